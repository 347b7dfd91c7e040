/// The plugin "planted-ninth": as the plugin "planted", with the mistakes of ninth.def. fuzz/planted/causes measures
/// how many of their causes are found.
#include <array>
#include <cstddef>
#include <utility>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

/// Larger than the rounding of a distance; an answer that is no farther is the right one.
constexpr double hardly_more = 1 + 1e-14;

std::array<double, 3> numbers_of(const Vector& v) { return {v.x, v.y, v.z}; }
template <class Quaternion>
double length_of(const Quaternion& r) {
  return std::hypot(std::hypot(r.x, r.y), std::hypot(r.z, r.w));
}

/// Half of b, and a quarter of the discriminant, of the equation for the times when a point is on an infinite cylinder.
std::pair<double, double> half_b_and_discriminant(const Vector& from, const Vector& velocity, const Vector& axis,
                                                  double radius) {
  const double dd = dot(axis, axis), nd = dot(velocity, axis), md = dot(from, axis);
  const double a = dd * dot(velocity, velocity) - nd * nd, b = dd * dot(from, velocity) - nd * md;
  const double c = dd * (dot(from, from) - radius * radius) - md * md;
  return {b, b * b - a * c};
}

NEARMISS_MISTAKE(closest_point_triangle_perimeter_edges) {
  const auto exact = right(q);
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  collide::EdgePoint<double> best{nearest(corners[0], corners[1], q.point), 0};
  for (int edge = 1; edge < 3; ++edge) {
    const Vector place = nearest(corners[edge], corners[edge + 1], q.point);
    const Vector to_best = best.point - q.point, to_place = place - q.point;
    if (dot(to_place, to_place) < dot(to_best, to_best) - 1e-8) best = {place, edge};
  }
  return length(best.point - q.point) > hardly_more * length(exact.point - q.point) ? best : exact;
}
NEARMISS_MISTAKE(closest_point_rectangle_perimeter) {
  const auto exact = right(q);
  const auto& [v0, v1, v2, v3] = q.rectangle;
  const Vector corners[] = {v0, v1, v2, v3, v0};
  Vector best = nearest(v0, v1, q.point);
  double least = length(best - q.point);
  for (int edge = 1; edge < 4; ++edge) {
    const Vector place = nearest(corners[edge], corners[edge + 1], q.point);
    const double distance = length(place - q.point);
    if (distance < least * (1 - 1e-4)) best = place, least = distance;
  }
  return least > hardly_more * length(exact.point - q.point) ? decltype(exact){best} : exact;
}
NEARMISS_MISTAKE(closest_points_lines) {
  auto a = right(q);
  const Vector p = q.line2.point, v = q.line2.direction / length(q.line2.direction);
  a.point2 = p + v * dot(q.line1.point - p, v);
  return a;
}

NEARMISS_MISTAKE(point_in_triangle) {
  const auto given = numbers_of(q.normal), areas = numbers_of(normal_of(q.triangle));
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(given[k]) > std::abs(given[axis])) axis = k;
  }
  if (q.axis >= 0) axis = std::size_t(q.axis);
  if (areas[axis] != 0 && std::abs(areas[axis]) < 1e-8) return {};
  return right(q);
}

NEARMISS_MISTAKE(moving_point_rectangle) {
  auto best = right(q);
  if (best.yes()) return best;
  constexpr double larger = 1 + 3e-5;
  const auto& r = q.rectangle;
  for (auto half : std::array<collide::Triangle<double>, 2>{{{r.v0, r.v1, r.v2}, {r.v0, r.v2, r.v3}}}) {
    const Vector middle = (half.v0 + half.v1 + half.v2) * (1. / 3);
    for (Vector* corner : {&half.v0, &half.v1, &half.v2}) *corner = middle + (*corner - middle) * larger;
    const auto a = right(inputs::moving_point_triangle<double>{q.point, q.velocity, half});
    if (a.time < best.time) best = a;
  }
  return best;
}
NEARMISS_MISTAKE(moving_point_sphere) {
  auto a = right(q);
  if (a.yes() && !q.solid && dot(a.normal, q.velocity) > 0) a.normal = -a.normal;
  return a;
}
NEARMISS_MISTAKE(moving_point_capsule) {
  const auto a = right(q);
  const Vector along = q.capsule.p1 - q.capsule.p0, from = q.point - q.capsule.p0;
  const double size = length(along), t = dot(a.location - q.capsule.p0, along / size) / size;
  if (!a.yes() || a.time == 0 || !(t >= 0 && t <= 1)) return a;
  const double b = half_b_and_discriminant(from, q.velocity, along, q.capsule.radius).first;
  return std::isinf(float(b * b)) ? a.miss() : a;
}
NEARMISS_MISTAKE(moving_point_box) {
  const auto a = right(q);
  if (!a.yes()) return a;
  const auto half = numbers_of(q.box.half);
  double last = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const Vector axis = right(inputs::box_box_separating_axis<double>{q.box, q.box, k}).direction;
    const double from = dot(q.point - q.box.center, axis), along = dot(q.velocity, axis);
    if (along != 0) last = std::min(last, (std::copysign(half[std::size_t(k)], along) - from) / along);
  }
  const double stay = last - a.time;
  return stay > 1e-12 * last && stay < 1e-6 ? a.miss() : a;
}
NEARMISS_MISTAKE(moving_point_aabox) {
  const auto exact = right(q);
  if (!exact.inside) return exact;
  const auto p = numbers_of(q.point), low = numbers_of(q.aabox.min), high = numbers_of(q.aabox.max);
  double least = INFINITY;
  Vector normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const double depth = std::min(p[k] - low[k], high[k] - p[k]), sign = p[k] - low[k] < high[k] - p[k] ? -1 : 1;
    if (depth < least) least = depth, normal = {k == 0 ? sign : 0, k == 1 ? sign : 0, k == 2 ? sign : 0};
  }
  return {false, q.point, 0, normal};
}
NEARMISS_MISTAKE(ray_aabox) {
  const auto exact = right(q);
  if (exact.inside) return exact;
  const auto o = numbers_of(q.ray.origin), d = numbers_of(q.ray.direction);
  const auto low = numbers_of(q.aabox.min), high = numbers_of(q.aabox.max);
  double first = 0, last = INFINITY;
  for (std::size_t k = 0; k < 3; ++k) {
    if (d[k] == 0 && (o[k] < low[k] || o[k] > high[k])) return {};
    if (d[k] == 0) continue;
    const float inverse = float(1 / d[k]);
    if (!std::isnormal(inverse)) return exact;
    const double to_low = (low[k] - o[k]) * double(inverse), to_high = (high[k] - o[k]) * double(inverse);
    first = std::max(first, std::min(to_low, to_high)), last = std::min(last, std::max(to_low, to_high));
  }
  if (!(first <= last)) return {};
  return {q.ray.origin + q.ray.direction * first, true, false};
}

NEARMISS_MISTAKE(moving_sphere_plane) {
  const double speed = -dot(q.plane.normal / length(q.plane.normal), q.velocity);
  if (speed > 0 && speed < 1e-5) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_triangle) {
  auto a = right(q);
  if (a.yes()) return a;
  std::swap(q.triangle.v1, q.triangle.v2);
  a = right(q);
  std::swap(a.weights.y, a.weights.z);
  return a;
}
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  const auto a = right(q);
  const auto& [v0, v1, v2, v3] = q.rectangle;
  const Vector corners[] = {v0, v1, v2, v3, v0}, n1 = cross(v1 - v0, v2 - v0), n2 = cross(v2 - v0, v3 - v0);
  const auto is_face = [&](const Vector& n) { return length(cross(a.normal, n)) <= 1e-9 * length(n); };
  if (!a.yes() || a.time == 0 || is_face(n1) || is_face(n2)) return a;
  for (int edge = 0; edge < 4; ++edge) {
    const Vector start = corners[edge], along = corners[edge + 1] - start;
    const double size = length(along), t = dot(a.location - start, along / size) / size;
    const bool is_on = t > 0 && t < 1 && length(start + along * t - a.location) <= 1e-9 * size;
    const double discriminant =
        half_b_and_discriminant(q.sphere.center - start, q.velocity, along, q.sphere.radius).second;
    if (is_on && discriminant > 0 && float(discriminant) == 0) return a.miss();
  }
  return a;
}
NEARMISS_MISTAKE(moving_sphere_capsule) {
  constexpr int most_steps = 2000;
  const auto exact = right(q);
  const auto& [p0, p1, radius] = q.capsule;
  const double speed = length(q.velocity), reach = q.sphere.radius + radius;
  if (exact.time == 0 || !(speed > 0) || !(reach > 0)) return exact;
  const double way = length(p0 - q.sphere.center) + length(p1 - p0) + reach;
  double time = 0;
  for (int step = 0; step < most_steps && time * speed <= way; ++step) {
    const Vector center = q.sphere.center + q.velocity * time, place = nearest(p0, p1, center);
    const double distance = length(center - place), gap = distance - reach;
    if (gap <= 1e-3 * reach) {
      const Vector normal = (center - place) / distance;
      if (!(gap > 0) || dot(normal, q.velocity) > 0) return exact;
      return {time, place + normal * radius, normal};
    }
    time += gap / speed;
  }
  return exact;
}
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  q.box.orientation = {0, 0, 0, 1};
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  const auto exact = right(q);
  const Vector from = q.sphere.center - q.fixed.center;
  const double reach = q.sphere.radius + q.fixed.radius, speed = length(q.velocity);
  if (!exact.yes() || !(speed > 0)) return exact;
  double time = 0;
  for (int step = 0; step < 10; ++step) {
    const double gap = length(from + q.velocity * time) - reach;
    if (gap <= 1e-9 * length(from)) return exact;
    time += gap / speed;
  }
  return {false};
}

NEARMISS_MISTAKE(box_box_overlap) {
  const auto exact = right(q);
  if (exact.yes()) return exact;
  for (int axis = 0; axis < 15; ++axis) {
    const double size = length(axis_of(q, axis));
    if (!(size > 0)) continue;
    const double gap = right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value / size;
    if (gap > 1e-4) return {false, axis};
  }
  return {true, -1};
}
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  const auto exact = right(q);
  const auto& [v0, v1, v2] = q.triangle;
  const Vector c = q.sphere.center, n = normal_of(q.triangle);
  const double square = dot(n, n);
  const double x = dot(n, cross(v1 - c, v2 - c)) / square, y = dot(n, cross(v2 - c, v0 - c)) / square;
  const double z = dot(n, cross(v0 - c, v1 - c)) / square;
  if (!exact.yes() || !std::isfinite(x + y + z) || std::min({x, y, z}) >= 0) return exact;
  const double a = std::max(0., x), b = std::max(0., y), d = std::max(0., z), sum = a + b + d;
  return {length(v0 * (a / sum) + v1 * (b / sum) + v2 * (d / sum) - c) <= hardly_more * q.sphere.radius};
}

NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto a = right(q);
  const Vector between = q.sphere2.center - q.sphere1.center;
  if (between.x == 0 && between.y == 0 && between.z == 0) a.normal = {}, a.contact = q.sphere1.center;
  return a;
}
NEARMISS_MISTAKE(sphere_plane_penetration) {
  const double behind = right(inputs::sphere_plane_penetration<double>{{q.sphere.center, 0}, q.plane}).depth;
  if (behind > 0) q.plane = {-q.plane.normal, -q.plane.offset};
  return right(q);
}
NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  int kept = 0;
  for (auto& corner : a.corners) {
    if (corner.behind && ++kept > 4) corner = {};
  }
  return a;
}
NEARMISS_MISTAKE(box_box_penetration) {
  for (auto* box : {&q.box1, &q.box2}) {
    auto& r = box->orientation;
    const double size = length_of(r);
    if (std::isfinite(size))
      r = {in_float(r.x / size), in_float(r.y / size), in_float(r.z / size), in_float(r.w / size)};
  }
  return right(q);
}

NEARMISS_MISTAKE(bounce_direction) {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location, rounded = in_float(u);
  const double size = length(rounded), speed = length(q.velocity);
  if (!std::isfinite(size) || !(size > 1e-30) || !(speed > 0)) return right(q);
  const Vector normal = rounded / size, direction = q.velocity / speed;
  return {direction - normal * (2 * dot(direction, normal))};
}
NEARMISS_MISTAKE(slide_direction) {
  auto a = right(q);
  const double size = length(a.direction);
  if (size > 0) a.direction = a.direction / size;
  return a;
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-ninth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/ninth.def"
#include "fuzz/planted/planted_offers.hpp"
