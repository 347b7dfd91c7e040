/// Lies: answers that are wrong by construction, to test the judge. Plain bounds (properties/judge/bodies.hpp), which
/// share no code with the oracle, show that a lie is wrong for every input near the given one.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The member of an answer that a lie is about.
enum class Topic { decision, time, depth, place, number };
inline constexpr int topic_count = 5;
std::string_view name_of(Topic topic);

/// An answer that gives only the wrong number, or only the decision.
struct Lie {
  Topic topic;
  Answer answer;
};

/// Lies about the case: no input within `widening` has an exact answer that matches one of them. Each number that may
/// move must move by at least 2^-44 of the largest in its group, so that the rounding of the bounds does not matter.
/// Returns none if the bounds cannot tell, or for a query without bounds. `salt` chooses the error of a wrong number.
std::vector<Lie> lies_about(const Case& c, std::span<const double> widening, std::uint64_t salt);

/// By what factor a gross lie exceeds a bound on the backward error.
inline constexpr double lies_beyond = 0x1p10;
/// The widening for lies that exceed the bound by a factor. A bound that is zero in subnormal numbers moves them by
/// one; a lie then exceeds that by the same factor.
std::vector<double> widening_of_lies(const Case& c, double backward, double beyond = lies_beyond);

/// The bounds against which lies about the query are judged: that of the tier `Fast` in that scalar and, in double, a
/// bound many bits wide.
std::vector<double> bounds_for_lies(const Query& query, Scalar scalar);

/// Whether the judge proves that the lie exceeds the bound.
bool is_refuted(const Case& c, const Lie& lie, double backward);

/// Whether lies() knows the query.
bool has_lies(const Query& query);

}  // namespace nearmiss
