#include "properties/judge/families.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "corpus/generator/case_builder.hpp"

namespace nearmiss {

namespace {

using Numbers = CaseBuilder::Numbers;

/// a + (b - a) * share.
Numbers between(const Numbers& a, const Numbers& b, double share) {
  return {a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share, a[2] + (b[2] - a[2]) * share};
}

/// The size factor of a tiny operand.
double small_factor(CaseBuilder& d) { return d.random.power_of_two(-d.orders(10, 40), -2); }

void shrink_operand(CaseBuilder& d, const Operand& operand, double factor) {
  for (std::size_t v : operand.positions) d.set_vector(v, between(d.vector(operand.positions[0]), d.vector(v), factor));
  for (std::size_t i : operand.sizes) d.scale(i, factor);
}

void make_tiny(CaseBuilder& d) {
  const std::size_t chosen = d.random.below(d.plan.operands.size() + 1);  // operands.size(): all of them
  const double factor = small_factor(d);
  for (std::size_t i = 0; i < d.plan.operands.size(); ++i) {
    if (i == chosen || chosen == d.plan.operands.size()) shrink_operand(d, d.plan.operands[i], factor);
  }
}

/// Moves one corner onto the line through two others, up to `share` of its distance.
void flatten_corners(CaseBuilder& d, const Operand& operand, double share) {
  const std::size_t n = operand.positions.size(), at = d.random.below(n);
  const auto corner = [&](std::size_t k) { return d.vector(operand.positions[(at + k) % n]); };
  const Numbers on_line = between(corner(1), corner(2), 0.125 * d.random.between(-2, 10));
  d.set_vector(operand.positions[at], between(on_line, corner(0), share));
}

void flatten_upright_box(CaseBuilder& d, const Operand& operand, double share) {
  Numbers high = d.vector(operand.positions[1]);
  const Numbers low = d.vector(operand.positions[0]);
  const std::size_t only = d.random.below(4);  // 3: every side
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == only || only == 3) high[k] = low[k] + (high[k] - low[k]) * share;
  }
  d.set_vector(operand.positions[1], high);
}

void flatten_operand(CaseBuilder& d, const Operand& operand, double share) {
  if (operand.shape == Shape::aabox) {
    flatten_upright_box(d, operand, share);
  } else if (operand.positions.size() >= 3) {
    const int corners = d.random.one_in(3) ? 2 : 1;
    for (int i = 0; i < corners; ++i) flatten_corners(d, operand, share);
  } else if (operand.positions.size() == 2 && !d.random.one_in(3)) {
    d.set_vector(operand.positions[1], between(d.vector(operand.positions[0]), d.vector(operand.positions[1]), share));
  }
  for (std::size_t i : operand.sizes) {
    if (d.random.one_in(2)) d.scale(i, share);
  }
}

/// Makes a direction or a rotation parallel to another one, up to `share` of their difference.
void make_parallel(CaseBuilder& d, double share) {
  if (d.plan.directions.size() > 1 && d.random.one_in(2)) {
    const auto [to, from] = d.two_of(d.plan.directions);
    d.set_vector(to, between(d.vector(from), d.vector(to), share));
  }
  if (d.plan.rotations.size() > 1 && d.random.one_in(2)) {
    const std::size_t from = d.plan.rotations[0], to = d.plan.rotations[1];
    for (std::size_t k = 0; k < 4; ++k) d.set(to + k, d[from + k] + (d[to + k] - d[from + k]) * share);
  }
}

void make_thin(CaseBuilder& d) {
  const double share = small_factor(d);
  const std::size_t chosen = d.random.below(d.plan.operands.size());
  for (std::size_t i = 0; i < d.plan.operands.size(); ++i) {
    if (i == chosen || d.random.one_in(2)) flatten_operand(d, d.plan.operands[i], share);
  }
  make_parallel(d, share);
}

/// Rounds positions to a grid, on which collinear corners are exactly collinear.
void round_positions(CaseBuilder& d) {
  const double cell = 0.125 * d.unit;
  for (Role role : {Role::position, Role::size}) {
    for (std::size_t i : d.plan.numbers[std::size_t(role)]) d.set(i, std::nearbyint(d[i] / cell) * cell);
  }
}

/// Moves the centers of two operands, or a corner of one and the center of the other, to the same point.
void make_concentric(CaseBuilder& d) {
  if (d.plan.operands.size() < 2) return;
  const Numbers at = d.vector(d.random.pick(d.plan.operands[0].positions));
  const Operand& other = d.plan.operands[1];
  const Numbers from = d.vector(d.random.pick(other.positions));
  for (std::size_t v : other.positions) {
    Numbers x = d.vector(v);
    for (std::size_t k = 0; k < 3; ++k) x[k] += at[k] - from[k];
    d.set_vector(v, x);
  }
}

void make_degenerate(CaseBuilder& d) {
  if (d.random.one_in(2)) round_positions(d);
  const std::size_t chosen = d.random.below(d.plan.operands.size());
  for (std::size_t i = 0; i < d.plan.operands.size(); ++i) {
    const Operand& operand = d.plan.operands[i];
    if (i != chosen && !d.random.one_in(3)) continue;
    if (d.random.one_in(4))
      shrink_operand(d, operand, 0);
    else if (operand.positions.size() >= 3 && d.random.one_in(2))
      d.set_vector(operand.positions[0], d.vector(operand.positions[d.random.between(1, 2)]));
    else
      flatten_operand(d, operand, 0);
  }
  make_parallel(d, 0);
  if (d.random.one_in(4)) make_concentric(d);
  if (!d.plan.velocities.empty() && d.random.one_in(8)) d.set_vector(d.plan.velocities[0], {0, 0, 0});
}

void make_far_out(CaseBuilder& d) {
  Numbers offset;
  for (double& x : offset) x = d.random.uniform(-1, 1) * d.random.power_of_two(3, d.orders(8, 30));
  for (std::size_t v : d.plan.positions) {
    const Numbers x = d.vector(v);
    d.set_vector(v, {x[0] + offset[0], x[1] + offset[1], x[2] + offset[2]});
  }
  // Planes keep their place in the scene.
  for (std::size_t i : d.plan.numbers[std::size_t(Role::offset)]) {
    d.set(i, d[i] - (d[i - 3] * offset[0] + d[i - 2] * offset[1] + d[i - 1] * offset[2]));
  }
}

/// Scales by powers of two: lengths and velocities together or separately, sometimes also a direction and a rotation.
void make_scaled(CaseBuilder& d, int low, int high) {
  const int of_lengths = d.random.between(low, high);
  const int of_velocities = d.random.one_in(2) ? of_lengths : d.random.one_in(2) ? 0 : d.random.between(low, high);
  const int of_directions = d.random.one_in(4) ? d.random.between(low, high) / 2 : 0;
  const int of_rotations = d.random.one_in(4) ? d.random.between(low, high) : 0;
  const auto scale = [&](Role role, int exponent) {
    for (std::size_t i : d.plan.numbers[std::size_t(role)]) d.set(i, std::ldexp(d[i], exponent));
  };
  scale(Role::position, of_lengths);
  scale(Role::size, of_lengths);
  scale(Role::velocity, of_velocities);
  scale(Role::direction, of_directions);
  scale(Role::offset, of_directions + of_lengths);
  scale(Role::rotation, of_rotations);
  scale(Role::time, of_lengths - of_velocities);
}

void apply(CaseBuilder& d, Family family) {
  switch (family) {
    case Family::scene: return;
    case Family::tiny: return make_tiny(d);
    case Family::thin: return make_thin(d);
    case Family::degenerate: return make_degenerate(d);
    case Family::far_out: return make_far_out(d);
    case Family::huge: return make_scaled(d, d.orders(60, 500), d.orders(122, 1018));
    case Family::minute: return make_scaled(d, -d.orders(140, 1060), -d.orders(60, 500));
  }
}

const Plan& plan_of(const Query& query) {
  static thread_local std::deque<Plan> plans;
  for (const Plan& p : plans) {
    if (p.query == &query) return p;
  }
  return plans.emplace_back(query);
}

}  // namespace

std::string_view name_of(Family family) {
  switch (family) {
    case Family::scene: return "scene";
    case Family::tiny: return "tiny";
    case Family::thin: return "thin";
    case Family::degenerate: return "degenerate";
    case Family::far_out: return "far out";
    case Family::huge: return "huge";
    case Family::minute: return "minute";
  }
  return "?";
}

Case case_of(Family family, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index) {
  const Plan& plan = plan_of(query);
  Random random(
      Random(Random(seed).bits() ^ plan.name_hash ^ std::uint64_t(scalar) ^ std::uint64_t(family) << 8).bits() ^
      Random(index).bits());
  Case c{&query, scalar, query.zeros(), "family", seed, index, {}};
  constexpr int attempts = 1000;
  for (int i = 0; i < attempts; ++i) {
    CaseBuilder builder(plan, scalar, random, c.values);
    draw_scene(builder);
    apply(builder, family);
    builder.repair();
    const bool finite = std::all_of(c.values.begin(), c.values.end(), [](double x) { return std::isfinite(x); });
    if (finite && !query.broken(c.values)) return c;
  }
  throw std::logic_error("families: no valid case of " + std::string(query.name) + " in 1000 attempts");
}

}  // namespace nearmiss
