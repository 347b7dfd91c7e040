/// Relations between different queries about the same operands, by the links of the catalogue.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "corpus/relations/follow_ups.hpp"
#include "corpus/relations/operands.hpp"
#include "corpus/relations/recast.hpp"

namespace nearmiss::metamorphic {

namespace {

bool is_part_of(std::string_view member, std::string_view name) {
  return !member.empty() && name.starts_with(member) && (name.size() == member.size() || name[member.size()] == '.');
}

/// The same answer in the members that both answer types have under the same name.
FollowUps same_answer(const Case& c, const Link& link) {
  Case other = recast(c, link);
  const Query &from = *c.query, &to = *other.query;
  FollowUps follow_ups = counterpart(std::move(other), [&from, &to, except = link.except](const Answer& own) {
    Answer a = own;
    for (std::size_t i = 0; i < to.outputs.size(); ++i) {
      const std::size_t at = index_of(from.outputs, to.outputs[i].name);
      const bool excepted = std::any_of(except.begin(), except.end(), [&](std::string_view member) {
        return is_part_of(member, to.outputs[i].name);
      });
      if (at == from.outputs.size() || excepted) {
        a = without(a, i);
      } else {
        carry(a, i, own, at);
      }
    }
    return a;
  });
  // If one answer has fewer numbers, fewer changes of the input make the answer right.
  follow_ups.image_keeps_ulps = to.inputs.size() >= from.inputs.size();
  return follow_ups;
}

/// A hit of the first query is a hit of the second, no later; at the same time, unless it may be earlier.
FollowUps hit_at_the_same_time(const Case& c, const Link& link, bool or_earlier = false) {
  Case other = recast(c, link);
  const std::size_t ours = time_of(*c.query), theirs = time_of(*other.query);
  return ordered({std::move(other)}, [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
    if (!own.yes) return Agreement::same;
    if (!others[0].yes) return Agreement::decisions_differ;
    if (!own.gives(ours) || !others[0].gives(theirs)) return Agreement::same;
    const double t = own.values[ours], s = others[0].values[theirs];
    const bool alike = or_earlier ? s <= t + slack(scalar, s, t) : std::abs(s - t) <= slack(scalar, s, t);
    return alike ? Agreement::same : Agreement::numbers_differ;
  });
}

/// The two ends of the capsule are one point.
bool is_ball(const Case& c) {
  const Operand& capsule = *c.operands().find(Shape::capsule);
  return std::equal(&c.values[capsule.positions[0]], &c.values[capsule.positions[0]] + 3,
                    &c.values[capsule.positions[1]]);
}

bool box_has_no_extents(const Case& c) {
  const std::vector<std::size_t>& sizes = c.operands().find(Shape::box)->sizes;
  return std::all_of(sizes.begin(), sizes.end(), [&](std::size_t i) { return c.values[i] == 0; });
}

/// The times of the answers to two halves and to the whole, as far as they can be compared.
Agreement first_of_two(const Answer& own, std::span<const Answer> halves, std::size_t ours, std::size_t theirs,
                       Scalar scalar) {
  const auto tells = [theirs](const Answer& a) { return !a.yes || a.gives(theirs); };
  if (!own.yes || !own.gives(ours) || !tells(halves[0]) || !tells(halves[1])) return Agreement::same;
  const double t = own.values[ours], a = halves[0].values[theirs], b = halves[1].values[theirs];
  const double first = halves[0].yes && (!halves[1].yes || a < b) ? a : b;
  return std::abs(t - first) <= slack(scalar, t, first) ? Agreement::same : Agreement::numbers_differ;
}

}  // namespace

std::optional<FollowUps> prepared(const Case& c, std::uint64_t) {
  const Link* link = link_of(c, Link::Kind::prepared);
  return link == nullptr ? std::nullopt : std::optional(same_answer(c, *link));
}

/// A capsule whose ends coincide as a sphere, and a box without extents as a point. A capsule's inside may differ for a
/// point that starts there: then only the times are compared.
std::optional<FollowUps> one_point(const Case& c, std::uint64_t) {
  const Link* link = link_of(c, Link::Kind::capsule_as_sphere);
  if (link != nullptr && is_ball(c)) {
    return link->times_alone ? hit_at_the_same_time(c, *link) : same_answer(c, *link);
  }
  link = link_of(c, Link::Kind::box_as_point);
  if (link == nullptr || !box_has_no_extents(c)) return std::nullopt;
  return same_answer(c, *link);
}

/// A sphere of radius 0 as a point, and a point as such a sphere, which also hits the edges of a one-sided
/// shape.
std::optional<FollowUps> sphere_as_point(const Case& c, std::uint64_t) {
  if (const Link* link = link_of(c, Link::Kind::point_as_sphere)) return hit_at_the_same_time(c, *link, true);
  const Link* link = link_of(c, Link::Kind::sphere_as_point);
  if (link == nullptr || c.values[*c.operands()[0].radius] != 0) return std::nullopt;
  return same_answer(c, *link);
}

/// A rectangle is hit, or contains a point, if one of its triangles is hit or contains it.
std::optional<FollowUps> two_triangles(const Case& c, std::uint64_t) {
  const Link* link = link_of(c, Link::Kind::halves);
  if (link == nullptr) return std::nullopt;
  constexpr std::array<Link::Renamed, 1> first = {{{"triangle", "rectangle"}}};
  constexpr std::array<Link::Renamed, 3> second = {
      {{"triangle.v0", "rectangle.v0"}, {"triangle.v1", "rectangle.v2"}, {"triangle.v2", "rectangle.v3"}}};
  const bool impact = c.query->kind == Kind::impact;
  const std::size_t ours = time_of(*c.query), theirs = time_of(query_of(link->to));
  return ordered({recast(c, *link, first), recast(c, *link, second)},
                 [=, scalar = c.scalar](const Answer& own, std::span<const Answer> halves) {
                   if (own.yes != (halves[0].yes || halves[1].yes)) return Agreement::decisions_differ;
                   return impact ? first_of_two(own, halves, ours, theirs, scalar) : Agreement::same;
                 });
}

/// Two queries where the yes of one implies the yes of the other, or both are equal.
std::optional<FollowUps> same_decision(const Case& c, std::uint64_t) {
  std::vector<Case> others;
  std::vector<bool> both_ways;
  for (const Link& l : c.query->traits.links) {
    if (l.kind != Link::Kind::same_decision && l.kind != Link::Kind::implied_decision) continue;
    Case other = recast(c, l);
    if (!valid(other)) continue;
    others.push_back(std::move(other));
    both_ways.push_back(l.kind == Link::Kind::same_decision);
  }
  if (others.empty()) return std::nullopt;
  return ordered(std::move(others), [both_ways](const Answer& own, std::span<const Answer> answers) {
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (own.yes == answers[i].yes || (!own.yes && !both_ways[i])) continue;
      return Agreement::decisions_differ;
    }
    return Agreement::same;
  });
}

/// A distance of 0 may be one that is too small for the scalar.
std::optional<FollowUps> sign_of_distance(const Case& c, std::uint64_t) {
  const Link* link = link_of(c, Link::Kind::sign_of_distance);
  if (link == nullptr) return std::nullopt;
  const std::size_t at = index_of(c.query->outputs, "distance");
  return ordered({recast(c, *link)}, [at](const Answer& own, std::span<const Answer> others) {
    if (!own.gives(at) || !(own.values[at] < 0 || own.values[at] > 0)) return Agreement::same;
    return (own.values[at] < 0) == others[0].yes ? Agreement::same : Agreement::numbers_differ;
  });
}

/// The signed distance of two operands; of a plane, that of the half-space behind it. nullptr where there is none.
const Query* signed_distance_between(const Operands& operands) {
  const auto solid = [](Shape shape) { return shape == Shape::plane ? Shape::halfspace : shape; };
  return find_query(
      fmt::format("{}_{}_signed_distance", name_of(solid(operands[0].shape)), name_of(solid(operands[1].shape))));
}

/// A depth of overlap is the distance of the same two shapes below zero; of a plane, that of the half-space behind it.
/// Where the depth says that the shapes are apart, the distance is not below zero.
std::optional<FollowUps> depth_of_distance(const Case& c, std::uint64_t) {
  const Layout::Part* depth = c.query->layout.at(Role::depth);
  if (c.query->kind != Kind::depth || depth == nullptr || c.operands().size() != 2) return std::nullopt;
  const Query* const grid = signed_distance_between(c.operands());
  if (grid == nullptr) return std::nullopt;
  const std::size_t ours = depth->begin, theirs = signed_distance_of(*grid);
  Case other =
      recast(c, Link{.kind = Link::Kind::same_decision, .to = grid->id, .renamed = {{{"halfspace", "plane"}}}});
  return ordered({std::move(other)}, [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
    if (!own.gives(ours) || !others[0].gives(theirs)) return Agreement::same;
    const double deep = own.values[ours], distance = others[0].values[theirs];
    if (!std::isfinite(deep) || !std::isfinite(distance)) return Agreement::same;  // beyond the scalar's range
    const bool alike = own.yes ? std::abs(deep + distance) <= slack(scalar, deep, distance) : !(distance < 0);
    return alike ? Agreement::same : Agreement::numbers_differ;
  });
}

/// No point of a shape that is translated moves further than the speed times the time.
std::optional<FollowUps> gap_before_contact(const Case& c, std::uint64_t) {
  const Operands& shapes = c.operands();
  if (c.query->kind != Kind::impact || shapes.size() != 2 || !shapes[0].velocity) return std::nullopt;
  const Query* const grid = signed_distance_between(shapes);
  if (grid == nullptr) return std::nullopt;
  Case start{grid, c.scalar, {}, c.origin, c.seed, c.index, c.moves};
  for (const Operand& o : shapes)
    start.values.insert(start.values.end(), &c.values[o.begin], &c.values[o.begin] + o.count);
  const double* const velocity = &c.values[*shapes[0].velocity];
  const long double speed = std::hypot(static_cast<long double>(velocity[0]), static_cast<long double>(velocity[1]),
                                       static_cast<long double>(velocity[2]));
  const std::size_t time = time_of(*c.query), distance = signed_distance_of(*grid);
  return ordered({std::move(start)}, [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
    if (!own.yes || !own.gives(time) || !others[0].gives(distance)) return Agreement::same;
    const double way = double(speed * own.values[time]), gap = others[0].values[distance];
    if (!std::isfinite(way) || !std::isfinite(gap)) return Agreement::same;  // beyond the scalar's range
    return way >= gap - slack(scalar, way, gap) ? Agreement::same : Agreement::numbers_differ;
  });
}

/// The closest point of a segment is as far from the point as the segment.
std::optional<FollowUps> distance_of_closest(const Case& c, std::uint64_t) {
  const Operands& shapes = c.operands();
  const Operand *segment = shapes.find(Shape::segment), *point = shapes.find(Shape::point);
  if (c.query->kind != Kind::points || shapes.size() != 2 || segment == nullptr || point == nullptr)
    return std::nullopt;
  const std::size_t closest = index_of(c.query->outputs, "point.x");
  if (closest == c.query->outputs.size()) return std::nullopt;
  const Query& grid = *find_query("point_segment_signed_distance");
  const std::size_t theirs = signed_distance_of(grid);
  const double* at = &c.values[point->begin];
  const std::array<double, 3> from{at[0], at[1], at[2]};
  Case other = recast(c, Link{.kind = Link::Kind::same_decision, .to = grid.id});
  return ordered({std::move(other)}, [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
    if (!others[0].gives(theirs) || !own.gives(closest)) return Agreement::same;
    long double square = 0, largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const long double x = own.values[closest + k], off = x - from[k];
      square += off * off, largest = std::max(largest, std::abs(x));
    }
    const double away = double(std::sqrt(square)), distance = others[0].values[theirs];
    if (!std::isfinite(away) || !std::isfinite(distance)) return Agreement::same;  // beyond the scalar's range
    return std::abs(away - distance) <= slack(scalar, double(largest), distance) ? Agreement::same
                                                                                 : Agreement::numbers_differ;
  });
}

/// If a motion hits, it passes through.
std::optional<FollowUps> hits_pass(const Case& c, std::uint64_t) {
  const Link* link = link_of(c, Link::Kind::within_any_time);
  if (link == nullptr) return std::nullopt;
  return ordered({recast(c, *link)}, [](const Answer& own, std::span<const Answer> others) {
    return own.yes && !others[0].yes ? Agreement::decisions_differ : Agreement::same;
  });
}

/// A point hits a flat one-sided shape from at most one of its two sides.
std::optional<FollowUps> other_side(const Case& c, std::uint64_t) {
  const Operands& operands = c.operands();
  const bool is_of_point = operands[0].shape == Shape::point && operands.rectangles.empty();
  if (!c.query->traits.one_sided || !is_of_point) return std::nullopt;
  Case other = c;
  if (const Operand* plane = operands.find(Shape::plane)) {
    for (std::size_t i = plane->begin; i < plane->begin + plane->count; ++i) other.values[i] = -c.values[i];
  }
  reverse_corners(other);
  return ordered({std::move(other)}, [](const Answer& own, std::span<const Answer> others) {
    return own.yes && others[0].yes ? Agreement::decisions_differ : Agreement::same;
  });
}

}  // namespace nearmiss::metamorphic
