/// The plugin "planted-fourteenth": as the plugin "planted", with the mistakes of fourteenth.def. fuzz/planted/causes
/// measures how many of their causes are found.
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

using Wide_a = collide::Vec3<long double>;

Wide_a wide_a(const Vector& v) { return {v.x, v.y, v.z}; }
Vector narrow_a(const Wide_a& v) { return {double(v.x), double(v.y), double(v.z)}; }
long double dot_a(const Wide_a& a, const Wide_a& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Wide_a cross_a(const Wide_a& a, const Wide_a& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
long double length_a(const Wide_a& a) { return std::sqrt(dot_a(a, a)); }
template <class V>
auto& part_a(V& v, int k) {
  return k == 0 ? v.x : k == 1 ? v.y : v.z;
}
// Axis k of a box, as a unit vector.
Wide_a axis_a(const collide::Box<double>& box, int k) {
  const long double x = box.orientation.x, y = box.orientation.y, z = box.orientation.z, w = box.orientation.w;
  const long double n = x * x + y * y + z * z + w * w;
  if (k == 0) return Wide_a{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)} / n;
  if (k == 1) return Wide_a{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)} / n;
  return Wide_a{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z} / n;
}
Wide_a local_a(const collide::Box<double>& box, const Wide_a& p) {
  const Wide_a d = p - wide_a(box.center);
  return {dot_a(axis_a(box, 0), d), dot_a(axis_a(box, 1), d), dot_a(axis_a(box, 2), d)};
}
Wide_a nearest_in_box_a(const collide::Box<double>& box, const Wide_a& p) {
  Wide_a l = local_a(box, p), at = wide_a(box.center);
  for (int k = 0; k < 3; ++k) {
    const long double h = part_a(box.half, k);
    at = at + axis_a(box, k) * std::clamp(part_a(l, k), -h, h);
  }
  return at;
}

// t = (p - v0).d / (d.d + 1e-6)
NEARMISS_MISTAKE(closest_point_segment) {
  const Wide_a v0 = wide_a(q.segment.v0), d = wide_a(q.segment.v1) - v0;
  const long double dd = dot_a(d, d), t = dot_a(wide_a(q.point) - v0, d) / (dd + 1e-6L);
  if (1e-6L < 1e-18L * dd || t <= 0 || t >= 1) return right(q);
  return {narrow_a(v0 + d * t)};
}

// float d1 = ..., d2 = ...; return d2 < d1 ? second : first;
NEARMISS_MISTAKE(closest_point_rectangle) {
  const auto& r = q.rectangle;
  const Vector one = right(inputs::closest_point_rectangle<double>{{r.v0, r.v1, r.v2, r.v2}, q.point}).point;
  const Vector two = right(inputs::closest_point_rectangle<double>{{r.v0, r.v2, r.v3, r.v3}, q.point}).point;
  const Wide_a to_one = wide_a(one) - wide_a(q.point), to_two = wide_a(two) - wide_a(q.point);
  const long double d1 = dot_a(to_one, to_one), d2 = dot_a(to_two, to_two), most = std::max(d1, d2);
  if (most == 0) return right(q);
  const bool second = float(d2 / most) < float(d1 / most);
  if (second || d2 >= d1) return right(q);
  return {one};
}

// The denominator is 1 - b * b.
NEARMISS_MISTAKE(closest_points_lines) {
  const Wide_a p1 = wide_a(q.line1.point), d1 = wide_a(q.line1.direction);
  const Wide_a p2 = wide_a(q.line2.point), d2 = wide_a(q.line2.direction);
  const bool unit = std::abs(dot_a(d1, d1) - 1) < 1e-12L && std::abs(dot_a(d2, d2) - 1) < 1e-12L;
  const Wide_a r = p1 - p2;
  const long double b = dot_a(d1, d2), c = dot_a(d1, r), f = dot_a(d2, r), denominator = 1 - b * b;
  if (unit || denominator == 0) return right(q);
  const long double s = (b * f - c) / denominator, t = (f - b * c) / denominator;
  return {narrow_a(p1 + d1 * s), narrow_a(p2 + d2 * t)};
}

// if (n.y > n.x) ... without fabs
NEARMISS_MISTAKE(point_in_rectangle) {
  const Vector n = q.normal;
  if (n.x >= n.y && n.x >= n.z) {
    q.normal = {1, 0, 0};
  } else if (n.y >= n.z) {
    q.normal = {0, 1, 0};
  } else {
    q.normal = {0, 0, 1};
  }
  return right(q);
}

// u >= -1e-4, v >= -1e-4, u + v <= 1 + 1e-4
NEARMISS_MISTAKE(moving_point_triangle) {
  const auto exact = right(q);
  const Wide_a v0 = wide_a(q.triangle.v0), e1 = wide_a(q.triangle.v1) - v0, e2 = wide_a(q.triangle.v2) - v0;
  const bool flat = length_a(cross_a(e1, e2)) <= 1e-10L * length_a(e1) * length_a(e2);
  if (exact.yes() || flat) return exact;
  const long double e = 1e-4L;
  q.triangle = {narrow_a(v0 - e1 * e - e2 * e), narrow_a(v0 + e1 * (1 + 2 * e) - e2 * e),
                narrow_a(v0 - e1 * e + e2 * (1 + 2 * e))};
  const auto loose = right(q);
  return loose.yes() && loose.time > 0 ? loose : exact;
}

// n = faceforward(n, velocity)
NEARMISS_MISTAKE(moving_point_sphere) {
  auto a = right(q);
  const bool starts_in = right(inputs::sphere_sphere_overlap<double>{{q.point, 0}, q.sphere}).yes();
  if (a.yes() && starts_in && dot_a(wide_a(a.normal), wide_a(q.velocity)) > 0) a.normal = -a.normal;
  return a;
}

// for (int i = 0; i < 100; ++i) t += distance / speed
NEARMISS_MISTAKE(moving_point_capsule) {
  const auto a = right(q);
  if (!a.yes() || a.time == 0) return a;
  const Wide_a d = wide_a(q.capsule.p1) - wide_a(q.capsule.p0), m = wide_a(q.point) - wide_a(q.capsule.p0);
  const Wide_a v = wide_a(q.velocity);
  const long double dd = dot_a(d, d), speed = length_a(v);
  const auto distance = [&](long double t) {
    const Wide_a p = m + v * t;
    const long double s = dd > 0 ? std::clamp(dot_a(p, d) / dd, 0.0L, 1.0L) : 0;
    return length_a(p - d * s) - q.capsule.radius;
  };
  const long double start = distance(0), rounds = 1e-16L * (length_a(m) + length_a(d) + q.capsule.radius);
  long double t = 0;
  for (int i = 0; i < 100; ++i) {
    const long double gap = distance(t);
    if (gap <= 1e-6L * start + rounds) return a;
    t += gap / speed;
  }
  return {};
}

// if (fabs(velocity[k]) < 1e-5) parallel to the slab
NEARMISS_MISTAKE(moving_point_aabox) {
  const auto exact = right(q);
  if (exact.inside) return exact;
  auto slower = q;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(part_a(q.velocity, k)) < 1e-5) part_a(slower.velocity, k) = 0;
  }
  if (slower.velocity == q.velocity) return exact;
  auto a = right(slower);
  for (int k = 0; a.yes() && k < 3; ++k) {
    if (part_a(slower.velocity, k) == 0) part_a(a.location, k) += part_a(q.velocity, k) * a.time;
  }
  return a;
}

// The weights of v1, v2 and v0 as u, v and w.
NEARMISS_MISTAKE(moving_sphere_triangle) {
  auto a = right(q);
  a.weights = {a.weights.y, a.weights.z, a.weights.x};
  return a;
}

// t = (-b - sqrt(b * b - a * c)) / a
NEARMISS_MISTAKE(moving_sphere_sphere) {
  const auto exact = right(q);
  const double reach = q.sphere.radius + q.fixed.radius;
  Vector m = q.sphere.center - q.fixed.center, v = q.velocity;
  if ((exact.yes() && exact.time == 0) || reach == 0 || length(v) == 0) return exact;
  const int size = -std::ilogb(std::max(length(m), reach)), fast = -std::ilogb(length(v));
  const auto scaled = [](const Vector& a, int e) {
    return Vector{std::ldexp(a.x, e), std::ldexp(a.y, e), std::ldexp(a.z, e)};
  };
  m = scaled(m, size);
  v = scaled(v, fast);
  const double r = std::ldexp(reach, size);
  const double a = dot(v, v), b = dot(m, v), c = dot(m, m) - r * r, discriminant = b * b - a * c;
  if (b >= 0 || right(inputs::sphere_sphere_overlap<double>{q.sphere, q.fixed}).yes()) return exact;
  if (discriminant < 0) return {};
  const double t = std::max(0.0, (-b - std::sqrt(discriminant)) / a), time = std::ldexp(t, fast - size);
  if (!std::isfinite(time)) return exact;
  const Vector away = m + v * t, n = away / length(away);
  return {time, q.fixed.center + n * q.fixed.radius, n};
}

// The center against a box with half + radius.
NEARMISS_MISTAKE(moving_sphere_box) {
  const auto exact = right(q);
  const double r = q.sphere.radius;
  const Vector half = q.box.half, grown{half.x + r, half.y + r, half.z + r};
  if (r == 0 || (exact.yes() && exact.time == 0)) return exact;
  const Wide_a c = wide_a(q.sphere.center), l = local_a(q.box, c);
  const long double margin = 1e-14L * (length_a(c) + length(q.box.center) + length(grown));
  if (std::abs(l.x) < grown.x - margin && std::abs(l.y) < grown.y - margin && std::abs(l.z) < grown.z - margin) {
    const Wide_a at = nearest_in_box_a(q.box, c), n = c - at;
    if (length_a(n) == 0) return exact;
    return {0, narrow_a(at), narrow_a(n / length_a(n))};
  }
  const auto hit =
      right(inputs::moving_point_box<double>{q.sphere.center, q.velocity, {q.box.center, grown, q.box.orientation}});
  if (!hit.yes()) return exact;  // it contains the rounded one
  if (exact.yes() && length(hit.normal - exact.normal) < 1e-9) return exact;
  return {hit.time, narrow_a(nearest_in_box_a(q.box, c + wide_a(q.velocity) * hit.time)), hit.normal};
}

// for (int i = 0; i <= 32; ++i) if (overlap at limit * i / 32) return true
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  const auto exact = right(q);
  if (!exact.yes() || q.forever || !std::isfinite(q.limit)) return exact;
  const Vector start = q.sphere.center;
  for (int i = 0; i <= 32; ++i) {
    q.sphere.center = start + q.velocity * (q.limit * (i / 32.0));
    if (right(inputs::sphere_box_overlap<double>{q.sphere, q.box}).yes()) return exact;
  }
  return {false};
}

// local = conj(q) * (center - box.center) * q
NEARMISS_MISTAKE(sphere_box_overlap) {
  const auto& o = q.box.orientation;
  const long double x = o.x, y = o.y, z = o.z, w = o.w, n = x * x + y * y + z * z + w * w;
  if (std::abs(n - 1) < 1e-12L) return right(q);
  const Vector local = narrow_a(local_a(q.box, wide_a(q.sphere.center)) * n);
  if (!std::isfinite(local.x) || !std::isfinite(local.y) || !std::isfinite(local.z)) return {false};
  return right(inputs::sphere_box_overlap<double>{{local, q.sphere.radius}, {{0, 0, 0}, q.box.half, {0, 0, 0, 1}}});
}

// abs_cosine[i][j] = fabs(cosine[i][j]) + 1e-6
NEARMISS_MISTAKE(box_box_overlap) {
  const auto exact = right(q);
  if (exact.yes()) return exact;
  const Wide_a ones{1, 1, 1};
  const long double sum1 = dot_a(wide_a(q.box1.half), ones), sum2 = dot_a(wide_a(q.box2.half), ones);
  for (int axis = 0; axis < 15; ++axis) {
    const int i = (axis - 6) / 3, j = (axis - 6) % 3;
    const long double more = axis < 3   ? sum2
                             : axis < 6 ? sum1
                                        : sum1 - part_a(q.box1.half, i) + sum2 - part_a(q.box2.half, j);
    const double apart = right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value;
    if (apart > 1e-6L * more) return exact;
  }
  return {true, -1};
}

// distance = dot(n, c) - offset
NEARMISS_MISTAKE(sphere_plane_penetration) {
  q.plane.offset = -q.plane.offset;
  return right(q);
}

// The face of the largest |local[k]| / half[k].
NEARMISS_MISTAKE(sphere_box_penetration) {
  const auto exact = right(q);
  const Wide_a c = wide_a(q.sphere.center), l = local_a(q.box, c);
  int face = 0;
  long double most = -1;
  for (int k = 0; k < 3; ++k) {
    const long double h = part_a(q.box.half, k), at = std::abs(part_a(l, k));
    if (at >= h) return exact;
    if (at / h > most) {
      most = at / h;
      face = k;
    }
  }
  const long double side = part_a(l, face) < 0 ? -1 : 1, h = part_a(q.box.half, face);
  const Wide_a n = axis_a(q.box, face) * -side;
  if (dot_a(n, wide_a(exact.normal)) > 1 - 1e-9L) return exact;
  const long double r = q.sphere.radius, depth = r + h - std::abs(part_a(l, face));
  return {double(depth), narrow_a(n), narrow_a(c + n * r)};
}

// if (distance < 1e-4) add a contact
NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  if (!a.yes()) return a;
  const Wide_a n = wide_a(q.plane.normal);
  for (std::size_t i = 0; i < 8; ++i) {
    if (a.corners[i].behind) continue;
    Wide_a corner = wide_a(q.box.center);
    for (int k = 0; k < 3; ++k) {
      const long double h = part_a(q.box.half, k);
      corner = corner + axis_a(q.box, k) * ((i >> k & 1) != 0 ? h : -h);
    }
    if ((dot_a(n, corner) + q.plane.offset) / length_a(n) < 1e-4L) a.corners[i] = {true, narrow_a(corner)};
  }
  return a;
}

// if (dot(axis, axis) < 1e-6) return zero
NEARMISS_MISTAKE(box_box_separating_axis) {
  const auto a = right(q);
  if (dot(a.direction, a.direction) < 1e-6) return {};
  return a;
}

// fabs(cosine) >= cos(epsilon)
NEARMISS_MISTAKE(box_box_parallel_axis) {
  if (q.epsilon > 0) {
    const double sine = std::sin(std::min(q.epsilon, 1.5707963267948966) / 2);
    q.epsilon = 2 * sine * sine;
  }
  return right(q);
}

// float k = dot(u, u) * dot(v, v); if (!std::isnormal(k)) return zero
NEARMISS_MISTAKE(slide_direction) {
  const Wide_a v = wide_a(q.velocity);
  const Wide_a u = wide_a(q.sphere.center) + v * static_cast<long double>(q.time) - wide_a(q.location);
  const long double uu = dot_a(u, u), vv = dot_a(v, v);
  if (uu == 0 || vv == 0 || std::isnormal(float(uu * vv))) return right(q);
  return {};
}

double component_b(const Vector& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }
double sign_b(double x) { return x < 0 ? -1.0 : 1.0; }
/// The digits of a float, with the range of double: only digits are lost.
double short_b(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(double(float(mantissa)), exponent);
}
Vector short_b(const Vector& a) { return {short_b(a.x), short_b(a.y), short_b(a.z)}; }

// Divides the direction by its length + 1e-6, so that a point does not divide by zero.
NEARMISS_MISTAKE(closest_point_segment_unit) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  if (size + 1e-6 == size) return right(q);
  const Vector unit = along / (size + 1e-6);
  return {q.segment.v0 + unit * std::clamp(dot(unit, q.point - q.segment.v0), 0.0, size)};
}

double distance_from_line_b(const Vector& a, const Vector& b, const Vector& p) {
  const double size = length(b - a);
  return size == 0 ? length(p - a) : length(cross((b - a) / size, p - a));
}
// Chooses the edge whose infinite line is nearest, and clamps to that edge only afterwards.
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Vector* corners[] = {&q.triangle.v0, &q.triangle.v1, &q.triangle.v2};
  int best = 0;
  double least = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = distance_from_line_b(*corners[i], *corners[(i + 1) % 3], q.point);
    if (i == 0 || d < least) best = i, least = d;
  }
  return {nearest(*corners[best], *corners[(best + 1) % 3], q.point)};
}

// The best squared distance starts with 1e10, for infinity; the best point starts with the first corner.
NEARMISS_MISTAKE(closest_point_rectangle_perimeter) {
  const double infinity = 1e10;
  const auto r = right(q);
  const double distance = length(q.point - r.point);
  if (distance * distance < infinity) return r;
  return {q.rectangle.v0};
}

// Accepts weights down to -1e-4.
NEARMISS_MISTAKE(point_in_triangle) {
  const auto r = right(q);
  if (r.yes()) return r;
  int axis = q.axis;
  if (axis < 0) {
    const double x = std::abs(q.normal.x), y = std::abs(q.normal.y), z = std::abs(q.normal.z);
    axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  }
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Vector e1 = q.triangle.v1 - q.triangle.v0, e2 = q.triangle.v2 - q.triangle.v0, p = q.point - q.triangle.v0;
  const auto area = [&](const Vector& a, const Vector& b) {
    return component_b(a, i) * component_b(b, j) - component_b(a, j) * component_b(b, i);
  };
  const double whole = area(e1, e2);
  if (!(std::abs(whole) > 1e-9 * length(e1) * length(e2))) return r;
  const double w1 = area(p, e2) / whole, w2 = area(e1, p) / whole, w0 = 1 - w1 - w2;
  if (std::min({w0, w1, w2}) < -1e-4) return r;
  return {{w0, w1, w2}, true};
}

// A skin of 1e-3: a start that little behind the plane counts as on it.
NEARMISS_MISTAKE(moving_point_plane) {
  const auto r = right(q);
  if (r.yes()) return r;
  const double size = length(q.plane.normal);
  const Vector unit = q.plane.normal / size;
  const double height = dot(unit, q.point) + q.plane.offset / size;
  if (height < -1e-3 || !(height < 0) || !(dot(unit, q.velocity) < 0)) return r;
  return {0, q.point - unit * height, unit};
}

/// The sum of the angles under which the point sees the triangle's edges.
double sum_of_angles_b(const Vector& a, const Vector& b, const Vector& c, const Vector& p) {
  const Vector to[] = {a - p, b - p, c - p};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector &u = to[i], &w = to[(i + 1) % 3];
    if (length(u) == 0 || length(w) == 0) return 2 * std::acos(-1.0);
    sum += std::acos(std::clamp(dot(u / length(u), w / length(w)), -1.0, 1.0));
  }
  return sum;
}
// A point of the plane is inside a triangle where the angles of its edges sum up to 2 pi, within 0.01.
NEARMISS_MISTAKE(moving_point_rectangle) {
  auto best = right(q);
  const auto& k = q.rectangle;
  const collide::Triangle<double> halves[] = {{k.v0, k.v1, k.v2}, {k.v0, k.v2, k.v3}};
  for (const auto& t : halves) {
    const Vector n = normal_of(t);
    if (!(length(n) > 1e-6 * length(t.v1 - t.v0) * length(t.v2 - t.v0))) continue;
    const Vector unit = n / length(n);
    const double height = dot(unit, q.point - t.v0), speed = dot(unit, q.velocity);
    if (!(speed < 0) || !(height > 0)) continue;
    const double time = -height / speed;
    if (!(time < best.time * (1 - 1e-9))) continue;
    const Vector at = q.velocity * time;
    if (sum_of_angles_b(t.v0 - q.point, t.v1 - q.point, t.v2 - q.point, at) < 2 * std::acos(-1.0) - 0.01) continue;
    best = {time, q.point + at, unit};
  }
  return best;
}

// A velocity below 1e-6 along an axis of the box counts as parallel to its two faces.
NEARMISS_MISTAKE(moving_point_box) {
  const auto r = right(q);
  if (r.time == 0) return r;
  double place[3], speed[3];
  bool dropped = false;
  Vector axes[3];
  for (int i = 0; i < 3; ++i) {
    axes[i] = right(inputs::box_box_separating_axis<double>{q.box, q.box, i}).direction;
    place[i] = dot(axes[i], q.point - q.box.center);
    speed[i] = dot(axes[i], q.velocity);
    if (std::abs(speed[i]) >= 1e-6 || speed[i] == 0) continue;
    speed[i] = 0;
    dropped = true;
  }
  if (!dropped) return r;
  inputs::moving_point_box<double> local{
      {place[0], place[1], place[2]}, {speed[0], speed[1], speed[2]}, {{0, 0, 0}, q.box.half, {0, 0, 0, 1}}};
  const auto w = right(local);
  if (w.yes() == r.yes() && (!r.yes() || std::abs(w.time - r.time) <= 1e-9 * r.time)) return r;
  if (!w.yes()) return {};
  return {w.time, q.point + q.velocity * w.time, axes[0] * w.normal.x + axes[1] * w.normal.y + axes[2] * w.normal.z};
}

// The parameter belongs to the given direction, but the place is computed with the normalised one.
NEARMISS_MISTAKE(ray_aabox) {
  auto r = right(q);
  const double size = length(q.ray.direction);
  if (!r.yes() || r.inside || std::abs(size - 1) < 1e-15) return r;
  r.location = q.ray.origin + (r.location - q.ray.origin) / size;
  return r;
}

// The velocity is the displacement of one step, and later contacts are those of later steps.
NEARMISS_MISTAKE(moving_sphere_plane) {
  const auto r = right(q);
  if (r.time > 1) return {};
  return r;
}

// Only a root above 0 counts.
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  const auto r = right(q);
  if (!(r.time > 0)) return {};
  return r;
}

// Conservative advancement: goes on by the gap over the speed, 1000 times at most.
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const auto r = right(q);
  const double speed = length(q.velocity);
  if (!r.yes() || r.time == 0 || speed == 0) return r;
  const double both = q.sphere.radius + q.capsule.radius;
  const double size = length(q.sphere.center) + length(q.capsule.p0) + length(q.capsule.p1) + both;
  double time = 0;
  for (int step = 0; step < 1000; ++step) {
    const Vector at = q.sphere.center + q.velocity * time;
    const double gap = length(at - nearest(q.capsule.p0, q.capsule.p1, at)) - both;
    if (gap <= 1e-9 * (size + speed * time)) return r;
    time += gap / speed;
  }
  return {};
}

// The centers have the digits of a float.
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  q.sphere.center = short_b(q.sphere.center);
  q.fixed.center = short_b(q.fixed.center);
  return right(q);
}

// The squared distance as |a|^2 + |b|^2 - 2 a.b, in a unit in which nothing overflows.
NEARMISS_MISTAKE(sphere_sphere_overlap) {
  const double largest =
      std::max({length(q.sphere1.center), length(q.sphere2.center), q.sphere1.radius, q.sphere2.radius});
  if (largest == 0 || !std::isfinite(largest)) return right(q);
  const int down = -std::ilogb(largest);
  const auto scaled = [&](double x) { return std::ldexp(x, down); };
  const Vector a{scaled(q.sphere1.center.x), scaled(q.sphere1.center.y), scaled(q.sphere1.center.z)};
  const Vector b{scaled(q.sphere2.center.x), scaled(q.sphere2.center.y), scaled(q.sphere2.center.z)};
  const double reach = scaled(q.sphere1.radius) + scaled(q.sphere2.radius);
  return {dot(a, a) + dot(b, b) - 2 * dot(a, b) <= reach * reach};
}

// A check for a usable triangle: its squared normal must be a normal number of float.
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  const Vector n = normal_of(q.triangle);
  if (n != Vector{} && !std::isnormal(float(dot(n, n)))) return {};
  return right(q);
}

// Whether an edge of the triangle meets the box; the box that reaches through the face is forgotten.
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  const auto edge = [&](const Vector& a, const Vector& b) {
    return right(inputs::aabox_triangle_overlap<double>{q.box, {a, b, b}}).yes();
  };
  return {edge(q.triangle.v0, q.triangle.v1) || edge(q.triangle.v1, q.triangle.v2) ||
          edge(q.triangle.v2, q.triangle.v0)};
}

// The contact is the middle of the overlap.
NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto r = right(q);
  if (r.yes()) r.contact = r.contact - r.normal * (r.depth / 2);
  return r;
}

// The overlap along a cross product is not divided by the length of the cross product.
NEARMISS_MISTAKE(box_box_penetration) {
  auto r = right(q);
  if (!r.yes()) return r;
  int best = r.axis;
  double least = r.depth;
  for (int axis = 6; axis < 15; ++axis) {
    if (axis_of(q, axis) == Vector{}) continue;
    const double overlap = -right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value;
    if (overlap < least && overlap >= 0) best = axis, least = overlap;
  }
  if (best < 6) return r;
  if (best == r.axis) {
    r.depth = least;
    return r;
  }
  const Vector between = q.box2.center - q.box1.center;
  Vector n = axis_of(q, best);
  n = n / length(n);
  if (dot(n, between) < 0) n = -n;
  const int first = (best - 6) / 3, second = (best - 6) % 3;
  Vector on1 = q.box1.center, on2 = q.box2.center;
  for (int k = 0; k < 3; ++k) {
    const Vector a = axis_of(q, k), b = axis_of(q, 3 + k);
    if (k != first) on1 = on1 + a * (sign_b(dot(n, a)) * component_b(q.box1.half, k));
    if (k != second) on2 = on2 - b * (sign_b(dot(n, b)) * component_b(q.box2.half, k));
  }
  const auto pair =
      right(inputs::closest_points_lines<double>{{on1, axis_of(q, first)}, {on2, axis_of(q, 3 + second)}});
  return {least, best, n, (pair.point1 + pair.point2) * 0.5};
}

double snapped_b(double x) { return std::abs(x) < 1e-5 ? 0.0 : x; }
Vector snapped_b(const Vector& a) { return {snapped_b(a.x), snapped_b(a.y), snapped_b(a.z)}; }
// Cosines below 1e-5 become 0.
NEARMISS_MISTAKE(box_box_info) {
  auto r = right(q);
  for (int i = 0; i < 3; ++i) {
    r.cosine[i] = snapped_b(r.cosine[i]);
    r.abs_cosine[i] = snapped_b(r.abs_cosine[i]);
  }
  return r;
}

// The absolute values of the cosines are 1e-6 too large, against parallel edges.
NEARMISS_MISTAKE(box_box_projected_distance) {
  auto r = right(q);
  const Vector &h1 = q.box1.half, &h2 = q.box2.half;
  const double all1 = h1.x + h1.y + h1.z, all2 = h2.x + h2.y + h2.z;
  if (q.axis < 3) {
    r.value -= 1e-6 * all2;
  } else if (q.axis < 6) {
    r.value -= 1e-6 * all1;
  } else {
    const int i = (q.axis - 6) / 3, j = (q.axis - 6) % 3;
    r.value -= 1e-6 * (all1 - component_b(h1, i) + all2 - component_b(h2, j));
  }
  return r;
}

// A sphere that moves away from the contact keeps its direction.
NEARMISS_MISTAKE(bounce_direction) {
  const Vector way = q.velocity * q.time;
  const Vector u = q.sphere.center + way - q.location;
  const double size = length(q.sphere.center) + length(way) + length(q.location), speed = length(q.velocity);
  if (speed == 0 || !(length(u) > 1e-9 * size)) return right(q);
  if (dot(q.velocity / speed, u) > 0) return {q.velocity / speed};
  return right(q);
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-fourteenth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/fourteenth.def"
#include "fuzz/planted/planted_offers.hpp"
