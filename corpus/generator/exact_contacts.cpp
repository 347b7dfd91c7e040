#include <algorithm>
#include <cmath>

#include "corpus/generator/constructions.hpp"

namespace nearmiss {

namespace {

/// Three orthogonal vectors of whole numbers, each of the whole length `length`: a rotation, scaled.
struct Frame {
  std::array<double, 4> rotation;  ///< the quaternion x, y, z, w
  std::array<Numbers, 3> axes;
  double length;

  Numbers in_space(const Numbers& at) const {
    return plus(plus(plus({}, axes[0], at[0]), axes[1], at[1]), axes[2], at[2]);
  }
};

/// The columns of the quaternion's rotation matrix times its squared length.
Frame frame_of(const std::array<double, 4>& q) {
  const auto [x, y, z, w] = q;
  Frame f{q, {}, x * x + y * y + z * z + w * w};
  f.axes[0] = {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
  f.axes[1] = {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
  f.axes[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
  return f;
}

/// Half of the frames are upright. The axes of the others have components such as 3/5 and 4/5, or 1/3 and 2/3.
Frame draw_frame(CaseBuilder& d) {
  constexpr int upright[][4] = {{0, 0, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
  constexpr int tilted[][4] = {{0, 0, 1, 2}, {0, 0, 1, 3}, {1, 1, 0, 1}, {1, 1, 1, 2}, {1, 2, 0, 2}};
  const auto& q =
      d.random.one_in(2) ? upright[d.random.below(std::size(upright))] : tilted[d.random.below(std::size(tilted))];
  const std::size_t turn = d.random.below(3);
  std::array<double, 4> turned{0, 0, 0, double(q[3])};
  for (std::size_t k = 0; k < 3; ++k) turned[(k + turn) % 3] = q[k] == 0 ? 0.0 : d.random.sign() * q[k];
  return frame_of(turned);
}

/// The dimension of the operand without its radius: 0 for a sphere, 1 for a capsule, 2 for a triangle, 3 for a box.
std::size_t dimension_of(const Operand& operand) {
  if (operand.half || operand.shape == Shape::aabox) return 3;
  return std::min<std::size_t>(operand.positions.size() - 1, 2);
}

/// A box in a frame, flat in the dimensions that its operand does not have, thickened by a radius.
struct Block {
  Frame frame;
  double step;     ///< one unit of the frame's coordinates, in space
  Numbers center;  ///< in space
  Numbers half;    ///< in the frame
  double radius;   ///< in space

  Numbers at(const Numbers& in_frame) const { return plus(center, frame.in_space(in_frame), step); }
};

void put_box(CaseBuilder& d, const Operand& box, const Block& b) {
  d.set_vector(box.positions[0], b.center);
  for (std::size_t k = 0; k < 3; ++k) d.set(box.sizes[k], b.half[k] * b.frame.length * b.step);
  for (std::size_t begin : d.plan.rotations) {
    for (std::size_t k = 0; k < 4; ++k) d.set(begin + k, b.frame.rotation[k]);
  }
}

/// The ends of a segment, the corners of a triangle with a right angle or of a rectangle. Starts at any corner and goes
/// either way round.
void put_corners(CaseBuilder& d, const Operand& operand, const Block& b) {
  constexpr int ends[][2] = {{-1, 0}, {1, 0}}, three[][2] = {{-1, -1}, {1, -1}, {-1, 1}},
                four[][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const std::size_t count = operand.positions.size(), start = d.random.below(count);
  const int(*const signs)[2] = count == 2 ? ends : count == 3 ? three : four;
  const bool back = d.random.one_in(2);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t to = (start + (back ? count - i : i)) % count;
    d.set_vector(operand.positions[to], b.at({signs[i][0] * b.half[0], signs[i][1] * b.half[1], 0}));
  }
}

void put(CaseBuilder& d, const Operand& operand, const Block& b) {
  if (operand.half) return put_box(d, operand, b);
  if (operand.radius) d.set(*operand.radius, b.radius);
  if (operand.positions.size() == 1) return d.set_vector(operand.positions[0], b.center);
  if (operand.shape != Shape::aabox) return put_corners(d, operand, b);
  d.set_vector(operand.positions[0], b.at(plus({}, b.half, -1)));
  d.set_vector(operand.positions[1], b.at(b.half));
}

/// A block for an operand with that dimension: half extents 1 ... 8, near `center`.
Block draw_block(CaseBuilder& d, std::size_t dimension, const Numbers& center) {
  Block b{draw_frame(d), d.unit * d.random.power_of_two(-6, -3), {}, {}, 0};
  for (std::size_t k = 0; k < 3; ++k) b.center[k] = std::nearbyint(center[k] / b.step) * b.step;
  for (std::size_t k = 0; k < dimension; ++k) b.half[k] = d.random.between(1, 8);
  return b;
}

/// An exact contact of the moving operand with a block.
struct Contact {
  Block block;
  Numbers outward;  ///< in the frame: whole numbers, perpendicular to the surface
  Numbers place;    ///< the center or point that moves, in space
};

/// Whole numbers of a whole length, and the length: along an axis, or off all axes.
std::array<int, 4> draw_outward(CaseBuilder& d) {
  const std::size_t turn = d.random.below(3);
  std::array<int, 4> out{0, 0, 0, 1};
  if (d.random.one_in(2)) {
    out[turn] = 1;
  } else {
    const auto& sides = whole_diagonals[d.random.below(std::size(whole_diagonals))];
    for (std::size_t k = 0; k < 3; ++k) out[(k + turn) % 3] = sides[k];
    out[3] = sides[3];
  }
  for (std::size_t k = 0; k < 3; ++k) out[k] *= int(d.random.sign());
  return out;
}

/// A point of the block without its radius at which `outward` is perpendicular to the surface, in the frame. In a
/// triangle with its right angle at the negative end of both axes, `outward` turns to that end.
Numbers point_below(CaseBuilder& d, const Numbers& half, bool triangle, Numbers& outward) {
  const bool over_face = outward[0] == 0 && outward[1] == 0;
  Numbers at;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool bounded = triangle && k < 2;
    if (bounded) outward[k] = -std::abs(outward[k]);
    const double along = 0.125 * d.random.between(-8, bounded && over_face ? 0 : 8);
    at[k] = half[k] * (outward[k] > 0 ? 1 : outward[k] < 0 ? -1 : along);
  }
  return at;
}

/// Radii of `mover` and of the block that are whole multiples of `outward`, and the place where they touch.
Contact touch(CaseBuilder& d, const Operand& mover, bool round, bool triangle, const Block& b,
              std::array<int, 4> outward) {
  Contact c{b, {double(outward[0]), double(outward[1]), double(outward[2])}, {}};
  const Numbers below = point_below(d, c.block.half, triangle, c.outward);
  const double theirs = round ? 0.25 * d.random.between(1, 8) : 0, own = 0.25 * d.random.between(1, 8);
  const double unit = outward[3] * c.block.frame.length * c.block.step;
  double away = theirs;
  c.block.radius = theirs * unit;
  if (!mover.sizes.empty()) d.set(mover.sizes[0], own * unit), away += own;
  c.place = c.block.at(plus(below, c.outward, away));
  return c;
}

bool is_one_ball(const Operand& operand) { return operand.positions.size() == 1 && operand.sizes.size() <= 1; }

/// The moving operand: a point or a ball. nullptr if the query has no motion of one.
const Operand* mover_of(const CaseBuilder& d) {
  if (d.plan.velocities.empty() || d.plan.operands.empty()) return nullptr;
  return is_one_ball(d.plan.operands.front()) ? &d.plan.operands.front() : nullptr;
}

/// A plane through the block's center, perpendicular to the frame's last axis.
void put_plane(CaseBuilder& d, std::size_t offset, const Block& b) {
  const Numbers& normal = b.frame.axes[2];
  const double factor = d.random.power_of_two(-2, 2);
  for (std::size_t k = 0; k < 3; ++k) d.set(offset - 3 + k, factor * normal[k]);
  d.set(offset, -factor * (normal[0] * b.center[0] + normal[1] * b.center[1] + normal[2] * b.center[2]));
}

/// From the front of a plane, or sometimes from behind; a half-space has no surface behind.
Contact touch_plane(CaseBuilder& d, const Operand& mover, std::size_t offset) {
  Block b = draw_block(d, 0, d.vector(mover.positions[0]));
  put_plane(d, offset, b);
  const bool may_be_behind = d.plan.query->operands.find(Shape::halfspace) == nullptr;
  return touch(d, mover, false, false, b, {0, 0, may_be_behind && d.random.one_in(4) ? -1 : 1, 1});
}

Contact touch_operand(CaseBuilder& d, const Operand& mover, const Operand& other) {
  Block b = draw_block(d, dimension_of(other), d.vector(other.positions[0]));
  if (other.shape == Shape::aabox) b.frame = frame_of({0, 0, 0, 1});
  const bool round = other.radius.has_value(), triangle = other.shape == Shape::triangle;
  Contact c = touch(d, mover, round, triangle, b, draw_outward(d));
  put(d, other, c.block);
  return c;
}

/// Whether the query has something that its moving operand can touch.
bool has_contact(const CaseBuilder& d, const Operand* mover) {
  return mover != nullptr && (d.plan.operands.size() > 1 || !d.plan.numbers[std::size_t(Role::offset)].empty());
}

Contact make_contact(CaseBuilder& d, const Operand& mover) {
  const auto& offsets = d.plan.numbers[std::size_t(Role::offset)];
  const auto& operands = d.plan.operands;
  if (operands.size() < 2) return touch_plane(d, mover, d.random.pick(offsets));
  return touch_operand(d, mover, operands[1 + d.random.below(operands.size() - 1)]);
}

/// A motion in the block's frame, at a right angle to `outward`; sometimes zero.
Numbers draw_along(CaseBuilder& d, const Numbers& out) {
  Numbers any;
  for (double& x : any) x = d.random.between(-3, 3);
  return {out[1] * any[2] - out[2] * any[1], out[2] * any[0] - out[0] * any[2], out[0] * any[1] - out[1] * any[0]};
}

/// `outwards` times the contact's outward vector, plus a motion along the surface, in space.
Numbers motion(CaseBuilder& d, const Contact& c, double outwards) {
  const Numbers in_frame = plus(draw_along(d, c.outward), c.outward, outwards);
  return plus({}, c.block.frame.in_space(in_frame), c.block.step * d.random.power_of_two(-2, 1));
}

}  // namespace

bool true_rectangle(CaseBuilder& d) {
  for (const Operand& operand : d.plan.operands) {
    if (operand.shape != Shape::rectangle) continue;
    Block b = draw_block(d, 2, d.vector(d.random.pick(operand.positions)));
    if (d.random.one_in(4)) b.half[0] *= d.random.power_of_two(1, 4);
    put(d, operand, b);
    if (!d.plan.directions.empty() && d.random.one_in(2)) d.set_vector(d.plan.directions.front(), b.frame.axes[2]);
    return true;
  }
  return false;
}

bool start_on_surface(CaseBuilder& d) {
  const Operand* mover = mover_of(d);
  if (!has_contact(d, mover)) return false;
  const Contact c = make_contact(d, *mover);
  d.set_vector(mover->positions[0], c.place);
  const int way = d.random.between(-1, 1), speed = d.random.between(1, 3);
  d.set_vector(d.plan.velocities.front(), motion(d, c, way * speed));
  return true;
}

void touch_at_rest(CaseBuilder& d) {
  const Operand& first = d.plan.operands[0];
  const Contact c = touch_operand(d, first, d.plan.operands[1]);
  for (std::size_t i = 0; i < first.positions.size(); ++i) {
    Numbers away{};
    if (i > 0) {
      const int outwards = d.random.between(0, 3);
      away = plus(draw_along(d, c.outward), c.outward, outwards);
    }
    const double stretch = d.random.power_of_two(0, 3);
    d.set_vector(first.positions[i], plus(c.place, c.block.frame.in_space(away), c.block.step * stretch));
  }
}

bool limit_at_contact(CaseBuilder& d) {
  const auto &times = d.plan.numbers[std::size_t(Role::time)], &flags = d.plan.numbers[std::size_t(Role::flag)];
  const Operand* mover = mover_of(d);
  if (times.empty() || !has_contact(d, mover)) return false;
  const Contact c = make_contact(d, *mover);
  const Numbers velocity = motion(d, c, -d.random.between(1, 3));
  const double limit = 0.125 * d.random.between(1, 32);
  d.set_vector(d.plan.velocities.front(), velocity);
  d.set_vector(mover->positions[0], plus(c.place, velocity, -limit));
  for (std::size_t i : flags) d.set(i, 0);
  d.set(times.front(), limit);
  if (d.random.one_in(2)) d.step_ulps(times.front(), d.random.one_in(2) ? 1 : -1);
  return true;
}

}  // namespace nearmiss
