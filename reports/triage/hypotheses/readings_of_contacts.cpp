#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "corpus/generator/case_builder.hpp"
#include "oracles/judge.hpp"
#include "reports/triage/geometry/case_geometry.hpp"
#include "reports/triage/hypotheses/readings.hpp"

namespace nearmiss {

namespace {

using Fits = std::optional<bool>;

Answer without(Answer a, const Layout::Part& p) {
  for (std::size_t i = p.begin; i < p.end; ++i) a.given &= ~(std::uint64_t{1} << i);
  return a;
}

LongVector long_vector_at(std::span<const double> numbers, std::size_t i) {
  return {numbers[i], numbers[i + 1], numbers[i + 2]};
}

/// The member of three numbers with this role that the answer gives; nullptr where there is none.
const Layout::Part* given_vector(const Case& c, const Answer& a, Role role) {
  const Layout::Part* p = given_part(c, a, role);
  return p != nullptr && p->end - p->begin == 3 ? p : nullptr;
}

/// As the measure compares: these vectors are computed in rounded numbers.
bool are_near(const LongVector& a, const LongVector& b, long double largest) {
  return length(a - b) <= measure().error * largest;
}

/// The answer is right but for its normal, which is one of `directions` or the opposite of one.
Fits normal_among(const Case& c, const Answer& a, std::span<const LongVector> directions, const IsRight& is_right) {
  const Layout::Part* p = given_vector(c, a, Role::normal);
  if (p == nullptr || directions.empty()) return std::nullopt;
  const LongVector normal = long_vector_at(a.values, p->begin);
  const bool is_one = std::any_of(directions.begin(), directions.end(), [&](const LongVector& d) {
    const long double size = length(d);
    return size > 0 && (are_near(normal, d * (1 / size), 1) || are_near(normal, d * (-1 / size), 1));
  });
  if (is_one && is_right(c, a)) return std::nullopt;  // the normal of a right answer may be one of them
  return is_one && is_right(c, without(a, *p));
}

Fits no_normal(const Case& c, const Answer& a, const IsRight& is_right) {
  const Layout::Part* p = given_part(c, a, Role::normal);
  const auto is_zero = [](double x) { return x == 0; };
  if (p == nullptr || !std::all_of(&a.values[p->begin], &a.values[p->begin] + (p->end - p->begin), is_zero))
    return std::nullopt;
  return is_right(c, without(a, *p));
}

/// Of the triangle, the rectangle or the boxes. Every normal of the contact of a point is that of a face.
Fits normal_of_a_face(const Case& c, const Answer& a, const IsRight& is_right) {
  const bool is_of_point = c.operands().start && !c.operands().start->radius;
  if (is_of_point || given_vector(c, a, Role::normal) == nullptr) return std::nullopt;
  const CaseGeometry g = geometry_of(c, &a);
  std::vector<LongVector> faces;
  for (const auto& t : g.triangles) faces.push_back(cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
  for (const auto& b : g.blocks) faces.insert(faces.end(), b.axes.begin(), b.axes.end());
  return normal_among(c, a, faces, is_right);
}

/// The mean of an operand's positions.
LongVector middle_of(const Case& c, const Operand& o) {
  LongVector sum{};
  for (const std::size_t at : o.positions) sum = sum + long_vector_at(c.values, at);
  return sum * (1 / static_cast<long double>(o.positions.size()));
}
/// Of the operands with one of these shapes, the moving one at the given time.
std::vector<LongVector> middles_of(const Case& c, const Answer& a, std::initializer_list<Shape> shapes) {
  const Operands& parts = c.operands();
  const Layout::Part* time = given_part(c, a, Role::time);
  std::vector<LongVector> middles;
  for (const Operand& o : parts) {
    if (std::find(shapes.begin(), shapes.end(), o.shape) == shapes.end()) continue;
    LongVector middle = middle_of(c, o);
    const bool moves = time != nullptr && parts.start && o.has(parts.start->place) && !parts.velocities.empty();
    if (moves)
      middle = middle + long_vector_at(c.values, parts.velocities[0]) * static_cast<long double>(a.values[time->begin]);
    middles.push_back(middle);
  }
  return middles;
}

Fits normal_between_centers(const Case& c, const Answer& a, const IsRight& is_right) {
  const std::vector<LongVector> middles =
      middles_of(c, a, {Shape::point, Shape::sphere, Shape::capsule, Shape::box, Shape::triangle, Shape::rectangle});
  if (middles.size() != 2) return std::nullopt;
  const LongVector between = middles[1] - middles[0];
  return normal_among(c, a, {&between, 1}, is_right);
}

/// The answer is right but for its place, which is one of `places`.
Fits place_among(const Case& c, const Answer& a, std::span<const LongVector> places, const IsRight& is_right) {
  const Layout::Part* p = given_vector(c, a, Role::position);
  if (p == nullptr) return std::nullopt;
  const LongVector given = long_vector_at(a.values, p->begin);
  const bool is_one = std::any_of(places.begin(), places.end(),
                                  [&](const LongVector& at) { return are_near(given, at, largest_length(c)); });
  return is_one && is_right(c, without(a, *p));
}
Fits place_of_a_center(const Case& c, const Answer& a, const IsRight& is_right) {
  return place_among(c, a, middles_of(c, a, {Shape::sphere, Shape::capsule, Shape::box}), is_right);
}
/// Where the point of contact of the moving body was when the motion began.
Fits place_before_the_motion(const Case& c, const Answer& a, const IsRight& is_right) {
  const Layout::Part* place = given_vector(c, a, Role::position);
  const Layout::Part* time = given_part(c, a, Role::time);
  const auto& velocities = c.operands().velocities;
  if (place == nullptr || time == nullptr || velocities.empty() || a.values[time->begin] == 0) return std::nullopt;
  Answer other = a;
  for (std::size_t k = 0; k < 3; ++k)
    other.values[place->begin + k] += a.values[time->begin] * c.values[velocities[0] + k];
  return is_right(c, other);
}

template <int sign>
Fits negative_time(const Case& c, const Answer& a, const IsRight& is_right) {
  const Layout::Part* time = given_part(c, a, Role::time);
  if (time == nullptr || !(a.values[time->begin] < 0)) return std::nullopt;
  Answer other = a;
  other.values[time->begin] *= sign;
  return is_right(c, other);
}

/// The corners of triangles, rectangles and boxes.
std::vector<LongVector> corners_of(const CaseGeometry& g) {
  std::vector<LongVector> corners;
  for (const auto& t : g.triangles) corners.insert(corners.end(), t.corners.begin(), t.corners.end());
  for (const auto& b : g.blocks) {
    for (int n = 0; n < 8; ++n) {
      LongVector at = b.center;
      for (int k = 0; k < 3; ++k) at = at + b.axes[std::size_t(k)] * ((n >> k & 1) != 0 ? b.half[k] : -b.half[k]);
      corners.push_back(at);
    }
  }
  return corners;
}
/// When a point that moves from `from` is first at this distance from the origin; empty where it never is.
std::optional<long double> time_at_distance(const LongVector& from, const LongVector& velocity, long double distance) {
  const long double a = dot(velocity, velocity), b = dot(from, velocity), c = dot(from, from) - distance * distance;
  const long double discriminant = b * b - a * c;
  if (!(a > 0) || !(discriminant >= 0)) return std::nullopt;
  const long double time = (-b - std::sqrt(discriminant)) / a;
  return time >= 0 ? std::optional(time) : std::nullopt;
}
/// The place is a corner, and the time is that of the sphere and the corner alone, though the sphere meets an edge or a
/// face before.
Fits corner_in_place_of_the_contact(const Case& c, const Answer& a, const IsRight& is_right) {
  const Operands& parts = c.operands();
  const Layout::Part* place = given_vector(c, a, Role::position);
  const Layout::Part* time = given_part(c, a, Role::time);
  const bool is_of_sphere = parts.start && parts.start->radius && !parts.velocities.empty();
  if (!is_of_sphere || place == nullptr || time == nullptr || is_right(c, a)) return std::nullopt;
  const LongVector at = long_vector_at(a.values, place->begin),
                   velocity = long_vector_at(c.values, parts.velocities[0]);
  const long double largest = largest_length(c), radius = c.values[*parts.start->radius];
  for (const LongVector& corner : corners_of(geometry_of(c, &a))) {
    const auto hit = time_at_distance(long_vector_at(c.values, parts.start->place) - corner, velocity, radius);
    if (!hit || !are_near(at, corner, largest)) continue;
    const long double off = std::abs(*hit - static_cast<long double>(a.values[time->begin])) * length(velocity);
    if (off <= measure().error * largest) return true;
  }
  return false;
}

/// The coordinates of the first operand's center in the frame of the box, over its half extents or not.
template <bool scaled>
std::size_t face_of(const CaseGeometry::Block& box, const LongVector& center) {
  std::array<long double, 3> share;
  for (std::size_t k = 0; k < 3; ++k) {
    share[k] = std::abs(dot(center - box.center, box.axes[k]));
    if (scaled) share[k] /= box.half[int(k)];
  }
  return std::size_t(std::max_element(share.begin(), share.end()) - share.begin());
}
/// A center inside a box, whose nearest face is told by the largest coordinate: judged as that of a box which is so
/// much longer along the other axes that this face is the nearest.
template <bool scaled>
Fits face_of_largest_coordinate(const Case& c, const Answer& a, const IsRight& is_right) {
  const Operand* operand = c.operands().find(Shape::box);
  const bool has_center = c.operands().size() == 2 && c.operands()[0].shape != Shape::box;
  if (operand == nullptr || !has_center || c.operands()[0].positions.size() != 1) return std::nullopt;
  const CaseGeometry g = geometry_of(c, &a);
  const LongVector center = long_vector_at(c.values, c.operands()[0].positions[0]);
  const CaseGeometry::Block& box = g.blocks.front();
  const auto depth_below = [&](std::size_t k) {
    return box.half[int(k)] - std::abs(dot(center - box.center, box.axes[k]));
  };
  const std::size_t face = face_of<scaled>(box, center);
  const bool is_inside = depth_below(0) > 0 && depth_below(1) > 0 && depth_below(2) > 0;
  if (!is_inside) return std::nullopt;
  Case other = c;
  bool is_nearest = true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == face || depth_below(k) > depth_below(face)) continue;
    is_nearest = false;
    const long double half = box.half[int(k)] + 2 * depth_below(face) - depth_below(k);
    double& other_half = other.values[*operand->half + k];
    other_half = rounded_to(c.scalar, double(half));
    if (!std::isfinite(other_half)) return std::nullopt;  // its sum is beyond all numbers of the scalar
  }
  return is_nearest ? std::nullopt : Fits(is_right(other, a));
}

constexpr Reading table_of_contacts[] = {
    {"no normal", "its normal, which is zero, is none", CauseKind::unsupported, false, no_normal},
    {"negative time", "its negative time is 0", CauseKind::convention, false, negative_time<0>},
    {"time of the other sign", "its time has the other sign", CauseKind::convention, false, negative_time<-1>},
    {"center in place of the contact", "its place is the center of a shape", CauseKind::convention, false,
     place_of_a_center},
    {"place before the motion", "its place is where the point of contact was before the motion", CauseKind::convention,
     false, place_before_the_motion},
    {"normal between the centers", "its normal points from one center to the other", CauseKind::convention, false,
     normal_between_centers},
    {"normal of a face", "its normal is that of a face", CauseKind::convention, false, normal_of_a_face},
    {"face of the largest coordinate", "the nearest face of a box is that of the largest coordinate", CauseKind::logic,
     false, face_of_largest_coordinate<false>},
    {"face of the largest share", "the nearest face of a box is that of the largest coordinate over its half extent",
     CauseKind::logic, false, face_of_largest_coordinate<true>},
    {"corner in place of the contact", "a corner is met in place of an edge or face that is met before",
     CauseKind::logic, false, corner_in_place_of_the_contact},
};

}  // namespace

std::span<const Reading> readings_of_contacts() { return table_of_contacts; }

}  // namespace nearmiss
