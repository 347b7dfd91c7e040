/// SIGINT, SIGTERM and SIGHUP as a request to stop at the next good moment.
#pragma once

namespace nearmiss {

/// The first of them from now on only makes interrupted() true; a second one ends the process. Under nohup SIGHUP
/// stays ignored.
void catch_interrupts();
bool interrupted();

}  // namespace nearmiss
