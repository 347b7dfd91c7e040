/// The outcome of the test of a hypothesis.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/triage/causes/cause.hpp"

namespace nearmiss {

/// A cause whose test passed.
struct Named {
  CauseKind kind = CauseKind::unexplained;
  std::string key, text;
};

struct Tested {
  std::optional<Named> named;
  std::vector<Evidence> evidence;
};

/// 9 of 10.
inline bool nearly_all(std::size_t part, std::size_t all) { return all > 0 && 10 * part >= 9 * all; }
/// 3 of 4.
inline bool most(std::size_t part, std::size_t all) { return all > 0 && 4 * part >= 3 * all; }

}  // namespace nearmiss
