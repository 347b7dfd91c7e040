/// Edges and faces of flat shapes: the nearest point on one of them, and which of two is nearer. What the
/// queries about triangles and rectangles share.
#pragma once

#include <array>
#include <limits>

#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The point of an edge nearest to a point, seen from both ends of the edge.
template <class T>
struct EdgeFoot {
  Vec3<T> from_start{}, from_end{};
  T share{};  ///< of the way from start to end
  bool at_end = false;

  Vec3<T> on(const Vec3<T>& start, const Vec3<T>& end) const { return at_end ? end : start + from_start; }
};

template <class Tier, class T>
EdgeFoot<T> foot_on_edge(const Vec3<T>& start, const Vec3<T>& end, const Vec3<T>& point) {
  const Vec3<T> along = end - start;
  const T length2 = Tier::dot(along, along);
  if (!(length2 > T(0))) return {};
  const T share = clamped(Tier::dot(point - start, along) / length2, T(0), T(1));
  return {along * share, along * (share - T(1)), share, share >= T(1)};
}

/// |b - w|^2 - |a - w|^2: how much further b is than a, all three seen from the same vertex. Where a and b
/// are near that vertex, as two feet on edges that meet there may be, this keeps what the difference of the
/// two squares would lose.
template <class Tier, class T>
T distance2_excess(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& w) {
  return Tier::dot(b - a, (a - w) + (b - w));
}

template <class T>
bool is_finite(const Vec3<T>& v) {
  using detail::abs;
  constexpr T most = std::numeric_limits<T>::max();
  return abs(v.x) <= most && abs(v.y) <= most && abs(v.z) <= most;
}

/// How much further the foot on the next edge is than the foot on this one: seen from the vertex between them.
template <class Tier, class T>
T next_distance2_excess(const EdgeFoot<T>& foot, const EdgeFoot<T>& next, const Vec3<T>& w) {
  return distance2_excess<Tier>(foot.from_end, next.from_start, w);
}

/// Which edge of the triangle, i from v[i] to v[(i + 1) % 3], is the nearest.
template <class Tier, class T>
int nearest_edge(const std::array<Vec3<T>, 3>& v, const std::array<EdgeFoot<T>, 3>& foot, const Vec3<T>& point) {
  const T excess01 = next_distance2_excess<Tier>(foot[0], foot[1], point - v[1]);
  const T excess12 = next_distance2_excess<Tier>(foot[1], foot[2], point - v[2]);
  const T excess20 = next_distance2_excess<Tier>(foot[2], foot[0], point - v[0]);
  const int nearer = excess01 >= T(0) ? 0 : 1;
  return (nearer == 0 ? excess20 <= T(0) : excess12 >= T(0)) ? nearer : 2;
}

/// Which of the four edges, i from v[i] to v[(i + 1) % 4], is the nearest. Opposite edges have no vertex in
/// common and are compared from the point.
template <class Tier, class T>
int nearest_edge(const std::array<Vec3<T>, 4>& v, const std::array<EdgeFoot<T>, 4>& foot, const Vec3<T>& point) {
  std::array<T, 4> distance2, next_excess;
  for (int i = 0; i < 4; ++i) {
    const Vec3<T> away = (point - v[i]) - foot[i].from_start;
    distance2[i] = Tier::dot(away, away);
    next_excess[i] = next_distance2_excess<Tier>(foot[i], foot[(i + 1) % 4], point - v[(i + 1) % 4]);
  }
  const auto as_near = [&](int edge, int other) {
    return other == (edge + 1) % 4 ? next_excess[edge] >= T(0) : next_excess[other] <= T(0);
  };
  const int even = distance2[0] <= distance2[2] ? 0 : 2, odd = distance2[1] <= distance2[3] ? 1 : 3;
  const bool is_even = as_near(even, odd);
  const int best = is_even ? even : odd, other = ((is_even ? odd : even) + 2) % 4;
  return as_near(best, other) ? best : other;
}

template <class T>
T largest_abs(const Vec3<T>& x) {
  using detail::abs;
  return larger(larger(abs(x.x), abs(x.y)), abs(x.z));
}

/// Where the perpendicular from a point onto the plane of a triangle meets it. The triangle has the corners
/// 0, base and apex; the point w, like both, is seen from the first corner.
template <class T>
struct FaceFoot {
  bool inside = false;  ///< in the triangle; false where it has no area
  T base_share{};       ///< of the nearest point on the line of the base
  Vec3<T> height{};     ///< from that line to the apex
  T base_weight{}, apex_weight{};

  Vec3<T> from_start(const Vec3<T>& base) const { return base * base_share + height * apex_weight; }
  Vec3<T> from_end(const Vec3<T>& base) const { return base * (base_share - T(1)) + height * apex_weight; }
};

/// Source: orthogonalization of base and apex (Gram and Schmidt), and of w before it is measured along the
/// height. So a thin triangle costs no accuracy: the foot is exact for an apex within a few eps of |apex|.
template <class Tier, class T>
FaceFoot<T> foot_on_face(const Vec3<T>& base, const Vec3<T>& apex, const Vec3<T>& w) {
  FaceFoot<T> foot;
  const T base2 = Tier::dot(base, base);
  if (!(base2 > T(0))) return foot;
  const T apex_share = Tier::dot(apex, base) / base2;
  foot.height = apex - base * apex_share;
  const T height2 = Tier::dot(foot.height, foot.height);
  if (!(height2 > T(0))) return foot;
  foot.base_share = Tier::dot(w, base) / base2;
  foot.apex_weight = Tier::dot(w - base * foot.base_share, foot.height) / height2;
  foot.base_weight = foot.base_share - foot.apex_weight * apex_share;
  foot.inside = foot.apex_weight >= T(0) && foot.base_weight >= T(0) && foot.base_weight + foot.apex_weight <= T(1);
  return foot;
}

/// Whether a triangle is so thin that sums of products of its edges do not do, from the squares of n = edge1 x edge2
/// and of these edges. Thin: (edge1^2 + edge2^2)^2 > thinness n^2; moving_point_triangle.hpp derives what the normal of
/// another is good for.
inline constexpr int thinness = 100;
template <MachineNumber T>
bool is_thin(T n2, T edge1_squared, T edge2_squared) {
  const T e2 = edge1_squared + edge2_squared;
  return T(thinness) * n2 < e2 * e2;
}

/// edge1 x edge2, the normal of the triangle with these edges. Of a thin one rounding leaves the product a part along
/// the edges, perhaps as large as itself, which is taken off where they are longest.
template <class Tier, class T>
Vec3<T> normal_of(const Vec3<T>& edge1, const Vec3<T>& edge2) {
  const Vec3<T> n = Tier::cross(edge1, edge2);
  if constexpr (MachineNumber<T>) {
    Vec3<T> longest = edge1;
    T longest2 = Tier::dot(edge1, edge1);
    const T other2 = Tier::dot(edge2, edge2);
    if (T(16) * Tier::dot(n, n) >= longest2 * other2) return n;  // a sine of 1/4: 2 eps of the product are 8 of n
    if (other2 > longest2) longest = edge2, longest2 = other2;
    const Vec3<T> edge3 = edge2 - edge1;
    if (const T third2 = Tier::dot(edge3, edge3); third2 > longest2) longest = edge3, longest2 = third2;
    if (longest2 > T(0)) return n - longest * (Tier::dot(n, longest) / longest2);
  }
  return n;
}

template <class T>
std::array<Vec3<T>, 3> corners(const Triangle<T>& t) {
  return {t.v0, t.v1, t.v2};
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
