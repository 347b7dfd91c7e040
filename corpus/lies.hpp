/// Answers that are wrong by construction: what the judge is watched with. That they are wrong is known from plain
/// bounds (corpus/bodies.hpp), which share nothing with the oracle and hold for every input near the given one.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// What a lie is about.
enum class Topic { decision, time, depth, place, number };
inline constexpr int topic_count = 5;
std::string_view name_of(Topic topic);

/// An answer that gives the number that is wrong alone, or the decision alone.
struct Lie {
  Topic topic;
  Answer answer;
};

/// Lies about the case: no input within `widening` has an exact answer that matches one of them. Each widening that
/// moves a number is at least 2^-44 of the largest in the number's group, so that the bounds' own rounding does not
/// count. None where the bounds do not tell, and for a query that they do not know. `salt` chooses by how much a number
/// is wrong.
std::vector<Lie> lies_about(const Case& c, std::span<const double> widening, std::uint64_t salt);

/// How many times further than a bound on the backward error a gross lie about it is.
inline constexpr double lies_beyond = 0x1p10;
/// The widening for lies that are so many times further off than such a bound. A bound that is nothing in subnormal
/// numbers moves them by one; a lie is then beyond as many times that.
std::vector<double> widening_of_lies(const Case& c, double backward, double beyond = lies_beyond);

/// Bounds that are held against lies about the query: what the tier `Fast` of that scalar promises, and in double one
/// that is many bits wide.
std::vector<double> bounds_for_lies(const Query& query, Scalar scalar);

/// Does the judge prove that the lie is further off than the bound?
bool is_told(const Case& c, const Lie& lie, double backward);

/// True for a query of which lies are known.
bool has_lies(const Query& query);

}  // namespace nearmiss
