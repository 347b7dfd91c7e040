/// The cases that follow from a case by a relation, and what their answers must have in common.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// How two answers that have the same exact ones, but for a known change, compare.
enum class Agreement {
  same,              ///< in every number, bit for bit but for the sign of zero
  numbers_differ,    ///< the same decision
  decisions_differ,  ///< at least one of the two decisions is wrong
};
std::string_view name_of(Agreement a);

/// The follow-up cases of a case, and what all their answers must have in common.
struct FollowUps {
  std::vector<Case> cases;
  /// Compares the answer to the case itself with those to its follow-ups, in order.
  std::function<Agreement(const Answer& own, std::span<const Answer> others)> compare;
  /// Where there is one follow-up and its right answers are those of the case, changed: that change. What has
  /// no counterpart is not given.
  std::function<Answer(const Answer& own)> image;
  /// What is right within an ulp has such an image. Not so where the change moves numbers to another grid.
  bool image_keeps_ulps = true;
  /// Decisions that contradict each other are so whatever the numbers are; otherwise a wrong number may be at fault.
  bool decisions_alone = true;
};

namespace metamorphic {

/// One follow-up whose right answers are those of the case, changed by `image`.
FollowUps counterpart(Case other, std::function<Answer(const Answer&)> image);
/// Empty where the other case breaks a rule or is not exact in its scalar.
std::optional<FollowUps> counterpart_if_valid(Case other, std::function<Answer(const Answer&)> image);
/// Follow-ups of which only something in particular is known.
FollowUps ordered(std::vector<Case> others, std::function<Agreement(const Answer&, std::span<const Answer>)> compare);

bool valid(const Case& c);

/// More than the distance of two answers, each within 2 ulp of the same number, and of a rounded difference.
double slack(Scalar scalar, double a, double b);
inline constexpr double ulps_of_slack = 2;

/// The relations' own functions: the follow-ups of a case, chosen by `seed` where there is a choice; empty where there
/// are none.
using Follow = std::optional<FollowUps>(const Case& c, std::uint64_t seed);
Follow scaled_lengths, scaled_time, scaled_directions, scaled_rotations, negated_rotations;
Follow reflected, permuted_axes;
Follow translated, rotated;
Follow turned_corners, reversed_corners, swapped, reversed_directions, another_hint;
Follow later_start, split_motion;
Follow grown_size, contained_ball, longer_limit;
Follow prepared, one_point, sphere_as_point, two_triangles, same_decision, hits_pass, other_side;

}  // namespace metamorphic
}  // namespace nearmiss
