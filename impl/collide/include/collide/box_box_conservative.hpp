/// Whether two boxes may overlap, from their bounding spheres.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

namespace detail {

/// |between| <= |half1| + |half2|, rounded to yes: never no where it holds in real numbers.
template <class T>
bool may_reach(const Vec3<T>& half1, const Vec3<T>& half2, const Vec3<T>& between) noexcept {
  const std::array<T, 3> d = components(between), a = components(half1), b = components(half2);
  T distance = length(d), reach = length(a) + length(b);
  if constexpr (MachineNumber<T>) {
    // To first order a length carries 1 eps for the difference of the centers, 1 + 2 for its squares and
    // their sums, halved by the root, 1 for the root (as much again after a division that keeps squares from
    // underflow), and the sum of the two 1: 4 ulps, 8 eps, are more than twice what the sides differ by.
    constexpr T slack = T(4) * std::numeric_limits<T>::epsilon();
    reach = reach + (reach * slack + std::numeric_limits<T>::denorm_min());
    if (distance > std::numeric_limits<T>::max()) {  // the squares are beyond the largest number
      using std::abs;
      const T largest = larger(larger(larger(abs(d[0]), abs(d[1])), abs(d[2])),
                               larger(larger(larger(a[0], a[1]), a[2]), larger(larger(b[0], b[1]), b[2])));
      if (!(largest <= std::numeric_limits<T>::max())) return false;
      const T scale = std::ldexp(T(1), -std::ilogb(largest) - 1);
      return may_reach(half1 * scale, half2 * scale, between * scale);
    }
  }
  return distance <= reach;
}

}  // namespace detail

/// Whether the boxes' bounding spheres meet: with D the vector between the centers and a, b those from
/// each center to a corner,
///
/// 1. answer == (|D| <= |a| + |b|)
///
/// Boxes that touch always get a yes: where the two sides are as near as rounding, so is the answer.
template <class Tier = Fast, class T>
Decision<T> box_box_conservative(const Box<T>& box1, const Box<T>& box2) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_conservative<decltype(by)>(a...); }, box1, box2);
  }
  return {detail::may_reach(box1.half, box2.half, box2.center - box1.center)};
}

/// The same from what the tools for pairs of boxes share.
template <class Tier = Fast, class T>
Decision<T> box_box_conservative(const BoxBoxInfo<T>& info) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_conservative<decltype(by)>(a...); }, info);
  }
  return {detail::may_reach(info.half1, info.half2, info.between)};
}

namespace contracts {

/// First order: the two sides differ by 4 eps of themselves, and 8 eps are added on purpose: 12 eps of
/// the sizes, or of |D| in the positions, at most 4 G with G the largest: less than 64 in either.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_conservative() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
