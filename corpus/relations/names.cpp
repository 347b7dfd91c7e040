/// Relations that rename operands: corners in another order, operands exchanged, directions reversed, hints changed.
#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/relations/follow_ups.hpp"
#include "corpus/relations/operands.hpp"

namespace nearmiss::metamorphic {

namespace {

int swapped_box_axis(int axis) {
  if (axis < 0 || axis > 14) return axis;
  if (axis < 6) return (axis + 3) % 6;
  return 6 + 3 * ((axis - 6) % 3) + (axis - 6) / 3;
}

bool nearly_parallel_directions(const Case& c) {
  const double *a = &c.values[c.operands().directions.at(0)], *b = &c.values[c.operands().directions.at(1)];
  const long double ax = a[0], ay = a[1], az = a[2], bx = b[0], by = b[1], bz = b[2];
  const long double cx = ay * bz - az * by, cy = az * bx - ax * bz, cz = ax * by - ay * bx;
  constexpr long double beyond_rounding = 0x1p-40L;
  return cx * cx + cy * cy + cz * cz <= beyond_rounding * (ax * ax + ay * ay + az * az) * (bx * bx + by * by + bz * bz);
}

struct Range {
  std::size_t begin, count;
};

/// Exchanges two ranges of numbers, which may differ in their lengths; `one` comes first.
void exchange_ranges(std::vector<double>& values, Range one, Range two) {
  const auto at = [&](std::size_t i) { return values.begin() + std::ptrdiff_t(i); };
  std::vector<double> exchanged(at(0), at(one.begin));
  const auto add = [&](std::size_t begin, std::size_t end) { exchanged.insert(exchanged.end(), at(begin), at(end)); };
  add(two.begin, two.begin + two.count);
  add(one.begin + one.count, two.begin);
  add(one.begin, one.begin + one.count);
  add(two.begin + two.count, values.size());
  values = std::move(exchanged);
}

}  // namespace

std::optional<FollowUps> turned_corners(const Case& c, std::uint64_t) {
  Case other = c;
  for (const Operand& o : c.operands()) {
    if (o.shape == Shape::triangle) reorder(other, o, {1, 2, 0});
    if (o.shape == Shape::rectangle) reorder(other, o, {2, 3, 0, 1});
    if (o.shape == Shape::segment || o.shape == Shape::capsule) reorder(other, o, {1, 0});
  }
  if (other.values == c.values) return std::nullopt;
  const Query& query = *c.query;
  return counterpart(std::move(other), [&query](const Answer& own) {
    Answer a = own;
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      if (vector_at(query.outputs, i) && query.outputs[i].role == Role::weight) {
        for (std::size_t k = 0; k < 3; ++k) carry(a, i + k, own, i + (k + 1) % 3);
      } else if (query.outputs[i].name == "edge") {
        if (const int edge = as_index(own.values[i]); edge >= 0) a.values[i] = double((edge + 2) % 3);
      }
    }
    return a;
  });
}

/// Reverses the corners of a shape that has no front.
std::optional<FollowUps> reversed_corners(const Case& c, std::uint64_t) {
  if (c.query->traits.one_sided) return std::nullopt;
  Case other = c;
  reverse_corners(other);
  if (other.values == c.values) return std::nullopt;
  const Query& query = *c.query;
  return counterpart(std::move(other), [&query](const Answer& own) {
    Answer a = own;
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      if (query.outputs[i].name == "edge") a.values[i] = 2 - own.values[i];
      if (query.outputs[i].name == "weights.y") carry(a, i, own, i + 1);
      if (query.outputs[i].name == "weights.z") carry(a, i, own, i - 1);
    }
    return a;
  });
}

/// Exchanges the two operands.
std::optional<FollowUps> swapped(const Case& c, std::uint64_t) {
  const Query& query = *c.query;
  const Exchange allowed = query.traits.exchange;
  if (allowed == Exchange::none) return std::nullopt;
  if (allowed == Exchange::unless_nearly_parallel && nearly_parallel_directions(c)) return std::nullopt;
  Case other = c;
  const Operand &one = c.operands()[0], &two = c.operands()[1];
  exchange_ranges(other.values, {one.begin, one.count}, {two.begin, two.count});
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (other.role(i) == Role::index) other.values[i] = swapped_box_axis(int(other.values[i]));
  }
  return counterpart(std::move(other), [&query](const Answer& own) {
    Answer a = own;
    const auto& out = query.outputs;
    const std::size_t point2 = index_of(out, "point2.x");
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (out[i].name.starts_with("point1.")) {
        const std::size_t twin = point2 + i - index_of(out, "point1.x");
        carry(a, i, own, twin);
        carry(a, twin, own, i);
      } else if (out[i].role == Role::normal) {
        a.values[i] = -own.values[i];
      } else if (out[i].role == Role::index) {
        if (const int axis = as_index(own.values[i]); axis >= 0) a.values[i] = swapped_box_axis(axis);
      } else if (out[i].name.starts_with("contact.") && query.traits.contact_is_of_the_first) {
        a = without(a, i);  // of the other sphere
      } else if (query.traits.frame == OutputFrame::order_of_operands) {
        a = without(a, i);  // a cross product changes its sign
      }
    }
    return a;
  });
}

/// Reverses a direction that only names a line or an axis.
std::optional<FollowUps> reversed_directions(const Case& c, std::uint64_t) {
  if (!c.query->traits.directions_are_lines) return std::nullopt;
  Case other = c;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == Role::direction) other.values[i] = -c.values[i];
  }
  return counterpart(std::move(other), [](const Answer& a) { return a; });
}

std::optional<FollowUps> another_hint(const Case& c, std::uint64_t seed) {
  if (!has(c, "hint")) return std::nullopt;
  Case other = c;
  value(other, "hint") = Random(seed).between(-1, 14);
  const Query& query = *c.query;
  return counterpart(std::move(other), [&query](Answer a) {
    // If the boxes are apart, any axis that separates them is right, with the separation along it.
    for (std::size_t i = 0; i < query.outputs.size() && !a.yes; ++i) a = without(a, i);
    return a;
  });
}

}  // namespace nearmiss::metamorphic
