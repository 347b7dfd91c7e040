/// The plugin "planted-later": as the plugin "planted", with the mistakes of later.def. fuzz/planted/causes measures
/// how many of their causes are found.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

NEARMISS_MISTAKE(closest_point_segment) {
  const Vector along = q.segment.v1 - q.segment.v0;
  if (dot(along, along) < 1e-10) return {q.segment.v0};
  return right(q);
}
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Vector along = q.triangle.v1 - q.triangle.v0;
  const double t = dot(q.point - q.triangle.v0, along) / dot(along, along);
  if (t < 0) {
    const Vector foot = q.triangle.v0 + along * t;
    if (length(foot - q.point) < length(right(q).point - q.point)) return {foot};
  }
  return right(q);
}
NEARMISS_MISTAKE(closest_point_rectangle) {
  return right(inputs::closest_point_rectangle_perimeter<double>{q.rectangle, q.point});
}
NEARMISS_MISTAKE(closest_points_lines) {
  const Vector u = q.line1.direction, v = q.line2.direction, n = cross(u, v);
  const double a = dot(u, u), c = dot(v, v), determinant = dot(n, n);
  if (determinant == 0 || !(determinant < 1e-8 * a * c)) return right(q);
  const Vector p = q.line1.point;
  return {p, q.line2.point + v * (dot(p - q.line2.point, v) / c)};
}
NEARMISS_MISTAKE(point_in_triangle) {
  const auto a = right(q);
  if (a.yes() && std::min({a.weights.x, a.weights.y, a.weights.z}) == 0) return {};
  return a;
}

NEARMISS_MISTAKE(moving_point_plane) {
  auto a = right(q);
  if (a.yes()) a.normal = q.plane.normal;
  return a;
}
NEARMISS_MISTAKE(moving_point_triangle) {
  const auto a = right(q);
  if (a.yes()) return a;
  constexpr double larger = 1 + 3e-9;
  const Vector middle = (q.triangle.v0 + q.triangle.v1 + q.triangle.v2) * (1. / 3);
  for (Vector* corner : {&q.triangle.v0, &q.triangle.v1, &q.triangle.v2})
    *corner = middle + (*corner - middle) * larger;
  return right(q);
}
NEARMISS_MISTAKE(moving_point_triangle_prepared) {
  if (dot(q.velocity, normal_of(q.triangle)) > -1e-9) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_point_sphere) {
  q.solid = true;
  return right(q);
}
NEARMISS_MISTAKE(moving_point_capsule) {
  const Vector along = q.capsule.p1 - q.capsule.p0;
  if (length(cross(along, q.velocity)) < 1e-8 * length(along) * length(q.velocity)) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_point_box) {
  auto& r = q.box.orientation;
  r.x = -r.x, r.y = -r.y, r.z = -r.z;
  return right(q);
}
NEARMISS_MISTAKE(moving_point_aabox) {
  const auto a = right(q);
  const bool moves = q.velocity.x != 0 || q.velocity.y != 0 || q.velocity.z != 0;
  if (moves && a.yes() && (q.velocity.x == 0 || q.velocity.y == 0 || q.velocity.z == 0)) return a.miss();
  return a;
}
NEARMISS_MISTAKE(ray_aabox) {
  Vector& d = q.ray.direction;
  const Vector given = d;
  for (double* component : {&d.x, &d.y, &d.z}) {
    if (std::abs(*component) < 1e-6) *component = 0;
  }
  if (d.x == 0 && d.y == 0 && d.z == 0) d = given;
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_plane) {
  auto a = right(q);
  if (a.yes()) a.time *= length(q.velocity);
  return a;
}
NEARMISS_MISTAKE(moving_sphere_triangle) {
  auto a = right(q);
  const Vector n = normal_of(q.triangle);
  if (a.yes() && length(cross(n, a.normal)) < 1e-5 * length(n) && dot(n, a.normal) > 0) a.normal = n / length(n);
  return a;
}
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  if (q.velocity.z > 0) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_sphere) {
  const Vector between = q.fixed.center - q.sphere.center;
  const float square = float(dot(between, between));
  if (std::isinf(square)) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_box) {
  auto a = right(q);
  if (!a.yes() || a.time == 0) return a;
  const double longest =
      (length(q.box.center - q.sphere.center) + length(q.box.half) + q.sphere.radius) / length(q.velocity);
  double low = 0, high = longest;
  for (int step = 0; step < 20; ++step) {
    const double middle = (low + high) / 2;
    (middle < a.time ? low : high) = middle;
  }
  a.time = high;
  return a;
}
NEARMISS_MISTAKE(moving_sphere_capsule) {
  if (length(q.capsule.p1 - q.capsule.p0) < 1e-4 * q.capsule.radius) q.capsule.p1 = q.capsule.p0;
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  q.box.half = q.box.half * 0.5;
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  if (q.limit < 1e-3) q.limit = 0;
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_overlap) {
  q.sphere1 = {in_float(q.sphere1.center), in_float(q.sphere1.radius)};
  q.sphere2 = {in_float(q.sphere2.center), in_float(q.sphere2.radius)};
  return right(q);
}
NEARMISS_MISTAKE(sphere_box_overlap) {
  const double r = q.sphere.radius;
  q.sphere.radius = std::sqrt(r * r + 1e-6);
  return {right(inputs::sphere_box_overlap<double>{{q.sphere.center, r}, q.box}).yes() || right(q).yes()};
}
NEARMISS_MISTAKE(box_box_overlap) {
  q.hint = -1;
  const auto a = right(q);
  if (a.axis >= 6) return {true, -1};
  return a;
}
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  const auto& t = q.triangle;
  const double longest = std::max({length(t.v1 - t.v0), length(t.v2 - t.v1), length(t.v0 - t.v2)});
  const double area = length(normal_of(t));
  if (area > 0 && area < 1e-6 * longest * longest) return {};
  return right(q);
}
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  std::swap(q.triangle.v2.y, q.triangle.v2.z);
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto a = right(q);
  if (a.yes()) a.depth = -a.depth;
  return a;
}
NEARMISS_MISTAKE(sphere_plane_penetration) {
  auto a = right(q);
  if (a.yes() && a.depth < 1e-5) return {-a.depth, {}, {}};
  return a;
}
NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  for (auto& corner : a.corners) corner.point = in_float(corner.point);
  return a;
}
NEARMISS_MISTAKE(sphere_box_penetration) {
  const auto a = right(q);
  if (a.depth > q.sphere.radius) return {-a.depth, {}, {}};
  return a;
}

NEARMISS_MISTAKE(bounce_direction) { return {-right(q).direction}; }
NEARMISS_MISTAKE(slide_direction) {
  if (length(q.velocity) < 1e-8) return {};
  return right(q);
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-later"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/later.def"
#include "fuzz/planted/planted_offers.hpp"
