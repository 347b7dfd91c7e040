/// Checks a time of contact with static queries of the referees: the two bodies should be apart before it, and touch at
/// it or after it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/judge.hpp"
#include "reports/findings/workers.hpp"

namespace nearmiss {

/// The answers of a referee with the moving body at its position before, at and after a time of contact. The position
/// is rounded, and referees have tolerances, so a check never changes a verdict.
struct StaticCheck {
  std::string referee;
  std::string version;
  std::string_view query;       ///< the static one
  std::string of;               ///< the source of the time: "answer" or "truth"
  std::array<double, 3> times;  ///< before, at and after; before is the time itself where that is 0
  std::array<Answer, 3> said;
};

/// Checks the time of the answer and, where it differs, the exact time, with every referee that offers the static
/// query. Empty where the catalogue has no static query for the two bodies. In the step before and after, the body
/// moves by 2^-10 of the largest size of the scene or, where all sizes are zero, of the largest position.
std::vector<StaticCheck> static_checks(const Case& question, const Answer& answer, const Truth& truth,
                                       Workers& workers);

}  // namespace nearmiss
