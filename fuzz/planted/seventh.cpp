/// The plugin "planted-seventh": as the plugin "planted", with the mistakes of seventh.def. fuzz/planted/causes
/// measures how many of their causes are found.
#include <array>
#include <cstddef>
#include <limits>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

/// An axis of a box, of unit length.
Vector axis_of_box(const collide::Box<double>& box, int k) {
  return right(inputs::box_box_separating_axis<double>{box, box, k}).direction;
}
std::array<double, 3> numbers_of(const Vector& v) { return {v.x, v.y, v.z}; }
/// The corner of a box that is furthest along a direction.
Vector furthest(const collide::Box<double>& box, const Vector& along) {
  const auto half = numbers_of(box.half);
  Vector corner = box.center;
  for (int k = 0; k < 3; ++k) {
    const Vector side = axis_of_box(box, k);
    corner = corner + side * std::copysign(half[std::size_t(k)], dot(side, along));
  }
  return corner;
}

NEARMISS_MISTAKE(closest_point_triangle_perimeter_edges) {
  const auto& [v0, v1, v2] = q.triangle;
  const Vector along = v0 - v2;
  if (!(length(along) > 0)) return right(q);
  const Vector unit = along / length(along);
  const Vector last = v0 + unit * std::clamp(dot(q.point - v0, unit), 0., length(along));
  const Vector places[] = {nearest(v0, v1, q.point), nearest(v1, v2, q.point), last};
  int best = 0;
  for (int edge = 1; edge < 3; ++edge) {
    if (length(places[edge] - q.point) < length(places[best] - q.point)) best = edge;
  }
  return {places[best], best};
}

NEARMISS_MISTAKE(closest_point_rectangle) {
  const auto& r = q.rectangle;
  const Vector n = cross(r.v1 - r.v0, r.v3 - r.v0);
  if (!(dot(n, n) > 0) || float(dot(n, n)) > 0) return right(q);
  return {right(inputs::closest_point_rectangle_perimeter<double>{r, q.point}).point};
}

NEARMISS_MISTAKE(point_in_rectangle) {
  if (right(q).yes()) return {true};
  const Vector n{std::abs(q.normal.x), std::abs(q.normal.y), std::abs(q.normal.z)};
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  const std::size_t i = axis == 0 ? 1 : 0, k = axis == 2 ? 1 : 2;
  const auto area = [&](const Vector& from, const Vector& to, const Vector& point) {
    const auto a = numbers_of(from), b = numbers_of(to), p = numbers_of(point);
    return (b[i] - a[i]) * (p[k] - a[k]) - (b[k] - a[k]) * (p[i] - a[i]);
  };
  const auto is_in = [&](const Vector& a, const Vector& b, const Vector& c) {
    const double sign = std::copysign(1., area(a, b, c));
    return std::min({sign * area(a, b, q.point), sign * area(b, c, q.point), sign * area(c, a, q.point)}) > -1e-6;
  };
  const auto& r = q.rectangle;
  return {is_in(r.v0, r.v1, r.v2) || is_in(r.v0, r.v2, r.v3)};
}

NEARMISS_MISTAKE(moving_point_plane) {
  const auto a = right(q);
  if (a.yes()) return a;
  q.plane = {-q.plane.normal, -q.plane.offset};
  return right(q);
}
NEARMISS_MISTAKE(moving_point_triangle_prepared) {
  const auto a = right(q);
  if (a.yes() && a.time < 1e-6) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_sphere) {
  const Vector m = q.point - q.sphere.center;
  const double radius = q.sphere.radius, square = dot(q.velocity, q.velocity), b = dot(m, q.velocity);
  const double outside = dot(m, m) - radius * radius, discriminant = b * b - square * outside;
  const bool is_usual = std::abs(b) > 1e-120 && std::isfinite(b * b) && std::isfinite(square * outside);
  if (!(is_usual && b < 0 && outside > 0 && radius > 0)) return right(q);
  if (discriminant < 0) return decltype(right(q))::miss();
  const double time = (-b - std::sqrt(discriminant)) / square;
  const Vector place = q.point + q.velocity * time, out = place - q.sphere.center;
  if (!(length(out) > 0)) return right(q);
  return {time, place, out / length(out)};
}
NEARMISS_MISTAKE(moving_point_capsule) {
  auto a = right(q);
  const Vector along = q.capsule.p1 - q.capsule.p0, from = a.location - q.capsule.p0;
  if (!a.yes() || !(length(along) > 0) || q.capsule.radius == 0) return a;
  const Vector unit = along / length(along);
  const double t = dot(from, unit);
  if (t >= 0 && t <= length(along)) return a;
  const Vector out = from - unit * t;
  if (length(out) > 1e-9 * length(from)) a.normal = out / length(out);
  return a;
}
NEARMISS_MISTAKE(moving_point_box) {
  auto a = right(q);
  const Vector n = a.normal;
  a.normal = {dot(n, axis_of_box(q.box, 0)), dot(n, axis_of_box(q.box, 1)), dot(n, axis_of_box(q.box, 2))};
  return a;
}
NEARMISS_MISTAKE(moving_point_aabox) {
  constexpr double margin = 1e-4;
  const auto p = numbers_of(q.point), low = numbers_of(q.aabox.min), high = numbers_of(q.aabox.max);
  for (std::size_t k = 0; k < 3; ++k) {
    if (p[k] < low[k] - margin || p[k] > high[k] + margin) return right(q);
  }
  return {true, q.point, std::numeric_limits<double>::infinity(), {}};
}
NEARMISS_MISTAKE(ray_aabox) {
  const auto a = right(q);
  if (a.yes() && length(a.location - q.ray.origin) > length(q.ray.direction)) return {};
  return a;
}

NEARMISS_MISTAKE(moving_sphere_plane) {
  auto a = right(q);
  const double size = length(q.plane.normal);
  const Vector unit = q.plane.normal / size;
  const double gap = dot(unit, q.sphere.center) + q.plane.offset / size - q.sphere.radius;
  const double approach = -dot(unit, q.velocity);
  if (!a.yes() || a.time > 0 || !(gap < 0) || !(approach > 0)) return a;
  const double time = gap / approach;
  return {time, q.sphere.center + q.velocity * time - unit * q.sphere.radius, unit};
}
NEARMISS_MISTAKE(moving_sphere_triangle) {
  const auto a = right(q);
  const Vector n = normal_of(q.triangle);
  if (!a.yes() || !(length(n) > 0) || std::isinf(length(n))) return a;
  if (grazes(n / length(n), q.velocity, 1e-4)) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  q.sphere.radius += 1e-4;
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_sphere) {
  auto a = right(q);
  if (a.yes()) a.location = (q.sphere.center + q.velocity * a.time + q.fixed.center) * 0.5;
  return a;
}
NEARMISS_MISTAKE(moving_sphere_box) {
  const Vector half = q.box.half;
  if (half.x == 0 || half.y == 0 || half.z == 0) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const auto a = right(q);
  const double speed = length(q.velocity), reach = q.sphere.radius + q.capsule.radius;
  if (!a.yes() || a.time == 0 || !(speed > 0)) return a;
  double time = 0;
  Vector place, between;
  for (int step = 0; step < 10; ++step) {
    const Vector center = q.sphere.center + q.velocity * time;
    place = nearest(q.capsule.p0, q.capsule.p1, center), between = center - place;
    const double gap = length(between) - reach;
    if (!(gap > 1e-14 * length(between))) return a;
    time += gap / speed;
  }
  const Vector normal = between / length(between);
  return {time, place + normal * q.capsule.radius, normal};
}
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  const double speed = length(q.velocity);
  if (speed > 0) q.limit = std::min(q.limit / speed, std::numeric_limits<double>::max());
  return right(q);
}

NEARMISS_MISTAKE(sphere_box_overlap) {
  const Vector from = q.sphere.center - q.box.center;
  const auto half = numbers_of(q.box.half);
  double outside[3];
  for (int k = 0; k < 3; ++k) {
    const double along = dot(from, axis_of_box(q.box, k)), local = in_float(along);
    if (std::isinf(local) || (along != 0 && std::abs(along) < 1e-30)) return right(q);
    outside[k] = std::max(0., std::abs(local) - half[std::size_t(k)]);
  }
  return {std::hypot(outside[0], outside[1], outside[2]) <= q.sphere.radius};
}
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  const Vector n = normal_of(q.triangle);
  if (std::isinf(float(dot(n, n)))) return {false};
  return right(q);
}
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  const auto a = right(q);
  if (a.yes()) return a;
  const auto v0 = numbers_of(q.triangle.v0), v1 = numbers_of(q.triangle.v1), v2 = numbers_of(q.triangle.v2);
  const auto low = numbers_of(q.box.min), high = numbers_of(q.box.max);
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::min({v0[k], v1[k], v2[k]}) > high[k] || std::max({v0[k], v1[k], v2[k]}) < low[k]) return a;
  }
  const Vector n = normal_of(q.triangle), half = (q.box.max - q.box.min) * 0.5;
  if (!(length(n) > 0) || std::isinf(length(n))) return a;
  const double apart = std::abs(dot(n / length(n), (q.box.min + q.box.max) * 0.5 - q.triangle.v0));
  const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
  return {apart < reach / length(n) * (1 - 1e-12)};
}

NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  if (!a.yes()) return a;
  const auto half = numbers_of(q.box.half);
  const double size = length(q.plane.normal), margin = 1e-3 * std::max({half[0], half[1], half[2]});
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    if (a.corners[i].behind) continue;
    Vector corner = q.box.center;
    for (unsigned k = 0; k < 3; ++k) corner = corner + axis_of_box(q.box, int(k)) * (i >> k & 1 ? half[k] : -half[k]);
    if (dot(q.plane.normal / size, corner) + q.plane.offset / size < margin) a.corners[i] = {true, corner};
  }
  return a;
}
NEARMISS_MISTAKE(box_box_penetration) {
  auto a = right(q);
  if (!a.yes() || a.axis < 6) return a;
  double least = INFINITY;
  int face = 0;
  for (int axis = 0; axis < 6; ++axis) {
    const double overlap = -right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value;
    if (overlap < least) least = overlap, face = axis;
  }
  if (a.depth * 1.05 < least) return a;
  Vector normal = axis_of(q, face);
  if (dot(normal, q.box2.center - q.box1.center) < 0) normal = -normal;
  const Vector contact =
      face < 3 ? furthest(q.box2, -normal) + normal * (least / 2) : furthest(q.box1, normal) - normal * (least / 2);
  return {least, face, normal, contact};
}

NEARMISS_MISTAKE(box_box_conservative) {
  const double reach = std::hypot(length(q.box1.half), length(q.box2.half));
  return {length(q.box2.center - q.box1.center) <= reach};
}

NEARMISS_MISTAKE(slide_direction) {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double speed = length(q.velocity);
  if (speed > 0 && dot(u, u) < 1e-8) return {q.velocity / speed};
  return right(q);
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-seventh"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/seventh.def"
#include "fuzz/planted/planted_offers.hpp"
