/// Groups breakages of subjects by cause.
#pragma once

#include <string>
#include <string_view>

#include "impl/catalogue/break_cause.hpp"

namespace nearmiss {

/// The kind under which a breakage is counted: its reason (Answer::reason) without the parts that differ between cases.
///
/// A reason that names a line of a source file, as assertions and many exceptions do, becomes its cause and that line:
/// "killed by signal 6 (Aborted) at gjk.h:335". Any other reason keeps its words, and each number becomes N:
/// "exception: no root in [N, N]". All breakages at a time limit are one kind.
std::string kind_of_breakage(std::string_view reason, BreakCause cause);

/// The cause of a breakage that a report file describes by its reason and by the flag `late`.
BreakCause cause_in_report(std::string_view reason, bool late);

}  // namespace nearmiss
