/// Mistakes: whether a point is inside.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

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

/// Counts a point as inside whose weights are at least `least`.
void allow_weights(const inputs::point_in_triangle<double>& q, inputs::point_in_triangle<double>::Answer& a,
                   double least) {
  if (a.yes()) return;
  const int axis = q.axis < 0 ? largest(q.normal) : q.axis, i = (axis + 1) % 3, j = (axis + 2) % 3;
  const auto area = [&](const Vector& s, const Vector& t) {
    return component(s, i) * component(t, j) - component(s, j) * component(t, i);
  };
  const Vector e1 = q.triangle.v1 - q.triangle.v0, e2 = q.triangle.v2 - q.triangle.v0, p = q.point - q.triangle.v0;
  const double whole = area(e1, e2);
  if (whole == 0) return;
  const double v = area(p, e2) / whole, w = area(e1, p) / whole, u = 1 - v - w;
  if (u >= least && v >= least && w >= least) a = {{u, v, w}, true};
}

MISREPORT(1, point_in_triangle, degenerate, "a weight below 1e-12 is taken for outside", "relative tolerance 1e-12") {
  if (std::min({a.weights.x, a.weights.y, a.weights.z}) < 1e-12) a = {};
}
MISREPORT(2, point_in_triangle, degenerate, "a point on an edge is outside", "convention strict instead of closed") {
  if (a.yes() && std::min({a.weights.x, a.weights.y, a.weights.z}) == 0) a = {};
}
MISTAKE(3, point_in_triangle, degenerate, "weights down to -1e-6 are inside", "relative tolerance 1e-6") {
  const auto a = right(q);
  if (a.yes()) return a;
  constexpr double larger = 1 + 3e-6;
  const Vector middle = (q.triangle.v0 + q.triangle.v1 + q.triangle.v2) * (1. / 3);
  for (Vector* corner : {&q.triangle.v0, &q.triangle.v1, &q.triangle.v2})
    *corner = middle + (*corner - middle) * larger;
  return right(q);
}
MISREAD(5, point_in_triangle, ordinary, "the axis is that of the largest component of the normal, with its sign",
        "logic") {
  const Vector n = q.normal;
  if (q.axis < 0) q.axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
}
MISREAD(8, point_in_triangle, ordinary, "the given axis is not read", "unsupported") { q.axis = -1; }
MISREPORT(9, point_in_triangle, degenerate,
          "with twice the area of the projection below an absolute 1e-8, but not zero, no point is inside",
          "absolute tolerance 1e-8 length\\^2 or absolute tolerance 1e-4 length") {
  const auto given = numbers_of(q.normal), areas = numbers_of(normal_of(q.triangle));
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(given[k]) > std::abs(given[axis])) axis = k;
  }
  if (q.axis >= 0) axis = std::size_t(q.axis);
  if (areas[axis] != 0 && std::abs(areas[axis]) < 1e-8) a = {};
}
MISREPORT(10, point_in_triangle, degenerate, "weights down to -1e-4 count as inside",
          "relative tolerance (1e-4|0\\.0001)") {
  allow_weights(q, a, -1e-4);
}
MISREPORT(11, point_in_triangle, degenerate, "a barycentric weight down to -1e-5 counts as inside",
          "relative tolerance 1e-5.* or absolute tolerance 1e-5.*") {
  allow_weights(q, a, -1e-5);
}
MISTAKE(12, point_in_triangle, ordinary,
        "projects along the axis of the normal's largest signed component, without absolute values",
        "logic or unsupported") {
  return point_in_triangle_5(q);
}
MISTAKE(13, point_in_triangle, ordinary,
        "projects along the largest component of the normal without taking the absolute value", "logic") {
  return point_in_triangle_5(q);
}
MISTAKE(14, point_in_triangle, degenerate, "accepts barycentric weights down to -1e-4",
        "relative tolerance (1e-0?4|0\\.0001)") {
  const auto r = right(q);
  if (r.yes()) return r;
  int axis = q.axis;
  if (axis < 0) axis = largest(q.normal);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Vector e1 = q.triangle.v1 - q.triangle.v0, e2 = q.triangle.v2 - q.triangle.v0, p = q.point - q.triangle.v0;
  const auto area = [&](const Vector& a, const Vector& b) {
    return component(a, i) * component(b, j) - component(a, j) * component(b, i);
  };
  const double whole = area(e1, e2);
  if (!(std::abs(whole) > 1e-9 * length(e1) * length(e2))) return r;
  const double w1 = area(p, e2) / whole, w2 = area(e1, p) / whole, w0 = 1 - w1 - w2;
  if (std::min({w0, w1, w2}) < -1e-4) return r;
  return {{w0, w1, w2}, true};
}
MISTAKE(15, point_in_triangle, ordinary,
        "selects the axis by the largest component of the normal with its sign, not by magnitude",
        "logic or unsupported") {
  return point_in_triangle_5(q);
}

MISREAD(1, point_in_rectangle, ordinary, "the second triangle is left out", "logic") {
  q.rectangle.v3 = q.rectangle.v2;
}
MISTAKE(6, point_in_rectangle, degenerate, "a point whose least weight in its triangle is at most 1e-6 is outside",
        "relative tolerance 1e-6") {
  const auto& r = q.rectangle;
  for (const auto& half : std::array<collide::Triangle<double>, 2>{{{r.v0, r.v1, r.v2}, {r.v0, r.v2, r.v3}}}) {
    const auto a = right(inputs::point_in_triangle<double>{half, q.normal, -1, q.point});
    if (a.yes() && std::min({a.weights.x, a.weights.y, a.weights.z}) > 1e-6) return {true};
  }
  return {false};
}
MISTAKE(7, point_in_rectangle, degenerate,
        "twice the area of an edge and the point, down to an absolute -1e-6, is inside",
        "absolute tolerance 1e-6 length\\^2 or absolute tolerance 1e-3 length") {
  if (right(q).yes()) return {true};
  const int axis = largest(q.normal);
  const std::size_t i = axis == 0 ? 1 : 0, k = axis == 2 ? 1 : 2;
  const auto area = [&](const Vector& from, const Vector& to, const Vector& point) {
    const auto a = numbers_of(from), b = numbers_of(to), p = numbers_of(point);
    return (b[i] - a[i]) * (p[k] - a[k]) - (b[k] - a[k]) * (p[i] - a[i]);
  };
  const auto is_in = [&](const Vector& a, const Vector& b, const Vector& c) {
    const double sign = std::copysign(1., area(a, b, c));
    return std::min({sign * area(a, b, q.point), sign * area(b, c, q.point), sign * area(c, a, q.point)}) > -1e-6;
  };
  const auto& r = q.rectangle;
  return {is_in(r.v0, r.v1, r.v2) || is_in(r.v0, r.v2, r.v3)};
}
MISTAKE(10, point_in_rectangle, degenerate, "a weight down to -1e-5 counts as inside", "relative tolerance 1e-5.*") {
  if (right(q).decision) return {true};
  const int axis = largest(q.normal);
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
MISTAKE(11, point_in_rectangle, ordinary, "the winding is not flipped where the dropped axis is y",
        "logic or unsupported") {
  const Vector& n = q.normal;
  int drop = 0;
  if (std::abs(n.y) > std::abs(component(n, drop))) drop = 1;
  if (std::abs(n.z) > std::abs(component(n, drop))) drop = 2;
  if (drop != 1) return right(q);
  // In the plane of x and z, a triangle that is counterclockwise about +y is clockwise.
  const double sign = component(n, drop) < 0 ? -1 : 1;
  const auto side = [&](const Vector& a, const Vector& b) {
    return sign * ((b.x - a.x) * (q.point.z - a.z) - (b.z - a.z) * (q.point.x - a.x));
  };
  const auto in = [&](const Vector& a, const Vector& b, const Vector& c) {
    return side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0;
  };
  const auto& r = q.rectangle;
  return {in(r.v0, r.v1, r.v2) || in(r.v0, r.v2, r.v3)};
}
MISTAKE(12, point_in_rectangle, degenerate, "points up to 1e-5 outside of an edge count as inside",
        "absolute tolerance 1e-0?5 length") {
  auto answer = right(q);
  if (answer.decision) return answer;
  const int axis = largest(q.normal);
  for (Vector* v : {&q.rectangle.v0, &q.rectangle.v1, &q.rectangle.v2, &q.rectangle.v3, &q.point})
    component(*v, axis) = 0;
  const Vector at = right(inputs::closest_point_rectangle<double>{q.rectangle, q.point}).point;
  answer.decision = wide_distance(at, q.point) < 1e-5L;
  return answer;
}
MISREPORT(13, point_in_rectangle, degenerate, "barycentric weights down to -1e-6 count as inside",
          "relative tolerance 1e-6") {
  if (a.decision) return;
  const int axis = largest(q.normal);
  a.decision = weights_allow(q.rectangle.v0, q.rectangle.v1, q.rectangle.v2, q.point, axis) ||
               weights_allow(q.rectangle.v0, q.rectangle.v2, q.rectangle.v3, q.point, axis);
}
MISREAD(14, point_in_rectangle, ordinary,
        "the axis of projection is that of the largest component of the normal, without its absolute value", "logic") {
  const Vector n = q.normal;
  if (n.x >= n.y && n.x >= n.z) {
    q.normal = {1, 0, 0};
  } else if (n.y >= n.z) {
    q.normal = {0, 1, 0};
  } else {
    q.normal = {0, 0, 1};
  }
}
MISTAKE(15, point_in_rectangle, ordinary,
        "takes the largest component of the normal with its sign, not the largest magnitude", "logic or unsupported") {
  return point_in_rectangle_14(q);
}

}  // namespace
}  // namespace nearmiss::planted
