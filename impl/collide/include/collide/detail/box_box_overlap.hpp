/// The kernel of box_box_overlap (collide/box_box_overlap.hpp).
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/box_pair.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// Filter in doubles: the answer, or nullopt if rounding may change the decision.
///
/// Let u = 2^-53, N = |q1|^2 |q2|^2, and L the sum of |x| + |y| + |z| of both half extents and of the vector between
/// the centers. A number of `relative` has an error of 3 u sqrt(N), a cosine 16 u N, a component of a cross product
/// 46 u N, and `between` 8 u |q1|^2 L. So the gap along an axis of box 1 has an error of 24 u N L, and along another
/// axis less than 96 u N |q1|^2 L.
template <class T>
std::optional<BoxOverlap<T>> filtered_overlap(const Box<T>& box1, const Box<T>& box2) {
  using L = Lanes<double>;
  const L between = wide_lanes(box2.center) - wide_lanes(box1.center);
  const auto wide = [](const Quaternion<T>& q) { return Quaternion<double>{q.x, q.y, q.z, q.w}; };
  const BoxPairInLanes<double> pair(wide(box1.orientation), wide(box2.orientation), between, wide_lanes(box1.half),
                                    wide_lanes(box2.half));
  const double lengths = sum_of_three(absolute(between) + absolute(pair.half1) + absolute(pair.half2)).first();
  if (!(pair.is_valid() && lengths >= 0x1p-400 && lengths <= 0x1p400)) return std::nullopt;
  const L bound = L::splat(0x1p-45 * lengths) * pair.norm1 * pair.norm2, of_others = bound * pair.norm1,
          zero = L::splat(0.0);
  unsigned apart = 0, overlap = 0;
  const auto look_at = [&](int n, const auto& s) COLLIDE_INLINE {  // the bound also covers small cross products
    const L& least = n == 0 ? bound : of_others;
    apart |= unsigned((least < s.gap).bits() & 7) << 3 * n;
    overlap |= unsigned((s.gap < zero - least).bits() & 7) << 3 * n;
  };
  pair.for_each_face_axis(look_at);
  if (apart == 0) pair.for_each_cross_axis(look_at);
  if (apart != 0) return BoxOverlap<T>{false, axis_of_bit(first_bit(apart))};
  if (overlap == (1u << box_box_axes) - 1) return BoxOverlap<T>{true, -1};
  return std::nullopt;
}

}  // namespace detail

#endif

COLLIDE_COMPILED(box_box_overlap)

namespace kernels {

template <class Tier, class T>
inline BoxOverlap<T> box_box_overlap(const Box<T>& box1, const Box<T>& box2, int hint) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {  // computes all axes at once, so a hint saves nothing
    const detail::BoxPairInLanes<T> pair(box1, box2);
    unsigned overlaps = 0;
    const bool good = pair.for_each_axis([&](int n, const auto& s) {
      overlaps |= unsigned((s.gap <= detail::Lanes<T>::splat(T(0))).bits() & 7) << 3 * n;
    });
    if (pair.is_valid() && good) {
      const int axis = detail::axis_of_bit(detail::first_bit(~overlaps));
      return {axis < 0, axis};
    }
  }
  if constexpr (uses_filter<Tier, T>) {
    if (const auto decided = detail::filtered_overlap(box1, box2)) return Tier::decided_by_filter(*decided);
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(box_box_overlap, box1, box2, hint);
  } else {
    const detail::BoxPair<T> pair(box1, box2);
    if constexpr (MachineNumber<T>) {
      if (!(pair.norm1 * pair.norm2 > T(0))) return {};  // a zero quaternion, or NaN
    }
    const auto separates = [&](int axis) {  // NaN counts as separating: it must not become an overlap
      return !(detail::separation(pair, axis).gap <= T(0));
    };
    if (hint >= 0 && hint < box_box_axes && separates(hint)) return {false, hint};
    for (int axis = 0; axis < box_box_axes; ++axis) {
      if (separates(axis)) return {false, axis};
    }
    return {true, -1};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
