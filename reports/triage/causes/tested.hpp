/// The outcome of the test of a hypothesis.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/triage/causes/cause.hpp"
#include "reports/triage/causes/shares.hpp"

namespace nearmiss {

/// What must be true besides if a cause is the right one. hypotheses/predictions.cpp has the tests.
enum class Prediction {
  at_every_scale,       ///< the finding stays where lengths or velocities are multiplied by powers of two
  in_every_rounding,    ///< the finding stays in the four rounding modes; behind pipes, where numbers move by some ulps
  in_every_mode,        ///< the finding of this case, and of nearly all others, stays in the four rounding modes
  changes_by_rounding,  ///< the answer or its error changes with the rounding mode, or with the last bits of the inputs
  extreme_numbers,      ///< a formula of the case leaves the range of a type
  small_error,          ///< the error is one that rounding may have
  two_borders,          ///< from scale to scale, the answers are wrong, then right, and then wrong again
  one_border,           ///< from scale to scale, the answers are wrong up to one border and right beyond it
  ends_at_a_scale,  ///< the finding ends where lengths, velocities, directions or rotations are multiplied by a power
                    ///< of two
  one_side_nearby,  ///< at least half of the cases a few ulps away with the same exact decision are wrong too
};

/// Where a finding ends while a group of numbers is multiplied by powers of two.
struct BorderOfScale {
  std::string_view group;
  bool wrong_below = true;
  double low = 0, high = 0;  ///< between these, the largest of the multiplied numbers lies at the borders
};

/// A cause whose test passed.
struct Named {
  CauseKind kind = CauseKind::unexplained;
  std::string key, text;
  std::vector<Prediction> predictions{};
  std::optional<BorderOfScale> border{};  ///< of an absolute tolerance: the finding of other cases ends there too
};

struct Tested {
  std::optional<Named> named;
  std::vector<Evidence> evidence;
};

/// 9 of 10.
constexpr double share_of_nearly_all = 0.9;
inline bool nearly_all(std::size_t part, std::size_t all) { return all > 0 && 10 * part >= 9 * all; }
/// It is proved that more than half of all have what this part of a sample has: of five cases, all.
inline bool proved_of_most(std::size_t part, std::size_t all) { return proved_at_least(part, all) > 0.5; }
/// 3 of 4.
inline bool most(std::size_t part, std::size_t all) { return all > 0 && 4 * part >= 3 * all; }

}  // namespace nearmiss
