/// When and where a moving point meets a one-sided plane.
#pragma once

#include <collide/answers.hpp>
#include <collide/contact.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// What `Fast` answers; where the normal's length is extreme or the contact is not finite, what `shared` does.
template <class T, class Shared>
inline Impact<T> moving_point_plane_in_lanes(const Vec3<T>& point, const Vec3<T>& velocity, const Plane<T>& plane,
                                             const Shared& shared) noexcept {
  using L = Lanes<T>;
  using P = Pair<T>;
  using limits = std::numeric_limits<T>;
  const L from = lanes(point), along = lanes(velocity), n = lanes(plane);
  const P zero = P::all(T(0));
  const L sums = sums_of_three(n * along, n * from, n * n, n);
  const P approach = zero - first_pair(sums), height = swapped(first_pair(sums)) + P::all(plane.offset);
  const P n2 = second_pair(sums), time = height / approach;
  const L location = from + along * every(time);
  const P hit = (zero < approach) & (zero <= height) & (time <= P::all(limits::max()));
  const P in_range = (P::all(limits::min() / limits::epsilon()) <= n2) & (n2 <= P::all(limits::max()));
  if (!all_three(are_finite(location & every(hit)) & every(in_range))) return shared(point, velocity, plane);
  return impact(hit, time, location, n / every(sqrt(n2)));
}

}  // namespace detail

#endif

/// The first contact of `point`, moving by `velocity` per unit of time, with the front of `plane`.
///
/// A hit needs normal . velocity < 0 and a start on the plane or in front of it. A start behind, a
/// motion along the plane and zero velocity are misses.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == plane.normal / |plane.normal|
///
/// Source: the plane's equation along the line of motion, linear in time.
template <class Tier = Fast, class T>
Impact<T> moving_point_plane(const Vec3<T>& point, const Vec3<T>& velocity, const Plane<T>& plane) noexcept {
  if constexpr (Tier::template lifts<T>) {
    const auto shared = [](const auto&... inputs) {
      return Tier::lift([](auto by, const auto&... a) { return moving_point_plane<decltype(by)>(a...); }, inputs...);
    };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::moving_point_plane_in_lanes(point, velocity, plane, detail::out_of_line(shared));
    }
#endif
    if constexpr (looks_first<Tier, T>) {
      if (detail::surely_misses(detail::in_double(point), 0.0, detail::in_double(velocity),
                                {detail::in_double(plane.normal), double(plane.offset)})) {
        return Tier::sure(Impact<T>::miss());
      }
    }
    return shared(point, velocity, plane);
  }
  const T approach = -Tier::dot(plane.normal, velocity);
  if (!(approach > T(0))) return Impact<T>::miss();
  const T height = Tier::dot(plane.normal, point) + plane.offset;
  if (!(height >= T(0))) return Impact<T>::miss();
  const T time = height / approach;
  return detail::contact(time, point + velocity * time, unit<Tier>(plane.normal));
}

namespace contracts {

/// First order: the height is that of a point whose coordinates moved by 4 eps each, over a plane whose
/// offset moved by 1 eps; the approach that of a velocity moved by 3 eps, 1 eps more for the quotient. The
/// location adds 2 eps of the way, which is at most as long as point and location together: half of it
/// moves the point, half the velocity. A unit normal carries 4 eps, which turns the plane.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_plane() {
  return Tier::template contract<T>(
      {.backward = 16, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
