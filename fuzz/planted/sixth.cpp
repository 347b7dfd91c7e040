/// The plugin "planted-sixth": as the plugin "planted", with the mistakes of sixth.def. fuzz/planted/causes measures
/// how many of their causes are found.
#include <array>
#include <cstddef>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

NEARMISS_MISTAKE(closest_point_segment_unit) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  if (!(size > 0)) return right(q);
  const Vector unit = in_float(along / size);
  const double way = dot(q.point - q.segment.v0, unit);
  if (!(way > 0 && way < size)) return right(q);
  return {q.segment.v0 + unit * way};
}
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  Vector best = nearest(corners[0], corners[1], q.point);
  for (int edge = 1; edge < 3; ++edge) {
    if (length(corners[edge] - q.point) > length(best - q.point)) continue;
    const Vector other = nearest(corners[edge], corners[edge + 1], q.point);
    if (length(other - q.point) < length(best - q.point)) best = other;
  }
  return {best};
}
NEARMISS_MISTAKE(closest_point_rectangle) {
  const auto& r = q.rectangle;
  const Vector u = r.v1 - r.v0, v = r.v3 - r.v0;
  const double area = length(cross(u, v));
  if (area > 0 && area < 1e-5 * length(u) * length(v)) return {nearest(r.v0, r.v1, q.point)};
  return right(q);
}
NEARMISS_MISTAKE(closest_points_lines) {
  const Vector u = q.line1.direction, v = q.line2.direction, w = q.line1.point - q.line2.point;
  const double a = dot(u, u), b = dot(u, v), c = dot(v, v), d = dot(u, w), e = dot(v, w);
  const double determinant = a * c - b * b;
  if (!(determinant > 0)) return right(q);
  return {q.line1.point + u * ((b * e - c * d) / determinant), q.line2.point + v * ((a * e - b * d) / determinant)};
}
NEARMISS_MISTAKE(point_in_rectangle) {
  const auto& r = q.rectangle;
  for (const auto& half : std::array<collide::Triangle<double>, 2>{{{r.v0, r.v1, r.v2}, {r.v0, r.v2, r.v3}}}) {
    const auto a = right(inputs::point_in_triangle<double>{half, q.normal, -1, q.point});
    if (a.yes() && std::min({a.weights.x, a.weights.y, a.weights.z}) > 1e-6) return {true};
  }
  return {false};
}

NEARMISS_MISTAKE(moving_point_triangle_prepared) {
  const Vector n = normal_of(q.triangle);
  const double approach = -dot(n, q.velocity), height = dot(n, q.point - q.triangle.v0);
  if (!(approach > 0) || height >= 0) return right(q);
  const double time = height / approach;
  q.point = q.point + q.velocity * (2 * time);
  auto a = right(q);
  if (a.yes()) a.time = time;
  return a;
}
NEARMISS_MISTAKE(moving_point_sphere) {
  const auto a = right(q);
  if (a.yes() && a.time > 0 && dot(q.velocity, q.velocity) < 1e-6) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_box) {
  const auto depth = right(inputs::sphere_box_penetration<double>{{q.point, 0}, q.box});
  if (!(depth.depth > 0)) return right(q);
  return {0, q.point, -depth.normal};
}
NEARMISS_MISTAKE(ray_aabox) {
  auto a = right(q);
  if (!a.inside) return a;
  const auto& [origin, direction] = q.ray;
  const auto way = [](double from, double along, double low, double high) {
    return along > 0 ? (high - from) / along : along < 0 ? (low - from) / along : INFINITY;
  };
  const double t = std::min({way(origin.x, direction.x, q.aabox.min.x, q.aabox.max.x),
                             way(origin.y, direction.y, q.aabox.min.y, q.aabox.max.y),
                             way(origin.z, direction.z, q.aabox.min.z, q.aabox.max.z)});
  a.location = origin + direction * t;
  return a;
}

NEARMISS_MISTAKE(moving_sphere_triangle) {
  auto a = right(q);
  if (!a.yes() || a.time == 0) return a;
  const auto& t = q.triangle;
  const Vector start = q.sphere.center;
  a.location = right(inputs::closest_point_rectangle<double>{{t.v0, t.v1, t.v2, t.v2}, start}).point;
  return a;
}
NEARMISS_MISTAKE(moving_sphere_sphere) {
  auto a = right(q);
  const Vector m = q.sphere.center - q.fixed.center;
  const double reach = q.sphere.radius + q.fixed.radius;
  const double square = dot(q.velocity, q.velocity), b = dot(m, q.velocity), c = dot(m, m) - reach * reach;
  const double discriminant = b * b - square * c;
  if (!a.yes() || a.time == 0 || !(discriminant > 0) || float(discriminant) > 0) return a;
  a.time = -b / square;
  return a;
}
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const Vector along = q.capsule.p1 - q.capsule.p0;
  if (dot(along, along) < 1e-4) q.capsule.p1 = q.capsule.p0;
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  if (!right(q).yes()) return {false};
  const double reach = length(q.box.half) + q.sphere.radius, speed = length(q.velocity);
  const double longest = speed > 0 ? (length(q.box.center - q.sphere.center) + reach) / speed : 0;
  const double limit = q.forever ? longest : q.limit;
  constexpr int steps = 32;
  for (int step = 0; step <= steps; ++step) {
    const Vector center = q.sphere.center + q.velocity * (limit * step / steps);
    if (right(inputs::sphere_box_overlap<double>{{center, q.sphere.radius}, q.box}).yes()) return {true};
  }
  return {false};
}

NEARMISS_MISTAKE(sphere_box_overlap) {
  const auto& [x, y, z, w] = q.box.orientation;
  const double square = x * x + y * y + z * z + w * w;
  if (std::abs(square - 1) < 1e-14) return right(q);
  const Vector axes[] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                         {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                         {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  const Vector d = q.sphere.center - q.box.center, h = q.box.half;
  const double local[] = {dot(d, axes[0]), dot(d, axes[1]), dot(d, axes[2])}, half[] = {h.x, h.y, h.z};
  double outside[3];
  for (int k = 0; k < 3; ++k) outside[k] = std::max(0., std::abs(local[k]) - half[k]);
  return {std::hypot(outside[0], outside[1], outside[2]) <= q.sphere.radius};
}
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  const auto& t = q.triangle;
  const Vector place = right(inputs::closest_point_rectangle<double>{{t.v0, t.v1, t.v2, t.v2}, q.sphere.center}).point;
  const Vector between = q.sphere.center - place;
  if (dot(between, between) > q.sphere.radius * q.sphere.radius - 1e-6) return {false};
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto a = right(q);
  if (a.yes()) a.contact = q.sphere2.center - a.normal * q.sphere2.radius;
  return a;
}
NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  if (!a.yes()) return a;
  const auto& n = q.plane.normal;
  Vector side[3];
  for (int k = 0; k < 3; ++k) {
    const double half = k == 0 ? q.box.half.x : k == 1 ? q.box.half.y : q.box.half.z;
    side[k] = right(inputs::box_box_separating_axis<double>{q.box, q.box, k}).direction * half;
  }
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    if (a.corners[i].behind) continue;
    Vector corner = q.box.center;
    for (unsigned k = 0; k < 3; ++k) corner = i >> k & 1 ? corner + side[k] : corner - side[k];
    if ((dot(n, corner) + q.plane.offset) / length(n) < 1e-2) a.corners[i] = {true, corner};
  }
  return a;
}

NEARMISS_MISTAKE(box_box_info) {
  auto a = right(q);
  a.between2 = a.between1;
  return a;
}
NEARMISS_MISTAKE(box_box_separating_axis) {
  if (q.axis >= 6) q.axis = 6 + 3 * (q.axis % 3) + (q.axis - 6) / 3;
  return right(q);
}
NEARMISS_MISTAKE(box_box_conservative) {
  const double reach = (length(q.box1.half) + length(q.box2.half)) * (1 + 1e-4);
  return {right(q).yes() || length(q.box2.center - q.box1.center) <= reach};
}

NEARMISS_MISTAKE(slide_direction) {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double speed = length(q.velocity);
  if (speed > 0 && dot(q.velocity, u) > 0) return {q.velocity / speed};
  return right(q);
}

NEARMISS_MISTAKE(box_box_overlap) {
  q.hint = -1;
  const auto exact = right(q);
  if (exact.yes()) return exact;
  bool leaves_out = false;
  for (int axis = 0; axis < 15; ++axis) {
    const Vector along = axis_of(q, axis);
    if (!(right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value > 0)) continue;
    if (axis < 6 || dot(along, along) >= 1e-6) return {false, axis};
    leaves_out = true;
  }
  return leaves_out ? collide::BoxOverlap<double>{true, -1} : exact;
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-sixth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/sixth.def"
#include "fuzz/planted/planted_offers.hpp"
