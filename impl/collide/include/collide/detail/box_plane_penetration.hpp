/// The kernel of box_plane_penetration (collide/box_plane_penetration.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/plane_contacts_filter.hpp>
#include <collide/detail/rotation_range.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// The kernel of `Fast` in lanes. Lane i stands for corner i, or corner i + 4.
template <class T>
inline CornerContacts<T> corner_contacts_in_lanes(const Lanes<T>& middle, const Lanes<T>& half,
                                                  const FrameInLanes<T>& frame, const Lanes<T>& n,
                                                  const Lanes<T>& offset, const Lanes<T>& norm) {
  using L = Lanes<T>;
  const L zero = L::splat(T(0)), reach = frame.into(n) * half, center = sum_of_three(n * middle) + offset;
  const L reach_x = reach.template broadcast<0>(), reach_y = reach.template broadcast<1>();
  const L reach_z = reach.template broadcast<2>();
  const L odd = L::of(T(-0.0), T(0), T(-0.0), T(0)), low_half = L::of(T(-0.0), T(-0.0), T(0), T(0));
  const L around = center + (reach_x ^ odd) + (reach_y ^ low_half);  // corners 0-3 and 4-7, without the z term
  const L height_low = around - reach_z, height_high = around + reach_z;
  const L lowest = smaller(height_low, height_high), pairwise = smaller(lowest, lowest.template shuffled<2, 3, 0, 1>());
  const L depth = (zero - smaller(pairwise, pairwise.template shuffled<1, 0, 3, 2>())) / norm, overlap = zero <= depth;
  const auto& [x, y, z] = frame.axes();
  const L side_x = x * half.template broadcast<0>(), side_y = y * half.template broadcast<1>();
  const L side_z = z * half.template broadcast<2>();
  const L behind_low = (height_low <= zero) & overlap, behind_high = (height_high <= zero) & overlap;
  const int behind = behind_low.bits() | behind_high.bits() << 4;
  const auto corner = [&](int i, const L& place, const L& mask) {
    return Corner<T>{(behind >> i & 1) != 0, to_vec3(place & mask)};
  };
  const L left_low = middle - side_x - side_y, right_low = middle + side_x - side_y;
  const L left_high = middle - side_x + side_y, right_high = middle + side_x + side_y;
  // Every member at once: an answer that is zeroed first takes half as long again, since a corner has padding.
  return {depth.first(),
          to_vec3((n / norm) & overlap),
          {corner(0, left_low - side_z, behind_low.template broadcast<0>()),
           corner(1, right_low - side_z, behind_low.template broadcast<1>()),
           corner(2, left_high - side_z, behind_low.template broadcast<2>()),
           corner(3, right_high - side_z, behind_low.template broadcast<3>()),
           corner(4, left_low + side_z, behind_high.template broadcast<0>()),
           corner(5, right_low + side_z, behind_high.template broadcast<1>()),
           corner(6, left_high + side_z, behind_high.template broadcast<2>()),
           corner(7, right_high + side_z, behind_high.template broadcast<3>())}};
}

}  // namespace detail

#endif

namespace detail {

/// Whether the decision of the answer of `Fast` is exact. With u the unit roundoff, N, M and H the length of the normal
/// and the sums of the magnitudes of the normal and of the half extents, and B the sum of the magnitudes of the terms
/// of the height of the center times N, and of M H: an axis has an error of 16 u, so a height of a corner above the
/// center times N has one of 21 u M H, and the height of the center times N one of 4 u B. Four sums add 4 u B. So the
/// height of the lowest corner has an error of less than 32 u B / N. N is at least the largest number of the normal.
template <class T>
bool is_certain(const CornerContacts<T>& answer, const Box<T>& box, const Plane<T>& plane) {
  const Vec3<T>&n = plane.normal, &middle = box.center;
  const T terms = magnitudes(Vec3<T>{n.x * middle.x, n.y * middle.y, n.z * middle.z}) + detail::abs(plane.offset);
  const T steepness = largest_magnitude(n), size = terms + magnitudes(n) * magnitudes(box.half);
  return is_accurate_rotation(box.orientation) && is_moderate_size(steepness) && is_moderate_size(size) &&
         detail::abs(answer.depth) * steepness > T(32) * std::numeric_limits<T>::epsilon() * size;
}

}  // namespace detail

COLLIDE_COMPILED(box_plane_penetration)

namespace kernels {

template <class Tier, class T>
inline CornerContacts<T> box_plane_penetration(const Box<T>& box, const Plane<T>& plane) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {
    using detail::lanes;
    using L = detail::Lanes<T>;
    using limits = std::numeric_limits<T>;
    const L middle = lanes(box.center), half = lanes(box.half), q = lanes(box.orientation), n = lanes(plane.normal);
    const L offset = L::splat(plane.offset), norm2 = sum_of_three(n * n);
    const L in_range = L::splat(limits::min() / limits::epsilon()) <= norm2;
    if (all_three(in_range & are_finite(middle, half, q, n, offset)))
      return detail::corner_contacts_in_lanes(middle, half, detail::FrameInLanes<T>(q), n, offset, sqrt(norm2));
  }
#endif
  if constexpr (Tier::template lifts<T>) {
#if defined(COLLIDE_LANES)
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_contacts(box, plane)) return Tier::decided_by_filter(*answer);
    }
#endif
    return COLLIDE_LIFTED(box_plane_penetration, box, plane);
  } else {
    const Axes<T> axes = axes_of(box.orientation);
    const std::array<Vec3<T>, 3> side{axes[0] * box.half.x, axes[1] * box.half.y, axes[2] * box.half.z};
    const T center = Tier::dot(plane.normal, box.center) + plane.offset;
    const std::array<T, 3> reach = into_frame<Tier>(side, plane.normal);
    const auto signed_sum = [](int corner, const auto& middle, const auto& sides) {
      const auto x = (corner & 1) != 0 ? middle + sides[0] : middle - sides[0];
      const auto y = (corner & 2) != 0 ? x + sides[1] : x - sides[1];
      return (corner & 4) != 0 ? y + sides[2] : y - sides[2];
    };
    std::array<T, 8> height;
    for (int i = 0; i < 8; ++i) height[i] = signed_sum(i, center, reach);
    T lowest = height[0];
    for (int i = 1; i < 8; ++i) lowest = smaller(lowest, height[i]);

    const T norm = length(components(plane.normal));
    CornerContacts<T> contacts;
    contacts.depth = -lowest / norm;
    if (!(contacts.depth >= T(0))) return contacts;
    contacts.normal = plane.normal / norm;
    for (int i = 0; i < 8; ++i) {
      if (height[i] <= T(0)) contacts.corners[i] = {typename Corner<T>::Flag(1), signed_sum(i, box.center, side)};
    }
    return contacts;
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline CornerContacts<T> box_plane_penetration(const Box<T>& box, const Plane<T>& plane) {
  return split_answer<Tier>([&](auto tier) { return kernels::box_plane_penetration<decltype(tier)>(box, plane); },
                            [&](const auto& answer) { return detail::is_certain(answer, box, plane); });
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
