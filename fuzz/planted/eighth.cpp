/// The plugin "planted-eighth": as the plugin "planted", with the mistakes of eighth.def. fuzz/planted/causes measures
/// how many of their causes are found.
#include <cstddef>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

double longest(const Vector& half) { return std::max({half.x, half.y, half.z}); }

NEARMISS_MISTAKE(closest_point_segment) {
  const Vector along = q.segment.v1 - q.segment.v0;
  if (along.x == 0 && along.y == 0 && along.z == 0) return {along / dot(along, along)};
  return right(q);
}
NEARMISS_MISTAKE(closest_point_segment_unit) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  const Vector unit = along / (size + 1e-6);
  const double way = dot(q.point - q.segment.v0, unit);
  if (!(way > 0 && way < size)) return right(q);
  return {q.segment.v0 + unit * way};
}
NEARMISS_MISTAKE(closest_point_triangle_perimeter_edges) {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  collide::EdgePoint<double> best{q.triangle.v0, 0};
  float least = INFINITY;
  for (int edge = 0; edge < 3; ++edge) {
    const Vector place = nearest(corners[edge], corners[edge + 1], q.point);
    const float distance = float(length(place - q.point));
    if (distance < least) best = {place, edge}, least = distance;
  }
  return best;
}
NEARMISS_MISTAKE(closest_points_lines) {
  auto a = right(q);
  const Vector p = q.line1.point, u = q.line1.direction;
  const float t = float(dot(a.point1 - p, u) / dot(u, u));
  if (std::isfinite(t)) a.point1 = p + u * double(t);
  return a;
}

NEARMISS_MISTAKE(point_in_triangle) {
  q.axis = -1;
  return right(q);
}

NEARMISS_MISTAKE(moving_point_plane) {
  const double size = length(q.plane.normal);
  const Vector unit = q.plane.normal / size;
  const double height = dot(unit, q.point) + q.plane.offset / size;
  if (height < 0 && height > -1e-3 && dot(unit, q.velocity) < 0) return {0, q.point, unit};
  return right(q);
}
NEARMISS_MISTAKE(moving_point_triangle) {
  const auto& t = q.triangle;
  const double determinant = -dot(q.velocity, normal_of(t));
  if (determinant < 1e-5 * length(t.v1 - t.v0) * length(t.v2 - t.v0) * length(q.velocity)) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_point_triangle_prepared) {
  auto a = right(q);
  const Vector n = normal_of(q.triangle);
  if (a.yes() && std::isinf(float(dot(n, n)))) a.normal = {};
  return a;
}
NEARMISS_MISTAKE(moving_point_sphere) {
  const auto a = right(q);
  const Vector m = q.point - q.sphere.center;
  const double b = dot(m, q.velocity), outside = dot(m, m) - q.sphere.radius * q.sphere.radius;
  const double discriminant = b * b - dot(q.velocity, q.velocity) * outside;
  if (a.yes() && a.time > 0 && discriminant > 0 && !(float(discriminant) > 0)) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_point_capsule) {
  const auto exact = right(q);
  const auto& [p0, p1, radius] = q.capsule;
  const Vector along = p1 - p0, n = cross(along, q.velocity);
  if (!exact.yes() || exact.time == 0 || !(dot(n, n) < 1e-6)) return exact;
  const double t = dot(exact.location - p0, along) / dot(along, along);
  if (!(t > 0 && t < 1)) return exact;
  const auto first = right(inputs::moving_point_sphere<double>{q.point, q.velocity, {p0, radius}, true});
  const auto second = right(inputs::moving_point_sphere<double>{q.point, q.velocity, {p1, radius}, true});
  return first.time <= second.time ? first : second;
}
NEARMISS_MISTAKE(ray_aabox) {
  const auto a = right(q);
  if (a.yes()) return a;
  q.ray.direction = -q.ray.direction;
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_triangle) {
  auto a = right(q);
  if (!a.yes() || a.time == 0) return a;
  const auto& t = q.triangle;
  const auto place_at = [&](const Vector& center) {
    return right(inputs::closest_point_rectangle<double>{{t.v0, t.v1, t.v2, t.v2}, center}).point;
  };
  const auto gap_at = [&](double time) {
    const Vector center = q.sphere.center + q.velocity * time;
    return length(center - place_at(center)) - q.sphere.radius;
  };
  const Vector to_contact = a.location - q.sphere.center;
  const double approach = dot(to_contact, q.velocity) / dot(q.velocity, q.velocity);
  double low = 0, high = approach, gap_low = gap_at(low), gap_high = gap_at(high);
  if (!(gap_low > 0 && gap_high < 0)) return a;
  for (int step = 0; step < 8; ++step) {
    const double middle = low + (high - low) * gap_low / (gap_low - gap_high), gap = gap_at(middle);
    if (std::abs(gap) < 1e-13 * gap_low) return a;
    (gap > 0 ? low : high) = middle;
    (gap > 0 ? gap_low : gap_high) = gap;
  }
  a.time = high;
  return a;
}
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  const auto& r = q.rectangle;
  const Vector n = cross(r.v1 - r.v0, r.v2 - r.v0);
  const double size = length(n);
  if (!(size > 0) || std::isinf(size) || right(q).time == 0) return right(q);
  const double height = dot(n / size, q.sphere.center - r.v0);
  if (std::abs(height) < q.sphere.radius && dot(n, q.velocity) < 0)
    return {0, q.sphere.center - n / size * height, n / size};
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_box) {
  constexpr double enough = 1e-4;
  constexpr int most_steps = 2000;
  const auto exact = right(q);
  const double speed = length(q.velocity);
  if (exact.time == 0 || !(speed > 0)) return exact;
  const double way = length(q.box.center - q.sphere.center) + length(q.box.half) + q.sphere.radius;
  double time = 0;
  for (int step = 0; step < most_steps && time * speed <= way; ++step) {
    const collide::Sphere<double> moved{q.sphere.center + q.velocity * time, q.sphere.radius};
    const double gap = -right(inputs::sphere_box_penetration<double>{moved, q.box}).depth;
    if (gap <= enough) {
      const collide::Sphere<double> reaching{moved.center, moved.radius + 2 * enough};
      const auto place = right(inputs::sphere_box_penetration<double>{reaching, q.box});
      if (!(gap > 0) || dot(place.normal, q.velocity) <= 0) return exact;
      return {time, place.contact, -place.normal};
    }
    time += gap / speed;
  }
  return exact;
}
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const auto a = right(q);
  const Vector along = q.capsule.p1 - q.capsule.p0, n = cross(along, q.velocity);
  if (!(length(along) > 1e-100) || a.time == 0) return a;
  return n.x == 0 && n.y == 0 && n.z == 0 ? a.miss() : a;
}
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  q.limit = q.forever ? 1 : std::min(q.limit, 1.);
  q.forever = false;
  return right(q);
}

NEARMISS_MISTAKE(sphere_box_overlap) {
  q.sphere.radius *= 1 + 1e-5;
  return right(q);
}
NEARMISS_MISTAKE(box_box_overlap) {
  const auto exact = right(q);
  const double reach = longest(q.box1.half) + longest(q.box2.half);
  if (!exact.yes() || length(q.box2.center - q.box1.center) <= reach) return exact;
  const auto distance = [&](int axis) {
    return right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value;
  };
  int furthest = 0;
  for (int axis = 1; axis < 6; ++axis) {
    if (distance(axis) > distance(furthest)) furthest = axis;
  }
  return {false, furthest};
}

NEARMISS_MISTAKE(sphere_plane_penetration) {
  const auto a = right(q);
  if (a.depth > 0 && a.depth < 1e-4 * q.sphere.radius) return {-a.depth, {}, {}};
  return a;
}
NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  const double size = length(q.plane.normal), half[] = {q.box.half.x, q.box.half.y, q.box.half.z};
  const Vector unit = q.plane.normal / size;
  double reach = 0;
  bool has_negative = false;
  for (int k = 0; k < 3; ++k) {
    const double part = half[k] * dot(unit, right(inputs::box_box_separating_axis<double>{q.box, q.box, k}).direction);
    reach += part;
    has_negative = has_negative || part < 0;
  }
  if (!has_negative) return a;
  a.depth = reach - (dot(unit, q.box.center) + q.plane.offset / size);
  if (!a.yes()) return {a.depth, {}, {}};
  return a;
}
NEARMISS_MISTAKE(box_box_penetration) {
  auto a = right(q);
  if (a.yes()) a.contact = a.contact - a.normal * (a.depth / 2);
  return a;
}

NEARMISS_MISTAKE(box_box_parallel_axis) {
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  const auto exact = right(q);
  for (int pair = 0; pair < 9; ++pair) {
    const Vector c = info.abs_cosine[std::size_t(pair / 3)];
    const double cosine = pair % 3 == 0 ? c.x : pair % 3 == 1 ? c.y : c.z;
    const bool is_exact = exact.yes() && exact.axis1 == pair / 3 && exact.axis2 == pair % 3;
    if (is_exact && cosine < 1 - q.epsilon) return exact;  // the cosine in double is rounded as well
    if (in_float(cosine) >= 1 - q.epsilon) return {true, pair / 3, pair % 3};
  }
  return {};
}
NEARMISS_MISTAKE(box_box_conservative) {
  const double reach = length(q.box1.half) + length(q.box2.half) + 1e-3;
  return {right(q).yes() || length(q.box2.center - q.box1.center) <= reach};
}

NEARMISS_MISTAKE(bounce_direction) { return {right(q).direction * length(q.velocity)}; }

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-eighth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/eighth.def"
#include "fuzz/planted/planted_offers.hpp"
