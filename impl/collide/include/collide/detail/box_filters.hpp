/// Filters of Certified for boxes, in the next wider type (wide_filters.hpp has the terms).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/detail/wide_lanes.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The box with its quaternion in the range in which products neither overflow nor underflow, by a power of two. With
/// it, a filter gives the same bits for every such multiple of the quaternion.
template <class T>
Box<T> with_rescaled_rotation(const Box<T>& box) {
  const auto [x, y, z, w] = rescaled(box.orientation);
  return {box.center, box.half, {x, y, z, w}};
}

/// The image of a coordinate axis i under the rotation of a quaternion q, times |q|^2. Number k of `along` is that of
/// the coordinate (i + k) mod 3, so that the compiler knows the places of all numbers.
///
/// The magnitudes of the terms of a number sum to at most |q|^2, so the first number has an error of 3 u |q|^2, the
/// others of 2 u |q|^2. As a vector, the axis has an error of less than 4.2 u |q|^2. |q|^2 has one of 3 u of itself.
template <class W>
struct ScaledAxis {
  std::array<W, 3> along;
  W norm2;  ///< |q|^2
};

/// v[i], v[i + 1], v[i + 2], cyclically.
template <class W, class T>
std::array<W, 3> in_cyclic_order(const Vec3<T>& v, std::size_t i) {
  const std::array<T, 3> all = components(v);
  return {W(all[i]), W(all[(i + 1) % 3]), W(all[(i + 2) % 3])};
}
template <class T, class W>
Vec3<T> from_cyclic_order(const std::array<W, 3>& numbers, std::size_t i) {
  std::array<T, 3> all;
  for (std::size_t k = 0; k < 3; ++k) all[(i + k) % 3] = T(leading_part(numbers[k]));
  return {all[0], all[1], all[2]};
}

template <class W, class T>
ScaledAxis<W> scaled_axis(const Quaternion<T>& q, std::size_t i) {
  const std::array<W, 3> v = in_cyclic_order<W>(Vec3<T>{q.x, q.y, q.z}, i);
  const W w = W(q.w), xx = v[0] * v[0], yy = v[1] * v[1], zz = v[2] * v[2], ww = w * w, x = v[0] + v[0], twice = w + w;
  return {{(ww - zz) + (xx - yy), x * v[1] + twice * v[2], x * v[2] - twice * v[1]}, (ww + zz) + (xx + yy)};
}

/// A quaternion q, for one number of a rotated vector at a time: registers of the wider type are few. Vectors have five
/// numbers, of the coordinates x, y, z, x and y, so that the next two coordinates follow each.
template <class T, class W>
struct AxesOneByOne {
  std::array<T, 5> v;
  T w;
  W w2, norm2;  ///< the square of w, and |q|^2

  explicit AxesOneByOne(const Quaternion<T>& q) : v{q.x, q.y, q.z, q.x, q.y}, w(q.w), w2(W(q.w) * W(q.w)) {
    norm2 = (w2 + W(q.x) * W(q.x)) + (W(q.y) * W(q.y) + W(q.z) * W(q.z));
  }
  /// The numbers i, i + 1 and i + 2 of axis i, times |q|^2, with the errors of ScaledAxis.
  W own(std::size_t i) const {
    return (w2 - W(v[i + 2]) * W(v[i + 2])) + (W(v[i]) * W(v[i]) - W(v[i + 1]) * W(v[i + 1]));
  }
  W next(std::size_t i) const {
    const W half = W(v[i]) * W(v[i + 1]) + W(w) * W(v[i + 2]);
    return half + half;
  }
  W last(std::size_t i) const {
    const W half = W(v[i]) * W(v[i + 2]) - W(w) * W(v[i + 1]);
    return half + half;
  }
  std::array<W, 5> axis(std::size_t i) const {
    std::array<W, 5> all;
    const std::size_t following = (i + 1) % 3, last_one = (i + 2) % 3;
    all[i] = own(i), all[following] = next(i), all[last_one] = last(i);
    all[3] = all[0], all[4] = all[1];
    return all;
  }
  /// Number i of the vector x in the rotated frame, times |q|^2.
  W along(std::size_t i, const std::array<W, 5>& x) const {
    return own(i) * x[i] + next(i) * x[i + 1] + last(i) * x[i + 2];
  }
  /// Number i of the vector that is x in the rotated frame, times |q|^2.
  W out_of(std::size_t i, const std::array<W, 5>& x) const {
    const W next_half = W(v[i]) * W(v[i + 1]) - W(w) * W(v[i + 2]);
    const W last_half = W(v[i]) * W(v[i + 2]) + W(w) * W(v[i + 1]);
    return own(i) * x[i] + ((next_half + next_half) * x[i + 1] + (last_half + last_half) * x[i + 2]);
  }
};

#if defined(COLLIDE_LANES)

/// Where the center of a sphere certainly lies: beyond the faces of a box (bit i of `outside`: beyond one of those
/// across axis i), or inside, with a certain nearest face. `nearest` is the axis of that face or of the only face that
/// the center is beyond; 3 if there is none.
struct CenterAndBox {
  bool certain = false;
  int outside = 0;
  std::size_t nearest = 3;
};

/// Let u = 2^-53, N = |q|^2, and S the sum of the magnitudes of the vector between the centers and of the half extents.
/// A number of the rotation matrix times N has an error of 3 u N, one of the vector in the box's frame, times N, of
/// 7 u N S, and N times a half extent of 4 u N S. So the differences of the two have an error of less than 13 u N S.
/// The filter uses a bound of 16 u N S, and two of them to compare two differences.
template <class T>
CenterAndBox certain_side(const Sphere<T>& sphere, const Box<T>& box) {
  using L = Lanes<double>;
  const L between = wide_lanes(sphere.center) - wide_lanes(box.center), half = wide_lanes(box.half);
  const L q = wide_lanes(box.orientation), norm2 = sum_of_four(q * q), zero = L::splat(0.0);
  const L local = FrameInLanes<double>::scaled(q).into(between);
  const L to_face = half * norm2 - absolute(local), size = sum_of_three(absolute(between) + absolute(half));
  const L bound = L::splat(0x1p-49) * norm2 * size;
  const bool in_range = is_in_safe_range(norm2.first()) && size.first() >= 0x1p-400 && size.first() <= 0x1p400;
  if (!(in_range && all_three(bound < absolute(to_face)))) return {};
  CenterAndBox place{true, (to_face < zero).bits() & 7, 3};
  const L most = smallest_of_three(to_face) + bound + bound;
  const int axes = place.outside != 0 ? place.outside : (to_face <= most).bits() & 7;
  const bool one_axis = (axes & (axes - 1)) == 0 && ((bound < absolute(local)).bits() & axes) != 0;
  if (one_axis) place.nearest = std::size_t(axes >> 1);
  place.certain = one_axis || place.outside != 0;
  return place;
}

/// The penetration of a sphere and a box for a center beyond one face alone (`outside`), or inside and nearest to it.
///
/// Let d be the distance of the centers. The component of the vector between them along the axis has an error of 9 u d,
/// and after the division by |q|^2 of 13 u d. The excess over the half extent has one of 1 u of itself more: it is at
/// most d outside, and at most the depth inside. So the depth has an error of 14 u d and 2 u of itself, the normal one
/// of 8 u, and the contact one of 23 u d and 1 u of itself outside, of 9 u of the radius and 1 u of itself inside.
template <class T>
std::optional<Penetration<T>> penetration_along_axis(const Sphere<T>& sphere, const Box<T>& box, std::size_t i,
                                                     bool outside, double apart) {
  using W = Wider<T>;
  const ScaledAxis<W> axis = scaled_axis<W>(box.orientation, i);
  const std::array<W, 3> center = in_cyclic_order<W>(sphere.center, i), middle = in_cyclic_order<W>(box.center, i);
  W along = axis.along[0] * (center[0] - middle[0]);
  for (std::size_t k = 1; k < 3; ++k) along = along + axis.along[k] * (center[k] - middle[k]);
  const W inverse = W(along < W(0) ? 1 : -1) / axis.norm2, radius = W(sphere.radius);
  const W excess = -(along * inverse) - W(components(box.half)[i]), depth = radius - excess;
  if (depth < W(0)) return accurate_penetration<T>(T(depth), {}, {}, apart / 4, 0);
  const W way = outside ? excess : radius;
  std::array<W, 3> normal, contact;
  for (std::size_t k = 0; k < 3; ++k) {
    normal[k] = axis.along[k] * inverse;
    contact[k] = center[k] + normal[k] * way;
  }
  return accurate_penetration<T>(T(depth), from_cyclic_order<T>(normal, i), from_cyclic_order<T>(contact, i), apart / 4,
                                 outside ? apart * 3 / 8 : double(radius) / 4);
}

/// The penetration of a sphere and a box for a center beyond two or three faces.
///
/// As above, each excess has an error of 14 u d; as a vector e they have one of 24 u d. Turned into the world it has
/// one of 21 u |e| more, and its length one of 24 u d and 4 u of itself. So the depth has an error of 28 u d and 1 u of
/// itself, the contact one of 45 u d and 1 u of itself. The normal is the computed e, turned and divided by its own
/// length: it has an error of 24 u d by |e|, and of 30 u. The largest number of a unit vector is at least 0.57.
template <class T>
std::optional<Penetration<T>> penetration_beyond_edge(const Sphere<T>& sphere, const Box<T>& box, int outside,
                                                      double apart) {
  using W = Wider<T>;
  const AxesOneByOne<T, W> axes(box.orientation);
  const std::array<T, 3> center = components(sphere.center), middle = components(box.center);
  const std::array<T, 3> half = components(box.half);
  const auto between = [&](std::size_t i) COLLIDE_INLINE { return W(center[i]) - W(middle[i]); };
  const std::array<W, 5> to_center{between(0), between(1), between(2), between(0), between(1)};
  const W inverse = W(1) / axes.norm2;
  std::array<W, 5> away{};
  W distance2 = W(0);
  for (std::size_t i = 0; i < 3; ++i) {
    if ((outside >> i & 1) == 0) continue;
    const W along = axes.along(i, to_center) * inverse;
    away[i] = along < W(0) ? along + W(half[i]) : along - W(half[i]);
    distance2 = distance2 + away[i] * away[i];
  }
  const W distance = detail::sqrt(distance2), depth = W(sphere.radius) - distance;
  if (depth < W(0)) return accurate_penetration<T>(T(depth), {}, {}, apart / 2, 0);
  if (!(24 * apart <= (0.56 * double(half_ulp<T>) - 32) * double(distance))) return std::nullopt;
  away[3] = away[0], away[4] = away[1];
  const W per_distance = W(-1) / distance;
  std::array<T, 3> normal, contact;
  for (std::size_t i = 0; i < 3; ++i) {
    const W outward = axes.out_of(i, away) * inverse;
    normal[i] = T(outward * per_distance), contact[i] = T(W(center[i]) - outward);
  }
  return accurate_penetration<T>(T(depth), {normal[0], normal[1], normal[2]}, {contact[0], contact[1], contact[2]},
                                 apart / 2, apart * 3 / 4);
}

/// Filter: the penetration of a sphere and a box, or nullopt. In double.
inline std::optional<Penetration<double>> filtered_penetration(const Sphere<double>& sphere, const Box<double>& given) {
  if constexpr (has_wider<double>) {
    const Box<double> box = with_rescaled_rotation(given);
    const CenterAndBox place = certain_side(sphere, box);
    if (!place.certain) return std::nullopt;
    const Vec3<double> between = sphere.center - box.center;
    const double apart = detail::sqrt(Plain::dot(between, between));
    if (place.nearest < 3) return penetration_along_axis(sphere, box, place.nearest, place.outside != 0, apart);
    return penetration_beyond_edge(sphere, box, place.outside, apart);
  }
  return std::nullopt;
}

/// The same in float, where doubles have digits enough for every case at once. The errors are those of
/// penetration_beyond_edge, with D, the sum of the magnitudes of the vector between the centers, for d. Inside, the
/// distances from the faces have an error of 12 u D and 1 u of themselves: the nearest face is certain if all others
/// are farther by more than 64 u D and 4 u of their distance.
inline std::optional<Penetration<float>> filtered_penetration(const Sphere<float>& sphere, const Box<float>& given) {
  using L = Lanes<double>;
  const Box<float> box = with_rescaled_rotation(given);
  constexpr double u = std::numeric_limits<double>::epsilon() / 2, most = half_ulp<float> / 128;
  const L center = wide_lanes(sphere.center), between = center - wide_lanes(box.center), half = wide_lanes(box.half);
  const L q = wide_lanes(box.orientation), norm2 = sum_of_four(q * q);
  if (!(is_in_safe_range(norm2.first()) && all_three(are_finite(half)))) return std::nullopt;
  const auto frame = FrameInLanes<double>::scaled(q);
  const L inverse = broadcast_first(TwoDoubles::splat(1.0) / first_pair(norm2));
  const L local = frame.into(between) * inverse, away = excess(local, half);
  const double size = sum_of_three(absolute(between)).first(), radius = sphere.radius;
  const double distance2 = sum_of_three(away * away).first();
  if (distance2 > 0) {
    const double distance = detail::sqrt(distance2), depth = radius - distance;
    if (!(size <= most * distance)) return std::nullopt;
    if (depth < 0) return accurate_penetration<float>(float(depth), {}, {}, size / 2, 0.0);
    const L to_center = frame.out_of(away) * inverse;
    return accurate_penetration<float>(float(depth), to_vec3(in_floats(to_center * L::splat(-1 / distance))),
                                       to_vec3(in_floats(center - to_center)), size / 2, size);
  }
  const L to_face = half - absolute(local), nearest = smallest_of_three(to_face);
  const L is_near = to_face * L::splat(1 - 4 * u) <= nearest + L::splat(64 * u * size);
  const L certain_sign = L::splat(32 * u * size) < absolute(local);
  const int axes = is_near.bits() & 7;
  const bool certainly_inside = nearest.first() > 64 * u * size;
  if (!(certainly_inside && (axes & (axes - 1)) == 0 && (certain_sign.bits() & axes) != 0)) return std::nullopt;
  const L side = L::splat(-1.0) ^ (local & L::splat(-0.0));
  const L normal = frame.out_of(side & is_near & L::mask_of_three()) * inverse;
  return accurate_penetration<float>(float(radius + nearest.first()), to_vec3(in_floats(normal)),
                                     to_vec3(in_floats(center + normal * L::splat(radius))), size, radius / 4);
}

#endif

/// The difference of two points in the frame of a rotation q, one number at a time: registers of the wider type are
/// few.
///
/// Let D be the sum of the magnitudes of the difference, and N = |q|^2. A number, times N, is a sum of three terms that
/// have errors of 6, 9 and 4 u N D, so a number has an error of less than 30 u D. The largest is at least D / 3.
template <class T>
Vec3<T> difference_in_frame(const Quaternion<T>& q, const Vec3<T>& to, const Vec3<T>& from) {
  using W = Wider<T>;
  const std::array<T, 5> v{q.x, q.y, q.z, q.x, q.y}, end{to.x, to.y, to.z, to.x, to.y},
      begin{from.x, from.y, from.z, from.x, from.y};
  const auto between = [&](std::size_t i) { return W(end[i]) - W(begin[i]); };
  W vector2 = W(0), along_vector = W(0);
  for (std::size_t i = 0; i < 3; ++i) {
    vector2 = vector2 + W(v[i]) * W(v[i]);
    along_vector = along_vector + W(v[i]) * between(i);
  }
  const W w2 = W(q.w) * W(q.w), inverse = W(1) / (w2 + vector2), rest = (w2 - vector2) * inverse;
  const W by_vector = (along_vector + along_vector) * inverse, by_cross = (W(q.w) + W(q.w)) * inverse;
  std::array<T, 3> numbers;
  for (std::size_t i = 0; i < 3; ++i) {
    const W across = between(i + 1) * W(v[i + 2]) - between(i + 2) * W(v[i + 1]);
    numbers[i] = T(rest * between(i) + (by_vector * W(v[i]) + by_cross * across));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

/// The cosines of the angles between the axes of two rotations: number j of row i is that of axis i of the first and
/// axis j of the second.
///
/// They are the matrix of the product r of the inverse of the first quaternion with the second. As a vector, r has an
/// error of 8 u |r|, which turns the matrix by 16 u at most. A number of the matrix has an error of 10 u more, and the
/// largest of its row is at least 0.57.
template <class T>
std::array<Vec3<T>, 3> cosines_of_axes(const Quaternion<T>& q1, const Quaternion<T>& q2) {
  using W = Wider<T>;
  const auto product = [](T a, T b) { return W(a) * W(b); };
  const W x = (product(q1.w, q2.x) - product(q2.w, q1.x)) - (product(q1.y, q2.z) - product(q1.z, q2.y));
  const W y = (product(q1.w, q2.y) - product(q2.w, q1.y)) - (product(q1.z, q2.x) - product(q1.x, q2.z));
  const W z = (product(q1.w, q2.z) - product(q2.w, q1.z)) - (product(q1.x, q2.y) - product(q1.y, q2.x));
  const W w = (product(q1.w, q2.w) + product(q1.x, q2.x)) + (product(q1.y, q2.y) + product(q1.z, q2.z));
  const W xx = x * x, yy = y * y, zz = z * z, ww = w * w, inverse = W(1) / ((xx + yy) + (zz + ww));
  const W twice = inverse + inverse;
  const auto pair = [&](const W& a, const W& b, T& sum, T& difference) {
    sum = T((a + b) * twice), difference = T((a - b) * twice);
  };
  std::array<Vec3<T>, 3> cosine;
  cosine[0].x = T(((ww + xx) - (yy + zz)) * inverse);
  cosine[1].y = T(((ww + yy) - (xx + zz)) * inverse);
  cosine[2].z = T(((ww + zz) - (xx + yy)) * inverse);
  pair(x * y, w * z, cosine[1].x, cosine[0].y);
  pair(x * z, w * y, cosine[0].z, cosine[2].x);
  pair(y * z, w * x, cosine[2].y, cosine[1].z);
  return cosine;
}

/// Filter: the values that queries about two boxes share, or nullopt.
template <class T>
std::optional<BoxBoxInfo<T>> filtered_info(const Box<T>& box1, const Box<T>& box2) {
  if constexpr (has_wider<T>) {
    BoxBoxInfo<T> info;
    info.half1 = box1.half, info.half2 = box2.half, info.between = box2.center - box1.center;
    T all = magnitudes(info.half1) + magnitudes(info.half2) + magnitudes(info.between);
    const std::array<Vec3<T>, 3> cosine = cosines_of_axes(box1.orientation, box2.orientation);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3<T>& row = cosine[i];
      info.cosine[i] = row;
      info.abs_cosine[i] = {detail::abs(row.x), detail::abs(row.y), detail::abs(row.z)};
      all += magnitudes(row);
    }
    info.between1 = difference_in_frame(box1.orientation, box2.center, box1.center);
    info.between2 = difference_in_frame(box2.orientation, box2.center, box1.center);
    if (all <= std::numeric_limits<T>::max() / 8) return info;
  }
  return std::nullopt;
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
