/// The plugin "planted-thirteenth": as the plugin "planted", with the mistakes of thirteenth.def. fuzz/planted/causes
/// measures how many of their causes are found.
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

double square(const Vector& a) { return dot(a, a); }

double component(const Vector& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

Vector axis_of_box(const collide::Box<double>& box, int k) {
  return right(inputs::box_box_separating_axis<double>{box, box, k}).direction;
}

// Float for double: the prepared unit direction is stored in float.
NEARMISS_MISTAKE(closest_point_segment_unit) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double len = length(along);
  if (!(len > 0)) return right(q);
  const Vector direction = in_float(along / len);
  const double t = dot(q.point - q.segment.v0, direction);
  if (t <= 0) return {q.segment.v0};
  if (t >= len) return {q.segment.v1};
  return {q.segment.v0 + direction * t};
}

// Edge i is the one opposite to corner i.
NEARMISS_MISTAKE(closest_point_triangle_perimeter_edges) {
  auto a = right(q);
  a.edge = (a.edge + 2) % 3;
  return a;
}

double distance_from_line(const Vector& a, const Vector& b, const Vector& p) {
  const double len = length(b - a);
  return len > 0 ? length(cross(p - a, (b - a) / len)) : length(p - a);
}

// The nearest edge is the one whose infinite line is nearest.
NEARMISS_MISTAKE(closest_point_rectangle_perimeter) {
  const Vector v[4] = {q.rectangle.v0, q.rectangle.v1, q.rectangle.v2, q.rectangle.v3};
  int best = 0;
  double least = INFINITY;
  for (int i = 0; i < 4; ++i) {
    const double d = distance_from_line(v[i], v[(i + 1) % 4], q.point);
    if (d < least) {
      least = d;
      best = i;
    }
  }
  return {nearest(v[best], v[(best + 1) % 4], q.point)};
}

double side(double ax, double ay, double bx, double by, double px, double py) {
  return (bx - ax) * (py - ay) - (by - ay) * (px - ax);
}

bool weights_allow(const Vector& a, const Vector& b, const Vector& c, const Vector& p, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto edge = [&](const Vector& s, const Vector& t, const Vector& w) {
    return side(component(s, u), component(s, v), component(t, u), component(t, v), component(w, u), component(w, v));
  };
  const double area = edge(a, b, c);
  // A triangle without a reliable area is left to the right answer.
  if (!(std::abs(area) > 1e-8 * length(b - a) * length(c - a))) return false;
  return edge(a, b, p) / area >= -1e-6 && edge(b, c, p) / area >= -1e-6 && edge(c, a, p) / area >= -1e-6;
}

// Barycentric weights down to -1e-6 are inside.
NEARMISS_MISTAKE(point_in_rectangle) {
  auto a = right(q);
  if (a.decision) return a;
  const Vector n{std::abs(q.normal.x), std::abs(q.normal.y), std::abs(q.normal.z)};
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  a.decision = weights_allow(q.rectangle.v0, q.rectangle.v1, q.rectangle.v2, q.point, axis) ||
               weights_allow(q.rectangle.v0, q.rectangle.v2, q.rectangle.v3, q.point, axis);
  return a;
}

// A small determinant counts as a parallel motion.
NEARMISS_MISTAKE(moving_point_triangle) {
  const double determinant = -dot(normal_of(q.triangle), q.velocity);
  if (determinant > -1e-6 && determinant < 1e-6) return {};
  return right(q);
}

// The discriminant of the textbook: b^2 - 4ac.
NEARMISS_MISTAKE(moving_point_sphere) {
  const double r = q.sphere.radius;
  if (r == 0 || right(inputs::sphere_sphere_overlap<double>{{q.point, 0}, q.sphere}).decision) return right(q);
  const Vector m = q.point - q.sphere.center;
  const double distance = length(m), speed = length(q.velocity);
  // Where products would leave the range of double, the answer is right.
  for (double x : {distance, speed, distance * speed})
    if (!(x > 1e-70 && x < 1e70)) return right(q);
  const double a = square(q.velocity), b = 2 * dot(m, q.velocity), c = square(m) - r * r;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return {};
  const double t = (-b - std::sqrt(discriminant)) / (2 * a);
  if (t < 0) return {};
  const Vector at = q.point + q.velocity * t;
  const Vector out = at - q.sphere.center;
  const double len = length(out);
  if (!(len > 0)) return right(q);
  return {t, at, out / len};
}

// The quaternion's numbers are read as w, x, y, z.
NEARMISS_MISTAKE(moving_point_box) {
  const auto o = q.box.orientation;
  q.box.orientation.w = o.x;
  q.box.orientation.x = o.y;
  q.box.orientation.y = o.z;
  q.box.orientation.z = o.w;
  return right(q);
}

// A flat box counts as empty.
NEARMISS_MISTAKE(ray_aabox) {
  if (q.aabox.min.x >= q.aabox.max.x || q.aabox.min.y >= q.aabox.max.y || q.aabox.min.z >= q.aabox.max.z) return {};
  return right(q);
}

// The normal is taken to have unit length.
NEARMISS_MISTAKE(moving_sphere_plane) {
  const Vector n = q.plane.normal;
  const double r = q.sphere.radius;
  if (std::abs(length(n) - 1) < 1e-12) return right(q);
  const double approach = dot(n, q.velocity), height = dot(n, q.sphere.center) + q.plane.offset;
  if (approach > 0 || height < -r) return {};
  if (height <= r) return {0, q.sphere.center - n * height, n};
  if (approach == 0) return {};
  const double t = (r - height) / approach;
  return {t, q.sphere.center + q.velocity * t - n * r, n};
}

// Conservative advancement gives up after 32 steps.
NEARMISS_MISTAKE(moving_sphere_sphere) {
  const auto a = right(q);
  if (!a.yes() || a.time == 0) return a;
  const double reach = q.sphere.radius + q.fixed.radius, speed = length(q.velocity);
  const Vector between = q.sphere.center - q.fixed.center;
  const double close = 1e-9 * std::max(reach, length(between));
  double t = 0;
  for (int step = 0; step < 32; ++step) {
    const double gap = length(between + q.velocity * t) - reach;
    if (gap <= close) return a;
    t += gap / speed;
  }
  return {};
}

// Motions nearly along the axis are tested against the two end balls only.
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const double len = length(axis), speed = length(q.velocity);
  if (!(len > 0 && speed > 0)) return right(q);
  if (square(cross(axis / len, q.velocity / speed)) >= 1e-4) return right(q);
  // A start in contact is treated before, and rightly.
  const Vector near = nearest(q.capsule.p0, q.capsule.p1, q.sphere.center);
  if (length(q.sphere.center - near) <= (q.sphere.radius + q.capsule.radius) * (1 + 1e-12)) return right(q);
  const auto a = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p0, q.capsule.radius}});
  const auto b = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p1, q.capsule.radius}});
  return b.time < a.time ? b : a;
}

// The limit is a distance: the velocity is normalised.
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  const double speed = length(q.velocity);
  if (q.forever || !(speed > 0)) return right(q);
  q.velocity = q.velocity / speed;
  return right(q);
}

// The box grows by the radius and keeps its square corners.
NEARMISS_MISTAKE(sphere_box_overlap) {
  auto a = right(q);
  if (a.decision) return a;
  const Vector between = q.sphere.center - q.box.center;
  a.decision = true;
  for (int k = 0; k < 3; ++k)
    if (std::abs(dot(between, axis_of_box(q.box, k))) > component(q.box.half, k) + q.sphere.radius) a.decision = false;
  return a;
}

// The squared height above the face, times the squared normal, is a length^6 that is kept in a float.
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  const auto& t = q.triangle;
  const Vector n = normal_of(t), to = q.sphere.center - t.v0;
  const double height = dot(n, to);
  const float squared = float(height * height);
  // Within the range of float, and where the foot is not in the triangle, the answer is right.
  if (height == 0 || (squared > 0 && !std::isinf(squared))) return right(q);
  if (dot(cross(t.v1 - t.v0, to), n) < 0 || dot(cross(t.v2 - t.v1, q.sphere.center - t.v1), n) < 0 ||
      dot(cross(t.v0 - t.v2, q.sphere.center - t.v2), n) < 0)
    return right(q);
  return {squared == 0.0f};
}

// The plane's back is treated as its front.
NEARMISS_MISTAKE(sphere_plane_penetration) {
  if (dot(q.plane.normal, q.sphere.center) + q.plane.offset < 0) {
    q.plane.normal = -q.plane.normal;
    q.plane.offset = -q.plane.offset;
  }
  return right(q);
}

// Corners within 1e-4 of the plane are contacts too.
NEARMISS_MISTAKE(box_plane_penetration) {
  auto a = right(q);
  if (!a.yes()) return a;
  const double len = length(q.plane.normal);
  const Vector n = q.plane.normal / len;
  for (int i = 0; i < 8; ++i) {
    if (a.corners[i].behind) continue;
    Vector corner = q.box.center;
    for (int k = 0; k < 3; ++k) {
      const double half = component(q.box.half, k);
      corner = corner + axis_of_box(q.box, k) * (i >> k & 1 ? half : -half);
    }
    if (dot(n, corner) + q.plane.offset / len <= 1e-4) a.corners[i] = {true, corner};
  }
  return a;
}

// The middle of the edges of both boxes that reach furthest along the normal.
Vector edge_contact(const collide::Box<double>& box1, const collide::Box<double>& box2, int i, int j, const Vector& n) {
  Vector p = box1.center, r = box2.center;
  for (int k = 0; k < 3; ++k) {
    const Vector a = axis_of_box(box1, k), b = axis_of_box(box2, k);
    if (k != i) p = p + a * std::copysign(component(box1.half, k), dot(a, n));
    if (k != j) r = r - b * std::copysign(component(box2.half, k), dot(b, n));
  }
  const Vector a = axis_of_box(box1, i), b = axis_of_box(box2, j);
  const auto c = right(inputs::closest_points_lines<double>{{p, a}, {r, b}});
  return (c.point1 + c.point2) / 2.0;
}

// Overlaps along cross products are not divided by the length of the axis.
NEARMISS_MISTAKE(box_box_penetration) {
  auto a = right(q);
  double face = -INFINITY, edge = -INFINITY;
  int axis = -1;
  for (int k = 0; k < 15; ++k) {
    if (axis_of(q, k) == Vector{}) continue;
    const double gap = right(inputs::box_box_projected_distance<double>{q.box1, q.box2, k}).value;
    if (k < 6) {
      face = std::max(face, gap);
    } else if (gap > edge) {
      edge = gap;
      axis = k;
    }
  }
  if (axis < 0 || !(edge > face + 1e-9 * std::abs(face))) return a;
  a.axis = axis;
  if (!a.yes()) {
    if (edge > 0) a.depth = -edge;
    return a;
  }
  a.depth = std::max(-edge, 0.0);
  a.normal = axis_of(q, axis);
  a.normal = a.normal / length(a.normal);
  if (dot(a.normal, q.box2.center - q.box1.center) < 0) a.normal = -a.normal;
  a.contact = edge_contact(q.box1, q.box2, (axis - 6) / 3, (axis - 6) % 3, a.normal);
  return a;
}

// A short cross product counts as zero.
NEARMISS_MISTAKE(box_box_separating_axis) {
  const auto a = right(q);
  if (q.axis >= 6 && square(a.direction) < 1e-8) return {};
  return a;
}

// Newton's iteration, which starts at 1: 16 steps are enough for boxes of a usual size.
double newton_root(double x) {
  double root = 1;
  for (int step = 0; step < 16; ++step) root = (root + x / root) / 2;
  return root;
}

// The half diagonals come from a square root that gives up.
NEARMISS_MISTAKE(box_box_conservative) {
  auto a = right(q);
  if (a.decision) return a;
  const auto diagonal = [](const Vector& half) { return half == Vector{} ? 0.0 : newton_root(square(half)); };
  a.decision = length(q.box2.center - q.box1.center) <= diagonal(q.box1.half) + diagonal(q.box2.half);
  return a;
}

// A short vector to the center counts as zero.
NEARMISS_MISTAKE(slide_direction) {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double speed = length(q.velocity);
  if (square(u) < 1e-12 && speed > 0) return {q.velocity / speed};
  return right(q);
}

// Mistakes planted in twenty queries.

using Corners = std::array<Vector, 3>;

inline Vector unit_of(const Vector& a) { return a / length(a); }

// The parameter along the segment goes through a float.
NEARMISS_MISTAKE(closest_point_segment) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  if (!(size > 0)) return right(q);
  const float t = float(dot(q.point - q.segment.v0, along / size) / size);
  if (t <= 0) return {q.segment.v0};
  if (t >= 1) return {q.segment.v1};
  return {q.segment.v0 + along * double(t)};
}

// Selects the edge whose infinite line is nearest, and only then clamps to the edge.
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Corners v = {q.triangle.v0, q.triangle.v1, q.triangle.v2};
  double least = std::numeric_limits<double>::infinity();
  int best = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector edge = v[(i + 1) % 3] - v[i], w = q.point - v[i];
    const double size = length(edge);
    const double distance = size > 0 ? length(cross(edge / size, w)) : length(w);
    if (distance < least) least = distance, best = i;
  }
  return {nearest(v[best], v[(best + 1) % 3], q.point)};
}

// Takes the four corners in the order of a triangle strip: the triangles v0 v1 v2 and v1 v2 v3.
NEARMISS_MISTAKE(closest_point_rectangle) {
  std::swap(q.rectangle.v0, q.rectangle.v1);
  return right(q);
}

// Lines with a cosine within 1e-4 of 1 count as parallel.
NEARMISS_MISTAKE(closest_points_lines) {
  const Vector u1 = unit_of(q.line1.direction), u2 = unit_of(q.line2.direction);
  if (std::abs(dot(u1, u2)) > 1 - 1e-4) {
    return {q.line1.point, q.line2.point + u2 * dot(q.line1.point - q.line2.point, u2)};
  }
  return right(q);
}

// Projects along the largest component of the normal, without the absolute value.
NEARMISS_MISTAKE(point_in_triangle) {
  if (q.axis < 0) {
    q.axis = 0;
    if (q.normal.y > component(q.normal, q.axis)) q.axis = 1;
    if (q.normal.z > component(q.normal, q.axis)) q.axis = 2;
  }
  return right(q);
}

// A ray ends after 10000 units.
NEARMISS_MISTAKE(moving_point_plane) {
  const double max_distance = 10000;
  const auto a = right(q);
  if (a.yes() && a.time * length(q.velocity) > max_distance) return {};
  return a;
}

// Barycentric weights down to -0.01 count as inside.
NEARMISS_MISTAKE(moving_point_rectangle) {
  constexpr double slack = 0.01;
  auto best = right(q);
  const auto& r = q.rectangle;
  for (const Corners& v : {Corners{r.v0, r.v1, r.v2}, Corners{r.v0, r.v2, r.v3}}) {
    const Vector e1 = v[1] - v[0], e2 = v[2] - v[0], n = cross(e1, e2), w = q.point - v[0];
    const double size = length(n), height = dot(n, w), approach = -dot(n, q.velocity);
    if (!(size > 1e-8 * length(e1) * length(e2)) || !(approach > 0) || !(height >= 0)) continue;
    const double time = height / approach;
    const Vector on_plane = w + q.velocity * time;
    const double b1 = dot(n, cross(on_plane, e2)) / size / size, b2 = dot(n, cross(e1, on_plane)) / size / size;
    const double least = std::min({1 - b1 - b2, b1, b2});
    if (least < -1e-12 && least >= -slack && time < best.time) best = {time, v[0] + on_plane, n / size};
  }
  return best;
}

// Marches along the ray by the distance from the capsule, and gives up after 256 steps.
NEARMISS_MISTAKE(moving_point_capsule) {
  const auto a = right(q);
  if (!a.yes() || !(a.time > 0)) return a;
  const auto& c = q.capsule;
  const Vector start = q.point - c.p0, axis = c.p1 - c.p0, step = unit_of(q.velocity);
  const double converged = 1e-9 * (length(start) + length(axis) + c.radius);
  double travelled = 0;
  for (int i = 0; i < 256; ++i) {
    const Vector at = start + step * travelled;
    const double distance = length(at - nearest({}, axis, at)) - c.radius;
    if (distance <= converged) return a;
    travelled += distance;
  }
  return {};
}

// The normal is that of the largest component of location - center, not divided by the half extents.
NEARMISS_MISTAKE(moving_point_aabox) {
  auto a = right(q);
  if (!a.yes()) return a;
  const Vector from = a.location - (q.aabox.min * 0.5 + q.aabox.max * 0.5);
  const double x = std::abs(from.x), y = std::abs(from.y), z = std::abs(from.z);
  if (x >= y && x >= z) {
    a.normal = {std::copysign(1.0, from.x), 0, 0};
  } else if (y >= z) {
    a.normal = {0, std::copysign(1.0, from.y), 0};
  } else {
    a.normal = {0, 0, std::copysign(1.0, from.z)};
  }
  return a;
}

// Gives the barycentric weights in the order u, v, 1 - u - v: of v1, v2, v0.
NEARMISS_MISTAKE(moving_sphere_triangle) {
  auto a = right(q);
  a.weights = {a.weights.y, a.weights.z, a.weights.x};
  return a;
}

// Ignores v3: the fourth corner is that of the parallelogram of the other three.
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  q.rectangle.v3 = q.rectangle.v0 + (q.rectangle.v2 - q.rectangle.v1);
  return right(q);
}

// Adds a collision margin of 0.04 to the sphere.
NEARMISS_MISTAKE(moving_sphere_box) {
  q.sphere.radius += 0.04;
  return right(q);
}

// Tests the overlap at 17 places of the path, and nothing between them.
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  const double speed = length(q.velocity);
  const auto a = right(q);
  if (!a.yes() || !(speed > 0)) return a;
  const double past = (length(q.sphere.center - q.box.center) + length(q.box.half) + q.sphere.radius) / speed;
  if (!std::isfinite(past)) return a;
  const double until = q.forever ? past : std::min(q.limit, past);
  for (int i = 0; i <= 16; ++i) {
    auto moved = q.sphere;
    moved.center = q.sphere.center + q.velocity * (until * (i / 16.0));
    if (right(inputs::sphere_box_overlap<double>{moved, q.box}).yes()) return a;
  }
  return {};
}

// The squared distance is expanded, |a|^2 + |b|^2 - 2 a.b: it cancels far from the origin.
NEARMISS_MISTAKE(sphere_sphere_overlap) {
  const Vector &a = q.sphere1.center, &b = q.sphere2.center;
  const double distance2 = dot(a, a) + dot(b, b) - 2 * dot(a, b);
  const double reach = q.sphere1.radius + q.sphere2.radius;
  return {distance2 <= reach * reach};
}

// Adds 1e-3 to the absolute cosines of all pairs of axes, against null cross products.
NEARMISS_MISTAKE(box_box_overlap) {
  constexpr double epsilon = 1e-3;
  const auto a = right(q);
  if (a.yes()) return a;
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  double c[3][3], absolute[3][3], d1[3], d2[3], h1[3], h2[3];
  for (int i = 0; i < 3; ++i) {
    d1[i] = component(info.between1, i), d2[i] = component(info.between2, i);
    h1[i] = component(q.box1.half, i), h2[i] = component(q.box2.half, i);
    for (int j = 0; j < 3; ++j) c[i][j] = component(info.cosine[i], j), absolute[i][j] = std::abs(c[i][j]) + epsilon;
  }
  for (int i = 0; i < 3; ++i) {
    double reach1 = h1[i], reach2 = h2[i];
    for (int j = 0; j < 3; ++j) reach1 += h2[j] * absolute[i][j], reach2 += h1[j] * absolute[j][i];
    if (std::abs(d1[i]) > reach1 || std::abs(d2[i]) > reach2) return a;
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double reach =
          h1[i1] * absolute[i2][j] + h1[i2] * absolute[i1][j] + h2[j1] * absolute[i][j2] + h2[j2] * absolute[i][j1];
      if (std::abs(d1[i2] * c[i1][j] - d1[i1] * c[i2][j]) > reach) return a;
    }
  }
  return {true, -1};
}

// An early way out compares (n.d)^2 / n.n with the box's bounding sphere in float: the squares leave its range.
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  const Vector n = normal_of(q.triangle);
  if (!(length(n) > 0)) return right(q);
  const Vector center = q.box.min * 0.5 + q.box.max * 0.5;
  const float height = float(dot(n, center - q.triangle.v0));
  const float distance2 = height * height / float(dot(n, n));
  if (!(distance2 <= std::numeric_limits<float>::max())) return {};  // finite: decides rightly
  return right(q);
}

// The contact is the middle of the overlap, not the surface point of sphere 1.
NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto a = right(q);
  if (a.yes()) a.contact = q.sphere1.center + a.normal * (q.sphere1.radius - 0.5 * a.depth);
  return a;
}

// A center whose squared distance from the box is at most 1e-6 counts as inside.
NEARMISS_MISTAKE(sphere_box_penetration) {
  const Vector from = q.sphere.center - q.box.center;
  Vector axes[3];
  double local[3], half[3], outside2 = 0;
  int face = 0;
  for (int k = 0; k < 3; ++k) {
    axes[k] = axis_of(inputs::box_box_overlap<double>{q.box, q.box}, k);
    local[k] = dot(from, axes[k]), half[k] = component(q.box.half, k);
    const double excess = std::max(0.0, std::abs(local[k]) - half[k]);
    outside2 += excess * excess;
    if (half[k] - std::abs(local[k]) < half[face] - std::abs(local[face])) face = k;
  }
  if (!(outside2 > 0) || outside2 > 1e-6) return right(q);
  const double depth = q.sphere.radius + half[face] - std::abs(local[face]);
  if (depth < 0) return {depth};
  const Vector normal = axes[face] * -std::copysign(1.0, local[face]);
  return {depth, normal, q.sphere.center + normal * q.sphere.radius};
}

// Divides by the length of the axis: the distance in space.
NEARMISS_MISTAKE(box_box_projected_distance) {
  auto a = right(q);
  const double size = length(axis_of(q, q.axis));
  if (q.axis >= 6 && size > 0) a.value /= size;
  return a;
}

// A contact earlier than 1e-3 counts as a contact at the start.
NEARMISS_MISTAKE(bounce_direction) {
  if (std::abs(q.time) < 1e-3) q.time = 0;
  return right(q);
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-thirteenth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/thirteenth.def"
#include "fuzz/planted/planted_offers.hpp"
