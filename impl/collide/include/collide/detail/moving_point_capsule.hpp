/// The kernel of moving_point_capsule (collide/moving_point_capsule.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/moving_ball_capsule.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Filter: true if a moving point certainly starts inside a capsule, or certainly moves away from every point of its
/// axis, or certainly moves along a line that does not meet the capsule.
///
/// Relative to an end of the axis, the point has an error of 1 u (u = 2^-53); relative to a point of the axis, 2 u of
/// the distances to the ends; its dot product with the velocity, 4 u of the sum of the terms' magnitudes. With d the
/// axis, w = velocity x d has an error of 6 u |velocity| |d|. The dot product of w with the vector from p0 to the point
/// is |w| times the distance of the two lines; its error is 12 u of the product of the three lengths. The term that it
/// is compared with has an error of 12 u (radius + distance) |velocity| |d|. The filter uses a bound of 2^7 u.
inline bool certainly_misses_capsule(const Vec3<double>& point, const Vec3<double>& velocity, const Vec3<double>& p0,
                                     const Vec3<double>& p1, double radius) {
  constexpr double error_bound = 0x1p-46, least = 0x1p-900, most = 0x1p900;
  const Vec3<double> from0 = point - p0, from1 = point - p1, d = p1 - p0;
  const double distance2 = Plain::dot(from0, from0), d2 = Plain::dot(d, d), speed2 = Plain::dot(velocity, velocity);
  const auto in_range = [](double x) { return x >= least && x <= most; };
  if (!(in_range(distance2) && in_range(d2) && in_range(d2 * speed2) && radius <= 0x1p450)) return false;
  const double sizes = detail::sqrt(distance2) + detail::sqrt(d2) + radius;
  const Vec3<double> from_axis = from0 - d * clamped(Plain::dot(from0, d) / d2, 0.0, 1.0);
  if (detail::sqrt(Plain::dot(from_axis, from_axis)) + error_bound * sizes < radius) return true;
  const auto leaves = [&velocity](const Vec3<double>& from) {
    const double x = from.x * velocity.x, y = from.y * velocity.y, z = from.z * velocity.z;
    return x + y + z > error_bound * (detail::abs(x) + detail::abs(y) + detail::abs(z)) + least;
  };
  if (leaves(from0) && leaves(from1)) return true;
  const Vec3<double> w = Plain::cross(velocity, d);
  const double distance = detail::abs(Plain::dot(from0, w));
  return distance - radius * detail::sqrt(Plain::dot(w, w)) > error_bound * sizes * detail::sqrt(d2 * speed2);
}

}  // namespace detail

COLLIDE_COMPILED(moving_point_capsule)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_point_capsule(const Vec3<T>& point, const Vec3<T>& velocity, const Capsule<T>& capsule) {
  if constexpr (uses_filter<Tier, T>) {
    if (detail::certainly_misses_capsule(detail::in_double(point), detail::in_double(velocity),
                                         detail::in_double(capsule.p0), detail::in_double(capsule.p1),
                                         double(capsule.radius))) {
      return Tier::decided_by_filter(Impact<T>::miss());
    }
  }
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_point_capsule, point, velocity, capsule);
  } else {
    return detail::moving_ball_capsule<Tier>(point, T(0), velocity, capsule);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
