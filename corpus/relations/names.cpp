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
    for (const Layout::Part& p : query.layout.parts) {
      if (p.is_vector() && p.role == Role::weight) {
        for (std::size_t k = 0; k < 3; ++k) carry(a, p.begin + k, own, p.begin + (k + 1) % 3);
      } else if (p.name == "edge") {
        if (const int edge = as_index(own.values[p.begin]); edge >= 0) a.values[p.begin] = double((edge + 2) % 3);
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
    for (const Layout::Part& p : query.layout.parts) {
      if (p.name == "edge") a.values[p.begin] = 2 - own.values[p.begin];
      if (!p.is_vector() || p.role != Role::weight) continue;
      carry(a, p.begin + 1, own, p.begin + 2);
      carry(a, p.begin + 2, own, p.begin + 1);
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
    for (const Layout::Part& p : query.layout.parts) {
      if (p.name == "point1" || p.name == "point2") {
        const Layout::Part* twin = query.layout.at(p.name == "point1" ? "point2" : "point1");
        for (std::size_t k = 0; k < 3; ++k) carry(a, p.begin + k, own, twin->begin + k);
      } else if (p.role == Role::normal) {
        for (std::size_t i = p.begin; i < p.end; ++i) a.values[i] = -own.values[i];
      } else if (p.role == Role::index) {
        if (const int axis = as_index(own.values[p.begin]); axis >= 0) a.values[p.begin] = swapped_box_axis(axis);
      } else if ((p.name == "contact" && query.traits.contact_is_of_the_first) ||  // of the other sphere
                 query.traits.frame == OutputFrame::order_of_operands) {           // a cross product changes its sign
        a = without(a, p);
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
