#include "oracles/error_kind.hpp"

#include <cmath>

namespace nearmiss {

std::string_view name_of(ErrorKind kind) { return kind == ErrorKind::forward ? "forward" : "backward"; }
std::string_view unit_of(ErrorKind kind) { return kind == ErrorKind::forward ? "ulps" : "epsilon"; }

bool is_compared(const Finding& f) {
  return f.is_proved() || f.verdict == Verdict::agrees || f.verdict == Verdict::not_proved;
}

std::optional<double> error_of(const Case& question, const Answer& answer, const Standard& standard, ErrorKind kind) {
  const Finding f = judge(question, answer, standard, Detail::full);
  if (!is_compared(f)) return std::nullopt;
  if (kind == ErrorKind::backward) {
    return f.backward
               ? std::optional(finer_backward(question, answer, *f.backward, standard.required, standard.declared))
               : std::nullopt;
  }
  return f.forward_ulps > 0 && std::isfinite(f.forward_ulps) ? std::optional(f.forward_ulps) : std::nullopt;
}

}  // namespace nearmiss
