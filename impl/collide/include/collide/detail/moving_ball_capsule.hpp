/// The first contact of a moving ball with a capsule: used by the queries about moving points and moving spheres.
#pragma once

#include <collide/detail/contact.hpp>
#include <collide/shapes.hpp>

#include <limits>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The first contact of a ball of `radius` at `center`, moving by `velocity` per unit of time, with the solid
/// `capsule`. A ball of radius 0 that starts strictly inside does not come from outside: a miss.
///
/// The center moves as a point against a capsule with the sum of the radii. It enters that capsule through the infinite
/// cylinder around the axis, between the ends, or through the ball at the end beyond which it enters the cylinder.
template <class Tier, class T>
inline Impact<T> moving_ball_capsule(const Vec3<T>& center, const T& radius, const Vec3<T>& velocity,
                                     const Capsule<T>& capsule) {
  const T reach = radius + capsule.radius;
  const Vec3<T> from_p0 = center - capsule.p0, from_p1 = center - capsule.p1;
  const Vec3<T> between = capsule.p1 - capsule.p0;
  const Vec3<T> axis = unit<Tier>(between);  // zero for a ball
  const T length = Tier::dot(axis, between);
  const T along = Tier::dot(axis, from_p0);
  const Vec3<T> beside = from_p0 - axis * along;
  /// The contact for the point `on_axis` of the axis and the unit vector from there to the center. A zero vector is
  /// replaced by one perpendicular to the axis.
  const auto contact_along = [&](const T& time, const Vec3<T>& on_axis, Vec3<T> normal) {
    if (!(Tier::dot(normal, normal) > T(0))) normal = perpendicular_against<Tier>(axis, velocity);
    return contact(time, on_axis + normal * capsule.radius, normal);
  };
  /// The contact for the point `on_axis` of the axis and the vector `away` from there to the center.
  const auto contact_at = [&](const T& time, const Vec3<T>& on_axis, const Vec3<T>& away) {
    return contact_along(time, on_axis, reach > T(0) ? unit<Tier>(away) : Vec3<T>{});
  };
  /// The contact between the ends, where `away` is perpendicular to the axis up to rounding. The component along the
  /// axis is removed from the unit vector, since `away` itself may be a few subnormal numbers. If that component is
  /// larger than the rest, all of `away` is rounding error.
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

  // Measured from the end itself: near the end, the rounding error of the length exceeds the component along the axis.
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
  if (!(time >= T(0))) {
    // The ball at an end contains the disc where the cylinder ends. In real numbers, a center that enters the cylinder
    // beyond the end, and is within the cylinder anywhere between the ends, meets the ball, and so comes closer to its
    // center. Where it grazes both, rounding may let it pass the ball; then it touches the ball where it is closest to
    // the center.
    if constexpr (MachineNumber<T>) {
      const T closing = -Tier::dot(from_end, velocity);
      const T speed_along = Tier::dot(axis, velocity), end = at < T(0) ? T(0) : length;
      const Vec3<T> across = velocity - axis * speed_along;
      const T to_end = (end - along) / speed_along, to_other_end = (length - end - along) / speed_along;
      T closest = -Tier::dot(beside, across) / Tier::dot(across, across);
      if (!(closest > to_end)) closest = to_end;
      if (closest > to_other_end) closest = to_other_end;
      const bool crosses =
          closing > T(0) && to_end >= T(0) && to_other_end >= to_end && to_other_end <= std::numeric_limits<T>::max();
      if (crosses && !(Tier::beyond_radius(beside + across * closest, reach) > T(0))) {
        const T touching = closing / Tier::dot(velocity, velocity);
        return contact_at(touching, at < T(0) ? capsule.p0 : capsule.p1, from_end + velocity * touching);
      }
    }
    return Impact<T>::miss();
  }
  return contact_at(time, at < T(0) ? capsule.p0 : capsule.p1, from_end + velocity * time);
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
