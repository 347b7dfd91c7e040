/// What ended a subject's work on a case without an answer.
#pragma once

#include <cstdint>
#include <string_view>

namespace nearmiss {

enum class BreakCause : std::uint8_t {
  other,       ///< a malformed answer, a memory limit, a function's own error code, a lost pipe
  exception,   ///< an exception left the subject's function
  signal,      ///< a signal killed the host
  exit_code,   ///< the host exited
  time_limit,  ///< a time limit was reached
};
inline constexpr int break_cause_count = int(BreakCause::time_limit) + 1;

/// The first words of the reason (Answer::reason) for each cause that has a fixed beginning; empty for the others. A
/// report file holds the reason, and the beginning is how a reader of the file finds the cause.
constexpr std::string_view reason_prefix(BreakCause cause) {
  switch (cause) {
    case BreakCause::exception: return "exception: ";
    case BreakCause::signal: return "killed by signal ";
    case BreakCause::exit_code: return "left with exit code ";
    case BreakCause::other:
    case BreakCause::time_limit: break;
  }
  return "";
}

}  // namespace nearmiss
