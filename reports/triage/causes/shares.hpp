/// Bounds of the share of all cases that was seen in a sample.
#pragma once

#include <cstddef>

namespace nearmiss {

/// The probability that one of these bounds is wrong.
constexpr double error_of_a_share = 0.05;
/// The true share is at least this one, by the bound of Clopper and Pearson; 0 where nothing was seen.
double proved_at_least(std::size_t part, std::size_t whole);
/// The true share is at most this one; 1 where nothing was seen.
double proved_at_most(std::size_t part, std::size_t whole);

}  // namespace nearmiss
