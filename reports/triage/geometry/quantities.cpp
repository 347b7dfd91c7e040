#include "reports/triage/geometry/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "oracles/judge.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

using Vector = std::array<double, 3>;

Vector vector_at(const Case& c, std::size_t i) { return {c.values[i], c.values[i + 1], c.values[i + 2]}; }
double length(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double area(const Case& c, const std::array<std::size_t, 3>& t) {
  return length(cross(minus(vector_at(c, t[1]), vector_at(c, t[0])), minus(vector_at(c, t[2]), vector_at(c, t[0])))) /
         2;
}

double largest_number(const Case& c) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    if (role == Role::position || role == Role::size) largest = std::max(largest, std::abs(c.values[i]));
  }
  return largest;
}

/// The case with the positions of the first operand moved along an axis.
Case moved(const Case& c, std::size_t axis, double by) {
  Case other = c;
  other.scalar = Scalar::float64;
  for (const std::size_t at : c.operands()[0].positions) other.values[at + axis] += by;
  return other;
}

/// How far the first operand must move along an axis to change the decision; infinite where it does not.
double way_to_flip(const Case& c, bool decision, std::size_t axis, double direction, double largest) {
  constexpr int finest = -50, coarsest = 2, bisections = 12;
  const auto flips = [&](double by) { return exact_decision(moved(c, axis, direction * by)) != decision; };
  for (int k = finest; k <= coarsest; ++k) {
    double far = std::ldexp(largest, k), near = far / 2;
    if (!flips(far)) continue;
    for (int i = 0; i < bisections; ++i) {
      const double middle = (near + far) / 2;
      (flips(middle) ? far : near) = middle;
    }
    return (near + far) / 2;
  }
  return INFINITY;
}

/// The time of the exact contact; 0 where there is none.
double contact_time(const Case& c) {
  const Layout::Part* time = c.query->layout.at(Role::time);
  if (c.query->kind != Kind::impact || time == nullptr) return 0;
  for (const Alternative& right : truth_of(c).alternatives) {
    if (right.yes) return std::max(0.0, right.values[time->begin].low);
  }
  return 0;
}

void add_vectors(const Case& c, std::vector<Quantity>& all) {
  std::vector<const InputMember*> places;
  for (const InputMember& m : c.operands().members) {
    for (std::size_t i = m.begin; m.role == Role::size && i < m.begin + m.count; ++i)
      all.push_back({c.name(i), std::abs(c.values[i])});
    if (m.role == Role::time) all.push_back({m.name, std::abs(c.values[m.begin]), "time"});
    if (m.role == Role::position) places.push_back(&m);
    const std::string of = "the length of " + m.name;
    if (m.role == Role::velocity) all.push_back({of, length(vector_at(c, m.begin)), "speed"});
    if (m.role == Role::direction) all.push_back({of, length(vector_at(c, m.begin)), "length of a direction"});
    if (m.role == Role::rotation)
      all.push_back({of, std::hypot(length(vector_at(c, m.begin)), c.values[m.begin + 3]), "length of a quaternion"});
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      all.push_back({fmt::format("the distance from {} to {}", places[i]->name, places[k]->name),
                     length(minus(vector_at(c, places[i]->begin), vector_at(c, places[k]->begin)))});
    }
  }
  for (const InputMember* m : places)
    all.push_back({fmt::format("the distance of {} from the origin", m->name), length(vector_at(c, m->begin))});
}

/// What tests of spheres, rays and triangles compare in squares: d^2 - R^2 for two centers and the sum of their radii,
/// the discriminant of a motion past a center, and the product of a velocity and the normal of a triangle.
void add_forms(const Case& c, std::vector<Quantity>& all) {
  const Operands& parts = c.operands();
  const bool moves = parts.start.has_value() && !parts.velocities.empty();
  const InputMember& first = parts.members[0];
  for (const InputMember& other : parts.members) {
    if (other.role != Role::position || other.begin == 0 || !first.is_vector()) continue;
    const auto r = parts[0].radius, s = parts[*other.operand].radius;
    if (!r && !s) continue;  // a square of a distance, which is listed
    const double reach = (r ? c.values[*r] : 0) + (s ? c.values[*s] : 0);
    const Vector m = minus(vector_at(c, first.begin), vector_at(c, other.begin));
    const std::string centers = fmt::format("{} and {}", first.name, other.name);
    const double outside = dot(m, m) - reach * reach;
    all.push_back({"d^2 - R^2 of " + centers, std::abs(outside), "length^2"});
    if (!moves) continue;
    const Vector v = vector_at(c, parts.velocities[0]);
    all.push_back(
        {"the discriminant of " + centers, std::abs(dot(m, v) * dot(m, v) - dot(v, v) * outside), "length^2 speed^2"});
  }
  for (const auto& t : parts.triangles) {
    if (!moves) break;
    const Vector n =
        cross(minus(vector_at(c, t[1]), vector_at(c, t[0])), minus(vector_at(c, t[2]), vector_at(c, t[0])));
    all.push_back({"the product of the velocity and the normal of the triangle",
                   std::abs(dot(n, vector_at(c, parts.velocities[0]))), "length^2 speed"});
  }
}

}  // namespace

double gap_of(const Case& c) {
  const double largest = largest_number(c);
  if (!(largest > 0)) return 0;
  const bool decision = exact_decision(c);
  double inverse_square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double way =
        std::min(way_to_flip(c, decision, axis, 1, largest), way_to_flip(c, decision, axis, -1, largest));
    inverse_square += 1 / (way * way);
  }
  return inverse_square > 0 ? 1 / std::sqrt(inverse_square) : 0;
}

std::vector<Quantity> quantities_of(const Case& c, bool with_gap) {
  std::vector<Quantity> all;
  if (with_gap) all.push_back({"the gap or overlap", gap_of(c)});
  all.push_back({"the largest position or size", largest_number(c)});
  add_vectors(c, all);
  add_forms(c, all);
  for (const auto& t : c.operands().triangles) all.push_back({"the area of the triangle", area(c, t), "length^2"});
  const auto& velocities = c.operands().velocities;
  if (!velocities.empty()) {
    const double time = contact_time(c);
    all.push_back({"the time of the contact", time, "time"});
    all.push_back({"the distance moved until the contact", time * length(vector_at(c, velocities[0]))});
  }
  return all;
}

}  // namespace nearmiss
