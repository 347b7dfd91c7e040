/// Mistakes: moving spheres.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

Vector world(const collide::Box<double>& b, const Vector& p) {
  return b.center + axis_of_box(b, 0) * p.x + axis_of_box(b, 1) * p.y + axis_of_box(b, 2) * p.z;
}
Vector clamped(const Vector& p, const Vector& h) {
  return {std::clamp(p.x, -h.x, h.x), std::clamp(p.y, -h.y, h.y), std::clamp(p.z, -h.z, h.z)};
}
Wide wide_nearest_in_box(const collide::Box<double>& box, const Wide& p) {
  Wide l = wide_local(box, p), at = widened(box.center);
  for (int k = 0; k < 3; ++k) {
    const long double h = component(box.half, k);
    at = at + wide_axis(box, k) * std::clamp(component(l, k), -h, h);
  }
  return at;
}
/// The vector with these coordinates in a frame.
Vector out_of(const std::array<Vector, 3>& axes, const Vector& a) {
  return axes[0] * a.x + axes[1] * a.y + axes[2] * a.z;
}

MISREPORT(1, moving_sphere_plane, degenerate, "a gap below 1e-7 of the radius at the start is a contact at time 0",
          "relative tolerance 1e-7") {
  if (a.yes() && a.time * std::abs(dot(a.normal, q.velocity)) < 1e-7 * q.sphere.radius) a.time = 0;
}
MISREPORT(2, moving_sphere_plane, ordinary, "the distance is taken for the time",
          "convention distance in place of time") {
  if (a.yes()) a.time *= length(q.velocity);
}
MISREPORT(3, moving_sphere_plane, ordinary, "the time is computed in float", "rounding") {
  if (a.yes() && a.time > 0) {
    const float unit = float(length(q.plane.normal));
    const float distance = (float(dot(q.plane.normal, q.sphere.center)) + float(q.plane.offset)) / unit;
    a.time = (distance - float(q.sphere.radius)) * unit / -float(dot(q.plane.normal, q.velocity));
  }
}
MISREAD(5, moving_sphere_plane, ordinary, "the offset of the plane has the other sign", "convention") {
  q.plane.offset = -q.plane.offset;
}
MISREPORT(7, moving_sphere_plane, ordinary, "the time of a sphere that starts in contact is not clamped at 0",
          "convention .*(start|negative|clamp|before).* or unsupported .*start.* or logic") {
  const double size = length(q.plane.normal);
  const Vector unit = q.plane.normal / size;
  const double gap = dot(unit, q.sphere.center) + q.plane.offset / size - q.sphere.radius;
  const double approach = -dot(unit, q.velocity);
  if (!a.yes() || a.time > 0 || !(gap < 0) || !(approach > 0)) return;
  const double time = gap / approach;
  a = {time, q.sphere.center + q.velocity * time - unit * q.sphere.radius, unit};
}
MISREPORT(9, moving_sphere_plane, degenerate,
          "a speed along the normal below an absolute 1e-5, but not zero, is a miss", "absolute tolerance 1e-5 speed") {
  const double speed = -dot(q.plane.normal / length(q.plane.normal), q.velocity);
  if (speed > 0 && speed < 1e-5) a = {};
}
MISREPORT(10, moving_sphere_plane, ordinary, "a sphere that reaches both sides at the start is a miss",
          "unsupported or convention") {
  if (right(inputs::sphere_plane_penetration<double>{q.sphere, q.plane}).depth > 0) a = {};
}
MISTAKE(11, moving_sphere_plane, ordinary, "the plane's normal is taken as a unit vector",
        "unsupported or convention") {
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
MISTAKE(12, moving_sphere_plane, degenerate,
        "the approach speed is the difference of the heights now and one unit of time later, which cancels",
        "rounding") {
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
MISTAKE(13, moving_sphere_plane, ordinary, "the plane's normal is used as if it had unit length", "unsupported") {
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
MISREPORT(14, moving_sphere_plane, ordinary,
          "takes the velocity as the displacement of one step: a contact after time 1 is a miss",
          "convention or absolute tolerance 1 time") {
  if (a.time > 1) a = {};
}
MISREPORT(15, moving_sphere_plane, degenerate,
          "takes a motion at a sine below 1e-3 to the plane as parallel to it, a miss", "relative tolerance 1e-3") {
  if (a.yes() && a.time > 0 && grazes(unit_of(q.plane.normal), q.velocity, 1e-3)) a = {};
}

MISREPORT(1, moving_sphere_triangle, ordinary, "the edge v2 v0 is left out", "logic") {
  if (a.yes() && a.weights.y < 1e-12 && a.weights.x > 1e-12 && a.weights.z > 1e-12) a = a.miss();
}
MISREPORT(2, moving_sphere_triangle, degenerate,
          "an edge contact within a sine of 1e-5 of the face gets the face normal", "relative tolerance 1e-5") {
  const Vector n = normal_of(q.triangle);
  if (a.yes() && length(cross(n, a.normal)) < 1e-5 * length(n) && dot(n, a.normal) > 0) a.normal = n / length(n);
}
MISREPORT(4, moving_sphere_triangle, ordinary, "the time is divided by the speed once more",
          "convention time over speed") {
  if (a.yes()) a.time /= length(q.velocity);
}
MISREPORT(6, moving_sphere_triangle, ordinary, "the location is the point that is nearest at the start", "logic") {
  if (!a.yes() || a.time == 0) return;
  const Vector start = q.sphere.center;
  a.location = nearest(q.triangle, start);
}
MISREPORT(7, moving_sphere_triangle, degenerate,
          "a motion along the triangle's plane, but for a sine of 1e-4, is a miss", "relative tolerance 1e-4") {
  const Vector n = normal_of(q.triangle);
  if (!a.yes() || !(length(n) > 0) || std::isinf(length(n))) return;
  if (grazes(n / length(n), q.velocity, 1e-4)) a = a.miss();
}
MISREPORT(8, moving_sphere_triangle, ordinary, "the time is sought by regula falsi, which ends after 8 steps",
          "iteration limit") {
  if (!a.yes() || a.time == 0) return;
  const auto place_at = [&](const Vector& center) { return nearest(q.triangle, center); };
  const auto gap_at = [&](double time) {
    const Vector center = q.sphere.center + q.velocity * time;
    return length(center - place_at(center)) - q.sphere.radius;
  };
  const Vector to_contact = a.location - q.sphere.center;
  const double approach = dot(to_contact, q.velocity) / dot(q.velocity, q.velocity);
  double low = 0, high = approach, gap_low = gap_at(low), gap_high = gap_at(high);
  if (!(gap_low > 0 && gap_high < 0)) return;
  for (int step = 0; step < 8; ++step) {
    const double middle = low + (high - low) * gap_low / (gap_low - gap_high), gap = gap_at(middle);
    if (std::abs(gap) < 1e-13 * gap_low) return;
    (gap > 0 ? low : high) = middle;
    (gap > 0 ? gap_low : gap_high) = gap;
  }
  a.time = high;
}
MISTAKE(9, moving_sphere_triangle, ordinary, "the back of the triangle is hit too", "convention") {
  auto a = right(q);
  if (a.yes()) return a;
  std::swap(q.triangle.v1, q.triangle.v2);
  a = right(q);
  std::swap(a.weights.y, a.weights.z);
  return a;
}
MISREPORT(10, moving_sphere_triangle, ordinary, "conservative advancement gives up after 32 steps: a miss",
          "iteration limit") {
  if (!a.yes() || a.time <= 0) return;
  const double speed = length(q.velocity);
  Vector center = q.sphere.center;
  double enough = -1;
  for (int step = 0; step < 32; ++step) {
    const Vector near = nearest(q.triangle, center);
    const double distance = length(center - near);
    if (enough < 0) enough = 1e-8 * distance;
    const double gap = distance - q.sphere.radius;
    if (gap <= enough) return;
    center = center + q.velocity * (gap / speed);
  }
  a = {};
}
MISTAKE(11, moving_sphere_triangle, ordinary, "the vertices are not tested, only the face and the edges",
        "logic or unsupported") {
  const auto a = right(q);
  const auto at_vertex = [&](double u, double v) { return std::abs(u) < 1e-15 && std::abs(v) < 1e-15; };
  if (a.yes() && a.time > 0 && squared(normal_of(q.triangle)) > 0 &&
      (at_vertex(a.weights.x, a.weights.y) || at_vertex(a.weights.y, a.weights.z) ||
       at_vertex(a.weights.z, a.weights.x)))
    return decltype(right(q))::miss();
  return a;
}
MISTAKE(12, moving_sphere_triangle, ordinary,
        "beside the face, only the perimeter point nearest to the contact with the plane is tested", "logic") {
  const auto answer = right(q);
  if (!answer.yes() || answer.time <= 0) return answer;
  const auto& t = q.triangle;
  Wide n = wide_normal(t.v0, t.v1, t.v2);
  const Real size = length(n);
  if (!(size > 0)) return answer;
  n = n / size;
  const Wide center = widened(q.sphere.center), velocity = widened(q.velocity);
  const Real above = dot(n, center - widened(t.v0)) - Real(q.sphere.radius), speed = -dot(n, velocity);
  const Wide then = center + velocity * (above > 0 && speed > 0 ? above / speed : Real(0));
  const Wide foot = then - n * dot(n, then - widened(t.v0));
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
MISREPORT(13, moving_sphere_triangle, ordinary, "gives the weights in the order of v1, v2, v0", "convention") {
  a.weights = {a.weights.y, a.weights.z, a.weights.x};
}
MISTAKE(14, moving_sphere_triangle, ordinary, "the weights are given in the order v1, v2, v0", "convention") {
  return moving_sphere_triangle_13(q);
}
MISREPORT(15, moving_sphere_triangle, degenerate, "a triangle with n n < 1e-12 is taken for one that cannot be hit",
          "absolute tolerance 1e-12 length\\^4 or absolute tolerance 1e-0?6 length\\^2") {
  const Vector n = normal_of(q.triangle);
  if (dot(n, n) < 1e-12) a = {};
}

MISREAD(1, moving_sphere_rectangle, ordinary, "the second triangle is left out", "logic") {
  q.rectangle.v3 = q.rectangle.v2;
}
MISREPORT(2, moving_sphere_rectangle, ordinary, "a motion with a positive z is a miss", "logic") {
  if (q.velocity.z > 0) a = {};
}
MISREPORT(4, moving_sphere_rectangle, ordinary, "every contact gets the normal of the face", "logic") {
  const Vector n = cross(q.rectangle.v1 - q.rectangle.v0, q.rectangle.v3 - q.rectangle.v0);
  if (a.yes() && length(n) > 0) a.normal = n / length(n);
}
MISREPORT(5, moving_sphere_rectangle, degenerate, "a gap below 1e-3 of the radius at the start is a contact at time 0",
          "relative tolerance 1e-3") {
  const Vector start = q.sphere.center;
  const Vector place = right(inputs::closest_point_rectangle<double>{q.rectangle, start}).point;
  const double gap = length(start - place) - q.sphere.radius;
  if (a.yes() && gap > 0 && gap < 1e-3 * q.sphere.radius)
    a.time = 0, a.location = place, a.normal = (start - place) / length(start - place);
}
MISREAD(7, moving_sphere_rectangle, ordinary, "the sphere has a skin of an absolute 1e-4",
        "absolute tolerance 1e-4 length") {
  q.sphere.radius += 1e-4;
}
MISREPORT(8, moving_sphere_rectangle, ordinary,
          "a start in contact with the plane is a contact at time 0, wherever the rectangle ends", "logic") {
  const auto& r = q.rectangle;
  const Vector n = cross(r.v1 - r.v0, r.v2 - r.v0);
  const double size = length(n);
  if (!(size > 0) || std::isinf(size) || right(q).time == 0) return;
  const double height = dot(n / size, q.sphere.center - r.v0);
  if (std::abs(height) < q.sphere.radius && dot(n, q.velocity) < 0)
    a = {0, q.sphere.center - n / size * height, n / size};
}
MISTAKE(9, moving_sphere_rectangle, degenerate,
        "the discriminant of an edge underflows in float, and the sphere misses the edge", "underflow") {
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
MISREPORT(10, moving_sphere_rectangle, ordinary, "the face and the edges are tested, the corners are not",
          "unsupported or logic") {
  if (!a.yes()) return;
  const auto& r = q.rectangle;
  for (const Vector& v : {r.v0, r.v1, r.v2, r.v3})
    if (a.location.x == v.x && a.location.y == v.y && a.location.z == v.z) a = {};
}
MISREPORT(11, moving_sphere_rectangle, degenerate, "motion within 1e-4 of the plane's direction is culled as parallel",
          "relative tolerance 1e-4") {
  const Vector n = cross(q.rectangle.v1 - q.rectangle.v0, q.rectangle.v2 - q.rectangle.v0);
  const double l = length(n);
  if (l > 0 && grazes(n / l, q.velocity, 1e-4)) a = a.miss();
}
MISTAKE(12, moving_sphere_rectangle, ordinary,
        "takes the hit of the first triangle if there is one, not the earlier hit of both", "logic") {
  const auto& r = q.rectangle;
  const auto first = right(inputs::moving_sphere_triangle<double>{q.sphere, q.velocity, {r.v0, r.v1, r.v2}});
  if (first.yes()) return {first.time, first.location, first.normal};
  const auto second = right(inputs::moving_sphere_triangle<double>{q.sphere, q.velocity, {r.v0, r.v2, r.v3}});
  return {second.time, second.location, second.normal};
}
MISREAD(13, moving_sphere_rectangle, ordinary,
        "ignores v3 and uses the fourth corner of the parallelogram of the other three", "unsupported") {
  q.rectangle.v3 = q.rectangle.v0 + (q.rectangle.v2 - q.rectangle.v1);
}
MISREPORT(14, moving_sphere_rectangle, ordinary, "drops every contact at time 0, so a start in contact is a miss",
          "unsupported or convention") {
  if (!(a.time > 0)) a = {};
}
MISREPORT(15, moving_sphere_rectangle, degenerate,
          "the squared length of the rectangle's normal leaves the range of float; such a rectangle is missed",
          "overflow or underflow") {
  const Vector n = cross(q.rectangle.v1 - q.rectangle.v0, q.rectangle.v3 - q.rectangle.v0);
  if (n == Vector{}) return;
  const float x = float(n.x), y = float(n.y), z = float(n.z), length2 = x * x + y * y + z * z;
  if (!(length2 > 0) || !std::isfinite(length2)) a = {};
}

MISREPORT(1, moving_sphere_sphere, degenerate,
          "a grazing hit, with a sine below 1e-6, is timed at the nearest approach", "relative tolerance 1e-6") {
  if (a.yes() && a.time > 0 && grazes(a.normal, q.velocity, 1e-6)) {
    a.time = dot(q.fixed.center - q.sphere.center, q.velocity) / dot(q.velocity, q.velocity);
  }
}
MISREPORT(2, moving_sphere_sphere, degenerate, "the square of a distance overflows in float", "overflow") {
  const Vector between = q.fixed.center - q.sphere.center;
  const float square = float(dot(between, between));
  if (std::isinf(square)) a = {};
}
MISREPORT(3, moving_sphere_sphere, ordinary, "a start in contact is a miss",
          "convention start in contact is a miss or unsupported a start in contact") {
  if (length(q.fixed.center - q.sphere.center) <= q.sphere.radius + q.fixed.radius) a = {};
}
MISREPORT(6, moving_sphere_sphere, degenerate, "the discriminant underflows in float, and becomes 0", "underflow") {
  const Vector m = q.sphere.center - q.fixed.center;
  const double reach = q.sphere.radius + q.fixed.radius;
  const double square = dot(q.velocity, q.velocity), b = dot(m, q.velocity), c = dot(m, m) - reach * reach;
  const double discriminant = b * b - square * c;
  if (!a.yes() || a.time == 0 || !(discriminant > 0) || float(discriminant) > 0) return;
  a.time = -b / square;
}
MISREPORT(7, moving_sphere_sphere, ordinary, "the location is half way between the centers", "logic") {
  if (a.yes()) a.location = (q.sphere.center + q.velocity * a.time + q.fixed.center) * 0.5;
}
MISREPORT(10, moving_sphere_sphere, degenerate, "a squared speed below 1e-10 counts as a sphere at rest",
          "absolute tolerance 1e-10 .*\\^2.* or absolute tolerance 1e-5 .*") {
  if (dot(q.velocity, q.velocity) < 1e-10 && a.time > 0) a = {};
}
MISREPORT(11, moving_sphere_sphere, degenerate, "the quadratic term below 1e-8 counts as no motion",
          "absolute tolerance 1e-8 .* or absolute tolerance 1e-4 .*") {
  if (a.time == 0) return;  // the overlap at the start is tested first
  if (dot(q.velocity, q.velocity) < 1e-8) a = a.miss();
}
MISREPORT(12, moving_sphere_sphere, ordinary, "conservative advancement gives up after 64 steps and reports a miss",
          "iteration limit") {
  if (!a.yes() || a.time <= 0) return;
  const Wide from = widened(q.sphere.center) - widened(q.fixed.center), velocity = widened(q.velocity);
  const Real radii = Real(q.sphere.radius) + Real(q.fixed.radius), speed = length(velocity);
  const Real gap_at_start = length(from) - radii;
  if (!advances<Real>([&](Real t) { return length(from + velocity * t) - radii; }, speed, 1e-6L * gap_at_start, 64))
    a = {};
}
MISREPORT(13, moving_sphere_sphere, ordinary, "conservative advancement gives up after 32 steps and reports a miss",
          "iteration limit") {
  if (!a.yes() || a.time == 0) return;
  const double reach = q.sphere.radius + q.fixed.radius, speed = length(q.velocity);
  const Vector between = q.sphere.center - q.fixed.center;
  const double close = 1e-9 * std::max(reach, length(between));
  if (!advances<double>([&](double t) { return length(between + q.velocity * t) - reach; }, speed, close, 32)) a = {};
}
MISTAKE(14, moving_sphere_sphere, degenerate, "the textbook quadratic, whose discriminant cancels far away",
        "rounding") {
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
MISREPORT(15, moving_sphere_sphere, degenerate,
          "a guard against degenerate input: the product of two squares in float overflows or becomes 0, a miss",
          "overflow or underflow") {
  const Vector between = q.fixed.center - q.sphere.center;
  const Vector zero{};
  if (q.velocity == zero || between == zero) return;
  const float product = float(dot(q.velocity, q.velocity)) * float(dot(between, between));
  if (product == 0.0f || !std::isfinite(product)) a = {};
}

MISREPORT(1, moving_sphere_box, degenerate, "a hit along a face, but for a sine of 1e-7, is a miss",
          "relative tolerance 1e-7") {
  if (a.yes() && a.time > 0 && grazes(a.normal, q.velocity, 1e-7)) a = a.miss();
}
MISREPORT(2, moving_sphere_box, ordinary, "the time is bisected in 20 steps", "iteration limit") {
  if (!a.yes() || a.time == 0) return;
  const double longest =
      (length(q.box.center - q.sphere.center) + length(q.box.half) + q.sphere.radius) / length(q.velocity);
  double low = 0, high = longest;
  for (int step = 0; step < 20; ++step) {
    const double middle = (low + high) / 2;
    (middle < a.time ? low : high) = middle;
  }
  a.time = high;
}
MISREPORT(3, moving_sphere_box, ordinary, "conservative advancement ends after 12 steps", "iteration limit") {
  const double speed = length(q.velocity);
  if (!a.yes() || a.time == 0) return;
  const auto gap_at = [&](double t) {
    const collide::Sphere<double> moved{q.sphere.center + q.velocity * t, q.sphere.radius};
    return -right(inputs::sphere_box_penetration<double>{moved, q.box}).depth;
  };
  if (!advances<double>(gap_at, speed, 1e-9 * q.sphere.radius, 12)) a = a.miss();
}
MISTAKE(5, moving_sphere_box, ordinary, "the box grown by the radius has sharp edges and corners", "logic") {
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
MISREPORT(7, moving_sphere_box, degenerate, "a box with a half extent of zero is a miss", "unsupported or logic") {
  const Vector half = q.box.half;
  if (half.x == 0 || half.y == 0 || half.z == 0) a = {};
}
MISTAKE(8, moving_sphere_box, ordinary, "conservative advancement ends at a gap of an absolute 1e-4",
        "absolute tolerance 1e-4 length") {
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
MISTAKE(10, moving_sphere_box, ordinary, "the box grown by the radius keeps sharp edges and corners", "logic") {
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
MISREPORT(11, moving_sphere_box, ordinary, "conservative advancement gives up after 20 steps", "iteration limit") {
  if (!a.yes() || a.time == 0) return;
  const Axes axes = axes_of_box(q.box);
  const Vector v = into(axes, q.velocity), p = into(axes, q.sphere.center - q.box.center);
  const double speed = length(v), precise = 1e-9 * (length(p) + q.sphere.radius);
  double t = 0;
  for (int step = 0; step < 20; ++step) {
    const Vector c = p + v * t;
    Vector out;
    for (int i = 0; i < 3; ++i) component(out, i) = std::max(std::abs(component(c, i)) - component(q.box.half, i), 0.0);
    const double gap = length(out) - q.sphere.radius;
    if (gap <= precise) return;
    t += gap / speed;
  }
  a = a.miss();
}
MISREPORT(12, moving_sphere_box, degenerate, "conservative advancement gives up after 200 steps and reports a miss",
          "iteration limit") {
  if (!a.yes() || a.time == 0) return;
  const double speed = length(q.velocity);
  const double grid = 1e-13 * (length(q.sphere.center) + length(q.box.center) + length(q.box.half) + q.sphere.radius);
  double time = 0, first = 0;
  for (int step = 0; step < 200; ++step) {
    const Vector p = local(q.box, q.sphere.center + q.velocity * time);
    const Vector out{std::max(0.0, std::abs(p.x) - q.box.half.x), std::max(0.0, std::abs(p.y) - q.box.half.y),
                     std::max(0.0, std::abs(p.z) - q.box.half.z)};
    const double gap = length(out) - q.sphere.radius;
    if (step == 0) first = gap;
    if (gap <= 1e-5 * first + grid) return;
    time += gap / speed;
  }
  a = {};
}
MISREAD(13, moving_sphere_box, ordinary, "adds a collision margin of 0.04 to the sphere's radius",
        "absolute tolerance (4e-0?2|0\\.04(0\\d*)?|0\\.0399?\\d*|3\\.99?\\d*e-0?2|4\\.0\\d*e-0?2) length") {
  q.sphere.radius += 0.04;
}
MISTAKE(14, moving_sphere_box, ordinary,
        "the box grown by the radius has square edges and corners instead of rounded ones", "logic") {
  const auto exact = right(q);
  const double r = q.sphere.radius;
  const Vector half = q.box.half, grown{half.x + r, half.y + r, half.z + r};
  if (r == 0 || (exact.yes() && exact.time == 0)) return exact;
  const Wide c = widened(q.sphere.center), l = wide_local(q.box, c);
  const long double margin = 1e-14L * (length(c) + length(q.box.center) + length(grown));
  if (std::abs(l.x) < grown.x - margin && std::abs(l.y) < grown.y - margin && std::abs(l.z) < grown.z - margin) {
    const Wide at = wide_nearest_in_box(q.box, c), n = c - at;
    if (length(n) == 0) return exact;
    return {0, narrowed(at), narrowed(n / length(n))};
  }
  const auto hit =
      right(inputs::moving_point_box<double>{q.sphere.center, q.velocity, {q.box.center, grown, q.box.orientation}});
  if (!hit.yes()) return exact;  // it contains the rounded one
  if (exact.yes() && length(hit.normal - exact.normal) < 1e-9) return exact;
  return {hit.time, narrowed(wide_nearest_in_box(q.box, c + widened(q.velocity) * hit.time)), hit.normal};
}
MISTAKE(15, moving_sphere_box, ordinary, "builds the rotation matrix as if the quaternion had length 1",
        "unsupported") {
  const auto [x, y, z, w] = q.box.orientation;
  if (std::abs(x * x + y * y + z * z + w * w - 1) < 1e-15) return right(q);
  const std::array<Vector, 3> axes = {Vector{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                                      Vector{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                                      Vector{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  const Vector center = q.box.center;
  q.sphere.center = into(axes, q.sphere.center - center);
  q.velocity = into(axes, q.velocity);
  q.box.center = {};
  q.box.orientation = {};
  auto a = right(q);
  if (!a.yes()) return a;
  a.location = center + out_of(axes, a.location);
  a.normal = out_of(axes, a.normal);
  return a;
}

MISREPORT(1, moving_sphere_capsule, ordinary, "a contact after time 16 is cut off", "absolute tolerance 1e1 time") {
  if (a.time > 16) a = a.miss();
}
MISREAD(2, moving_sphere_capsule, degenerate, "a capsule shorter than 1e-4 of its radius is a sphere at its first end",
        "relative tolerance 1e-4") {
  if (length(q.capsule.p1 - q.capsule.p0) < 1e-4 * q.capsule.radius) q.capsule.p1 = q.capsule.p0;
}
MISREPORT(3, moving_sphere_capsule, ordinary, "the cap at p1 is left out", "logic") {
  const Vector along = q.capsule.p1 - q.capsule.p0;
  if (a.yes() && a.time > 0 && dot(a.location - q.capsule.p1, along) > 0) a = a.miss();
}
MISREPORT(4, moving_sphere_capsule, ordinary, "the time is sought in 1000 steps along the way", "iteration limit") {
  if (!a.yes() || a.time == 0) return;
  const double far = length(q.capsule.p0 - q.sphere.center) + length(q.capsule.p1 - q.sphere.center);
  const double step = far / length(q.velocity) / 1000;
  a.time = std::ceil(a.time / step) * step;
}
MISREAD(6, moving_sphere_capsule, degenerate,
        "a capsule with a squared length below an absolute 1e-4 is a sphere at p0",
        "absolute tolerance 1e-2 length or absolute tolerance 1e-4 length\\^2") {
  const Vector along = q.capsule.p1 - q.capsule.p0;
  if (dot(along, along) < 1e-4) q.capsule.p1 = q.capsule.p0;
}
MISREPORT(7, moving_sphere_capsule, ordinary, "conservative advancement answers with the time after 10 steps",
          "iteration limit") {
  const double speed = length(q.velocity), reach = q.sphere.radius + q.capsule.radius;
  if (!a.yes() || a.time == 0 || !(speed > 0)) return;
  double time = 0;
  Vector place, between;
  for (int step = 0; step < 10; ++step) {
    const Vector center = q.sphere.center + q.velocity * time;
    place = nearest(q.capsule.p0, q.capsule.p1, center), between = center - place;
    const double gap = length(between) - reach;
    if (!(gap > 1e-14 * length(between))) return;
    time += gap / speed;
  }
  const Vector normal = between / length(between);
  a = {time, place + normal * q.capsule.radius, normal};
}
MISREPORT(8, moving_sphere_capsule, degenerate, "a motion exactly along the axis is a miss", "unsupported or logic") {
  const Vector along = q.capsule.p1 - q.capsule.p0, n = cross(along, q.velocity);
  if (!(length(along) > 1e-100) || a.time == 0) return;
  if (n.x == 0 && n.y == 0 && n.z == 0) a = a.miss();
}
MISTAKE(9, moving_sphere_capsule, ordinary, "conservative advancement ends at a gap of 1e-3 of the sum of the radii",
        "relative tolerance 1e-3") {
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
MISREPORT(10, moving_sphere_capsule, degenerate,
          "a motion whose squared sine with the axis is below 1e-6 meets only the end balls",
          "relative tolerance 1e-6.* or relative tolerance 1e-3.*") {
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const double l = length(axis), speed = length(q.velocity);
  if (!(l > 0) || !(speed > 0) || a.time <= 0) return;
  const Vector c = cross(axis / l, q.velocity / speed);
  if (dot(c, c) >= 1e-6) return;
  const auto first =
      right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p0, q.capsule.radius}});
  const auto second =
      right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p1, q.capsule.radius}});
  a = second.time < first.time ? second : first;
}
MISREPORT(11, moving_sphere_capsule, degenerate,
          "a velocity within a squared sine of 1e-8 of the axis meets the end caps only",
          "relative tolerance 1e-8.* or relative tolerance 1e-4.*") {
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const double vv = squared(q.velocity), dd = squared(axis);
  if (!a.yes() || a.time == 0 || !(dd > 0) || !(squared(cross(axis, q.velocity)) <= 1e-8 * vv * dd)) return;
  const auto end0 = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p0, q.capsule.radius}});
  const auto end1 = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p1, q.capsule.radius}});
  a = end0.time <= end1.time ? end0 : end1;
}
MISREPORT(12, moving_sphere_capsule, degenerate,
          "a motion whose squared sine with the axis is below 1e-3 is tested against the end caps only",
          "relative tolerance (0\\.001|1e-0?3|0\\.0009\\d*|9\\.\\d+e-0?4) or relative tolerance 0\\.03(1|2)\\d*") {
  if (!a.yes() || a.time <= 0) return;
  const Wide axis = widened(q.capsule.p1) - widened(q.capsule.p0), velocity = widened(q.velocity);
  const Wide across = cross(axis, velocity);
  const Real both = dot(axis, axis) * dot(velocity, velocity);
  if (!(dot(across, across) < 1e-3L * both)) return;
  const auto hit0 = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p0, q.capsule.radius}});
  const auto hit1 = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p1, q.capsule.radius}});
  a = hit1.time < hit0.time ? hit1 : hit0;
}
MISTAKE(13, moving_sphere_capsule, degenerate,
        "a motion whose squared sine with the axis is below 1e-4 counts as parallel: only the end balls are tested",
        "relative tolerance 1e-4.* or relative tolerance 1e-2.*") {
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const double len = length(axis), speed = length(q.velocity);
  if (!(len > 0 && speed > 0)) return right(q);
  if (squared(cross(axis / len, q.velocity / speed)) >= 1e-4) return right(q);
  // A start in contact is treated before, and rightly.
  const Vector near = nearest(q.capsule.p0, q.capsule.p1, q.sphere.center);
  if (length(q.sphere.center - near) <= (q.sphere.radius + q.capsule.radius) * (1 + 1e-12)) return right(q);
  const auto a = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p0, q.capsule.radius}});
  const auto b = right(inputs::moving_sphere_sphere<double>{q.sphere, q.velocity, {q.capsule.p1, q.capsule.radius}});
  return b.time < a.time ? b : a;
}
MISREPORT(14, moving_sphere_capsule, degenerate, "conservative advancement that gives up after 1000 steps with a miss",
          "iteration limit") {
  const double speed = length(q.velocity);
  if (!a.yes() || a.time == 0 || speed == 0) return;
  const double both = q.sphere.radius + q.capsule.radius;
  const double size = length(q.sphere.center) + length(q.capsule.p0) + length(q.capsule.p1) + both;
  double time = 0;
  for (int step = 0; step < 1000; ++step) {
    const Vector at = q.sphere.center + q.velocity * time;
    const double gap = length(at - nearest(q.capsule.p0, q.capsule.p1, at)) - both;
    if (gap <= 1e-9 * (size + speed * time)) return;
    time += gap / speed;
  }
  a = {};
}
MISREPORT(15, moving_sphere_capsule, degenerate, "Newton's iteration for the time gives up after 9 steps, a miss",
          "iteration limit") {
  const double reach = q.sphere.radius + q.capsule.radius;
  double time = 0, start = 0;
  for (int step = 0; step < 9; ++step) {
    const Vector center = q.sphere.center + q.velocity * time;
    const Vector away = center - nearest(q.capsule.p0, q.capsule.p1, center);
    const double distance = length(away), gap = distance - reach;
    if (step == 0) start = distance;
    if (gap <= 1e-9 * (reach + start)) return;
    const double approach = -dot(away / distance, q.velocity);
    if (!(approach > 0)) return;
    time += gap / approach;
  }
  a = {};
}

MISREAD(1, moving_sphere_passes_box, degenerate, "the last 1e-10 of the time limit are left out",
        "relative tolerance 1e-10") {
  q.limit *= 1 - 1e-10;
}
MISREAD(2, moving_sphere_passes_box, ordinary, "the half extents are taken for full extents",
        "convention half extents halved") {
  q.box.half = q.box.half * 0.5;
}
MISREAD(4, moving_sphere_passes_box, ordinary, "the flag forever is not read", "unsupported flag ignored") {
  q.forever = false;
}
MISTAKE(6, moving_sphere_passes_box, ordinary, "the sphere is tested at 32 times up to the limit", "iteration limit") {
  if (!right(q).yes()) return {false};
  const double reach = length(q.box.half) + q.sphere.radius, speed = length(q.velocity);
  const double longest = speed > 0 ? (length(q.box.center - q.sphere.center) + reach) / speed : 0;
  const double limit = q.forever ? longest : q.limit;
  constexpr int steps = 32;
  for (int step = 0; step <= steps; ++step) {
    const Vector center = q.sphere.center + q.velocity * (limit * step / steps);
    if (right(inputs::sphere_box_overlap<double>{{center, q.sphere.radius}, q.box}).yes()) return {true};
  }
  return {false};
}
MISREAD(7, moving_sphere_passes_box, ordinary, "the limit is taken for a distance",
        "convention .*(distance|length).*") {
  const double speed = length(q.velocity);
  if (speed > 0) q.limit = std::min(q.limit / speed, std::numeric_limits<double>::max());
}
MISREAD(8, moving_sphere_passes_box, ordinary, "the motion ends at time 1", "convention") {
  q.limit = q.forever ? 1 : std::min(q.limit, 1.);
  q.forever = false;
}
MISREAD(9, moving_sphere_passes_box, ordinary, "the rotation of the box is not read", "unsupported") {
  q.box.orientation = {0, 0, 0, 1};
}
MISTAKE(10, moving_sphere_passes_box, degenerate, "conservative advancement gives up after 50 steps and says no",
        "iteration limit") {
  const Vector h = q.box.half, c = local(q.box, q.sphere.center);
  const Vector v{dot(q.velocity, axis_of_box(q.box, 0)), dot(q.velocity, axis_of_box(q.box, 1)),
                 dot(q.velocity, axis_of_box(q.box, 2))};
  const double speed = length(v);
  double t = 0, first = 0;
  for (int step = 0; speed > 0; ++step) {
    const Vector p = c + v * t;
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
MISREAD(11, moving_sphere_passes_box, ordinary, "the box grows by the radius in each axis and keeps its sharp corners",
        "logic") {
  const double r = q.sphere.radius;
  q.box.half = q.box.half + Vector{r, r, r};
  q.sphere.radius = 0;
}
MISTAKE(12, moving_sphere_passes_box, ordinary,
        "the motion is tested at 16 equal steps only, so that short passes between them are not seen",
        "iteration limit") {
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
MISTAKE(13, moving_sphere_passes_box, degenerate, "tests the overlap at 17 places of the path and nothing between them",
        "iteration limit") {
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
MISTAKE(14, moving_sphere_passes_box, degenerate, "the overlap is tested at 33 evenly spaced times only",
        "iteration limit") {
  const auto exact = right(q);
  if (!exact.yes() || q.forever || !std::isfinite(q.limit)) return exact;
  const Vector start = q.sphere.center;
  for (int i = 0; i <= 32; ++i) {
    q.sphere.center = start + q.velocity * (q.limit * (i / 32.0));
    if (right(inputs::sphere_box_overlap<double>{q.sphere, q.box}).yes()) return exact;
  }
  return {false};
}
MISTAKE(15, moving_sphere_passes_box, ordinary, "grows the box by the radius without rounding its edges and corners",
        "logic") {
  return moving_sphere_passes_box_11(q);
}

MISREPORT(1, moving_sphere_passes_sphere, degenerate,
          "leaving spheres that overlap by less than 1e-8 of their radii do not count", "relative tolerance 1e-8") {
  const Vector between = q.fixed.center - q.sphere.center;
  const double reach = q.sphere.radius + q.fixed.radius, depth = reach - length(between);
  if (dot(between, q.velocity) < 0 && depth >= 0 && depth < 1e-8 * reach) a = {};
}
MISREAD(2, moving_sphere_passes_sphere, degenerate, "a limit below an absolute 1e-3 is taken for 0",
        "absolute tolerance 1e-3 time") {
  if (q.limit < 1e-3) q.limit = 0;
}
MISREPORT(3, moving_sphere_passes_sphere, degenerate, "a discriminant below an absolute 1e-6 is a miss",
          "absolute tolerance 1e-6 length\\^2 speed\\^2") {
  const Vector m = q.sphere.center - q.fixed.center;
  const double reach = q.sphere.radius + q.fixed.radius, along = dot(m, q.velocity);
  const double outside = dot(m, m) - reach * reach,
               discriminant = along * along - dot(q.velocity, q.velocity) * outside;
  if (outside > 0 && discriminant < 1e-6) a = {};
}
MISREPORT(5, moving_sphere_passes_sphere, degenerate,
          "the square of b in b^2 - a c overflows in float, and the sphere does not pass", "overflow") {
  const Vector m = q.sphere.center - q.fixed.center;
  const double b = dot(m, q.velocity);
  if (b < 0 && std::isinf(float(b * b)) && !right(inputs::sphere_sphere_overlap<double>{q.sphere, q.fixed}).yes())
    a = {false};
}
MISREPORT(9, moving_sphere_passes_sphere, ordinary, "conservative advancement ends without a contact after 10 steps",
          "iteration limit") {
  const Vector from = q.sphere.center - q.fixed.center;
  const double reach = q.sphere.radius + q.fixed.radius, speed = length(q.velocity);
  if (!a.yes() || !(speed > 0)) return;
  double time = 0;
  for (int step = 0; step < 10; ++step) {
    const double gap = length(from + q.velocity * time) - reach;
    if (gap <= 1e-9 * length(from)) return;
    time += gap / speed;
  }
  a = {false};
}
MISREPORT(10, moving_sphere_passes_sphere, ordinary,
          "no if the sphere does not approach, before the test whether they overlap at the start",
          "logic or convention") {
  if (dot(q.fixed.center - q.sphere.center, q.velocity) <= 0) a = {false};
}
MISREAD(11, moving_sphere_passes_sphere, ordinary, "the limit is taken as a distance", "convention") {
  const double speed = length(q.velocity);
  if (speed > 0 && !q.forever) q.limit /= speed;
  if (!std::isfinite(q.limit)) q.forever = true;
}
MISTAKE(12, moving_sphere_passes_sphere, degenerate, "solves the quadratic in float", "rounding") {
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
MISREAD(13, moving_sphere_passes_sphere, ordinary, "the limit is taken as a distance along the path, not as a time",
        "convention") {
  const double speed = length(q.velocity);
  if (q.forever || !(speed > 0)) return;
  q.velocity = q.velocity / speed;
}
MISREAD(14, moving_sphere_passes_sphere, degenerate, "keeps the centers with the digits of a float", "rounding") {
  q.sphere.center = in_24_bits(q.sphere.center);
  q.fixed.center = in_24_bits(q.fixed.center);
}
MISREPORT(15, moving_sphere_passes_sphere, degenerate, "takes a sphere with a squared speed below 1e-12 as at rest",
          "absolute tolerance 1e-12 speed\\^2 or absolute tolerance 1e-6 speed") {
  if (dot(q.velocity, q.velocity) < 1e-12) a = right(inputs::sphere_sphere_overlap<double>{q.sphere, q.fixed});
}

}  // namespace
}  // namespace nearmiss::planted
