/// The kernel of moving_point_triangle (collide/moving_point_triangle.hpp).
#pragma once

#include <array>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/contact.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

template <class T>
T sum_of_abs(const Vec3<T>& x) {
  using detail::abs;
  return abs(x.x) + abs(x.y) + abs(x.z);
}

/// Whether a point lies on the triangle up to rounding. All vectors are relative to the moving point.
///
/// Such coordinates are at most 2 G, where G is the largest position, so an accepted point lies within 16 eps of 2 G
/// (eps is the unit roundoff). Moving the point accounts for that: 32 of the 48 eps of the contracts.
template <class Tier, MachineNumber T>
bool is_on_triangle(const Vec3<T>& place, const std::array<Vec3<T>, 3>& corner) {
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

/// A time near `time` at which the moving point projects into the triangle along its normal n and lies on it up to
/// rounding; negative if there is none. Corners are relative to the moving point.
template <class Tier, MachineNumber T>
T nearest_time_over_triangle(const T& time, const Vec3<T>& velocity, const Vec3<T>& n,
                             const std::array<Vec3<T>, 3>& corner) {
  using detail::abs;
  const Vec3<T> sideways = Tier::cross(velocity, n);
  const T speed2 = Tier::dot(velocity, velocity);
  std::array<T, 3> side,
      at;  // of each corner: signed distance from the line of motion, and the time of closest approach
  for (int i = 0; i < 3; ++i) side[i] = Tier::dot(sideways, corner[i]), at[i] = Tier::dot(velocity, corner[i]) / speed2;
  T low = std::numeric_limits<T>::infinity(), high = -low;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const bool crosses = (side[i] < T(0) && side[j] > T(0)) || (side[i] > T(0) && side[j] < T(0));
    // A triple product has 7 roundings: a corner so close may lie on the line, whatever its sign.
    const T scale = sum_of_abs(velocity) * sum_of_abs(n) * sum_of_abs(corner[i]);
    const T rounding = T(4) * std::numeric_limits<T>::epsilon() * scale;
    if (abs(side[i]) <= rounding) low = smaller(low, at[i]), high = larger(high, at[i]);
    if (!crosses) continue;
    const T crossing = at[i] + (at[j] - at[i]) * (side[i] / (side[i] - side[j]));
    low = smaller(low, crossing), high = larger(high, crossing);
  }
  if (!(low <= high && high >= T(0))) return T(-1);
  const T nearest = positive_part(clamped(time, low, high));
  return is_on_triangle<Tier>(velocity * nearest, corner) ? nearest : T(-1);
}

/// Checks the time at which the plane of a triangle is hit, after the edge tests passed; negative if their result was
/// rounding error alone.
///
/// For a motion nearly parallel to the plane, `time` is a quotient of two numbers near zero, so it may have any value,
/// and the signs of volumes near zero may be wrong. So the point at `time` must project into the triangle along its
/// normal. If it lies nearly on an edge, or the square of the normal is out of range, a nearby time is searched for.
/// The corners are `a` (relative to the moving point), a + edge1 and a + edge2. The edges are the triangle's own:
/// differences of the corners relative to the point lose the digits of a tiny triangle far away.
template <class Tier, class T>
T time_in_triangle(const T& time, const Vec3<T>& velocity, const Vec3<T>& n, const Vec3<T>& a, const Vec3<T>& edge1,
                   const Vec3<T>& edge2) {
  if constexpr (MachineNumber<T>) {
    using limits = std::numeric_limits<T>;
    const Vec3<T> from_a = velocity * time - a, b = a + edge1, c = a + edge2;
    const T n2 = Tier::dot(n, n);
    const bool lost =
        a == b || b == c || c == a;  // an edge too short for the precision at this distance, or for products
    const bool over = !lost && n2 >= limits::min() / limits::epsilon() && n2 <= limits::max() &&
                      Tier::dot(n, Tier::cross(edge1, from_a)) > T(0) &&
                      Tier::dot(n, Tier::cross(edge2 - edge1, from_a - edge1)) > T(0) &&
                      Tier::dot(n, Tier::cross(from_a, edge2)) > T(0);
    if (!over) return nearest_time_over_triangle<Tier, T>(time, velocity, n, {a, b, c});
  }
  return time;
}

#if defined(COLLIDE_LANES)

/// The rest of moving_point_triangle_in_lanes for a thin triangle, whose normal needs a correction. The edge tests are
/// certain.
template <class T, class Fallback>
COLLIDE_COLD Impact<T> impact_with_thin_triangle(const Vec3<T>& point, const Vec3<T>& velocity,
                                                 const Triangle<T>& triangle, const Fallback& fallback) {
  using limits = std::numeric_limits<T>;
  const Vec3<T> n = normal_of<Plain>(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0);
  const T n2 = Plain::dot(n, n);
  if (!(n2 >= limits::min() / limits::epsilon() && n2 <= limits::max())) return fallback(point, velocity, triangle);
  const T approach = -Plain::dot(n, velocity), behind = Plain::dot(n, triangle.v0 - point);
  if (!(approach > T(0) && behind <= T(0))) return Impact<T>::miss();
  const T time = -behind / approach;
  return contact(time, point + velocity * time, unit<Plain>(n));
}

/// The kernel of `Fast` in lanes. Calls `fallback` where the edge tests are uncertain; with `decides`, where the
/// decision is.
///
/// Let a = v0 - point, f = v0 - v2, n = f x edge1 and q = velocity x a. The signs of q . edge1, q . f and n . velocity
/// - q . edge1 - q . f tell on which side of the three edges the motion passes; each is a signed volume (Moeller,
/// Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997). Two cross products at a time cost as much as one.
///
/// Edge tests. Let e^2 = |edge1|^2 + |f|^2, l^2 = e^2 + |a|^2, and u the unit roundoff. The three volumes have an error
/// of at most 17 u |velocity| l^2. The volumes of an edge in the shared kernel have an error of at most 15 u of
/// |velocity| times the squared distances to the ends of the edge, whichever triangle it belongs to. So if the largest
/// of the three exceeds 64 u |velocity| l^2, the signs are exact, and adjacent triangles agree about their edge,
/// whichever kernel answers for each of them.
///
/// Normal. n has an error of 1.5 u |edge1| |f| <= 0.75 u e^2. Along the longest edge, whose square is at most 2 e^2,
/// moving its ends by 30 u of the largest position (which is at least l / 6) accounts for the error as long as
/// e^4 <= 100 |n|^2. Perpendicular to that edge, the apex moves by no more. The normal of a thinner triangle is
/// corrected.
///
/// Contact. Moving the corners by less than 12 u l along the normal accounts for the products with n and their
/// quotient. That changes the volumes of a hit by less than 24 u |velocity| l^2, so the location stays on the triangle.
///
/// Decision. Where the motion certainly passes inside of all edges, n . velocity is certain too: it is the sum of the
/// three volumes. n . a has an error of 8 u (|edge1|^2 + |f|^2) |a|. The bound is 64 u, as for the edges.
///
/// Overflow makes the edge tests uncertain. A triangle whose normal overflows is treated as thin. The `least` numbers
/// are added to the squares so that the bounds lie far above numbers that underflow.
template <bool decides, class T, class Fallback>
inline Impact<T> moving_point_triangle_in_lanes(const Vec3<T>& point, const Vec3<T>& velocity,
                                                const Triangle<T>& triangle, const Fallback& fallback) {
  using L = Lanes<T>;
  using P = Pair<T>;
  using limits = std::numeric_limits<T>;
  constexpr T u = limits::epsilon() / 2;
  constexpr T least_size2 = std::same_as<T, float> ? T(0x1p-30) : T(0x1p-300), least_speed2 = least_size2 / 4;
  const L from_point = lanes(point), along = lanes(velocity);
  const auto [v0, v1, v2] = corner_lanes(triangle);
  const auto [x, y, z] = columns(v0 - v2, along, v1 - v0, v0 - from_point);
  const P x1 = first_pair(x), y1 = first_pair(y), z1 = first_pair(z);     // lanes: f, velocity
  const P x2 = second_pair(x), y2 = second_pair(y), z2 = second_pair(z);  // lanes: edge1, a
  const P nq_x = y1 * z2 - z1 * y2, nq_y = z1 * x2 - x1 * z2, nq_z = x1 * y2 - y1 * x2;
  const L products = swapped_twice(nq_x) * x + swapped_twice(nq_y) * y + swapped_twice(nq_z) * z;
  const P beside_f = first_pair(products), beside_edge1 = second_pair(products);
  const L squares = x * x + y * y + z * z;
  const P f_and_speed2 = first_pair(squares) + P::two(least_size2, least_speed2), edge1_and_a2 = second_pair(squares);
  const P approach = swapped(beside_f), behind = swapped(beside_edge1);  // lane 0: n . velocity, n . a
  const P time = behind / approach;
  const L location = from_point + along * broadcast_first(time);
  const P outside = larger(larger(beside_f, beside_edge1), approach - (beside_f + beside_edge1));
  const P e2 = f_and_speed2 + edge1_and_a2, l2 = e2 + swapped(edge1_and_a2), e4 = e2 * e2;
  const P hit = larger(outside, behind) <= P::splat(T(0));
  const T bound2 = T(64 * 64) * u * u * (l2 * l2 * swapped(f_and_speed2)).first();
  const P n2 = nq_x * nq_x + nq_y * nq_y + nq_z * nq_z;
  const L normal = first_lanes(nq_x, nq_y, nq_z) / broadcast_first(sqrt(n2));
  if (!(bound2 < (outside * outside).first())) return fallback(point, velocity, triangle);
  if constexpr (decides) {
    const T a2 = swapped(edge1_and_a2).first() + least_size2;
    const T bound_of_behind2 = T(64 * 64) * u * u * (e4.first() * a2);
    const bool is_certain = bound_of_behind2 < (behind * behind).first() && time.first() <= limits::max() / 4;
    if (!(outside.first() > T(0) || is_certain)) return fallback(point, velocity, triangle);
  }
  if (!((hit & e4).first() < T(thinness) * n2.first())) {
    const Impact<T> answer = impact_with_thin_triangle(point, velocity, triangle, fallback);
    return !decides || answer.yes() == ((hit.bits() & 1) != 0) ? answer : fallback(point, velocity, triangle);
  }
  return impact_where(hit, time, location, normal);
}

/// What is certain about a line of motion and a triangle, seen from its front.
struct CertainPassage {
  bool beside = false;  ///< the line passes an edge on its outer side
  bool within = false;  ///< the line passes all edges on their inner side
};

/// The passage of a motion along `along` by the corners a, b and c, which are relative to the moving point.
///
/// Each volume is a triple product, with an error of 16 u of the product of the vectors' |x| + |y| + |z| (u = 2^-53),
/// without underflow. If one is certainly positive, the line of motion passes an edge on its outer side. If all three
/// are certainly negative, it passes through the triangle, from its front.
inline CertainPassage certain_passage(const Lanes<double>& along, const Lanes<double>& a, const Lanes<double>& b,
                                      const Lanes<double>& c) {
  using L = Lanes<double>;
  const L volumes = sums_of_three(along * cross(a, b), along * cross(b, c), along * cross(c, a), along);
  const L sizes = sums_of_three(absolute(a), absolute(b), absolute(c), absolute(along));
  const L products = sizes * yzx(sizes), most = L::splat(0x1p900);  // excludes overflow
  const L bounds = L::splat(0x1p-48) * (products * sizes.template broadcast<3>()) + L::splat(0x1p-900);
  const L in_range = (products <= most) & (bounds <= most);
  return {any_of_three((bounds < volumes) & in_range), all_three((bounds < L::splat(0.0) - volumes) & in_range)};
}

/// Filter: the certain answer, or nullopt.
template <class T>
std::optional<Impact<T>> filtered_impact(const Vec3<T>& point, const Vec3<T>& velocity, const Triangle<T>& triangle) {
  using L = Lanes<double>;
  const L from = wide_lanes(point), a = wide_lanes(triangle.v0) - from, b = wide_lanes(triangle.v1) - from,
          c = wide_lanes(triangle.v2) - from;
  const CertainPassage passage = certain_passage(wide_lanes(velocity), a, b, c);
  if (passage.beside) return Impact<T>::miss();
  if (passage.within) return filtered_contact(point, velocity, triangle);
  return std::nullopt;
}

#endif

}  // namespace detail

COLLIDE_COMPILED(moving_point_triangle)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_point_triangle(const Vec3<T>& point, const Vec3<T>& velocity, const Triangle<T>& triangle) {
  if constexpr (Tier::template lifts<T>) {
    const auto fallback = [](const auto&... inputs) { return COLLIDE_LIFTED(moving_point_triangle, inputs...); };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::moving_point_triangle_in_lanes<false>(point, velocity, triangle, detail::out_of_line(fallback));
    }
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_impact(point, velocity, triangle))
        return Tier::decided_by_filter(*answer);
    }
#endif
    return fallback(point, velocity, triangle);
  } else {
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
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline Impact<T> moving_point_triangle(const Vec3<T>& point, const Vec3<T>& velocity, const Triangle<T>& triangle) {
  const auto asked_of_decisions = [](const auto&... inputs) {
    return kernels::moving_point_triangle<TierOfDecisions<Tier>>(inputs...);
  };
#if defined(COLLIDE_LANES)
  return detail::moving_point_triangle_in_lanes<true>(point, velocity, triangle,
                                                      detail::out_of_line(asked_of_decisions));
#else
  return asked_of_decisions(point, velocity, triangle);
#endif
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
