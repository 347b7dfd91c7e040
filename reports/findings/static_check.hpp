/// Times of contact, checked by the referees' static queries: are the two apart before, and together at it or after?
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/judge.hpp"
#include "reports/findings/workers.hpp"

namespace nearmiss {

/// What a referee says when the moving body is put where it is before, at and after a time of contact. The place is
/// rounded, and referees have tolerances; so it decides nothing.
struct StaticCheck {
  std::string referee;
  std::string version;
  std::string_view query;       ///< the static one
  std::string of;               ///< whose time: "answer" or "truth"
  std::array<double, 3> times;  ///< before, at and after; before is the time itself where that is 0
  std::array<Answer, 3> said;
};

/// Checks the time of the answer and, where it is another one, that of the truth, by every referee that offers the
/// static query; none where the catalogue has no static query for the two. Before and after are so far off that the
/// body moves by 2^-10 of the scene's largest size or, where everything is a point, position.
std::vector<StaticCheck> static_checks(const Case& question, const Answer& answer, const Truth& truth,
                                       Workers& workers);

}  // namespace nearmiss
