#include "reports/triage/hypotheses/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "corpus/generator/feature_regions.hpp"
#include "oracles/judge.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

/// The cases that do not meet a precondition.
std::string_view outside_of(Precondition p) {
  switch (p) {
    case Precondition::true_rectangle: return "four corners that are not those of a rectangle";
    case Precondition::unit_normal: return "a given normal that is not of unit length";
    case Precondition::unit_direction: return "a direction that is not of unit length";
    case Precondition::unit_quaternion: return "a quaternion that is not of unit length";
    case Precondition::starts_outside: return "a start in contact";
    case Precondition::moves: return "a velocity of zero";
    case Precondition::no_zero_sizes: return "a shape without extent";
  }
  return "?";
}

bool are_equal(const Case& c, std::size_t a, std::size_t b) {
  return std::equal(&c.values[a], &c.values[a] + 3, &c.values[b]);
}

/// Whether the number has the same meaning in every case of the query.
bool is_fixed(const Query& q, std::size_t number) { return number < q.numbers_before_lists(); }

/// Pairs of positions of different operands.
std::vector<std::pair<std::size_t, std::size_t>> places_of_two_operands(const Query& q) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const Operand& second : q.operands) {
    for (const std::size_t b : second.positions) {
      for (const Operand& first : q.operands) {
        if (first.begin >= second.begin) break;
        for (const std::size_t a : first.positions) {
          if (is_fixed(q, a) && is_fixed(q, b)) pairs.emplace_back(a, b);
        }
      }
    }
  }
  return pairs;
}

/// Where the vectors along which something moves begin: velocities, and directions of rays and lines.
std::vector<std::size_t> ways_of(const Query& q) {
  std::vector<std::size_t> ways = q.operands.velocities;
  ways.insert(ways.end(), q.operands.directions.begin(), q.operands.directions.end());
  std::erase_if(ways, [&](std::size_t way) { return !is_fixed(q, way); });
  return ways;
}

/// It is parallel to a plane of coordinates, but not zero.
bool is_along_axes(const Case& c, std::size_t way) {
  const auto zeros = std::count(&c.values[way], &c.values[way] + 3, 0.0);
  return zeros == 1 || zeros == 2;
}

/// Twice the area of a triangle times the height of a place over it, in doubles.
double height_over(const Case& c, const std::array<std::size_t, 3>& corners, std::size_t place) {
  std::array<double, 3> a{}, b{}, to{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double origin = c.values[corners[0] + k];
    a[k] = c.values[corners[1] + k] - origin, b[k] = c.values[corners[2] + k] - origin;
    to[k] = c.values[place + k] - origin;
  }
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k)
    height += to[k] * (a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
  return height;
}

/// Hits of the first operand from one side of a triangle, or of a rectangle: an implementation may leave them out.
void add_sides(std::vector<Region>& regions, const Query& query) {
  const auto& triangles = query.operands.triangles;
  if (triangles.empty() || !query.operands.aaboxes.empty() || !decides(query.kind)) return;
  const auto& corners = triangles.front();
  for (const auto& [a, b] : places_of_two_operands(query)) {
    if (b != corners[0]) continue;
    const std::string& of = query.operands.of_number(b)->name;
    regions.push_back({fmt::format("a hit from behind the {}", of),
                       [=, a = a](const Case& c) { return height_over(c, corners, a) < 0 && exact_decision(c); },
                       false});
    regions.push_back({fmt::format("a hit from in front of the {}", of),
                       [=, a = a](const Case& c) { return height_over(c, corners, a) > 0 && exact_decision(c); },
                       false});
    return;
  }
}

bool is_turned(const Case& c) {
  const auto& all = c.operands().quaternions;
  return std::any_of(all.begin(), all.end(),
                     [&](std::size_t i) { return c.values[i] != 0 || c.values[i + 1] != 0 || c.values[i + 2] != 0; });
}

}  // namespace

std::vector<Region> regions_of(const Query& query) {
  std::vector<Region> regions;
  for (std::size_t i = 0; i < query.numbers_before_lists(); ++i) {
    const Field& f = query.inputs[i];
    if (f.role == Role::size)
      regions.push_back({fmt::format("{} of zero", f.name), [i](const Case& c) { return c.values[i] == 0; }});
    if (f.role == Role::flag)
      regions.push_back({fmt::format("the flag {}", f.name), [i](const Case& c) { return c.values[i] != 0; }, false});
  }
  for (const auto& [a, b] : places_of_two_operands(query))
    regions.push_back({"two equal points", [a = a, b = b](const Case& c) { return are_equal(c, a, b); }});
  for (const std::size_t i : ways_of(query)) {
    regions.push_back({fmt::format("{} with a component of zero", query.operands.member_of(i).name),
                       [i](const Case& c) { return is_along_axes(c, i); }});
  }
  for (const auto& t : query.operands.triangles)
    regions.push_back({"a triangle with two equal corners", [t](const Case& c) {
                         return are_equal(c, t[0], t[1]) || are_equal(c, t[1], t[2]) || are_equal(c, t[0], t[2]);
                       }});
  for (const auto& s : query.operands.segments)
    regions.push_back({"a segment of one point", [s](const Case& c) { return are_equal(c, s[0], s[1]); }});
  for (const Precondition p : all_preconditions) {
    if (concerns(p, query))
      regions.push_back({std::string(outside_of(p)), [p](const Case& c) { return !meets(c, p); }});
  }
  for (const FeatureRegion r : {FeatureRegion::flat, FeatureRegion::parallel})
    regions.push_back({std::string(name_of(r)), [r](const Case& c) { return feature_regions_of(c).has(r); }});
  if (!query.operands.quaternions.empty()) regions.push_back({"a turned box", is_turned, false});
  add_sides(regions, query);
  return regions;
}

}  // namespace nearmiss
