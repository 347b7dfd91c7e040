/// Whether two boxes overlap.
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/box_pair.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// The answer; nothing where doubles may be wrong.
///
/// u = 2^-53, N = |q1|^2 |q2|^2, L the sum of |x| + |y| + |z| of both half extents and of the way between the centers.
/// A number of `turn` is known to 3 u sqrt(N), a cosine to 16 u N, a number of a cross product to 46 u N, `between` to
/// 8 u |q1|^2 L. So the gap of an axis of box 1 is known to 24 u N L, of another to less than 96 u N |q1|^2 L.
template <class T>
std::optional<BoxOverlap<T>> sure_overlap(const Box<T>& box1, const Box<T>& box2) noexcept {
  using L = Lanes<double>;
  const L way = wide_lanes(box2.center) - wide_lanes(box1.center);
  const auto wide = [](const Quaternion<T>& q) { return Quaternion<double>{q.x, q.y, q.z, q.w}; };
  const BoxPairInLanes<double> pair(wide(box1.orientation), wide(box2.orientation), way, wide_lanes(box1.half),
                                    wide_lanes(box2.half));
  const double lengths = sum_of_three(absolute(way) + absolute(pair.half1) + absolute(pair.half2)).first();
  if (!(pair.is_usual() && lengths >= 0x1p-400 && lengths <= 0x1p400)) return std::nullopt;
  const L bound = L::all(0x1p-45 * lengths) * pair.norm1 * pair.norm2, of_others = bound * pair.norm1,
          zero = L::all(0.0);
  unsigned apart = 0, overlap = 0;
  pair.for_each_axis([&](int n, const auto& s) {  // small cross products are within the bound as well
    const L& least = n == 0 ? bound : of_others;
    apart |= unsigned((least < s.gap).bits() & 7) << 3 * n;
    overlap |= unsigned((s.gap < zero - least).bits() & 7) << 3 * n;
  });
  if (apart != 0) return BoxOverlap<T>{false, axis_of_bit(first_bit(apart))};
  if (overlap == (1u << box_box_axes) - 1) return BoxOverlap<T>{true, -1};
  return std::nullopt;
}

}  // namespace detail

#endif

/// Whether the closed boxes meet and, where they do not, an axis that separates them: 0-2 the axes of
/// box 1, 3-5 those of box 2, 6 + 3 i + j the cross product of axis i of box 1 and axis j of box 2.
/// `hint` (-1, or the axis that separated them last time) may speed the answer up and never changes it,
/// but for which of several separating axes is named.
///
/// 1. box_box_overlap(a, b, h).overlap == box_box_overlap(a, b, -1).overlap
/// 2. overlap == (axis == -1)
///
/// Source: separating axes (Gottschalk, Lin, Manocha, OBBTree, 1996). The cross product of two nearly
/// parallel edges comes from the boxes' relative rotation (detail::BoxPair::cross_axis), so that it is a
/// direction and not what rounding leaves of one.
template <class Tier = Fast, class T>
BoxOverlap<T> box_box_overlap(const Box<T>& box1, const Box<T>& box2, int hint = -1) noexcept {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {  // all axes at once: a hint could save nothing
    const detail::BoxPairInLanes<T> pair(box1, box2);
    unsigned overlaps = 0;
    const bool good = pair.for_each_axis([&](int n, const auto& s) {
      overlaps |= unsigned((s.gap <= detail::Lanes<T>::all(T(0))).bits() & 7) << 3 * n;
    });
    if (pair.is_usual() && good) {
      const int axis = detail::axis_of_bit(detail::first_bit(~overlaps));
      return {axis < 0, axis};
    }
  }
  if constexpr (looks_first<Tier, T>) {
    if (const auto sure = detail::sure_overlap(box1, box2)) return Tier::sure(*sure);
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_overlap<decltype(by)>(a...); }, box1, box2, hint);
  }
  const detail::BoxPair<T> pair(box1, box2);
  if constexpr (MachineNumber<T>) {
    if (!(pair.norm1 * pair.norm2 > T(0))) return {};  // no rotation, or NaN
  }
  const auto separates = [&](int axis) {  // so does NaN: it must not look like an overlap
    return !(detail::separation(pair, axis).gap <= T(0));
  };
  if (hint >= 0 && hint < box_box_axes && separates(hint)) return {false, hint};
  for (int axis = 0; axis < box_box_axes; ++axis) {
    if (separates(axis)) return {false, axis};
  }
  return {true, -1};
}

namespace contracts {

/// First order: a number of the relative rotation is a sum of four products, known to 4 eps |q1| |q2|,
/// which turning box 2 by 8 eps explains, the same for every axis. An axis (cosine or cross product)
/// adds 4 eps of its own length, its gap 5 eps of the lengths along it; `between` carries 8 eps of its
/// own, at most 4 G with G the largest position: 32 eps of G, 24 eps of the rotations and sizes.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_overlap() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
