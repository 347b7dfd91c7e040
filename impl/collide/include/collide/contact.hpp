/// What the queries about moving things share: when a contact is one, and normals where many are right.
#pragma once

#include <cmath>
#include <limits>

#include <collide/answers.hpp>
#include <collide/tiers.hpp>

namespace collide::detail {

/// The contact; a miss where its time is beyond the largest finite number.
template <class T>
Impact<T> contact(const T& time, const Vec3<T>& location, const Vec3<T>& normal) noexcept {
  if (!(time <= std::numeric_limits<T>::max())) return Impact<T>::miss();
  return {time, location, normal};
}

/// A unit vector at a right angle to the unit vector u; any unit vector where u is zero.
template <class Tier, class T>
Vec3<T> perpendicular(const Vec3<T>& u) noexcept {
  using std::abs;
  const T x = abs(u.x), y = abs(u.y), z = abs(u.z);
  Vec3<T> across{T(0), u.z, -u.y};
  if (y < x && y <= z) across = {-u.z, T(0), u.x};
  if (z < x && z < y) across = {u.y, -u.x, T(0)};
  if (!(Tier::dot(across, across) > T(0))) return {T(1), T(0), T(0)};
  return unit<Tier>(across);
}

/// `away` as a unit vector; where it is zero, a unit vector at a right angle to the unit vector `axis`.
template <class Tier, class T>
Vec3<T> outward(const Vec3<T>& away, const Vec3<T>& axis = {}) noexcept {
  const Vec3<T> n = unit<Tier>(away);
  return Tier::dot(n, n) > T(0) ? n : perpendicular<Tier>(axis);
}

/// The time at which a point outside a ball, `from` away from its center, comes to its surface; negative
/// where it never does. In two dimensions as well: then all vectors lie in one plane.
///
/// Source: the discriminant as the distance of the center from the line of motion (Haines, Guenther,
/// Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, 2019). Near a tangent the quotient
/// of the textbooks loses what the square of the radius loses; this difference loses 1 eps of the way to
/// the closest approach.
template <class Tier, class T>
T time_to_ball(const Vec3<T>& from, const Vec3<T>& velocity, const T& radius) noexcept {
  using std::sqrt;
  const T closing = -Tier::dot(from, velocity);
  const T speed2 = Tier::dot(velocity, velocity);
  if (!(closing > T(0) && speed2 > T(0))) return T(-1);
  const T nearest = closing / speed2;  // time of the closest approach
  const Vec3<T> offset = from + velocity * nearest;
  const T chord2 = -Tier::beyond_radius(offset, radius);
  if (!(chord2 >= T(0))) return T(-1);
  return not_negative(nearest - sqrt(chord2) / sqrt(speed2));
}

/// Whether a moving point is surely outside of a ball and never comes to it; `from` is seen from the center, with numbers
/// that are known to 1 u each (u = 2^-53), and the radius to 2^8 u.
///
/// Of numbers that neither overflow nor underflow each sum of products is known to 8 u of the sum of their magnitudes.
inline bool surely_misses(const Vec3<double>& from, const Vec3<double>& velocity, double radius) noexcept {
  const double x = from.x * velocity.x, y = from.y * velocity.y, z = from.z * velocity.z, along = x + y + z;
  const double distance2 = Plain::dot(from, from), speed2 = Plain::dot(velocity, velocity), radius2 = radius * radius;
  const double scale = (distance2 + radius2) * speed2;
  constexpr double least = 0x1p-800, most = 0x1p800, known = 0x1p-42;
  if (!(scale >= least && scale <= most && distance2 >= least && distance2 <= most && speed2 >= least && speed2 <= most)) return false;
  if (!(distance2 - radius2 > known * (distance2 + radius2))) return false;
  if (along > known * (std::abs(x) + std::abs(y) + std::abs(z))) return true;  // it moves away
  return (distance2 - radius2) * speed2 - along * along > known * (scale + along * along);
}

template <class T>
Vec3<double> in_double(const Vec3<T>& a) noexcept { return {double(a.x), double(a.y), double(a.z)}; }

}  // namespace collide::detail
