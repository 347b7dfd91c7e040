/// Mistakes: nearest points.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

MISREPORT(1, closest_point_segment, degenerate,
          "a segment shorter than 1e-6 of the distance to the point is taken for its first end",
          "relative tolerance 1e-6") {
  if (length(q.segment.v1 - q.segment.v0) < 1e-6 * length(q.point - q.segment.v0)) a = {q.segment.v0};
}
MISREPORT(2, closest_point_segment, degenerate, "a squared length below an absolute 1e-10 is taken for a point",
          "absolute tolerance 1e-5 length or absolute tolerance 1e-10 length\\^2") {
  const Vector along = q.segment.v1 - q.segment.v0;
  if (dot(along, along) < 1e-10) a = {q.segment.v0};
}
MISREPORT(3, closest_point_segment, ordinary, "1e-12 is added to the squared length that is divided by",
          "absolute tolerance 1e-12 length\\^2") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double t = dot(q.point - q.segment.v0, along) / (dot(along, along) + 1e-12);
  if (!(t > 0 && t < 1)) return;
  a = {q.segment.v0 + along * t};
}
MISTAKE(5, closest_point_segment, degenerate, "a foot within 1e-4 of the length from an end is moved to that end",
        "relative tolerance 1e-4") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double t = dot(q.point - q.segment.v0, along) / dot(along, along);
  if (t > 0 && t < 1e-4) return {q.segment.v0};
  if (t > 1 - 1e-4 && t < 1) return {q.segment.v1};
  return right(q);
}
MISREPORT(8, closest_point_segment, degenerate, "a segment with equal ends gives 0 / 0", "unsupported or logic") {
  const Vector along = q.segment.v1 - q.segment.v0;
  if (along.x == 0 && along.y == 0 && along.z == 0) a = {along / dot(along, along)};
}
MISREPORT(10, closest_point_segment, degenerate, "a segment whose squared length is below 1e-8 counts as the point v0",
          "absolute tolerance 1e-8 length\\^2 or absolute tolerance (1e-4|0\\.0001) length$") {
  if (squared(q.segment.v1 - q.segment.v0) < 1e-8) a = {q.segment.v0};
}
MISTAKE(11, closest_point_segment, degenerate, "a segment with a squared length below 1e-8 is taken for its first end",
        "absolute tolerance 1e-8 length\\^2 or absolute tolerance 1e-4 length") {
  return closest_point_segment_10(q);
}
MISTAKE(12, closest_point_segment, degenerate,
        "a foot within a ten-thousandth of the length from an end snaps to that end",
        "relative tolerance (1e-0?4|0\\.0001).*") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  const double t = dot(q.point - q.segment.v0, along / size) / size;
  if (t < 1e-4) return {q.segment.v0};
  if (t > 1 - 1e-4) return {q.segment.v1};
  return right(q);
}
MISTAKE(13, closest_point_segment, ordinary, "the parameter along the segment goes through a float", "rounding") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  if (!(size > 0)) return right(q);
  const float t = float(dot(q.point - q.segment.v0, along / size) / size);
  if (t <= 0) return {q.segment.v0};
  if (t >= 1) return {q.segment.v1};
  return {q.segment.v0 + along * double(t)};
}
MISREPORT(14, closest_point_segment, ordinary,
          "the segment's squared length has 1e-6 added, so that a point never divides by zero",
          "absolute tolerance 1e-6 length\\^2 or absolute tolerance (1e-3|0\\.001) length") {
  const Wide v0 = widened(q.segment.v0), d = widened(q.segment.v1) - v0;
  const long double dd = dot(d, d), t = dot(widened(q.point) - v0, d) / (dd + 1e-6L);
  if (1e-6L < 1e-18L * dd || t <= 0 || t >= 1) return;
  a = {narrowed(v0 + d * t)};
}
MISTAKE(15, closest_point_segment, ordinary, "adds 1e-10 to the segment's squared length, so as not to divide by zero",
        "absolute tolerance 1e-10 length\\^2 or absolute tolerance 1e-5 length") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double t = dot(q.point - q.segment.v0, along) / (dot(along, along) + 1e-10);
  if (t <= 0) return {q.segment.v0};
  if (t >= 1) return {q.segment.v1};
  return {q.segment.v0 + along * t};
}

MISREPORT(1, closest_point_segment_unit, ordinary, "the parameter is not clamped at the second end", "logic") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double t = dot(q.point - q.segment.v0, along) / dot(along, along);
  if (t > 1) a = {q.segment.v0 + along * t};
}
MISREPORT(6, closest_point_segment_unit, ordinary, "the components of the unit direction are floats", "rounding") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  if (!(size > 0)) return;
  const Vector unit = in_float(along / size);
  const double way = dot(q.point - q.segment.v0, unit);
  if (!(way > 0 && way < size)) return;
  a = {q.segment.v0 + unit * way};
}
MISREPORT(8, closest_point_segment_unit, ordinary, "1e-6 is added to the length by which the direction is divided",
          "absolute tolerance 1e-6 length") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  const Vector unit = along / (size + 1e-6);
  const double way = dot(q.point - q.segment.v0, unit);
  if (!(way > 0 && way < size)) return;
  a = {q.segment.v0 + unit * way};
}
MISREPORT(10, closest_point_segment_unit, degenerate,
          "a segment shorter than 1e-6 has no unit direction and counts as its first point",
          "absolute tolerance 1e-6 length or absolute tolerance 1e-12 length\\^2") {
  if (length(q.segment.v1 - q.segment.v0) < 1e-6) a = {q.segment.v0};
}
MISREPORT(11, closest_point_segment_unit, degenerate, "a segment with a squared length below 1e-10 is its first point",
          "absolute tolerance 1e-10 length\\^2 or absolute tolerance 1e-5 length") {
  const Vector d = q.segment.v1 - q.segment.v0;
  if (dot(d, d) < 1e-10) a = {q.segment.v0};
}
MISTAKE(12, closest_point_segment_unit, degenerate,
        "a point within a thousandth of the segment's length from an end is snapped to that end",
        "relative tolerance (0\\.001|1e-0?3|0\\.0009\\d*|9\\.\\d+e-0?4)") {
  auto answer = right(q);
  const Real whole = wide_distance(q.segment.v0, q.segment.v1);
  if (wide_distance(answer.point, q.segment.v0) < 1e-3L * whole) return {q.segment.v0};
  if (wide_distance(answer.point, q.segment.v1) < 1e-3L * whole) return {q.segment.v1};
  return answer;
}
MISTAKE(13, closest_point_segment_unit, ordinary, "the prepared unit direction of the segment is stored in float",
        "rounding") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double len = length(along);
  if (!(len > 0)) return right(q);
  const Vector direction = in_float(along / len);
  const double t = dot(q.point - q.segment.v0, direction);
  if (t <= 0) return {q.segment.v0};
  if (t >= len) return {q.segment.v1};
  return {q.segment.v0 + direction * t};
}
MISREPORT(14, closest_point_segment_unit, ordinary,
          "normalises the direction by its length + 1e-6, against a division by zero",
          "absolute tolerance 1e-0?6 length") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double size = length(along);
  if (size + 1e-6 == size) return;
  const Vector unit = along / (size + 1e-6);
  a = {q.segment.v0 + unit * std::clamp(dot(unit, q.point - q.segment.v0), 0.0, size)};
}
MISTAKE(15, closest_point_segment_unit, degenerate,
        "a foot within a thousandth of the segment's length of an end snaps to that end",
        "relative tolerance (1e-0?3|0\\.001)") {
  const Vector along = q.segment.v1 - q.segment.v0;
  const double whole = length(along);
  if (whole == 0) return right(q);
  const double share = dot(q.point - q.segment.v0, along / whole) / whole;
  if (share < 1e-3) return {q.segment.v0};
  if (share > 1 - 1e-3) return {q.segment.v1};
  return right(q);
}

MISTAKE(1, closest_point_triangle_perimeter, ordinary, "the edge v2 v0 is left out", "logic") {
  const Vector a = nearest(q.triangle.v0, q.triangle.v1, q.point), b = nearest(q.triangle.v1, q.triangle.v2, q.point);
  return {length(a - q.point) < length(b - q.point) ? a : b};
}
MISTAKE(2, closest_point_triangle_perimeter, ordinary, "the parameter along the edge v0 v1 is not clamped at 0",
        "logic") {
  const Vector along = q.triangle.v1 - q.triangle.v0;
  const double t = dot(q.point - q.triangle.v0, along) / dot(along, along);
  if (t < 0) {
    const Vector foot = q.triangle.v0 + along * t;
    if (length(foot - q.point) < length(right(q).point - q.point)) return {foot};
  }
  return right(q);
}
MISTAKE(3, closest_point_triangle_perimeter, ordinary, "the edge v2 v0 is taken for v2 v1", "logic") {
  const Vector a = nearest(q.triangle.v0, q.triangle.v1, q.point), b = nearest(q.triangle.v1, q.triangle.v2, q.point);
  const Vector c = nearest(q.triangle.v2, q.triangle.v1, q.point);
  Vector best = a;
  for (const Vector& other : {b, c}) {
    if (length(other - q.point) < length(best - q.point)) best = other;
  }
  return {best};
}
MISTAKE(6, closest_point_triangle_perimeter, ordinary,
        "an edge is left out whose first end is farther than the best point so far", "logic") {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  Vector best = nearest(corners[0], corners[1], q.point);
  for (int edge = 1; edge < 3; ++edge) {
    if (length(corners[edge] - q.point) > length(best - q.point)) continue;
    const Vector other = nearest(corners[edge], corners[edge + 1], q.point);
    if (length(other - q.point) < length(best - q.point)) best = other;
  }
  return {best};
}
MISTAKE(10, closest_point_triangle_perimeter, ordinary, "the edge is chosen by the distance from its infinite line",
        "logic") {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2};
  int best = 0;
  double least = INFINITY;
  for (int i = 0; i < 3; ++i) {
    const Vector edge = corners[(i + 1) % 3] - corners[i];
    const Vector to_point = q.point - corners[i];
    const double l = length(edge);
    const double distance = l > 0 ? length(cross(edge / l, to_point)) : length(to_point);
    if (distance < least) least = distance, best = i;
  }
  return {nearest(corners[best], corners[(best + 1) % 3], q.point)};
}
MISTAKE(11, closest_point_triangle_perimeter, ordinary,
        "over the face, the edge is that opposite to the least barycentric weight", "logic") {
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
MISTAKE(12, closest_point_triangle_perimeter, ordinary, "chooses the edge by the distance from its endless line",
        "logic") {
  return closest_point_triangle_perimeter_10(q);
}
MISTAKE(13, closest_point_triangle_perimeter, ordinary,
        "selects the edge whose infinite line is nearest, and only then clamps to that edge", "logic") {
  return closest_point_triangle_perimeter_10(q);
}
MISTAKE(14, closest_point_triangle_perimeter, ordinary,
        "chooses the edge by the distance from its infinite line, then clamps to the edge", "logic") {
  return closest_point_triangle_perimeter_10(q);
}
MISTAKE(15, closest_point_triangle_perimeter, ordinary, "takes the edge whose midpoint is nearest to the point",
        "logic") {
  const Vector corner[3] = {q.triangle.v0, q.triangle.v1, q.triangle.v2};
  int best = 0;
  double least = INFINITY;
  for (int i = 0; i < 3; ++i) {
    const double distance = length((corner[i] + corner[(i + 1) % 3]) * 0.5 - q.point);
    if (distance < least) least = distance, best = i;
  }
  return {nearest(corner[best], corner[(best + 1) % 3], q.point)};
}

MISREPORT(1, closest_point_triangle_perimeter_edges, degenerate,
          "a later edge wins if its distance is at most 1e-11 of itself larger", "relative tolerance 1e-11") {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  const double least = length(a.point - q.point);
  for (int edge = a.edge + 1; edge < 3; ++edge) {
    const Vector other = nearest(corners[edge], corners[edge + 1], q.point);
    if (length(other - q.point) <= least * (1 + 1e-11)) a = {other, edge};
  }
}
MISTAKE(5, closest_point_triangle_perimeter_edges, degenerate,
        "an edge with a squared length below an absolute 1e-12 is left out",
        "absolute tolerance 1e-6 length or absolute tolerance 1e-12 length\\^2") {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  const auto is_short = [&](int edge) {
    const Vector along = corners[edge + 1] - corners[edge];
    return dot(along, along) < 1e-12;
  };
  const auto a = right(q);
  if (!is_short(a.edge)) return a;
  collide::EdgePoint<double> best{q.triangle.v0, 0};
  double least = INFINITY;
  for (int edge = 0; edge < 3; ++edge) {
    if (is_short(edge)) continue;
    const Vector other = nearest(corners[edge], corners[edge + 1], q.point);
    if (length(other - q.point) < least) best = {other, edge}, least = length(other - q.point);
  }
  return best;
}
MISREPORT(7, closest_point_triangle_perimeter_edges, ordinary, "the edge v2 v0 is measured from v0 on, away from v2",
          "logic") {
  const auto& [v0, v1, v2] = q.triangle;
  const Vector along = v0 - v2;
  if (!(length(along) > 0)) return;
  const Vector unit = along / length(along);
  const Vector last = v0 + unit * std::clamp(dot(q.point - v0, unit), 0., length(along));
  const Vector places[] = {nearest(v0, v1, q.point), nearest(v1, v2, q.point), last};
  int best = 0;
  for (int edge = 1; edge < 3; ++edge) {
    if (length(places[edge] - q.point) < length(places[best] - q.point)) best = edge;
  }
  a = {places[best], best};
}
MISTAKE(8, closest_point_triangle_perimeter_edges, degenerate, "the distances of the edges are compared in float",
        "rounding") {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  collide::EdgePoint<double> best{q.triangle.v0, 0};
  float least = INFINITY;
  for (int edge = 0; edge < 3; ++edge) {
    const Vector place = nearest(corners[edge], corners[edge + 1], q.point);
    const float distance = float(length(place - q.point));
    if (distance < least) best = {place, edge}, least = distance;
  }
  return best;
}
MISREPORT(9, closest_point_triangle_perimeter_edges, degenerate,
          "a later edge must have a squared distance that is smaller by an absolute 1e-8",
          "absolute tolerance 1e-8 length\\^2 or absolute tolerance 1e-4 length") {
  const Vector corners[] = {q.triangle.v0, q.triangle.v1, q.triangle.v2, q.triangle.v0};
  collide::EdgePoint<double> best{nearest(corners[0], corners[1], q.point), 0};
  for (int edge = 1; edge < 3; ++edge) {
    const Vector place = nearest(corners[edge], corners[edge + 1], q.point);
    const Vector to_best = best.point - q.point, to_place = place - q.point;
    if (dot(to_place, to_place) < dot(to_best, to_best) - 1e-8) best = {place, edge};
  }
  a = length(best.point - q.point) > hardly_more * length(a.point - q.point) ? best : a;
}
MISREPORT(10, closest_point_triangle_perimeter_edges, ordinary, "the edge's number is that of the opposite vertex",
          "convention") {
  a.edge = (a.edge + 2) % 3;  // the vertex that is not on the edge
}
MISTAKE(13, closest_point_triangle_perimeter_edges, ordinary,
        "edge i is numbered as the edge opposite to corner i, not as the edge that starts there", "convention") {
  return closest_point_triangle_perimeter_edges_10(q);
}
MISTAKE(15, closest_point_triangle_perimeter_edges, degenerate,
        "takes a later edge only if its squared distance is smaller by 1e-8",
        "absolute tolerance 1e-8 length\\^2 or absolute tolerance 1e-4 length") {
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

MISREPORT(1, closest_point_rectangle, degenerate,
          "a point within 1e-8 of the rectangle is taken for its own nearest point", "absolute tolerance 1e-8 length") {
  if (length(a.point - q.point) < 1e-8) a = {q.point};
}
MISTAKE(2, closest_point_rectangle, ordinary, "the nearest point of the perimeter is taken for that of the face",
        "logic") {
  return right(inputs::closest_point_rectangle_perimeter<double>{q.rectangle, q.point});
}
MISREPORT(4, closest_point_rectangle, degenerate, "a side below an absolute 1e-4 is taken for a point",
          "absolute tolerance 1e-4 length") {
  const auto& r = q.rectangle;
  if (length(r.v1 - r.v0) < 1e-4) a = {nearest(r.v0, r.v3, q.point)};
}
MISREPORT(6, closest_point_rectangle, degenerate,
          "if the sides at v0 have an angle with a sine below 1e-5, only the edge v0 v1 counts",
          "relative tolerance 1e-5") {
  const auto& r = q.rectangle;
  const Vector u = r.v1 - r.v0, v = r.v3 - r.v0;
  const double area = length(cross(u, v));
  if (area > 0 && area < 1e-5 * length(u) * length(v)) a = {nearest(r.v0, r.v1, q.point)};
}
MISREPORT(7, closest_point_rectangle, degenerate,
          "a rectangle whose squared normal underflows in float has only its edges", "underflow") {
  const auto& r = q.rectangle;
  const Vector n = cross(r.v1 - r.v0, r.v3 - r.v0);
  if (!(dot(n, n) > 0) || float(dot(n, n)) > 0) return;
  a = {right(inputs::closest_point_rectangle_perimeter<double>{r, q.point}).point};
}
MISREAD(10, closest_point_rectangle, ordinary, "the corner v2 is not read: it is taken as v1 + v3 - v0",
        "unsupported or convention") {
  q.rectangle.v2 = q.rectangle.v1 + (q.rectangle.v3 - q.rectangle.v0);
}
MISTAKE(11, closest_point_rectangle, ordinary,
        "corner plus two edges, clamped one by one; the third corner is never read", "unsupported or logic") {
  const auto& r = q.rectangle;
  const Vector e1 = r.v1 - r.v0, e2 = r.v3 - r.v0, d = q.point - r.v0;
  const double l1 = dot(e1, e1), l2 = dot(e2, e2);
  const double s = l1 > 0 ? std::clamp(dot(d, e1) / l1, 0.0, 1.0) : 0;
  const double t = l2 > 0 ? std::clamp(dot(d, e2) / l2, 0.0, 1.0) : 0;
  return {r.v0 + e1 * s + e2 * t};
}
MISTAKE(12, closest_point_rectangle, ordinary,
        "ignores the third corner and computes it from the other three as that of a parallelogram", "unsupported") {
  return closest_point_rectangle_10(q);
}
MISREAD(13, closest_point_rectangle, ordinary,
        "takes the corners in the order of a triangle strip: triangles v0 v1 v2 and v1 v2 v3", "convention") {
  std::swap(q.rectangle.v0, q.rectangle.v1);
}
MISREPORT(14, closest_point_rectangle, degenerate, "the squared distances of the two triangles are compared in float",
          "rounding") {
  const auto& r = q.rectangle;
  const Vector one = nearest({r.v0, r.v1, r.v2}, q.point);
  const Vector two = nearest({r.v0, r.v2, r.v3}, q.point);
  const Wide to_one = widened(one) - widened(q.point), to_two = widened(two) - widened(q.point);
  const long double d1 = dot(to_one, to_one), d2 = dot(to_two, to_two), most = std::max(d1, d2);
  if (most == 0) return;
  const bool second = float(d2 / most) < float(d1 / most);
  if (second || d2 >= d1) return;
  a = {one};
}
MISREAD(15, closest_point_rectangle, ordinary, "splits the four corners along the other diagonal, v1 v3",
        "convention or unsupported") {
  q.rectangle = {q.rectangle.v1, q.rectangle.v2, q.rectangle.v3, q.rectangle.v0};
}

MISREPORT(1, closest_point_rectangle_perimeter, ordinary, "the diagonal v0 v2 is taken for an edge", "logic") {
  const Vector other = nearest(q.rectangle.v0, q.rectangle.v2, q.point);
  if (length(other - q.point) < length(a.point - q.point)) a = {other};
}
MISTAKE(5, closest_point_rectangle_perimeter, ordinary, "the parameter along an edge is a float", "rounding") {
  const auto a = right(q);
  const Vector corners[] = {q.rectangle.v0, q.rectangle.v1, q.rectangle.v2, q.rectangle.v3, q.rectangle.v0};
  for (int edge = 0; edge < 4; ++edge) {
    const Vector begin = corners[edge], along = corners[edge + 1] - begin;
    if (nearest(begin, corners[edge + 1], q.point) != a.point) continue;
    const float t = float(dot(q.point - begin, along) / dot(along, along));
    if (t > 0 && t < 1) return {begin + along * double(t)};
  }
  return a;
}
MISREPORT(9, closest_point_rectangle_perimeter, degenerate, "a later edge must be nearer by 1e-4 of the distance",
          "relative tolerance 1e-4") {
  const auto& [v0, v1, v2, v3] = q.rectangle;
  const Vector corners[] = {v0, v1, v2, v3, v0};
  Vector best = nearest(v0, v1, q.point);
  double least = length(best - q.point);
  for (int edge = 1; edge < 4; ++edge) {
    const Vector place = nearest(corners[edge], corners[edge + 1], q.point);
    const double distance = length(place - q.point);
    if (distance < least * (1 - 1e-4)) best = place, least = distance;
  }
  if (least > hardly_more * length(a.point - q.point)) a = {best};
}
MISREAD(11, closest_point_rectangle_perimeter, ordinary, "the corners are read in the order of a triangle strip",
        "convention") {
  std::swap(q.rectangle.v2, q.rectangle.v3);
}
MISTAKE(12, closest_point_rectangle_perimeter, ordinary,
        "takes the edge whose infinite line is nearest, then clamps to that edge only", "logic") {
  const std::array<Vector, 4> v = {q.rectangle.v0, q.rectangle.v1, q.rectangle.v2, q.rectangle.v3};
  int best = 0;
  Real least = -1;
  for (int i = 0; i < 4; ++i) {
    const Wide along = widened(v[(i + 1) % 4]) - widened(v[i]), to = widened(q.point) - widened(v[i]);
    const Real whole = length(along);
    const Real distance = whole > 0 ? length(cross(along, to)) / whole : length(to);
    if (least < 0 || distance < least) least = distance, best = i;
  }
  return {nearest(v[best], v[(best + 1) % 4], q.point)};
}
MISTAKE(13, closest_point_rectangle_perimeter, ordinary,
        "the nearest edge is chosen by the distance from its infinite line", "logic") {
  const Vector v[4] = {q.rectangle.v0, q.rectangle.v1, q.rectangle.v2, q.rectangle.v3};
  int best = 0;
  double least = INFINITY;
  for (int i = 0; i < 4; ++i) {
    const double d = distance_from_line(v[i], v[(i + 1) % 4], q.point);
    if (d < least) least = d, best = i;
  }
  return {nearest(v[best], v[(best + 1) % 4], q.point)};
}
MISTAKE(14, closest_point_rectangle_perimeter, degenerate,
        "the search for the nearest edge starts with a best squared distance of 1e10 for infinity",
        "absolute tolerance (1e\\+?10|10000000000) length\\^2 or absolute tolerance (1e\\+?0?5|100000) length") {
  const double infinity = 1e10;
  const auto r = right(q);
  const double distance = length(q.point - r.point);
  if (distance * distance < infinity) return r;
  return {q.rectangle.v0};
}
MISREAD(15, closest_point_rectangle_perimeter, ordinary,
        "takes v1 + v3 - v0 for the corner v2, which only a parallelogram has there", "unsupported") {
  q.rectangle.v2 = q.rectangle.v1 + (q.rectangle.v3 - q.rectangle.v0);
}

MISREPORT(1, closest_points_lines, degenerate, "lines whose angle has a sine below 1e-5 are taken for parallel",
          "relative tolerance 1e-5") {
  const Vector d1 = q.line1.direction, d2 = q.line2.direction, n = cross(d1, d2);
  const double sine = length(n) / (length(d1) * length(d2));
  if (sine == 0 || !(sine < 1e-5)) return;
  const Vector p = q.line1.point;
  a = {p, q.line2.point + d2 * (dot(p - q.line2.point, d2) / dot(d2, d2))};
}
MISTAKE(2, closest_points_lines, degenerate, "lines are parallel if a c - b^2 is below 1e-8 of a c",
        "relative tolerance 1e-8 or relative tolerance 1e-4") {
  const Vector u = q.line1.direction, v = q.line2.direction, n = cross(u, v);
  const double a = dot(u, u), c = dot(v, v), determinant = dot(n, n);
  if (determinant == 0 || !(determinant < 1e-8 * a * c)) return right(q);
  const Vector p = q.line1.point;
  return {p, q.line2.point + v * (dot(p - q.line2.point, v) / c)};
}
MISREPORT(3, closest_points_lines, ordinary, "the direction of line 2 is taken for a unit vector",
          "unsupported a direction that is not of unit length or logic") {
  a.point2 = q.line2.point + q.line2.direction * dot(a.point1 - q.line2.point, q.line2.direction);
}
MISREPORT(4, closest_points_lines, degenerate, "lines are parallel if a c - b^2 is below an absolute 1e-6",
          "absolute tolerance or relative tolerance 1e-3") {
  const Vector u = q.line1.direction, v = q.line2.direction, n = cross(u, v);
  const double determinant = dot(n, n);
  if (determinant == 0 || !(determinant < 1e-6)) return;
  const Vector p = q.line1.point;
  a = {p, q.line2.point + v * (dot(p - q.line2.point, v) / dot(v, v))};
}
MISTAKE(6, closest_points_lines, degenerate, "a c - b^2 is computed in double, and cancels", "rounding") {
  const Vector u = q.line1.direction, v = q.line2.direction, w = q.line1.point - q.line2.point;
  const double a = dot(u, u), b = dot(u, v), c = dot(v, v), d = dot(u, w), e = dot(v, w);
  const double determinant = a * c - b * b;
  if (!(determinant > 0)) return right(q);
  return {q.line1.point + u * ((b * e - c * d) / determinant), q.line2.point + v * ((a * e - b * d) / determinant)};
}
MISREPORT(8, closest_points_lines, ordinary, "the parameter of line 1 is a float", "rounding") {
  const Vector p = q.line1.point, u = q.line1.direction;
  const float t = float(dot(a.point1 - p, u) / dot(u, u));
  if (std::isfinite(t)) a.point1 = p + u * double(t);
}
MISREPORT(9, closest_points_lines, ordinary, "the point of line 2 is that nearest to the given point of line 1",
          "logic") {
  const Vector p = q.line2.point, v = q.line2.direction / length(q.line2.direction);
  a.point2 = p + v * dot(q.line1.point - p, v);
}
MISTAKE(10, closest_points_lines, degenerate,
        "lines are parallel if the squared cross product of the directions is below 1e-10",
        "absolute tolerance 1e-10.*") {
  if (squared(cross(q.line1.direction, q.line2.direction)) < 1e-10) {
    const Vector p = q.line1.point, d = q.line2.direction;
    const double t = dot(p - q.line2.point, d) / dot(d, d);
    return {p, q.line2.point + d * t};
  }
  return right(q);
}
MISTAKE(11, closest_points_lines, degenerate,
        "parallel when the determinant of directions that are not normalised is below 1e-8",
        "absolute tolerance 1e-8 .* or absolute tolerance 1e-4 .*") {
  const Vector &d1 = q.line1.direction, &d2 = q.line2.direction;
  const Vector n = cross(d1, d2);  // its square is the determinant a c - b b
  if (dot(n, n) < 1e-8) {
    const Vector w = q.line1.point - q.line2.point;
    return {q.line1.point, q.line2.point + d2 * (dot(w, d2) / dot(d2, d2))};
  }
  return right(q);
}
MISTAKE(12, closest_points_lines, degenerate,
        "the denominator a c - b b of the textbook solution cancels for nearly parallel lines", "rounding") {
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
MISTAKE(13, closest_points_lines, degenerate, "lines whose cosine is within 1e-4 of 1 count as parallel",
        "relative tolerance (1e-0?4|0\\.0001\\d*|0\\.00009\\d+|9\\.\\d+e-0?5|1\\.0\\d*e-0?4) or relative tolerance "
        "(2e-0?4|0\\.0002\\d*|0\\.00019\\d*|1\\.9\\d*e-0?4|2\\.0\\d*e-0?4) or relative tolerance "
        "(0\\.014\\d*|1\\.4\\d*e-0?2)") {
  const Vector u1 = unit_of(q.line1.direction), u2 = unit_of(q.line2.direction);
  if (std::abs(dot(u1, u2)) > 1 - 1e-4) {
    return {q.line1.point, q.line2.point + u2 * dot(q.line1.point - q.line2.point, u2)};
  }
  return right(q);
}
MISREPORT(14, closest_points_lines, ordinary, "the directions are taken to have unit length", "unsupported") {
  const Wide p1 = widened(q.line1.point), d1 = widened(q.line1.direction);
  const Wide p2 = widened(q.line2.point), d2 = widened(q.line2.direction);
  const bool unit = std::abs(dot(d1, d1) - 1) < 1e-12L && std::abs(dot(d2, d2) - 1) < 1e-12L;
  const Wide r = p1 - p2;
  const long double b = dot(d1, d2), c = dot(d1, r), f = dot(d2, r), denominator = 1 - b * b;
  if (unit || denominator == 0) return;
  const long double s = (b * f - c) / denominator, t = (f - b * c) / denominator;
  a = {narrowed(p1 + d1 * s), narrowed(p2 + d2 * t)};
}
MISTAKE(15, closest_points_lines, degenerate, "the determinant a c - b b cancels for nearly parallel lines",
        "rounding") {
  const Vector d1 = q.line1.direction, d2 = q.line2.direction, w = q.line1.point - q.line2.point;
  const double a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2), d = dot(d1, w), e = dot(d2, w);
  const double determinant = a * c - b * b;
  if (!(determinant > 0)) return {q.line1.point, q.line2.point + d2 * (e / c)};
  const double s = (b * e - c * d) / determinant;
  const double t = (a * e - b * d) / determinant;
  return {q.line1.point + d1 * s, q.line2.point + d2 * t};
}

}  // namespace
}  // namespace nearmiss::planted
