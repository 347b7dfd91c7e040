/// Filters of Certified for pairs of boxes that give the numbers of an answer. They compute in W: the next wider type,
/// or double-words where that has too few digits (wide_filters.hpp has the terms; u is the unit roundoff of W).
///
/// Let N1 = |q1|^2, N2 = |q2|^2, N = N1 N2, D the sum of the magnitudes of the vector between the centers, H1 and H2
/// those of the half extents, and S = D + H1 + H2. A scaled axis has an error of 4.2 u of its length as a vector, and
/// of 3 u N1 in each number (box_filters.hpp). So its product with the vector between the centers has an error of 7 u
/// N1 D, and the product of two axes one of 12 u N.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/box_filters.hpp>
#include <collide/detail/box_pair.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

template <class W>
W product(const std::array<W, 3>& a, const std::array<W, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// a + b s
template <class W>
std::array<W, 3> moved(const std::array<W, 3>& a, const std::array<W, 3>& b, const W& s) {
  return {a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s};
}
template <class W>
std::array<W, 3> difference(const std::array<W, 3>& a, const std::array<W, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// The distance of the centers plus `reach`, or infinity where the sum is so small that a product could underflow.
template <class T>
double size_from_centers(const Box<T>& box1, const Box<T>& box2, double reach) {
  const Vec3<double> between = in_double(box2.center) - in_double(box1.center);
  const double size = detail::sqrt(Plain::dot(between, between)) + reach;
  return size >= 0x1p-400 ? size : std::numeric_limits<double>::infinity();
}

/// S, or 0 where a product could leave the range of a double.
template <class T>
double size_of_pair(const Box<T>& box1, const Box<T>& box2) {
  const auto has_safe_length = [](const Quaternion<T>& q) {
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    return is_in_safe_range(x * x + y * y + z * z + w * w);
  };
  const double size = magnitudes(in_double(box2.center) - in_double(box1.center)) + magnitudes(in_double(box1.half)) +
                      magnitudes(in_double(box2.half));
  const bool in_range = size >= 0x1p-400 && size <= 0x1p400;
  return in_range && has_safe_length(box1.orientation) && has_safe_length(box2.orientation) ? size : 0;
}

/// The error in u that leaves a number of magnitude 1 accurate, beside one of 32 u of itself and as much for the
/// rounding of the bounds.
template <class T, class W>
inline constexpr double most_error_in = half_ulp_in<T, W> - 64;

/// Whether a length is accurate that has an error of `error` u, and of 32 u of itself.
template <class T, class W>
bool is_accurate_length(const W& length, double error) {
  const auto magnitude = double(leading_part(abs(length)));
  return error <= most_error_in<T, W> * magnitude && magnitude >= double(std::numeric_limits<T>::min()) &&
         magnitude <= double(std::numeric_limits<T>::max()) / 2;
}
template <class T, class W>
bool is_accurate_place(const Vec3<T>& place, double error) {
  return error <= most_error_in<T, W> * double(largest_magnitude(place));
}

/// The unit roundoff of W.
template <class T, class W>
inline constexpr double roundoff_of = double(std::numeric_limits<T>::epsilon()) / 4 / half_ulp_in<T, W>;

/// Two boxes seen along axis i of box 1. All vectors are in cyclic order from the coordinate i.
template <class T, class W>
struct AlongFaceAxis {
  ScaledAxis<W> axis;
  std::array<ScaledAxis<W>, 3> axes2;  ///< number k of axes2[l] is that of the coordinate (l + k) mod 3
  std::array<W, 3> center2, half2, cosine;
  W inverse, gap;  ///< 1 / N; the gap between the projections of the boxes onto the axis

  /// Let d be the length of the vector between the centers, and h the half extent of box 1. The product of axis and
  /// vector between the centers, times N2, has an error of 13 u N d, h times N one of 8 u N h, and the projection of
  /// box 2 one of 15 u N H2. With their sums the error is at most 16 u N (d + h + H2), and the division by N adds 9 u
  /// of the gap.
  AlongFaceAxis(const Box<T>& box1, const Box<T>& box2, std::size_t i)
      : axis(scaled_axis<W>(box1.orientation, i)),
        center2(in_cyclic_order<W>(box2.center, i)),
        half2(in_cyclic_order<W>(box2.half, i)) {
    const std::array<T, 3> v = components(Vec3<T>{box2.orientation.x, box2.orientation.y, box2.orientation.z});
    const Quaternion<T> q2{v[i], v[(i + 1) % 3], v[(i + 2) % 3], box2.orientation.w};
    W reach2 = W(0);
    for (std::size_t l = 0; l < 3; ++l) {
      axes2[l] = scaled_axis<W>(q2, l);
      const std::array<W, 3>& a = axis.along;
      cosine[l] = product(axes2[l].along, {a[l], a[(l + 1) % 3], a[(l + 2) % 3]});
      reach2 = reach2 + half2[l] * abs(cosine[l]);
    }
    const W toward = product(axis.along, difference(center2, in_cyclic_order<W>(box1.center, i)));
    const W norm = axis.norm2 * axes2[0].norm2, reach1 = W(components(box1.half)[i]) * norm;
    inverse = W(1) / norm;
    gap = (abs(toward) * axes2[0].norm2 - (reach1 + reach2)) * inverse;
  }
};

/// Two boxes seen along the cross product c of axis i of box 1 and axis j of box 2.
template <class T, class W>
struct AlongCrossAxis {
  std::array<std::array<W, 3>, 3> axes1, axes2;  ///< times N1 and N2
  W norm1, norm2;
  std::array<W, 3> between;
  std::array<W, 2> in1, in2;  ///< c in the frames of both boxes, times N, as in CrossAxis
  W toward, gap;              ///< times N1 N
  W sine;                     ///< times N

  /// A number of c in the frame of a box has an error of 12 u N, so its length, the sine of the angle between the axes,
  /// one of 17 u N and 3 u of itself. The vector between the centers has an error of 7 u N1 D in the frame of box 1. So
  /// its product with c has one of 29 u N1 N D, and the projections of the boxes have one of 21 u N1 N (H1 + H2). With
  /// their sums the error of the gap is at most 32 u N1 N S.
  AlongCrossAxis(const Box<T>& box1, const Box<T>& box2, std::size_t i, std::size_t j) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    const auto wide = [](const Quaternion<T>& q) { return std::array<W, 4>{W(q.x), W(q.y), W(q.z), W(q.w)}; };
    const std::array<W, 4> q1 = wide(box1.orientation), q2 = wide(box2.orientation);
    axes1 = scaled_axes(q1), axes2 = scaled_axes(q2);
    norm1 = detail::norm2(q1), norm2 = detail::norm2(q2);
    between = difference(in_cyclic_order<W>(box2.center, 0), in_cyclic_order<W>(box1.center, 0));
    in1 = {-product(axes1[i2], axes2[j]), product(axes1[i1], axes2[j])};
    in2 = {product(axes1[i], axes2[j2]), -product(axes1[i], axes2[j1])};
    const std::array<T, 3> half1 = components(box1.half), half2 = components(box2.half);
    toward = product(axes1[i1], between) * in1[0] + product(axes1[i2], between) * in1[1];
    const W reach1 = W(half1[i1]) * abs(in1[0]) + W(half1[i2]) * abs(in1[1]);
    const W reach2 = W(half2[j1]) * abs(in2[0]) + W(half2[j2]) * abs(in2[1]);
    gap = abs(toward) - (reach1 + reach2) * norm1;
    sine = sqrt(in1[0] * in1[0] + in1[1] * in1[1]);
  }
};

/// d + h + H2: of the boxes along axis i of box 1, as AlongFaceAxis has them. Infinity where they are tiny.
template <class T>
double size_along_face(const Box<T>& box1, const Box<T>& box2, std::size_t i) {
  return size_from_centers(box1, box2, double(components(box1.half)[i]) + magnitudes(in_double(box2.half)));
}

/// The gap between the projections of two boxes onto axis i of box 1, with the errors of AlongFaceAxis.
template <class T, class W>
W face_gap(const Box<T>& box1, const Box<T>& box2, std::size_t i) {
  const AxesOneByOne<T, W> axes1(box1.orientation), axes2(box2.orientation);
  const std::array<T, 3> center1 = components(box1.center), center2 = components(box2.center);
  const std::array<T, 3> half2 = components(box2.half);
  const std::array<W, 5> axis = axes1.axis(i);
  W toward = W(0), reach2 = W(0);
  for (std::size_t k = 0; k < 3; ++k) {
    toward = toward + axis[k] * (W(center2[k]) - W(center1[k]));
    reach2 = reach2 + W(half2[k]) * abs(axes2.along(k, axis));
  }
  const W norm = axes1.norm2 * axes2.norm2;
  return (abs(toward) * axes2.norm2 - (W(components(box1.half)[i]) * norm + reach2)) / norm;
}

/// The gap between the projections of two boxes onto the cross product of axis i of box 1 and axis j of box 2, times
/// the sine of the angle between these axes.
template <class W>
struct CrossGap {
  W by_sine, sine;  ///< times N
  W norm;           ///< N
};

/// d + H: d is the length of the vector between the centers, H the sum of the half extents along the other axes.
/// Infinity where they are tiny.
template <class T>
double size_along_cross(const Box<T>& box1, const Box<T>& box2, std::size_t i, std::size_t j) {
  const std::array<T, 3> half1 = components(box1.half), half2 = components(box2.half);
  return size_from_centers(box1, box2,
                           double(half1[(i + 1) % 3]) + double(half1[(i + 2) % 3]) + double(half2[(j + 1) % 3]) +
                               double(half2[(j + 2) % 3]));
}

/// As a vector, the cross product times N has an error of 12 u N, so its product with the vector between the centers
/// one of 16 u N d. The projections of the boxes have one of 16 u N H. So `by_sine` has an error of 16 u N (d + H) and
/// 1 u of itself, and `sine` one of 12 u N and of 3 u of itself.
template <class T, class W>
CrossGap<W> cross_gap(const Box<T>& box1, const Box<T>& box2, std::size_t i, std::size_t j) {
  const AxesOneByOne<T, W> axes1(box1.orientation), axes2(box2.orientation);
  const std::array<T, 3> center1 = components(box1.center), center2 = components(box2.center);
  const std::array<T, 3> half1 = components(box1.half), half2 = components(box2.half);
  const std::array<W, 5> a = axes1.axis(i), b = axes2.axis(j);
  W toward = W(0), length2 = W(0), reach = W(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const W c = a[k + 1] * b[k + 2] - a[k + 2] * b[k + 1];
    toward = toward + c * (W(center2[k]) - W(center1[k]));
    length2 = length2 + c * c;
  }
  // The product with one of the two other axes of a box is, up to the sign, that of the third axis with a or b.
  for (std::size_t k = 1; k < 3; ++k) {
    const std::size_t ik = (i + k) % 3, jk = (j + k) % 3;
    reach = reach + W(half1[3 - i - ik]) * abs(axes1.along(ik, b)) + W(half2[3 - j - jk]) * abs(axes2.along(jk, a));
  }
  return {abs(toward) - reach, sqrt(length2), axes1.norm2 * axes2.norm2};
}

/// The gap between the projections of two boxes onto an axis, or nullopt.
template <class T, class W>
std::optional<Measure<T>> projected_distance_in(const Box<T>& box1, const Box<T>& box2, std::size_t axis) {
  if (axis < 6) {
    const W gap = axis < 3 ? face_gap<T, W>(box1, box2, axis) : face_gap<T, W>(box2, box1, axis - 3);
    const double size = axis < 3 ? size_along_face(box1, box2, axis) : size_along_face(box2, box1, axis - 3);
    if (is_accurate_length<T>(gap, 16 * size)) return Measure<T>{T(leading_part(gap))};
  } else {
    const std::size_t i = (axis - 6) / 3, j = (axis - 6) % 3;
    const CrossGap<W> gap = cross_gap<T, W>(box1, box2, i, j);
    const W value = gap.by_sine / gap.norm;
    if (is_accurate_length<T>(value, 16 * size_along_cross(box1, box2, i, j)))
      return Measure<T>{T(leading_part(value))};
  }
  return std::nullopt;
}

/// Filter: the gap between the projections of two boxes onto an axis, or nullopt.
template <class T>
std::optional<Measure<T>> filtered_projected_distance(const Box<T>& given1, const Box<T>& given2, int axis) {
  const Box<T> box1 = with_rescaled_rotation(given1), box2 = with_rescaled_rotation(given2);
  if (!(axis >= 0 && axis < box_box_axes && size_of_pair(box1, box2) > 0)) return std::nullopt;
  const auto n = std::size_t(axis);
  if constexpr (has_wider<T>) {
    if (const auto answer = projected_distance_in<T, Wider<T>>(box1, box2, n)) return answer;
  }
  if constexpr (std::same_as<T, double>) return projected_distance_in<T, DoubleWord<double>>(box1, box2, n);
  return std::nullopt;
}

/// Filter: a candidate separating axis, or nullopt. The numbers of an axis have an error of 9 u, and the largest is at
/// least 0.57. Those of a cross product, times N, have one of 12 u N, and of 9 u of themselves with the division.
template <class T>
std::optional<Direction<T>> filtered_separating_axis(const Box<T>& box1, const Box<T>& box2, int axis) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    if (!(axis >= 0 && axis < box_box_axes)) return std::nullopt;
    const auto n = std::size_t(axis);
    const AxesOneByOne<T, W> axes1(with_rescaled_rotation(box1).orientation);
    const AxesOneByOne<T, W> axes2(with_rescaled_rotation(box2).orientation);
    if (!(is_in_safe_range(double(axes1.norm2)) && is_in_safe_range(double(axes2.norm2)))) return std::nullopt;
    if (n < 6) {
      const AxesOneByOne<T, W>& axes = n < 3 ? axes1 : axes2;
      const std::array<W, 5> a = axes.axis(n % 3);
      const W inverse = W(1) / axes.norm2;
      return Direction<T>{{T(a[0] * inverse), T(a[1] * inverse), T(a[2] * inverse)}};
    }
    const std::array<W, 5> a = axes1.axis((n - 6) / 3), b = axes2.axis((n - 6) % 3);
    const W inverse = W(1) / (axes1.norm2 * axes2.norm2);
    std::array<T, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = T((a[k + 1] * b[k + 2] - a[k + 2] * b[k + 1]) * inverse);
    const Vec3<T> direction{c[0], c[1], c[2]};
    if (is_accurate_place<T, W>(direction, 12)) return Direction<T>{direction};
  }
  return std::nullopt;
}

/// The penetration of two boxes that overlap least along axis i of box 1, or nullopt. `side`: on which side of box 1
/// box 2 lies along the axis, +1 or -1. The normal points to that side.
///
/// The depth has an error of 16 u (d + h + H2) and 9 u of itself; half of it moves the contact. A scaled axis times a
/// half extent and by its squared length has an error of 12 u of the half extent. So the contact has an error of less
/// than 32 u S, and of 1 u of itself for each of five sums.
template <class T, class W>
std::optional<BoxPenetration<T>> face_penetration(const Box<T>& box1, const Box<T>& box2, std::size_t i, int side,
                                                  double size) {
  const AlongFaceAxis<T, W> along(box1, box2, i);
  const W to_unit = W(side) / along.axis.norm2, half_depth = along.gap * W(-0.5);
  std::array<W, 3> normal, contact = along.center2;
  for (std::size_t l = 0; l < 3; ++l) {
    const W cosine = along.cosine[l] * along.inverse;
    if (!(double(leading_part(abs(cosine))) > 32 * roundoff_of<T, W>)) return std::nullopt;  // two deepest vertices?
    const W step = along.half2[l] * W(cosine < W(0) ? side : -side) / along.axes2[l].norm2;
    for (std::size_t k = 0; k < 3; ++k) contact[(l + k) % 3] = contact[(l + k) % 3] + along.axes2[l].along[k] * step;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    normal[k] = along.axis.along[k] * to_unit;
    contact[k] = contact[k] + normal[k] * half_depth;
  }
  const Vec3<T> place = from_cyclic_order<T>(contact, i);
  if (!(is_accurate_length<T>(along.gap, 16 * size_along_face(box1, box2, i)) &&
        is_accurate_place<T, W>(place, 32 * size)))
    return std::nullopt;
  return BoxPenetration<T>{-T(leading_part(along.gap)), -1, from_cyclic_order<T>(normal, i), place};
}

/// The penetration of two boxes that overlap least along the cross product of axes i and j, or nullopt.
///
/// Let q be the inverse of the sine of the angle between the axes. The middles of the two edges have an error of 13 u S
/// each, the vector d between them one of 26 u S. The products of d with the directions of the edges have an error of
/// 70 u S, the cosine between these one of 21 u. So the ways from the middles to the closest points, the quotients of
/// numbers with errors of 200 u S and of 40 u, have an error of less than 256 u q^2 S, and the contact one of less than
/// 512 u q^2 S. The normal has an error of less than 60 u q, and its largest number is at least 0.57.
template <class T, class W>
std::optional<BoxPenetration<T>> edge_penetration(const Box<T>& box1, const Box<T>& box2, std::size_t i, std::size_t j,
                                                  double size) {
  const AlongCrossAxis<T, W> along(box1, box2, i, j);
  const int side = along.toward < W(0) ? -1 : 1;
  const std::array<T, 3> half1 = components(box1.half), half2 = components(box2.half);
  const W inverse1 = W(1) / along.norm1, inverse2 = W(1) / along.norm2, inverse = inverse1 * inverse2;
  const W sine = along.sine * inverse, depth = -along.gap * inverse1 / along.sine;
  const double q = 1 / double(leading_part(sine)), error = 512 * q * q * size;
  if (!(is_accurate_length<T>(depth, 64 * q * size) && 160 * q <= half_ulp_in<T, W>)) return std::nullopt;
  std::array<W, 3> middle1{}, middle2 = along.between;
  for (std::size_t k = 0; k < 2; ++k) {
    const W c1 = along.in1[k] * inverse, c2 = along.in2[k] * inverse;
    const double least = smaller(double(leading_part(abs(c1))), double(leading_part(abs(c2))));
    if (!(least > 32 * roundoff_of<T, W>)) return std::nullopt;  // two edges reach as far?
    const std::size_t ik = (i + 1 + k) % 3, jk = (j + 1 + k) % 3;
    middle1 = moved(middle1, along.axes1[ik], W(half1[ik]) * W(c1 < W(0) ? -side : side) * inverse1);
    middle2 = moved(middle2, along.axes2[jk], W(half2[jk]) * W(c2 < W(0) ? side : -side) * inverse2);
  }
  const std::array<W, 3> apart = difference(middle2, middle1);
  const W along1 = product(apart, along.axes1[i]) * inverse1, along2 = product(apart, along.axes2[j]) * inverse2;
  const W cosine = product(along.axes1[i], along.axes2[j]) * inverse, per_sine2 = W(1) / (sine * sine);
  const W way1 = (along1 - along2 * cosine) * per_sine2, way2 = (along1 * cosine - along2) * per_sine2;
  const auto is_on_edge = [&](const W& way, T half) {
    return double(leading_part(abs(way))) + error * roundoff_of<T, W> < double(half) * (1 - 0x1p-50);
  };
  if (!(is_on_edge(way1, half1[i]) && is_on_edge(way2, half2[j]))) return std::nullopt;
  const std::array<W, 3> on1 = moved(middle1, along.axes1[i], way1 * inverse1),
                         on2 = moved(middle2, along.axes2[j], way2 * inverse2);
  const std::array<W, 3> center1 = in_cyclic_order<W>(box1.center, 0);
  const W to_unit = W(side) / (along.norm1 * along.sine);
  std::array<W, 3> normal, contact;
  for (std::size_t k = 0; k < 3; ++k) {
    normal[k] = (along.axes1[(i + 1) % 3][k] * along.in1[0] + along.axes1[(i + 2) % 3][k] * along.in1[1]) * to_unit;
    contact[k] = center1[k] + (on1[k] + on2[k]) * W(0.5);
  }
  const Vec3<T> place = from_cyclic_order<T>(contact, 0);
  if (!is_accurate_place<T, W>(place, error)) return std::nullopt;
  return BoxPenetration<T>{T(leading_part(depth)), -1, from_cyclic_order<T>(normal, 0), place};
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
