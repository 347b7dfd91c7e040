/// Follow-ups: the cases that a relation derives from a case, and how their answers must agree.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// How two answers compare whose exact answers are equal up to a known change.
enum class Agreement {
  same,              ///< every number is bitwise equal, apart from the sign of zero
  numbers_differ,    ///< the decisions are equal
  decisions_differ,  ///< at least one of the two decisions is wrong
};
std::string_view name_of(Agreement a);

/// The follow-ups of a case, and how all answers must agree.
struct FollowUps {
  std::vector<Case> cases;
  /// Compares the answer to the case with the answers to its follow-ups, in order.
  std::function<Agreement(const Answer& own, std::span<const Answer> others)> compare;
  /// If there is one follow-up, whose right answers are those of the case under a known change: that change. Leaves out
  /// numbers without a counterpart.
  std::function<Answer(const Answer& own)> image;
  /// Whether the image of an answer within an ulp is also within an ulp. False if the change moves numbers to another
  /// grid.
  bool image_keeps_ulps = true;
  /// Whether contradicting decisions are wrong whatever the numbers are; otherwise a wrong number may be the cause.
  bool decisions_alone = true;
};

namespace metamorphic {

/// One follow-up whose right answers are those of the case, changed by `image`.
FollowUps counterpart(Case other, std::function<Answer(const Answer&)> image);
/// Empty if the other case breaks a rule or is not exact in its scalar.
std::optional<FollowUps> counterpart_if_valid(Case other, std::function<Answer(const Answer&)> image);
/// Follow-ups of which only one particular consequence is known.
FollowUps ordered(std::vector<Case> others, std::function<Agreement(const Answer&, std::span<const Answer>)> compare);

bool valid(const Case& c);

/// An upper bound of the distance of two answers, each within 2 ulp of the same number, plus that of a rounded
/// difference.
double slack(Scalar scalar, double a, double b);
inline constexpr double ulps_of_slack = 2;

/// The relations' functions: the follow-ups of a case, chosen by `seed` if there is a choice; empty if there are none.
using Follow = std::optional<FollowUps>(const Case& c, std::uint64_t seed);
Follow scaled_lengths, scaled_time, scaled_directions, scaled_rotations, negated_rotations;
Follow reflected, permuted_axes;
Follow translated, rotated;
Follow turned_corners, reversed_corners, swapped, reversed_directions, another_hint;
Follow later_start, split_motion;
Follow grown_size, grown_radius, contained_ball, longer_limit;
Follow prepared, one_point, sphere_as_point, two_triangles, same_decision, sign_of_distance, depth_of_distance,
    distance_of_closest, gap_before_contact, hits_pass, other_side;

}  // namespace metamorphic
}  // namespace nearmiss
