/// Reflections, and permutations of the coordinate axes.
#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/relations/follow_ups.hpp"
#include "corpus/relations/operands.hpp"

namespace nearmiss::metamorphic {

namespace {

/// Coordinate k of the image is sign[k] times coordinate from[k]. A box's own axes are permuted in the same way, so
/// that its rotation stays a rotation: R' = M R M^-1.
struct SignedPermutation {
  std::array<std::size_t, 3> from{0, 1, 2};
  std::array<double, 3> sign{1, 1, 1};

  bool permutes() const { return from[0] != 0; }
  bool turns_over() const { return sign[0] * sign[1] * sign[2] < 0; }  // permutations are cyclic here
  /// The image of axis k.
  std::size_t to(std::size_t k) const { return std::size_t(std::find(from.begin(), from.end(), k) - from.begin()); }
  /// The image of one of the fifteen axes of two boxes.
  int box_axis(int axis) const {
    if (axis < 0 || axis > 14) return axis;
    if (axis < 3) return int(to(std::size_t(axis)));
    if (axis < 6) return 3 + int(to(std::size_t(axis - 3)));
    return 6 + 3 * int(to(std::size_t(axis - 6) / 3)) + int(to(std::size_t(axis - 6) % 3));
  }
};

void apply(const SignedPermutation& m, const double* from, double* to, bool with_signs) {
  for (std::size_t k = 0; k < 3; ++k) to[k] = (with_signs ? m.sign[k] : 1.0) * from[m.from[k]];
}

/// Whether only one axis has the normal's component of largest magnitude, along which a point is projected.
bool one_axis_to_look_along(const Case& c) {
  if (!c.query->traits.projects) return true;
  const double* normal = &c.values[c.operands().normals.front()];
  std::array<double, 3> m{std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])};
  std::sort(m.begin(), m.end());
  return m[1] < m[2];
}

Case image_of(const Case& c, const SignedPermutation& m) {
  Case other = c;
  for (const InputMember& member : c.operands().members) {
    const double* at = &c.values[member.begin];
    double* to = &other.values[member.begin];
    if (member.role == Role::rotation) {
      apply(m, at, to, true);  // a rotation axis: a reflection reverses it once more
      for (std::size_t k = 0; m.turns_over() && k < 3; ++k) to[k] = -to[k];
    } else if (member.is_vector()) {
      apply(m, at, to, member.role != Role::size);
    } else if (member.role == Role::index && c.query->traits.projects) {
      if (*at >= 0 && *at < 3) *to = double(m.to(std::size_t(*at)));
    } else if (member.role == Role::index) {
      *to = m.box_axis(int(*at));
    }
  }
  for (const std::size_t lower : c.operands().aaboxes) {
    for (std::size_t k = lower; k < lower + 3; ++k) {
      if (other.values[k + 3] < other.values[k]) std::swap(other.values[k], other.values[k + 3]);
    }
  }
  if (m.turns_over()) reverse_corners(other);  // keeps the front
  return other;
}

std::optional<FollowUps> moved_by(const Case& c, const SignedPermutation& m) {
  const OutputFrame frame = c.query->traits.frame;
  if (frame == OutputFrame::operands || (m.permutes() && frame == OutputFrame::order_of_axes)) return std::nullopt;
  if (m.permutes() && !one_axis_to_look_along(c)) return std::nullopt;
  const Query& query = *c.query;
  const bool weights_of_corners = c.operands().find(Shape::triangle) != nullptr;
  return counterpart_if_valid(image_of(c, m), [&query, m, weights_of_corners](const Answer& own) {
    Answer a = own;
    for (const Layout::Part& p : query.layout.parts) {
      const std::size_t i = p.begin;
      if (query.traits.frame == OutputFrame::order_of_operands || p.is_entry) {
        a = without(a, p);  // a cross product may change its sign; entries come in another order
      } else if (p.is_vector() && p.role != Role::weight) {
        for (std::size_t k = 0; k < 3; ++k) carry(a, i + k, own, i + m.from[k], m.sign[k]);
      } else if (p.is_vector() && m.turns_over() && weights_of_corners) {
        carry(a, i + 1, own, i + 2);
        carry(a, i + 2, own, i + 1);
      } else if (p.name == "edge") {
        if (m.turns_over()) a.values[i] = 2 - own.values[i];
      } else if (p.role == Role::index && query.traits.frame != OutputFrame::order_of_axes) {
        if (const int axis = as_index(own.values[i]); axis >= 0) a.values[i] = m.box_axis(axis);
      }
    }
    return a;
  });
}

}  // namespace

std::optional<FollowUps> reflected(const Case& c, std::uint64_t seed) {
  Random random(seed);
  SignedPermutation m;
  const std::size_t which = 1 + random.below(7);
  for (std::size_t k = 0; k < 3; ++k) m.sign[k] = (which >> k & 1u) != 0 ? -1 : 1;
  return moved_by(c, m);
}

std::optional<FollowUps> permuted_axes(const Case& c, std::uint64_t seed) {
  SignedPermutation m;
  m.from = Random(seed).one_in(2) ? std::array<std::size_t, 3>{1, 2, 0} : std::array<std::size_t, 3>{2, 0, 1};
  return moved_by(c, m);
}

}  // namespace nearmiss::metamorphic
