/// The kernels of the overlap of a triangle with a segment, a capsule and a triangle: those of every two rounded
/// polytopes (detail/overlaps.hpp), and filters of Fast and Certified that decide most cases in doubles.
///
/// In the derivations u = 2^-53, and |x| is the sum of the magnitudes of the coordinates of x. A sum, a difference and
/// a product have an error of 1 u of themselves.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/detail/double_word.hpp>
#include <collide/detail/overlaps.hpp>
#include <collide/detail/overlaps_of_axes.hpp>
#include <collide/detail/wide_filters.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

template <class A, class T>
  requires(std::same_as<T, float> || std::same_as<T, double>)
inline constexpr bool filter_is_fast<A, Triangle<T>> = true;

/// The sign of a number that has an error of at most `error`: -1 or 1, or 0 if it is in doubt.
constexpr int sign_beyond(double number, double error) { return int(number > error) - int(number < -error); }

/// The plane through three points whose coordinates are at most 2^199, in numbers of W: double, or double-words where
/// the sign is in doubt. The points must live as long.
///
/// Here u is the error of an operation in W. The differences have an error of 1 u, double-words none. So each product
/// of two of them has one of 3 u, and a number of the normal one of 4 u of the magnitudes of its two products, whose
/// sum is `terms`. The product with another difference has an error of 8 u of the product of `terms` with that
/// difference's magnitudes: half of the bound. What products lose by underflow is far below 2^-600.
template <class W>
class PlaneOfPoints {
 public:
  PlaneOfPoints(const Vec3<double>& first, const Vec3<double>& second, const Vec3<double>& third)
      : first_(first), second_(second), third_(third) {
    const Vec3<W> a = difference(second, first), b = difference(third, first);
    const W yz = a.y * b.z, zy = a.z * b.y, zx = a.z * b.x, xz = a.x * b.z, xy = a.x * b.y, yx = a.y * b.x;
    normal_ = {yz - zy, zx - xz, xy - yx};
    terms_ = {size(yz) + size(zy), size(zx) + size(xz), size(xy) + size(yx)};
  }
  /// The side of the plane on which a point is, or 0 if it is in doubt. Seen from side 1, the points are
  /// counterclockwise.
  int side_of(const Vec3<double>& point) const {
    const Vec3<W> to = difference(point, first_);
    const Vec3<double> sizes{size(to.x), size(to.y), size(to.z)};
    const int side = sign_beyond(leading_part(Plain::dot(normal_, to)), 16 * u * Plain::dot(terms_, sizes) + 0x1p-600);
    if constexpr (std::same_as<W, double>) {
      if (side == 0) return side_in_double_words(point);
    }
    return side;
  }

 private:
  static constexpr double u = std::same_as<W, double> ? 0x1p-53 : DoubleWord<double>::epsilon;

  static Vec3<W> difference(const Vec3<double>& to, const Vec3<double>& from) {
    return {W(to.x) - W(from.x), W(to.y) - W(from.y), W(to.z) - W(from.z)};
  }
  static double size(const W& x) { return abs(leading_part(x)); }
  [[gnu::noinline]] int side_in_double_words(const Vec3<double>& point) const {
    return PlaneOfPoints<DoubleWord<double>>(first_, second_, third_).side_of(point);
  }

  const Vec3<double>&first_, &second_, &third_;
  Vec3<W> normal_;
  Vec3<double> terms_;
};

inline std::array<Vec3<double>, 3> corners_in_double(const auto& triangle) {
  return {in_double(triangle.v0), in_double(triangle.v1), in_double(triangle.v2)};
}
/// Whether all coordinates are numbers whose magnitude is at most 2^199.
template <std::size_t n>
bool are_moderate(const std::array<Vec3<double>, n>& points) {
  constexpr double most = 0x1p199;
  bool moderate = true;
  for (const Vec3<double>& p : points)
    moderate = moderate && abs(p.x) <= most && abs(p.y) <= most && abs(p.z) <= most;  // false for NaN
  return moderate;
}
template <std::size_t n, std::size_t m>
bool have_equal_points(const std::array<Vec3<double>, n>& a, const std::array<Vec3<double>, m>& b) {
  bool equal = false;
  for (const Vec3<double>& p : a) {
    for (const Vec3<double>& q : b) equal = equal || p == q;
  }
  return equal;
}

/// Filter: whether segment and triangle meet; nullopt where an end is in the triangle's plane, or the segment meets the
/// line of an edge, unless an end is a corner.
///
/// A segment between both sides of the triangle's plane meets the triangle exactly if its line passes all three edges
/// on the same side. On different sides of two edges, the line misses the triangle, wherever the ends are.
template <class T>
std::optional<bool> filtered_overlap(const Segment<T>& segment, const Triangle<T>& triangle) {
  using Plane = PlaneOfPoints<double>;
  const std::array<Vec3<double>, 3> corner = corners_in_double(triangle);
  const auto& [a, b, c] = corner;
  const std::array<Vec3<double>, 2> ends{in_double(segment.v0), in_double(segment.v1)};
  const auto& [start, end] = ends;
  if (!are_moderate(std::array{a, b, c, start, end})) return std::nullopt;
  const Plane plane(a, b, c);
  const int first = plane.side_of(start), last = plane.side_of(end);
  if (first * last > 0) return false;
  if (first * last == 0 && have_equal_points(ends, corner)) return true;
  const std::array<int, 3> beside{Plane(start, end, a).side_of(b), Plane(start, end, b).side_of(c),
                                  Plane(start, end, c).side_of(a)};
  const bool before = beside[0] < 0 || beside[1] < 0 || beside[2] < 0;
  const bool behind = beside[0] > 0 || beside[1] > 0 || beside[2] > 0;
  if (before && behind) return false;
  if (first * last < 0 && beside[0] * beside[1] * beside[2] != 0) return true;
  return std::nullopt;
}

/// The number of the point that is alone on its side, where none is in doubt; -1 if all are on one side, -2 in doubt.
constexpr int alone_on_its_side(const std::array<int, 3>& sides) {
  const int sum = sides[0] + sides[1] + sides[2];
  if (sum == 3 || sum == -3) return -1;
  if (sides[0] * sides[1] * sides[2] == 0) return -2;
  return sides[0] == -sum ? 0 : sides[1] == -sum ? 1 : 2;
}

/// Filter: whether two triangles meet; nullopt where a vertex is in the plane of the other triangle, or the lines of
/// two edges meet, unless the triangles share a vertex.
///
/// Two triangles that each have vertices on both sides of the other one's plane meet the line of both planes in an
/// interval each. The edges that end in the vertex that is alone on its side bound it. Which bound comes first is the
/// orientation of four vertices.
/// Source: Guigue, Devillers, Fast and Robust Triangle-Triangle Overlap Test Using Orientation Predicates, Journal of
/// Graphics Tools 8, 2003.
template <class T>
std::optional<bool> filtered_overlap(const Triangle<T>& triangle1, const Triangle<T>& triangle2) {
  const std::array<Vec3<double>, 3> a = corners_in_double(triangle1), b = corners_in_double(triangle2);
  if (!are_moderate(std::array{a[0], a[1], a[2], b[0], b[1], b[2]})) return std::nullopt;
  using Plane = PlaneOfPoints<double>;
  const Plane plane_of_b(b[0], b[1], b[2]);
  const std::array<int, 3> of_a{plane_of_b.side_of(a[0]), plane_of_b.side_of(a[1]), plane_of_b.side_of(a[2])};
  const int alone_of_a = alone_on_its_side(of_a);
  if (alone_of_a == -1) return false;
  const Plane plane_of_a(a[0], a[1], a[2]);
  const std::array<int, 3> of_b{plane_of_a.side_of(b[0]), plane_of_a.side_of(b[1]), plane_of_a.side_of(b[2])};
  const int alone_of_b = alone_on_its_side(of_b);
  if (alone_of_b == -1) return false;
  if (alone_of_a < 0 || alone_of_b < 0) return have_equal_points(a, b) ? std::optional(true) : std::nullopt;
  // The vertices from the one that is alone on, counterclockwise seen from where the other triangle's is alone.
  const int on_a = of_b[alone_of_b] > 0 ? 1 : 2, on_b = of_a[alone_of_a] > 0 ? 1 : 2;
  const Vec3<double>&p = a[alone_of_a], &q = a[(alone_of_a + on_a) % 3], &r = a[(alone_of_a + 2 * on_a) % 3];
  const Vec3<double>&s = b[alone_of_b], &t = b[(alone_of_b + on_b) % 3], &w = b[(alone_of_b + 2 * on_b) % 3];
  const int first = Plane(p, q, s).side_of(t), last = Plane(p, r, w).side_of(s);
  if (first > 0 || last > 0) return false;
  if (first < 0 && last < 0) return true;
  return std::nullopt;
}

/// The shortest of the ways from points of an axis to points of a triangle that are considered one after the other, in
/// doubles, relative to the axis's start.
///
/// Each computed parameter is that of a point of the axis, and each two weights are those of a point of the triangle,
/// whatever their errors. So a way has an error as in filtered_overlap of two axes: at most 16 u S.
class WayToTriangle {
 public:
  WayToTriangle(const Axis<double>& axis, const std::array<Vec3<double>, 3>& corners)
      : axis_(axis), v0_(corners[0]), edge1_(corners[1] - v0_), edge2_(corners[2] - v0_) {
    normal_ = Plain::cross(edge1_, edge2_);
    inverse2_ = inverse_or_zero(Plain::dot(normal_, normal_));
    consider_face_from(0);
    consider_face_from(axis.end);
    const double start = -Plain::dot(normal_, v0_), along = Plain::dot(normal_, axis.direction);
    if (start * (start + along * axis.end) < 0) consider_face_from(parameter_within(-start / along, axis.end));
    for (int i = 0; i < 3; ++i) {
      const Axis<double> edge(corners[i], corners[(i + 1) % 3], Vec3<double>{});
      const NearestParameters<double> nearest = nearest_parameters<Plain>(axis, edge);
      consider(edge.at(nearest.second) - axis.at(nearest.first));
    }
  }
  const Vec3<double>& way() const { return way_; }
  double length2() const { return length2_; }

 private:
  void consider_face_from(double parameter) {
    const Vec3<double> point = axis_.at(parameter), from = point - v0_;
    const double weight1 = Plain::dot(Plain::cross(from, edge2_), normal_) * inverse2_;
    const double weight2 = Plain::dot(Plain::cross(edge1_, from), normal_) * inverse2_, rest = 1 - weight1;
    if (weight1 >= 0 && weight2 >= 0 && weight2 <= rest) consider(v0_ + edge1_ * weight1 + edge2_ * weight2 - point);
  }
  void consider(const Vec3<double>& way) {
    const double length2 = Plain::dot(way, way);
    if (length2 < length2_) way_ = way, length2_ = length2;
  }

  const Axis<double>& axis_;
  Vec3<double> v0_, edge1_, edge2_, normal_, way_;
  double inverse2_, length2_ = std::numeric_limits<double>::infinity();
};

/// Filter: whether capsule and triangle meet; nullopt if rounding may change the decision. Errors are those of
/// filtered_overlap of two axes; the sum S has the capsule's end and the three corners, relative to its start.
template <class T>
std::optional<bool> filtered_overlap(const Capsule<T>& capsule, const Triangle<T>& triangle) {
  if (capsule.radius == T(0)) return filtered_overlap(Segment<T>{capsule.p0, capsule.p1}, triangle);
  const Vec3<double> start = in_double(capsule.p0), end = in_double(capsule.p1) - start;
  std::array<Vec3<double>, 3> corners = corners_in_double(triangle);
  double s = extent_of(end);
  for (Vec3<double>& corner : corners) corner = corner - start, s = s + extent_of(corner);
  const double radius = capsule.radius, error = 0x1p-48 * s, slack = 0x1p-49 * radius;
  if (!(s >= 0x1p-200 && s <= 0x1p200 && radius >= 0 && radius <= 0x1p200)) return std::nullopt;
  const Axis<double> axis(Vec3<double>{}, end, Vec3<double>{});
  const WayToTriangle shortest(axis, corners);
  const double sure = radius - slack - error, length2 = shortest.length2();
  if (sure >= 0x1p-300 && length2 <= sure * sure) return true;
  const Vec3<double>& way = shortest.way();
  const double least =
      smaller(smaller(Plain::dot(way, corners[0]), Plain::dot(way, corners[1])), Plain::dot(way, corners[2]));
  const double gap = least - larger(0.0, Plain::dot(way, end));
  if (length2 >= 0x1p-600 && gap > sqrt(length2) * (radius + slack + error)) return false;
  return std::nullopt;
}

}  // namespace detail
}  // namespace collide

#include <collide/detail/strict_end.hpp>
