#include "oracles/requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "impl/catalogue/query_ids.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

using Long = long double;
using Obstacle = Parts::Start::Obstacle;

static_assert(std::numeric_limits<Long>::digits >= 64 && std::numeric_limits<Long>::max_exponent >= 16384,
              "the slacks below are derived from them; no square of a double overflows or underflows");

/// What "within rounding" means, in epsilon. Normalising in the scalar itself rounds the sum of squares, the root and
/// the quotient, by at most half an epsilon, one and one.
constexpr Long most_epsilons = 4;
/// Each check below does at most 16 operations in long double, each with a relative error of at most 2^-63 in any
/// rounding mode.
constexpr Long rounding = 0x1p-58L;

/// The fields of one top-level member.
struct Operand {
  std::string_view name;
  std::size_t begin, count;
};

std::vector<Operand> operands_of(const Query& q) {
  std::vector<Operand> operands;
  for (std::size_t i = 0; i < q.inputs.size(); ++i) {
    const std::string_view whole = q.inputs[i].name, name = whole.substr(0, whole.find('.'));
    if (operands.empty() || operands.back().name != name) operands.push_back({name, i, 0});
    ++operands.back().count;
  }
  return operands;
}

/// The index of the operand's field with that name; empty where it has none.
std::optional<std::size_t> field(const Query& q, const Operand& t, std::string_view member) {
  for (std::size_t i = t.begin; i < t.begin + t.count; ++i) {
    const std::string_view name = q.inputs[i].name;
    if (name.size() == t.name.size() + 1 + member.size() && name.ends_with(member)) return i;
  }
  return std::nullopt;
}

/// The kind of obstacle that the operand is.
std::optional<Obstacle> obstacle_of(const Query& q, const Operand& t) {
  const auto has = [&](std::string_view member) { return field(q, t, member).has_value(); };
  if (has("offset")) return Obstacle::plane;
  if (has("v3.x")) return Obstacle::rectangle;
  if (has("v2.x")) return Obstacle::triangle;
  if (has("p1.x")) return Obstacle::capsule;
  if (has("half.x")) return Obstacle::box;
  if (has("min.x")) return Obstacle::aabox;
  if (has("radius")) return Obstacle::sphere;
  return std::nullopt;
}

std::optional<Parts::Start> start_of(const Query& q, const std::vector<Operand>& operands) {
  const Operand& mover = operands.front();
  const bool is_ray = field(q, mover, "origin.x").has_value();
  const bool moves =
      std::any_of(q.inputs.begin(), q.inputs.end(), [](const Field& f) { return f.role == Role::velocity; });
  if (!is_ray && !moves) return std::nullopt;
  for (const Operand& t : operands) {
    const auto obstacle = obstacle_of(q, t);
    if (&t == &mover || !obstacle) continue;
    return Parts::Start{mover.begin, field(q, mover, "radius"), *obstacle, t.begin, t.count};
  }
  return std::nullopt;
}

using Vector = std::array<Long, 3>;

Vector vector(const Case& c, std::size_t i) { return {c.values[i], c.values[i + 1], c.values[i + 2]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Long dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Long length(const Vector& a) { return std::sqrt(dot(a, a)); }
Long largest(const Vector& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// If the length lies in [1 - d, 1 + d], d = most_epsilons * epsilon, its square lies in [1 - 2 d + d^2, 1 + 2 d +
/// d^2].
bool is_unit(const Case& c, std::size_t begin, std::size_t count) {
  const Long d = most_epsilons * Long(unit_roundoff(c.scalar));
  Long square = 0;
  for (std::size_t i = begin; i < begin + count; ++i) square += Long(c.values[i]) * c.values[i];
  return std::abs(square - 1) <= 2 * d - d * d - rounding;
}

/// True if v3 can move along the first side, and v2 to the fourth corner of the parallelogram, so that the corners form
/// a rectangle and no coordinate moves too far.
bool is_rectangle(const Case& c, const Parts::Corners& corners) {
  const Vector v0 = vector(c, corners[0]), v1 = vector(c, corners[1]), v2 = vector(c, corners[2]),
               v3 = vector(c, corners[3]);
  const Long magnitude = std::max({largest(v0), largest(v1), largest(v2), largest(v3)});
  const Long most = (most_epsilons * Long(unit_roundoff(c.scalar)) - rounding) * magnitude;
  const Vector e = v1 - v0, f = v3 - v0;
  const Long shorter = std::min(length(e), length(f)), longer = std::max(length(e), length(f));
  constexpr Long sides_stay = 4;  // each end of a side moves by at most sqrt(3) most
  if (!(shorter > sides_stay * most)) return false;
  const Long askew = std::abs(dot(e, f)) / longer, open = largest((v0 + v2) - (v1 + v3));
  return askew + open <= most;
}

/// The rounding error of the cross product is at most 16 roundings of |v| (|e| + |f|), where |v| is the largest
/// coordinate.
bool has_area(const Case& c, const std::array<std::size_t, 3>& corners) {
  const Vector v0 = vector(c, corners[0]), v1 = vector(c, corners[1]), v2 = vector(c, corners[2]);
  const Vector e = v1 - v0, f = v2 - v0;
  const Long magnitude = std::max({largest(v0), largest(v1), largest(v2)});
  return largest(cross(e, f)) > rounding * magnitude * (length(e) + length(f));
}

bool differ(const Case& c, std::size_t i, std::size_t k) {
  return !std::equal(&c.values[i], &c.values[i] + 3, &c.values[k]);
}

bool is_zero(const Case& c, std::size_t begin) {
  return std::all_of(&c.values[begin], &c.values[begin] + 3, [](double x) { return x == 0; });
}

bool has_no_zero_sizes(const Case& c, const Parts& parts) {
  const auto each = [](const auto& list, auto holds) { return std::all_of(list.begin(), list.end(), holds); };
  const auto has_sides = [&](std::size_t i) {
    return c.values[i] < c.values[i + 3] && c.values[i + 1] < c.values[i + 4] && c.values[i + 2] < c.values[i + 5];
  };
  return each(parts.sizes, [&](std::size_t i) { return c.values[i] > 0; }) && each(parts.aaboxes, has_sides) &&
         each(parts.segments, [&](const auto& s) { return differ(c, s[0], s[1]); }) &&
         each(parts.triangles, [&](const auto& t) { return has_area(c, t); });
}

/// The ball at the start and the obstacle, as a case of another query of the catalogue.
Case beside(const Case& c, QueryId query, std::vector<double> values) {
  return {&query_of(query), c.scalar, std::move(values), "start", 0, 0, {}};
}

bool overlaps(const Case& c, const Parts::Start& s, QueryId query, const std::vector<std::size_t>& rest) {
  std::vector<double> values(&c.values[s.place], &c.values[s.place] + 3);
  values.push_back(s.radius ? c.values[*s.radius] : 0.0);
  for (const std::size_t i : rest) values.push_back(c.values[i]);
  return exact_decision(beside(c, query, std::move(values)));
}

/// A ball at rest hits exactly what it touches or overlaps. Only the sum of the radii matters. The ball gets the larger
/// radius, because a point inside a capsule hits nothing.
bool overlaps_capsule(const Case& c, const Parts::Start& s) {
  const double own = s.radius ? c.values[*s.radius] : 0.0, other = c.values[s.begin + 6];
  std::vector<double> values(&c.values[s.place], &c.values[s.place] + 3);
  values.insert(values.end(), {std::max(own, other), 0, 0, 0});
  values.insert(values.end(), &c.values[s.begin], &c.values[s.begin] + 6);
  values.push_back(std::min(own, other));
  return exact_decision(beside(c, QueryId::moving_sphere_capsule, std::move(values)));
}

bool is_in_aabox(const Case& c, const Parts::Start& s) {
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = c.values[s.place + k];
    inside = inside && c.values[s.begin + k] <= x && x <= c.values[s.begin + 3 + k];
  }
  return inside;
}

std::vector<std::size_t> numbers(std::size_t begin, std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = begin + i;
  return all;
}

bool starts_in_touch(const Case& c, const Parts::Start& s) {
  const auto all = numbers(s.begin, s.count);
  switch (s.obstacle) {
    case Obstacle::plane: return overlaps(c, s, QueryId::sphere_plane_penetration, all);
    case Obstacle::triangle: return overlaps(c, s, QueryId::sphere_triangle_overlap, all);
    case Obstacle::sphere: return overlaps(c, s, QueryId::sphere_sphere_overlap, all);
    case Obstacle::box: return overlaps(c, s, QueryId::sphere_box_overlap, all);
    case Obstacle::capsule: return overlaps_capsule(c, s);
    case Obstacle::aabox: return is_in_aabox(c, s);
    case Obstacle::rectangle: break;
  }
  auto second = numbers(s.begin, 3);  // v0 v2 v3
  for (const std::size_t i : numbers(s.begin + 6, 6)) second.push_back(i);
  return overlaps(c, s, QueryId::sphere_triangle_overlap, numbers(s.begin, 9)) ||
         overlaps(c, s, QueryId::sphere_triangle_overlap, second);
}

}  // namespace

Parts::Parts(const Query& q) {
  const std::vector<Operand> operands = operands_of(q);
  for (const Operand& t : operands) {
    const auto at = [&](std::string_view member) { return field(q, t, member); };
    if (at("v3.x")) {
      rectangles.push_back({t.begin, t.begin + 3, t.begin + 6, t.begin + 9});
      triangles.push_back({t.begin, t.begin + 3, t.begin + 6});
      triangles.push_back({t.begin, t.begin + 6, t.begin + 9});
    } else if (at("v2.x")) {
      triangles.push_back({t.begin, t.begin + 3, t.begin + 6});
    } else if (at("v1.x") || at("p1.x")) {
      segments.push_back({t.begin, t.begin + 3});
    } else if (at("min.x")) {
      aaboxes.push_back(t.begin);
    }
  }
  for (std::size_t i = 0; i < q.inputs.size(); ++i) {
    const Field& f = q.inputs[i];
    if (f.role == Role::size) sizes.push_back(i);
    if (!f.name.ends_with(".x") && f.name != "x") continue;
    if (f.role == Role::rotation) quaternions.push_back(i);
    if (f.role == Role::velocity) velocities.push_back(i);
    if (f.role == Role::direction) (f.name.ends_with("normal.x") ? normals : directions).push_back(i);
  }
  start = start_of(q, operands);
}

const Parts& parts_of(const Query& query) {
  static const std::vector<Parts> all = [] {
    std::vector<Parts> made;
    for (const Query& q : catalogue()) made.emplace_back(q);
    return made;
  }();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (&catalogue()[i] == &query) return all[i];
  }
  throw std::logic_error("the query is not of the catalogue");
}

bool concerns(Precondition p, const Query& query) {
  const Parts& parts = parts_of(query);
  switch (p) {
    case Precondition::true_rectangle: return !parts.rectangles.empty();
    case Precondition::unit_normal: return !parts.normals.empty();
    case Precondition::unit_direction: return !parts.directions.empty();
    case Precondition::unit_quaternion: return !parts.quaternions.empty();
    case Precondition::starts_outside: return parts.start.has_value();
    case Precondition::moves: return !parts.velocities.empty();
    case Precondition::no_zero_sizes:
      return !(parts.sizes.empty() && parts.aaboxes.empty() && parts.segments.empty() && parts.triangles.empty());
  }
  throw std::logic_error("no precondition");
}

bool meets(const Case& c, Precondition p) {
  const Parts& parts = parts_of(*c.query);
  const auto each = [](const auto& list, auto holds) { return std::all_of(list.begin(), list.end(), holds); };
  const auto three = [&](std::size_t i) { return is_unit(c, i, 3); };
  switch (p) {
    case Precondition::true_rectangle: return each(parts.rectangles, [&](const auto& r) { return is_rectangle(c, r); });
    case Precondition::unit_normal: return each(parts.normals, three);
    case Precondition::unit_direction: return each(parts.directions, three);
    case Precondition::unit_quaternion: return each(parts.quaternions, [&](std::size_t i) { return is_unit(c, i, 4); });
    case Precondition::starts_outside: return !parts.start || !starts_in_touch(c, *parts.start);
    case Precondition::moves: return each(parts.velocities, [&](std::size_t i) { return !is_zero(c, i); });
    case Precondition::no_zero_sizes: return has_no_zero_sizes(c, parts);
  }
  throw std::logic_error("no precondition");
}

Preconditions unmet_by(const Case& question, Preconditions required) {
  Preconditions unmet;
  if (required.empty()) return unmet;
  for (const Precondition p : all_preconditions) {
    if (required.has(p) && !meets(question, p)) unmet.add(p);
  }
  return unmet;
}

std::string requires_text(Preconditions required) {
  std::vector<std::string_view> names;
  for (const Precondition p : all_preconditions) {
    if (required.has(p)) names.push_back(precondition_texts[std::size_t(p)].required);
  }
  std::string text = "it requires ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : i + 1 == names.size() ? " and " : ", ", names[i]);
  }
  return text;
}

Answer answer_of_unasked(Preconditions unmet) {
  return Answer::without(Answer::Status::cannot_answer, "not asked: " + requires_text(unmet));
}

Answer ask_here(const Subject& subject, const Case& question) {
  const Offering& offering = subject.offering(question.query->name);
  const Preconditions unmet = unmet_by(question, offering.required);
  return unmet.empty() ? offering.answer(question.values) : answer_of_unasked(unmet);
}

}  // namespace nearmiss
