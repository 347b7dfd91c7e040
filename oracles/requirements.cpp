#include "oracles/requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "impl/catalogue/query_ids.hpp"
#include "oracles/derived_case.hpp"
#include "oracles/exact_decision.hpp"

namespace nearmiss {

namespace {

using Long = long double;
using Start = Operands::Start;

static_assert(std::numeric_limits<Long>::digits >= 64 && std::numeric_limits<Long>::max_exponent >= 16384,
              "the slacks below are derived from them; no square of a double overflows or underflows");

/// What "within rounding" means, in epsilon. Normalising in the scalar itself rounds the sum of squares, the root and
/// the quotient, by at most half an epsilon, one and one.
constexpr Long most_epsilons = 4;
/// Each check below does at most 16 operations in long double, each with a relative error of at most 2^-63 in any
/// rounding mode.
constexpr Long rounding = 0x1p-58L;

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
bool is_rectangle(const Case& c, const Operands::Corners& corners) {
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

/// The names of a member in another query and here.
using Renamed = std::pair<std::string_view, std::string_view>;

/// A case and how far each of its numbers may move; without `moves` none does. A question about it asks whether
/// something certainly holds for every such input.
struct Neighbourhood {
  const Case& c;
  std::span<const double> moves;

  Long move(std::size_t i) const { return moves.empty() ? 0 : moves[i]; }
  /// Of the three numbers of a vector, the furthest move.
  Long move_of_vector(std::size_t i) const { return std::max({move(i), move(i + 1), move(i + 2)}); }
  /// Number i is certainly at most number k.
  bool at_most(std::size_t i, std::size_t k) const { return moves.empty() ? c.values[i] <= c.values[k] : less(i, k); }
  /// Number i is certainly less than number k.
  bool less(std::size_t i, std::size_t k) const {
    if (moves.empty()) return c.values[i] < c.values[k];
    return Long(c.values[k]) - c.values[i] > (move(i) + move(k)) * (1 + rounding);
  }
};

/// The rounding error of the cross product is at most 16 roundings of |v| (|e| + |f|), where |v| is the largest
/// coordinate. If each coordinate moves by at most m, each coordinate of e and f moves by at most 2 m, and one of the
/// cross product by at most 2 m (|e| + |f|) sqrt(2) + 8 m^2.
bool has_area(const Neighbourhood& n, const std::array<std::size_t, 3>& corners) {
  const Vector v0 = vector(n.c, corners[0]), v1 = vector(n.c, corners[1]), v2 = vector(n.c, corners[2]);
  const Vector e = v1 - v0, f = v2 - v0;
  const Long magnitude = std::max({largest(v0), largest(v1), largest(v2)}), sides = length(e) + length(f);
  const Long m = std::max({n.move_of_vector(corners[0]), n.move_of_vector(corners[1]), n.move_of_vector(corners[2])});
  return largest(cross(e, f)) > rounding * magnitude * sides + 3 * m * sides + 9 * m * m;
}

bool differ(const Neighbourhood& n, std::size_t i, std::size_t k) {
  bool any = false;
  for (std::size_t c = 0; c < 3; ++c) any = any || n.less(i + c, k + c) || n.less(k + c, i + c);
  return any;
}

bool is_not_zero(const Neighbourhood& n, std::size_t begin) {
  bool any = false;
  for (std::size_t i = begin; i < begin + 3; ++i) any = any || std::abs(Long(n.c.values[i])) > n.move(i);
  return any;
}

bool has_no_zero_sizes(const Neighbourhood& n, const Operands& parts) {
  const auto each = [](const auto& list, auto holds) { return std::all_of(list.begin(), list.end(), holds); };
  const auto has_sides = [&](std::size_t i) {
    return n.less(i, i + 3) && n.less(i + 1, i + 4) && n.less(i + 2, i + 5);
  };
  return each(parts.sizes, [&](std::size_t i) { return n.c.values[i] > n.move(i); }) &&
         each(parts.aaboxes, has_sides) && each(parts.segments, [&](const auto& s) { return differ(n, s[0], s[1]); }) &&
         each(parts.triangles, [&](const auto& t) { return has_area(n, t); });
}

/// What is the same for every input of a neighbourhood; empty where this is not proved.
using Certain = std::optional<bool>;

/// The ball at the start and the obstacle, as a case of another query of the catalogue whose decision tells whether
/// they touch.
class StartAsCase {
 public:
  StartAsCase(const Neighbourhood& n, const Start& start, QueryId query) : n_(n), start_(start), derived_(n.c, query) {}

  void set(std::string_view to, std::optional<std::size_t> index) { derived_.set(to, index); }
  void set_ball(const std::string& to) {
    derived_.set_vector(to + ".center", start_.place);
    derived_.set(to + ".radius", start_.radius);
  }
  /// The numbers of the obstacle, which has the same members there; a member with the name `first` takes that with the
  /// name `second`.
  void set_obstacle(std::string_view to, std::span<const Renamed> renamed = {}) {
    const Operand& operand = *derived_.question().operands().find(to);
    for (const ShapeMember& m : operand.members) {
      const auto other =
          std::find_if(renamed.begin(), renamed.end(), [&](const Renamed& r) { return m.name == r.first; });
      const std::size_t from = start_.obstacle.member(other == renamed.end() ? m.name : other->second).value();
      for (std::size_t k = 0; k < m.count; ++k) derived_.set(operand.begin + m.begin + k, from + k);
    }
  }
  Certain touch() const {
    if (n_.moves.empty()) return exact_decision(derived_.question());
    const std::vector<double> moves = derived_.of_inputs({n_.moves.begin(), n_.moves.end()});
    return decision_within(derived_.question(), moves);
  }

 private:
  const Neighbourhood& n_;
  const Start& start_;
  DerivedCase derived_;
};

Certain touch_of(const Neighbourhood& n, const Start& s, QueryId query, const std::string& ball,
                 std::string_view obstacle, std::span<const Renamed> renamed = {}) {
  StartAsCase start(n, s, query);
  start.set_ball(ball);
  start.set_obstacle(obstacle, renamed);
  return start.touch();
}

/// A ball at rest hits exactly what it touches or overlaps. Only the sum of the radii matters. The ball gets the larger
/// radius, because a point inside a capsule hits nothing.
Certain touch_of_capsule(const Neighbourhood& n, const Start& s) {
  StartAsCase start(n, s, QueryId::moving_sphere_capsule);
  start.set_ball("sphere");
  start.set_obstacle("capsule");
  const std::size_t other = s.obstacle.radius.value();
  if (!s.radius || n.c.values[*s.radius] < n.c.values[other]) {
    start.set("sphere.radius", other);
    start.set("capsule.radius", s.radius);
  }
  return start.touch();
}

Certain touch_of_aabox(const Neighbourhood& n, const Start& s) {
  const std::size_t low = s.obstacle.positions[0], high = s.obstacle.positions[1];
  bool any_apart = false, all_within = true;
  for (std::size_t k = 0; k < 3; ++k) {
    any_apart = any_apart || n.less(s.place + k, low + k) || n.less(high + k, s.place + k);
    all_within = all_within && n.at_most(low + k, s.place + k) && n.at_most(s.place + k, high + k);
  }
  return any_apart ? Certain(false) : all_within ? Certain(true) : std::nullopt;
}

/// Both triangles of a rectangle count.
Certain touch_of_rectangle(const Neighbourhood& n, const Start& s) {
  constexpr std::array<Renamed, 2> second{Renamed{"v1", "v2"}, Renamed{"v2", "v3"}};
  const Certain one = touch_of(n, s, QueryId::sphere_triangle_overlap, "sphere", "triangle");
  if (one.value_or(false)) return one;
  const Certain other = touch_of(n, s, QueryId::sphere_triangle_overlap, "sphere", "triangle", second);
  return other.value_or(false) || (one && other) ? other : std::nullopt;
}

Certain touch_at_start(const Neighbourhood& n, const Start& s) {
  switch (s.obstacle.shape) {
    case Shape::plane: return touch_of(n, s, QueryId::sphere_plane_penetration, "sphere", "plane");
    case Shape::halfspace: return touch_of(n, s, QueryId::sphere_halfspace_overlap, "sphere", "halfspace");
    case Shape::triangle: return touch_of(n, s, QueryId::sphere_triangle_overlap, "sphere", "triangle");
    case Shape::rectangle: return touch_of_rectangle(n, s);
    case Shape::sphere: return touch_of(n, s, QueryId::sphere_sphere_overlap, "sphere1", "sphere2");
    case Shape::capsule: return touch_of_capsule(n, s);
    case Shape::box: return touch_of(n, s, QueryId::sphere_box_overlap, "sphere", "box");
    case Shape::aabox: return touch_of_aabox(n, s);
    case Shape::point:
    case Shape::segment:
    case Shape::line:
    case Shape::ray: break;
  }
  throw std::logic_error("no obstacle");
}

bool meets(const Neighbourhood& n, Precondition p) {
  const Case& c = n.c;
  const Operands& parts = c.operands();
  const auto each = [](const auto& list, auto holds) { return std::all_of(list.begin(), list.end(), holds); };
  const auto three = [&](std::size_t i) { return is_unit(c, i, 3); };
  switch (p) {
    case Precondition::true_rectangle: return each(parts.rectangles, [&](const auto& r) { return is_rectangle(c, r); });
    case Precondition::unit_normal: return each(parts.normals, three);
    case Precondition::unit_direction: return each(parts.directions, three);
    case Precondition::unit_quaternion: return each(parts.quaternions, [&](std::size_t i) { return is_unit(c, i, 4); });
    case Precondition::starts_outside: return !parts.start || touch_at_start(n, *parts.start) == Certain(false);
    case Precondition::moves: return each(parts.velocities, [&](std::size_t i) { return is_not_zero(n, i); });
    case Precondition::no_zero_sizes: return has_no_zero_sizes(n, parts);
  }
  throw std::logic_error("no precondition");
}

}  // namespace

bool concerns(Precondition p, const Query& query) {
  const Operands& parts = query.operands;
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

bool meets(const Case& question, Precondition p) { return meets(Neighbourhood{question, {}}, p); }

Preconditions unmet_by(const Case& question, Preconditions required) {
  Preconditions unmet;
  if (required.empty()) return unmet;
  for (const Precondition p : all_preconditions) {
    if (required.has(p) && !meets(question, p)) unmet.add(p);
  }
  return unmet;
}

Preconditions with_border(const Query& query, Preconditions required) {
  Preconditions some;
  for (const Precondition p : all_preconditions) {
    if (required.has(p) && has_border(p) && concerns(p, query)) some.add(p);
  }
  return some;
}

Preconditions unmet_within(const Case& question, Preconditions required, std::span<const double> moves) {
  Preconditions unmet;
  for (const Precondition p : all_preconditions) {
    if (required.has(p) && has_border(p) && !meets(Neighbourhood{question, moves}, p)) unmet.add(p);
  }
  return unmet;
}

std::optional<bool> contact_at_start(const Case& question, std::span<const double> moves) {
  const auto& start = question.operands().start;
  return start ? touch_at_start({question, moves}, *start) : false;
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
