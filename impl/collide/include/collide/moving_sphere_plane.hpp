/// When and where a moving sphere meets a one-sided plane.
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
inline Impact<T> moving_sphere_plane_in_lanes(const Sphere<T>& sphere, const Vec3<T>& velocity, const Plane<T>& plane,
                                              const Shared& shared) noexcept {
  using L = Lanes<T>;
  using P = Pair<T>;
  using limits = std::numeric_limits<T>;
  const L center = lanes(sphere), along = lanes(velocity), n = lanes(plane);
  const P zero = P::all(T(0)), radius = P::all(sphere.radius), most = P::all(limits::max());
  const L sums = sums_of_three(n * along, n * center, n * n, n);
  const P approach = zero - first_pair(sums), height = swapped(first_pair(sums)) + P::all(plane.offset);
  const P n2 = second_pair(sums), length = sqrt(n2), reach = radius * length;
  const P starts = height <= reach, time = without((height - reach) / approach, starts);
  const P down = select(starts, height / length, radius);
  const P hit = (zero <= approach) & (zero - reach <= height) & (starts | ((zero < approach) & (time <= most)));
  const L normal = n / every(length);
  const L location = (center + along * every(time)) - normal * every(down);
  const P in_range = (P::all(limits::min() / limits::epsilon()) <= n2) & (n2 <= most) & (reach <= most);
  if (!all_three(are_finite(location & every(hit)) & every(in_range))) return shared(sphere, velocity, plane);
  return impact(hit, time, location, normal);
}

}  // namespace detail

#endif

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the front of `plane`.
///
/// A contact needs normal . velocity <= 0 and a sphere that does not start wholly behind the plane. A sphere
/// that reaches both sides, or touches the plane, is a contact at time 0.
///
/// 1. location is the point of the plane nearest to the center at that time
/// 2. normal == plane.normal / |plane.normal|
///
/// Source: the height of the center above the plane, linear in time.
template <class Tier = Fast, class T>
Impact<T> moving_sphere_plane(const Sphere<T>& sphere, const Vec3<T>& velocity, const Plane<T>& plane) noexcept {
  if constexpr (Tier::template lifts<T>) {
    const auto shared = [](const auto&... inputs) {
      return Tier::lift([](auto by, const auto&... a) { return moving_sphere_plane<decltype(by)>(a...); }, inputs...);
    };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::moving_sphere_plane_in_lanes(sphere, velocity, plane, detail::out_of_line(shared));
    }
#endif
    if constexpr (looks_first<Tier, T>) {
      if (detail::surely_misses(detail::in_double(sphere.center), double(sphere.radius), detail::in_double(velocity),
                                {detail::in_double(plane.normal), double(plane.offset)})) {
        return Tier::sure(Impact<T>::miss());
      }
    }
    return shared(sphere, velocity, plane);
  }
  Vec3<T> normal = plane.normal;
  T length;
  if constexpr (MachineNumber<T>) {
    normal = unit<Tier>(plane.normal), length = Tier::dot(normal, plane.normal);
  } else {  // one root, which need not be kept in range, makes both
    using std::sqrt;
    length = sqrt(Tier::dot(normal, normal));
    if (!(length == T(0))) normal = normal / length;
  }
  const T approach = -Tier::dot(plane.normal, velocity);
  const T height = Tier::dot(plane.normal, sphere.center) + plane.offset;
  const T reach = sphere.radius * length;
  if (!(approach >= T(0) && height >= -reach)) return Impact<T>::miss();
  if (height <= reach) return detail::contact(T(0), sphere.center - normal * (height / length), normal);
  if (!(approach > T(0))) return Impact<T>::miss();
  const T time = (height - reach) / approach;
  return detail::contact(time, (sphere.center + velocity * time) - normal * sphere.radius, normal);
}

namespace contracts {

/// First order: the height is that of a center whose coordinates moved by 4 eps each, over a plane whose
/// offset moved by 1 eps; the reach that of a radius moved by 7 eps, and their difference 1 eps more; the
/// approach that of a velocity moved by 3 eps, 1 eps more for the quotient. The location adds 4 eps of the
/// way and 4 eps of the radius; the way is at most as long as center and contact together. A unit normal
/// carries 4 eps, which turns the plane.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_plane() {
  return Tier::template contract<T>(
      {.backward = 32, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
