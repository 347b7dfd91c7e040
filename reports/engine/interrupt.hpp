/// Turns SIGINT, SIGTERM and SIGHUP into a request to stop.
#pragma once

namespace nearmiss {

/// From now on the first of these signals makes interrupted() true, and a second one ends the process. An ignored
/// SIGHUP (nohup) stays ignored.
void catch_interrupts();
bool interrupted();

}  // namespace nearmiss
