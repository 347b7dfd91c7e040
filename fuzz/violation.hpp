/// What a fuzz target does with a violation.
#pragma once

#include "impl/subject/subject.hpp"
#include "oracles/confirmed.hpp"

namespace nearmiss::fuzz {

/// With a folder in NEARMISS_FUZZ_REPORTS: writes the case there, at most 100 files for each kind of finding, and
/// returns. Without one, or after abort_on_violation(): prints the case and aborts, in a function whose name contains
/// query, subject and kind. Ends the process with exit status 2 where the file cannot be written.
void report(const Case& c, const Subject& subject, const Finding& f);

/// From now on report() aborts, also after it has written a file.
void abort_on_violation();

/// Prints the case and aborts, so that it becomes an artifact of the target. Judging the artifact repeats the error.
[[noreturn]] void end_with(const InternalError& error, const Subject& subject);

}  // namespace nearmiss::fuzz
