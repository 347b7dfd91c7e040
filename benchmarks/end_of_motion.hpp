/// The end of a motion, for the contenders that move from a start to an end.
#pragma once

#include <algorithm>

#include "impl/adapters/motion.hpp"

namespace nearmiss::benchmarks {

using adapters::Vec3d;

/// Past the shape, so that no contact is lost. For a plane that the motion does not approach: after a unit of time.
template <class S>
Vec3d end_of_motion(const Vec3d& start, const Vec3d& velocity, double radius, const S& shape) {
  const collide::Sphere<double> ball = adapters::ball_around(shape);
  const double speed = adapters::length(velocity);
  if (!(speed > 0)) return start;
  const double way = std::max(adapters::dot(ball.center - start, velocity) / speed, 0.0) + ball.radius + radius;
  return start + velocity * (way / speed);
}
template <class S>
  requires requires(const S& s) { s.normal, s.offset; }
Vec3d end_of_motion(const Vec3d& start, const Vec3d& velocity, double radius, const S& plane) {
  const double above = adapters::dot(plane.normal, start) + plane.offset;
  const double closing = -adapters::dot(plane.normal, velocity);
  if (!(above > 0 && closing > 0)) return start + velocity;
  return start + velocity * ((above + radius * adapters::length(plane.normal)) / closing);
}

/// The box as one with a center, which may be rounded.
inline collide::Box<double> boxed(const collide::AABox<double>& b) {
  return {(b.min + b.max) * 0.5, (b.max - b.min) * 0.5, {0, 0, 0, 1}};
}

}  // namespace nearmiss::benchmarks
