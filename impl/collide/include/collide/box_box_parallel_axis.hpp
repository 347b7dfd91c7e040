/// Which axes of two boxes are parallel.
#pragma once

#include <collide/answers.hpp>
#include <collide/box_pair.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether an axis of box 1 and one of box 2 are parallel up to `epsilon`, and which: the first pair, in
/// the order (0, 0), (0, 1), (0, 2), (1, 0) ... (2, 2), of which
///
/// 1. |cosine of the angle between axis1 and axis2| >= 1 - epsilon
///
/// `epsilon` has no unit: 0 asks for exactly parallel axes, 1 or more for any, less than 0 for none. Source: with r the
/// relative rotation, 1 -+ cosine is a sum of two squares of sums of r's numbers, over |r|^2; so nearly
/// parallel axes are told from parallel ones without the rounding of a cosine near 1.
template <class Tier = Fast, class T>
ParallelAxes<T> box_box_parallel_axis(const Box<T>& box1, const Box<T>& box2, T epsilon) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_parallel_axis<decltype(by)>(a...); }, box1, box2,
                      epsilon);
  }
  if (epsilon < T(0)) return {};  // no two axes are that near
  const std::array<T, 4> r = detail::seen_from(detail::moderate(box1.orientation), detail::moderate(box2.orientation));
  const T most = epsilon * detail::norm2(r);
  if constexpr (MachineNumber<T>) {
    if (!(detail::norm2(r) > T(0))) return {};  // no rotation, or NaN
  }
  if (epsilon >= T(1))
    return epsilon <= std::numeric_limits<T>::max() ? ParallelAxes<T>{true, 0, 0} : ParallelAxes<T>{};
  const auto sum = [](const T& a, const T& b) { return a * a + b * b; };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      T from_same, from_opposite;  // |r|^2 (1 - cosine), |r|^2 (1 + cosine)
      if (i == j) {
        from_same = T(2) * sum(r[(i + 1) % 3], r[(i + 2) % 3]);
        from_opposite = T(2) * sum(r[i], r[3]);
      } else {
        const T third = j == (i + 1) % 3 ? r[3 - i - j] : -r[3 - i - j];
        from_same = sum(r[i] - r[j], r[3] + third);
        from_opposite = sum(r[i] + r[j], r[3] - third);
      }
      if (smaller(from_same, from_opposite) <= most) return {true, i, j};
    }
  }
  return {};
}

/// The same from what the tools for pairs of boxes share: as exact as the cosines are.
template <class Tier = Fast, class T>
ParallelAxes<T> box_box_parallel_axis(const BoxBoxInfo<T>& info, T epsilon) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_parallel_axis<decltype(by)>(a...); }, info,
                      epsilon);
  }
  for (int i = 0; i < 3; ++i) {
    const std::array<T, 3> row = components(info.abs_cosine[i]);
    for (int j = 0; j < 3; ++j) {
      if (row[j] >= T(1) - epsilon) return {true, i, j};
    }
  }
  return {};
}

namespace contracts {

/// First order: the numbers of the relative rotation are known to 4 eps |q1| |q2|, which turning box 2
/// by 8 eps explains; the two sides of the comparison carry 4 and 5 eps of themselves, as much as
/// turning by 5 eps of the angle in question does.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_parallel_axis() {
  return Tier::template contract<T>({.backward = 32, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
