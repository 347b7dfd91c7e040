/// Translations, and rotations by integer quaternions.
#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/relations/exact_sums.hpp"
#include "corpus/relations/follow_ups.hpp"
#include "corpus/relations/operands.hpp"

namespace nearmiss::metamorphic {

namespace {

using Vector = std::array<double, 3>;

/// Adds `shift` to every position and moves planes with it; false if that is not exact.
bool translate(Case& c, const Vector& shift) {
  for (const Operand& o : c.operands()) {
    for (const std::size_t i : o.positions) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto sum = exact_sum(c.values[i + k], shift[k], c.scalar);
        if (!sum) return false;
        c.values[i + k] = *sum;
      }
    }
    for (std::size_t k = 0; o.offset && k < 3; ++k) {
      const auto moved = exact_step(c.values[*o.offset], -c.values[*o.direction + k], shift[k], c.scalar);
      if (!moved) return false;
      c.values[*o.offset] = *moved;
    }
  }
  return true;
}

}  // namespace

std::optional<FollowUps> translated(const Case& c, std::uint64_t seed) {
  Random random(seed);
  const double unit = random.power_of_two(-2, c.scalar == Scalar::float32 ? 6 : 20);
  for (const double step : {unit, 1.0, 0.5}) {  // a coarser one if the finer one is not exact
    Vector shift;
    for (double& x : shift) x = step * random.between(-8, 8);
    Case other = c;
    if (shift == Vector{} || !translate(other, shift) || other.values == c.values) continue;
    const Query& query = *c.query;
    auto follow_ups = counterpart_if_valid(std::move(other), [&query, shift](Answer a) {
      for (const Layout::Part& p : query.layout.parts) {
        const bool place = p.role == Role::position && query.kind != Kind::measure;
        if (!place || !p.is_vector()) continue;
        // Zero stands for no place if there is no contact, and for a corner in front.
        if (!a.yes || p.is_entry) a = without(a, p);
        for (std::size_t k = 0; k < 3; ++k) {
          double& x = a.values[p.begin + k];
          if (x + shift[k] - shift[k] != x) a = without(a, p.begin + k);
          x += shift[k];
        }
      }
      return a;
    });
    if (follow_ups) follow_ups->image_keeps_ulps = false;
    return follow_ups;
  }
  return std::nullopt;
}

namespace {

/// A rotation whose matrix, times `factor`, has integer entries.
struct WholeRotation {
  std::array<int, 4> quaternion{};  ///< x, y, z, w
  int factor = 0;                   ///< its squared length
  std::array<std::array<int, 3>, 3> rows{};
};

WholeRotation draw_whole_rotation(Random& random) {
  WholeRotation r;
  while (r.factor < 2) {
    for (int& k : r.quaternion) k = random.one_in(2) ? 0 : random.between(-3, 3);
    const auto [x, y, z, w] = r.quaternion;
    r.factor = x * x + y * y + z * z + w * w;
    r.rows = {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
               {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
               {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
  }
  return r;
}

/// The sum of factor times number, if the scalar holds every partial sum exactly.
template <std::size_t N>
std::optional<double> exact_combination(const std::array<int, N>& factors, const double* numbers, Scalar scalar) {
  double sum = 0;
  for (std::size_t k = 0; k < N; ++k) {
    const auto next = exact_step(sum, factors[k], numbers[k], scalar);
    if (!next) return std::nullopt;
    sum = *next;
  }
  return sum;
}

/// The case rotated and scaled by `factor`; empty if that is not exact.
std::optional<Case> turned(const Case& c, const WholeRotation& r) {
  Case other = c;
  const auto [a, b, d, w] = r.quaternion;  // the product of both, one row per component
  const std::array<std::array<int, 4>, 4> product{{{w, -d, b, a}, {d, w, -a, b}, {-b, a, w, d}, {-a, -b, -d, w}}};
  for (const InputMember& m : c.operands().members) {
    const double* numbers = &c.values[m.begin];
    for (std::size_t k = 0; k < m.count; ++k) {
      std::optional<double> x = numbers[k];
      switch (m.role) {
        case Role::position:
        case Role::velocity:
        case Role::direction: x = exact_combination(r.rows[k], numbers, c.scalar); break;
        case Role::rotation: x = exact_combination(product[k], numbers, c.scalar); break;
        case Role::size: x = exact_product(r.factor, numbers[k], c.scalar); break;
        case Role::offset: x = exact_product(r.factor * r.factor, numbers[k], c.scalar); break;
        default: break;
      }
      if (!x) return std::nullopt;
      other.values[m.begin + k] = *x;
    }
  }
  return other;
}

}  // namespace

std::optional<FollowUps> rotated(const Case& c, std::uint64_t seed) {
  // A projection along a coordinate axis, or an axis-aligned box, changes under rotation. Directions and normals are
  // not exact after rotation.
  const bool upright = c.operands().find(Shape::aabox) != nullptr;
  const Traits& traits = c.query->traits;
  const bool turns = !upright && !traits.projects && traits.frame != OutputFrame::operands;
  if (!turns || c.query->kind == Kind::direction) return std::nullopt;
  Random random(seed);
  const WholeRotation r = draw_whole_rotation(random);
  auto other = turned(c, r);
  if (!other) return std::nullopt;
  const Query& query = *c.query;
  auto follow_ups = counterpart_if_valid(std::move(*other), [&query, r, scalar = c.scalar](const Answer& own) {
    Answer a = own;
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      const Role role = query.outputs[i].role;
      std::optional<double> x = own.values[i];
      if (role == Role::position) {
        const std::size_t k = std::size_t(last(query.outputs[i].name)[0] - 'x');
        if (own.gives(i - k) && own.gives(i - k + 1) && own.gives(i - k + 2)) {
          x = exact_combination(r.rows[k], &own.values[i - k], scalar);
        } else {
          x = std::nullopt;
        }
      } else if (role == Role::depth || role == Role::distance) {
        x = exact_product(r.factor, own.values[i], scalar);
      } else if (role == Role::normal) {
        x = std::nullopt;
      }
      if (x)
        a.values[i] = *x;
      else
        a = without(a, i);
    }
    return a;
  });
  if (follow_ups) follow_ups->image_keeps_ulps = false;
  return follow_ups;
}

}  // namespace nearmiss::metamorphic
