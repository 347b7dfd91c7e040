/// Closest points on the edges and faces of triangles and rectangles, and comparisons of their distances.
#pragma once

#include <array>
#include <limits>

#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The point of an edge closest to a given point (the foot), relative to both ends of the edge.
template <class T>
struct EdgeFoot {
  Vec3<T> from_start{}, from_end{};
  T share{};  ///< parameter along the edge, 0 at the start, 1 at the end
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

/// The squared distance of b from w minus that of a: |b - w|^2 - |a - w|^2. All three are relative to one vertex. If a
/// and b are near that vertex, as the feet on two edges that meet there may be, this keeps the digits that subtracting
/// the two squares would lose.
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

/// The squared distance of the foot on the next edge minus that of the foot on this edge, measured from their common
/// vertex.
template <class Tier, class T>
T next_distance2_excess(const EdgeFoot<T>& foot, const EdgeFoot<T>& next, const Vec3<T>& w) {
  return distance2_excess<Tier>(foot.from_end, next.from_start, w);
}

/// The index of the closest edge of a triangle; edge i runs from v[i] to v[(i + 1) % 3].
template <class Tier, class T>
int nearest_edge(const std::array<Vec3<T>, 3>& v, const std::array<EdgeFoot<T>, 3>& foot, const Vec3<T>& point) {
  const T excess01 = next_distance2_excess<Tier>(foot[0], foot[1], point - v[1]);
  const T excess12 = next_distance2_excess<Tier>(foot[1], foot[2], point - v[2]);
  const T excess20 = next_distance2_excess<Tier>(foot[2], foot[0], point - v[0]);
  const int nearer = excess01 >= T(0) ? 0 : 1;
  return (nearer == 0 ? excess20 <= T(0) : excess12 >= T(0)) ? nearer : 2;
}

/// The index of the closest edge of a rectangle; edge i runs from v[i] to v[(i + 1) % 4]. Opposite edges have no common
/// vertex, so they are compared by their distances from the point, whose rounding may hide a difference. So the
/// search then goes on along the perimeter, as long as an edge that shares a vertex is nearer.
template <class Tier, class T>
int nearest_edge(const std::array<Vec3<T>, 4>& v, const std::array<EdgeFoot<T>, 4>& foot, const Vec3<T>& point) {
  std::array<T, 4> distance2, next_excess;
  for (int i = 0; i < 4; ++i) {
    const Vec3<T> away = (point - v[i]) - foot[i].from_start;
    distance2[i] = Tier::dot(away, away);
    next_excess[i] = next_distance2_excess<Tier>(foot[i], foot[(i + 1) % 4], point - v[(i + 1) % 4]);
  }
  const int even = distance2[0] <= distance2[2] ? 0 : 2, odd = distance2[1] <= distance2[3] ? 1 : 3;
  const bool odd_is_next = odd == (even + 1) % 4;
  const bool is_even = odd_is_next ? next_excess[even] >= T(0) : next_excess[odd] <= T(0);
  int best = is_even ? even : odd;
  for (int step = 0; step < 2; ++step) {
    const int next = (best + 1) % 4, previous = (best + 3) % 4;
    if (next_excess[best] < T(0)) {
      best = next;
    } else if (next_excess[previous] > T(0)) {
      best = previous;
    } else {
      break;
    }
  }
  return best;
}

template <class T>
T largest_abs(const Vec3<T>& x) {
  using detail::abs;
  return larger(larger(abs(x.x), abs(x.y)), abs(x.z));
}

/// The foot of the perpendicular from the point w to the plane of a triangle with the corners 0, base and apex. All
/// vectors are relative to the first corner.
template <class T>
struct FaceFoot {
  bool inside = false;  ///< the foot lies in the triangle; false if the triangle has no area
  T base_share{};       ///< parameter of the closest point on the line of the base
  Vec3<T> height{};     ///< the vector from that line to the apex
  T base_weight{}, apex_weight{};

  Vec3<T> from_start(const Vec3<T>& base) const { return base * base_share + height * apex_weight; }
  Vec3<T> from_end(const Vec3<T>& base) const { return base * (base_share - T(1)) + height * apex_weight; }
};

/// Source: Gram-Schmidt orthogonalization of base and apex; w is orthogonalized too before it is measured along the
/// height. So a thin triangle costs no accuracy: the foot is exact for an apex that is moved by a few eps of |apex|.
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

/// Whether a triangle is thin: so thin that sums of products of its edges are too inaccurate. The arguments are the
/// squared lengths of n = edge1 x edge2 and of the edges. Thin means (edge1^2 + edge2^2)^2 > thinness n^2;
/// moving_point_triangle.hpp derives the accuracy of the normal of other triangles.
inline constexpr int thinness = 100;
template <MachineNumber T>
bool is_thin(T n2, T edge1_squared, T edge2_squared) {
  const T e2 = edge1_squared + edge2_squared;
  return T(thinness) * n2 < e2 * e2;
}

/// edge1 x edge2, the normal of the triangle with these edges. For a thin triangle, rounding leaves the cross product a
/// component along the edges that may be as large as itself. That component along the longest edge is removed.
template <class Tier, class T>
Vec3<T> normal_of(const Vec3<T>& edge1, const Vec3<T>& edge2) {
  const Vec3<T> n = Tier::cross(edge1, edge2);
  if constexpr (MachineNumber<T>) {
    Vec3<T> longest = edge1;
    T longest2 = Tier::dot(edge1, edge1);
    const T other2 = Tier::dot(edge2, edge2);
    if (T(16) * Tier::dot(n, n) >= longest2 * other2) return n;  // sine >= 1/4: 2 eps of the product are 8 eps of n
    if (other2 > longest2) longest = edge2, longest2 = other2;
    const Vec3<T> edge3 = edge2 - edge1;
    if (const T third2 = Tier::dot(edge3, edge3); third2 > longest2) longest = edge3, longest2 = third2;
    if (longest2 > T(0)) return n - longest * (Tier::dot(n, longest) / longest2);
  }
  return n;
}

/// An edge multiplied by a power of two, without rounding, so that its products do not underflow; a long edge and zero
/// stay as they are. The product of four components is below a sixteenth of the largest number.
template <MachineNumber T>
Vec3<T> magnified(const Vec3<T>& edge) {
  constexpr int target = (std::numeric_limits<T>::max_exponent - 8) / 4;
  const T largest = largest_abs(edge);
  if (!(largest > T(0) && largest < detail::ldexp(T(1), target))) return edge;
  const int up = target - 1 - detail::ilogb(largest);
  return {detail::ldexp(edge.x, up), detail::ldexp(edge.y, up), detail::ldexp(edge.z, up)};
}

/// The direction of n = normal_of(edge1, edge2). If products of the edges may have underflowed, the direction is
/// computed from magnified edges.
template <class Tier, class T>
Vec3<T> unit_normal_of(const Vec3<T>& n, const Vec3<T>& edge1, const Vec3<T>& edge2) {
  if constexpr (MachineNumber<T>) {
    constexpr T least = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
    if (largest_abs(n) < least) return unit<Tier>(normal_of<Tier>(magnified(edge1), magnified(edge2)));
  }
  return unit<Tier>(n);
}

template <class T>
std::array<Vec3<T>, 3> corners(const Triangle<T>& t) {
  return {t.v0, t.v1, t.v2};
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
