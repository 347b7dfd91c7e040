#include <algorithm>
#include <cmath>

#include "corpus/generator/constructions.hpp"

namespace nearmiss {

namespace {

/// One operand of the scene: its position and approximate extent.
struct Placed {
  Numbers center{};
  double reach = 0;
};

double draw_sizes(CaseBuilder& d, const Operand& operand) {
  if (operand.sizes.empty()) return operand.positions.size() > 1 ? d.unit : 0.0;
  double sum = 0;
  for (std::size_t i : operand.sizes) {
    d.set(i, d.unit * d.random.uniform(0.25, 2));
    sum += d[i];
  }
  return sum / double(operand.sizes.size());
}

/// A vector of about unit length.
Numbers draw_direction(CaseBuilder& d) {
  Numbers x = d.random_vector(1);
  const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  if (length < 0.125) return {0, 0, 1};
  for (double& component : x) component /= length;
  return x;
}

using Corners = std::array<Numbers, 4>;

Corners parallelogram(const Numbers& corner, const Numbers& side, const Numbers& other) {
  return {corner, plus(corner, side), plus(plus(corner, side), other), plus(corner, other)};
}

/// The spacing of the scalar's numbers at the largest coordinate.
double spacing_at(const CaseBuilder& d, const Corners& corners) {
  double largest = d.unit / 2;
  for (const Numbers& c : corners) largest = std::max({largest, std::abs(c[0]), std::abs(c[1]), std::abs(c[2])});
  return std::ldexp(1.0, std::ilogb(largest) - d.orders(23, 52));
}

/// A tilted rectangle around the place, as exact as the scalar allows: a corner and two sides are rounded to the
/// spacing of the largest coordinate, so that their sums are exact.
void put_rectangle(CaseBuilder& d, const Operand& operand, const Placed& at) {
  const Numbers u = draw_direction(d), any = draw_direction(d);
  Numbers v{u[1] * any[2] - u[2] * any[1], u[2] * any[0] - u[0] * any[2], u[0] * any[1] - u[1] * any[0]};
  if (v == Numbers{}) v = {-u[2], 0, u[0]};
  const double length = d.unit * d.random.uniform(0.5, 3), width = d.unit * d.random.uniform(0.5, 3);
  Numbers corner = plus(plus(at.center, u, -length / 2), v, -width / 2), side = plus({}, u, length),
          other = plus({}, v, width);
  const double step = spacing_at(d, parallelogram(corner, side, other));
  for (Numbers* part : {&corner, &side, &other}) {
    for (double& x : *part) x = std::nearbyint(x / step) * step;
  }
  const Corners corners = parallelogram(corner, side, other);
  for (std::size_t i = 0; i < 4; ++i) d.set_vector(operand.positions[i], corners[i]);
}

void put(CaseBuilder& d, const Operand& operand, const Placed& at) {
  const bool single = operand.positions.size() == 1;
  if (operand.shape == Shape::rectangle && d.random.one_in(2)) return put_rectangle(d, operand, at);
  for (std::size_t v : operand.positions) {
    d.set_vector(v, single ? at.center : plus(at.center, d.random_vector(1.5 * d.unit)));
  }
}

/// A position of the operand, or a point between its positions.
Numbers point_of(CaseBuilder& d, const Operand& operand) {
  Numbers sum{};
  double weights = 0;
  for (std::size_t v : operand.positions) {
    const double w = d.random.uniform(0.01, 1);
    sum = plus(sum, d.vector(v), w);
    weights += w;
  }
  for (double& x : sum) x /= weights;
  return sum;
}

/// Two flat operands, which meet where an edge of one passes through the other.
bool are_flat(const std::vector<Operand>& operands) {
  const auto is_flat = [](const Operand& o) { return o.sizes.empty() && !o.traits().edges.empty(); };
  return operands.size() == 2 && is_flat(operands[0]) && is_flat(operands[1]);
}

/// Moves the second operand so that a point of it is a point of the first one, but for rounding.
void let_meet(CaseBuilder& d) {
  const Operand& moved = d.plan.operands[1];
  const Numbers from = point_of(d, moved), to = point_of(d, d.plan.operands[0]);
  const Numbers way = plus(to, from, -1);
  for (std::size_t v : moved.positions) d.set_vector(v, plus(d.vector(v), way));
}

/// Places the first operand near the origin, the others at distances comparable with the extents of both.
std::vector<Placed>& place_operands(CaseBuilder& d) {
  static thread_local std::vector<Placed> placed;
  placed.clear();
  // Operands without a size hardly ever meet by chance.
  const bool chance = d.plan.sizes.empty() && decides(d.plan.query->kind);
  const double furthest = !d.plan.velocities.empty() ? 4 : chance ? 1 : 2;
  for (const Operand& operand : d.plan.operands) {
    Placed p{{}, draw_sizes(d, operand)};
    if (placed.empty()) {
      p.center = d.random_vector(4 * d.unit);
    } else {
      const Placed& first = placed.front();
      const double together = first.reach + p.reach > 0 ? first.reach + p.reach : d.unit;
      const Numbers towards = draw_direction(d);
      p.center = plus(first.center, towards, together * d.random.uniform(0, furthest));
    }
    put(d, operand, p);
    placed.push_back(p);
  }
  if (chance && are_flat(d.plan.operands) && d.random.one_in(3)) let_meet(d);
  return placed;
}

/// Two operands at rest of which one has an axis: they touch hardly ever by chance.
bool may_touch_at_rest(const Plan& plan) {
  const auto has_axis = [](const Operand& o) { return o.traits().edges.size() == 1; };
  return plan.query->kind == Kind::decision && plan.velocities.empty() && plan.operands.size() == 2 &&
         std::any_of(plan.operands.begin(), plan.operands.end(), has_axis);
}

void aim(CaseBuilder& d, std::size_t velocity, const std::vector<Placed>& placed) {
  if (placed.size() < 2 || d.random.one_in(8)) return d.set_vector(velocity, d.random_vector(2 * d.unit));
  const std::size_t target = 1 + d.random.below(placed.size() - 1);
  const Operand& aimed = d.plan.operands[target];
  const double wide = aimed.positions.size() == 1 || aimed.radius ? 1.5 : 0.25;
  const double around = wide * (placed[0].reach + placed[target].reach);
  const Numbers target_point = point_of(d, aimed);
  const Numbers to = plus(target_point, d.random_vector(around));
  Numbers along = plus(to, placed[0].center, -1);
  const double per_time = d.random.uniform(0.25, 2);
  for (double& x : along) x *= per_time;
  d.set_vector(velocity, along);
}

void draw_rotation(CaseBuilder& d, std::size_t begin) {
  std::array<double, 4> q;
  double length2 = 0;
  for (double& x : q) {
    x = d.random.uniform(-1, 1);
    length2 += x * x;
  }
  const double scale = d.random.one_in(4) ? 1 : 1 / std::sqrt(length2);
  for (std::size_t k = 0; k < 4; ++k) d.set(begin + k, q[k] * scale);
}

double draw_index(CaseBuilder& d) {
  if (d.random.one_in(4)) return -1;
  const std::size_t choices = d.random.one_in(3) ? 3 : 15;
  return double(d.random.below(choices));
}

/// For a plane, whose normal is the three numbers before: the plane passes near a position of the scene.
double draw_offset(CaseBuilder& d, std::size_t i) {
  Numbers near = d.random_vector(3 * d.unit);
  if (!d.plan.positions.empty()) near = plus(near, d.vector(d.random.pick(d.plan.positions)));
  return -(d[i - 3] * near[0] + d[i - 2] * near[1] + d[i - 1] * near[2]);
}

/// A half-space is large: chance puts most bodies into it. Most of those that move start in front.
void start_in_front(CaseBuilder& d) {
  const Operand* halfspace = d.plan.query->operands.find(Shape::halfspace);
  if (halfspace == nullptr || d.plan.velocities.empty() || d.random.one_in(4)) return;
  const std::size_t normal = *halfspace->direction, offset = *halfspace->offset;
  const Numbers n = d.vector(normal), at = d.vector(d.plan.operands.front().positions[0]);
  if (n[0] * at[0] + n[1] * at[1] + n[2] * at[2] + d[offset] >= 0) return;
  d.set_vector(normal, plus({}, n, -1));
  d.set(offset, -d[offset]);
}

double draw_lone(CaseBuilder& d, std::size_t i) {
  switch (d.plan.fields[i].role) {
    case Role::flag: return double(d.random.below(2));
    case Role::index: return draw_index(d);
    case Role::time: return d.random.uniform(0, 2);
    case Role::offset: return draw_offset(d, i);
    case Role::weight: return d.random.one_in(4) ? 0.0 : d.random.uniform(0, 1) * d.random.power_of_two(-50, 0);
    default: return d.unit * d.random.uniform(-4, 4);
  }
}

}  // namespace

void draw_scene(CaseBuilder& d) {
  d.unit = d.random.one_in(4) ? d.random.power_of_two(-4, 4) : 1.0;
  const std::vector<Placed>& placed = place_operands(d);
  for (std::size_t v : d.plan.velocities) aim(d, v, placed);
  for (std::size_t v : d.plan.directions) d.set_vector(v, d.random.one_in(2) ? draw_direction(d) : d.random_vector(2));
  for (std::size_t begin : d.plan.rotations) draw_rotation(d, begin);
  for (std::size_t i : d.plan.lone) d.set(i, draw_lone(d, i));
  start_in_front(d);
  if (may_touch_at_rest(d.plan) && d.random.one_in(16)) touch_at_rest(d);
  d.repair();
}

}  // namespace nearmiss
