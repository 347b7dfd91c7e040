#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/generator/case_builder.hpp"
#include "oracles/requirements.hpp"
#include "reports/triage/hypotheses/readings.hpp"

namespace nearmiss {

namespace {

using Fits = std::optional<bool>;

/// The opinion about the answer to another case; empty where it is the same case, or none.
Fits opinion_on(const Case& c, const Case& other, const Answer& a, const IsRight& is_right) {
  if (other.values == c.values || c.query->broken(other.values)) return std::nullopt;
  return is_right(other, a);
}

/// The opinion about the answer to the case with every input of this role replaced.
template <class Change>
Fits with_input(const Case& c, const Answer& a, Role role, const IsRight& is_right, const Change& change) {
  Case other = c;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == role) other.values[i] = change(c.values[i]);
  }
  return opinion_on(c, other, a, is_right);
}

bool is_half_extent(const Case& c, std::size_t i) { return c.operands().of_number(i)->half.has_value(); }

/// Which operands a reading is about: all, or the first or second of the operands with such a part.
enum class Which { all, first, second };

/// Whether the input belongs to the operand that is meant, among those of these inputs.
bool is_meant(const Case& c, std::size_t i, std::span<const std::size_t> among, Which which) {
  if (which == Which::all || among.empty()) return which == Which::all;
  const auto operand_of = [&](std::size_t number) { return c.operands().of_number(number); };
  const bool is_first = operand_of(i) == operand_of(among.front());
  const bool are_two = operand_of(among.back()) != operand_of(among.front());
  return are_two && is_first == (which == Which::first);
}

/// The case with the meant sizes multiplied: the half extents, or the radii.
Case with_sizes(const Case& c, double factor, bool half_extents, Which which) {
  std::vector<std::size_t> sizes;
  for (const std::size_t i : c.operands().sizes) {
    if (is_half_extent(c, i) == half_extents) sizes.push_back(i);
  }
  Case other = c;
  for (const std::size_t i : sizes) {
    if (is_meant(c, i, sizes, which)) other.values[i] = c.values[i] * factor;
  }
  return other;
}

template <int numerator, int denominator, bool half_extents, Which which = Which::all>
Fits scaled_sizes(const Case& c, const Answer& a, const IsRight& is_right) {
  return opinion_on(c, with_sizes(c, double(numerator) / denominator, half_extents, which), a, is_right);
}

using QuaternionNumbers = std::array<double, 4>;
using ChangeOfRotation = QuaternionNumbers (*)(const QuaternionNumbers&);

/// The case with the meant quaternions replaced.
Case with_rotations(const Case& c, ChangeOfRotation change, Which which) {
  Case other = c;
  const auto& all = c.operands().quaternions;
  for (const std::size_t i : all) {
    if (!is_meant(c, i, all, which)) continue;
    const QuaternionNumbers changed = change({c.values[i], c.values[i + 1], c.values[i + 2], c.values[i + 3]});
    std::copy(changed.begin(), changed.end(), other.values.begin() + std::ptrdiff_t(i));
  }
  return other;
}

QuaternionNumbers inverse_of(const QuaternionNumbers& q) { return {-q[0], -q[1], -q[2], q[3]}; }
QuaternionNumbers rotated_left(const QuaternionNumbers& q) { return {q[1], q[2], q[3], q[0]}; }
QuaternionNumbers no_turn(const QuaternionNumbers& q) {
  const bool is_turned = q[0] != 0 || q[1] != 0 || q[2] != 0;
  return is_turned ? QuaternionNumbers{0, 0, 0, 1} : q;
}

template <ChangeOfRotation change, Which which = Which::all>
Fits changed_rotation(const Case& c, const Answer& a, const IsRight& is_right) {
  return opinion_on(c, with_rotations(c, change, which), a, is_right);
}

Fits negative_offset(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::offset, is_right, [](double x) { return -x; });
}
template <Role role>
Fits zero_input(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, role, is_right, [](double) { return 0.0; });
}
Fits reversed_velocity(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::velocity, is_right, [](double x) { return -x; });
}
Fits no_axis(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::index, is_right, [](double) { return -1.0; });
}
Fits other_flag(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::flag, is_right, [](double x) { return 1 - x; });
}
/// A case whose flag has this value already makes no difference.
template <int value>
Fits fixed_flag(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::flag, is_right, [](double) { return double(value); });
}

/// The index of an axis of two boxes: its cross products are numbered by those of the second box.
Fits cross_products_by_columns(const Case& c, const Answer& a, const IsRight& is_right) {
  if (c.operands().quaternions.size() != 2) return std::nullopt;
  return with_input(c, a, Role::index, is_right, [](double x) {
    const double own_axes = 6, cross = x - own_axes, row = std::floor(cross / 3);
    return cross < 0 ? x : own_axes + 3 * (cross - 3 * row) + row;
  });
}
Fits index_from_one(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::index, is_right, [](double x) { return x - 1; });
}

/// A bound of 1 minus a cosine that is taken for an angle, or for the sine of one.
template <bool of_sine>
Fits angle_for_bound(const Case& c, const Answer& a, const IsRight& is_right) {
  if (c.query->kind != Kind::decision) return std::nullopt;
  return with_input(c, a, Role::weight, is_right, [&](double bound) {
    if (!(bound > 0 && bound < 1)) return bound;
    const double half = std::sin((of_sine ? std::asin(bound) : bound) / 2);
    return rounded_to(c.scalar, 2 * half * half);
  });
}

/// The two operands in each other's place.
Fits exchanged_operands(const Case& c, const Answer& a, const IsRight& is_right) {
  Case other = c;
  const bool are_two = c.operands().size() == 2 && c.operands().velocities.empty();
  if (are_two && c.operands()[0].shape == c.operands()[1].shape) {
    const Operand &one = c.operands()[0], &two = c.operands()[1];
    std::swap_ranges(&other.values[one.begin], &other.values[one.begin] + one.count, &other.values[two.begin]);
  }
  return opinion_on(c, other, a, is_right);
}

/// A rectangle whose corners are read as those of a strip of two triangles: two corners that follow each other are
/// exchanged. Which two decides on the diagonal.
template <std::size_t first>
Fits corners_of_a_strip(const Case& c, const Answer& a, const IsRight& is_right) {
  Case other = c;
  for (const auto& corners : c.operands().rectangles) {
    for (std::size_t k = 0; k < 3; ++k)
      std::swap(other.values[corners[first] + k], other.values[corners[first + 1] + k]);
  }
  return opinion_on(c, other, a, is_right);
}

/// The upper corner of an axis-aligned box is its size; a negative one is 0.
Fits size_for_corner(const Case& c, const Answer& a, const IsRight& is_right) {
  Case other = c;
  for (const std::size_t low : c.operands().aaboxes) {
    for (std::size_t k = low; k < low + 3; ++k)
      other.values[k + 3] = rounded_to(c.scalar, c.values[k] + std::max(c.values[k + 3], 0.0));
  }
  return opinion_on(c, other, a, is_right);
}
/// An axis-aligned box whose extents are multiplied about its center.
template <int numerator, int denominator>
Fits scaled_corners(const Case& c, const Answer& a, const IsRight& is_right) {
  constexpr double factor = double(numerator) / denominator, own = (1 + factor) / 2, other_corner = (1 - factor) / 2;
  Case other = c;
  for (const std::size_t low : c.operands().aaboxes) {
    for (std::size_t k = low; k < low + 3; ++k) {
      other.values[k] = rounded_to(c.scalar, own * c.values[k] + other_corner * c.values[k + 3]);
      other.values[k + 3] = rounded_to(c.scalar, other_corner * c.values[k] + own * c.values[k + 3]);
    }
  }
  return opinion_on(c, other, a, is_right);
}
/// The corners of an axis-aligned box are its center and half extents; negative ones are 0.
Fits center_for_corner(const Case& c, const Answer& a, const IsRight& is_right) {
  Case other = c;
  for (const std::size_t low : c.operands().aaboxes) {
    for (std::size_t k = low; k < low + 3; ++k) {
      const double half = std::max(c.values[k + 3], 0.0);
      other.values[k] = rounded_to(c.scalar, c.values[k] - half);
      other.values[k + 3] = rounded_to(c.scalar, c.values[k] + half);
    }
  }
  return opinion_on(c, other, a, is_right);
}
/// The velocity, or the direction of a ray, is the place where the motion ends.
Fits end_for_way(const Case& c, const Answer& a, const IsRight& is_right) {
  const Operands& parts = c.operands();
  if (!parts.start) return std::nullopt;
  Case other = c;
  for (const auto* ways : {&parts.velocities, &parts.directions}) {
    for (const std::size_t way : *ways) {
      for (std::size_t k = 0; k < 3; ++k)
        other.values[way + k] = rounded_to(c.scalar, c.values[way + k] - c.values[parts.start->place + k]);
    }
  }
  return opinion_on(c, other, a, is_right);
}

/// A limit of time that is taken for a length of the motion.
Fits length_for_limit(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto& velocities = c.operands().velocities;
  if (velocities.empty()) return std::nullopt;
  const double* v = &c.values[velocities[0]];
  const double speed = std::hypot(v[0], v[1], v[2]);
  if (!(speed > 0)) return std::nullopt;
  return with_input(c, a, Role::time, is_right, [&](double limit) { return limit / speed; });
}

/// A limit of time that no motion exceeds: 1.
Fits limit_of_one(const Case& c, const Answer& a, const IsRight& is_right) {
  Case other = c;
  const auto inputs = c.fields();
  bool is_forever = false, has_limit = false;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].role != Role::flag) continue;
    is_forever = is_forever || c.values[i] != 0;
    other.values[i] = 0;
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].role != Role::time) continue;
    other.values[i] = is_forever ? 1 : std::min(c.values[i], 1.0);
    has_limit = true;
  }
  if (!has_limit) return std::nullopt;
  return opinion_on(c, other, a, is_right);
}

/// A box that is grown by the radius of the sphere has sharp corners, where that of the sphere and the box is round.
Fits sharp_corners(const Case& c, const Answer& a, const IsRight& is_right) {
  const Operand *sphere = c.operands().find(Shape::sphere), *box = c.operands().find(Shape::box);
  if (sphere == nullptr || box == nullptr) return std::nullopt;
  Case other = c;
  double& radius = other.values[*sphere->radius];
  for (std::size_t k = 0; k < 3; ++k) {
    double& half = other.values[*box->half + k];
    half = rounded_to(c.scalar, half + radius);
  }
  radius = 0;
  return opinion_on(c, other, a, is_right);
}

constexpr Reading table_of_inputs[] = {
    {"half extents halved", "the given half extents are full extents", CauseKind::convention, false,
     scaled_sizes<1, 2, true>},
    {"half extents doubled", "each half extent is twice the given one", CauseKind::convention, false,
     scaled_sizes<2, 1, true>},
    {"radius halved", "the given radius is a diameter", CauseKind::convention, false, scaled_sizes<1, 2, false>},
    {"radius doubled", "each radius is twice the given one", CauseKind::convention, false, scaled_sizes<2, 1, false>},
    {"rotation inverted", "each rotation is the inverse of the given one", CauseKind::convention, false,
     changed_rotation<inverse_of>},
    {"quaternion begins with w", "the four numbers of a quaternion are w, x, y, z", CauseKind::convention, false,
     changed_rotation<rotated_left>},
    {"offset of the other sign", "the plane's offset has the other sign", CauseKind::convention, false,
     negative_offset},
    {"velocity reversed", "the velocity has the other sign", CauseKind::convention, false, reversed_velocity},
    {"end in place of the velocity", "the velocity is the place where the motion ends", CauseKind::convention, false,
     end_for_way},
    {"flag inverted", "the flag has the other value", CauseKind::convention, false, other_flag},
    {"rotation ignored", "rotations are ignored", CauseKind::unsupported, false, changed_rotation<no_turn>},
    {"radius ignored", "radii are ignored", CauseKind::unsupported, false, scaled_sizes<0, 1, false>},
    {"flag ignored", "the flag is taken for true", CauseKind::unsupported, false, fixed_flag<1>},
    {"flag ignored", "the flag is taken for false", CauseKind::unsupported, false, fixed_flag<0>},
    {"half extents of the first halved", "the half extents of the first box are full extents", CauseKind::convention,
     false, scaled_sizes<1, 2, true, Which::first>},
    {"half extents of the first doubled", "each half extent of the first box is twice the given one",
     CauseKind::convention, false, scaled_sizes<2, 1, true, Which::first>},
    {"radius of the first halved", "the first radius is a diameter", CauseKind::convention, false,
     scaled_sizes<1, 2, false, Which::first>},
    {"radius of the first doubled", "the first radius is twice the given one", CauseKind::convention, false,
     scaled_sizes<2, 1, false, Which::first>},
    {"rotation of the first inverted", "the rotation of the first box is the inverse of the given one",
     CauseKind::convention, false, changed_rotation<inverse_of, Which::first>},
    {"rotation ignored", "the rotation of the first box is ignored", CauseKind::unsupported, false,
     changed_rotation<no_turn, Which::first>},
    {"radius ignored", "the first radius is ignored", CauseKind::unsupported, false,
     scaled_sizes<0, 1, false, Which::first>},
    {"half extents of the second halved", "the half extents of the second box are full extents", CauseKind::convention,
     false, scaled_sizes<1, 2, true, Which::second>},
    {"half extents of the second doubled", "each half extent of the second box is twice the given one",
     CauseKind::convention, false, scaled_sizes<2, 1, true, Which::second>},
    {"radius of the second halved", "the second radius is a diameter", CauseKind::convention, false,
     scaled_sizes<1, 2, false, Which::second>},
    {"radius of the second doubled", "the second radius is twice the given one", CauseKind::convention, false,
     scaled_sizes<2, 1, false, Which::second>},
    {"rotation of the second inverted", "the rotation of the second box is the inverse of the given one",
     CauseKind::convention, false, changed_rotation<inverse_of, Which::second>},
    {"rotation ignored", "the rotation of the second box is ignored", CauseKind::unsupported, false,
     changed_rotation<no_turn, Which::second>},
    {"radius ignored", "the second radius is ignored", CauseKind::unsupported, false,
     scaled_sizes<0, 1, false, Which::second>},
    {"half extents ignored", "half extents are ignored", CauseKind::unsupported, false, scaled_sizes<0, 1, true>},
    {"offset ignored", "the plane's offset is ignored", CauseKind::unsupported, false, zero_input<Role::offset>},
    {"operands exchanged", "the first operand and the second are exchanged", CauseKind::convention, false,
     exchanged_operands},
    {"length in place of the limit", "the limit is a length of the motion", CauseKind::convention, true,
     length_for_limit},
    {"motion ends at time 1", text_of(Convention::ends_at_time_one).what, CauseKind::convention, true, limit_of_one,
     Convention::ends_at_time_one},
    {"axis ignored", "the given axis is not read", CauseKind::unsupported, false, no_axis},
    {"time ignored", "the time is ignored", CauseKind::unsupported, false, zero_input<Role::time>},
    {"corners of a strip", "the corners of the rectangle are those of a strip of two triangles", CauseKind::convention,
     false, corners_of_a_strip<2>},
    {"corners of a strip", "the corners of the rectangle are those of a strip of two triangles", CauseKind::convention,
     false, corners_of_a_strip<0>},
    {"size in place of a corner", "the upper corner of the box is its size", CauseKind::convention, false,
     size_for_corner},
    {"center and half extents in place of corners", "the two corners of the box are its center and half extents",
     CauseKind::convention, false, center_for_corner},
    {"extents halved", "the extents of the box are half of those between its corners", CauseKind::convention, false,
     scaled_corners<1, 2>},
    {"extents doubled", "the extents of the box are twice those between its corners", CauseKind::convention, false,
     scaled_corners<2, 1>},
    {"cross products by columns", "the cross products of the boxes' axes are numbered by those of the second box",
     CauseKind::convention, false, cross_products_by_columns},
    {"angle in place of the bound", "the bound is an angle in radians", CauseKind::convention, false,
     angle_for_bound<false>},
    {"sine in place of the bound", "the bound is the sine of an angle", CauseKind::convention, false,
     angle_for_bound<true>},
    {"given index from 1", "the given index counts from 1", CauseKind::convention, false, index_from_one},
    {"sharp corners", "the box is grown by the radius, so that its corners are not round", CauseKind::logic, false,
     sharp_corners},
};

}  // namespace

std::span<const Reading> readings_of_inputs() { return table_of_inputs; }

}  // namespace nearmiss
