/// The kernel of moving_sphere_triangle (collide/moving_sphere_triangle.hpp).
#pragma once

#include <bit>
#include <limits>

#include <collide/answers.hpp>
#include <collide/detail/contact.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/lanes.hpp>
#include <collide/detail/sphere_triangle_filter.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// A point of a triangle and the feature on which it lies: 0 is the face, 1 + i the edge from v[i] to v[i + 1], 4 + i
/// the vertex i.
template <class T>
struct TrianglePlace {
  int feature = 0;
  Vec3<T> point{};
  Vec3<T> weights{};
};

/// A moving sphere and a triangle, with the values that both the tests and the contact need.
template <class Tier, class T>
struct SpherePastTriangle {
  Vec3<T> center;
  T radius;
  Vec3<T> velocity;
  std::array<Vec3<T>, 3> v, edge;  ///< corners; edge i runs from v[i] to v[i + 1]
  std::array<Vec3<T>, 3> inward;   ///< n x edge i: points into the triangle
  Vec3<T> n;
  T n_length, height, approach;  ///< n . (center - v[0]), -n . velocity

  SpherePastTriangle(const Sphere<T>& sphere, const Vec3<T>& along, const Triangle<T>& triangle)
      : center(sphere.center), radius(sphere.radius), velocity(along), v{triangle.v0, triangle.v1, triangle.v2} {
    for (int i = 0; i < 3; ++i) edge[i] = v[(i + 1) % 3] - v[i];
    n = normal_of<Tier>(edge[0], -edge[2]);
    n_length = length(components(n));
    height = Tier::dot(n, center - v[0]);
    approach = -Tier::dot(n, velocity);
    for (int i = 0; i < 3; ++i) inward[i] = Tier::cross(n, edge[i]);
  }

  Vec3<T> unit_n() const { return unit_normal_of<Tier>(n, edge[0], -edge[2]); }

  /// True if the sphere does not move along n and does not start wholly behind the plane.
  bool may_hit_front() const {
    if constexpr (MachineNumber<T>) {  // the product may underflow, not its sign
      if (approach == T(0) && n_length > T(0) && Tier::dot(unit_n(), unit<Tier>(velocity)) > T(0)) return false;
    }
    return approach >= T(0) && height >= -(radius * n_length);
  }

  /// n . (edge i x (point - start of the edge)): which side of edge i the point is on, positive inside. The value is
  /// the same from either end of the edge; from the closer end it is more accurate.
  T edge_side(int i, const Vec3<T>& point, bool from_nearer) const {
    const Vec3<T> w = point - v[i];
    if constexpr (MachineNumber<T>) {
      const Vec3<T> other = point - v[(i + 1) % 3];
      if (from_nearer && Tier::dot(other, other) < Tier::dot(w, w)) return Tier::dot(inward[i], other);
    }
    return Tier::dot(inward[i], w);
  }

  /// Whether the foot of a point on the triangle's plane lies in the face. If so, sets the feature and the weights of
  /// `place`: the weights are the signed distances from the edges, over their sum.
  bool in_face(const Vec3<T>& point, TrianglePlace<T>& place, bool from_nearer = false) const {
    if (!(n_length > T(0))) return false;
    const T a = edge_side(1, point, from_nearer), b = edge_side(2, point, from_nearer),
            c = edge_side(0, point, from_nearer);
    if (!(a >= T(0) && b >= T(0) && c >= T(0))) return false;
    const T sum = a + b + c;  // |n|^2
    if (!(sum > T(0))) return false;
    place.feature = 0;
    if constexpr (MachineNumber<T>) {  // a sum with an error as large as itself: only the edges count
      const T n2 = n_length * n_length;
      if (!(sum <= T(2) * n2 && sum >= n2 / T(2))) return false;
      if (is_thin(n2, Tier::dot(edge[0], edge[0]), Tier::dot(edge[2], edge[2]))) {
        const Vec3<T> w = point - v[0];
        const Vec3<T> on_plane = w - n * (Tier::dot(n, w) / n2);
        const FaceFoot<T> foot = foot_on_face<Tier>(edge[0], -edge[2], on_plane);
        const T apex = clamped(foot.apex_weight, T(0), T(1)), base = clamped(foot.base_weight, T(0), T(1) - apex);
        // Far beyond a tip, the side tests of the edges that meet there are rounding error, and so are the weights
        // where the corners lie on a line. The foot counts as on the face only if the point at its weights agrees with
        // it within 32 u (the unit roundoff) of the longest of two edges and the vector to the foot. That is 64 u of
        // the largest position, or of the center's coordinate if the motion took it farther; the error of the velocity
        // is added to that. It is half of the contract.
        const T longest = larger(larger(largest_abs(w), largest_abs(edge[0])), largest_abs(edge[2]));
        const T most = T(16) * std::numeric_limits<T>::epsilon() * longest;
        if (!(largest_abs(edge[0] * base - edge[2] * apex - on_plane) <= most)) return false;
        place.weights = {T(1) - apex - base, base, apex};
        return true;
      }
    }
    place.weights = {a / sum, b / sum, c / sum};
    return true;
  }

  TrianglePlace<T> on_edge(int i, const T& along) const {
    TrianglePlace<T> place{1 + i, v[i] + edge[i] * along, {}};
    const T rest = T(1) - along;
    place.weights = i == 0   ? Vec3<T>{rest, along, T(0)}
                    : i == 1 ? Vec3<T>{T(0), rest, along}
                             : Vec3<T>{along, T(0), rest};
    return place;
  }
  TrianglePlace<T> at_vertex(int i) const {
    return {4 + i, v[i], {i == 0 ? T(1) : T(0), i == 1 ? T(1) : T(0), i == 2 ? T(1) : T(0)}};
  }

  /// Removes rounding error from `to_point`, the vector from an edge to a point, which was computed from w. Its error
  /// is 4 eps of w from the parameter along the edge and 2 eps from the difference. An inward component that is no
  /// larger is rounding error, since the edge would not be closest otherwise; so is a vector that is no longer.
  void remove_rounding(int i, const Vec3<T>& w, const T& edge2, Vec3<T>& to_point) const {
    constexpr T error = T(4) * std::numeric_limits<T>::epsilon();
    const T most2 = error * error * Tier::dot(w, w);
    if (Tier::dot(to_point, to_point) <= most2) to_point = Vec3<T>{};
    if (!(n_length > T(0))) return;
    const Vec3<T> in = inward[i] / n_length;
    const T behind = Tier::dot(to_point, in);
    if (behind > T(0) && behind * behind <= most2 * edge2) to_point = to_point - in * (behind / edge2);
  }

  /// The point of the triangle closest to the center at the start, and `away`, the vector from there to the center.
  TrianglePlace<T> nearest(Vec3<T>& away) const {
    TrianglePlace<T> place;
    if (in_face(center, place, true)) {
      away = n * (height / (n_length * n_length));
      place.point = center - away;
      return place;
    }
    if (!nearest_on_boundary<true>(center, place, away)) nearest_on_boundary<false>(center, place, away);
    if constexpr (MachineNumber<T>) {  // so close that the squares underflow: the center is on the triangle
      constexpr T least = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
      if (Tier::dot(away, away) < least) away = Vec3<T>{};
    }
    return place;
  }

  /// The closest point of the edges and vertices to a point that does not project into the face, and `away`, the vector
  /// from there to the point. `away` is computed from the closest corner, so it is accurate where it is short. With
  /// `by_region`, only features whose Voronoi region contains the point are considered: two distances may differ by
  /// less than their squares show. Returns false if rounding left the point in no region.
  template <bool by_region>
  bool nearest_on_boundary(const Vec3<T>& point, TrianglePlace<T>& best, Vec3<T>& away) const {
    std::array<Vec3<T>, 3> from;
    std::array<T, 3> after_start, before_end;
    for (int i = 0; i < 3; ++i) from[i] = point - v[i];
    for (int i = 0; i < 3; ++i) {
      after_start[i] = Tier::dot(from[i], edge[i]);
      before_end[i] = -Tier::dot(from[(i + 1) % 3], edge[i]);
    }
    T best2 = std::numeric_limits<T>::infinity();
    const auto consider = [&](const TrianglePlace<T>& place, const Vec3<T>& to_point) {
      const T distance2 = Tier::dot(to_point, to_point);
      if (distance2 < best2) best = place, best2 = distance2, away = to_point;
    };
    for (int i = 0; i < 3; ++i) {
      if (!by_region || (after_start[i] <= T(0) && before_end[(i + 2) % 3] <= T(0))) consider(at_vertex(i), from[i]);
      if (!(after_start[i] > T(0) && before_end[i] > T(0))) continue;
      if (by_region && !(edge_side(i, point, true) <= T(0))) continue;
      const T edge2 = Tier::dot(edge[i], edge[i]);
      const bool first_half = after_start[i] < before_end[i];
      const T along = (first_half ? after_start[i] : before_end[i]) / edge2;
      const Vec3<T>& w = first_half ? from[i] : from[(i + 1) % 3];
      Vec3<T> to_point = first_half ? w - edge[i] * along : w + edge[i] * along;
      if constexpr (MachineNumber<T>) remove_rounding(i, w, edge2, to_point);
      consider(on_edge(i, first_half ? along : T(1) - along), to_point);
    }
    return best2 < std::numeric_limits<T>::infinity();
  }

  /// The outward normal at `place`: the direction of `away`, which points to the center. If the center is on the
  /// triangle it is n; if the triangle has no area, it is a unit vector perpendicular to it that does not point along
  /// the velocity.
  Vec3<T> normal_at(const TrianglePlace<T>& place, Vec3<T> away) const {
    if (place.feature == 0) return height < T(0) ? -unit_n() : unit_n();
    if (place.feature < 4) {  // removes the component along the edge that rounding left
      const Vec3<T>& e = edge[place.feature - 1];
      away = away - e * (Tier::dot(away, e) / Tier::dot(e, e));
    }
    const bool apart = radius > T(0) && !(away == Vec3<T>{});
    if (apart) return unit<Tier>(away);
    if (n_length > T(0)) return unit_n();
    return turned_against<Tier>(across_longest_edge(), velocity);
  }
  /// A unit vector perpendicular to a triangle without area.
  Vec3<T> across_longest_edge() const {
    using detail::abs;
    Vec3<T> e = edge[0];
    for (int i = 1; i < 3; ++i) {
      if (Tier::dot(edge[i], edge[i]) > Tier::dot(e, e)) e = edge[i];
    }
    if (e == Vec3<T>{}) return {T(0), T(0), T(1)};
    const bool along_x = abs(e.x) > abs(e.y) && abs(e.x) > abs(e.z);
    return unit<Tier>(Tier::cross(e, along_x ? Vec3<T>{T(0), T(1), T(0)} : Vec3<T>{T(1), T(0), T(0)}));
  }

  TriangleImpact<T> contact(const T& time, const TrianglePlace<T>& place, const Vec3<T>& away) const {
    if (!(time <= std::numeric_limits<T>::max())) return TriangleImpact<T>::miss();
    return {time, place.point, normal_at(place, away), place.weights};
  }

  /// The first time at which a point at w that moves by u comes within the radius of the origin; negative if it does
  /// not approach. The time is 0 if rounding puts the start within the radius. The squares of w, u and the radius are
  /// multiplied by `scale2`. `touches`: it is certain that the point reaches the radius.
  T first_time(const Vec3<T>& w, const Vec3<T>& u, const T& scale2 = T(1),
               [[maybe_unused]] bool touches = false) const {
    using detail::sqrt;
    const T closing = -Tier::dot(w, u);
    if (!(closing > T(0))) return T(-1);
    const T speed2 = Tier::dot(u, u);
    const Vec3<T> moment = Tier::cross(w, u);
    if constexpr (MachineNumber<T>) {
      T chord2 = radius * radius * speed2 - Tier::dot(moment, moment);
      if (touches && chord2 < T(0)) chord2 = T(0);
      if (!(chord2 >= T(0))) return T(-1);
      // Bounded by the time of the least distance, which decides if the approach is rounding error alone.
      return smaller(positive_part(Tier::beyond_radius(w, radius)) / (closing + sqrt(chord2)), closing / speed2);
    } else {
      const T radius2 = radius * radius * scale2;
      const T chord2 = radius2 * speed2 - Tier::dot(moment, moment);
      if (!(chord2 >= T(0))) return T(-1);
      return positive_part(Tier::dot(w, w) - radius2) / (closing + sqrt(chord2));
    }
  }

  /// A sphere that comes within reach of the line of edge i beyond an end, at `time`, and is within reach of the line
  /// anywhere between the ends, meets the vertex at that end. Where it grazes both, rounding may let it pass the
  /// vertex. Returns the time at which the center is closest to that vertex then, and -1 otherwise. `reach` is the
  /// coordinate of the center along the edge's unit direction at `time`; `most` is that of the other end.
  T passed_vertex(int i, const Vec3<T>& along, const T& most, const T& reach, const T& time) const {
    const T forward = Tier::dot(velocity, along);
    const T to_start = time - reach / forward, to_end = to_start + most / forward;
    const T enters = smaller(to_start, to_end), leaves = larger(to_start, to_end);
    if (!(enters >= time && leaves <= std::numeric_limits<T>::max())) return T(-1);
    const Vec3<T> w = center - v[i], beside = Tier::cross(w, along), step = Tier::cross(velocity, along);
    const T closest = clamped(T(-Tier::dot(beside, step) / Tier::dot(step, step)), enters, leaves);
    if (Tier::beyond_radius(beside + step * closest, radius) > T(0)) return T(-1);
    const Vec3<T> from_vertex = reach < T(0) ? w : center - v[(i + 1) % 3];
    return positive_part(T(-Tier::dot(from_vertex, velocity) / Tier::dot(velocity, velocity)));
  }

  bool approaches_face() const { return n_length > T(0) && approach > T(0) && height > T(0); }
  /// The time at which the sphere touches the plane from its front.
  T face_time() const { return positive_part(height - radius * n_length) / approach; }

  /// Near the border of face and edge, rounding may lose a contact in both tests. In that case the sphere is deeper in
  /// the face at `first` than it is apart from the boundary at the time at which it touches the plane. Returns true
  /// then, with the contact at the latter time.
  bool passed_between(const T& first, T& time, TrianglePlace<T>& place, Vec3<T>& away) const {
    if (!approaches_face()) return false;
    const T later = smaller(first, height / approach), left = (height - approach * later) / n_length;
    if (!(left < radius) || !in_face(center + velocity * later, place)) return false;
    time = face_time();
    const Vec3<T> at = center + velocity * time;
    if (!nearest_on_boundary<true>(at, place, away)) nearest_on_boundary<false>(at, place, away);
    return Tier::dot(away, away) - radius * radius < radius * radius - left * left;
  }

  /// The first contact of a sphere that does not overlap the triangle at the start.
  TriangleImpact<T> moving() const {
    TrianglePlace<T> place;
    if (approaches_face()) {
      const T time = face_time();
      const Vec3<T> at = center + velocity * time;
      if (in_face(at, place)) {
        place.point = at - n * (radius / n_length);
        return contact(time, place, n);
      }
    }
    T first = std::numeric_limits<T>::infinity();
    std::array<T, 3> at_vertex_time;
    for (int i = 0; i < 3; ++i) {
      at_vertex_time[i] = first_time(center - v[i], velocity);
      if (at_vertex_time[i] >= T(0) && at_vertex_time[i] < first) first = at_vertex_time[i];
    }
    for (int i = 0; i < 3; ++i) {
      const Vec3<T> w = center - v[i];
      // A unit direction keeps float and double in range. Other number types have no range limit, and skip its square
      // root.
      Vec3<T> along = edge[i];
      T most;
      if constexpr (MachineNumber<T>) {
        along = unit<Tier>(edge[i]);  // accurate even for a subnormal edge, whose length has few digits
        most = Tier::dot(along, edge[i]);
        if (!(most > T(0))) continue;
      } else {
        most = Tier::dot(along, along);
        if (!(most > T(0))) continue;
      }
      // A sphere that hits a corner also hits the lines of its edges, no later: a negative chord is rounding error.
      const bool touches = at_vertex_time[i] >= T(0) || at_vertex_time[(i + 1) % 3] >= T(0);
      const T time = first_time(Tier::cross(w, along), Tier::cross(velocity, along), most, touches);
      if (!(time >= T(0) && time < first)) continue;
      const T reach = Tier::dot(w + velocity * time, along);
      if (reach >= T(0) && reach <= most) {
        first = time;
      } else if constexpr (MachineNumber<T>) {
        const int corner = reach < T(0) ? i : (i + 1) % 3;
        if (at_vertex_time[corner] >= T(0)) continue;
        const T touching = passed_vertex(i, along, most, reach, time);
        if (touching >= T(0) && touching < first) first = touching;
      }
    }
    Vec3<T> away;
    if constexpr (MachineNumber<T>) {
      if (T time; passed_between(first, time, place, away)) return contact(time, place, away);
    }
    if (!(first < std::numeric_limits<T>::infinity())) return TriangleImpact<T>::miss();
    // The closest feature at that time: the times of two features may differ by less than their squares show.
    const Vec3<T> at = center + velocity * first;
    if (!nearest_on_boundary<true>(at, place, away)) nearest_on_boundary<false>(at, place, away);
    return contact(first, place, away);
  }

  TriangleImpact<T> impact() const {
    if (!may_hit_front()) return TriangleImpact<T>::miss();
    const bool in_front = height > radius * n_length;  // the sphere is wholly in front of the plane
    if (in_front && approach == T(0)) return TriangleImpact<T>::miss();
    if (!in_front) {
      Vec3<T> away;
      const TrianglePlace<T> start = nearest(away);
      const T outside = Tier::beyond_radius(away, radius);
      if (outside < T(0)) return contact(T(0), start, away);
      if (outside == T(0)) {
        return Tier::dot(away, velocity) <= T(0) ? contact(T(0), start, away) : TriangleImpact<T>::miss();
      }
      if (!(outside > T(0))) return TriangleImpact<T>::miss();
    }
    return moving();
  }
};

#if defined(COLLIDE_LANES)

/// Stores an impact with its weights from registers.
inline TriangleImpact<float> impact_from_lanes(float time, Lanes<float> location, Lanes<float> normal,
                                               Lanes<float> weights) {
  using A = TriangleImpact<float>;
  static_assert(offsetof(A, normal) == offsetof(A, location) + sizeof(Vec3<float>));
  static_assert(offsetof(A, weights) == offsetof(A, normal) + sizeof(Vec3<float>));
  TriangleImpact<float> answer;
  char* const numbers = reinterpret_cast<char*>(&answer);
  answer.time = time;
  location.store(
      reinterpret_cast<float*>(numbers + offsetof(A, location)));  // and a fourth number, overwritten by the next
  normal.store(reinterpret_cast<float*>(numbers + offsetof(A, normal)));
  _mm_storel_pi(reinterpret_cast<__m64*>(numbers + offsetof(A, weights)), weights.v);
  _mm_store_ss(&answer.weights.z, _mm_movehl_ps(weights.v, weights.v));
  return answer;
}
inline TriangleImpact<double> impact_from_lanes(double time, Lanes<double> location, Lanes<double> normal,
                                                Lanes<double> weights) {
  using A = TriangleImpact<double>;
  static_assert(offsetof(A, normal) == offsetof(A, location) + sizeof(Vec3<double>));
  static_assert(offsetof(A, weights) == offsetof(A, normal) + sizeof(Vec3<double>));
  TriangleImpact<double> answer;
  char* const numbers = reinterpret_cast<char*>(&answer);
  answer.time = time;
  location.store(reinterpret_cast<double*>(numbers + offsetof(A, location)));
  normal.store(reinterpret_cast<double*>(numbers + offsetof(A, normal)));
  _mm_storeu_pd(reinterpret_cast<double*>(numbers + offsetof(A, weights)), weights.low.v);
  _mm_store_sd(&answer.weights.z, weights.high.v);
  return answer;
}

/// The times at which a sphere first touches four features; +infinity: never. The squared distance of a feature minus
/// the squared radius is speed2 t^2 - 2 closing t + outside; `chord2` is closing^2 - speed2 outside.
///
/// A time is bounded by the time of the least distance, which decides if the approach is rounding error alone.
template <class T>
Lanes<T> touching_times(const Lanes<T>& closing, const Lanes<T>& speed2, const Lanes<T>& outside,
                        const Lanes<T>& chord2) {
  using L = Lanes<T>;
  const L zero = L::splat(T(0)), never = L::splat(std::numeric_limits<T>::infinity());
  const L time = smaller(larger(outside, zero) / (closing + sqrt(chord2)), closing / speed2);
  const L at_start = (outside < zero) | ((outside == zero) & (closing == zero));
  return and_not(select((zero < closing) & (zero <= chord2), time, never), at_start);
}

/// A list of numbers for the corners, or the edges, of a polygon with `count` corners in their order: three or four.
template <class T, int count>
struct AroundPolygon {
  using L = Lanes<T>;
  /// The number of the following corner, or the preceding one, in each lane.
  static L next(const L& a) noexcept {
    if constexpr (count == 3) return yzx(a);
    return a.template shuffled<1, 2, 3, 0>();
  }
  static L previous(const L& a) noexcept {
    if constexpr (count == 3) return zxy(a);
    return a.template shuffled<3, 0, 1, 2>();
  }
  static Columns<T> next(const Columns<T>& a) noexcept { return {next(a.x), next(a.y), next(a.z)}; }
  static int bits(const L& mask) noexcept { return mask.bits() & ((1 << count) - 1); }
  static bool all(const L& mask) noexcept { return bits(mask) == (1 << count) - 1; }
  static bool any(const L& mask) noexcept { return bits(mask) != 0; }
  static T smallest(const L& a) noexcept {
    const Pair<T> two = count == 3 ? second_pair(a) : smaller(second_pair(a), swapped(second_pair(a)));
    return smaller(smaller(first_pair(a), swapped(first_pair(a))), two).first();
  }
  static T sum(const L& a) noexcept {
    if constexpr (count == 3) return sum_of_three(a).first();
    return sum_of_four(a).first();
  }
};

/// The corners of a polygon, the first of which also follows the last.
template <class T, int count>
using CornersInLanes = std::array<Lanes<T>, count + 1>;

/// The kernel of `Fast` in lanes for a triangle, or for a parallelogram up to rounding. Calls `fallback` for extreme
/// inputs, and where rounding leaves the closest feature undecided. Lane i holds edge i, from corner i to the next, or
/// corner i. The side of an edge on which the center lies, and its position along the edge, are linear functions of
/// time, so the values of the start serve for all times.
///
/// Rounding errors, with u the unit roundoff. The error of the normal is that of moving_point_triangle: moving corners
/// by 30 u of G, the largest position, accounts for it. Let w be a corner relative to the center at the start, d the
/// displacement to the contact, and w + d the corner relative to the center then. The side of an edge has an error of
/// 5 u of |w + d| and 4 u of |w| and of |d|; |w| and |w + d| are at most 3.5 G: 60 u. Where two edges meet in a sharp
/// tip, both sides may be wrong far beyond the tip; a contact on the face must therefore lie within the bounds of the
/// corners, up to rounding. The time on the face has an error of 7 u of |w| and 3 u of the velocity, the location 3 u
/// of the center and of d. In all 128 u. The vector to the line of an edge, perpendicular to the edge, is as accurate
/// as the velocity's component across the edge, which has an error of 3 u of the whole velocity. For a motion nearly
/// along the edge that is up to 16 times as much of the component; a motion closer to the edge's direction goes to
/// `fallback`. An edge or a corner counts only if the center is beyond it by 7 times the rounding error, so the
/// direction from there to the center is never rounding error alone.
///
/// A parallelogram is one up to 16 u of G, by which its last corner moves; then its two triangles have one plane and
/// one border, and their common edge is not on it.
template <class A, int count, class T, class Fallback>
inline A moving_sphere_polygon_in_lanes(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                        const CornersInLanes<T, count>& v, const Fallback& fallback) {
  using L = Lanes<T>;
  using Around = AroundPolygon<T, count>;
  using limits = std::numeric_limits<T>;
  // `least` and `most` bound lengths: products of eight of them stay in range. `shortest` bounds the squared length of
  // the normal, relative to the squared edges: below it the normal is rounding error.
  constexpr T least = std::same_as<T, float> ? T(0x1p-13) : T(0x1p-120),
              most = std::same_as<T, float> ? T(0x1p15) : T(0x1p120);
  constexpr T shortest = limits::epsilon() * limits::epsilon();
  constexpr T least2 = least * least, most2 = most * most, error_bound = T(64) * limits::epsilon();
  const L center = lanes(sphere), along = lanes(velocity), zero = L::splat(T(0));
  const T radius = sphere.radius, radius2 = radius * radius;
  const auto sums_with = [&](const L& n) {
    return sums_of_three(n * along, n * (center - v[0]), n * n, along * along);
  };
  L n = cross(v[1] - v[0], v[count - 1] - v[0]), sums = sums_with(n);
  const Columns<T> corner = columns(v[0], v[1], v[2], v[3]), edge = Around::next(corner) - corner,
                   from = splat_columns(center) - corner;
  const L edge2 = dot(edge, edge), from2 = dot(from, from);
  if (!Around::all((L::splat(least2) <= edge2) & (edge2 <= L::splat(most2)) & (from2 <= L::splat(most2)))) {
    return fallback();
  }
  const L largest = largest_of_three(
      larger(absolute(center), larger(larger(absolute(v[0]), absolute(v[1])), larger(absolute(v[2]), absolute(v[3])))));
  const T first2 = edge2.first(), last2 = edge2.template broadcast<count - 1>().first();
  const T size2_of_n = second_pair(sums).first();
  bool thin = false;
  if constexpr (count == 3) {
    thin = is_thin(size2_of_n, first2, last2);
    if (thin) {
      n = lanes(out_of_line([](const Vec3<T>& a, const Vec3<T>& b) { return normal_of<Plain>(a, b); })(
          to_vec3(v[1] - v[0]), to_vec3(v[2] - v[0])));
      sums = sums_with(n);
    }
  } else {
    const L open = absolute((v[1] - v[0]) - (v[2] - v[3])), closed = L::splat(T(8) * limits::epsilon()) * largest;
    if (!(all_three(open <= closed) && T(4) * size2_of_n >= first2 * last2)) return fallback();
  }
  const auto [receding, height, n2, speed2] = to_array(sums);
  const T both2 = first2 + last2;
  const bool in_range =
      n2 >= shortest * (both2 * both2) && speed2 >= least2 && speed2 <= most2 && radius >= least && radius <= most;
  if (!in_range) return fallback();
  // A center behind the plane passes if the sphere overlaps the plane, or touches it and does not leave.
  const T height2 = height * height, reach2 = radius2 * n2;
  const bool passes = height >= T(0) || height2 < reach2 || (height2 == reach2 && receding == T(0));
  if (!(receding <= T(0) && passes)) return A::miss();
  const T n_length = detail::sqrt(n2), reach = radius * n_length;
  if (height > reach && receding == T(0)) return A::miss();

  const Columns<T> u = splat_columns(along), inward = cross(splat_columns(n), edge);
  const L beside = dot(inward, from), moves_in = dot(inward, u);
  const T face_time = height > reach ? (reach - height) / receding : T(0);
  if (const L sides = beside + moves_in * L::splat(face_time); Around::all(zero <= sides)) {
    const L at = center + along * L::splat(face_time), location = at - n * L::splat(smaller(height, reach) / n2);
    const L rounding = L::splat(T(16) * limits::epsilon()) * largest;
    const L low = smaller(smaller(v[0], v[1]), smaller(v[2], v[3])) - rounding,
            high = larger(larger(v[0], v[1]), larger(v[2], v[3])) + rounding;
    // Each pair of neighbouring sides of the parallelogram adds |n|^2, as the three of a triangle do.
    const T side_sum = Around::sum(sides), due = T(count - 2) * n2;
    const bool is_sum = due <= T(2) * side_sum && side_sum <= T(2) * due;  // unless it is rounding error
    if (thin || !is_sum || !all_three((low <= location) & (location <= high))) return fallback();
    const L normal = n / L::splat(height < T(0) ? -n_length : n_length);
    if constexpr (count == 3) {
      return impact_from_lanes(face_time, location, normal, yzx(sides) / L::splat(side_sum));
    } else {
      return answer_from_lanes<A>(Pair<T>::splat(face_time), location, normal);
    }
  }

  // The distances from each line are multiplied by the length of its edge.
  const Columns<T> w = cross(from, edge), across = cross(u, edge), line_moment = cross(w, across),
                   moment = cross(from, u);
  const L r2 = L::splat(radius2), u2 = L::splat(speed2), across2 = dot(across, across), line_r2 = r2 * edge2;
  if (Around::any(across2 * L::splat(T(256)) < edge2 * u2)) return fallback();
  const L corner_chord2 = r2 * u2 - dot(moment, moment),
          line_chord2 = line_r2 * across2 - dot(line_moment, line_moment);
  // A sphere that hits a corner also hits the lines of its edges, no later: a negative chord is rounding error.
  const L at_ends = (zero <= corner_chord2) | (zero <= Around::next(corner_chord2));
  const L line_times = touching_times(zero - dot(w, across), across2, dot(w, w) - line_r2,
                                      select(at_ends, larger(line_chord2, zero), line_chord2));
  const L corner_times = touching_times(zero - dot(from, u), u2, from2 - r2, corner_chord2);
  const L along_edge = dot(from, edge), moves_along = dot(u, edge);
  const L reached = along_edge + moves_along * line_times;
  const L on_line = (zero <= reached) & (reached <= edge2);
  const T time = Around::smallest(smaller(corner_times, select(on_line, line_times, corner_times)));
  if (time == limits::infinity()) return A::miss();

  // The closest feature at that time: the times of two features may differ by less than their squares show.
  const T speed = detail::sqrt(speed2), displacement_error = error_bound * speed * time;
  const L passed = L::splat(time), moved_along = moves_along * passed, scale = L::splat(error_bound * n_length);
  const L doubt = scale * (from2 + edge2) + scale * sqrt(edge2) * L::splat(speed * time);
  const L after_start = along_edge + moved_along, after_end = dot(Around::next(from), edge) + moved_along;
  const L at_corner = (after_start <= zero) & (zero <= Around::previous(after_end));
  const L at_edge = (zero < after_start) & (after_end < zero) & (beside + moves_in * passed < zero - doubt);
  const auto features = unsigned(Around::bits(at_corner | at_edge));
  if (!std::has_single_bit(features)) return fallback();
  const int i = std::countr_zero(features);
  const T per_edge2 = to_array((L::splat(T(1)) / edge2) & at_edge)[i],
          share = smaller(to_array(after_start)[i] * per_edge2, T(1));
  const L e = v[i + 1] - v[i], foot = e * L::splat(share), seen = (center + along * passed - v[i]) - foot;
  // Removes the component along the edge that rounding left, which matters if the rest is small.
  const L away = seen - e * (sum_of_three(seen * e) * L::splat(per_edge2)), away2 = sum_of_three(away * away);
  const T away2_least = limits::min() / limits::epsilon() + displacement_error * displacement_error;
  if (!(away2.first() >= away2_least)) return fallback();
  const L location = v[i] + foot, normal = away / sqrt(away2);
  if constexpr (count == 3) {
    static constexpr std::array<std::array<T, 4>, 4> unit{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}}};
    const auto unit_at = [](int k) { return L::load(reinterpret_cast<const char*>(&unit[k])); };
    return impact_from_lanes(time, location, normal,
                             unit_at(i) * L::splat(T(1) - share) + unit_at(i + 1) * L::splat(share));
  } else {
    return answer_from_lanes<A>(Pair<T>::splat(time), location, normal);
  }
}

#endif

}  // namespace detail

COLLIDE_COMPILED(moving_sphere_triangle)

namespace kernels {

template <class Tier, class T>
inline TriangleImpact<T> moving_sphere_triangle(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                const Triangle<T>& triangle) {
  if constexpr (Tier::template lifts<T>) {
    const auto fallback = [](const auto&... inputs) { return COLLIDE_LIFTED(moving_sphere_triangle, inputs...); };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      const auto [v0, v1, v2] = detail::corner_lanes(triangle);
      return detail::moving_sphere_polygon_in_lanes<TriangleImpact<T>, 3>(
          sphere, velocity, detail::CornersInLanes<T, 3>{v0, v1, v2, v0},
          [&]() COLLIDE_COLD { return fallback(sphere, velocity, triangle); });
    }
#endif
    if constexpr (uses_filter<Tier, T>) {
      const auto estimate = [&] { return kernels::moving_sphere_triangle<Fast>(sphere, velocity, triangle); };
      if (const auto answer = detail::filtered_impact(sphere, velocity, triangle, estimate))
        return Tier::decided_by_filter(*answer);
    }
    return fallback(sphere, velocity, triangle);
  } else {
    return detail::SpherePastTriangle<Tier, T>(sphere, velocity, triangle).impact();
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
