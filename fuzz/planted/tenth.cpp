/// The plugin "planted-tenth": as the plugin "planted", with the mistakes of tenth.def. fuzz/planted/causes measures
/// how many of their causes are found.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

NEARMISS_MISTAKE(closest_point_segment_unit) {
  if (length(q.segment.v1 - q.segment.v0) < 1e-6) return {q.segment.v0};
  return right(q);
}

NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2};
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vector edge = corners[(i + 1) % 3] - corners[i];
    const Vector to_point = q.point - corners[i];
    const double l = length(edge);
    const double distance = l > 0 ? length(cross(edge / l, to_point)) : length(to_point);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return {nearest(corners[best], corners[(best + 1) % 3], q.point)};
}

NEARMISS_MISTAKE(closest_point_rectangle) {
  q.rectangle.v2 = q.rectangle.v1 + (q.rectangle.v3 - q.rectangle.v0);
  return right(q);
}

NEARMISS_MISTAKE(point_in_rectangle) {
  if (right(q).decision) return {true};
  const double x = std::abs(q.normal.x), y = std::abs(q.normal.y), z = std::abs(q.normal.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const auto doubled_area = [&](const Vector& a, const Vector& b, const Vector& c) {
    const Vector n = cross(b - a, c - a);
    return axis == 0 ? n.x : axis == 1 ? n.y : n.z;
  };
  const auto nearly_in = [&](const Vector& a, const Vector& b, const Vector& c) {
    const double whole = doubled_area(a, b, c), least = -1e-5;
    return whole != 0 && doubled_area(q.point, b, c) / whole >= least && doubled_area(a, q.point, c) / whole >= least &&
           doubled_area(a, b, q.point) / whole >= least;
  };
  const auto& r = q.rectangle;
  return {nearly_in(r.v0, r.v1, r.v2) || nearly_in(r.v0, r.v2, r.v3)};
}

NEARMISS_MISTAKE(moving_point_plane) {
  q.plane.offset = -q.plane.offset;
  return right(q);
}

NEARMISS_MISTAKE(moving_point_triangle) {
  const double determinant = -dot(q.velocity, normal_of(q.triangle));
  if (determinant < 1e-8) return {};
  return right(q);
}

NEARMISS_MISTAKE(moving_point_sphere) {
  const Vector between = q.point - q.sphere.center;
  const double speed = length(q.velocity), scale = std::max(length(between), q.sphere.radius);
  if (!(speed > 0) || !(q.sphere.radius > 0)) return right(q);
  const Vector m = between / scale, v = q.velocity / speed;
  const double r = q.sphere.radius / scale;
  const double a = dot(v, v), b = dot(m, v), c = dot(m, m) - r * r;
  if (c <= 0) return right(q);
  if (b >= 0) return {};
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return {};
  const double way = (-b - std::sqrt(discriminant)) / a;
  const double t = way * scale / speed;
  const Vector out = m + v * way;
  const double l = length(out);
  return {t, q.point + q.velocity * t, l > 0 ? out / l : -v};
}

NEARMISS_MISTAKE(moving_point_box) {
  auto a = right(q);
  if (!a.yes()) return a;
  Vector local{};
  double* to[] = {&local.x, &local.y, &local.z};
  for (int i = 0; i < 3; ++i)
    *to[i] = dot(a.normal, right(inputs::box_box_separating_axis<double>{q.box, q.box, i}).direction);
  a.normal = local;
  return a;
}

NEARMISS_MISTAKE(ray_aabox) {
  const auto a = right(q);
  auto& d = q.ray.direction;
  for (double* x : {&d.x, &d.y, &d.z})
    if (std::abs(*x) < 1e-6) *x = 0;
  if (d == Vector{}) return a.inside ? a : inputs::ray_aabox<double>::Answer{};
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_triangle) {
  const auto a = right(q);
  if (!a.yes() || a.time <= 0) return a;
  const auto& t = q.triangle;
  const double speed = length(q.velocity);
  Vector center = q.sphere.center;
  double enough = -1;
  for (int step = 0; step < 32; ++step) {
    const Vector near = right(inputs::closest_point_rectangle<double>{{t.v0, t.v1, t.v2, t.v2}, center}).point;
    const double distance = length(center - near);
    if (enough < 0) enough = 1e-8 * distance;
    const double gap = distance - q.sphere.radius;
    if (gap <= enough) return a;
    center = center + q.velocity * (gap / speed);
  }
  return {};
}

NEARMISS_MISTAKE(moving_sphere_sphere) {
  const auto a = right(q);
  if (dot(q.velocity, q.velocity) < 1e-10 && a.time > 0) return {};
  return a;
}

NEARMISS_MISTAKE(moving_sphere_capsule) {
  const auto a = right(q);
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const double l = length(axis), speed = length(q.velocity);
  if (!(l > 0) || !(speed > 0) || a.time <= 0) return a;
  const Vector c = cross(axis / l, q.velocity / speed);
  if (dot(c, c) >= 1e-6) return a;
  const auto first =
      right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p0, q.capsule.radius}});
  const auto second =
      right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p1, q.capsule.radius}});
  return second.time < first.time ? second : first;
}

NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  if (dot(q.fixed.center - q.sphere.center, q.velocity) <= 0) return {false};
  return right(q);
}

NEARMISS_MISTAKE(sphere_box_overlap) {
  q.box.half = q.box.half * 0.5;
  return right(q);
}

NEARMISS_MISTAKE(sphere_triangle_overlap) {
  const Vector n = normal_of(q.triangle);
  if (dot(n, n) < 1e-12) return {false};
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto a = right(q);
  if (a.yes() && length(q.sphere2.center - q.sphere1.center) < 1e-7) {
    a.normal = {1, 0, 0};
    a.contact = q.sphere1.center + a.normal * q.sphere1.radius;
  }
  return a;
}

NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  int contacts = 0;
  for (auto& corner : a.corners)
    if (corner.behind && ++contacts > 4) corner = {};
  return a;
}

NEARMISS_MISTAKE(box_box_penetration) {
  const auto a = right(q);
  if (!a.yes() || a.axis < 6) return a;
  int best = 0;
  double depth = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 6; ++i) {
    const double d = -right(inputs::box_box_projected_distance<double>{q.box1, q.box2, i}).value;
    if (d < depth) {
      depth = d;
      best = i;
    }
  }
  if (depth > 1.05 * a.depth) return a;
  Vector n = axis_of(q, best);
  if (dot(n, q.box2.center - q.box1.center) < 0) n = -n;
  const bool of_first = best < 3;
  const auto& other = of_first ? q.box2 : q.box1;
  Vector deepest = other.center;  // the corner of the other box that reaches deepest
  const double half[] = {other.half.x, other.half.y, other.half.z};
  for (int i = 0; i < 3; ++i) {
    const Vector axis = axis_of(q, of_first ? 3 + i : i);
    const bool along = dot(axis, n) > 0;
    deepest = deepest + axis * (along == of_first ? -half[i] : half[i]);
  }
  return {depth, best, n, deepest + n * (of_first ? depth / 2 : -depth / 2)};
}

NEARMISS_MISTAKE(box_box_projected_distance) {
  auto a = right(q);
  if (q.axis != 9) return a;
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  a.value += (info.half1.z - info.half1.y) * info.abs_cosine[0].x;
  return a;
}

NEARMISS_MISTAKE(bounce_direction) {
  const double speed = length(q.velocity);
  auto a = right(q);
  if (!(speed > 0)) return a;
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double l = length(u);
  const Vector n = l > 0 ? u / l : q.normal / length(q.normal);
  const Vector v = in_float(q.velocity / speed);
  a.direction = v - n * (2 * dot(v, n));
  return a;
}

double at(const Vector& a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }
double squared(const Vector& a) { return dot(a, a); }
Vector times(double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }

/// The box's axes, and a point in its frame.
Vector box_axis(const collide::Box<double>& b, int k) {
  return right(inputs::box_box_separating_axis<double>{b, b, k}).direction;
}
Vector local(const collide::Box<double>& b, const Vector& p) {
  const Vector d = p - b.center;
  return {dot(d, box_axis(b, 0)), dot(d, box_axis(b, 1)), dot(d, box_axis(b, 2))};
}
Vector world(const collide::Box<double>& b, const Vector& p) {
  return b.center + times(p.x, box_axis(b, 0)) + times(p.y, box_axis(b, 1)) + times(p.z, box_axis(b, 2));
}
Vector clamped(const Vector& p, const Vector& h) {
  return {std::clamp(p.x, -h.x, h.x), std::clamp(p.y, -h.y, h.y), std::clamp(p.z, -h.z, h.z)};
}

NEARMISS_MISTAKE(closest_point_segment) {
  if (squared(q.segment.v1 - q.segment.v0) < 1e-8) return {q.segment.v0};
  return right(q);
}

NEARMISS_MISTAKE(closest_point_triangle_perimeter_edges) {
  auto a = right(q);
  a.edge = (a.edge + 2) % 3;  // the vertex that is not on the edge
  return a;
}

NEARMISS_MISTAKE(closest_points_lines) {
  if (squared(cross(q.line1.direction, q.line2.direction)) < 1e-10) {
    const Vector p = q.line1.point, d = q.line2.direction;
    const double t = dot(p - q.line2.point, d) / dot(d, d);
    return {p, q.line2.point + times(t, d)};
  }
  return right(q);
}

NEARMISS_MISTAKE(point_in_triangle) {
  auto a = right(q);
  if (a.decision) return a;
  int axis = q.axis;
  if (axis < 0) {
    const double x = std::abs(q.normal.x), y = std::abs(q.normal.y), z = std::abs(q.normal.z);
    axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  }
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const auto area = [&](const Vector& s, const Vector& t) { return at(s, i) * at(t, j) - at(s, j) * at(t, i); };
  const Vector e1 = q.triangle.v1 - q.triangle.v0, e2 = q.triangle.v2 - q.triangle.v0, p = q.point - q.triangle.v0;
  const double whole = area(e1, e2);
  if (whole == 0) return a;
  const double v = area(p, e2) / whole, w = area(e1, p) / whole, u = 1 - v - w;
  if (u >= -1e-4 && v >= -1e-4 && w >= -1e-4) a.decision = true, a.weights = {u, v, w};
  return a;
}

NEARMISS_MISTAKE(moving_point_triangle_prepared) {
  if (std::abs(dot(normal_of(q.triangle), q.velocity)) < 1e-6) return {};
  return right(q);
}

NEARMISS_MISTAKE(moving_point_rectangle) {
  q.rectangle.v2 = q.rectangle.v1 + (q.rectangle.v3 - q.rectangle.v0);
  return right(q);
}

NEARMISS_MISTAKE(moving_point_capsule) {
  const Vector d = q.capsule.p1 - q.capsule.p0;
  if (length(d) > 0 && length(cross(q.velocity, d)) < 1e-3 * length(q.velocity) * length(d)) {
    const double from_axis = length(cross(q.point - q.capsule.p0, d)) / length(d);
    if (from_axis > q.capsule.radius) return {};
  }
  return right(q);
}

NEARMISS_MISTAKE(moving_point_aabox) {
  for (double* v : {&q.velocity.x, &q.velocity.y, &q.velocity.z})
    if (std::abs(*v) < 1e-6) *v = 0;  // parallel to the slab
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_plane) {
  if (right(inputs::sphere_plane_penetration<double>{q.sphere, q.plane}).depth > 0) return {};
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_rectangle) {
  const auto a = right(q);
  if (!a.yes()) return a;
  const auto& r = q.rectangle;
  for (const Vector& v : {r.v0, r.v1, r.v2, r.v3})
    if (a.location.x == v.x && a.location.y == v.y && a.location.z == v.z) return {};
  return a;
}

NEARMISS_MISTAKE(moving_sphere_box) {
  const double r = q.sphere.radius;
  const Vector h = q.box.half, c = local(q.box, q.sphere.center);
  if (std::abs(c.x) <= h.x + r && std::abs(c.y) <= h.y + r && std::abs(c.z) <= h.z + r) return right(q);
  collide::Box<double> grown = q.box;
  grown.half = {h.x + r, h.y + r, h.z + r};
  const auto a = right(inputs::moving_point_box<double>{q.sphere.center, q.velocity, grown});
  if (!a.yes()) return {};
  const Vector p = local(q.box, a.location);
  return {a.time, world(q.box, clamped(p, h)), a.normal};
}

NEARMISS_MISTAKE(moving_sphere_passes_box) {
  const Vector h = q.box.half, c = local(q.box, q.sphere.center);
  const Vector v{dot(q.velocity, box_axis(q.box, 0)), dot(q.velocity, box_axis(q.box, 1)),
                 dot(q.velocity, box_axis(q.box, 2))};
  const double speed = length(v);
  double t = 0, first = 0;
  for (int step = 0; speed > 0; ++step) {
    const Vector p = c + times(t, v);
    const double gap = length(p - clamped(p, h)) - q.sphere.radius;
    if (step == 0) first = gap;
    if (!(gap > 1e-6 * first)) break;                 // arrived
    if (!q.forever && t > q.limit) break;             // too late
    if (!(t < 1e6 * first / speed + q.limit)) break;  // gone
    if (step == 50) return {false};
    t += gap / speed;
  }
  return right(q);
}

NEARMISS_MISTAKE(sphere_sphere_overlap) {
  const double r = q.sphere1.radius + q.sphere2.radius;
  if (squared(q.sphere2.center - q.sphere1.center) <= r * r + 1e-6) return {true};
  return right(q);
}

NEARMISS_MISTAKE(box_box_overlap) {
  const auto a = right(q);
  if (a.decision) return a;
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  const auto c = [&](int i, int j) { return at(info.cosine[i % 3], j % 3); };
  const auto more = [&](int i, int j) { return std::abs(c(i, j)) + 1e-6; };
  const auto h1 = [&](int i) { return at(info.half1, i % 3); };
  const auto h2 = [&](int j) { return at(info.half2, j % 3); };
  for (int i = 0; i < 3; ++i) {
    if (std::abs(at(info.between1, i)) > h1(i) + h2(0) * more(i, 0) + h2(1) * more(i, 1) + h2(2) * more(i, 2)) return a;
    if (std::abs(at(info.between2, i)) > h2(i) + h1(0) * more(0, i) + h1(1) * more(1, i) + h1(2) * more(2, i)) return a;
    for (int j = 0; j < 3; ++j) {
      const double far =
          std::abs(at(info.between1, (i + 2) % 3) * c(i + 1, j) - at(info.between1, (i + 1) % 3) * c(i + 2, j));
      if (far > h1(i + 1) * more(i + 2, j) + h1(i + 2) * more(i + 1, j) + h2(j + 1) * more(i, j + 2) +
                    h2(j + 2) * more(i, j + 1))
        return a;
    }
  }
  return {true, -1};
}

NEARMISS_MISTAKE(aabox_triangle_overlap) {
  if (right(q).decision) return {true};
  const Vector middle = times(0.5, q.box.min + q.box.max), half = times(0.5, q.box.max - q.box.min);
  const Vector v[] = {q.triangle.v0 - middle, q.triangle.v1 - middle, q.triangle.v2 - middle};
  const auto apart = [&](const Vector& axis) {
    const double p0 = dot(axis, v[0]), p1 = dot(axis, v[1]), p2 = dot(axis, v[2]);
    const double r = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
    return std::min({p0, p1, p2}) > r || std::max({p0, p1, p2}) < -r;
  };
  const Vector units[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vector& u : units)
    if (apart(u) || apart(cross(u, v[1] - v[0])) || apart(cross(u, v[2] - v[1]))) return {false};
  return {!apart(normal_of(q.triangle))};
}

NEARMISS_MISTAKE(sphere_plane_penetration) {
  q.plane.offset = -q.plane.offset;
  return right(q);
}

NEARMISS_MISTAKE(sphere_box_penetration) {
  const Vector h = q.box.half, c = local(q.box, q.sphere.center);
  if (!(std::abs(c.x) < h.x && std::abs(c.y) < h.y && std::abs(c.z) < h.z)) return right(q);
  const double x = std::abs(c.x), y = std::abs(c.y), z = std::abs(c.z);
  const int k = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const Vector inward = times(at(c, k) < 0 ? 1 : -1, box_axis(q.box, k));
  return {q.sphere.radius + at(h, k) - std::abs(at(c, k)), inward, q.sphere.center + times(q.sphere.radius, inward)};
}

NEARMISS_MISTAKE(box_box_parallel_axis) {
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (at(info.cosine[i], j) >= 1 - q.epsilon) return {true, i, j};
  return {};
}

NEARMISS_MISTAKE(box_box_conservative) {
  const auto size = [](const Vector& h) {
    const float x = float(h.x), y = float(h.y), z = float(h.z);
    return std::sqrt(x * x + y * y + z * z);
  };
  const float x = float(q.box2.center.x) - float(q.box1.center.x), y = float(q.box2.center.y) - float(q.box1.center.y),
              z = float(q.box2.center.z) - float(q.box1.center.z);
  return {std::sqrt(x * x + y * y + z * z) <= size(q.box1.half) + size(q.box2.half)};
}

NEARMISS_MISTAKE(slide_direction) {
  auto a = right(q);
  const double l = length(a.direction);
  if (l > 0) a.direction = times(1 / l, a.direction);
  return a;
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-tenth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/tenth.def"
#include "fuzz/planted/planted_offers.hpp"
