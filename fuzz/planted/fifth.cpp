/// The plugin "planted-fifth": as the plugin "planted", with the mistakes of fifth.def. fuzz/planted/causes measures
/// how many of their causes are found.
#include <cstddef>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

NEARMISS_MISTAKE(closest_point_segment) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double t = dot(q.point - q.segment.v0, along) / dot(along, along);
  if (t > 0 && t < 1e-4) return {q.segment.v0};
  if (t > 1 - 1e-4 && t < 1) return {q.segment.v1};
  return right(q);
}
NEARMISS_MISTAKE(closest_point_triangle_perimeter_edges) {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  const auto is_short = [&](int edge) {
    const Vector along = corners[edge + 1] - corners[edge];
    return dot(along, along) < 1e-12;
  };
  const auto a = right(q);
  if (!is_short(a.edge)) return a;
  collide::EdgePoint<double> best{q.triangle.v0, 0};
  double least = INFINITY;
  for (int edge = 0; edge < 3; ++edge) {
    if (is_short(edge)) continue;
    const Vector other = nearest(corners[edge], corners[edge + 1], q.point);
    if (length(other - q.point) < least) best = {other, edge}, least = length(other - q.point);
  }
  return best;
}
NEARMISS_MISTAKE(closest_point_rectangle_perimeter) {
  const auto a = right(q);
  const Vector corners[] = {q.rectangle.v0, q.rectangle.v1, q.rectangle.v2, q.rectangle.v3, q.rectangle.v0};
  for (int edge = 0; edge < 4; ++edge) {
    const Vector begin = corners[edge], along = corners[edge + 1] - begin;
    if (nearest(begin, corners[edge + 1], q.point) != a.point) continue;
    const float t = float(dot(q.point - begin, along) / dot(along, along));
    if (t > 0 && t < 1) return {begin + along * double(t)};
  }
  return a;
}

NEARMISS_MISTAKE(point_in_triangle) {
  const Vector n = q.normal;
  if (q.axis < 0) q.axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  return right(q);
}

NEARMISS_MISTAKE(moving_point_plane) {
  const auto a = right(q);
  if (a.yes() && std::abs(dot(a.normal, q.velocity)) < 1e-6) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_triangle) {
  const auto a = right(q);
  const auto& t = q.triangle;
  const Vector edge1 = t.v1 - t.v0, edge2 = t.v2 - t.v0, n = cross(edge1, edge2), from = q.point - t.v0;
  const double determinant = -dot(q.velocity, n), distance = dot(from, n);
  if (!(determinant > 0) || distance < 0) return a;
  const float u = float(dot(from, cross(q.velocity, edge2)) / determinant);
  const float v = float(dot(edge1, cross(q.velocity, from)) / determinant);
  const bool inside = u >= 0 && v >= 0 && u + v <= 1;
  if (inside == a.yes()) return a;
  if (!inside) return a.miss();
  const double time = distance / determinant;
  return {time, q.point + q.velocity * time, n / length(n)};
}
NEARMISS_MISTAKE(moving_point_rectangle) {
  const auto a = right(q);
  if (a.yes() && a.time < 1e-4) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_capsule) {
  const auto a = right(q);
  if (!a.yes() || a.time == 0) return a;
  const auto gap_at = [&](double time) {
    const Vector p = q.point + q.velocity * time;
    return length(p - nearest(q.capsule.p0, q.capsule.p1, p)) - q.capsule.radius;
  };
  const double speed = length(q.velocity), enough = 1e-9 * gap_at(0);
  double time = 0;
  for (int step = 0; step < 24; ++step) {
    const double gap = gap_at(time);
    if (gap <= enough) return a;
    time += gap / speed;
  }
  return a.miss();
}
NEARMISS_MISTAKE(moving_point_aabox) {
  auto a = right(q);
  if (!a.yes()) return a;
  const Vector from = a.location - (q.aabox.min + q.aabox.max) * 0.5;
  const double x = std::abs(from.x), y = std::abs(from.y), z = std::abs(from.z);
  a.normal = {};
  if (x >= y && x >= z)
    a.normal.x = std::copysign(1., from.x);
  else if (y >= z)
    a.normal.y = std::copysign(1., from.y);
  else
    a.normal.z = std::copysign(1., from.z);
  return a;
}

NEARMISS_MISTAKE(moving_sphere_plane) {
  q.plane.offset = -q.plane.offset;
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  auto a = right(q);
  const Vector start = q.sphere.center;
  const Vector place = right(inputs::closest_point_rectangle<double>{q.rectangle, start}).point;
  const double gap = length(start - place) - q.sphere.radius;
  if (a.yes() && gap > 0 && gap < 1e-3 * q.sphere.radius)
    a.time = 0, a.location = place, a.normal = (start - place) / length(start - place);
  return a;
}
NEARMISS_MISTAKE(moving_sphere_box) {
  const auto exact = right(q);
  if (exact.time == 0 || q.sphere.radius == 0) return exact;
  auto grown = q.box;
  const double r = q.sphere.radius;
  grown.half = grown.half + Vector{r, r, r};
  auto a = right(inputs::moving_point_box<double>{q.sphere.center, q.velocity, grown});
  if (right(inputs::sphere_box_overlap<double>{{q.sphere.center, 0}, grown}).yes())
    return {0, q.sphere.center, {0, 0, 1}};
  if (a.yes()) a.location = a.location - a.normal * r;
  const bool same_face = exact.yes() && a.yes() && length(exact.normal - a.normal) < 1e-9;
  return same_face ? exact : a;
}
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  const Vector m = q.sphere.center - q.fixed.center;
  const double b = dot(m, q.velocity);
  if (b < 0 && std::isinf(float(b * b)) && !right(inputs::sphere_sphere_overlap<double>{q.sphere, q.fixed}).yes())
    return {false};
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_overlap) {
  const Vector a = q.sphere1.center, b = q.sphere2.center;
  const double reach = q.sphere1.radius + q.sphere2.radius;
  return {dot(a, a) + dot(b, b) - 2 * dot(a, b) <= reach * reach};
}
NEARMISS_MISTAKE(box_box_overlap) {
  if (q.hint < 0 || q.hint >= 15) return right(q);
  const double apart = right(inputs::box_box_projected_distance<double>{q.box1, q.box2, q.hint}).value;
  if (apart > 0) return right(q);
  return {true, -1};
}
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  const Vector n = normal_of(q.triangle);
  const double square = dot(n, n);
  if (square > 0 && float(square) == 0) return {false};
  return right(q);
}

NEARMISS_MISTAKE(sphere_plane_penetration) {
  auto a = right(q);
  const auto& [n, offset] = q.plane;
  if (dot(n, n) == 1) return a;
  a.depth = q.sphere.radius - (dot(n, q.sphere.center) + offset);
  if (!a.yes()) return {a.depth, {}, {}};
  a.normal = n / length(n);
  a.contact = q.sphere.center - a.normal * q.sphere.radius;
  return a;
}
NEARMISS_MISTAKE(sphere_box_penetration) {
  auto a = right(q);
  if (!(a.depth > q.sphere.radius)) return a;
  const Vector half = q.box.half;
  const int axis = half.x <= half.y && half.x <= half.z ? 0 : half.y <= half.z ? 1 : 2;
  const Vector out = right(inputs::box_box_separating_axis<double>{q.box, q.box, axis}).direction;
  if (length(cross(out, a.normal)) < 1e-9) return a;
  const double along = dot(out, q.sphere.center - q.box.center), extent = std::min({half.x, half.y, half.z});
  a.depth = q.sphere.radius + extent - std::abs(along);
  a.normal = out * (along > 0 ? -1. : 1.);
  a.contact = q.sphere.center + a.normal * q.sphere.radius;
  return a;
}
NEARMISS_MISTAKE(box_box_penetration) {
  auto a = right(q);
  if (!a.yes()) return a;
  for (int axis = 6; axis < 15; ++axis) {
    const Vector along = axis_of(q, axis);
    if (length(along) < 1e-6) continue;
    const double overlap = -right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value;
    if (overlap < a.depth) a.depth = overlap, a.axis = axis, a.normal = along / length(along);
  }
  if (dot(a.normal, q.box2.center - q.box1.center) < 0) a.normal = -a.normal;
  return a;
}
NEARMISS_MISTAKE(box_box_projected_distance) {
  const double between = std::abs(dot(q.box2.center - q.box1.center, axis_of(q, q.axis)));
  return {right(q).value - between + in_float(between)};
}
NEARMISS_MISTAKE(box_box_parallel_axis) {
  const auto a = right(q);
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  const auto is_parallel = [&](int i, int k) {
    const Vector c = info.cosine[std::size_t(i)];
    return (k == 0 ? c.x : k == 1 ? c.y : c.z) >= 1 - q.epsilon;
  };
  if (!a.yes() || is_parallel(a.axis1, a.axis2)) return a;
  for (int pair = 3 * a.axis1 + a.axis2 + 1; pair < 9; ++pair) {
    if (is_parallel(pair / 3, pair % 3)) return {true, pair / 3, pair % 3};
  }
  return {};
}

NEARMISS_MISTAKE(bounce_direction) {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  if (length(u) < 1e-6) q.location = q.sphere.center, q.time = 0;  // exactly zero
  return right(q);
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-fifth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/fifth.def"
#include "fuzz/planted/planted_offers.hpp"
