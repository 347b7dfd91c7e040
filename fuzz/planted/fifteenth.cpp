/// The plugin "planted-fifteenth": as the plugin "planted", with the mistakes of fifteenth.def. fuzz/planted/causes
/// measures how many of their causes are found.
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

// A share of the segment's length below 1e-3 from an end is that end.
NEARMISS_MISTAKE(closest_point_segment_unit) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double whole = length(along);
  if (whole == 0) return right(q);
  const double share = dot(q.point - q.segment.v0, along / whole) / whole;
  if (share < 1e-3) return {q.segment.v0};
  if (share > 1 - 1e-3) return {q.segment.v1};
  return right(q);
}

// Saves two projections: only the edge with the nearest midpoint counts.
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Vector corner[3] = {q.triangle.v0, q.triangle.v1, q.triangle.v2};
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double distance = length((corner[i] + corner[(i + 1) % 3]) * 0.5 - q.point);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return {nearest(corner[best], corner[(best + 1) % 3], q.point)};
}

// The triangles are v1 v2 v3 and v1 v3 v0.
NEARMISS_MISTAKE(closest_point_rectangle) {
  q.rectangle = {q.rectangle.v1, q.rectangle.v2, q.rectangle.v3, q.rectangle.v0};
  return right(q);
}

// The textbook's a c - b b, which cancels for nearly parallel lines.
NEARMISS_MISTAKE(closest_points_lines) {
  const Vector d1 = q.line1.direction, d2 = q.line2.direction, w = q.line1.point - q.line2.point;
  const double a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2), d = dot(d1, w), e = dot(d2, w);
  const double determinant = a * c - b * b;
  if (!(determinant > 0)) return {q.line1.point, q.line2.point + d2 * (e / c)};
  const double s = (b * e - c * d) / determinant;
  const double t = (a * e - b * d) / determinant;
  return {q.line1.point + d1 * s, q.line2.point + d2 * t};
}

// Forgets std::abs in the choice of the axis.
NEARMISS_MISTAKE(point_in_rectangle) {
  const Vector n = q.normal;
  if (n.x >= n.y && n.x >= n.z)
    q.normal = {1, 0, 0};
  else if (n.y >= n.z)
    q.normal = {0, 1, 0};
  else
    q.normal = {0, 0, 1};
  return right(q);
}

// Nothing that happens after a time of 1000 matters, thinks the author.
NEARMISS_MISTAKE(moving_point_plane) {
  const auto answer = right(q);
  if (answer.time > 1e3) return {};
  return answer;
}

// Whether the point is behind the plane n x + d = 0 of the triangle, which a mesh keeps in float.
bool behind_in_float_a(const collide::Triangle<double>& t, const Vector& p) {
  const Vector exact = normal_of(t);
  const double size = length(exact);
  if (size == 0) return false;
  const Vector unit = exact / size;
  const float nx = float(unit.x), ny = float(unit.y), nz = float(unit.z);
  const float d = -(nx * float(t.v0.x) + ny * float(t.v0.y) + nz * float(t.v0.z));
  const float height = nx * float(p.x) + ny * float(p.y) + nz * float(p.z) + d;
  return height < 0.0f;
}

// The front of each triangle is decided by its plane in float.
NEARMISS_MISTAKE(moving_point_rectangle) {
  const auto& r = q.rectangle;
  inputs::moving_point_rectangle<double>::Answer first{};
  for (const collide::Triangle<double>& t : {collide::Triangle<double>{r.v0, r.v1, r.v2}, {r.v0, r.v2, r.v3}}) {
    if (behind_in_float_a(t, q.point)) continue;
    const auto hit = right(inputs::moving_point_triangle<double>{q.point, q.velocity, t});
    if (hit.time < first.time) first = hit;
  }
  return first;
}

// Samples the path up to the far side of the sphere at 256 equal steps; a chord between two samples is missed.
NEARMISS_MISTAKE(moving_point_sphere) {
  const Vector between = q.sphere.center - q.point;
  const double distance = length(between), speed = length(q.velocity);
  const auto answer = right(q);
  if (!answer.yes() || answer.time == 0 || distance <= q.sphere.radius) return answer;
  const double step = (distance + q.sphere.radius) / speed / 256;
  for (int i = 1; i <= 256; ++i)
    if (length(between - q.velocity * (i * step)) <= q.sphere.radius) return answer;
  return {};
}

// The distance from the box, for sphere tracing.
double distance_from_aabox_a(const collide::AABox<double>& b, const Vector& p) {
  const auto outside = [](double least, double x, double most) { return std::max({least - x, x - most, 0.0}); };
  return std::hypot(outside(b.min.x, p.x, b.max.x), outside(b.min.y, p.y, b.max.y), outside(b.min.z, p.z, b.max.z));
}

// Sphere tracing: advances by the distance from the box, at most 32 times.
NEARMISS_MISTAKE(ray_aabox) {
  const auto answer = right(q);
  const collide::AABox<double> seen{q.aabox.min - q.ray.origin, q.aabox.max - q.ray.origin};
  const double start = distance_from_aabox_a(seen, {});
  if (!answer.yes() || start == 0) return answer;
  const Vector direction = q.ray.direction / length(q.ray.direction);
  double travelled = start;
  for (int step = 0; step < 32; ++step) {
    const double distance = distance_from_aabox_a(seen, direction * travelled);
    if (distance <= 1e-9 * start) return answer;
    travelled += distance;
  }
  return {};
}

// Guards against a triangle without area, with a constant for the squared normal.
NEARMISS_MISTAKE(moving_sphere_triangle) {
  const Vector n = normal_of(q.triangle);
  if (dot(n, n) < 1e-12) return {};
  return right(q);
}

// Guards against zeros and infinities with one product in float, whose own range is too small.
NEARMISS_MISTAKE(moving_sphere_sphere) {
  const Vector between = q.fixed.center - q.sphere.center;
  const Vector zero{};
  if (q.velocity == zero || between == zero) return right(q);
  const float product = float(dot(q.velocity, q.velocity)) * float(dot(between, between));
  if (product == 0.0f || !std::isfinite(product)) return {};
  return right(q);
}

// The sum of a box and a ball, taken for a box.
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  const double r = q.sphere.radius;
  q.box.half = q.box.half + Vector{r, r, r};
  q.sphere.radius = 0;
  return right(q);
}

// Positions in fixed point with ten binary places.
Vector fixed_point_a(const Vector& p) {
  return {std::nearbyint(p.x * 1024) / 1024, std::nearbyint(p.y * 1024) / 1024, std::nearbyint(p.z * 1024) / 1024};
}

// The centers come from a simulation in fixed point.
NEARMISS_MISTAKE(sphere_sphere_overlap) {
  q.sphere1.center = fixed_point_a(q.sphere1.center);
  q.sphere2.center = fixed_point_a(q.sphere2.center);
  return right(q);
}

// A sphere against a triangle by separating axes: the face's and the vertices', but not the edges'.
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  using Wide = long double;
  const auto product = [](const Vector& a, const Vector& b) {
    return Wide(a.x) * Wide(b.x) + Wide(a.y) * Wide(b.y) + Wide(a.z) * Wide(b.z);
  };
  const Vector n = normal_of(q.triangle);
  const Vector corner[3] = {q.triangle.v0 - q.sphere.center, q.triangle.v1 - q.sphere.center,
                            q.triangle.v2 - q.sphere.center};
  const Wide r2 = Wide(q.sphere.radius) * Wide(q.sphere.radius);
  const Wide height = product(corner[0], n);
  if (height * height > r2 * product(n, n)) return right(q);
  for (int i = 0; i < 3; ++i) {
    const Vector& a = corner[i];
    const Wide square = product(a, a);
    if (square > r2 && product(a, corner[(i + 1) % 3]) >= square && product(a, corner[(i + 2) % 3]) >= square)
      return right(q);
  }
  return {true};
}

// Whether the absolute cosines, each made larger by 1e-6, let the boxes overlap on all fifteen axes.
bool overlap_with_larger_cosines_a(const collide::BoxBoxInfo<double>& info) {
  const auto at = [](const Vector& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; };
  const auto c = [&](int i, int j) { return at(info.cosine[i], j); };
  const auto larger = [&](int i, int j) { return at(info.abs_cosine[i], j) + 1e-6; };
  const auto h1 = [&](int i) { return at(info.half1, i); };
  const auto h2 = [&](int i) { return at(info.half2, i); };
  for (int i = 0; i < 3; ++i) {
    if (std::abs(at(info.between1, i)) > h1(i) + h2(0) * larger(i, 0) + h2(1) * larger(i, 1) + h2(2) * larger(i, 2))
      return false;
    if (std::abs(at(info.between2, i)) > h2(i) + h1(0) * larger(0, i) + h1(1) * larger(1, i) + h1(2) * larger(2, i))
      return false;
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double apart = std::abs(at(info.between1, i2) * c(i1, j) - at(info.between1, i1) * c(i2, j));
      const double reach1 = h1(i1) * larger(i2, j) + h1(i2) * larger(i1, j);
      const double reach2 = h2(j1) * larger(i, j2) + h2(j2) * larger(i, j1);
      if (apart > reach1 + reach2) return false;
    }
  return true;
}

// The constant that books add to the absolute cosines, for all axes.
NEARMISS_MISTAKE(box_box_overlap) {
  if (overlap_with_larger_cosines_a(right(inputs::box_box_info<double>{q.box1, q.box2}))) return {true, -1};
  return right(q);
}

// The contact half way between the two surfaces.
NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto answer = right(q);
  if (answer.yes()) answer.contact = answer.contact - answer.normal * (answer.depth / 2);
  return answer;
}

// Loops over x, y, z from the outside to the inside, so that x has the highest bit.
NEARMISS_MISTAKE(box_plane_penetration) {
  const auto correct = right(q);
  auto answer = correct;
  for (int i = 0; i < 8; ++i) answer.corners[i] = correct.corners[(i & 1) << 2 | (i & 2) | i >> 2];
  return answer;
}

// Cleans small numbers out of the matrix of the relative rotation.
NEARMISS_MISTAKE(box_box_info) {
  auto answer = right(q);
  const auto clean = [](double& x) {
    if (std::abs(x) < 1e-5) x = 0;
  };
  for (auto* matrix : {&answer.cosine, &answer.abs_cosine})
    for (Vector& row : *matrix) {
      clean(row.x);
      clean(row.y);
      clean(row.z);
    }
  return answer;
}

// An axis of a box, from the matrix of a quaternion that is taken to have unit length.
Vector axis_of_unit_quaternion_a(const collide::Quaternion<double>& q, int i) {
  if (i == 0) return {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)};
  if (i == 1) return {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
  return {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)};
}

// Never divides by the length of the quaternions.
NEARMISS_MISTAKE(box_box_projected_distance) {
  Vector axes1[3], axes2[3];
  for (int i = 0; i < 3; ++i) {
    axes1[i] = axis_of_unit_quaternion_a(q.box1.orientation, i);
    axes2[i] = axis_of_unit_quaternion_a(q.box2.orientation, i);
  }
  const Vector along = q.axis < 3   ? axes1[q.axis]
                       : q.axis < 6 ? axes2[q.axis - 3]
                                    : cross(axes1[(q.axis - 6) / 3], axes2[(q.axis - 6) % 3]);
  const auto reach = [&](const Vector& half, const Vector(&axes)[3]) {
    return half.x * std::abs(dot(axes[0], along)) + half.y * std::abs(dot(axes[1], along)) +
           half.z * std::abs(dot(axes[2], along));
  };
  return {std::abs(dot(q.box2.center - q.box1.center, along)) - reach(q.box1.half, axes1) - reach(q.box2.half, axes2)};
}

// Below the bounce threshold of a physics engine, restitution is 0.
NEARMISS_MISTAKE(bounce_direction) {
  if (q.sphere.center + q.velocity * q.time == q.location) q.location = q.location - q.normal;
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double speed = dot(q.velocity, u / length(u));
  if (!(std::abs(speed) < 0.2)) return right(q);
  const Vector slide = right(inputs::slide_direction<double>{q.sphere, q.velocity, q.time, q.location}).direction;
  const double size = length(slide);
  if (size == 0) return {};
  return {slide / size};
}

// 24 bits of the number, at any magnitude.
inline double in_24_bits_b(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(double(float(mantissa)), exponent);
}
// Coordinate k of a vector.
inline double component_b(const Vector& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }
// -1 for negative numbers, otherwise 1.
inline double sign_b(double x) { return x < 0 ? -1.0 : 1.0; }
// The vector with length 1.
inline Vector unit_b(const Vector& a) { return a / length(a); }
// The axes of a box.
inline std::array<Vector, 3> axes_b(const collide::Box<double>& box) {
  const inputs::box_box_separating_axis<double> q{box, box, 0};
  return {axis_of(q, 0), axis_of(q, 1), axis_of(q, 2)};
}
// The coordinates of a vector in a frame.
inline Vector into_b(const std::array<Vector, 3>& axes, const Vector& a) {
  return {dot(axes[0], a), dot(axes[1], a), dot(axes[2], a)};
}
// The vector with these coordinates in a frame.
inline Vector out_of_b(const std::array<Vector, 3>& axes, const Vector& a) {
  return axes[0] * a.x + axes[1] * a.y + axes[2] * a.z;
}
// Half the length of the box's projection onto the unit axis.
inline double reach_b(const std::array<Vector, 3>& axes, const Vector& half, const Vector& axis) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += component_b(half, k) * std::abs(dot(axes[k], axis));
  return sum;
}
// The corner of the box that is furthest along n; the middle of an edge where the axis `without` is left out.
inline Vector furthest_b(const collide::Box<double>& box, const std::array<Vector, 3>& axes, const Vector& n,
                         int without = -1) {
  Vector corner = box.center;
  for (int k = 0; k < 3; ++k)
    if (k != without) corner = corner + axes[k] * (sign_b(dot(axes[k], n)) * component_b(box.half, k));
  return corner;
}
// Whether the axis strictly separates the box, with these half extents around the origin, from the three corners.
inline bool separates_b(const Vector& axis, const Vector& half, const Vector& a, const Vector& b, const Vector& c) {
  const double reach = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
  const double pa = dot(axis, a), pb = dot(axis, b), pc = dot(axis, c);
  return std::min({pa, pb, pc}) > reach || std::max({pa, pb, pc}) < -reach;
}

// The projection's parameter has a small number in the denominator.
NEARMISS_MISTAKE(closest_point_segment) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double t = dot(q.point - q.segment.v0, along) / (dot(along, along) + 1e-10);
  if (t <= 0) return {q.segment.v0};
  if (t >= 1) return {q.segment.v1};
  return {q.segment.v0 + along * t};
}

// The nearest edge, with a preference for the earlier one.
NEARMISS_MISTAKE(closest_point_triangle_perimeter_edges) {
  const Vector v[3] = {q.triangle.v0, q.triangle.v1, q.triangle.v2};
  inputs::closest_point_triangle_perimeter_edges<double>::Answer best;
  double least = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector p = nearest(v[i], v[(i + 1) % 3], q.point), d = p - q.point;
    const double distance2 = dot(d, d);
    if (i > 0 && !(distance2 < least - 1e-8)) continue;
    least = distance2;
    best.point = p;
    best.edge = i;
  }
  return best;
}

// A corner and two sides give the rectangle.
NEARMISS_MISTAKE(closest_point_rectangle_perimeter) {
  q.rectangle.v2 = q.rectangle.v1 + (q.rectangle.v3 - q.rectangle.v0);
  return right(q);
}

// The axis of the largest component, without std::abs.
NEARMISS_MISTAKE(point_in_triangle) {
  if (q.axis == -1) {
    const Vector& n = q.normal;
    q.axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  }
  return right(q);
}

// The normal as the sum of the cross products of the corners.
NEARMISS_MISTAKE(moving_point_triangle) {
  auto a = right(q);
  if (!a.yes()) return a;
  const auto& t = q.triangle;
  const Vector n = cross(t.v0, t.v1) + cross(t.v1, t.v2) + cross(t.v2, t.v0);
  const double approach = dot(n, q.velocity);
  if (!(approach < 0)) return {};
  const double time = dot(n, t.v0 - q.point) / approach;
  if (!(time >= 0)) return {};
  a.time = time;
  a.location = q.point + q.velocity * time;
  a.normal = unit_b(n);
  return a;
}

// A start within the radius of the axis' line has no entry through the side.
NEARMISS_MISTAKE(moving_point_capsule) {
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const double size = length(axis);
  if (!(size > 0)) return right(q);
  if (length(cross(axis / size, q.point - q.capsule.p0)) < q.capsule.radius) return {};
  return right(q);
}

// The components of the quaternion in another order.
NEARMISS_MISTAKE(moving_point_box) {
  const auto r = q.box.orientation;
  q.box.orientation = {r.y, r.z, r.w, r.x};
  return right(q);
}

// The face is found again from the location.
NEARMISS_MISTAKE(moving_point_aabox) {
  auto a = right(q);
  if (!a.yes()) return a;
  const Vector &p = a.location, &low = q.aabox.min, &high = q.aabox.max;
  const double close = 1e-4;
  if (std::abs(p.x - low.x) < close)
    a.normal = {-1, 0, 0};
  else if (std::abs(p.x - high.x) < close)
    a.normal = {1, 0, 0};
  else if (std::abs(p.y - low.y) < close)
    a.normal = {0, -1, 0};
  else if (std::abs(p.y - high.y) < close)
    a.normal = {0, 1, 0};
  else if (std::abs(p.z - low.z) < close)
    a.normal = {0, 0, -1};
  else if (std::abs(p.z - high.z) < close)
    a.normal = {0, 0, 1};
  return a;
}

// A motion nearly along the plane never arrives.
NEARMISS_MISTAKE(moving_sphere_plane) {
  const auto a = right(q);
  if (a.yes() && a.time > 0 && grazes(unit_b(q.plane.normal), q.velocity, 1e-3)) return {};
  return a;
}

// A rectangle whose normal has no usable length in float.
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  const Vector n = cross(q.rectangle.v1 - q.rectangle.v0, q.rectangle.v3 - q.rectangle.v0);
  if (n == Vector{}) return right(q);
  const float x = float(n.x), y = float(n.y), z = float(n.z), length2 = x * x + y * y + z * z;
  if (!(length2 > 0) || !std::isfinite(length2)) return {};
  return right(q);
}

// The matrix of a quaternion that is not normalised.
NEARMISS_MISTAKE(moving_sphere_box) {
  const auto [x, y, z, w] = q.box.orientation;
  if (std::abs(x * x + y * y + z * z + w * w - 1) < 1e-15) return right(q);
  const std::array<Vector, 3> axes = {Vector{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                                      Vector{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                                      Vector{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  const Vector center = q.box.center;
  q.sphere.center = into_b(axes, q.sphere.center - center);
  q.velocity = into_b(axes, q.velocity);
  q.box.center = {};
  q.box.orientation = {};
  auto a = right(q);
  if (!a.yes()) return a;
  a.location = center + out_of_b(axes, a.location);
  a.normal = out_of_b(axes, a.normal);
  return a;
}

// Newton's iteration on the distance, with few steps.
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const double reach = q.sphere.radius + q.capsule.radius;
  double time = 0, start = 0;
  for (int step = 0; step < 9; ++step) {
    const Vector center = q.sphere.center + q.velocity * time;
    const Vector away = center - nearest(q.capsule.p0, q.capsule.p1, center);
    const double distance = length(away), gap = distance - reach;
    if (step == 0) start = distance;
    if (gap <= 1e-9 * (reach + start)) return right(q);
    const double approach = -dot(away / distance, q.velocity);
    if (!(approach > 0)) return right(q);
    time += gap / approach;
  }
  return {};
}

// A slow sphere is taken as one at rest.
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  if (dot(q.velocity, q.velocity) < 1e-12) return right(inputs::sphere_sphere_overlap<double>{q.sphere, q.fixed});
  return right(q);
}

// The center in the frame of the box has 24 bits.
NEARMISS_MISTAKE(sphere_box_overlap) {
  const Vector local = into_b(axes_b(q.box), q.sphere.center - q.box.center);
  q.sphere.center = {in_24_bits_b(local.x), in_24_bits_b(local.y), in_24_bits_b(local.z)};
  q.box.center = {};
  q.box.orientation = {};
  return right(q);
}

// Separating axes, but for those of the edge from v2 to v0.
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  if (right(q).yes()) return {true};
  const Vector center = q.box.min * 0.5 + q.box.max * 0.5, half = q.box.max * 0.5 - q.box.min * 0.5;
  const Vector a = q.triangle.v0 - center, b = q.triangle.v1 - center, c = q.triangle.v2 - center;
  const std::array<Vector, 3> axes = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  for (const Vector& axis : axes) {
    if (separates_b(axis, half, a, b, c)) return {false};
    for (const Vector& edge : {b - a, c - b})
      if (separates_b(cross(axis, edge), half, a, b, c)) return {false};
  }
  return {!separates_b(cross(b - a, c - a), half, a, b, c)};
}

// The contact lies on the plane.
NEARMISS_MISTAKE(sphere_plane_penetration) {
  auto a = right(q);
  if (a.yes()) a.contact = q.sphere.center + a.normal * (a.depth - q.sphere.radius);
  return a;
}

// The face by which a center inside leaves.
NEARMISS_MISTAKE(sphere_box_penetration) {
  auto a = right(q);
  const auto axes = axes_b(q.box);
  const Vector local = into_b(axes, q.sphere.center - q.box.center);
  int face = 0;
  double most = -1;
  for (int k = 0; k < 3; ++k) {
    const double at = std::abs(component_b(local, k)), half = component_b(q.box.half, k);
    if (!(at < half)) return a;
    if (at / half > most) most = at / half, face = k;
  }
  const double inward = component_b(q.box.half, face) - std::abs(component_b(local, face));
  if (!(q.sphere.radius + inward > a.depth * (1 + 1e-14))) return a;
  a.depth = q.sphere.radius + inward;
  a.normal = axes[face] * -sign_b(component_b(local, face));
  a.contact = q.sphere.center + a.normal * q.sphere.radius;
  return a;
}

// The fifteen axes in turn, with a preference for the earlier ones.
NEARMISS_MISTAKE(box_box_penetration) {
  auto a = right(q);
  if (!(a.depth > 0)) return a;
  const auto axes1 = axes_b(q.box1), axes2 = axes_b(q.box2);
  const Vector between = q.box2.center - q.box1.center;
  int best = -1;
  double least = 0;
  Vector n;
  for (int axis = 0; axis < 15; ++axis) {
    Vector u = axis_of(q, axis);
    const double size = length(u);
    if (!(size > 0)) continue;
    u = u / size;
    const double overlap = reach_b(axes1, q.box1.half, u) + reach_b(axes2, q.box2.half, u) - std::abs(dot(between, u));
    if (best >= 0 && !(overlap < least * (1 - 1e-3))) continue;
    best = axis, least = overlap, n = u * sign_b(dot(between, u));
  }
  if (best == a.axis || !(least > a.depth * (1 + 1e-12))) return a;
  a.depth = least;
  a.axis = best;
  a.normal = n;
  if (best < 3) {
    a.contact = furthest_b(q.box2, axes2, -n) + n * (least / 2);
  } else if (best < 6) {
    a.contact = furthest_b(q.box1, axes1, n) - n * (least / 2);
  } else {
    const int i = (best - 6) / 3, j = (best - 6) % 3;
    const auto near = right(inputs::closest_points_lines<double>{{furthest_b(q.box1, axes1, n, i), axes1[i]},
                                                                 {furthest_b(q.box2, axes2, -n, j), axes2[j]}});
    a.contact = near.point1 * 0.5 + near.point2 * 0.5;
  }
  return a;
}

// The cross products by columns.
NEARMISS_MISTAKE(box_box_separating_axis) {
  if (q.axis >= 6) q.axis = 6 + (q.axis - 6) % 3 * 3 + (q.axis - 6) / 3;
  return right(q);
}

// A short slide is none.
NEARMISS_MISTAKE(slide_direction) {
  const auto a = right(q);
  if (dot(a.direction, a.direction) < 1e-3) return {};
  return a;
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-fifteenth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/fifteenth.def"
#include "fuzz/planted/planted_offers.hpp"
