#include <algorithm>
#include <cmath>

#include "corpus/generator/constructions.hpp"
#include "corpus/generator/features.hpp"

namespace nearmiss {

namespace {

using Quaternion = std::array<double, 4>;  // x, y, z, w, of any length

/// The rotation `second` followed by the rotation `first`.
Quaternion product(const Quaternion& first, const Quaternion& second) {
  const auto [a, b, c, d] = first;
  const auto [x, y, z, w] = second;
  return {a * w + d * x + b * z - c * y, b * w + d * y + c * x - a * z, c * w + d * z + a * y - b * x,
          d * w - a * x - b * y - c * z};
}

/// A power of two with that range of exponents, of either sign.
double signed_power(Random& random, int low, int high) {
  const double sign = random.sign();
  return sign * random.power_of_two(low, high);
}

/// Two boxes whose axes longest[0] and longest[1] are nearly parallel.
struct CrossedBoxes {
  std::array<const Operand*, 2> box;
  std::array<std::size_t, 2> longest;          ///< which axis is long
  std::array<std::array<Numbers, 3>, 2> axes;  ///< in space
  Numbers apart;                               ///< the unit cross product of the two long axes
  double sine;                                 ///< of the angle between them
};

/// The rotation that turns the axis `from` to the axis `to`.
Quaternion exchange_of_axes(std::size_t from, std::size_t to) {
  if (from == to) return {0, 0, 0, 1};
  const double sign = to == (from + 1) % 3 ? 1 : -1;
  return {sign, sign, sign, 1};
}

/// The rotation of box 2 in the frame of box 1: its axis longest[1] is turned from the axis longest[0] of box 1 by 1e-5
/// ... 0.3 degrees, about a vector that is 22 ... 68 degrees off each of the two boxes' other axes.
Quaternion draw_crossing(CaseBuilder& d, const std::array<std::size_t, 2>& longest) {
  const std::size_t i = longest[0], u = (i + 1) % 3, v = (i + 2) % 3;
  const double sign = d.random.sign(), first = sign * d.random.uniform(0.4, 2.5),
               second = sign * d.random.uniform(0.4, 2.5);
  const double length1 = std::sqrt(1 + first * first), length2 = std::sqrt(1 + second * second);
  const double power = signed_power(d.random, -23, -10), half_angle = power * d.random.uniform(0.75, 2.6);
  Quaternion tilt{0, 0, 0, 1}, roll{0, 0, 0, 1};  // roll: from (1, second) to (1, first) about the long axis
  tilt[u] = half_angle / length1, tilt[v] = half_angle * first / length1;
  roll[i] = first - second, roll[3] = length1 * length2 + 1 + first * second;
  return product(product(tilt, roll), exchange_of_axes(longest[1], i));
}

void draw_rotations(CaseBuilder& d, CrossedBoxes& c) {
  const bool upright = d.random.one_in(2);  // then the scalar holds the smallest angles
  Quaternion first{0, 0, 0, 1};
  c.longest[0] = d.random.below(3);
  c.longest[1] = upright ? c.longest[0] : d.random.below(3);
  if (!upright) {
    for (double& x : first) x = d.random.sign(), x *= d.random.uniform(0.125, 1);
  }
  const Quaternion second = product(first, draw_crossing(d, c.longest));
  for (std::size_t k = 0; k < 4; ++k)
    d.set(d.plan.rotations[0] + k, first[k]), d.set(d.plan.rotations[1] + k, second[k]);
}

/// Reads back the rotations as the scalar holds them. The cross product is made exactly perpendicular to the first long
/// axis, because a long half extent multiplies what is left of it.
void measure(const CaseBuilder& d, CrossedBoxes& c) {
  for (std::size_t n = 0; n < 2; ++n) c.axes[n] = axes_of(d, d.plan.rotations[n]);
  const Numbers &a = c.axes[0][c.longest[0]], &b = c.axes[1][c.longest[1]];
  const Numbers across = cross(a, b);
  c.sine = norm(across);
  const Numbers direction = unit_of(across);
  c.apart = unit_of(plus(direction, a, -dot(direction, a)));
}

/// Half extents: thin enough that no face separates boxes of the lengths `half_length` whose edges cross.
double draw_thickness(CaseBuilder& d, const CrossedBoxes& c, double half_length) {
  const double thickness = half_length * c.sine / d.random.power_of_two(4, 7);
  for (std::size_t n = 0; n < 2; ++n) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double scale = k == c.longest[n] ? half_length : thickness;
      d.set(c.box[n]->sizes[k], scale * d.random.uniform(0.5, 1));
    }
  }
  return thickness;
}

double reach(const CaseBuilder& d, const CrossedBoxes& c) {
  double total = 0;
  for (std::size_t n = 0; n < 2; ++n) {
    for (std::size_t k = 0; k < 3; ++k) total += d[c.box[n]->sizes[k]] * std::abs(dot(c.axes[n][k], c.apart));
  }
  return total;
}

bool choose_boxes(const CaseBuilder& d, CrossedBoxes& c) {
  std::size_t count = 0;
  for (const Operand& t : d.plan.operands) {
    if (t.half && count < 2) c.box[count++] = &t;
  }
  return count == 2 && d.plan.rotations.size() == 2;
}

const Operand* capsule_of(const CaseBuilder& d) {
  for (const Operand& t : d.plan.operands) {
    if (t.shape == Shape::capsule) return &t;
  }
  return nullptr;
}

/// A motion along a capsule: unit vectors along its axis and at a right angle to it, and the distance of its axis at
/// which the mover touches it.
struct Skimming {
  Numbers first, axis, along, aside;  ///< the end that is passed first, and the way from there to the other end
  double reach;
};

/// About the place at which the motion is nearest to the capsule: beside the axis, or before its first end.
Numbers draw_place(CaseBuilder& d, const Skimming& p) {
  const double off = p.reach * (1 + signed_power(d.random, -d.orders(18, 44), -4));
  if (!d.random.one_in(3)) return plus(plus(p.first, p.axis, d.random.uniform(0, 1)), p.aside, off);
  const Numbers toward = unit_of(plus(p.aside, p.along, -d.random.uniform(0, 2)));
  return plus(p.first, toward, off);
}

/// The axis, tilted by up to a sixteenth along the surface and, in half of the cases, toward it or away from it.
Numbers draw_tilted(CaseBuilder& d, const Skimming& p) {
  const double sideways = signed_power(d.random, -20, -5);
  const double inwards = d.random.one_in(2) ? 0 : signed_power(d.random, -20, -5);
  return plus(plus(p.along, cross(p.along, p.aside), sideways), p.aside, inwards);
}

Skimming draw_skimming(CaseBuilder& d, const Operand& capsule, const Operand& mover) {
  const bool back = d.random.one_in(2);
  const Numbers first = d.vector(capsule.positions[back ? 1 : 0]), last = d.vector(capsule.positions[back ? 0 : 1]);
  Skimming p{first, plus(last, first, -1), {}, {}, d[capsule.sizes[0]]};
  if (!mover.sizes.empty()) p.reach += d[mover.sizes[0]];
  p.along = unit_of(p.axis);
  p.aside = unit_of(cross(p.along, d.random_vector(1)));
  return p;
}

}  // namespace

bool crossed_edges(CaseBuilder& d) {
  CrossedBoxes c{};
  if (!choose_boxes(d, c)) return false;
  draw_rotations(d, c);
  measure(d, c);
  const double half_length = d.unit * d.random.uniform(0.5, 2);
  const double thickness = draw_thickness(d, c, half_length);
  const double gap = signed_power(d.random, -20, -3) * thickness;
  const Numbers center = d.random_vector(thickness * d.random.power_of_two(0, 4));
  const double along = d.random.one_in(2) ? 0 : 0.25 * half_length * d.random.uniform(-1, 1);
  d.set_vector(c.box[0]->positions[0], center);
  const Numbers crossing = plus(d.vector(c.box[0]->positions[0]), c.axes[0][c.longest[0]], along);
  d.set_vector(c.box[1]->positions[0], plus(crossing, c.apart, d.random.sign() * (reach(d, c) + gap)));
  return true;
}

bool along_capsule(CaseBuilder& d) {
  const Operand* capsule = capsule_of(d);
  if (capsule == nullptr || d.plan.velocities.empty()) return false;
  const Operand& mover = d.plan.operands.front();
  if (&mover == capsule || mover.positions.size() != 1) return false;
  const Skimming p = draw_skimming(d, *capsule, mover);
  if (norm(p.aside) == 0) return false;
  const Numbers place = draw_place(d, p);
  const double far = (norm(p.axis) + p.reach) * d.random.power_of_two(4, d.orders(9, 20));
  d.set_vector(mover.positions[0], plus(place, draw_tilted(d, p), -far));
  const Numbers way = plus(place, d.vector(mover.positions[0]), -1);
  d.set_vector(d.plan.velocities.front(), plus({}, way, d.random.power_of_two(-9, 0)));
  return true;
}

}  // namespace nearmiss
