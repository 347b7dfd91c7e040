/// Reduces a case to a simpler one with the same finding.
#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// How simple a case is. The order is shortlex, fewer elements first: of two cases the one with fewer numbers is
/// simpler; of two with as many the one with fewer numbers that are not 0; then the one whose numbers are shorter in
/// sum; then the one with fewer different magnitudes. Two cases that are alike in all four are equally simple.
///
/// The length of a number x = m 2^e, with m odd and of b bits, is 6 b + 2 |e| + 1 where x is negative; that of 0 is 0,
/// and that of -0 is 1. So 1 is the shortest number but 0, and 4 is shorter than 3.
struct Simplicity {
  std::size_t numbers = 0, not_zero = 0, length = 0, magnitudes = 0;
  auto operator<=>(const Simplicity&) const = default;
};
Simplicity simplicity_of(const Case& c);

/// The valid simpler cases that are one step away, each exact in its scalar. A step leaves out an entry of a list,
/// scales all lengths by a power of two, shifts all positions along an axis so that one of them has the coordinate 0,
/// rounds all lengths to a grid, gives a member its simplest value (0; no rotation; a direction along an axis) or the
/// value of another member of its kind, or gives one number a simpler value or that of another number of its role.
std::vector<Case> simpler_by_one_step(const Case& c);

/// A case for which `keeps` holds, and for none of those that are simpler by one step. It is no less simple than `c`.
/// `keeps(c)` must hold. `keeps` is called at most `questions` times, always with valid cases that are exact in their
/// scalar; where that is not enough, the result is the simplest case so far. Deterministic.
Case shrink(const Case& c, const std::function<bool(const Case&)>& keeps, int questions = 20000);

}  // namespace nearmiss
