#include <algorithm>
#include <cmath>

#include "corpus/generator/constructions.hpp"
#include "corpus/generator/features.hpp"

namespace nearmiss {

double tiny(CaseBuilder& d, int least, int most) {
  double x = d.random.sign();
  for (int i = d.random.between(least, most); i > 0; --i) x /= 10;
  return x;
}

namespace {

Numbers difference(const Numbers& a, const Numbers& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// Scenes.

/// Rounds every number to a multiple of `step` units, then sets the unit to `unit`.
void to_grid(CaseBuilder& d, double step, double unit) {
  const auto onto = [&](std::size_t i, double cell, double out) { d.set(i, std::nearbyint(d[i] / cell) * out); };
  for (Role role : {Role::position, Role::velocity, Role::size}) {
    for (std::size_t i : d.plan.numbers[std::size_t(role)]) onto(i, step * d.unit, step * unit);
  }
  for (Role role : {Role::direction, Role::time}) {
    for (std::size_t i : d.plan.numbers[std::size_t(role)]) onto(i, step, step);
  }
  d.unit = unit;
  d.repair();
}

bool small_lattice(CaseBuilder& d) {
  to_grid(d, 0.5, 2);
  for (std::size_t begin : d.plan.rotations) {
    for (std::size_t k = 0; k < 4; ++k) d.set(begin + k, std::nearbyint(2 * d[begin + k]));
  }
  d.repair();
  return true;
}

bool dyadic_grid(CaseBuilder& d) {
  to_grid(d, d.random.power_of_two(-6, -2), d.unit);
  return true;
}

// Vectors and their components.

bool equal_vectors(CaseBuilder& d) {
  if (d.plan.positions.size() < 2) return false;
  const auto [to, from] = d.two_of(d.plan.positions);
  d.set_vector(to, d.vector(from));
  return true;
}

bool shared_coordinate(CaseBuilder& d) {
  if (d.plan.positions.size() < 2) return false;
  const auto [to, from] = d.two_of(d.plan.positions);
  const std::size_t k = d.random.below(3);
  d.set(to + k, d.vector(from)[k]);
  return true;
}

bool zero_component(CaseBuilder& d) {
  if (d.plan.movable.empty()) return false;
  const std::size_t begin = d.random.pick(d.plan.movable);
  d.set(begin + d.random.below(3), 0);
  d.repair();
  return true;
}

/// On the segment or in the plane of other positions; exactly so if no rounding occurs.
bool between_positions(CaseBuilder& d) {
  const auto& list = d.plan.positions;
  if (list.size() < 3) return false;
  const auto [to, from] = d.two_of(list);
  Numbers at = d.vector(from);
  for (int i = d.random.between(1, 2); i > 0; --i) {
    const Numbers along = difference(d.vector(d.random.pick(list)), d.vector(from));
    const double weight = 0.125 * d.random.between(-2, 8);
    for (std::size_t k = 0; k < 3; ++k) at[k] += weight * along[k];
  }
  d.set_vector(to, at);
  return true;
}

/// Three nearly collinear corners.
bool sliver(CaseBuilder& d) {
  for (const Operand& operand : d.plan.operands) {
    if (operand.positions.size() < 3) continue;
    const std::size_t at = d.random.below(3);
    const Numbers a = d.vector(operand.positions[(at + 1) % 3]), b = d.vector(operand.positions[(at + 2) % 3]);
    const double weight = 0.125 * d.random.between(-2, 10), off = tiny(d, 1) * d.unit;
    Numbers corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = a[k] + weight * (b[k] - a[k]) + off * d.random.uniform(-1, 1);
    d.set_vector(operand.positions[at], corner);
    return true;
  }
  return false;
}

// Operands.

/// Two operands of the same type become the same set.
bool coincident_things(CaseBuilder& d) {
  const auto& operands = d.plan.operands;
  for (std::size_t i = 0; i + 1 < operands.size(); ++i) {
    const Operand &a = operands[i], &b = operands[i + 1];
    if (a.positions.size() != b.positions.size() || a.sizes.size() != b.sizes.size() || a.sizes.empty()) continue;
    for (std::size_t k = 0; k < a.positions.size(); ++k) d.set_vector(b.positions[k], d.vector(a.positions[k]));
    for (std::size_t k = 0; k < a.sizes.size(); ++k) d.set(b.sizes[k], d[a.sizes[k]]);
    if (d.plan.rotations.size() == 2 && d.random.one_in(2)) {
      for (std::size_t k = 0; k < 4; ++k) d.set(d.plan.rotations[1] + k, d[d.plan.rotations[0] + k]);
    }
    return true;
  }
  return false;
}

/// One operand deep inside another one that has a size.
bool contained(CaseBuilder& d) {
  const auto& operands = d.plan.operands;
  if (operands.size() < 2 || d.random.one_in(2)) return false;  // half as often, because nearly all of them are hits
  const std::size_t outer = d.random.below(operands.size());
  const Operand &around = operands[outer], &small = operands[outer == 0 ? 1 : 0];
  if (around.sizes.empty()) return false;
  double least = HUGE_VAL;
  for (std::size_t i : around.sizes) least = std::min(least, d[i]);
  const Numbers center = d.vector(d.random.pick(around.positions));
  for (std::size_t v : small.positions) {
    Numbers at = d.random_vector(0.25 * least);
    for (std::size_t k = 0; k < 3; ++k) at[k] += center[k];
    d.set_vector(v, at);
  }
  for (std::size_t i : small.sizes) d.set(i, 0.25 * least * d.random.uniform(0, 1));
  return true;
}

// Sizes.

bool zero_size(CaseBuilder& d) {
  if (d.plan.sizes.empty()) return false;
  d.set(d.random.pick(d.plan.sizes), 0);
  return true;
}

bool all_sizes_zero(CaseBuilder& d) {
  if (d.plan.operands.empty()) return false;
  const Operand& operand = d.random.pick(d.plan.operands);
  for (std::size_t i : operand.sizes) d.set(i, 0);
  return !operand.sizes.empty();
}

bool equal_sizes(CaseBuilder& d) {
  if (d.plan.sizes.size() < 2) return false;
  const auto [to, from] = d.two_of(d.plan.sizes);
  d.set(to, d[from]);
  return true;
}

bool size_ratio(CaseBuilder& d) {
  if (d.plan.sizes.empty()) return false;
  const int orders = d.random.between(1, d.orders(12, 40));  // 40: 1e12
  const double factor = std::ldexp(1.0, d.random.one_in(2) ? orders : -orders);
  d.scale(d.random.pick(d.plan.sizes), factor);
  return true;
}

// Velocities and directions.

bool zero_velocity(CaseBuilder& d) {
  if (d.plan.velocities.empty()) return false;
  d.set_vector(d.random.pick(d.plan.velocities), {0, 0, 0});
  return true;
}

bool axis_velocity(CaseBuilder& d) {
  if (d.plan.velocities.empty()) return false;
  const std::size_t v = d.random.pick(d.plan.velocities);
  const std::size_t k = d.random.below(3);
  Numbers along{};
  along[k] = d.vector(v)[k] == 0 ? d.random.sign() : d.vector(v)[k];
  d.set_vector(v, along);
  return true;
}

bool scaled_velocity(CaseBuilder& d) {
  if (d.plan.velocities.empty()) return false;
  const double factor = d.random.power_of_two(-d.orders(8, 30), d.orders(8, 30));
  const std::size_t begin = d.random.pick(d.plan.velocities);
  for (std::size_t k = 0; k < 3; ++k) d.scale(begin + k, factor);
  return true;
}

bool aimed_at_position(CaseBuilder& d) {
  if (d.plan.velocities.empty() || d.plan.positions.size() < 2) return false;
  const auto& list = d.plan.positions;
  Numbers along = difference(d.vector(list[1 + d.random.below(list.size() - 1)]), d.vector(list[0]));
  const double factor = d.random.power_of_two(-2, 1);
  for (double& x : along) x *= factor;
  d.set_vector(d.random.pick(d.plan.velocities), along);
  return true;
}

/// Motion straight at a corner of an axis-aligned box, or at a point of its edge.
bool aimed_at_corner(CaseBuilder& d) {
  if (d.plan.velocities.empty()) return false;
  const Operand* box = nullptr;
  for (const Operand& t : d.plan.operands) {
    if (t.half) box = &t;
  }
  if (box == nullptr || d.plan.positions.empty()) return false;
  for (std::size_t begin : d.plan.rotations) {
    for (std::size_t k = 0; k < 4; ++k) d.set(begin + k, k == 3 ? 1 : 0);
  }
  const Numbers from = d.vector(d.plan.positions.front());
  Numbers corner = d.vector(box->positions.front());
  const std::size_t along = d.random.below(6);  // 3 to 5: the corner itself
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] += (k == along ? 0.125 * d.random.between(-7, 7) : d.random.sign()) * d[box->sizes[k]];
  }
  const double factor = d.random.power_of_two(-2, 1);
  d.set_vector(d.random.pick(d.plan.velocities),
               {factor * (corner[0] - from[0]), factor * (corner[1] - from[1]), factor * (corner[2] - from[2])});
  return true;
}

/// Along an edge or across a face of an operand. False if the operand has neither.
bool some_direction_of_a_feature(CaseBuilder& d, Numbers& out) {
  if (d.plan.bodies.empty()) return false;
  const Features f = features_of(d, d.random.pick(d.plan.bodies));
  const std::size_t edges = f.edges.size(), all = edges + f.normals.size();
  if (all == 0) return false;
  const std::size_t i = d.random.below(all);
  out = i < edges ? f.edges[i].along : f.normals[i - edges];
  return true;
}

/// A vector that serves as a direction: another velocity or direction, the difference of two positions, or a direction
/// of a feature.
bool some_direction(CaseBuilder& d, std::size_t but, Numbers& out) {
  if (d.random.one_in(3)) return some_direction_of_a_feature(d, out);
  const auto& list = d.plan.movable;
  const std::size_t v = list[d.random.below(list.size())];
  if (d.plan.fields[v].role != Role::position) {
    out = d.vector(v);
    return v != but;
  }
  if (d.plan.positions.size() < 2) return false;
  const auto [a, b] = d.two_of(d.plan.positions);
  out = difference(d.vector(a), d.vector(b));
  return true;
}

/// Picks a velocity or direction and passes it to `make` together with another direction.
template <class Make>
bool direct(CaseBuilder& d, Make make) {
  const std::size_t velocities = d.plan.velocities.size(), all = velocities + d.plan.directions.size();
  if (all == 0) return false;
  const std::size_t k = d.random.below(all);
  const std::size_t to = k < velocities ? d.plan.velocities[k] : d.plan.directions[k - velocities];
  Numbers from;
  if (!some_direction(d, to, from)) return false;
  d.set_vector(to, make(from));
  d.repair();
  return true;
}

Numbers scaled(const Numbers& x, double factor) { return {factor * x[0], factor * x[1], factor * x[2]}; }

bool parallel(CaseBuilder& d) {
  return direct(d, [&](const Numbers& x) { return scaled(x, d.random.power_of_two(-2, 2)); });
}
bool antiparallel(CaseBuilder& d) {
  return direct(d, [&](const Numbers& x) { return scaled(x, -d.random.power_of_two(-2, 2)); });
}
/// Parallel or antiparallel up to 1e-16 ... 1e-2 radians.
bool near_parallel(CaseBuilder& d) {
  return direct(d, [&](const Numbers& x) {
    Numbers along = scaled(x, d.random.sign() * d.random.power_of_two(-2, 2));
    const double angle = tiny(d), length = std::max({std::abs(along[0]), std::abs(along[1]), std::abs(along[2])});
    for (double& component : along) component += angle * length * d.random.uniform(-1, 1);
    return along;
  });
}
bool orthogonal(CaseBuilder& d) {
  return direct(d, [&](const Numbers& x) {
    const std::size_t i = d.random.below(3), j = (i + 1) % 3;
    Numbers turned{};
    turned[i] = -x[j];
    turned[j] = x[i];
    return turned;
  });
}

// Rotations.

bool axis_rotation(CaseBuilder& d) {
  if (d.plan.rotations.empty()) return false;
  const std::size_t begin = d.random.pick(d.plan.rotations);
  const std::size_t first = d.random.one_in(2) ? 3 : d.random.below(4);
  const std::size_t second = d.random.below(4);
  const double length = d.random.one_in(4) ? d.random.power_of_two(-2, 2) : 1.0;
  for (std::size_t k = 0; k < 4; ++k) d.set(begin + k, 0);
  d.set(begin + first, length);
  if (d.random.one_in(2)) d.set(begin + second, d.random.sign() * length);
  return true;
}

/// A rotation by an angle with rational sine and cosine, such as 3/5 and 4/5, and lengths that stay integers in the
/// rotated frame.
bool pythagorean_rotation(CaseBuilder& d) {
  if (d.plan.rotations.empty()) return false;
  constexpr int halves[][2] = {{1, 2}, {1, 3}, {2, 3}, {1, 4}, {3, 4}};  // tangents of half the angle
  const auto& [n, m] = halves[d.random.below(std::size(halves))];
  const std::size_t begin = d.random.pick(d.plan.rotations), axis = d.random.below(3);
  for (std::size_t k = 0; k < 4; ++k) d.set(begin + k, k == 3 ? m : k == axis ? n * d.random.sign() : 0.0);
  for (Role role : {Role::position, Role::size}) {
    for (std::size_t i : d.plan.numbers[std::size_t(role)]) d.scale(i, n * n + m * m);
  }
  return true;
}

/// A right angle as programs usually compute it: from the rounded sine and cosine of half of it.
bool rounded_right_angle(CaseBuilder& d) {
  if (d.plan.rotations.empty()) return false;
  const std::size_t begin = d.random.pick(d.plan.rotations), axis = d.random.below(3);
  constexpr double pi = 3.14159265358979323846;
  const double half = d.random.sign() * d.random.between(1, 3) * pi / 4;
  for (std::size_t k = 0; k < 4; ++k) d.set(begin + k, k == 3 ? std::cos(half) : k == axis ? std::sin(half) : 0.0);
  d.repair();
  return true;
}

bool identity_rotation(CaseBuilder& d) {
  for (std::size_t begin : d.plan.rotations) {
    for (std::size_t k = 0; k < 4; ++k) d.set(begin + k, k == 3 ? 1 : 0);
  }
  return !d.plan.rotations.empty();
}

bool scaled_rotation(CaseBuilder& d) {
  if (d.plan.rotations.empty()) return false;
  const std::size_t begin = d.random.pick(d.plan.rotations);
  const double factor = d.random.one_in(2) ? d.random.power_of_two(-4, 4) : d.random.uniform(0.25, 4);
  for (std::size_t k = 0; k < 4; ++k) d.scale(begin + k, factor);
  d.repair();
  return true;
}

bool near_axis_rotation(CaseBuilder& d) {
  if (!axis_rotation(d)) return false;
  for (std::size_t begin : d.plan.rotations) {
    const std::size_t k = begin + d.random.below(4);
    d.set(k, d[k] + tiny(d, 3));
  }
  d.repair();
  return true;
}

bool equal_rotations(CaseBuilder& d) {
  if (d.plan.rotations.size() < 2) return false;
  const auto [to, from] = d.two_of(d.plan.rotations);
  const double sign = d.random.sign();
  const double factor = d.random.one_in(2) ? 1.0 : sign * d.random.power_of_two(-2, 2);
  for (std::size_t k = 0; k < 4; ++k) d.set(to + k, factor * d[from + k]);
  return true;
}

bool near_equal_rotations(CaseBuilder& d) {
  if (!equal_rotations(d)) return false;
  const std::size_t begin = d.random.pick(d.plan.rotations);
  const std::size_t k = begin + d.random.below(4);
  d.set(k, d[k] + tiny(d, 3));
  d.repair();
  return true;
}

// Touches.

/// Two operands with positions, one of them with a size.
bool touching_pair(CaseBuilder& d, const Operand*& a, const Operand*& b) {
  const auto& operands = d.plan.operands;
  if (operands.size() < 2) return false;
  const std::size_t first = d.random.below(operands.size());
  a = &operands[first];
  b = &operands[(first + 1 + d.random.below(operands.size() - 1)) % operands.size()];
  if (a->sizes.empty()) std::swap(a, b);
  return !a->sizes.empty();
}

/// The extent of the operand along axis k, for a sphere or an unrotated box.
double reach_along(const CaseBuilder& d, const Operand& operand, std::size_t k) {
  if (operand.sizes.empty()) return 0;
  return d[operand.half ? *operand.half + k : operand.sizes[0]];
}

bool touch_by_size(CaseBuilder& d) {
  const Operand *a = nullptr, *b = nullptr;
  if (!touching_pair(d, a, b)) return false;
  const std::size_t k = d.random.below(3);
  const double from = d.vector(d.random.pick(a->positions))[k];
  const double apart = std::abs(from - d.vector(d.random.pick(b->positions))[k]);
  const double rest = apart - reach_along(d, *b, k);
  const std::size_t size = a->half ? *a->half + k : a->sizes[d.random.below(a->sizes.size())];
  d.set(size, rest > 0 ? rest : apart);
  return true;
}

bool touch_by_position(CaseBuilder& d) {
  const Operand *a = nullptr, *b = nullptr;
  if (!touching_pair(d, a, b)) return false;
  const std::size_t k = d.random.below(3);
  const Numbers from = d.vector(d.random.pick(b->positions));
  Numbers at = d.vector(a->positions.front());
  if (d.random.one_in(2)) at = from;
  at[k] = from[k] + d.random.sign() * (reach_along(d, *a, k) + reach_along(d, *b, k));
  d.set_vector(a->positions.front(), at);
  return true;
}

/// A sphere or capsule touches an edge or a vertex of another operand, or another sphere or capsule, off every axis and
/// yet exactly: its radius is the integer diagonal of a box with integer sides. A box is unrotated.
bool touch_at_edge_or_vertex(CaseBuilder& d) {
  const auto& operands = d.plan.operands;
  if (operands.size() < 2) return false;
  const std::size_t first = d.random.below(operands.size());
  const Operand& round = operands[first];
  const Operand& other = operands[(first + 1 + d.random.below(operands.size() - 1)) % operands.size()];
  if (!round.radius) return false;
  const auto& sides = whole_diagonals[d.random.below(std::size(whole_diagonals))];
  const std::size_t turn = d.random.below(3);
  const double step = d.unit * d.random.power_of_two(-6, -2);
  Numbers at = d.vector(d.random.pick(other.positions));
  double reach = sides[3] * step;
  const bool box = other.half.has_value();
  if (box) identity_rotation(d);
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = d.random.sign(), apart = sides[(k + turn) % 3] * step;
    // Along an axis in which the diagonal does not leave the box, the point may be anywhere on the edge.
    const double corner = !box        ? 0.0
                          : apart > 0 ? d[other.sizes[k]]
                                      : 0.125 * d.random.between(-8, 8) * d[other.sizes[k]];
    at[k] += side * (corner + apart);
  }
  if (!box && other.radius) {  // two spheres or capsules share the distance
    const double theirs = 0.125 * d.random.between(0, 8) * reach;
    d.set(other.sizes[0], theirs);
    reach -= theirs;
  }
  d.set_vector(d.random.pick(round.positions), at);
  d.set(round.sizes[0], reach);
  return true;
}

/// Two unrotated boxes with integer half diagonals, whose centers are the sum of both apart.
bool touch_by_diagonals(CaseBuilder& d) {
  std::vector<const Operand*> boxes;
  for (const Operand& t : d.plan.operands) {
    if (t.half) boxes.push_back(&t);
  }
  if (boxes.size() < 2) return false;
  const auto& sides = whole_diagonals[d.random.below(std::size(whole_diagonals))];
  const double step = d.unit * d.random.power_of_two(-5, -2);
  const std::array<int, 2> times{d.random.between(1, 4), d.random.between(1, 4)};
  for (std::size_t n = 0; n < 2; ++n) {
    const std::size_t turn = d.random.below(3);
    for (std::size_t k = 0; k < 3; ++k) d.set(boxes[n]->sizes[k], times[n] * step * sides[(k + turn) % 3]);
  }
  Numbers at = d.vector(boxes[0]->positions.front());
  for (std::size_t k = 0; k < 3; ++k) at[k] += d.random.sign() * (times[0] + times[1]) * step * sides[k];
  d.set_vector(boxes[1]->positions.front(), at);
  return true;
}

/// An operand with several positions becomes symmetric about a plane through another operand, perpendicular to an axis.
/// A shape that stays in that plane is equally near to both halves.
bool mirrored(CaseBuilder& d) {
  const auto& operands = d.plan.operands;
  if (operands.size() < 2) return false;
  const std::size_t first = d.random.below(operands.size());
  const Operand& shape = operands[first];
  const Operand& seen = operands[(first + 1 + d.random.below(operands.size() - 1)) % operands.size()];
  const std::size_t count = shape.positions.size(), k = d.random.below(3);
  if (count < 2) return false;
  const double plane = d.vector(seen.positions.front())[k];
  const auto at = [&](std::size_t i) { return shape.positions[i % count]; };
  const std::size_t start = d.random.below(count);
  const auto mirror = [&](std::size_t from, std::size_t to) {
    Numbers x = d.vector(at(start + from));
    x[k] = plane - (x[k] - plane);
    d.set_vector(at(start + to), x);
  };
  if (count == 3) d.set(at(start) + k, plane);
  if (count == 2) mirror(0, 1);
  if (count == 3) mirror(1, 2);
  if (count == 4) {
    const bool folded = d.random.one_in(2);  // along its diagonal from the first corner
    if (folded) {
      for (std::size_t i : {0, 2}) d.set(shape.positions[i] + k, plane);
      Numbers x = d.vector(shape.positions[1]);
      x[k] = plane - (x[k] - plane);
      d.set_vector(shape.positions[3], x);
    } else {
      mirror(1, 2);
      mirror(0, 3);
    }
  }
  for (std::size_t v : d.plan.velocities) d.set(v + k, 0);
  return true;
}

/// A plane perpendicular to an axis touches an operand from either side. A box that it touches is unrotated.
bool touch_by_plane(CaseBuilder& d) {
  const auto& offsets = d.plan.numbers[std::size_t(Role::offset)];
  if (offsets.empty() || d.plan.operands.empty()) return false;
  const std::size_t at = d.random.pick(offsets), k = d.random.below(3);  // its normal is the three numbers before
  const Operand& operand = d.random.pick(d.plan.operands);
  if (operand.half) identity_rotation(d);
  const double length = d.random.power_of_two(-1, 1), side = d.random.sign(), over = d.random.sign();
  for (std::size_t i = 0; i < 3; ++i) d.set(at - 3 + i, i == k ? side * length : 0.0);
  const double reached = d.vector(d.random.pick(operand.positions))[k] + over * reach_along(d, operand, k);
  d.set(at, -side * length * reached);
  return true;
}

/// The first operand touches another one along an axis. `make` sets its motion from the axis and the side on which it
/// lies.
template <class Make>
bool touch_and_move(CaseBuilder& d, Make make) {
  const auto& operands = d.plan.operands;
  if (d.plan.velocities.empty() || operands.size() < 2) return false;
  const Operand &a = operands[0], &b = operands[1 + d.random.below(operands.size() - 1)];
  const std::size_t k = d.random.below(3);
  const double side = d.random.sign();
  Numbers at = d.vector(d.random.pick(b.positions));
  at[k] += side * (reach_along(d, a, k) + reach_along(d, b, k));
  d.set_vector(a.positions.front(), at);
  Numbers velocity = d.vector(d.plan.velocities.front());
  make(k, side, at, velocity);
  d.set_vector(a.positions.front(), at);
  d.set_vector(d.plan.velocities.front(), velocity);
  return true;
}

/// Motion along a touching face, from the touch on or from an earlier point.
bool grazing(CaseBuilder& d) {
  return touch_and_move(d, [&](std::size_t k, double, Numbers& at, Numbers& velocity) {
    velocity[k] = 0;
    if (d.random.one_in(2)) return;
    const double before = d.random.between(1, 4);
    for (std::size_t i = 0; i < 3; ++i) at[i] -= before * velocity[i];
  });
}

/// Motion perpendicular to a face, toward or away from it, from the touch on or from an earlier point.
bool head_on(CaseBuilder& d) {
  return touch_and_move(d, [&](std::size_t k, double side, Numbers& at, Numbers& velocity) {
    const double speed = velocity[k] == 0 ? d.unit : std::abs(velocity[k]);
    velocity = {};
    velocity[k] = d.random.one_in(3) ? side * speed : -side * speed;
    if (!d.random.one_in(3)) at[k] += side * speed * d.random.between(1, 4);
  });
}

// Transforms of all operands.

bool far_offset(CaseBuilder& d) {
  if (d.plan.positions.empty()) return false;
  Numbers offset;
  for (double& x : offset) {
    const double sign = d.random.one_in(3) ? 0.0 : d.random.sign();
    const int times = d.random.between(1, 7);
    x = sign * times * d.random.power_of_two(0, d.orders(12, 48));  // 7 * 2^47: 1e15
  }
  for (std::size_t v : d.plan.positions) {
    const Numbers x = d.vector(v);
    d.set_vector(v, {x[0] + offset[0], x[1] + offset[1], x[2] + offset[2]});
  }
  return true;
}

bool scaled_lengths(CaseBuilder& d) {
  const double factor = d.random.power_of_two(-d.orders(8, 30), d.orders(8, 30));
  for (Role role : {Role::position, Role::velocity, Role::size}) {
    for (std::size_t i : d.plan.numbers[std::size_t(role)]) d.scale(i, factor);
  }
  return true;
}

bool ulp_nudge(CaseBuilder& d) {
  const std::size_t count = d.plan.fields.size();
  bool any = false;
  for (int i = d.random.between(1, 3); i > 0; --i) {
    const std::size_t at = d.random.below(count);
    const Role role = d.plan.fields[at].role;
    if (is_discrete(role) || (d[at] == 0 && d.random.one_in(2))) continue;
    const int ulps = d.random.between(1, 3);
    d.step_ulps(at, d.random.one_in(2) ? ulps : -ulps);
    if (role == Role::size && d[at] < 0) d.set(at, 0);
    any = true;
  }
  return any;
}

/// A number that may have any value: a component of a position, velocity, direction or rotation.
bool some_signed_number(CaseBuilder& d, std::size_t& at) {
  at = d.random.below(d.plan.fields.size());
  const Role role = d.plan.fields[at].role;
  return role == Role::position || role == Role::velocity || role == Role::direction || role == Role::rotation;
}

/// A relative change of 1e-15 ... 1e-3.
bool relative_nudge(CaseBuilder& d) {
  const std::size_t at = d.random.below(d.plan.fields.size());
  const Role role = d.plan.fields[at].role;
  if (is_discrete(role) || d[at] == 0) return false;
  d.scale(at, 1 + tiny(d, 3, 15));
  d.repair();
  return true;
}

bool negative_zero(CaseBuilder& d) {
  bool any = false;
  for (std::size_t i = 0; i < d.plan.fields.size(); ++i) {
    const Role role = d.plan.fields[i].role;
    if (is_discrete(role) || d[i] != 0 || std::signbit(d[i]) || d.random.one_in(3)) continue;
    d.set(i, -0.0);
    any = true;
  }
  return any;
}

bool neighbour_of_one(CaseBuilder& d) {
  std::size_t at;
  if (!some_signed_number(d, at)) return false;
  d.set(at, d.random.sign());
  d.step_ulps(at, d.random.between(-2, 2));
  d.repair();
  return true;
}

/// All lengths at an end of the scalar's range: 2^-149 or 2^-1074 among them, or the largest finite numbers.
bool extreme_scale(CaseBuilder& d) {
  const int lowest = d.orders(-149, -1074), highest = d.orders(127, 1023);
  double largest = 0;
  for (Role role : {Role::position, Role::velocity, Role::size}) {
    for (std::size_t i : d.plan.numbers[std::size_t(role)]) largest = std::max(largest, std::abs(d[i]));
  }
  if (largest == 0 || !std::isfinite(largest)) return false;
  const int now = std::ilogb(largest);
  const int wanted = d.random.one_in(2) ? d.random.between(lowest, lowest / 2) : d.random.between(highest / 2, highest);
  for (Role role : {Role::position, Role::velocity, Role::size}) {
    for (std::size_t i : d.plan.numbers[std::size_t(role)]) d.set(i, std::ldexp(d[i], wanted - now));
  }
  d.repair();
  return true;
}

/// One number at an end of the scalar's range.
bool largest_or_least(CaseBuilder& d) {
  std::size_t at;
  if (!some_signed_number(d, at)) return false;
  const double least = std::ldexp(1.0, d.orders(-149, -1074) + d.random.between(0, 3));
  d.set(at, d.random.sign() * (d.random.one_in(2) ? largest_finite(d.scalar) : least));
  d.repair();
  return true;
}

/// The closed table. Mutators apply in this order: exact constructions come before transforms of the scene, and changes
/// of the last ulps come last.
constexpr Mutator all_mutators[] = {
    {"small-lattice", "every number a small integer", small_lattice},
    {"dyadic-grid", "every number a multiple of a power of two", dyadic_grid},
    {"equal-vectors", "two positions are the same: a duplicate vertex, coincident centers", equal_vectors},
    {"shared-coordinate", "a coordinate copied from another position", shared_coordinate},
    {"zero-component", "one number of a vector is 0", zero_component},
    {"between-positions", "a position on the segment or in the plane of others", between_positions},
    {"sliver", "three corners nearly on a line: 1e-1 ... 1e-16 off it", sliver},
    {"true-rectangle", "four corners of an exact rectangle, upright or tilted", true_rectangle},
    {"coincident-things", "two things are the same set", coincident_things},
    {"contained", "one thing deep inside of another", contained},
    {"zero-size", "one size is 0", zero_size},
    {"all-sizes-zero", "a shape without any size", all_sizes_zero},
    {"equal-sizes", "two sizes are the same", equal_sizes},
    {"size-ratio", "one size tiny or huge", size_ratio},
    {"axis-rotation", "a quaternion of a right angle or a half turn", axis_rotation},
    {"pythagorean-rotation", "a turn with rational sine and cosine", pythagorean_rotation},
    {"rounded-right-angle", "a right angle by rounded sines and cosines", rounded_right_angle},
    {"identity-rotation", "no shape is turned", identity_rotation},
    {"near-axis-rotation", "1e-3 ... 1e-16 from a right angle", near_axis_rotation},
    {"equal-rotations", "two shapes turned alike", equal_rotations},
    {"near-equal-rotations", "two shapes turned alike but for 1e-3 ... 1e-16", near_equal_rotations},
    {"scaled-rotation", "a quaternion whose length is not 1", scaled_rotation},
    {"touch-by-size", "a size equal to a coordinate's distance: upright shapes touch", touch_by_size},
    {"touch-by-position", "a center as far along one axis as both shapes reach", touch_by_position},
    {"touch-at-edge-or-vertex", "a round thing touches an edge, a vertex or a round thing off every axis",
     touch_at_edge_or_vertex},
    {"touch-by-diagonals", "two boxes as far apart as their half diagonals are long", touch_by_diagonals},
    {"crossed-edges", "two long, thin boxes, apart or not along the cross product of nearly parallel edges alone",
     crossed_edges},
    {"parallel-edges", "edges of two shapes are parallel, or boxes turned alike", parallel_edges, false, true},
    {"nearly-parallel-edges", "the same, 1e-2 ... 1e-16 off", nearly_parallel_edges, false, true},
    {"coplanar-features", "a shape in the plane of another one's face or through its edge; boxes with flush faces",
     coplanar_features, false, true},
    {"crossing-edges", "edges, vertices or centers of two shapes share a point", crossing_edges, false, true},
    {"touching-features", "a vertex, edge or face of one shape just reaches one of another, radii included",
     touching_features, false, true},
    {"mirrored", "a shape its own mirror image in a plane through another: as near to both halves", mirrored},
    {"touch-by-plane", "a plane across an axis that just reaches a shape", touch_by_plane},
    {"zero-velocity", "no motion", zero_velocity},
    {"axis-velocity", "motion along one axis", axis_velocity},
    {"aimed-at-position", "motion straight at a vertex or center", aimed_at_position},
    {"aimed-at-corner", "motion straight at a corner or an edge of an upright box", aimed_at_corner},
    {"parallel", "a velocity or direction along another one, along an edge or across a face", parallel},
    {"antiparallel", "the same, against it", antiparallel},
    {"near-parallel", "the same, 1e-2 ... 1e-16 radians off, either way", near_parallel},
    {"orthogonal", "a velocity or direction at an exact right angle to another one, an edge or a normal", orthogonal},
    {"grazing", "motion along a touching face, from the touch on or before it", grazing},
    {"head-on", "motion straight against a face or away from it, from the touch on or before it", head_on},
    {"along-capsule", "motion from far away nearly along a capsule's axis, nearly touching its side or an end",
     along_capsule},
    {"start-on-surface", "a start exactly on a surface, moving in, along it or out", start_on_surface},
    {"limit-at-contact", "a time limit that is the exact time of contact, or an ulp off", limit_at_contact},
    {"scaled-velocity", "the same motion, much slower or faster", scaled_velocity},
    {"far-offset", "everything far from the origin", far_offset},
    {"scaled-lengths", "all lengths times a power of two", scaled_lengths},
    {"negative-zero", "zeros that have a sign", negative_zero},
    {"neighbour-of-one", "a number that is 1 or -1 but for up to 2 ulps", neighbour_of_one},
    {"relative-nudge", "one number moved by 1e-3 ... 1e-15 of itself", relative_nudge},
    {"ulp-nudge", "up to three numbers moved by 1 to 3 ulps", ulp_nudge},
    {"extreme-scale", "all lengths at an end of the scalar's range, subnormal or nearly infinite", extreme_scale, true},
    {"largest-or-least", "one number the largest finite one, or the least above zero", largest_or_least, true},
};

}  // namespace

std::span<const Mutator> mutators() { return all_mutators; }

}  // namespace nearmiss
