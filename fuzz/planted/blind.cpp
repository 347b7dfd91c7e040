/// The plugin "planted-blind": as the plugin "planted", with the mistakes of blind.def. fuzz/planted/causes measures
/// how many of their causes are found.
#include <array>
#include <utility>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

NEARMISS_MISTAKE(closest_point_segment) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double t = dot(q.point - q.segment.v0, along) / (dot(along, along) + 1e-12);
  if (!(t > 0 && t < 1)) return right(q);
  return {q.segment.v0 + along * t};
}
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Vector a = nearest(q.triangle.v0, q.triangle.v1, q.point), b = nearest(q.triangle.v1, q.triangle.v2, q.point);
  const Vector c = nearest(q.triangle.v2, q.triangle.v1, q.point);
  Vector best = a;
  for (const Vector& other : {b, c}) {
    if (length(other - q.point) < length(best - q.point)) best = other;
  }
  return {best};
}
NEARMISS_MISTAKE(closest_points_lines) {
  auto a = right(q);
  a.point2 = q.line2.point + q.line2.direction * dot(a.point1 - q.line2.point, q.line2.direction);
  return a;
}
NEARMISS_MISTAKE(point_in_triangle) {
  const auto a = right(q);
  if (a.yes()) return a;
  constexpr double larger = 1 + 3e-6;
  const Vector middle = (q.triangle.v0 + q.triangle.v1 + q.triangle.v2) * (1. / 3);
  for (Vector* corner : {&q.triangle.v0, &q.triangle.v1, &q.triangle.v2})
    *corner = middle + (*corner - middle) * larger;
  return right(q);
}
NEARMISS_MISTAKE(moving_point_triangle) {
  const auto a = right(q);
  if (a.yes()) return a;
  std::swap(q.triangle.v1, q.triangle.v2);
  return right(q);
}
NEARMISS_MISTAKE(moving_point_aabox) {
  const auto a = right(q);
  return a.yes() && a.time > 1 ? a.miss() : a;
}
NEARMISS_MISTAKE(ray_aabox) {
  const auto& [origin, direction] = q.ray;
  const auto divides_zero_by_zero = [](double o, double d, double low, double high) {
    return d == 0 && (o == low || o == high);
  };
  if (divides_zero_by_zero(origin.x, direction.x, q.aabox.min.x, q.aabox.max.x) ||
      divides_zero_by_zero(origin.y, direction.y, q.aabox.min.y, q.aabox.max.y) ||
      divides_zero_by_zero(origin.z, direction.z, q.aabox.min.z, q.aabox.max.z))
    return {};
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_plane) {
  auto a = right(q);
  if (a.yes() && a.time > 0) {
    const float unit = float(length(q.plane.normal));
    const float distance = (float(dot(q.plane.normal, q.sphere.center)) + float(q.plane.offset)) / unit;
    a.time = (distance - float(q.sphere.radius)) * unit / -float(dot(q.plane.normal, q.velocity));
  }
  return a;
}
NEARMISS_MISTAKE(moving_sphere_sphere) {
  if (length(q.fixed.center - q.sphere.center) <= q.sphere.radius + q.fixed.radius) return {};
  return right(q);
}
NEARMISS_MISTAKE(moving_sphere_box) {
  const auto a = right(q);
  const double speed = length(q.velocity);
  if (!a.yes() || a.time == 0) return a;
  const auto gap_at = [&](double t) {
    const collide::Sphere<double> moved{q.sphere.center + q.velocity * t, q.sphere.radius};
    return -right(inputs::sphere_box_penetration<double>{moved, q.box}).depth;
  };
  double t = 0;
  for (int step = 0; step < 12; ++step) {
    const double gap = gap_at(t);
    if (gap <= 1e-9 * q.sphere.radius) return a;
    t += gap / speed;
  }
  return a.miss();
}
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const auto a = right(q);
  const Vector along = q.capsule.p1 - q.capsule.p0;
  if (a.yes() && a.time > 0 && dot(a.location - q.capsule.p1, along) > 0) return a.miss();
  return a;
}
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  const Vector m = q.sphere.center - q.fixed.center;
  const double reach = q.sphere.radius + q.fixed.radius, along = dot(m, q.velocity);
  const double outside = dot(m, m) - reach * reach,
               discriminant = along * along - dot(q.velocity, q.velocity) * outside;
  if (outside > 0 && discriminant < 1e-6) return {};
  return right(q);
}

NEARMISS_MISTAKE(sphere_box_overlap) {
  const double distance = -right(inputs::sphere_box_penetration<double>{{q.sphere.center, 0}, q.box}).depth;
  return {distance <= 0 || distance * distance <= q.sphere.radius};
}
NEARMISS_MISTAKE(box_box_overlap) {
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  const auto at = [](const Vector& v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; };
  const Vector a = q.box1.half, b = q.box2.half;
  double c[3][3], s[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) c[i][k] = at(info.cosine[std::size_t(i)], k), s[i][k] = std::abs(c[i][k]) + 1e-6;
  }
  for (int i = 0; i < 3; ++i) {
    const double first = s[i][0] * b.x + s[i][1] * b.y + s[i][2] * b.z;
    if (std::abs(at(info.between1, i)) > at(a, i) + first) return {false, i};
    const double second = s[0][i] * a.x + s[1][i] * a.y + s[2][i] * a.z;
    if (std::abs(at(info.between2, i)) > at(b, i) + second) return {false, 3 + i};
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      const double reach = at(a, i1) * s[i2][k] + at(a, i2) * s[i1][k] + at(b, k1) * s[i][k2] + at(b, k2) * s[i][k1];
      const double between = at(info.between1, i2) * c[i1][k] - at(info.between1, i1) * c[i2][k];
      if (std::abs(between) > reach) return {false, 6 + 3 * i + k};
    }
  }
  return {true, -1};
}
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  const auto& t = q.triangle;
  const Vector corners[] = {t.v0, t.v1, t.v2};
  double to_corner = INFINITY, to_edge = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    to_corner = std::min(to_corner, length(corners[i] - q.sphere.center));
    to_edge = std::min(to_edge, length(nearest(corners[i], corners[(i + 1) % 3], q.sphere.center) - q.sphere.center));
  }
  if (to_corner <= to_edge) return {};
  return right(q);
}
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  const Vector margin{1e-5, 1e-5, 1e-5};
  q.box = {q.box.min - margin, q.box.max + margin};
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto a = right(q);
  if (a.yes() && length(q.sphere2.center - q.sphere1.center) < 1e-6) {
    a.normal = {0, 0, 1};
    a.contact = q.sphere1.center + a.normal * q.sphere1.radius;
  }
  return a;
}
NEARMISS_MISTAKE(sphere_plane_penetration) {
  auto a = right(q);
  if (a.yes()) a.contact = a.contact + a.normal * (a.depth / 2);
  return a;
}
NEARMISS_MISTAKE(box_plane_penetration) {
  std::swap(q.box.half.x, q.box.half.z);
  return right(q);
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-blind"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/blind.def"
#include "fuzz/planted/planted_offers.hpp"
