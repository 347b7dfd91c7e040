/// Helpers that turn an unlimited motion into one of a known length.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <collide/shapes.hpp>

namespace nearmiss::adapters {

using Vec3d = collide::Vec3<double>;

inline double length(const Vec3d& v) { return std::hypot(v.x, v.y, v.z); }
inline double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline bool finite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A ball that holds the shape.
inline collide::Sphere<double> ball_around(const collide::Sphere<double>& s) { return s; }
inline collide::Sphere<double> ball_around(const collide::Box<double>& b) { return {b.center, length(b.half)}; }
inline collide::Sphere<double> ball_around(const collide::Capsule<double>& c) {
  return {(c.p0 + c.p1) * 0.5, length(c.p1 - c.p0) / 2 + c.radius};
}
inline collide::Sphere<double> ball_around(const collide::AABox<double>& b) {
  return {(b.min + b.max) * 0.5, length(b.max - b.min) / 2};
}
inline collide::Sphere<double> ball_around(const collide::Triangle<double>& t) {
  return {t.v0, std::max(length(t.v1 - t.v0), length(t.v2 - t.v0))};
}

/// What a motion past the shape is measured by: a ball around it, or the plane itself.
template <class S>
auto bound_of(const S& shape) {
  if constexpr (requires { ball_around(shape); }) {
    return ball_around(shape);
  } else {
    return shape;
  }
}

/// The normalized quaternion, rounded, for any length except zero.
inline collide::Quaternion<double> unit(const collide::Quaternion<double>& q) {
  const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)});
  const double scale = std::exp2(-std::floor(std::log2(largest)));  // exact, so that no square overflows
  if (!std::isfinite(scale)) return q;
  const double x = q.x * scale, y = q.y * scale, z = q.z * scale, w = q.w * scale;
  const double n = std::sqrt(x * x + y * y + z * z + w * w);
  return {x / n, y / n, z / n, w / n};
}

inline double power_of_two_above(double x) { return x > 0 ? std::exp2(std::ceil(std::log2(x))) : 0.0; }

/// The least power of two as a time after which the ball is past `target`; 0 where it does not move or starts past it.
inline double time_to_pass(const Vec3d& center, double radius, const Vec3d& velocity,
                           const collide::Sphere<double>& target) {
  const double speed = length(velocity);
  if (!(speed > 0)) return 0;
  const Vec3d along = velocity / speed;
  return power_of_two_above((target.radius + radius - dot(center - target.center, along)) / speed);
}
/// The same for a plane or a half-space: 0 where the ball moves along it or away from it.
template <class S>
  requires requires(const S& s) { s.normal, s.offset; }
double time_to_pass(const Vec3d& center, double radius, const Vec3d& velocity, const S& plane) {
  const double approach = -dot(plane.normal, velocity), reach = radius * length(plane.normal);
  return approach > 0 ? power_of_two_above((dot(plane.normal, center) + plane.offset + reach) / approach) : 0.0;
}

inline constexpr const char* no_end = "the end of the motion is not finite";

/// The path of q.sphere as a capsule: until q.limit or, without a limit, past `target`. Empty where its end is not
/// finite.
template <class Q>
std::optional<collide::Capsule<double>> way_of(const Q& q, const collide::Sphere<double>& target) {
  const auto& [center, radius] = q.sphere;
  const Vec3d end = center + q.velocity * (q.forever ? time_to_pass(center, radius, q.velocity, target) : q.limit);
  if (!finite(end)) return std::nullopt;
  return collide::Capsule<double>{center, end, radius};
}

/// An axis-aligned box by its center and half extents; empty where these are not exact.
inline std::optional<collide::Box<double>> centered(const collide::AABox<double>& b) {
  collide::Box<double> box;
  const auto axis = [](double low, double high, double& center, double& half) {
    const auto exact_sum = [](double x, double y, double& sum) {
      sum = x + y;
      const double y_part = sum - x, x_part = sum - y_part;  // the parts of x and y in the sum
      return x - x_part == 0 && y - y_part == 0;
    };
    return low / 2 * 2 == low && high / 2 * 2 == high && exact_sum(low / 2, high / 2, center) &&
           exact_sum(high / 2, -low / 2, half);
  };
  if (axis(b.min.x, b.max.x, box.center.x, box.half.x) && axis(b.min.y, b.max.y, box.center.y, box.half.y) &&
      axis(b.min.z, b.max.z, box.center.z, box.half.z)) {
    return box;
  }
  return std::nullopt;
}

}  // namespace nearmiss::adapters
