/// The plugin "planted-eleventh": as the plugin "planted", with the mistakes of eleventh.def. fuzz/planted/causes
/// measures how many of their causes are found.
#include <array>
#include <limits>
#include <utility>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

using collide::Vec3;

double squared(const Vector& a) { return dot(a, a); }

// Like many engines: "degenerate segment" by the squared length.
NEARMISS_MISTAKE(closest_point_segment) {
  if (squared(q.segment.v1 - q.segment.v0) < 1e-8) return {q.segment.v0};
  return right(q);
}

// Inside of the prism over the face, the barycentric weights choose the edge; they ignore that the heights differ.
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const auto& t = q.triangle;
  const Vector n = normal_of(t);
  const double nn = squared(n);
  if (!(nn > 0)) return right(q);
  const double w0 = dot(n, cross(t.v1 - q.point, t.v2 - q.point)) / nn;
  const double w1 = dot(n, cross(t.v2 - q.point, t.v0 - q.point)) / nn;
  const double w2 = dot(n, cross(t.v0 - q.point, t.v1 - q.point)) / nn;
  if (!(w0 > 0 && w1 > 0 && w2 > 0)) return right(q);
  if (w0 <= w1 && w0 <= w2) return {nearest(t.v1, t.v2, q.point)};
  if (w1 <= w2) return {nearest(t.v2, t.v0, q.point)};
  return {nearest(t.v0, t.v1, q.point)};
}

// Corners as a triangle strip: v0 v1 v3 v2 around.
NEARMISS_MISTAKE(closest_point_rectangle_perimeter) {
  std::swap(q.rectangle.v2, q.rectangle.v3);
  return right(q);
}

NEARMISS_MISTAKE(point_in_triangle) {
  const auto exact = right(q);
  if (exact.yes()) return exact;
  int axis = q.axis;
  if (axis < 0) {
    const double x = std::abs(q.normal.x), y = std::abs(q.normal.y), z = std::abs(q.normal.z);
    axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  }
  const auto part = [&](const Vector& a) {
    return axis == 0 ? std::array{a.y, a.z} : axis == 1 ? std::array{a.z, a.x} : std::array{a.x, a.y};
  };
  const auto a = part(q.triangle.v1 - q.triangle.v0), b = part(q.triangle.v2 - q.triangle.v0),
             p = part(q.point - q.triangle.v0);
  const double area = a[0] * b[1] - a[1] * b[0];
  if (area == 0) return exact;
  const double w1 = (p[0] * b[1] - p[1] * b[0]) / area, w2 = (a[0] * p[1] - a[1] * p[0]) / area, w0 = 1 - w1 - w2;
  if (!(w0 >= -1e-5 && w1 >= -1e-5 && w2 >= -1e-5)) return exact;
  return {{w0, w1, w2}, true};
}

NEARMISS_MISTAKE(moving_point_plane) {
  if (dot(q.plane.normal, q.velocity) > -1e-6) return decltype(right(q))::miss();
  return right(q);
}

// A corner and two sides; the opposite corner is never read.
NEARMISS_MISTAKE(moving_point_rectangle) {
  q.rectangle.v2 = q.rectangle.v1 + (q.rectangle.v3 - q.rectangle.v0);
  return right(q);
}

// The schoolbook quadratic.
NEARMISS_MISTAKE(moving_point_sphere) {
  using Answer = inputs::moving_point_sphere<double>::Answer;
  const Vector from = q.point - q.sphere.center;
  const double a = squared(q.velocity), b = dot(from, q.velocity),
               c = squared(from) - q.sphere.radius * q.sphere.radius;
  if (a == 0 || (q.solid && c <= 0)) return right(q);
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return Answer::miss();
  const double root = std::sqrt(discriminant);
  double t = (-b - root) / a;
  if (c <= 0) t = (-b + root) / a;
  if (t < 0 || !std::isfinite(t)) return Answer::miss();
  const Vector location = q.point + q.velocity * t;
  const Vector out = location - q.sphere.center;
  const double size = length(out);
  if (size == 0) return right(q);
  return {t, location, out / size};
}

// The slab test with an epsilon: slower than that is parallel to the slab.
NEARMISS_MISTAKE(moving_point_aabox) {
  for (double* v : {&q.velocity.x, &q.velocity.y, &q.velocity.z})
    if (std::abs(*v) < 1e-6) *v = 0;
  return right(q);
}

// No division by the length of the normal anywhere.
NEARMISS_MISTAKE(moving_sphere_plane) {
  using Answer = inputs::moving_sphere_plane<double>::Answer;
  const Vector n = q.plane.normal;
  const double distance = dot(n, q.sphere.center) + q.plane.offset, speed = dot(n, q.velocity), r = q.sphere.radius;
  if (speed > 0 || distance < -r) return Answer::miss();
  if (distance <= r) return {0, q.sphere.center - n * distance, n};
  if (speed == 0) return Answer::miss();
  const double t = (r - distance) / speed;
  if (!std::isfinite(t)) return Answer::miss();
  return {t, q.sphere.center + q.velocity * t - n * r, n};
}

// Face and edges between their ends; the balls around the vertices are forgotten.
NEARMISS_MISTAKE(moving_sphere_triangle) {
  const auto a = right(q);
  const auto at_vertex = [&](double u, double v) { return std::abs(u) < 1e-15 && std::abs(v) < 1e-15; };
  if (a.yes() && a.time > 0 && squared(normal_of(q.triangle)) > 0 &&
      (at_vertex(a.weights.x, a.weights.y) || at_vertex(a.weights.y, a.weights.z) ||
       at_vertex(a.weights.z, a.weights.x)))
    return decltype(right(q))::miss();
  return a;
}

// "Parallel to the axis": the cylinder is left out.
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const auto a = right(q);
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const double vv = squared(q.velocity), dd = squared(axis);
  if (!a.yes() || a.time == 0 || !(dd > 0) || !(squared(cross(axis, q.velocity)) <= 1e-8 * vv * dd)) return a;
  const auto end0 = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p0, q.capsule.radius}});
  const auto end1 = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p1, q.capsule.radius}});
  return end0.time <= end1.time ? end0 : end1;
}

// The sum of a box and a ball is taken for a larger box.
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  const double r = q.sphere.radius;
  q.box.half = q.box.half + Vector{r, r, r};
  q.sphere.radius = 0;
  return right(q);
}

// Float in the middle of double.
NEARMISS_MISTAKE(sphere_sphere_overlap) {
  auto a = right(q);
  const Vector d = q.sphere2.center - q.sphere1.center;
  const float x = float(d.x), y = float(d.y), z = float(d.z), r = float(q.sphere1.radius + q.sphere2.radius);
  a.decision = x * x + y * y + z * z <= r * r;
  return a;
}

NEARMISS_MISTAKE(sphere_triangle_overlap) {
  auto a = right(q);
  if (dot(normal_of(q.triangle), q.sphere.center - q.triangle.v0) < 0) a.decision = false;
  return a;
}

// The separating axis test with axes skipped that are "too short".
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  auto a = right(q);
  if (a.decision) return a;
  const Vector center = (q.box.min + q.box.max) * 0.5, half = (q.box.max - q.box.min) * 0.5;
  const Vector v[] = {q.triangle.v0 - center, q.triangle.v1 - center, q.triangle.v2 - center};
  const auto separates = [&](const Vector& axis) {
    const double p[] = {dot(axis, v[0]), dot(axis, v[1]), dot(axis, v[2])};
    const double r = std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
    return *std::min_element(p, p + 3) > r || *std::max_element(p, p + 3) < -r;
  };
  const Vector axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vector& axis : axes)
    if (separates(axis)) return a;
  if (separates(normal_of(q.triangle))) return a;
  bool skipped = false;
  for (int i = 0; i < 3; ++i)
    for (const Vector& axis : axes) {
      const Vector both = cross(axis, v[(i + 1) % 3] - v[i]);
      if (!separates(both)) continue;
      if (squared(both) >= 1e-10) return a;
      skipped = true;
    }
  a.decision = skipped;
  return a;
}

NEARMISS_MISTAKE(sphere_plane_penetration) {
  q.plane.offset = -q.plane.offset;
  return right(q);
}

// The "fudge factor" that prefers faces.
NEARMISS_MISTAKE(box_box_penetration) {
  auto a = right(q);
  if (!a.yes() || a.axis < 6) return a;
  int face = -1;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 6; ++i) {
    const double depth = -right(inputs::box_box_projected_distance<double>{q.box1, q.box2, i}).value;
    if (depth < best) best = depth, face = i;
  }
  if (!(best <= 1.05 * a.depth)) return a;
  Vector n = axis_of(q, face);
  if (dot(n, q.box2.center - q.box1.center) < 0) n = -n;
  const bool of_first = face < 3;
  const auto& other = of_first ? q.box2 : q.box1;
  const double h[] = {other.half.x, other.half.y, other.half.z};
  const Vector into = of_first ? -n : n;
  Vector deepest = other.center;
  for (int i = 0; i < 3; ++i) {
    const Vector axis = axis_of(q, of_first ? 3 + i : i);
    deepest = deepest + axis * (dot(axis, into) < 0 ? -h[i] : h[i]);
  }
  a.depth = best;
  a.axis = face;
  a.normal = n;
  a.contact = deepest - into * (best / 2);
  return a;
}

// The matrix of a unit quaternion, for a quaternion of any length.
Vector column(const collide::Quaternion<double>& r, int i) {
  const double x = r.x, y = r.y, z = r.z, w = r.w;
  if (i == 0) return {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
  if (i == 1) return {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
  return {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
}

NEARMISS_MISTAKE(box_box_separating_axis) {
  const auto& r1 = q.box1.orientation;
  const auto& r2 = q.box2.orientation;
  if (q.axis < 3) return {column(r1, q.axis)};
  if (q.axis < 6) return {column(r2, q.axis - 3)};
  return {cross(column(r1, (q.axis - 6) / 3), column(r2, (q.axis - 6) % 3))};
}

// Normalizing as in a well-known engine: short vectors become zero.
NEARMISS_MISTAKE(bounce_direction) {
  if (length(q.velocity) <= 1e-5) return {};
  return right(q);
}

// Small cosines are "cleaned".
NEARMISS_MISTAKE(box_box_info) {
  auto a = right(q);
  const auto clean = [](Vector& c) {
    if (std::abs(c.x) < 1e-6) c.x = 0;
    if (std::abs(c.y) < 1e-6) c.y = 0;
    if (std::abs(c.z) < 1e-6) c.z = 0;
  };
  for (auto& row : a.cosine) clean(row);
  for (auto& row : a.abs_cosine) clean(row);
  return a;
}

using Axes = std::array<Vector, 3>;

double at(const Vector& a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }
double& at(Vector& a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }
Vector unit(const Vector& a) { return a / length(a); }

/// The columns of the matrix of a unit quaternion.
template <class Q>
Axes axes_of_unit(const Q& q) {
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  return {Vector{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          Vector{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          Vector{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}
template <class Q>
Axes axes_of(Q q) {
  const double most = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)});
  q.x /= most, q.y /= most, q.z /= most, q.w /= most;
  const double n = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  q.x /= n, q.y /= n, q.z /= n, q.w /= n;
  return axes_of_unit(q);
}
Vector into(const Axes& axes, const Vector& a) { return {dot(axes[0], a), dot(axes[1], a), dot(axes[2], a)}; }

NEARMISS_MISTAKE(closest_point_segment_unit) {
  const Vector d = q.segment.v1 - q.segment.v0;
  if (dot(d, d) < 1e-10) return {q.segment.v0};
  return right(q);
}

NEARMISS_MISTAKE(closest_point_rectangle) {
  const auto& r = q.rectangle;
  const Vector e1 = r.v1 - r.v0, e2 = r.v3 - r.v0, d = q.point - r.v0;
  const double l1 = dot(e1, e1), l2 = dot(e2, e2);
  const double s = l1 > 0 ? std::clamp(dot(d, e1) / l1, 0.0, 1.0) : 0;
  const double t = l2 > 0 ? std::clamp(dot(d, e2) / l2, 0.0, 1.0) : 0;
  return {r.v0 + e1 * s + e2 * t};
}

NEARMISS_MISTAKE(closest_points_lines) {
  const Vector &d1 = q.line1.direction, &d2 = q.line2.direction;
  const Vector n = cross(d1, d2);  // its square is the determinant a c - b b
  if (dot(n, n) < 1e-8) {
    const Vector w = q.line1.point - q.line2.point;
    return {q.line1.point, q.line2.point + d2 * (dot(w, d2) / dot(d2, d2))};
  }
  return right(q);
}

NEARMISS_MISTAKE(point_in_rectangle) {
  const Vector& n = q.normal;
  int drop = 0;
  if (std::abs(n.y) > std::abs(at(n, drop))) drop = 1;
  if (std::abs(n.z) > std::abs(at(n, drop))) drop = 2;
  if (drop != 1) return right(q);
  // In the plane of x and z, a triangle that is counterclockwise about +y is clockwise.
  const double sign = at(n, drop) < 0 ? -1 : 1;
  const auto side = [&](const Vector& a, const Vector& b) {
    return sign * ((b.x - a.x) * (q.point.z - a.z) - (b.z - a.z) * (q.point.x - a.x));
  };
  const auto in = [&](const Vector& a, const Vector& b, const Vector& c) {
    return side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0;
  };
  const auto& r = q.rectangle;
  return {in(r.v0, r.v1, r.v2) || in(r.v0, r.v2, r.v3)};
}

NEARMISS_MISTAKE(moving_point_triangle) {
  if (-dot(q.velocity, normal_of(q.triangle)) < 1e-6) return inputs::moving_point_triangle<double>::Answer::miss();
  return right(q);
}

NEARMISS_MISTAKE(moving_point_capsule) {
  auto a = right(q);
  if (!a.yes()) return a;
  const Vector d = q.capsule.p1 - q.capsule.p0;
  if (!(dot(d, d) > 0)) return a;
  const Vector foot = q.capsule.p0 + d * (dot(a.location - q.capsule.p0, d) / dot(d, d));
  const Vector out = a.location - foot;
  if (length(out) > 0) a.normal = unit(out);
  return a;
}

NEARMISS_MISTAKE(moving_point_box) {
  const Axes axes = axes_of(q.box.orientation);
  const Vector v = into(axes, q.velocity), p = into(axes, q.point - q.box.center);
  Vector moved = q.velocity;
  for (int i = 0; i < 3; ++i)
    if (std::abs(at(v, i)) < 1e-6) {
      if (std::abs(at(p, i)) > at(q.box.half, i)) return inputs::moving_point_box<double>::Answer::miss();
      moved = moved - axes[i] * at(v, i);
    }
  q.velocity = moved;
  return right(q);
}

NEARMISS_MISTAKE(ray_aabox) {
  auto a = right(q);
  if (!a.yes() || a.inside) return a;
  double enters = 0;
  for (int i = 0; i < 3; ++i) {
    const double o = at(q.ray.origin, i), d = at(q.ray.direction, i);
    if (d != 0) enters = std::max(enters, ((d > 0 ? at(q.aabox.min, i) : at(q.aabox.max, i)) - o) / d);
  }
  if (enters > 1) return {};
  return a;
}

NEARMISS_MISTAKE(moving_sphere_rectangle) {
  const Vector n = cross(q.rectangle.v1 - q.rectangle.v0, q.rectangle.v2 - q.rectangle.v0);
  const double l = length(n);
  if (l > 0 && grazes(n / l, q.velocity, 1e-4)) return inputs::moving_sphere_rectangle<double>::Answer::miss();
  return right(q);
}

NEARMISS_MISTAKE(moving_sphere_sphere) {
  const auto exact = right(q);
  if (exact.time == 0) return exact;  // the overlap at the start is tested first
  if (dot(q.velocity, q.velocity) < 1e-8) return inputs::moving_sphere_sphere<double>::Answer::miss();
  return exact;
}

NEARMISS_MISTAKE(moving_sphere_box) {
  const auto exact = right(q);
  if (!exact.yes() || exact.time == 0) return exact;
  const Axes axes = axes_of(q.box.orientation);
  const Vector v = into(axes, q.velocity), p = into(axes, q.sphere.center - q.box.center);
  const double speed = length(v), precise = 1e-9 * (length(p) + q.sphere.radius);
  double t = 0;
  for (int step = 0; step < 20; ++step) {
    const Vector c = p + v * t;
    Vector out;
    for (int i = 0; i < 3; ++i) at(out, i) = std::max(std::abs(at(c, i)) - at(q.box.half, i), 0.0);
    const double gap = length(out) - q.sphere.radius;
    if (gap <= precise) return exact;
    t += gap / speed;
  }
  return inputs::moving_sphere_box<double>::Answer::miss();
}

NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  const double speed = length(q.velocity);
  if (speed > 0 && !q.forever) q.limit /= speed;
  if (!std::isfinite(q.limit)) q.forever = true;
  return right(q);
}

NEARMISS_MISTAKE(sphere_box_overlap) {
  const auto& o = q.box.orientation;
  const double n = o.x * o.x + o.y * o.y + o.z * o.z + o.w * o.w;
  if (std::abs(n - 1) < 1e-12) return right(q);
  const Vector c = into(axes_of_unit(o), q.sphere.center - q.box.center);
  Vector out;
  for (int i = 0; i < 3; ++i) at(out, i) = std::max(std::abs(at(c, i)) - at(q.box.half, i), 0.0);
  return {length(out) <= q.sphere.radius};
}

NEARMISS_MISTAKE(box_box_overlap) {
  const auto exact = right(q);
  if (exact.yes()) return exact;
  const Axes a1 = axes_of(q.box1.orientation), a2 = axes_of(q.box2.orientation);
  const Vector t = into(a1, q.box2.center - q.box1.center), &h1 = q.box1.half, &h2 = q.box2.half;
  double r[3][3], s[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = dot(a1[i], a2[j]), s[i][j] = std::abs(r[i][j]) + 1e-6;
  for (int i = 0; i < 3; ++i)
    if (std::abs(at(t, i)) > at(h1, i) + h2.x * s[i][0] + h2.y * s[i][1] + h2.z * s[i][2]) return {false, i};
  for (int j = 0; j < 3; ++j)
    if (std::abs(t.x * r[0][j] + t.y * r[1][j] + t.z * r[2][j]) >
        at(h2, j) + h1.x * s[0][j] + h1.y * s[1][j] + h1.z * s[2][j])
      return {false, 3 + j};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
      if (std::abs(at(t, l) * r[k][j] - at(t, k) * r[l][j]) >
          at(h1, k) * s[l][j] + at(h1, l) * s[k][j] + at(h2, m) * s[i][n] + at(h2, n) * s[i][m])
        return {false, 6 + 3 * i + j};
    }
  return {true, -1};
}

NEARMISS_MISTAKE(sphere_sphere_penetration) {
  const Vector d = q.sphere2.center - q.sphere1.center;
  if (dot(d, d) < 1e-12) {
    const Vector up{0, 1, 0};
    return {q.sphere1.radius + q.sphere2.radius, up, q.sphere1.center + up * q.sphere1.radius};
  }
  return right(q);
}

NEARMISS_MISTAKE(sphere_box_penetration) {
  const Axes axes = axes_of(q.box.orientation);
  const Vector c = into(axes, q.sphere.center - q.box.center);
  const Vector& h = q.box.half;
  for (int i = 0; i < 3; ++i)
    if (std::abs(at(c, i)) >= at(h, i)) return right(q);
  int face = 0, nearest_face = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(at(c, i)) / at(h, i) > std::abs(at(c, face)) / at(h, face)) face = i;
    if (at(h, i) - std::abs(at(c, i)) < at(h, nearest_face) - std::abs(at(c, nearest_face))) nearest_face = i;
  }
  if (face == nearest_face) return right(q);
  const Vector normal = axes[face] * (at(c, face) < 0 ? 1.0 : -1.0);
  return {q.sphere.radius + at(h, face) - std::abs(at(c, face)), normal, q.sphere.center + normal * q.sphere.radius};
}

NEARMISS_MISTAKE(box_plane_penetration) {
  q.plane.offset = -q.plane.offset;
  return right(q);
}

NEARMISS_MISTAKE(box_box_projected_distance) {
  q.box1.center = in_float(q.box1.center);
  q.box2.center = in_float(q.box2.center);
  return right(q);
}

NEARMISS_MISTAKE(box_box_parallel_axis) {
  const Axes a1 = axes_of(q.box1.orientation), a2 = axes_of(q.box2.orientation);
  const auto a = right(q);
  if (!a.yes() || dot(a1[a.axis1], a2[a.axis2]) > 0) return a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::pair(i, j) > std::pair(a.axis1, a.axis2) && dot(a1[i], a2[j]) >= 1 - q.epsilon) return {true, i, j};
  return {};
}

NEARMISS_MISTAKE(slide_direction) {
  if (dot(q.velocity, q.velocity) < 1e-4 * 1e-4) return {};
  return right(q);
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-eleventh"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/eleventh.def"
#include "fuzz/planted/planted_offers.hpp"
