/// Filters of Certified for penetrations of a box, in the next wider type (wide_filters.hpp has the terms).
///
/// Each number of an axis has an error of 19 u: the scale 2 / |q|^2 has one of 6 u of itself, a product of two numbers
/// of q and the scale one of 8 u, and the magnitudes of such products sum to at most 2.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

template <class T>
Axes<Wider<T>> axes_in_wider(const Quaternion<T>& q) {
  using W = Wider<T>;
  return axes_of(Quaternion<W>{W(q.x), W(q.y), W(q.z), W(q.w)});
}

/// Filter: the penetration of a sphere and a box, or nullopt.
///
/// Let D be the sum of the magnitudes of the vector between the centers. Its numbers in the box's frame have an error
/// of 23 u D, those of the vector `away` from the nearest place of the box one of 25 u D, and its length 47 u D.
/// Outside, the normal has an error of 44 u D of this length and 42 u more; the nearest place one of 80 u D and 1 u of
/// itself. With D <= half_ulp / 128 of the length and of the contact, and half of that of the depth, all are accurate.
/// Inside, the distances from the faces have an error of 24 u D and 1 u of themselves; the nearest face is certain if
/// all others are farther by more than 64 u D and 4 u of their distance. The contact then has an error of 21 u of the
/// radius and 1 u of itself.
template <class T>
std::optional<Penetration<T>> filtered_penetration(const Sphere<T>& sphere, const Box<T>& box) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    constexpr W u = std::numeric_limits<W>::epsilon() / 2, most = half_ulp<T> / 64;
    if (!(magnitudes(box.half) <= std::numeric_limits<T>::max())) return std::nullopt;
    const Axes<W> axes = axes_in_wider(box.orientation);
    const Vec3<W> middle = in_wider(box.center), center = in_wider(sphere.center), between = center - middle;
    const std::array<W, 3> half = components(in_wider(box.half)), local = into_frame<Plain>(axes, between);
    const W size = magnitudes(between), radius = W(sphere.radius);
    std::array<W, 3> to_face, away, nearest;
    for (std::size_t i = 0; i < 3; ++i) {
      to_face[i] = half[i] - detail::abs(local[i]);
      nearest[i] = clamped(local[i], -half[i], half[i]);
      away[i] = local[i] - nearest[i];
    }
    const W distance2 = away[0] * away[0] + away[1] * away[1] + away[2] * away[2];
    if (distance2 > W(0)) {
      const W distance = detail::sqrt(distance2), depth = radius - distance;
      if (!(2 * size <= most * distance)) return std::nullopt;
      if (depth < W(0)) return accurate_penetration<T>(depth, {}, {}, size, W(0));
      const W inverse = W(-1) / distance;
      return accurate_penetration<T>(depth, out_of_frame(axes, away) * inverse, middle + out_of_frame(axes, nearest),
                                     size, 2 * size);
    }
    std::size_t face = 0;
    for (std::size_t i = 1; i < 3; ++i) face = to_face[i] < to_face[face] ? i : face;
    for (std::size_t i = 0; i < 3; ++i) {
      const W beyond = i == face ? W(0) : to_face[face];
      if (!(to_face[i] - beyond > 64 * u * size + 4 * u * to_face[i])) return std::nullopt;
    }
    if (!(detail::abs(local[face]) > 32 * u * size)) return std::nullopt;  // which of two opposite faces?
    const Vec3<W> normal = axes[face] * (local[face] < W(0) ? W(1) : W(-1));
    return accurate_penetration<T>(radius + to_face[face], normal, center + normal * radius, size, radius);
  }
  return std::nullopt;
}

/// Filter: the depth of a box behind a plane and its contacts, or nullopt.
///
/// Let N and H be the sums of the magnitudes of the normal and of the half extents, and B the sum of the magnitudes of
/// the products of the normal with the center, of the offset, and of N H. A side has an error of 20 u of its length, so
/// the height of a corner, times |normal|, has one of 27 u B. Where B is at most half_ulp / 32 of the lowest height,
/// the depth is accurate. A corner has an error of 26 u H and 3 u of itself; it is accurate where H is at most
/// half_ulp / 32 of it. Heights beyond 32 u B have certain signs.
template <class T>
std::optional<CornerContacts<T>> filtered_contacts(const Box<T>& box, const Plane<T>& plane) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    constexpr W u = std::numeric_limits<W>::epsilon() / 2, most = half_ulp<T> / 32;
    const Axes<W> axes = axes_in_wider(box.orientation);
    const Vec3<W> middle = in_wider(box.center), half = in_wider(box.half), n = in_wider(plane.normal);
    const Vec3<W> x = axes[0] * half.x, y = axes[1] * half.y, z = axes[2] * half.z;
    const Vec3<W> above{n.x * middle.x, n.y * middle.y, n.z * middle.z};
    const W offset = W(plane.offset), center = above.x + above.y + above.z + offset;
    const W to_x = Plain::dot(n, x), to_y = Plain::dot(n, y), to_z = Plain::dot(n, z), extent = magnitudes(half);
    const W size = magnitudes(above) + detail::abs(offset) + magnitudes(n) * extent;
    const W lowest = center - detail::abs(to_x) - detail::abs(to_y) - detail::abs(to_z);
    const W norm = detail::sqrt(Plain::dot(n, n)), inverse = W(1) / norm;
    CornerContacts<T> answer;
    answer.depth = T(-lowest * inverse);
    const T magnitude = detail::abs(answer.depth);
    if (!(norm > W(0) && size <= std::numeric_limits<W>::max() && size <= most * detail::abs(lowest) &&
          magnitude >= std::numeric_limits<T>::min() && magnitude <= std::numeric_limits<T>::max()))
      return std::nullopt;
    if (lowest > W(0)) return answer;
    answer.normal = rounded_to<T>(n * inverse);
    const std::array<W, 4> heights{center - to_x - to_y, center + to_x - to_y, center - to_x + to_y,
                                   center + to_x + to_y};
    const std::array<Vec3<W>, 4> places{middle - x - y, middle + x - y, middle - x + y, middle + x + y};
    for (std::size_t i = 0; i < 8; ++i) {
      const W height = i < 4 ? heights[i] - to_z : heights[i - 4] + to_z;
      if (!(detail::abs(height) > 32 * u * size)) return std::nullopt;
      if (height > W(0)) continue;
      const Vec3<T> corner = rounded_to<T>(i < 4 ? places[i] - z : places[i - 4] + z);
      if (!(double(extent) <= double(most) * double(largest_magnitude(corner)))) return std::nullopt;
      answer.corners[i] = {true, corner};
    }
    return answer;
  }
  return std::nullopt;
}

/// Filter: the values that queries about two boxes share, or nullopt.
///
/// A cosine is a product of two axes: it has an error of at most 71 u, and the largest of its row is at least 0.57. Let
/// D be the sum of the magnitudes of the vector between the centers. In a frame it has an error of 23 u D, and its
/// largest number is at least D / 3.
template <class T>
std::optional<BoxBoxInfo<T>> filtered_info(const Box<T>& box1, const Box<T>& box2) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    const Axes<W> axes1 = axes_in_wider(box1.orientation), axes2 = axes_in_wider(box2.orientation);
    const Vec3<W> between = in_wider(box2.center) - in_wider(box1.center);
    const auto rounded_in = [](const Axes<W>& axes, const Vec3<W>& v) {
      return Vec3<T>{T(Plain::dot(axes[0], v)), T(Plain::dot(axes[1], v)), T(Plain::dot(axes[2], v))};
    };
    BoxBoxInfo<T> info;
    info.half1 = box1.half, info.half2 = box2.half, info.between = rounded_to<T>(between);
    T all = magnitudes(info.half1) + magnitudes(info.half2) + magnitudes(info.between);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3<T> row = rounded_in(axes2, axes1[i]);
      info.cosine[i] = row;
      info.abs_cosine[i] = {detail::abs(row.x), detail::abs(row.y), detail::abs(row.z)};
      all += magnitudes(row);
    }
    info.between1 = rounded_in(axes1, between), info.between2 = rounded_in(axes2, between);
    if (all <= std::numeric_limits<T>::max() / 8) return info;
  }
  return std::nullopt;
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
