#include "corpus/scenes/scene_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "corpus/generator/fit.hpp"
#include "corpus/scenes/operands.hpp"
#include "corpus/scenes/solids.hpp"

namespace nearmiss::scenes {

namespace {

std::uint64_t hash_of_text(std::string_view text) {  // FNV-1a
  std::uint64_t h = 0xcbf29ce484222325;
  for (const unsigned char c : text) h = (h ^ c) * 0x100000001b3;
  return h;
}

/// The stream of one scene, query, scalar and seed at its `index`-th place.
Random random_at(const Scene& scene, std::string_view query, int scalar, std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t stream = hash_of_text(scene.name) ^ Random(hash_of_text(query)).bits() ^ std::uint64_t(scalar);
  return Random(Random(Random(seed).bits() ^ stream).bits() ^ Random(index).bits());
}

double tolerable_error(const Scene& scene) {
  return std::max(scene.required.position_error.value, scene.required.missed_depth.value);
}

/// A length of up to eight times the tolerable error, of either sign; in each of 25 octaves equally often.
double draw_gap(Random& random, const Scene& scene) {
  constexpr int most = 2;  // 2 * 2^2: eight times the tolerable error
  return random.sign() * tolerable_error(scene) * std::ldexp(random.uniform(1, 2), random.between(-22, most));
}

/// Two solids of a scene, the velocity of the first, and the time of the step.
struct Placement {
  Solid first, second;
  Vector velocity{};
};

/// Draws the placement of two shapes.
class Placing {
 public:
  Placing(const Scene& scene, const MixedQuery& mixed, const QueryPlan& plan, Random& random)
      : scene_(scene), plan_(plan), random_(random), shapes_{&shapes(mixed, 0), &shapes(mixed, 1)} {}

  Placement draw() {
    Placement p{draw_solid(random_, *shapes_[0]), draw_solid(random_, *shapes_[1])};
    const Vector middle = scaled(draw_direction(random_), draw_from(random_, scene_.distance));
    p.second.center = plus(middle, vector_within(scene_.extent.value));
    // A ray has no speed: it has a direction of length 1.
    speed_ = plan_.velocity ? draw_from(random_, shapes_[0]->speed) : plan_.direction ? 1 : 0;
    if (random_.uniform(0, 1) < scene_.near_contact.value) {
      near_contact(p);
    } else {
      within_reach(p);
    }
    return p;
  }

 private:
  const Shapes& shapes(const MixedQuery& mixed, std::size_t i) const { return scene_.shapes[mixed.operands[i]]; }
  Vector vector_within(double reach) {
    return {random_.uniform(-reach, reach), random_.uniform(-reach, reach), random_.uniform(-reach, reach)};
  }
  /// How far the first may be from the second in the step: for a ray, over the extent of the scene.
  double way() const { return plan_.direction ? scene_.extent.value : speed_ * scene_.step.value; }

  /// The first is where a broad phase keeps the pair; it moves anywhere, or towards a point in the second.
  void within_reach(Placement& p) {
    const double together = p.first.reach() + p.second.reach() + way();
    p.first.center = plus(p.second.center, draw_direction(random_), together * random_.uniform(0, 1));
    if (!plan_.moves()) return;
    Vector along = draw_direction(random_);
    const Vector to = plus(plus(p.second.center, vector_within(p.second.reach() / 2)), p.first.center, -1);
    if (const double length = length_of(to); random_.one_in(2) && length > 0) along = scaled(to, 1 / length);
    p.velocity = scaled(along, speed_);
  }

  /// The first touches the second but for a gap: at rest, at the end of the step, or where it passes by.
  void near_contact(Placement& p) {
    const SurfacePoint at = draw_surface_point(random_, p.second);
    const Vector touching = plus(plus(p.second.center, at.at), p.first.support(scaled(at.normal, -1)), -1);
    p.first.center = plus(touching, at.normal, draw_gap(random_, scene_));
    if (!plan_.moves()) return;
    const bool passes = !random_.one_in(4);
    Vector along = passes ? draw_orthogonal(random_, at.normal) : draw_direction(random_);
    if (!passes && dot(along, at.normal) > 0) along = scaled(along, -1);
    p.first.center = plus(p.first.center, along, -way() * (passes ? random_.uniform(0, 1) : 1.0));
    p.velocity = scaled(along, speed_);
  }

  const Scene& scene_;
  const QueryPlan& plan_;
  Random& random_;
  std::array<const Shapes*, 2> shapes_;
  double speed_ = 0;
};

/// Writes the numbers of a case, rounded to its scalar.
class Filling {
 public:
  explicit Filling(Case& c) : case_(c) {}

  void vector(std::size_t begin, const Vector& v) {
    for (std::size_t k = 0; k < 3; ++k) number(begin + k, v[k]);
  }
  void number(std::size_t i, double x) { case_.values[i] = rounded_to(case_.scalar, x); }
  void solid(std::size_t begin, const Solid& s) {
    switch (s.type) {
      case Shape::box: return box(begin, s);
      case Shape::aabox: vector(begin, plus(s.center, s.half, -1)); return vector(begin + 3, plus(s.center, s.half));
      case Shape::plane:
      case Shape::halfspace: vector(begin, s.axes[0]); return number(begin + 3, -dot(s.axes[0], s.center));
      default: break;
    }
    for (std::size_t i = 0; i < s.corner_count; ++i) vector(begin + 3 * i, plus(s.center, s.corners[i]));
    if (s.type == Shape::sphere || s.type == Shape::capsule) number(begin + 3 * s.corner_count, s.radius);
  }

 private:
  void box(std::size_t begin, const Solid& s) {
    vector(begin, s.center);
    vector(begin + 3, s.half);
    for (std::size_t k = 0; k < 4; ++k) number(begin + 6 + k, s.rotation[k]);
  }

  Case& case_;
};

/// A time is the step. Flags: a solid sphere, a motion with a limit. Indices: no hint.
double lone_number(const Field& field, const Scene& scene, Random& random) {
  if (field.role == Role::time) return scene.step.value;
  if (field.role == Role::flag) return field.name == "solid" ? 1 : 0;
  return field.name == "axis" ? double(random.below(15)) : -1;
}

bool is_valid(const Case& c) {
  const bool finite = std::all_of(c.values.begin(), c.values.end(), [](double x) { return std::isfinite(x); });
  return finite && !c.query->broken(c.values);
}

void draw_shapes(Case& into, const Scene& scene, const MixedQuery& mixed, Random& random) {
  const QueryPlan plan = *query_plan(*mixed.query);
  constexpr int attempts = 100;
  for (int i = 0; i < attempts; ++i) {
    const Placement p = Placing(scene, mixed, plan, random).draw();
    Filling fill(into);
    fill.solid(plan.operands[0].begin, p.first);
    fill.solid(plan.operands[1].begin, p.second);
    if (plan.velocity) fill.vector(*plan.velocity, p.velocity);
    if (plan.direction) fill.vector(*plan.direction, p.velocity);
    for (const std::size_t k : plan.lone) fill.number(k, lone_number(mixed.query->inputs[k], scene, random));
    if (is_valid(into)) return;
  }
  throw std::logic_error(fmt::format("scene {}: no valid case of {} in 100 attempts", scene.name, mixed.query->name));
}

/// Moves the shape that holds a drawn position, all its positions alike.
void move_one_shape(Case& c, const Scene& scene, Random& random) {
  const Operands& operands = c.operands();
  std::vector<std::size_t> begins;
  for (const Operand& o : operands) begins.insert(begins.end(), o.positions.begin(), o.positions.end());
  if (begins.empty()) return;
  const Operand* chosen = operands.of_number(random.pick(begins));
  const Vector by = scaled(draw_direction(random), draw_gap(random, scene));
  for (const std::size_t begin : begins) {
    if (!chosen->has(begin)) continue;
    for (std::size_t k = 0; k < 3; ++k) c.values[begin + k] = rounded_to(c.scalar, c.values[begin + k] + by[k]);
  }
}

/// The recorded cases of the query in turn; from the second round on, moved.
void draw_recorded(Case& into, const Scene& scene, const MixedQuery& mixed, std::uint64_t index, Random& random) {
  const std::vector<std::size_t>& own = mixed.recorded;
  const std::size_t first = std::size_t(index % own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Case& c = scene.recorded[own[(first + i) % own.size()]];
    for (std::size_t k = 0; k < c.values.size(); ++k) into.values[k] = rounded_to(into.scalar, c.values[k]);
    if (index >= own.size()) move_one_shape(into, scene, random);
    if (is_valid(into)) return;
  }
  throw std::logic_error(fmt::format("scene {}: no recorded case of {} is valid in {}", scene.name, into.query->name,
                                     name_of(into.scalar)));
}

}  // namespace

double largest_gap(const Scene& scene) { return 8 * tolerable_error(scene); }

void draw_case(Case& into, const Scene& scene, const Query& query, Scalar scalar, std::uint64_t seed,
               std::uint64_t index) {
  const MixedQuery* mixed = scene.find(query);
  if (mixed == nullptr) throw std::logic_error(fmt::format("scene {} does not ask {}", scene.name, query.name));
  Random random = random_at(scene, query.name, int(scalar), seed, index);
  into.query = &query;
  into.scalar = scalar;
  into.values.assign(query.inputs.size(), 0);
  into.origin = "scene " + scene.name;
  into.seed = seed;
  into.index = index;
  into.moves.clear();
  if (scene.is_recorded()) {
    draw_recorded(into, scene, *mixed, index, random);
  } else {
    draw_shapes(into, scene, *mixed, random);
  }
}

Case draw_case(const Scene& scene, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index) {
  Case c;
  draw_case(c, scene, query, scalar, seed, index);
  return c;
}

void draw_case_inside(Case& into, const Scene& scene, const Query& query, Scalar scalar, std::uint64_t seed,
                      std::uint64_t index, Preconditions required) {
  draw_case(into, scene, query, scalar, seed, index);
  fit(into, required);
}

const Query& drawn_query(const Scene& scene, std::uint64_t seed, std::uint64_t index) {
  double sum = 0;
  for (const MixedQuery& m : scene.queries) sum += m.weight.value;
  double at = random_at(scene, "", 2, seed, index).uniform(0, sum);
  for (const MixedQuery& m : scene.queries) {
    if (at < m.weight.value) return *m.query;
    at -= m.weight.value;
  }
  return *scene.queries.back().query;
}

}  // namespace nearmiss::scenes
