/// Mistakes: moving points and rays.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

/// The sum of the angles under which the point sees the triangle's edges.
double sum_of_angles(const Vector& a, const Vector& b, const Vector& c, const Vector& p) {
  const Vector to[] = {a - p, b - p, c - p};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector &u = to[i], &w = to[(i + 1) % 3];
    if (length(u) == 0 || length(w) == 0) return 2 * std::acos(-1.0);
    sum += std::acos(std::clamp(dot(u / length(u), w / length(w)), -1.0, 1.0));
  }
  return sum;
}
/// Whether the point is behind the plane n x + d = 0 of the triangle, which a mesh keeps in float.
bool is_behind_in_float(const collide::Triangle<double>& t, const Vector& p) {
  const Vector exact = normal_of(t);
  const double size = length(exact);
  if (size == 0) return false;
  const Vector unit = exact / size;
  const float nx = float(unit.x), ny = float(unit.y), nz = float(unit.z);
  const float d = -(nx * float(t.v0.x) + ny * float(t.v0.y) + nz * float(t.v0.z));
  const float height = nx * float(p.x) + ny * float(p.y) + nz * float(p.z) + d;
  return height < 0.0f;
}
/// The distance from the box, for sphere tracing.
double distance_from_aabox(const collide::AABox<double>& b, const Vector& p) {
  const auto outside = [](double least, double x, double most) { return std::max({least - x, x - most, 0.0}); };
  return std::hypot(outside(b.min.x, p.x, b.max.x), outside(b.min.y, p.y, b.max.y), outside(b.min.z, p.z, b.max.z));
}

MISREPORT(1, moving_point_plane, degenerate, "a motion along the plane, but for a sine of 1e-6, is a miss",
          "relative tolerance 1e-6") {
  if (a.yes() && grazes(a.normal, q.velocity, 1e-6)) a = a.miss();
}
MISREPORT(2, moving_point_plane, ordinary, "the normal is not divided by its length",
          "convention normal not of unit length") {
  if (a.yes()) a.normal = q.plane.normal;
}
MISREPORT(4, moving_point_plane, degenerate, "a motion along the plane, but for a sine of 1e-3, is a miss",
          "relative tolerance 1e-3") {
  if (a.yes() && grazes(a.normal, q.velocity, 1e-3)) a = a.miss();
}
MISREPORT(5, moving_point_plane, degenerate, "a speed along the normal below an absolute 1e-6 is a miss",
          "absolute tolerance 1e-6 speed") {
  if (a.yes() && std::abs(dot(a.normal, q.velocity)) < 1e-6) a = a.miss();
}
MISTAKE(7, moving_point_plane, ordinary, "the plane is hit from behind too", "convention .*(side|behind|back).*") {
  const auto a = right(q);
  if (a.yes()) return a;
  q.plane = {-q.plane.normal, -q.plane.offset};
  return right(q);
}
MISREPORT(8, moving_point_plane, degenerate,
          "a start behind the plane by less than an absolute 1e-3 is a contact at time 0",
          "absolute tolerance 1e-3 length") {
  const double size = length(q.plane.normal);
  const Vector unit = q.plane.normal / size;
  const double height = dot(unit, q.point) + q.plane.offset / size;
  if (height < 0 && height > -1e-3 && dot(unit, q.velocity) < 0) a = {0, q.point, unit};
}
MISREAD(10, moving_point_plane, ordinary, "the plane is read as normal . x = offset", "convention") {
  q.plane.offset = -q.plane.offset;
}
MISREPORT(11, moving_point_plane, degenerate, "a miss unless normal . velocity is below -1e-6",
          "absolute tolerance 1e-6 .*") {
  if (dot(q.plane.normal, q.velocity) > -1e-6) a = a.miss();
}
MISREPORT(12, moving_point_plane, degenerate, "a hit after a path longer than 1e4 is a miss",
          "absolute tolerance (1e\\+?0?4|10000) length") {
  if (a.time * length(q.velocity) > 1e4) a = {};
}
MISTAKE(13, moving_point_plane, degenerate, "a path ends after 10000 units of length, whatever the scene's size",
        "absolute tolerance "
        "(1e\\+?0?4|10000|1\\.0\\d*e\\+?0?4|9\\.9\\d*e\\+?0?3|99\\d\\d(\\.\\d+)?|100\\d\\d(\\.\\d+)?) length") {
  return moving_point_plane_12(q);
}
MISREPORT(14, moving_point_plane, degenerate, "a skin: a start up to 1e-3 behind the plane counts as on it",
          "absolute tolerance (1e-0?3|0\\.001) length") {
  if (a.yes()) return;
  const double size = length(q.plane.normal);
  const Vector unit = q.plane.normal / size;
  const double height = dot(unit, q.point) + q.plane.offset / size;
  if (height < -1e-3 || !(height < 0) || !(dot(unit, q.velocity) < 0)) return;
  a = {0, q.point - unit * height, unit};
}
MISREPORT(15, moving_point_plane, degenerate, "a far limit: hits later than a time of 1000 are misses",
          "absolute tolerance (1e\\+?0?3|1000) time") {
  if (a.time > 1e3) a = {};
}

MISREPORT(1, moving_point_triangle, degenerate, "a determinant below an absolute 1e-12 is a miss",
          "absolute tolerance 1e-12 length\\^2 speed") {
  if (std::abs(dot(q.velocity, normal_of(q.triangle))) < 1e-12) a = {};
}
MISTAKE(2, moving_point_triangle, degenerate, "weights down to -1e-9 are inside", "relative tolerance 1e-9") {
  const auto a = right(q);
  if (a.yes()) return a;
  constexpr double larger = 1 + 3e-9;
  const Vector middle = (q.triangle.v0 + q.triangle.v1 + q.triangle.v2) * (1. / 3);
  for (Vector* corner : {&q.triangle.v0, &q.triangle.v1, &q.triangle.v2})
    *corner = middle + (*corner - middle) * larger;
  return right(q);
}
MISTAKE(3, moving_point_triangle, ordinary, "the back of the triangle is hit too", "convention both sides") {
  const auto a = right(q);
  if (a.yes()) return a;
  std::swap(q.triangle.v1, q.triangle.v2);
  return right(q);
}
MISTAKE(5, moving_point_triangle, degenerate, "the weights of the crossing are floats", "rounding") {
  const auto a = right(q);
  const auto& t = q.triangle;
  const Vector edge1 = t.v1 - t.v0, edge2 = t.v2 - t.v0, n = cross(edge1, edge2), from = q.point - t.v0;
  const double determinant = -dot(q.velocity, n), distance = dot(from, n);
  if (!(determinant > 0) || distance < 0) return a;
  const float u = float(dot(from, cross(q.velocity, edge2)) / determinant);
  const float v = float(dot(edge1, cross(q.velocity, from)) / determinant);
  const bool inside = u >= 0 && v >= 0 && u + v <= 1;
  if (inside == a.yes()) return a;
  if (!inside) return a.miss();
  const double time = distance / determinant;
  return {time, q.point + q.velocity * time, n / length(n)};
}
MISREPORT(8, moving_point_triangle, degenerate,
          "a determinant below 1e-5 of the product of velocity and edges is a miss", "relative tolerance 1e-5") {
  const auto& t = q.triangle;
  const double determinant = -dot(q.velocity, normal_of(t));
  if (determinant < 1e-5 * length(t.v1 - t.v0) * length(t.v2 - t.v0) * length(q.velocity)) a = {};
}
MISREPORT(10, moving_point_triangle, degenerate, "a determinant below 1e-8 counts as a parallel motion: a miss",
          "absolute tolerance 1e-8 .*") {
  const double determinant = -dot(q.velocity, normal_of(q.triangle));
  if (determinant < 1e-8) a = {};
}
MISREPORT(11, moving_point_triangle, degenerate, "the determinant of Moller and Trumbore below 1e-6 is a miss",
          "absolute tolerance 1e-6 .*") {
  if (-dot(q.velocity, normal_of(q.triangle)) < 1e-6) a = a.miss();
}
MISTAKE(12, moving_point_triangle, degenerate, "a determinant below 1e-8 counts as parallel",
        "absolute tolerance 1e-0?8 length\\^2 speed") {
  return moving_point_triangle_10(q);
}
MISREPORT(13, moving_point_triangle, degenerate,
          "a determinant n.v below 1e-6 counts as a motion parallel to the triangle",
          "absolute tolerance 1e-6 length\\^2 speed") {
  const double determinant = -dot(normal_of(q.triangle), q.velocity);
  if (determinant > -1e-6 && determinant < 1e-6) a = {};
}
MISTAKE(14, moving_point_triangle, degenerate, "barycentric coordinates down to -1e-4 count as inside",
        "relative tolerance (1e-4|0\\.0001)") {
  const auto exact = right(q);
  const Wide v0 = widened(q.triangle.v0), e1 = widened(q.triangle.v1) - v0, e2 = widened(q.triangle.v2) - v0;
  const bool flat = length(cross(e1, e2)) <= 1e-10L * length(e1) * length(e2);
  if (exact.yes() || flat) return exact;
  const long double e = 1e-4L;
  q.triangle = {narrowed(v0 - e1 * e - e2 * e), narrowed(v0 + e1 * (1 + 2 * e) - e2 * e),
                narrowed(v0 - e1 * e + e2 * (1 + 2 * e))};
  const auto loose = right(q);
  return loose.yes() && loose.time > 0 ? loose : exact;
}
MISTAKE(15, moving_point_triangle, degenerate,
        "sums the normal from cross products of the corners' position vectors, which cancels far from the origin",
        "rounding") {
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
  a.normal = unit_of(n);
  return a;
}

MISREAD(1, moving_point_triangle_prepared, ordinary, "the edge v1 v2 is not tested", "logic") {
  q.triangle.v1 = q.triangle.v1 * 2. - q.triangle.v2;
}
MISREPORT(2, moving_point_triangle_prepared, degenerate,
          "a product of velocity and normal above an absolute -1e-9 is a miss",
          "absolute tolerance 1e-9 length\\^2 speed") {
  if (dot(q.velocity, normal_of(q.triangle)) > -1e-9) a = {};
}
MISTAKE(6, moving_point_triangle_prepared, ordinary,
        "the time is not compared with 0: a triangle behind the start is hit",
        "logic or convention .*(back|behind|before|negative|line).*") {
  const Vector n = normal_of(q.triangle);
  const double approach = -dot(n, q.velocity), height = dot(n, q.point - q.triangle.v0);
  if (!(approach > 0) || height >= 0) return right(q);
  const double time = height / approach;
  q.point = q.point + q.velocity * (2 * time);
  auto a = right(q);
  if (a.yes()) a.time = time;
  return a;
}
MISREPORT(7, moving_point_triangle_prepared, degenerate, "a contact before an absolute time 1e-6 is a miss",
          "absolute tolerance 1e-6 time") {
  if (a.yes() && a.time < 1e-6) a = a.miss();
}
MISREPORT(8, moving_point_triangle_prepared, degenerate,
          "the squared normal overflows in float, and the normal becomes zero", "overflow") {
  const Vector n = normal_of(q.triangle);
  if (a.yes() && std::isinf(float(dot(n, n)))) a.normal = {};
}
MISREPORT(10, moving_point_triangle_prepared, degenerate,
          "a miss if the determinant, normal . velocity, is below 1e-6 in magnitude",
          "absolute tolerance 1e-6 (length\\^[23]( speed)?|.*velocity.*)") {
  if (std::abs(dot(normal_of(q.triangle), q.velocity)) < 1e-6) a = {};
}

MISREPORT(1, moving_point_rectangle, degenerate, "a hit within 1e-9 of the diagonal falls between the triangles",
          "relative tolerance 1e-9") {
  const Vector v0 = q.rectangle.v0, v2 = q.rectangle.v2;
  if (a.yes() && length(nearest(v0, v2, a.location) - a.location) < 1e-9 * length(v2 - v0)) a = a.miss();
}
MISREPORT(5, moving_point_rectangle, degenerate, "a contact before an absolute time 1e-4 is a miss",
          "absolute tolerance 1e-4 time") {
  if (a.yes() && a.time < 1e-4) a = a.miss();
}
MISTAKE(9, moving_point_rectangle, degenerate, "weights down to -1e-5 are inside", "relative tolerance 1e-5") {
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
MISREAD(10, moving_point_rectangle, ordinary, "a parallelogram from v0, v1 and v3; v2 is not read", "unsupported") {
  q.rectangle.v2 = q.rectangle.v1 + (q.rectangle.v3 - q.rectangle.v0);
}
MISTAKE(11, moving_point_rectangle, ordinary, "the fourth corner is completed from the other three: v2 is never read",
        "unsupported or convention") {
  return moving_point_rectangle_10(q);
}
MISTAKE(12, moving_point_rectangle, degenerate,
        "a triangle whose normal, not normalised, has -n.v below 1e-6 is skipped as parallel to the motion",
        "absolute tolerance 1e-0?6 length\\^2 speed") {
  const auto& r = q.rectangle;
  const Wide v = widened(q.velocity);
  const bool first = -dot(wide_normal(r.v0, r.v1, r.v2), v) >= 1e-6L;
  const bool second = -dot(wide_normal(r.v0, r.v2, r.v3), v) >= 1e-6L;
  if (first && second) return right(q);
  if (first) return right(inputs::moving_point_rectangle<double>{q.point, q.velocity, {r.v0, r.v1, r.v2, r.v2}});
  if (second) return right(inputs::moving_point_rectangle<double>{q.point, q.velocity, {r.v0, r.v2, r.v3, r.v3}});
  return {};
}
MISTAKE(13, moving_point_rectangle, degenerate, "barycentric weights down to -0.01 count as inside",
        "relative tolerance (1e-0?2|0\\.01(0\\d*)?|0\\.0099\\d*|9\\.9\\d*e-0?3|1\\.0\\d*e-0?2)") {
  constexpr double slack = 0.01;
  auto best = right(q);
  const auto& r = q.rectangle;
  for (const std::array<Vector, 3>& v :
       {std::array<Vector, 3>{r.v0, r.v1, r.v2}, std::array<Vector, 3>{r.v0, r.v2, r.v3}}) {
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
MISREPORT(14, moving_point_rectangle, degenerate,
          "a point is inside where the angles of its corners sum up to a full turn within 0.01",
          "relative tolerance (0\\.01|1e-0?2)") {
  const auto& k = q.rectangle;
  const collide::Triangle<double> halves[] = {{k.v0, k.v1, k.v2}, {k.v0, k.v2, k.v3}};
  for (const auto& t : halves) {
    const Vector n = normal_of(t);
    if (!(length(n) > 1e-6 * length(t.v1 - t.v0) * length(t.v2 - t.v0))) continue;
    const Vector unit = n / length(n);
    const double height = dot(unit, q.point - t.v0), speed = dot(unit, q.velocity);
    if (!(speed < 0) || !(height > 0)) continue;
    const double time = -height / speed;
    if (!(time < a.time * (1 - 1e-9))) continue;
    const Vector at = q.velocity * time;
    if (sum_of_angles(t.v0 - q.point, t.v1 - q.point, t.v2 - q.point, at) < 2 * std::acos(-1.0) - 0.01) continue;
    a = {time, q.point + at, unit};
  }
}
MISTAKE(15, moving_point_rectangle, degenerate,
        "the height of the start above the plane, n p + d, is in float where it decides on front or back", "rounding") {
  const auto& r = q.rectangle;
  inputs::moving_point_rectangle<double>::Answer first{};
  for (const collide::Triangle<double>& t : {collide::Triangle<double>{r.v0, r.v1, r.v2}, {r.v0, r.v2, r.v3}}) {
    if (is_behind_in_float(t, q.point)) continue;
    const auto hit = right(inputs::moving_point_triangle<double>{q.point, q.velocity, t});
    if (hit.time < first.time) first = hit;
  }
  return first;
}

MISREPORT(1, moving_point_sphere, degenerate, "a grazing hit, with a sine below 1e-6, is a miss",
          "relative tolerance 1e-6") {
  if (a.yes() && a.time > 0 && grazes(a.normal, q.velocity, 1e-6)) a = a.miss();
}
MISREAD(2, moving_point_sphere, ordinary, "the flag solid is not read", "unsupported flag ignored") { q.solid = true; }
MISREPORT(4, moving_point_sphere, ordinary, "the discriminant is computed in float", "rounding") {
  const Vector m = q.point - q.sphere.center;
  const double outside = dot(m, m) - q.sphere.radius * q.sphere.radius;
  if (!a.yes() || a.time == 0 || outside <= 0) return;
  const double along = dot(m, q.velocity), square = dot(q.velocity, q.velocity);
  const float discriminant = float(along * along - square * outside);
  a.time = (-along - std::sqrt(std::max(0.F, discriminant))) / square;
}
MISREPORT(6, moving_point_sphere, degenerate, "a squared speed below an absolute 1e-6 is no motion",
          "absolute tolerance 1e-3 speed or absolute tolerance 1e-6 speed\\^2") {
  if (a.yes() && a.time > 0 && dot(q.velocity, q.velocity) < 1e-6) a = a.miss();
}
MISTAKE(7, moving_point_sphere, degenerate, "the discriminant b^2 - a c is computed in double, and cancels",
        "rounding") {
  const Vector m = q.point - q.sphere.center;
  const double radius = q.sphere.radius, square = dot(q.velocity, q.velocity), b = dot(m, q.velocity);
  const double outside = dot(m, m) - radius * radius, discriminant = b * b - square * outside;
  const bool is_usual = std::abs(b) > 1e-120 && std::isfinite(b * b) && std::isfinite(square * outside);
  if (!(is_usual && b < 0 && outside > 0 && radius > 0)) return right(q);
  if (discriminant < 0) return decltype(right(q))::miss();
  const double time = (-b - std::sqrt(discriminant)) / square;
  const Vector place = q.point + q.velocity * time, out = place - q.sphere.center;
  if (!(length(out) > 0)) return right(q);
  return {time, place, out / length(out)};
}
MISREPORT(8, moving_point_sphere, degenerate, "the discriminant underflows in float, and the point misses",
          "underflow") {
  const Vector m = q.point - q.sphere.center;
  const double b = dot(m, q.velocity), outside = dot(m, m) - q.sphere.radius * q.sphere.radius;
  const double discriminant = b * b - dot(q.velocity, q.velocity) * outside;
  if (a.yes() && a.time > 0 && discriminant > 0 && !(float(discriminant) > 0)) a = a.miss();
}
MISREPORT(9, moving_point_sphere, ordinary, "the normal of an exit points against the motion", "convention or logic") {
  if (a.yes() && !q.solid && dot(a.normal, q.velocity) > 0) a.normal = -a.normal;
}
MISTAKE(10, moving_point_sphere, degenerate, "the discriminant b b - a c of the quadratic equation cancels",
        "rounding") {
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
MISTAKE(11, moving_point_sphere, ordinary, "the discriminant is b*b - a*c, which cancels far from the sphere",
        "rounding or overflow or underflow") {
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
MISREPORT(12, moving_point_sphere, ordinary,
          "the normal is flipped to face against the motion, also where the point leaves the sphere", "convention") {
  if (a.yes() && wide_distance(q.point, q.sphere.center) <= Real(q.sphere.radius) &&
      dot(widened(a.normal), widened(q.velocity)) > 0)
    a.normal = -a.normal;
}
MISTAKE(13, moving_point_sphere, degenerate,
        "the textbook discriminant b^2 - 4ac cancels when the sphere is small and far", "rounding") {
  const double r = q.sphere.radius;
  if (r == 0 || right(inputs::sphere_sphere_overlap<double>{{q.point, 0}, q.sphere}).decision) return right(q);
  const Vector m = q.point - q.sphere.center;
  const double distance = length(m), speed = length(q.velocity);
  // Where products would leave the range of double, the answer is right.
  for (double x : {distance, speed, distance * speed})
    if (!(x > 1e-70 && x < 1e70)) return right(q);
  const double a = squared(q.velocity), b = 2 * dot(m, q.velocity), c = squared(m) - r * r;
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
MISREPORT(14, moving_point_sphere, ordinary,
          "the normal is turned against the velocity where the point leaves the sphere", "convention") {
  const bool starts_in = right(inputs::sphere_sphere_overlap<double>{{q.point, 0}, q.sphere}).yes();
  if (a.yes() && starts_in && dot(widened(a.normal), widened(q.velocity)) > 0) a.normal = -a.normal;
}
MISTAKE(15, moving_point_sphere, degenerate,
        "looks for the sphere in 256 equal steps along the path and misses a shorter chord", "iteration limit") {
  const Vector between = q.sphere.center - q.point;
  const double distance = length(between), speed = length(q.velocity);
  const auto answer = right(q);
  if (!answer.yes() || answer.time == 0 || distance <= q.sphere.radius) return answer;
  const double step = (distance + q.sphere.radius) / speed / 256;
  for (int i = 1; i <= 256; ++i)
    if (length(between - q.velocity * (i * step)) <= q.sphere.radius) return answer;
  return {};
}

MISREPORT(1, moving_point_capsule, degenerate, "a hit within 1e-10 of the seam of side and second end is a miss",
          "relative tolerance 1e-10") {
  const Vector along = q.capsule.p1 - q.capsule.p0;
  const double beyond = dot(a.location - q.capsule.p1, along) / dot(along, along);
  if (a.yes() && a.time > 0 && std::abs(beyond) < 1e-10) a = a.miss();
}
MISREPORT(2, moving_point_capsule, degenerate, "a motion along the axis, but for a sine of 1e-8, is a miss",
          "relative tolerance 1e-8") {
  const Vector along = q.capsule.p1 - q.capsule.p0;
  if (length(cross(along, q.velocity)) < 1e-8 * length(along) * length(q.velocity)) a = {};
}
MISREAD(4, moving_point_capsule, ordinary, "the radius is taken for a diameter", "convention radius halved") {
  q.capsule.radius /= 2;
}
MISREPORT(5, moving_point_capsule, ordinary, "sphere tracing ends with a miss after 24 steps", "iteration limit") {
  if (!a.yes() || a.time == 0) return;
  const auto gap_at = [&](double time) {
    const Vector p = q.point + q.velocity * time;
    return length(p - nearest(q.capsule.p0, q.capsule.p1, p)) - q.capsule.radius;
  };
  const double speed = length(q.velocity), enough = 1e-9 * gap_at(0);
  if (!advances<double>(gap_at, speed, enough, 24)) a = a.miss();
}
MISREPORT(7, moving_point_capsule, ordinary, "the normal on a cap is perpendicular to the axis", "logic") {
  const Vector along = q.capsule.p1 - q.capsule.p0, from = a.location - q.capsule.p0;
  if (!a.yes() || !(length(along) > 0) || q.capsule.radius == 0) return;
  const Vector unit = along / length(along);
  const double t = dot(from, unit);
  if (t >= 0 && t <= length(along)) return;
  const Vector out = from - unit * t;
  if (length(out) > 1e-9 * length(from)) a.normal = out / length(out);
}
MISREPORT(8, moving_point_capsule, degenerate,
          "with a squared cross product of axis and velocity below an absolute 1e-6, only the caps are tested",
          "absolute tolerance 1e-6 length\\^2 speed\\^2 or absolute tolerance 1e-3 length speed") {
  const auto& [p0, p1, radius] = q.capsule;
  const Vector along = p1 - p0, n = cross(along, q.velocity);
  if (!a.yes() || a.time == 0 || !(dot(n, n) < 1e-6)) return;
  const double t = dot(a.location - p0, along) / dot(along, along);
  if (!(t > 0 && t < 1)) return;
  const auto first = right(inputs::moving_point_sphere<double>{q.point, q.velocity, {p0, radius}, true});
  const auto second = right(inputs::moving_point_sphere<double>{q.point, q.velocity, {p1, radius}, true});
  a = first.time <= second.time ? first : second;
}
MISREPORT(9, moving_point_capsule, degenerate,
          "the square of b in b^2 - a c of the side overflows in float, and the point misses the side", "overflow") {
  const Vector along = q.capsule.p1 - q.capsule.p0, from = q.point - q.capsule.p0;
  const double size = length(along), t = dot(a.location - q.capsule.p0, along / size) / size;
  if (!a.yes() || a.time == 0 || !(t >= 0 && t <= 1)) return;
  const double b = half_b_and_discriminant(from, q.velocity, along, q.capsule.radius).first;
  if (std::isinf(float(b * b))) a = a.miss();
}
MISTAKE(10, moving_point_capsule, degenerate,
        "a motion within a sine of 1e-3 of the axis counts as parallel to it: outside of the cylinder it misses",
        "relative tolerance (1e-3|0\\.001) or relative tolerance 1e-6") {
  const Vector d = q.capsule.p1 - q.capsule.p0;
  if (length(d) > 0 && length(cross(q.velocity, d)) < 1e-3 * length(q.velocity) * length(d)) {
    const double from_axis = length(cross(q.point - q.capsule.p0, d)) / length(d);
    if (from_axis > q.capsule.radius) return {};
  }
  return right(q);
}
MISREPORT(11, moving_point_capsule, ordinary, "the normal is that of the infinite cylinder, also on the caps",
          "logic") {
  if (!a.yes()) return;
  const Vector d = q.capsule.p1 - q.capsule.p0;
  if (!(dot(d, d) > 0)) return;
  const Vector foot = q.capsule.p0 + d * (dot(a.location - q.capsule.p0, d) / dot(d, d));
  const Vector out = a.location - foot;
  if (length(out) > 0) a.normal = unit_of(out);
}
MISTAKE(12, moving_point_capsule, degenerate,
        "the products of the quadratic's discriminant overflow in float, which gives NaN and a miss",
        "overflow or underflow") {
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
MISREPORT(13, moving_point_capsule, degenerate,
          "marches along the path by the distance from the capsule and gives up after 256 steps", "iteration limit") {
  if (!a.yes() || !(a.time > 0)) return;
  const auto& c = q.capsule;
  const Vector start = q.point - c.p0, axis = c.p1 - c.p0, step = unit_of(q.velocity);
  const double converged = 1e-9 * (length(start) + length(axis) + c.radius);
  double travelled = 0;
  for (int i = 0; i < 256; ++i) {
    const Vector at = start + step * travelled;
    const double distance = length(at - nearest({}, axis, at)) - c.radius;
    if (distance <= converged) return;
    travelled += distance;
  }
  a = {};
}
MISREPORT(14, moving_point_capsule, degenerate,
          "sphere tracing gives up after 100 steps, so that grazing hits are missed", "iteration limit") {
  if (!a.yes() || a.time == 0) return;
  const Wide d = widened(q.capsule.p1) - widened(q.capsule.p0), m = widened(q.point) - widened(q.capsule.p0);
  const Wide v = widened(q.velocity);
  const long double dd = dot(d, d), speed = length(v);
  const auto distance = [&](long double t) {
    const Wide p = m + v * t;
    const long double s = dd > 0 ? std::clamp(dot(p, d) / dd, 0.0L, 1.0L) : 0;
    return length(p - d * s) - q.capsule.radius;
  };
  const long double start = distance(0), rounds = 1e-16L * (length(m) + length(d) + q.capsule.radius);
  if (!advances<long double>(distance, speed, 1e-6L * start + rounds, 100)) a = {};
}
MISREPORT(15, moving_point_capsule, ordinary,
          "misses if the start lies in the infinite cylinder around the capsule's axis, beyond an end",
          "logic or unsupported") {
  const Vector axis = q.capsule.p1 - q.capsule.p0;
  const double size = length(axis);
  if (!(size > 0)) return;
  if (length(cross(axis / size, q.point - q.capsule.p0)) < q.capsule.radius) a = {};
}

MISREPORT(1, moving_point_box, degenerate, "a start within 1e-8 of the surface is a contact at time 0 there",
          "absolute tolerance 1e-8 length") {
  if (a.yes() && a.time * length(q.velocity) < 1e-8) a.time = 0, a.location = q.point;
}
MISREAD(2, moving_point_box, ordinary, "the box is turned by the inverse of its rotation",
        "convention rotation inverted") {
  auto& r = q.box.orientation;
  r.x = -r.x, r.y = -r.y, r.z = -r.z;
}
MISREAD(4, moving_point_box, ordinary, "the rotation of the box is not read", "unsupported rotation ignored") {
  q.box.orientation = {};
}
MISREPORT(6, moving_point_box, ordinary, "a start in the box is a contact at time 0",
          "convention .*(start|inside|solid).*") {
  const auto depth = right(inputs::sphere_box_penetration<double>{{q.point, 0}, q.box});
  if (!(depth.depth > 0)) return;
  a = {0, q.point, -depth.normal};
}
MISREPORT(7, moving_point_box, ordinary, "the normal is not turned back from the frame of the box",
          "convention .*(frame|local|rotat|turn).* or logic") {
  const Vector n = a.normal;
  a.normal = {dot(n, axis_of_box(q.box, 0)), dot(n, axis_of_box(q.box, 1)), dot(n, axis_of_box(q.box, 2))};
}
MISREPORT(9, moving_point_box, degenerate,
          "a point that is in the box for less than an absolute time 1e-6, but not zero, misses it",
          "absolute tolerance 1e-6 time") {
  if (!a.yes()) return;
  const auto half = numbers_of(q.box.half);
  double last = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const Vector axis = axis_of_box(q.box, k);
    const double from = dot(q.point - q.box.center, axis), along = dot(q.velocity, axis);
    if (along != 0) last = std::min(last, (std::copysign(half[k], along) - from) / along);
  }
  const double stay = last - a.time;
  if (stay > 1e-12 * last && stay < 1e-6) a = a.miss();
}
MISREPORT(10, moving_point_box, ordinary, "the normal is not rotated back out of the box's frame", "convention") {
  if (!a.yes()) return;
  Vector local{};
  double* to[] = {&local.x, &local.y, &local.z};
  for (int i = 0; i < 3; ++i) *to[i] = dot(a.normal, axis_of_box(q.box, i));
  a.normal = local;
}
MISTAKE(11, moving_point_box, degenerate,
        "a velocity component below 1e-6 in the box's frame counts as parallel to the slab",
        "absolute tolerance 1e-6 .*") {
  const Axes axes = axes_of_box(q.box);
  const Vector v = into(axes, q.velocity), p = into(axes, q.point - q.box.center);
  Vector moved = q.velocity;
  for (int i = 0; i < 3; ++i)
    if (std::abs(component(v, i)) < 1e-6) {
      if (std::abs(component(p, i)) > component(q.box.half, i)) return inputs::moving_point_box<double>::Answer::miss();
      moved = moved - axes[i] * component(v, i);
    }
  q.velocity = moved;
  return right(q);
}
MISREPORT(12, moving_point_box, degenerate,
          "a contact at time 0 is a miss: a start on the surface is rejected by t <= 0", "unsupported or convention") {
  if (a.time <= 0) a = {};
}
MISREAD(13, moving_point_box, ordinary, "the four numbers of the quaternion are read with w first", "convention") {
  const auto o = q.box.orientation;
  q.box.orientation.w = o.x;
  q.box.orientation.x = o.y;
  q.box.orientation.y = o.z;
  q.box.orientation.z = o.w;
}
MISTAKE(14, moving_point_box, degenerate,
        "a velocity below 1e-6 along an axis of the box counts as parallel to that slab",
        "absolute tolerance 1e-0?6 speed") {
  const auto r = right(q);
  if (r.time == 0) return r;
  double place[3], speed[3];
  bool dropped = false;
  Vector axes[3];
  for (int i = 0; i < 3; ++i) {
    axes[i] = axis_of_box(q.box, i);
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
MISTAKE(15, moving_point_box, ordinary, "reads the quaternion x, y, z, w as w, x, y, z", "convention") {
  return moving_point_box_13(q);
}

MISREAD(1, moving_point_aabox, degenerate, "a component below 1e-9 of the largest one of the velocity is taken for 0",
        "relative tolerance 1e-9") {
  Vector& v = q.velocity;
  const double least = 1e-9 * std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  for (double* component : {&v.x, &v.y, &v.z}) {
    if (std::abs(*component) < least) *component = 0;
  }
}
MISREPORT(2, moving_point_aabox, degenerate, "a motion with a component of zero is a miss", "unsupported or logic") {
  const bool moves = q.velocity.x != 0 || q.velocity.y != 0 || q.velocity.z != 0;
  if (moves && a.yes() && (q.velocity.x == 0 || q.velocity.y == 0 || q.velocity.z == 0)) a = a.miss();
}
MISREPORT(3, moving_point_aabox, ordinary, "a contact after time 1 is a miss", "convention motion ends at time 1") {
  if (a.yes() && a.time > 1) a = a.miss();
}
MISREPORT(5, moving_point_aabox, ordinary, "the face is that of the largest offset from the center, without the sizes",
          "logic") {
  if (!a.yes()) return;
  const Vector from = a.location - (q.aabox.min + q.aabox.max) * 0.5;
  const double x = std::abs(from.x), y = std::abs(from.y), z = std::abs(from.z);
  a.normal = {};
  if (x >= y && x >= z)
    a.normal.x = std::copysign(1., from.x);
  else if (y >= z)
    a.normal.y = std::copysign(1., from.y);
  else
    a.normal.z = std::copysign(1., from.z);
}
MISREPORT(7, moving_point_aabox, degenerate, "a start within an absolute 1e-4 of the box is inside",
          "absolute tolerance 1e-4 length") {
  constexpr double margin = 1e-4;
  const auto p = numbers_of(q.point), low = numbers_of(q.aabox.min), high = numbers_of(q.aabox.max);
  for (std::size_t k = 0; k < 3; ++k) {
    if (p[k] < low[k] - margin || p[k] > high[k] + margin) return;
  }
  a = {true, q.point, INFINITY, {}};
}
MISREPORT(9, moving_point_aabox, ordinary, "a start in the box is a contact at time 0", "convention") {
  if (!a.inside) return;
  const auto p = numbers_of(q.point), low = numbers_of(q.aabox.min), high = numbers_of(q.aabox.max);
  double least = INFINITY;
  Vector normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const double depth = std::min(p[k] - low[k], high[k] - p[k]), sign = p[k] - low[k] < high[k] - p[k] ? -1 : 1;
    if (depth < least) least = depth, normal = {k == 0 ? sign : 0, k == 1 ? sign : 0, k == 2 ? sign : 0};
  }
  a = {false, q.point, 0, normal};
}
MISREAD(10, moving_point_aabox, degenerate,
        "a component of the velocity below 1e-6 counts as parallel to the slab, as zero", "absolute tolerance 1e-6.*") {
  for (double* v : {&q.velocity.x, &q.velocity.y, &q.velocity.z})
    if (std::abs(*v) < 1e-6) *v = 0;  // parallel to the slab
}
MISTAKE(11, moving_point_aabox, degenerate, "a component of the velocity below 1e-6 counts as parallel to its slab",
        "absolute tolerance 1e-6 .*") {
  return moving_point_aabox_10(q);
}
MISREPORT(12, moving_point_aabox, ordinary,
          "the normal is along the largest component of location minus center, as if the box were a cube",
          "logic or unsupported") {
  if (!a.yes()) return;
  const Vector& low = q.aabox.min;
  const Vector& high = q.aabox.max;
  const Vector from = a.location - (low * 0.5 + high * 0.5);
  const double grid = 1e-14 * (length(low) + length(high));
  const int entered = a.normal.x != 0 ? 0 : a.normal.y != 0 ? 1 : 2;
  int face = entered;
  double most = std::abs(component(from, entered)) + grid;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(component(from, k)) <= most) continue;
    most = std::abs(component(from, k));
    face = k;
  }
  if (face == entered) return;
  const double sign = component(from, face) < 0 ? -1 : 1;
  a.normal = {face == 0 ? sign : 0.0, face == 1 ? sign : 0.0, face == 2 ? sign : 0.0};
}
MISREPORT(13, moving_point_aabox, ordinary,
          "the normal is that of the largest component of location - center, not divided by the half extents",
          "logic") {
  if (!a.yes()) return;
  const Vector from = a.location - (q.aabox.min * 0.5 + q.aabox.max * 0.5);
  const double x = std::abs(from.x), y = std::abs(from.y), z = std::abs(from.z);
  if (x >= y && x >= z) {
    a.normal = {std::copysign(1.0, from.x), 0, 0};
  } else if (y >= z) {
    a.normal = {0, std::copysign(1.0, from.y), 0};
  } else {
    a.normal = {0, 0, std::copysign(1.0, from.z)};
  }
}
MISTAKE(14, moving_point_aabox, degenerate, "a velocity along an axis below 1e-5 counts as parallel to the slab",
        "absolute tolerance 1e-5 speed") {
  const auto exact = right(q);
  if (exact.inside) return exact;
  auto slower = q;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(component(q.velocity, k)) < 1e-5) component(slower.velocity, k) = 0;
  }
  if (slower.velocity == q.velocity) return exact;
  auto a = right(slower);
  for (int k = 0; a.yes() && k < 3; ++k) {
    if (component(slower.velocity, k) == 0) component(a.location, k) += component(q.velocity, k) * a.time;
  }
  return a;
}
MISREPORT(15, moving_point_aabox, degenerate, "gives the normal of the first face within 1e-4 of the location",
          "absolute tolerance 1e-4 length") {
  if (!a.yes()) return;
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
}

MISREPORT(1, ray_aabox, ordinary, "a direction with three negative components is a miss", "logic") {
  if (q.ray.direction.x < 0 && q.ray.direction.y < 0 && q.ray.direction.z < 0) a = {};
}
MISREAD(2, ray_aabox, degenerate, "a component of the direction below an absolute 1e-6 is taken for 0",
        "absolute tolerance 1e-6 length of a direction") {
  Vector& d = q.ray.direction;
  const Vector given = d;
  for (double* component : {&d.x, &d.y, &d.z}) {
    if (std::abs(*component) < 1e-6) *component = 0;
  }
  if (d.x == 0 && d.y == 0 && d.z == 0) d = given;
}
MISTAKE(3, ray_aabox, degenerate, "a ray that begins on a face, and moves in its plane, is a miss",
        "unsupported or logic") {
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
MISREPORT(6, ray_aabox, ordinary, "a ray that starts in the box has the location where it leaves",
          "convention .*(start|inside|exit|leave).*") {
  if (!a.inside) return;
  const auto& [origin, direction] = q.ray;
  const auto way = [](double from, double along, double low, double high) {
    return along > 0 ? (high - from) / along : along < 0 ? (low - from) / along : INFINITY;
  };
  const double t = std::min({way(origin.x, direction.x, q.aabox.min.x, q.aabox.max.x),
                             way(origin.y, direction.y, q.aabox.min.y, q.aabox.max.y),
                             way(origin.z, direction.z, q.aabox.min.z, q.aabox.max.z)});
  a.location = origin + direction * t;
}
MISREPORT(7, ray_aabox, ordinary, "the ray ends where its direction ends",
          "convention .*(end|time 1|segment|length).*") {
  if (a.yes() && length(a.location - q.ray.origin) > length(q.ray.direction)) a = {};
}
MISTAKE(8, ray_aabox, ordinary, "the ray is taken for a line", "convention or logic") {
  const auto a = right(q);
  if (a.yes()) return a;
  q.ray.direction = -q.ray.direction;
  return right(q);
}
MISTAKE(9, ray_aabox, ordinary, "the inverse of the direction is a float", "rounding") {
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
MISTAKE(10, ray_aabox, degenerate, "a component of the direction below 1e-6 counts as parallel to the slab",
        "absolute tolerance 1e-6 .*") {
  const auto a = right(q);
  auto& d = q.ray.direction;
  for (double* x : {&d.x, &d.y, &d.z})
    if (std::abs(*x) < 1e-6) *x = 0;
  if (d == Vector{}) return a.inside ? a : inputs::ray_aabox<double>::Answer{};
  return right(q);
}
MISREPORT(11, ray_aabox, ordinary, "the ray ends at origin + direction", "convention") {
  if (!a.yes() || a.inside) return;
  double enters = 0;
  for (int i = 0; i < 3; ++i) {
    const double o = component(q.ray.origin, i), d = component(q.ray.direction, i);
    if (d != 0) enters = std::max(enters, ((d > 0 ? component(q.aabox.min, i) : component(q.aabox.max, i)) - o) / d);
  }
  if (enters > 1) a = {};
}
MISREPORT(12, ray_aabox, ordinary, "for an origin in the box, the location is where the ray leaves, not the origin",
          "convention") {
  if (!a.inside) return;
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
  if (leaves < 0) return;
  std::array<double, 3> at{};
  for (int i = 0; i < 3; ++i) at[i] = double(std::clamp(o[i] + d[i] * leaves, low[i], high[i]));
  a.location = {at[0], at[1], at[2]};
}
MISREPORT(13, ray_aabox, degenerate, "a box that has no thickness along some axis counts as empty", "unsupported") {
  if (q.aabox.min.x >= q.aabox.max.x || q.aabox.min.y >= q.aabox.max.y || q.aabox.min.z >= q.aabox.max.z) a = {};
}
MISREPORT(14, ray_aabox, ordinary, "multiplies the parameter of the given direction with the normalised one",
          "convention or unsupported") {
  const double size = length(q.ray.direction);
  if (!a.yes() || a.inside || std::abs(size - 1) < 1e-15) return;
  a.location = q.ray.origin + (a.location - q.ray.origin) / size;
}
MISREPORT(15, ray_aabox, ordinary, "sphere tracing that gives up after 32 steps", "iteration limit") {
  const collide::AABox<double> seen{q.aabox.min - q.ray.origin, q.aabox.max - q.ray.origin};
  const double start = distance_from_aabox(seen, {});
  if (!a.yes() || start == 0) return;
  const Vector direction = q.ray.direction / length(q.ray.direction);
  double travelled = start;
  for (int step = 0; step < 32; ++step) {
    const double distance = distance_from_aabox(seen, direction * travelled);
    if (distance <= 1e-9 * start) return;
    travelled += distance;
  }
  a = {};
}

}  // namespace
}  // namespace nearmiss::planted
