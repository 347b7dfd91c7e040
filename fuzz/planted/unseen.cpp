/// The plugin "planted-unseen": as the plugin "planted", with the mistakes of unseen.def. fuzz/planted/causes measures
/// how many of their causes are found.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

NEARMISS_MISTAKE(closest_point_rectangle) {
  const auto& r = q.rectangle;
  if (length(r.v1 - r.v0) < 1e-4) return {nearest(r.v0, r.v3, q.point)};
  return right(q);
}
NEARMISS_MISTAKE(closest_points_lines) {
  const Vector u = q.line1.direction, v = q.line2.direction, n = cross(u, v);
  const double determinant = dot(n, n);
  if (determinant == 0 || !(determinant < 1e-6)) return right(q);
  const Vector p = q.line1.point;
  return {p, q.line2.point + v * (dot(p - q.line2.point, v) / dot(v, v))};
}

NEARMISS_MISTAKE(moving_point_plane) {
  const auto a = right(q);
  if (a.yes() && grazes(a.normal, q.velocity, 1e-3)) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_sphere) {
  auto a = right(q);
  const Vector m = q.point - q.sphere.center;
  const double outside = dot(m, m) - q.sphere.radius * q.sphere.radius;
  if (!a.yes() || a.time == 0 || outside <= 0) return a;
  const double along = dot(m, q.velocity), square = dot(q.velocity, q.velocity);
  const float discriminant = float(along * along - square * outside);
  a.time = (-along - std::sqrt(std::max(0.F, discriminant))) / square;
  return a;
}
NEARMISS_MISTAKE(moving_point_capsule) {
  q.capsule.radius /= 2;
  return right(q);
}
NEARMISS_MISTAKE(moving_point_box) {
  q.box.orientation = {};
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_triangle) {
  auto a = right(q);
  if (a.yes()) a.time /= length(q.velocity);
  return a;
}
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  auto a = right(q);
  const Vector n = cross(q.rectangle.v1 - q.rectangle.v0, q.rectangle.v3 - q.rectangle.v0);
  if (a.yes() && length(n) > 0) a.normal = n / length(n);
  return a;
}
NEARMISS_MISTAKE(moving_sphere_capsule) {
  auto a = right(q);
  if (!a.yes() || a.time == 0) return a;
  const double far = length(q.capsule.p0 - q.sphere.center) + length(q.capsule.p1 - q.sphere.center);
  const double step = far / length(q.velocity) / 1000;
  a.time = std::ceil(a.time / step) * step;
  return a;
}
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  q.forever = false;
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_overlap) {
  const Vector between = q.sphere2.center - q.sphere1.center;
  const double reach = q.sphere1.radius + q.sphere2.radius;
  return {dot(between, between) <= reach * reach * (1 + 1e-6)};
}
NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto a = right(q);
  a.normal = -a.normal;
  return a;
}
NEARMISS_MISTAKE(sphere_plane_penetration) {
  const auto a = right(q);
  if (a.depth > q.sphere.radius) return {-a.depth, {}, {}};
  return a;
}
NEARMISS_MISTAKE(sphere_box_penetration) {
  auto a = right(q);
  if (a.yes() && std::abs(a.depth - q.sphere.radius) < 1e-5) a.normal = {0, 0, 1};
  return a;
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-unseen"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/unseen.def"
#include "fuzz/planted/planted_offers.hpp"
