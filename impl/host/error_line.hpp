/// Finds the line of a program's output that says what ended it.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// The line that holds the error, without the white space around it: that of an uncaught exception, a panic, a failed
/// assertion or a sanitizer. What runtimes write below it (stack frames, hints, their version) is passed over. Where no
/// runtime is recognised, the last line that is not empty. Empty for an empty text.
std::string error_line_of(std::string_view output);

}  // namespace nearmiss
