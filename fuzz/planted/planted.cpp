/// The plugin "planted": `collide` in the tier Accurate and in double, with one planted mistake for each query. It
/// keeps the contract of that tier except for the mistake. fuzz/feedback-gain measures how soon fuzz targets find the
/// mistakes. planted.def is the table of the mistakes.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

NEARMISS_MISTAKE(closest_point_segment) {
  if (length(q.segment.v1 - q.segment.v0) < 1e-6 * length(q.point - q.segment.v0)) return {q.segment.v0};
  return right(q);
}
NEARMISS_MISTAKE(closest_point_segment_unit) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double t = dot(q.point - q.segment.v0, along) / dot(along, along);
  if (t > 1) return {q.segment.v0 + along * t};
  return right(q);
}
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Vector a = nearest(q.triangle.v0, q.triangle.v1, q.point), b = nearest(q.triangle.v1, q.triangle.v2, q.point);
  return {length(a - q.point) < length(b - q.point) ? a : b};
}
NEARMISS_MISTAKE(closest_point_triangle_perimeter_edges) {
  auto a = right(q);
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  const double least = length(a.point - q.point);
  for (int edge = a.edge + 1; edge < 3; ++edge) {
    const Vector other = nearest(corners[edge], corners[edge + 1], q.point);
    if (length(other - q.point) <= least * (1 + 1e-11)) a = {other, edge};
  }
  return a;
}
NEARMISS_MISTAKE(closest_point_rectangle) {
  const auto a = right(q);
  if (length(a.point - q.point) < 1e-8) return {q.point};
  return a;
}
NEARMISS_MISTAKE(closest_point_rectangle_perimeter) {
  const auto a = right(q);
  const Vector other = nearest(q.rectangle.v0, q.rectangle.v2, q.point);
  if (length(other - q.point) < length(a.point - q.point)) return {other};
  return a;
}
NEARMISS_MISTAKE(closest_points_lines) {
  const Vector d1 = q.line1.direction, d2 = q.line2.direction, n = cross(d1, d2);
  const double sine = length(n) / (length(d1) * length(d2));
  if (sine == 0 || !(sine < 1e-5)) return right(q);
  const Vector p = q.line1.point;
  return {p, q.line2.point + d2 * (dot(p - q.line2.point, d2) / dot(d2, d2))};
}

NEARMISS_MISTAKE(point_in_triangle) {
  const auto a = right(q);
  if (std::min({a.weights.x, a.weights.y, a.weights.z}) < 1e-12) return {};
  return a;
}
NEARMISS_MISTAKE(point_in_rectangle) {
  q.rectangle.v3 = q.rectangle.v2;
  return right(q);
}

NEARMISS_MISTAKE(moving_point_plane) {
  const auto a = right(q);
  if (a.yes() && grazes(a.normal, q.velocity, 1e-6)) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_triangle) {
  if (std::abs(dot(q.velocity, normal_of(q.triangle))) < 1e-12) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_point_triangle_prepared) {
  q.triangle.v1 = q.triangle.v1 * 2. - q.triangle.v2;
  return right(q);
}
NEARMISS_MISTAKE(moving_point_rectangle) {
  const auto a = right(q);
  const Vector v0 = q.rectangle.v0, v2 = q.rectangle.v2;
  if (a.yes() && length(nearest(v0, v2, a.location) - a.location) < 1e-9 * length(v2 - v0)) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_sphere) {
  const auto a = right(q);
  if (a.yes() && a.time > 0 && grazes(a.normal, q.velocity, 1e-6)) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_capsule) {
  const auto a = right(q);
  const Vector along = q.capsule.p1 - q.capsule.p0;
  const double beyond = dot(a.location - q.capsule.p1, along) / dot(along, along);
  if (a.yes() && a.time > 0 && std::abs(beyond) < 1e-10) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_box) {
  auto a = right(q);
  if (a.yes() && a.time * length(q.velocity) < 1e-8) a.time = 0, a.location = q.point;
  return a;
}
NEARMISS_MISTAKE(moving_point_aabox) {
  Vector& v = q.velocity;
  const double least = 1e-9 * std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  for (double* component : {&v.x, &v.y, &v.z}) {
    if (std::abs(*component) < least) *component = 0;
  }
  return right(q);
}
NEARMISS_MISTAKE(ray_aabox) {
  if (q.ray.direction.x < 0 && q.ray.direction.y < 0 && q.ray.direction.z < 0) return {};
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_plane) {
  auto a = right(q);
  if (a.yes() && a.time * std::abs(dot(a.normal, q.velocity)) < 1e-7 * q.sphere.radius) a.time = 0;
  return a;
}
NEARMISS_MISTAKE(moving_sphere_triangle) {
  const auto a = right(q);
  if (a.yes() && a.weights.y < 1e-12 && a.weights.x > 1e-12 && a.weights.z > 1e-12) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  q.rectangle.v3 = q.rectangle.v2;
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_sphere) {
  auto a = right(q);
  if (a.yes() && a.time > 0 && grazes(a.normal, q.velocity, 1e-6)) {
    a.time = dot(q.fixed.center - q.sphere.center, q.velocity) / dot(q.velocity, q.velocity);
  }
  return a;
}
NEARMISS_MISTAKE(moving_sphere_box) {
  const auto a = right(q);
  if (a.yes() && a.time > 0 && grazes(a.normal, q.velocity, 1e-7)) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const auto a = right(q);
  return a.time > 16 ? a.miss() : a;
}
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  q.limit *= 1 - 1e-10;
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  const Vector between = q.fixed.center - q.sphere.center;
  const double reach = q.sphere.radius + q.fixed.radius, depth = reach - length(between);
  if (dot(between, q.velocity) < 0 && depth >= 0 && depth < 1e-8 * reach) return {};
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_overlap) {
  q.sphere1.radius += 1e-12 * (q.sphere1.radius + q.sphere2.radius);
  return right(q);
}
NEARMISS_MISTAKE(sphere_box_overlap) {
  q.box.half.z = q.box.half.y;
  return right(q);
}
NEARMISS_MISTAKE(box_box_overlap) {
  q.hint = -1;
  const auto a = right(q);
  if (a.axis >= 6 && length(axis_of(q, a.axis)) < 1e-5) return {true, -1};
  return a;
}
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  if (dot(normal_of(q.triangle), q.sphere.center - q.triangle.v0) < 0) return {};
  return right(q);
}
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  const Vector side = q.box.max - q.box.min;
  const double largest = std::max({side.x, side.y, side.z});
  for (const double s : {side.x, side.y, side.z}) {
    if (s > 0 && s < 1e-6 * largest) return {};
  }
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto a = right(q);
  if (length(q.sphere2.center - q.sphere1.center) < 1e-10 * (q.sphere1.radius + q.sphere2.radius)) {
    a.normal = {1, 0, 0};
    a.contact = q.sphere1.center + a.normal * q.sphere1.radius;
  }
  return a;
}
NEARMISS_MISTAKE(sphere_plane_penetration) {
  auto a = right(q);
  if (std::abs(dot(q.plane.normal, q.plane.normal) - 1) < 1e-6) {
    a.depth = q.sphere.radius - (dot(q.plane.normal, q.sphere.center) + q.plane.offset);
  }
  return a;
}
NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  a.corners[7] = {};
  return a;
}
NEARMISS_MISTAKE(sphere_box_penetration) {
  auto a = right(q);
  const double below = a.depth - q.sphere.radius;
  if (below > 0 && below < 1e-10 * q.sphere.radius) a.normal = {0, 0, 1};
  return a;
}
NEARMISS_MISTAKE(box_box_penetration) {
  auto a = right(q);
  const Vector between = q.box2.center - q.box1.center;
  if (between.x < 0 && between.y < 0 && between.z < 0) a.normal = -a.normal;
  return a;
}
NEARMISS_MISTAKE(box_box_info) {
  auto a = right(q);
  a.abs_cosine[2].z = a.cosine[2].z;
  return a;
}
NEARMISS_MISTAKE(box_box_projected_distance) {
  if (length(axis_of(q, q.axis)) < 1e-7) return {0};
  return right(q);
}
NEARMISS_MISTAKE(box_box_separating_axis) {
  const auto a = right(q);
  if (length(a.direction) < 1e-9) return {};
  return a;
}
NEARMISS_MISTAKE(box_box_parallel_axis) {
  q.epsilon *= 1 + 1e-6;
  return right(q);
}
NEARMISS_MISTAKE(box_box_conservative) {
  q.box2.half.z = 0;
  return right(q);
}

NEARMISS_MISTAKE(bounce_direction) {
  if (length(q.velocity) < 1e-9) return {};
  return right(q);
}
NEARMISS_MISTAKE(slide_direction) {
  const double speed = length(q.velocity);
  if (speed > 0 && length(q.sphere.center + q.velocity * q.time - q.location) < 1e-9 * q.sphere.radius)
    return {q.velocity / speed};
  return right(q);
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/planted.def"
#include "fuzz/planted/planted_offers.hpp"
