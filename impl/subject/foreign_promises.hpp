/// Whether the promises of libraries other than collide count.
#pragma once

namespace nearmiss {

/// Sets it for the rest of the process; usual: true. Where they do not count, Subject::standard_for() takes the measure
/// for every subject that is not our own (Subject::own).
void count_promises_of_others(bool count);

}  // namespace nearmiss
