/// When and where a moving point meets a one-sided triangle.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <collide/answers.hpp>
#include <collide/contact.hpp>
#include <collide/contract.hpp>
#include <collide/edges.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

namespace detail {

template <class T>
T sum_of_abs(const Vec3<T>& x) noexcept {
  using std::abs;
  return abs(x.x) + abs(x.y) + abs(x.z);
}

template <class T>
T largest_abs(const Vec3<T>& x) noexcept {
  using std::abs;
  return larger(larger(abs(x.x), abs(x.y)), abs(x.z));
}

/// Whether a place is on the triangle, but for rounding, all seen from the moving point.
///
/// Coordinates seen from there are at most 2 G, G the largest position, so what is let through lies within 16 eps of
/// 2 G (eps the unit roundoff): moving the point explains 32 of the 48 eps that the queries promise.
template <class Tier, MachineNumber T>
bool is_on_triangle(const Vec3<T>& place, const std::array<Vec3<T>, 3>& corner) noexcept {
  T scale = largest_abs(place);
  for (int i = 0; i < 3; ++i) scale = larger(scale, largest_abs(corner[i]));
  const T rounding = T(8) * std::numeric_limits<T>::epsilon() * scale;
  const auto on = [&](const Vec3<T>& foot) { return largest_abs(place - foot) <= rounding; };
  const Vec3<T> base = corner[1] - corner[0];
  const FaceFoot<T> face = foot_on_face<Tier>(base, corner[2] - corner[0], place - corner[0]);
  if (face.inside && on(corner[0] + face.from_start(base))) return true;
  for (int i = 0; i < 3; ++i) {
    if (on(corner[i] + foot_on_edge<Tier>(corner[i], corner[(i + 1) % 3], place).from_start)) return true;
  }
  return false;
}

/// A time near `time` at which the motion is over the triangle, seen along its normal n, and on it but for
/// rounding; negative where it never is. Corners are given as seen from the moving point.
template <class Tier, MachineNumber T>
T nearest_time_over_triangle(const T& time, const Vec3<T>& velocity, const Vec3<T>& n,
                             const std::array<Vec3<T>, 3>& corner) noexcept {
  using std::abs;
  const Vec3<T> sideways = Tier::cross(velocity, n);
  const T speed2 = Tier::dot(velocity, velocity);
  std::array<T, 3> side, at;  // of each corner: how far beside the line of motion, and the time next to it
  for (int i = 0; i < 3; ++i) side[i] = Tier::dot(sideways, corner[i]), at[i] = Tier::dot(velocity, corner[i]) / speed2;
  T low = std::numeric_limits<T>::infinity(), high = -low;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const bool crosses = (side[i] < T(0) && side[j] > T(0)) || (side[i] > T(0) && side[j] < T(0));
    // A product of three carries 7 roundings: a corner so near may lie on the line, whatever its sign.
    const T scale = sum_of_abs(velocity) * sum_of_abs(n) * sum_of_abs(corner[i]);
    const T rounding = T(4) * std::numeric_limits<T>::epsilon() * scale;
    if (abs(side[i]) <= rounding) low = smaller(low, at[i]), high = larger(high, at[i]);
    if (!crosses) continue;
    const T crossing = at[i] + (at[j] - at[i]) * (side[i] / (side[i] - side[j]));
    low = smaller(low, crossing), high = larger(high, crossing);
  }
  if (!(low <= high && high >= T(0))) return T(-1);
  const T nearest = not_negative(clamped(time, low, high));
  return is_on_triangle<Tier>(velocity * nearest, corner) ? nearest : T(-1);
}

/// The time at which the plane of a triangle is hit, once its edges have been passed on their inner sides;
/// negative where that was nothing but rounding.
///
/// Of a motion nearly along the plane, the quotient of two numbers that nearly vanish may be anything, and the
/// signs of volumes that nearly vanish as well. So the place must be over the triangle, seen along its normal;
/// where that is nearly on an edge, or the normal's square leaves the range, it is looked for again.
/// The corners are `a`, seen from the moving point, a + edge1 and a + edge2: the edges are the triangle's own, of
/// which those of a tiny triangle far from the point lose digits.
template <class Tier, class T>
T time_in_triangle(const T& time, const Vec3<T>& velocity, const Vec3<T>& n, const Vec3<T>& a,
                   const Vec3<T>& edge1, const Vec3<T>& edge2) noexcept {
  if constexpr (MachineNumber<T>) {
    using limits = std::numeric_limits<T>;
    const Vec3<T> from_a = velocity * time - a, b = a + edge1, c = a + edge2;
    const T n2 = Tier::dot(n, n);
    const bool lost = a == b || b == c || c == a;  // an edge too short to be seen from there, or to be multiplied
    const bool over = !lost && n2 >= limits::min() / limits::epsilon() && n2 <= limits::max() &&
                      Tier::dot(n, Tier::cross(edge1, from_a)) > T(0) &&
                      Tier::dot(n, Tier::cross(edge2 - edge1, from_a - edge1)) > T(0) &&
                      Tier::dot(n, Tier::cross(from_a, edge2)) > T(0);
    if (!over) return nearest_time_over_triangle<Tier, T>(time, velocity, n, {a, b, c});
  }
  return time;
}

#if defined(COLLIDE_LANES)

/// Whether the line of motion surely passes an edge on its outer side.
///
/// Each volume is a sum of products of three, known to 16 u of the product of the vectors' |x| + |y| + |z|, u = 2^-53,
/// where nothing underflows.
template <class T>
bool surely_passes(const Vec3<T>& point, const Vec3<T>& velocity, const Triangle<T>& triangle) noexcept {
  using L = Lanes<double>;
  const L from = wide_lanes(point), along = wide_lanes(velocity);
  const L a = wide_lanes(triangle.v0) - from, b = wide_lanes(triangle.v1) - from, c = wide_lanes(triangle.v2) - from;
  const L volumes = sums_of_three(along * cross(a, b), along * cross(b, c), along * cross(c, a), along);
  const L sizes = sums_of_three(absolute(a), absolute(b), absolute(c), absolute(along));
  const L products = sizes * yzx(sizes), most = L::all(0x1p900);  // nothing overflows
  const L bounds = L::all(0x1p-48) * (products * sizes.template broadcast<3>()) + L::all(0x1p-900);
  return any_of_three((bounds < volumes) & (products <= most) & (bounds <= most));
}

#endif

}  // namespace detail

/// The first contact of `point`, moving by `velocity` per unit of time, with the front of `triangle`.
///
/// Front is the side to which n = (v1 - v0) x (v2 - v0) points. A hit needs n . velocity < 0, a start
/// on the plane or in front of it, and a plane point inside the closed triangle. A start behind, a
/// motion along the plane, zero velocity and a triangle without area are misses.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == n / |n|
///
/// Two triangles that share an edge decide it with opposite signs of the same number, so no motion
/// passes between them. Source: signed volumes of the tetrahedra that the line of motion forms with
/// the edges (Pluecker coordinates; Ericson, Real-Time Collision Detection, 5.3.4).
template <class Tier = Fast, class T>
Impact<T> moving_point_triangle(const Vec3<T>& point, const Vec3<T>& velocity,
                                const Triangle<T>& triangle) noexcept {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {
    using detail::lanes;
    using L = detail::Lanes<T>;
    using limits = std::numeric_limits<T>;
    const L zero = L::all(T(0)), from_point = lanes(point), along = lanes(velocity);
    const L v0 = lanes(triangle.v0), v1 = lanes(triangle.v1), v2 = lanes(triangle.v2);
    const L a = v0 - from_point, b = v1 - from_point, c = v2 - from_point;
    const L edge1 = v1 - v0, edge2 = v2 - v0, n = cross(edge1, edge2);
    // The volumes beside the edges, none where an edge is too short to be seen, and minus the approach.
    const L volumes = sums_of_three(along * cross(a, b), along * cross(b, c), along * cross(c, a), along * n);
    const L others = sums_of_three(n * a, n * n, edge1 * edge1, edge2 * edge2);
    const L behind = others.template broadcast<0>(), n2 = others.template broadcast<1>();
    const bool hits = ((volumes < zero).bits() & (behind <= zero).bits()) == 15;
    const L hit = L::when(hits);
    const L time = behind / volumes.template broadcast<3>(), way = along * time;
    // What needs no closer look: see normal_of and time_in_triangle.
    const L wide = others.template broadcast<2>() * others.template broadcast<3>() <= L::all(T(16)) * n2;
    const L in_range = (L::all(limits::min() / limits::epsilon()) <= n2) & (n2 <= L::all(limits::max() / T(16)));
    const L beside = cross(n, way - a);
    const L areas = sums_of_three(beside * (zero - edge1), beside * edge2, beside * (edge1 - edge2), zero);
    const L over = zero < areas + (n2 & L::only(2));  // the third side's area is n . n less the others
    const L sure = wide & in_range & without(over | L::when(!hits), volumes == zero);
    if (all_three(sure) || any_of_three(zero < volumes)) {
      return {select(hit, time, L::all(limits::infinity())).first(), first_three((from_point + way) & hit),
              first_three((n / sqrt(n2)) & hit)};
    }
  }
  if constexpr (looks_first<Tier, T>) {
    if (detail::surely_passes(point, velocity, triangle)) return Tier::sure(Impact<T>::miss());
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return moving_point_triangle<decltype(by)>(a...); },
                      point, velocity, triangle);
  }
  const Vec3<T> edge1 = triangle.v1 - triangle.v0, edge2 = triangle.v2 - triangle.v0;
  const Vec3<T> n = detail::normal_of<Tier>(edge1, edge2);
  const T approach = -Tier::dot(n, velocity);
  if (!(approach > T(0))) return Impact<T>::miss();
  const Vec3<T> a = triangle.v0 - point;
  const T behind = Tier::dot(n, a);
  if (!(behind <= T(0))) return Impact<T>::miss();
  const Vec3<T> b = triangle.v1 - point;
  const Vec3<T> c = triangle.v2 - point;
  const bool inside = Tier::dot(velocity, Tier::cross(a, b)) <= T(0) &&
                      Tier::dot(velocity, Tier::cross(b, c)) <= T(0) &&
                      Tier::dot(velocity, Tier::cross(c, a)) <= T(0);
  if (!inside) return Impact<T>::miss();
  const T time = detail::time_in_triangle<Tier>(T(-behind / approach), velocity, n, a, edge1, edge2);
  if (!(time >= T(0))) return Impact<T>::miss();
  return detail::contact(time, point + velocity * time, unit<Tier>(n));
}

namespace inputs {
template <class T>
struct moving_point_triangle {
  Vec3<T> point{};
  Vec3<T> velocity{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_triangle::point, Role::position),
                      member("velocity", &moving_point_triangle::velocity, Role::velocity),
                      member("triangle", &moving_point_triangle::triangle));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::moving_point_triangle<Tier>(point, velocity, triangle);
  }

  /// First order, G the largest position: an edge or a corner seen from the point is a difference of two
  /// positions, known to 2 eps G; each product of a cross product carries 3 eps more of 2 G, the dot
  /// product 3 eps: corners and point move by at most 2 + 2 * 3 + 3 eps of 2 G each, for the plane and
  /// again for the edges; the location adds 2 eps of 2 G. The velocity takes 3 eps of its own.
  static constexpr Contract contract(Fast) {
    return {.backward = 48, .unit = 4, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)};
  }
};
}  // namespace inputs
}  // namespace collide
