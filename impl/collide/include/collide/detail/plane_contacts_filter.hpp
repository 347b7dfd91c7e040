/// The filter of Certified for the penetration of a box and a plane.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/box_filters.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/detail/wide_lanes.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

#if defined(COLLIDE_LANES)

namespace collide::detail {

/// The corners of a box that certainly lie behind a plane (bit i: corner i); the sizes are in doubles. Valid if each
/// corner certainly lies in front of the plane or behind it.
struct CertainCorners {
  bool valid = false;
  unsigned behind = 0;
  double norm2 = 0;   ///< |q|^2
  double size = 0;    ///< B
  double lowest = 0;  ///< the height of the lowest corner, times |normal|
};

/// Let u = 2^-53, N = |q|^2, M and H the sums of the magnitudes of the normal and of the half extents, and B the sum of
/// the magnitudes of the products of the normal with the center, of the offset, and of M H. The normal in the box's
/// frame, times N, has an error of 7 u N M, and the height of the center, times N, one of 8 u N times its terms. So the
/// height of a corner, times N |normal|, has an error of less than 14 u N B. The filter uses a bound of 16 u N B. M and
/// B lie in a range where no product of them overflows and where underflow costs less than 1 u.
template <class T>
CertainCorners certain_corners(const Box<T>& box, const Plane<T>& plane) {
  using L = Lanes<double>;
  const L half = wide_lanes(box.half), normal = wide_lanes(plane.normal), q = wide_lanes(box.orientation);
  const L above = normal * wide_lanes(box.center), offset = L::splat(plane.offset), zero = L::splat(0.0);
  const L norm2 = sum_of_four(q * q), center = (sum_of_three(above) + offset) * norm2;
  const L reach = FrameInLanes<double>::scaled(q).into(normal) * half;
  const L steepness = sum_of_three(absolute(normal)), extent = sum_of_three(absolute(half));
  const L size = sum_of_three(absolute(above)) + absolute(offset) + steepness * extent;
  const L odd = L::of(-0.0, 0.0, -0.0, 0.0), low_half = L::of(-0.0, -0.0, 0.0, 0.0);
  const L around = center + (reach.template broadcast<0>() ^ odd) + (reach.template broadcast<1>() ^ low_half);
  const L reach_z = reach.template broadcast<2>(), low = around - reach_z, high = around + reach_z;
  const L bound = L::splat(0x1p-49) * norm2 * size;
  const int certain = (bound < absolute(low)).bits() & (bound < absolute(high)).bits();
  const auto is_in_range = [](const L& x) COLLIDE_INLINE { return x.first() >= 0x1p-900 && x.first() <= 0x1p900; };
  const bool in_range = is_in_safe_range(norm2.first()) && is_in_range(steepness) && is_in_range(size);
  if (!(in_range && certain == 15)) return {};
  const L lowest = smaller(low, high), pairwise = smaller(lowest, lowest.template shuffled<2, 3, 0, 1>());
  const double least = smaller(pairwise, pairwise.template shuffled<1, 0, 3, 2>()).first() / norm2.first();
  return {true, unsigned((low < zero).bits() | (high < zero).bits() << 4), norm2.first(), size.first(), least};
}

/// Filter: the depth of a box behind a plane and its contacts, or nullopt. In double.
///
/// Now in the wider type, with its u. A number of the normal in the box's frame, times N, is a sum of three terms that
/// have errors of 5, 8 and 3 u N M, and has one of 20 u N M with the sums. So the height of the lowest corner, times
/// N |normal|, has an error of less than 24 u N B, and N |normal| one of 8 u of itself. So where B is at most half_ulp
/// / 32 of that height, the depth is accurate. A number of an axis, times N, has an error of 3 u N, so a number of a
/// side one of 9 u of the half extent, and a corner one of 15 u H and 3 u of itself; it is accurate where H is at most
/// half_ulp / 32 of it.
///
/// The coordinates are computed one after the other: registers of the wider type are few.
inline std::optional<CornerContacts<double>> filtered_contacts(const Box<double>& given, const Plane<double>& plane) {
  if constexpr (has_wider<double>) {
    using W = Wider<double>;
    using limits = std::numeric_limits<double>;
    constexpr double most = double(half_ulp<double> / 32);
    const Box<double> box = with_rescaled_rotation(given);
    const CertainCorners corners = certain_corners(box, plane);
    if (!(corners.valid && corners.size <= most * detail::abs(corners.lowest))) return std::nullopt;
    // Numbers 3 and 4 are those of 0 and 1 again: the numbers of an axis i are those of i, i + 1 and i + 2.
    const auto cyclic = [](double x, double y, double z) { return std::array<double, 5>{x, y, z, x, y}; };
    const std::array<double, 5> q = cyclic(box.orientation.x, box.orientation.y, box.orientation.z);
    const std::array<double, 5> n = cyclic(plane.normal.x, plane.normal.y, plane.normal.z);
    const std::array<double, 5> half = cyclic(box.half.x, box.half.y, box.half.z);
    const std::array<double, 3> middle = components(box.center);
    const double w = box.orientation.w;
    W vector2 = W(0), along_vector = W(0), center = W(0), length2 = W(0), reach = W(0);
    for (std::size_t i = 0; i < 3; ++i) {
      vector2 = vector2 + W(q[i]) * W(q[i]);
      along_vector = along_vector + W(q[i]) * W(n[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      center = center + W(n[i]) * W(middle[i]);
      length2 = length2 + W(n[i]) * W(n[i]);
    }
    const W w2 = W(w) * W(w), norm2 = w2 + vector2, rest = w2 - vector2, by_vector = along_vector + along_vector,
            by_cross = W(w) + W(w);
    for (std::size_t i = 0; i < 3; ++i) {
      const W across = W(n[i + 1]) * W(q[i + 2]) - W(n[i + 2]) * W(q[i + 1]);
      const W along = rest * W(n[i]) + (by_vector * W(q[i]) + by_cross * across);
      reach = reach + detail::abs(along) * W(half[i]);
    }
    const W norm = detail::sqrt(length2);
    CornerContacts<double> answer;
    answer.depth = double((reach - (center + W(plane.offset)) * norm2) / (norm2 * norm));
    const double magnitude = detail::abs(answer.depth);
    if (!(magnitude >= limits::min() && magnitude <= limits::max())) return std::nullopt;
    if (corners.behind == 0) return answer;
    const W per_norm = W(1) / norm, per_norm2 = W(1) / norm2;
    std::array<std::array<double, 8>, 3> place;  // in place[i], bit 0 of the index is that of axis i, bit 1 of i + 1
    std::array<double, 3> normal;
    const auto twice = [](const W& x) COLLIDE_INLINE { return x + x; };
    for (std::size_t i = 0; i < 3; ++i) {
      normal[i] = double(W(n[i]) * per_norm);
      const W on_diagonal = (w2 - W(q[i + 2]) * W(q[i + 2])) + (W(q[i]) * W(q[i]) - W(q[i + 1]) * W(q[i + 1]));
      const W side0 = on_diagonal * W(half[i]) * per_norm2;
      const W side1 = twice(W(q[i]) * W(q[i + 1]) - W(w) * W(q[i + 2])) * W(half[i + 1]) * per_norm2;
      const W side2 = twice(W(q[i]) * W(q[i + 2]) + W(w) * W(q[i + 1])) * W(half[i + 2]) * per_norm2;
      std::array<double, 8>& to = place[i];
      const W low = W(middle[i]) - side0, high = W(middle[i]) + side0;
      const auto put = [&](std::size_t at, const W& x)
                           COLLIDE_INLINE { to[at] = double(x - side2), to[at + 4] = double(x + side2); };
      put(0, low - side1), put(2, low + side1), put(1, high - side1), put(3, high + side1);
    }
    answer.normal = {normal[0], normal[1], normal[2]};
    const double extent = half[0] + half[1] + half[2];
    for (unsigned i = 0; i < 8; ++i) {
      if ((corners.behind >> i & 1) == 0) continue;
      const Vec3<double> corner{place[0][i], place[1][(i >> 1 | i << 2) & 7], place[2][(i >> 2 | i << 1) & 7]};
      if (!(extent <= most * largest_magnitude(corner))) return std::nullopt;
      answer.corners[i] = {true, corner};
    }
    return answer;
  }
  return std::nullopt;
}

/// The same in float, where doubles have digits enough. A side has an error of 20 u of its length, so the height of a
/// corner, times |normal|, has one of 27 u B, and a corner one of 26 u H and 3 u of itself.
inline std::optional<CornerContacts<float>> filtered_contacts(const Box<float>& given, const Plane<float>& plane) {
  using L = Lanes<double>;
  using limits = std::numeric_limits<float>;
  constexpr double most = half_ulp<float> / 32;
  const Box<float> box = with_rescaled_rotation(given);
  const CertainCorners corners = certain_corners(box, plane);
  if (!(corners.valid && corners.size <= most * detail::abs(corners.lowest))) return std::nullopt;
  const L half = wide_lanes(box.half), normal = wide_lanes(plane.normal), middle = wide_lanes(box.center);
  const L inverse = L::splat(1 / detail::sqrt(sum_of_three(normal * normal).first()));
  CornerContacts<float> answer;
  answer.depth = float(-corners.lowest * inverse.first());
  const float magnitude = detail::abs(answer.depth);
  if (!(magnitude >= limits::min() && magnitude <= limits::max())) return std::nullopt;
  if (corners.behind == 0) return answer;
  answer.normal = to_vec3(in_floats(normal * inverse));
  const auto& [x, y, z] = FrameInLanes<double>(wide_lanes(box.orientation)).axes();
  const L side_x = x * half.broadcast<0>(), side_y = y * half.broadcast<1>(), side_z = z * half.broadcast<2>();
  const std::array<L, 4> places{middle - side_x - side_y, middle + side_x - side_y, middle - side_x + side_y,
                                middle + side_x + side_y};
  const double extent = sum_of_three(half).first();
  for (unsigned i = 0; i < 8; ++i) {
    if ((corners.behind >> i & 1) == 0) continue;
    const L& place = places[i & 3];
    const Vec3<float> corner = to_vec3(in_floats(i < 4 ? place - side_z : place + side_z));
    if (!(extent <= most * double(largest_magnitude(corner)))) return std::nullopt;
    answer.corners[i] = {true, corner};
  }
  return answer;
}

}  // namespace collide::detail

#endif

#include <collide/detail/strict_end.hpp>
