/// Functions that the queries about moving points and spheres share: making an impact, choosing a normal where many are
/// valid, and filters that decide.
#pragma once

#include <limits>

#include <collide/answers.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The impact, or a miss if the time is beyond the largest finite number.
template <class T>
inline Impact<T> contact(const T& time, const Vec3<T>& location, const Vec3<T>& normal) {
  if (!(time <= std::numeric_limits<T>::max())) return Impact<T>::miss();
  return {time, location, normal};
}

#if defined(COLLIDE_LANES)
/// Stores an answer that consists of a number and two vectors from registers, which is faster than shuffling lanes into
/// its members.
template <class A>
A answer_from_lanes(Lanes<float> number, Lanes<float> first, Lanes<float> second) {
  static_assert(sizeof(A) == 7 * sizeof(float));
  A answer;
  float* const numbers = reinterpret_cast<float*>(&answer);
  _mm_store_ss(numbers, number.v);
  first.store(numbers + 1);  // and a fourth number, overwritten by the next
  _mm_storel_pi(reinterpret_cast<__m64*>(numbers + 4), second.v);
  _mm_store_ss(numbers + 6, _mm_movehl_ps(second.v, second.v));
  return answer;
}
template <class A>
A answer_from_lanes(TwoDoubles number, Lanes<double> first, Lanes<double> second) {
  static_assert(sizeof(A) == 7 * sizeof(double));
  A answer;
  double* const numbers = reinterpret_cast<double*>(&answer);
  _mm_store_sd(numbers, number.v);
  first.store(numbers + 1);
  _mm_storeu_pd(numbers + 4, second.low.v);
  _mm_store_sd(numbers + 6, second.high.v);
  return answer;
}

/// An impact if the first lane of `hit` is set, else a miss; the other arguments are then ignored. A negative time
/// becomes 0.
template <class P, class L>
auto impact_where(const P& hit, const P& time, const L& location, const L& normal) {
  using T = decltype(time.first());
  const P none = and_not(P::first_lane(std::numeric_limits<T>::infinity()), hit);
  const L hits = broadcast_first(hit);
  return answer_from_lanes<Impact<T>>(larger(none, time), location & hits, normal & hits);
}
#endif

/// A unit vector perpendicular to the unit vector u; any unit vector if u is zero.
template <class Tier, class T>
Vec3<T> perpendicular(const Vec3<T>& u) {
  using detail::abs;
  const T x = abs(u.x), y = abs(u.y), z = abs(u.z);
  Vec3<T> across{T(0), u.z, -u.y};
  if (y < x && y <= z) across = {-u.z, T(0), u.x};
  if (z < x && z < y) across = {u.y, -u.x, T(0)};
  if (!(Tier::dot(across, across) > T(0))) return {T(1), T(0), T(0)};
  return unit<Tier>(across);
}

/// n, or -n if n . velocity > 0.
template <class Tier, class T>
Vec3<T> turned_against(const Vec3<T>& n, const Vec3<T>& velocity) {
  return Tier::dot(n, velocity) > T(0) ? -n : n;
}

/// A unit vector n perpendicular to the unit vector `axis` (any, if that is zero), with n . velocity <= 0.
template <class Tier, class T>
Vec3<T> perpendicular_against(const Vec3<T>& axis, const Vec3<T>& velocity) {
  return turned_against<Tier>(perpendicular<Tier>(axis), velocity);
}

/// The unit vector opposite to the velocity; any unit vector if that is zero.
template <class Tier, class T>
Vec3<T> against(const Vec3<T>& velocity) {
  const Vec3<T> n = unit<Tier>(Vec3<T>{} - velocity);
  return Tier::dot(n, n) > T(0) ? n : Vec3<T>{T(1), T(0), T(0)};
}

template <class Tier, class T>
COLLIDE_COLD Vec3<T> outward_of_any_length(const Vec3<T>& away, const Vec3<T>& velocity) {
  const Vec3<T> n = unit<Tier>(away);
  return Tier::dot(n, n) > T(0) ? n : against<Tier>(velocity);
}
/// `away` as a unit vector; if it is zero, the unit vector opposite to the velocity.
template <class Tier, class T>
inline Vec3<T> outward(const Vec3<T>& away, const Vec3<T>& velocity) {
  using detail::sqrt;
  if constexpr (MachineNumber<T>) {
    if (const T length2 = Tier::dot(away, away); needs_no_scaling(length2)) return away / sqrt(length2);
  }
  return outward_of_any_length<Tier>(away, velocity);
}

/// Where a line of motion is nearest to the center of a ball.
template <class T>
struct ClosestApproach {
  T time;    ///< negative where it lies behind the start
  T chord2;  ///< the square of half the chord in the ball; negative where the line misses it
};

/// `from` is the vector from the center to the point, `closing` is -from . velocity, and `speed2` is |velocity|^2, not
/// 0. Also works in two dimensions, with all vectors in one plane.
///
/// Source: the discriminant computed from the distance between the center and the line of motion (Haines, Guenther,
/// Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, 2019). Near a tangent, the textbook quotient
/// loses the digits that the square of the radius loses. This difference has an error of 1 eps of the distance to the
/// closest approach.
template <class Tier, class T>
ClosestApproach<T> closest_approach(const Vec3<T>& from, const Vec3<T>& velocity, const T& closing, const T& speed2,
                                    const T& radius) {
  const T time = closing / speed2;
  const Vec3<T> offset = from + velocity * time;
  return {time, -Tier::beyond_radius(offset, radius)};
}

/// The time at which a point outside a ball reaches its surface; negative if it never does. `from` is the vector from
/// the center to the point. Also works in two dimensions, with all vectors in one plane.
template <class Tier, class T>
T time_to_ball(const Vec3<T>& from, const Vec3<T>& velocity, const T& radius) {
  using detail::sqrt;
  const T closing = -Tier::dot(from, velocity);
  const T speed2 = Tier::dot(velocity, velocity);
  if (!(closing > T(0) && speed2 > T(0))) return T(-1);
  const auto [nearest, chord2] = closest_approach<Tier>(from, velocity, closing, speed2, radius);
  if (!(chord2 >= T(0))) return T(-1);
  return positive_part(nearest - sqrt(chord2) / sqrt(speed2));
}

/// The time at which a point in a ball, or on its surface, is on the surface for the last time; `speed2` is
/// |velocity|^2, not 0. The other arguments are those of time_to_ball.
template <class Tier, class T>
T time_out_of_ball(const Vec3<T>& from, const Vec3<T>& velocity, const T& speed2, const T& radius) {
  using detail::sqrt;
  const auto [nearest, chord2] = closest_approach<Tier>(from, velocity, T(-Tier::dot(from, velocity)), speed2, radius);
  return positive_part(nearest + sqrt(positive_part(chord2)) / sqrt(speed2));
}

/// A decision by a filter.
struct CertainDecision {
  bool decided = false;
  bool yes = false;
};

/// Filter: whether a ball hits a plane from its front. A point is a ball of radius 0. A hit after the time
/// `latest` is a miss.
///
/// A sum of n products has an error of n u of the sum of their magnitudes (u = 2^-53), the length of the normal 3 u of
/// itself, and each product 2^-1074 if it underflows. The filter uses a bound of 8 u. Where an approach is certain, its
/// error is less than half of it.
inline CertainDecision certain_decision(const Vec3<double>& center, double radius, const Vec3<double>& velocity,
                                        const Plane<double>& plane, double latest) {
  const Vec3<double>& n = plane.normal;
  const auto magnitudes = [&n](const Vec3<double>& v) {
    return detail::abs(n.x * v.x) + detail::abs(n.y * v.y) + detail::abs(n.z * v.z);
  };
  constexpr double error_bound = 0x1p-50, least = 0x1p-1000;
  const double approach = -Plain::dot(n, velocity), of_approach = error_bound * magnitudes(velocity) + least;
  if (-approach > of_approach) return {true, false};
  const double length2 = Plain::dot(n, n), reach = radius * detail::sqrt(length2);
  if (!(length2 >= least)) return {};
  const double height = Plain::dot(n, center) + plane.offset;
  const double of_height = error_bound * (magnitudes(center) + detail::abs(plane.offset) + reach) + least;
  if (-height - reach > of_height) return {true, false};
  const bool hits = approach > of_approach && height + reach > of_height;
  return {hits && (height - reach) + of_height <= latest / 4 * approach, true};
}

/// What is certain about a moving point and a ball, and the terms of the equation of its contact. Without a flag,
/// nothing is certain.
struct BallApproach {
  bool inside = false;                      ///< the point starts inside
  bool misses = false;                      ///< the point starts outside and never reaches the ball
  bool reaches = false;                     ///< the point starts outside and reaches the ball
  double distance2{}, speed2{}, closing{};  ///< |from|^2, |velocity|^2, -from . velocity
  double outside{}, chord2{};               ///< |from|^2 - radius^2, closing^2 - speed2 outside
  double of_chord2{};                       ///< `chord2` has an error of less than 2^6 u of this
};

/// Filter: `from` is the vector from the center of the ball to the point. `from` and `radius` are differences and sums
/// of inputs, each with an error of 1 u (u = 2^-53).
///
/// Without overflow and underflow, the square of a length has an error of 5 u of itself, and `closing` has an error of
/// 5 u of the sum of its terms' magnitudes, which is at most sqrt(distance2 speed2). So each difference below has an
/// error of less than 2^6 u of the terms that it is compared with. The filter uses a bound of 2^11 u.
inline BallApproach certain_approach(const Vec3<double>& from, const Vec3<double>& velocity, double radius) {
  BallApproach a;
  const double x = from.x * velocity.x, y = from.y * velocity.y, z = from.z * velocity.z, radius2 = radius * radius;
  a.closing = -(x + y + z);
  a.distance2 = Plain::dot(from, from), a.speed2 = Plain::dot(velocity, velocity);
  const double scale = (a.distance2 + radius2) * a.speed2;
  constexpr double least = 0x1p-800, most = 0x1p800, error_bound = 0x1p-42;
  if (!(scale >= least && scale <= most && a.distance2 >= least && a.distance2 <= most && a.speed2 >= least &&
        a.speed2 <= most))
    return a;
  a.outside = a.distance2 - radius2;
  a.inside = -a.outside > error_bound * (a.distance2 + radius2);
  const double of_closing = error_bound * (detail::abs(x) + detail::abs(y) + detail::abs(z));
  a.chord2 = a.closing * a.closing - a.outside * a.speed2;
  a.of_chord2 = scale + a.closing * a.closing;
  if (!(a.outside > error_bound * (a.distance2 + radius2))) return a;
  a.misses = -a.closing > of_closing || -a.chord2 > error_bound * a.of_chord2;
  a.reaches = a.closing > of_closing && a.chord2 > error_bound * a.of_chord2;
  return a;
}

/// Filter: true if a moving point is certainly outside a ball and certainly never reaches it.
inline bool certainly_misses(const Vec3<double>& from, const Vec3<double>& velocity, double radius) {
  return certain_approach(from, velocity, radius).misses;
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
