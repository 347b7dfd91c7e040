/// Why subjects broke, told apart by cause.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// The kind of a breakage: its reason (Answer::reason) without what differs from case to case. A reason that names a
/// line of a source file, as assertions and many exceptions do, is told by signal or exception and that line: "killed
/// by signal 6 (Aborted) at gjk.h:335". Any other keeps its words, and its numbers are N: "exception: no root in [N,
/// N]". `late`: a time limit was reached, whatever it was.
std::string kind_of_breakage(std::string_view reason, bool late = false);

}  // namespace nearmiss
