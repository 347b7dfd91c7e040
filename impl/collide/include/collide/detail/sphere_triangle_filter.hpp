/// Filter of Certified for a moving sphere and a triangle: certain misses, and contacts with the face.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/contact.hpp>
#include <collide/detail/double_word.hpp>
#include <collide/detail/sphere_edge_filter.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// A moving sphere and the plane of a triangle, in W with the unit roundoff u. All places are relative to v0.
///
/// Let t be the vector of the sums of the magnitudes of the two products in each number of the normal n, and |x| the
/// sum of the magnitudes of the numbers of x. As in filtered_contact of a point, n has an error of 4 u t, and its
/// product with a vector one of 8 u of the product of t with the magnitudes of the vector (`bound`).
template <class W>
struct SphereOverPlane {
  Vec3<W> step, edge1, edge2, to, n;
  W radius, approach, height, length2, length;  ///< -n . velocity, n . to, |n|^2, |n|
  Vec3<double> terms;                           ///< t

  template <class T>
  SphereOverPlane(const Sphere<T>& sphere, const Vec3<T>& velocity, const Triangle<T>& triangle)
      : step(in<T>(velocity)),
        edge1(in<T>(triangle.v1) - in<T>(triangle.v0)),
        edge2(in<T>(triangle.v2) - in<T>(triangle.v0)),
        to(in<T>(sphere.center) - in<T>(triangle.v0)),
        radius(sphere.radius) {
    const Vec3<W>&a = edge1, &b = edge2;
    const W yz = a.y * b.z, zy = a.z * b.y, zx = a.z * b.x, xz = a.x * b.z, xy = a.x * b.y, yx = a.y * b.x;
    n = {yz - zy, zx - xz, xy - yx};
    terms = {sum(yz, zy), sum(zx, xz), sum(xy, yx)};
    approach = -Plain::dot(n, step);
    height = Plain::dot(n, to);
    length2 = Plain::dot(n, n);
    length = sqrt(length2);
  }
  double bound(const Vec3<W>& v) const { return terms.x * size(v.x) + terms.y * size(v.y) + terms.z * size(v.z); }

  /// In double, twice the errors of the approach, and of the sum and the difference of the height and the radius times
  /// |n|, if no input is beyond 2^60 and |n|^2 has not underflowed (`has_length`). |n| has an error of 8 u |t|, and the
  /// radius times |n| one of 9 u |t| of the radius. Products that underflow are far smaller than 2^-800.
  double approach_bound() const { return 0x1p-49 * bound(step) + 0x1p-800; }
  double reach_bound() const { return 0x1p-48 * (bound(to) + double(radius) * magnitudes(terms)) + 0x1p-800; }
  bool has_length() const { return length2 >= W(0x1p-800); }

  template <class T>
  static Vec3<W> in(const Vec3<T>& v) {
    return {W(v.x), W(v.y), W(v.z)};
  }
  static double size(const W& x) { return detail::abs(double(leading_part(x))); }
  static double size(const Vec3<W>& v) { return size(v.x) + size(v.y) + size(v.z); }
  static double sum(const W& x, const W& y) { return size(x) + size(y); }
};

/// Whether the sphere certainly moves along n, starts wholly behind the plane, or passes a ball that contains the
/// triangle.
///
/// The ball is around the centroid, with the radius R. No edge is longer than 3 R, so the vector from the centroid has
/// an error of 4 u of itself and of 48 u R, for which the radius is made larger. The bound of a moving point and a ball
/// leaves room for 4 u.
inline bool certainly_misses(const SphereOverPlane<double>& s) {
  constexpr double third = 1.0 / 3;
  if (-s.approach > s.approach_bound()) return true;
  if (s.has_length() && -s.height - s.radius * s.length > s.reach_bound()) return true;
  const Vec3<double> centroid = (s.edge1 + s.edge2) * third, first = s.edge1 - centroid, second = s.edge2 - centroid;
  const double ball2 =
      larger(Plain::dot(centroid, centroid), larger(Plain::dot(first, first), Plain::dot(second, second)));
  return certainly_misses(s.to - centroid, s.step, (s.radius + detail::sqrt(ball2)) * (1 + 0x1p-40));
}

/// The contact of a sphere that certainly starts in front of the plane and touches it first within the face, or
/// nullopt.
///
/// Errors are in units of u, those of the time and the normal relative to them. The approach has one of 8 bound(step),
/// the gap between sphere and plane one of 9 (bound(to) + r |t|). The unit normal has one of 8 k + 5, with k = |t| /
/// |n|. Let E be the larger of |edge1| and |edge2|, and `way` the sum of |to| and of the distance moved. The place of
/// the center at the contact has an error of (time error + 3) way. It enters a weight with E / |n|; n and the products
/// enter it with (4 k + 8) 2 E^2 / |n|, the division with 8 k + 6. The first weight is what the others leave of 1.
template <class T, class W>
std::optional<TriangleImpact<T>> face_impact(const Vec3<T>& center, const SphereOverPlane<W>& s) {
  using S = SphereOverPlane<W>;
  using In = InW<T, W>;
  const W gap = s.height - s.radius * s.length, time = gap / s.approach;
  const Vec3<W> moved = s.step * time, at = s.to + moved;
  const W per_length2 = W(1) / s.length2;
  const W weight1 = Plain::dot(s.n, Plain::cross(at, s.edge2)) * per_length2;
  const W weight2 = Plain::dot(s.n, Plain::cross(s.edge1, at)) * per_length2, weight0 = W(1) - (weight1 + weight2);
  const double approach = In::number(s.approach), n = In::number(s.length), r = In::number(s.radius),
               all = magnitudes(s.terms);
  if (!(approach > 0 && In::number(gap) > 0 && n > 0)) return std::nullopt;
  const double of_time = 8 * s.bound(s.step) / approach + 9 * (s.bound(s.to) + r * all) / In::number(gap) + 3,
               k = all / n;
  const double edge = larger(S::size(s.edge1), S::size(s.edge2)), path = S::size(moved), of_normal = 8 * k + 5;
  const double of_weight =
      2 * (edge / n * ((of_time + 3) * (S::size(s.to) + path) + (4 * k + 8) * 2 * edge) + 8 * k + 6);
  const double least = smaller(In::number(weight0), smaller(In::number(weight1), In::number(weight2)));
  if (!(least > 4 * In::u * of_weight && of_weight <= In::enough / 3 && of_time <= In::enough &&
        of_normal <= In::enough / 2))
    return std::nullopt;
  const Vec3<W> normal = s.n * (W(1) / s.length), place = In::wide(center) + moved - normal * s.radius;
  const TriangleImpact<T> impact{T(leading_part(time)), In::rounded(place), In::rounded(normal),
                                 In::rounded({weight0, weight1, weight2})};
  const double of_place = (of_time + 4) * path + (of_normal + 4) * r + 2 * magnitudes(in_double(center));
  if (of_place <= In::enough * double(largest_magnitude(impact.location))) return impact;
  return std::nullopt;
}

/// The certain impact with the feature on which an estimated contact lies, as its weights tell; or nullopt.
template <class T, class W>
std::optional<TriangleImpact<T>> impact_like(const Vec3<T>& weights, const Sphere<T>& sphere, const Vec3<T>& velocity,
                                             const Triangle<T>& triangle, const SphereOverPlane<W>& s) {
  const std::array<T, 3> weight{weights.x, weights.y, weights.z};
  const std::array<Vec3<T>, 3> corner{triangle.v0, triangle.v1, triangle.v2};
  std::optional<TriangleImpact<T>> impact;
  if (weights.x > T(0) && weights.y > T(0) && weights.z > T(0)) {
    impact = face_impact<T>(sphere.center, s);
  } else {
    for (std::size_t i = 0; i < 3 && !impact; ++i) {
      const std::size_t next = (i + 1) % 3;
      if (weight[i] == T(1)) impact = corner_impact<T, W>(sphere, velocity, corner, i);
      if (weight[i] > T(0) && weight[next] > T(0))
        impact = edge_impact<T, W>(sphere, velocity, corner, i, s.n, magnitudes(s.terms));
    }
  }
  using limits = std::numeric_limits<T>;
  if (impact && impact->time >= limits::min() && impact->time <= limits::max() / 2) return impact;
  return std::nullopt;
}

/// Filter: the certain answer, or nullopt. `estimate` gives an answer without a promise, from which the filter takes
/// the feature.
template <class T, class Estimate>
std::optional<TriangleImpact<T>> filtered_impact(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                 const Triangle<T>& triangle, const Estimate& estimate) {
  using S = SphereOverPlane<double>;
  const S s(sphere, velocity, triangle);
  constexpr double least = 0x1p-60, most = 0x1p60;
  const double all = S::size(s.to) + S::size(s.edge1) + S::size(s.edge2) + S::size(s.step) + s.radius;
  if (!(all <= most)) return std::nullopt;
  if (certainly_misses(s)) return TriangleImpact<T>::miss();
  // The gate is certainly open: the sphere moves against n, and no part of it need be in front of the plane but one.
  if (!(s.approach > s.approach_bound() && s.height + s.radius * s.length > s.reach_bound() && s.length >= least &&
        s.radius >= least && S::size(s.step) >= least))
    return std::nullopt;
  const Vec3<T> weights = estimate().weights;
  if constexpr (std::same_as<T, float>) return impact_like(weights, sphere, velocity, triangle, s);
  if constexpr (std::same_as<T, double>) {  // long double has too few digits
    return impact_like(weights, sphere, velocity, triangle,
                       SphereOverPlane<DoubleWord<double>>(sphere, velocity, triangle));
  }
  return std::nullopt;
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
