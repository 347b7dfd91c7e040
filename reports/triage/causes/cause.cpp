#include "reports/triage/causes/cause.hpp"

namespace nearmiss {

std::string_view name_of(CauseKind kind) {
  switch (kind) {
    case CauseKind::rounding: return "rounding";
    case CauseKind::absolute_tolerance: return "absolute tolerance";
    case CauseKind::relative_tolerance: return "relative tolerance";
    case CauseKind::iteration_limit: return "iteration limit";
    case CauseKind::unsupported: return "unsupported";
    case CauseKind::overflow: return "overflow";
    case CauseKind::underflow: return "underflow";
    case CauseKind::convention: return "convention";
    case CauseKind::logic: return "logic";
    case CauseKind::unexplained: return "unexplained";
  }
  return "?";
}

}  // namespace nearmiss
