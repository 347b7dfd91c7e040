/// A ball that moves past a capsule: shared by the queries about points and spheres.
#pragma once

#include <collide/detail/contact.hpp>
#include <collide/shapes.hpp>

#include <limits>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The first contact of a ball of `radius` at `center`, moving by `velocity` per unit of time, with the solid
/// `capsule`. A ball of radius 0 that starts strictly inside never comes from outside: a miss.
///
/// The center meets the capsule with both radii. It enters the endless tube around the axis between its ends,
/// or the ball around the end on whose side it is in the tube.
template <class Tier, class T>
Impact<T> moving_ball_capsule(const Vec3<T>& center, const T& radius, const Vec3<T>& velocity,
                              const Capsule<T>& capsule) {
  const T reach = radius + capsule.radius;
  const Vec3<T> from_p0 = center - capsule.p0, from_p1 = center - capsule.p1;
  const Vec3<T> between = capsule.p1 - capsule.p0;
  const Vec3<T> axis = unit<Tier>(between);  // zero for a ball
  const T length = Tier::dot(axis, between);
  const T along = Tier::dot(axis, from_p0);
  const Vec3<T> beside = from_p0 - axis * along;
  /// At a point of the axis, with the unit vector from it to the center; 0 where nothing leads there.
  const auto contact_along = [&](const T& time, const Vec3<T>& on_axis, Vec3<T> normal) {
    if (!(Tier::dot(normal, normal) > T(0))) normal = perpendicular_against<Tier>(axis, velocity);
    return contact(time, on_axis + normal * capsule.radius, normal);
  };
  /// At a point of the axis, with `away` from it to the center.
  const auto contact_at = [&](const T& time, const Vec3<T>& on_axis, const Vec3<T>& away) {
    return contact_along(time, on_axis, reach > T(0) ? unit<Tier>(away) : Vec3<T>{});
  };
  /// The same between the ends, where `away` is at a right angle to the axis but for rounding. That is taken out of its
  /// direction, for `away` itself may be a few subnormal numbers; all of it is rounding where more of it leads along
  /// the axis than aside.
  const auto contact_beside = [&](const T& time, const T& at, const Vec3<T>& away) {
    Vec3<T> normal = reach > T(0) ? unit<Tier>(away) : Vec3<T>{};
    if constexpr (MachineNumber<T>) {
      const T rounding = Tier::dot(axis, normal), rounding2 = rounding * rounding;
      normal = normal - axis * rounding;
      if (rounding2 > T(0.5))
        normal = Vec3<T>{};
      else if (rounding2 > std::numeric_limits<T>::epsilon() / T(8))
        normal = unit<Tier>(normal);
    }
    const Vec3<T> on_axis = at + at <= length ? capsule.p0 + axis * at : capsule.p1 - axis * (length - at);
    return contact_along(time, on_axis, normal);
  };

  // Seen from the end itself: beside it, rounding of the length is more than what leads along the axis.
  const bool before = along<T(0), beyond = along> length && !(Tier::dot(axis, from_p1) < T(0));
  const Vec3<T> nearest = before ? from_p0 : beyond ? from_p1 : beside;
  const T apart = Tier::beyond_radius(nearest, reach);
  if (!(apart > T(0))) {
    const bool touches = apart == T(0) && Tier::dot(nearest, velocity) <= T(0);
    const bool overlaps = apart < T(0) && radius > T(0);
    if (!touches && !overlaps) return Impact<T>::miss();
    if (before) return contact_at(T(0), capsule.p0, nearest);
    if (beyond) return contact_at(T(0), capsule.p1, nearest);
    return contact_beside(T(0), along, nearest);
  }

  T at = along;
  if (Tier::beyond_radius(beside, reach) > T(0)) {
    const T speed_along = Tier::dot(axis, velocity);
    const Vec3<T> across = velocity - axis * speed_along;
    const T time = time_to_ball<Tier>(beside, across, reach);
    if (!(time >= T(0))) return Impact<T>::miss();
    at = along + speed_along * time;
    if (at >= T(0) && at <= length) return contact_beside(time, at, beside + across * time);
  }
  const Vec3<T> from_end = at < T(0) ? from_p0 : from_p1;
  const T time = time_to_ball<Tier>(from_end, velocity, reach);
  if (!(time >= T(0))) return Impact<T>::miss();
  return contact_at(time, at < T(0) ? capsule.p0 : capsule.p1, from_end + velocity * time);
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
