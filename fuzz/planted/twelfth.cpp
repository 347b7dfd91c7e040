/// The plugin "planted-twelfth": as the plugin "planted", with the mistakes of twelfth.def. fuzz/planted/causes
/// measures how many of their causes are found.
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

inline double component(const Vector& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

inline Vector axis_of_box(const collide::Box<double>& box, int k) {
  return right(inputs::box_box_separating_axis<double>{box, box, k}).direction;
}

/// The coordinates of a point in the box's frame.
struct Frame {
  Vector center, x, y, z;
  explicit Frame(const collide::Box<double>& box)
      : center(box.center), x(axis_of_box(box, 0)), y(axis_of_box(box, 1)), z(axis_of_box(box, 2)) {}
  Vector local(const Vector& p) const {
    const Vector d = p - center;
    return {dot(d, x), dot(d, y), dot(d, z)};
  }
};

// A foot close to an end snaps to that end, so that callers see a vertex.
NEARMISS_MISTAKE(closest_point_segment) {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  const double t = dot(q.point - q.segment.v0, along / size) / size;
  if (t < 1e-4) return {q.segment.v0};
  if (t > 1 - 1e-4) return {q.segment.v1};
  return right(q);
}

inline double distance_from_line(const Vector& a, const Vector& b, const Vector& p) {
  const Vector along = b - a;
  const double size = length(along);
  if (size == 0) return length(p - a);
  return length(cross(p - a, along / size));
}

// The nearest of the three endless lines, instead of the nearest of the three edges.
NEARMISS_MISTAKE(closest_point_triangle_perimeter) {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2};
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double distance = distance_from_line(corners[i], corners[(i + 1) % 3], q.point);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return {nearest(corners[best], corners[(best + 1) % 3], q.point)};
}

// A corner and two edges: the third corner follows from the others.
NEARMISS_MISTAKE(closest_point_rectangle) {
  q.rectangle.v2 = q.rectangle.v1 + (q.rectangle.v3 - q.rectangle.v0);
  return right(q);
}

// The largest component of the normal, with its sign.
NEARMISS_MISTAKE(point_in_triangle) {
  if (q.axis == -1) {
    q.axis = 0;
    if (q.normal.y > q.normal.x) q.axis = 1;
    if (q.normal.z > component(q.normal, q.axis)) q.axis = 2;
  }
  return right(q);
}

// Nothing is that far away.
NEARMISS_MISTAKE(moving_point_plane) {
  const auto hit = right(q);
  if (hit.time * length(q.velocity) > 1e4) return {};
  return hit;
}

// Moeller and Trumbore's test for a ray in the triangle's plane.
NEARMISS_MISTAKE(moving_point_triangle) {
  const double determinant = -dot(normal_of(q.triangle), q.velocity);
  if (determinant < 1e-8) return {};
  return right(q);
}

// The products of the discriminant do not fit in a float: infinity minus infinity is no number, and no hit.
NEARMISS_MISTAKE(moving_point_capsule) {
  const auto hit = right(q);
  if (!hit.yes()) return hit;
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const Vector from = q.point - q.capsule.p0;
  const double axis2 = dot(axis, axis);
  const double a = axis2 * dot(q.velocity, q.velocity) - dot(axis, q.velocity) * dot(axis, q.velocity);
  const double b = axis2 * dot(from, q.velocity) - dot(axis, from) * dot(axis, q.velocity);
  const double c = axis2 * (dot(from, from) - q.capsule.radius * q.capsule.radius) - dot(axis, from) * dot(axis, from);
  if (std::isnan(float(b * b) - float(a * c))) return {};
  return hit;
}

// The face on which the location lies, found as if all faces had the same distance from the center.
NEARMISS_MISTAKE(moving_point_aabox) {
  auto hit = right(q);
  if (!hit.yes()) return hit;
  const Vector& low = q.aabox.min;
  const Vector& high = q.aabox.max;
  const Vector from = hit.location - (low * 0.5 + high * 0.5);
  const double grid = 1e-14 * (length(low) + length(high));
  const int entered = hit.normal.x != 0 ? 0 : hit.normal.y != 0 ? 1 : 2;
  int face = entered;
  double most = std::abs(component(from, entered)) + grid;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(component(from, k)) <= most) continue;
    most = std::abs(component(from, k));
    face = k;
  }
  if (face == entered) return hit;
  const double sign = component(from, face) < 0 ? -1 : 1;
  hit.normal = {face == 0 ? sign : 0.0, face == 1 ? sign : 0.0, face == 2 ? sign : 0.0};
  return hit;
}

// The time from the heights at the start and the end of the step.
NEARMISS_MISTAKE(moving_sphere_plane) {
  const auto hit = right(q);
  if (!hit.yes() || hit.time == 0) return hit;
  const double size = length(q.plane.normal);
  const Vector normal = q.plane.normal / size;
  const double offset = q.plane.offset / size;
  const double start = dot(normal, q.sphere.center) + offset;
  const double end = dot(normal, q.sphere.center + q.velocity) + offset;
  if (!(end < start)) return {};
  const double time = std::max(0.0, (start - q.sphere.radius) / (start - end));
  return {time, q.sphere.center + q.velocity * time - normal * q.sphere.radius, hit.normal};
}

// The second triangle counts only if the first is not hit.
NEARMISS_MISTAKE(moving_sphere_rectangle) {
  const auto& r = q.rectangle;
  const auto first = right(inputs::moving_sphere_triangle<double>{q.sphere, q.velocity, {r.v0, r.v1, r.v2}});
  if (first.yes()) return {first.time, first.location, first.normal};
  const auto second = right(inputs::moving_sphere_triangle<double>{q.sphere, q.velocity, {r.v0, r.v2, r.v3}});
  return {second.time, second.location, second.normal};
}

// Advances by the distance over the speed, but for 200 steps only: a grazing approach needs more.
NEARMISS_MISTAKE(moving_sphere_box) {
  const auto hit = right(q);
  if (!hit.yes() || hit.time == 0) return hit;
  const Frame frame(q.box);
  const double speed = length(q.velocity);
  const double grid = 1e-13 * (length(q.sphere.center) + length(q.box.center) + length(q.box.half) + q.sphere.radius);
  double time = 0, first = 0;
  for (int step = 0; step < 200; ++step) {
    const Vector p = frame.local(q.sphere.center + q.velocity * time);
    const Vector out{std::max(0.0, std::abs(p.x) - q.box.half.x), std::max(0.0, std::abs(p.y) - q.box.half.y),
                     std::max(0.0, std::abs(p.z) - q.box.half.z)};
    const double gap = length(out) - q.sphere.radius;
    if (step == 0) first = gap;
    if (gap <= 1e-5 * first + grid) return hit;
    time += gap / speed;
  }
  return {};
}

// Unit speed and unit size, and then a quadratic equation in float.
NEARMISS_MISTAKE(moving_sphere_passes_sphere) {
  const Vector between = q.fixed.center - q.sphere.center;
  const double radii = q.sphere.radius + q.fixed.radius;
  const double size = std::max(length(between), radii);
  const double speed = length(q.velocity);
  if (!(size > 0)) return right(q);
  const Vector to = in_float(between / size);
  const float r = float(radii / size);
  const float c = float(to.x) * float(to.x) + float(to.y) * float(to.y) + float(to.z) * float(to.z) - r * r;
  if (c <= 0) return {true};
  if (!(speed > 0)) return {false};
  const Vector along = in_float(q.velocity / speed);
  const float b = float(to.x) * float(along.x) + float(to.y) * float(along.y) + float(to.z) * float(along.z);
  const float discriminant = b * b - c;
  if (b < 0 || discriminant < 0) return {false};
  return {q.forever || double(b - std::sqrt(discriminant)) <= q.limit * speed / size};
}

// The square of a sum is not the sum of the squares.
NEARMISS_MISTAKE(sphere_sphere_overlap) {
  q.sphere1.radius = std::hypot(q.sphere1.radius, q.sphere2.radius);
  q.sphere2.radius = 0;
  return right(q);
}

// The usual test of fifteen axes, with an epsilon on the absolute cosines against parallel edges.
NEARMISS_MISTAKE(box_box_overlap) {
  const auto apart = right(q);
  if (apart.yes()) return apart;
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  const auto cosine = [&](int i, int j) { return component(info.cosine[std::size_t(i % 3)], j % 3); };
  const auto wide = [&](int i, int j) { return std::abs(cosine(i, j)) + 1e-4; };
  const auto h1 = [&](int i) { return component(info.half1, i % 3); };
  const auto h2 = [&](int j) { return component(info.half2, j % 3); };
  const auto d1 = [&](int i) { return component(info.between1, i % 3); };
  for (int i = 0; i < 3; ++i) {
    if (std::abs(d1(i)) > h1(i) + h2(0) * wide(i, 0) + h2(1) * wide(i, 1) + h2(2) * wide(i, 2)) return apart;
    if (std::abs(component(info.between2, i)) > h2(i) + h1(0) * wide(0, i) + h1(1) * wide(1, i) + h1(2) * wide(2, i))
      return apart;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double r1 = h1(i + 1) * wide(i + 2, j) + h1(i + 2) * wide(i + 1, j);
      const double r2 = h2(j + 1) * wide(i, j + 2) + h2(j + 2) * wide(i, j + 1);
      if (std::abs(d1(i + 2) * cosine(i + 1, j) - d1(i + 1) * cosine(i + 2, j)) > r1 + r2) return apart;
    }
  }
  return {true, -1};
}

// Center and extents of the box, where the test expects half of the extents.
NEARMISS_MISTAKE(aabox_triangle_overlap) {
  const Vector center = q.box.min * 0.5 + q.box.max * 0.5;
  const Vector extent = q.box.max - q.box.min;
  if (extent.x > 0) q.box.min.x = center.x - extent.x, q.box.max.x = center.x + extent.x;
  if (extent.y > 0) q.box.min.y = center.y - extent.y, q.box.max.y = center.y + extent.y;
  if (extent.z > 0) q.box.min.z = center.z - extent.z, q.box.max.z = center.z + extent.z;
  return right(q);
}

// A unit normal with the offset of the given one.
NEARMISS_MISTAKE(sphere_plane_penetration) {
  q.plane.normal = q.plane.normal / length(q.plane.normal);
  return right(q);
}

// The test for a center inside allows for a thousandth, and then the nearest face decides.
NEARMISS_MISTAKE(sphere_box_penetration) {
  const auto found = right(q);
  if (!found.yes()) return found;
  const Frame frame(q.box);
  const Vector p = frame.local(q.sphere.center);
  bool outside = false;
  int face = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double half = component(q.box.half, k), at = std::abs(component(p, k));
    if (at > half * (1 + 1e-3)) return found;
    if (at > half) outside = true;
    if (half - at < least) {
      least = half - at;
      face = k;
    }
  }
  if (!outside) return found;
  const Vector axis = face == 0 ? frame.x : face == 1 ? frame.y : frame.z;
  const Vector normal = component(p, face) < 0 ? axis : -axis;
  return {q.sphere.radius + least, normal, q.sphere.center + normal * q.sphere.radius};
}

// The nine cross products in columns instead of rows.
NEARMISS_MISTAKE(box_box_separating_axis) {
  if (q.axis >= 6) {
    const int i = (q.axis - 6) % 3, j = (q.axis - 6) / 3;
    q.axis = 6 + 3 * i + j;
  }
  return right(q);
}

struct Axes {
  Vector axis[3];
};
inline double squared(const collide::Quaternion<double>& r) { return r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w; }
/// The rotation matrix of a unit quaternion.
inline Axes axes_of_unit(const collide::Quaternion<double>& r) {
  return {{{1 - 2 * (r.y * r.y + r.z * r.z), 2 * (r.x * r.y + r.w * r.z), 2 * (r.x * r.z - r.w * r.y)},
           {2 * (r.x * r.y - r.w * r.z), 1 - 2 * (r.x * r.x + r.z * r.z), 2 * (r.y * r.z + r.w * r.x)},
           {2 * (r.x * r.z + r.w * r.y), 2 * (r.y * r.z - r.w * r.x), 1 - 2 * (r.x * r.x + r.y * r.y)}}};
}

// The matrix of a unit quaternion, from any quaternion.
NEARMISS_MISTAKE(box_box_info) {
  auto info = right(q);
  if (std::abs(squared(q.box1.orientation) - 1) < 1e-13 && std::abs(squared(q.box2.orientation) - 1) < 1e-13)
    return info;
  const Axes a = axes_of_unit(q.box1.orientation), b = axes_of_unit(q.box2.orientation);
  for (std::size_t i = 0; i < 3; ++i) {
    info.cosine[i] = {dot(a.axis[i], b.axis[0]), dot(a.axis[i], b.axis[1]), dot(a.axis[i], b.axis[2])};
    info.abs_cosine[i] = {std::abs(info.cosine[i].x), std::abs(info.cosine[i].y), std::abs(info.cosine[i].z)};
  }
  const Vector& d = info.between;
  info.between1 = {dot(a.axis[0], d), dot(a.axis[1], d), dot(a.axis[2], d)};
  info.between2 = {dot(b.axis[0], d), dot(b.axis[1], d), dot(b.axis[2], d)};
  return info;
}

// A safe normalisation gives the zero vector for short ones, and a reflection at it changes nothing.
NEARMISS_MISTAKE(bounce_direction) {
  const Vector out = q.sphere.center + q.velocity * q.time - q.location;
  const double size = length(out), speed = length(q.velocity);
  if (size > 0 && size < 1e-5 && speed > 0) return {q.velocity / speed};
  return right(q);
}

// Vectors of long double: what the mistakes compute by themselves shall neither round nor leave the range.
using Real = long double;
using Wide = collide::Vec3<Real>;

Wide widened(const Vector& a) { return {Real(a.x), Real(a.y), Real(a.z)}; }
Vector narrowed(const Wide& a) { return {double(a.x), double(a.y), double(a.z)}; }
Real wide_dot(const Wide& a, const Wide& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Real wide_length(const Wide& a) { return std::sqrt(wide_dot(a, a)); }
Wide wide_cross(const Wide& a, const Wide& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Real wide_distance(const Vector& a, const Vector& b) { return wide_length(widened(a) - widened(b)); }
Wide wide_normal(const Vector& a, const Vector& b, const Vector& c) {
  return wide_cross(widened(b) - widened(a), widened(c) - widened(a));
}
double& component(Vector& a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }

/// Not normalised barycentric coordinates of the foot of p on the triangle's plane, times the squared normal.
Wide foot_weights(const collide::Triangle<double>& t, const Wide& n, const Wide& p) {
  const Wide a = widened(t.v0), b = widened(t.v1), c = widened(t.v2);
  return {wide_dot(n, wide_cross(c - b, p - b)), wide_dot(n, wide_cross(a - c, p - c)),
          wide_dot(n, wide_cross(b - a, p - a))};
}
bool none_negative(const Wide& a) { return a.x >= 0 && a.y >= 0 && a.z >= 0; }

/// The columns of the rotation matrix of a quaternion, which is trusted to have unit length.
std::array<Wide, 3> columns_of_unit(Real x, Real y, Real z, Real w) {
  return {Wide{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          Wide{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          Wide{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}
/// The axes of a box, whose quaternion may have any length.
std::array<Wide, 3> axes_of(const collide::Box<double>& box) {
  const Real x = box.orientation.x, y = box.orientation.y, z = box.orientation.z, w = box.orientation.w;
  const Real size = std::sqrt(x * x + y * y + z * z + w * w);
  return columns_of_unit(x / size, y / size, z / size, w / size);
}
std::array<Real, 3> halves_of(const collide::Box<double>& box) { return {box.half.x, box.half.y, box.half.z}; }
/// The corner of a box that reaches furthest along a direction.
Wide support(const collide::Box<double>& box, const Wide& direction) {
  Wide corner = widened(box.center);
  const std::array<Wide, 3> axes = axes_of(box);
  const std::array<Real, 3> half = halves_of(box);
  for (int i = 0; i < 3; ++i) corner = corner + axes[i] * (wide_dot(axes[i], direction) < 0 ? -half[i] : half[i]);
  return corner;
}

// Snapping to an end point within a share of the length.
NEARMISS_MISTAKE(closest_point_segment_unit) {
  auto answer = right(q);
  const Real whole = wide_distance(q.segment.v0, q.segment.v1);
  if (wide_distance(answer.point, q.segment.v0) < 1e-3L * whole) return {q.segment.v0};
  if (wide_distance(answer.point, q.segment.v1) < 1e-3L * whole) return {q.segment.v1};
  return answer;
}

// The nearest edge is chosen by the distance from its line, not from the edge.
NEARMISS_MISTAKE(closest_point_rectangle_perimeter) {
  const std::array<Vector, 4> v = {q.rectangle.v0, q.rectangle.v1, q.rectangle.v2, q.rectangle.v3};
  int best = 0;
  Real least = -1;
  for (int i = 0; i < 4; ++i) {
    const Wide along = widened(v[(i + 1) % 4]) - widened(v[i]), to = widened(q.point) - widened(v[i]);
    const Real whole = wide_length(along);
    const Real distance = whole > 0 ? wide_length(wide_cross(along, to)) / whole : wide_length(to);
    if (least < 0 || distance < least) {
      least = distance;
      best = i;
    }
  }
  return {nearest(v[best], v[(best + 1) % 4], q.point)};
}

// The textbook solution in plain double; directions are scaled by powers of two, which rounds nothing.
NEARMISS_MISTAKE(closest_points_lines) {
  const auto scaled = [](const Vector& a) {
    const int exponent = std::ilogb(std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}));
    return Vector{std::scalbn(a.x, -exponent), std::scalbn(a.y, -exponent), std::scalbn(a.z, -exponent)};
  };
  const Vector d1 = scaled(q.line1.direction), d2 = scaled(q.line2.direction), w = q.line1.point - q.line2.point;
  const double a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2), d = dot(d1, w), e = dot(d2, w);
  const double denominator = a * c - b * b;
  if (denominator <= 0) return {q.line1.point, q.line2.point + d2 * (e / c)};
  const double s = (b * e - c * d) / denominator;
  const double t = (a * e - b * d) / denominator;
  return {q.line1.point + d1 * s, q.line2.point + d2 * t};
}

// A margin of 1e-5 around the projected rectangle.
NEARMISS_MISTAKE(point_in_rectangle) {
  auto answer = right(q);
  if (answer.decision) return answer;
  const double x = std::abs(q.normal.x), y = std::abs(q.normal.y), z = std::abs(q.normal.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  for (Vector* v : {&q.rectangle.v0, &q.rectangle.v1, &q.rectangle.v2, &q.rectangle.v3, &q.point})
    component(*v, axis) = 0;
  const Vector at = right(inputs::closest_point_rectangle<double>{q.rectangle, q.point}).point;
  answer.decision = wide_distance(at, q.point) < 1e-5L;
  return answer;
}

// The epsilon of Moeller and Trumbore for the determinant.
NEARMISS_MISTAKE(moving_point_rectangle) {
  const auto& r = q.rectangle;
  const Wide v = widened(q.velocity);
  const bool first = -wide_dot(wide_normal(r.v0, r.v1, r.v2), v) >= 1e-6L;
  const bool second = -wide_dot(wide_normal(r.v0, r.v2, r.v3), v) >= 1e-6L;
  if (first && second) return right(q);
  if (first) return right(inputs::moving_point_rectangle<double>{q.point, q.velocity, {r.v0, r.v1, r.v2, r.v2}});
  if (second) return right(inputs::moving_point_rectangle<double>{q.point, q.velocity, {r.v0, r.v2, r.v3, r.v3}});
  return {};
}

// The normal of a contact from within turns to the side from which the point comes.
NEARMISS_MISTAKE(moving_point_sphere) {
  auto answer = right(q);
  if (answer.yes() && wide_distance(q.point, q.sphere.center) <= Real(q.sphere.radius) &&
      wide_dot(widened(answer.normal), widened(q.velocity)) > 0)
    answer.normal = -answer.normal;
  return answer;
}

// t <= 0 is taken for a contact in the past.
NEARMISS_MISTAKE(moving_point_box) {
  const auto answer = right(q);
  if (answer.time <= 0) return {};
  return answer;
}

// tmin >= 0 ? tmin : tmax
NEARMISS_MISTAKE(ray_aabox) {
  auto answer = right(q);
  if (!answer.inside) return answer;
  const std::array<Real, 3> o = {q.ray.origin.x, q.ray.origin.y, q.ray.origin.z};
  const std::array<Real, 3> d = {q.ray.direction.x, q.ray.direction.y, q.ray.direction.z};
  const std::array<Real, 3> low = {q.aabox.min.x, q.aabox.min.y, q.aabox.min.z};
  const std::array<Real, 3> high = {q.aabox.max.x, q.aabox.max.y, q.aabox.max.z};
  Real leaves = -1;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0) continue;
    const Real t = ((d[i] > 0 ? high[i] : low[i]) - o[i]) / d[i];
    if (leaves < 0 || t < leaves) leaves = t;
  }
  if (leaves < 0) return answer;
  std::array<double, 3> at{};
  for (int i = 0; i < 3; ++i) at[i] = double(std::clamp(o[i] + d[i] * leaves, low[i], high[i]));
  answer.location = {at[0], at[1], at[2]};
  return answer;
}

// Where the sphere meets the plane beside the triangle, the nearest perimeter point there is taken for the contact.
NEARMISS_MISTAKE(moving_sphere_triangle) {
  const auto answer = right(q);
  if (!answer.yes() || answer.time <= 0) return answer;
  const auto& t = q.triangle;
  Wide n = wide_normal(t.v0, t.v1, t.v2);
  const Real size = wide_length(n);
  if (!(size > 0)) return answer;
  n = n / size;
  const Wide center = widened(q.sphere.center), velocity = widened(q.velocity);
  const Real above = wide_dot(n, center - widened(t.v0)) - Real(q.sphere.radius), speed = -wide_dot(n, velocity);
  const Wide then = center + velocity * (above > 0 && speed > 0 ? above / speed : Real(0));
  const Wide foot = then - n * wide_dot(n, then - widened(t.v0));
  if (none_negative(foot_weights(t, n, foot))) return answer;
  const auto edge = right(inputs::closest_point_triangle_perimeter_edges<double>{t, narrowed(foot)});
  const auto hit = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {edge.point, 0.0}});
  if (!hit.yes()) return {};
  const std::array<Vector, 3> v = {t.v0, t.v1, t.v2};
  const int from = edge.edge, to = (edge.edge + 1) % 3;
  const Real whole = wide_distance(v[from], v[to]);
  const Real share = whole > 0 ? std::min(Real(1), wide_distance(edge.point, v[from]) / whole) : Real(0);
  Vector weights{};
  component(weights, from) = double(1 - share);
  component(weights, to) = double(share);
  return {hit.time, edge.point, hit.normal, weights};
}

// Steps of the gap divided by the speed; a grazing contact needs many.
NEARMISS_MISTAKE(moving_sphere_sphere) {
  const auto answer = right(q);
  if (!answer.yes() || answer.time <= 0) return answer;
  const Wide from = widened(q.sphere.center) - widened(q.fixed.center), velocity = widened(q.velocity);
  const Real radii = Real(q.sphere.radius) + Real(q.fixed.radius), speed = wide_length(velocity);
  const Real gap_at_start = wide_length(from) - radii;
  Real t = 0;
  for (int step = 0; step < 64; ++step) {
    const Real gap = wide_length(from + velocity * t) - radii;
    if (gap <= 1e-6L * gap_at_start) return answer;
    t += gap / speed;
  }
  return {};
}

// Motion along the axis is a special case, for which the side is not tested.
NEARMISS_MISTAKE(moving_sphere_capsule) {
  const auto answer = right(q);
  if (!answer.yes() || answer.time <= 0) return answer;
  const Wide axis = widened(q.capsule.p1) - widened(q.capsule.p0), velocity = widened(q.velocity);
  const Wide across = wide_cross(axis, velocity);
  const Real both = wide_dot(axis, axis) * wide_dot(velocity, velocity);
  if (!(wide_dot(across, across) < 1e-3L * both)) return answer;
  const auto hit0 = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p0, q.capsule.radius}});
  const auto hit1 = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p1, q.capsule.radius}});
  return hit1.time < hit0.time ? hit1 : hit0;
}

// Discrete substeps.
NEARMISS_MISTAKE(moving_sphere_passes_box) {
  const auto answer = right(q);
  if (!answer.decision || q.forever || !std::isfinite(q.limit)) return answer;
  for (int step = 0; step <= 16; ++step) {
    const Real t = Real(q.limit) * step / 16;
    const Vector center = narrowed(widened(q.sphere.center) + widened(q.velocity) * t);
    if (!std::isfinite(center.x) || !std::isfinite(center.y) || !std::isfinite(center.z)) break;
    if (right(inputs::sphere_box_overlap<double>{{center, q.sphere.radius}, q.box}).decision) return {true};
  }
  return {false};
}

// The center against the box whose half extents are larger by the radius.
NEARMISS_MISTAKE(sphere_box_overlap) {
  if (right(q).decision) return {true};
  const std::array<Wide, 3> axes = axes_of(q.box);
  const std::array<Real, 3> half = halves_of(q.box);
  const Wide from = widened(q.sphere.center) - widened(q.box.center);
  for (int i = 0; i < 3; ++i)
    if (std::abs(wide_dot(axes[i], from)) > half[i] + Real(q.sphere.radius)) return {false};
  return {true};
}

// d * d > r * r * e in float: inf > inf and 0 > 0 are false. Beside the face, the axes of edges and corners decide.
NEARMISS_MISTAKE(sphere_triangle_overlap) {
  if (right(q).decision) return {true};
  const auto& t = q.triangle;
  const Wide n = wide_normal(t.v0, t.v1, t.v2), center = widened(q.sphere.center);
  const Real e = wide_dot(n, n), d = wide_dot(n, widened(t.v0) - center), r = q.sphere.radius;
  if (!(e > 0) || !none_negative(foot_weights(t, n, center))) return {false};
  constexpr Real highest = std::numeric_limits<float>::max(), lowest = std::numeric_limits<float>::denorm_min();
  const Real left = d * d, other = r * r * e;
  return {(left > highest && other > highest) || (left < lowest && other < lowest)};
}

// The contact of the other sphere.
NEARMISS_MISTAKE(sphere_sphere_penetration) {
  auto answer = right(q);
  if (answer.yes())
    answer.contact = narrowed(widened(q.sphere2.center) - widened(answer.normal) * Real(q.sphere2.radius));
  return answer;
}

// The corners from a matrix that is a rotation only for a unit quaternion.
NEARMISS_MISTAKE(box_plane_penetration) {
  const auto& o = q.box.orientation;
  const std::array<Wide, 3> axes = columns_of_unit(o.x, o.y, o.z, o.w);
  const std::array<Real, 3> half = halves_of(q.box);
  const Wide n = widened(q.plane.normal);
  const Real size = wide_length(n);
  inputs::box_plane_penetration<double>::Answer answer{};
  Real deepest = 0;
  for (int i = 0; i < 8; ++i) {
    Wide corner = widened(q.box.center);
    for (int k = 0; k < 3; ++k) corner = corner + axes[k] * ((i >> k & 1) != 0 ? half[k] : -half[k]);
    const Real depth = -(wide_dot(n, corner) + Real(q.plane.offset)) / size;
    if (i == 0 || depth > deepest) deepest = depth;
    if (!(depth >= 0)) continue;
    answer.corners[i].behind = true;
    answer.corners[i].point = narrowed(corner);
  }
  answer.depth = double(deepest);
  if (deepest >= 0) answer.normal = narrowed(n / size);
  return answer;
}

// Preference for face axes, so that the contact does not jitter.
NEARMISS_MISTAKE(box_box_penetration) {
  const auto answer = right(q);
  if (!answer.yes() || answer.axis < 6) return answer;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 6; ++axis) {
    const double depth = -right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value;
    if (depth < least) {
      least = depth;
      best = axis;
    }
  }
  if (answer.depth < 0.998 * least) return answer;
  Wide n = axes_of(best < 3 ? q.box1 : q.box2)[best % 3];
  if (wide_dot(n, widened(q.box2.center) - widened(q.box1.center)) < 0) n = -n;
  const Wide contact =
      best < 3 ? support(q.box2, -n) + n * (Real(least) / 2) : support(q.box1, n) - n * (Real(least) / 2);
  return {least, best, narrowed(n), narrowed(contact)};
}

// The epsilon for nearly parallel edges, as the books have it, on each absolute cosine.
NEARMISS_MISTAKE(box_box_projected_distance) {
  auto answer = right(q);
  const std::array<Real, 3> a = halves_of(q.box1), b = halves_of(q.box2);
  Real sum = 0;
  if (q.axis < 3) {
    sum = b[0] + b[1] + b[2];
  } else if (q.axis < 6) {
    sum = a[0] + a[1] + a[2];
  } else {
    const int i = (q.axis - 6) / 3, j = (q.axis - 6) % 3;
    sum = a[(i + 1) % 3] + a[(i + 2) % 3] + b[(j + 1) % 3] + b[(j + 2) % 3];
  }
  answer.value = double(Real(answer.value) - 1e-6L * sum);
  return answer;
}

// A cosine near 1 in float says nothing about a small angle.
NEARMISS_MISTAKE(box_box_parallel_axis) {
  const auto info = right(inputs::box_box_info<double>{q.box1, q.box2});
  const float least = 1.0f - float(q.epsilon);
  for (int i = 0; i < 3; ++i) {
    const Vector& row = info.cosine[i];
    const std::array<float, 3> cosine = {float(row.x), float(row.y), float(row.z)};
    for (int j = 0; j < 3; ++j)
      if (std::abs(cosine[j]) >= least) return {true, i, j};
  }
  return {};
}

// A contact too near to the center has no direction.
NEARMISS_MISTAKE(slide_direction) {
  const Wide velocity = widened(q.velocity);
  const Wide u = widened(q.sphere.center) + velocity * Real(q.time) - widened(q.location);
  const Real speed = wide_length(velocity);
  if (!(speed > 0) || !(wide_dot(u, u) < 1e-8L)) return right(q);
  return {narrowed(velocity / speed)};
}

}  // namespace
}  // namespace nearmiss::planted

#define NEARMISS_PLANTED_NAME "planted-twelfth"
#define NEARMISS_PLANTED_TABLE "fuzz/planted/twelfth.def"
#include "fuzz/planted/planted_offers.hpp"
