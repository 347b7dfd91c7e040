/// The two errors of an answer that a search for worst cases maximises.
#pragma once

#include <optional>
#include <string_view>

#include "oracles/judge.hpp"

namespace nearmiss {

enum class ErrorKind {
  forward,   ///< of an answer with the right decision: its distance from the nearest exact answer, in ulps
  backward,  ///< of the whole answer, in epsilon
};
inline constexpr ErrorKind error_kinds[] = {ErrorKind::forward, ErrorKind::backward};

/// "forward", "backward".
std::string_view name_of(ErrorKind kind);
/// "ulps", "epsilon".
std::string_view unit_of(ErrorKind kind);

/// True where the judge compared the answer with the exact one: the subject was asked, it answered, and its contract
/// covers the case.
bool is_compared(const Finding& f);

/// The proved lower bound of the answer's error, at the judge's full detail; the backward error by finer_backward().
/// Empty where the answer is not compared, where nothing is proved, and for a forward error that is not finite.
std::optional<double> error_of(const Case& question, const Answer& answer, const Standard& standard, ErrorKind kind);

}  // namespace nearmiss
