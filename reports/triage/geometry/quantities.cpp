#include "reports/triage/geometry/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "impl/catalogue/roles.hpp"
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

/// "sphere.center" of "sphere.center.x".
std::string vector_name(const Query& q, std::size_t i) {
  const std::string& name = q.inputs[i].name;
  return name.size() > 2 ? name.substr(0, name.size() - 2) : name;
}

bool begins_vector(const Query& q, std::size_t i) {
  return (q.inputs[i].name.ends_with(".x") || q.inputs[i].name == "x") && i + 2 < q.inputs.size();
}

double largest_number(const Case& c) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.query->inputs[i].role;
    if (role == Role::position || role == Role::size) largest = std::max(largest, std::abs(c.values[i]));
  }
  return largest;
}

/// The case with the positions of the first operand moved along an axis.
Case moved(const Case& c, std::size_t axis, double by) {
  constexpr std::string_view axes[] = {".x", ".y", ".z"};
  Case other = c;
  other.scalar = Scalar::float64;
  const std::string& first = c.query->inputs.front().name;
  const std::string operand = first.substr(0, first.find('.') + 1);
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Field& f = c.query->inputs[i];
    if (f.role == Role::position && f.name.starts_with(operand) && f.name.ends_with(axes[axis])) other.values[i] += by;
  }
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
  const auto time = index_of_role(c.query->outputs, Role::time);
  if (c.query->kind != Kind::impact || !time) return 0;
  for (const Alternative& right : truth_of(c).alternatives) {
    if (right.yes) return std::max(0.0, right.values[*time].low);
  }
  return 0;
}

void add_vectors(const Case& c, std::vector<Quantity>& all) {
  const Query& q = *c.query;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = q.inputs[i].role;
    if (role == Role::size) all.push_back({q.inputs[i].name, std::abs(c.values[i])});
    if (role == Role::time) all.push_back({q.inputs[i].name, std::abs(c.values[i]), "time"});
    if (!begins_vector(q, i)) continue;
    if (role == Role::position) places.push_back(i);
    const std::string of = "the length of " + vector_name(q, i);
    if (role == Role::velocity) all.push_back({of, length(vector_at(c, i)), "speed"});
    if (role == Role::direction) all.push_back({of, length(vector_at(c, i)), "length of a direction"});
    if (role == Role::rotation)
      all.push_back({of, std::hypot(length(vector_at(c, i)), c.values[i + 3]), "length of a quaternion"});
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      all.push_back({fmt::format("the distance from {} to {}", vector_name(q, places[i]), vector_name(q, places[k])),
                     length(minus(vector_at(c, places[i]), vector_at(c, places[k])))});
    }
  }
  for (const std::size_t i : places)
    all.push_back({fmt::format("the distance of {} from the origin", vector_name(q, i)), length(vector_at(c, i))});
}

/// The input that is the radius of the operand of a position; none where it has none.
std::optional<std::size_t> radius_beside(const Query& q, std::size_t place) {
  const std::string operand = q.inputs[place].name.substr(0, q.inputs[place].name.find('.'));
  for (std::size_t i = 0; i < q.inputs.size(); ++i) {
    if (q.inputs[i].name == operand + ".radius") return i;
  }
  return std::nullopt;
}

/// What tests of spheres, rays and triangles compare in squares: d^2 - R^2 for two centers and the sum of their radii,
/// the discriminant of a motion past a center, and the product of a velocity and the normal of a triangle.
void add_forms(const Case& c, std::vector<Quantity>& all) {
  const Query& q = *c.query;
  const Parts& parts = parts_of(q);
  const bool moves = parts.start.has_value() && !parts.velocities.empty();
  for (std::size_t b = 3; b < q.inputs.size(); ++b) {
    if (q.inputs[b].role != Role::position || !begins_vector(q, b) || !begins_vector(q, 0)) continue;
    const auto r = radius_beside(q, 0), s = radius_beside(q, b);
    if (!r && !s) continue;  // a square of a distance, which is listed
    const double reach = (r ? c.values[*r] : 0) + (s ? c.values[*s] : 0);
    const Vector m = minus(vector_at(c, 0), vector_at(c, b));
    const std::string centers = fmt::format("{} and {}", vector_name(q, 0), vector_name(q, b));
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
  for (const auto& t : parts_of(*c.query).triangles)
    all.push_back({"the area of the triangle", area(c, t), "length^2"});
  const auto& velocities = parts_of(*c.query).velocities;
  if (!velocities.empty()) {
    const double time = contact_time(c);
    all.push_back({"the time of the contact", time, "time"});
    all.push_back({"the distance moved until the contact", time * length(vector_at(c, velocities[0]))});
  }
  return all;
}

}  // namespace nearmiss
