/// Larger solids, balls inside solids, and longer limits: their answers must not become a miss, later or shallower.
#include <algorithm>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/relations/follow_ups.hpp"
#include "corpus/relations/operands.hpp"
#include "corpus/relations/recast.hpp"

namespace nearmiss::metamorphic {

namespace {

/// Compares a case with one that contains it.
Agreement not_later_nor_shallower(const Query& query, Scalar scalar, const Answer& small, const Answer& large) {
  if (small.yes && !large.yes) return Agreement::decisions_differ;
  for (std::size_t i = 0; i < query.outputs.size() && small.yes; ++i) {
    if (!small.gives(i) || !large.gives(i)) continue;
    const double a = small.values[i], b = large.values[i];
    const Role role = query.outputs[i].role;
    if (role == Role::time && b > a + slack(scalar, a, b)) return Agreement::numbers_differ;
    if (role == Role::depth && b < a - slack(scalar, a, b)) return Agreement::numbers_differ;
  }
  return Agreement::same;
}

bool yes_stays_yes(const Answer& own, const Answer& other) { return !own.yes || other.yes; }

Agreement no_fewer(const Answer& own, std::span<const Answer> others) {
  return yes_stays_yes(own, others[0]) ? Agreement::same : Agreement::decisions_differ;
}

/// The radius of the ball inside the solid, about the middle of a box or about an end of a capsule.
double inner_radius(const Case& c) {
  const std::vector<std::size_t>& sizes = c.operands()[1].sizes;
  double least = c.values[sizes[0]];
  for (const std::size_t i : sizes) least = std::min(least, c.values[i]);
  return least;
}

/// A point or another body without thickness that only touches may slide along a small solid and move away from a
/// larger one.
bool may_slide_away(const Case& c) {
  const Operand& mover = c.operands()[0];
  return mover.velocity && (!mover.radius || c.values[*mover.radius] == 0);
}

}  // namespace

std::optional<FollowUps> grown_size(const Case& c, std::uint64_t seed) {
  if (!c.query->traits.grows) return std::nullopt;
  Random random(seed);
  const std::size_t at = random.pick(c.operands().sizes);
  if (may_slide_away(c) && !c.operands()[0].has(at)) return std::nullopt;
  Case other = c;
  const double x = c.values[at], more = x == 0 ? random.power_of_two(-8, 2) : x * random.power_of_two(-8, 2);
  other.values[at] = rounded_to(c.scalar, x + more);
  if (!(other.values[at] > x) || !valid(other)) return std::nullopt;
  const Query& query = *c.query;
  const Scalar scalar = c.scalar;
  return ordered({std::move(other)}, [&query, scalar](const Answer& own, std::span<const Answer> others) {
    return not_later_nor_shallower(query, scalar, own, others[0]);
  });
}

/// With a larger radius of a sphere or a capsule, the distance is smaller by as much.
std::optional<FollowUps> grown_radius(const Case& c, std::uint64_t seed) {
  const std::size_t distance = signed_distance_of(*c.query);
  std::vector<std::size_t> radii;
  for (const Operand& o : c.operands()) {
    if (o.radius) radii.push_back(*o.radius);
  }
  if (distance == c.query->outputs.size() || radii.empty()) return std::nullopt;
  Random random(seed);
  const std::size_t at = random.pick(radii);
  Case other = c;
  const double r = c.values[at], more = r == 0 ? random.power_of_two(-8, 2) : r * random.power_of_two(-8, 2);
  other.values[at] = rounded_to(c.scalar, r + more);
  if (!(other.values[at] > r) || !valid(other)) return std::nullopt;
  const double grown = other.values[at] - r;
  return ordered({std::move(other)}, [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
    if (!own.gives(distance) || !others[0].gives(distance)) return Agreement::same;
    const double before = own.values[distance], after = others[0].values[distance];
    if (!std::isfinite(before) || !std::isfinite(after)) return Agreement::same;  // beyond the scalar's range
    return std::abs(before - grown - after) <= slack(scalar, before, after) ? Agreement::same
                                                                            : Agreement::numbers_differ;
  });
}

/// A motion that misses a box or a capsule misses a ball inside it, and hits the ball no earlier.
std::optional<FollowUps> contained_ball(const Case& c, std::uint64_t) {
  const Link* link = link_of(c, Link::Kind::contained_ball);
  if (link == nullptr || may_slide_away(c)) return std::nullopt;
  Case other = recast(c, *link);
  other.values[other.operands()[1].radius.value()] = inner_radius(c);  // the ball is fixed
  const bool impact = c.query->kind == Kind::impact;
  const std::size_t ours = time_of(*c.query), theirs = time_of(*other.query);
  return ordered({std::move(other)}, [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
    if (!yes_stays_yes(others[0], own)) return Agreement::decisions_differ;
    if (!others[0].yes || !impact || !own.gives(ours) || !others[0].gives(theirs)) return Agreement::same;
    const double outer = own.values[ours], inner = others[0].values[theirs];
    return outer <= inner + slack(scalar, outer, inner) ? Agreement::same : Agreement::numbers_differ;
  });
}

std::optional<FollowUps> longer_limit(const Case& c, std::uint64_t seed) {
  if (!has(c, "limit")) return std::nullopt;
  Random random(seed);
  Case other = c;
  if (random.one_in(3)) {
    value(other, "forever") = 1;
  } else {
    value(other, "limit") = rounded_to(c.scalar, value(c, "limit") + random.power_of_two(-10, 4));
  }
  if (!valid(other) || other.values == c.values) return std::nullopt;
  return ordered({std::move(other)}, no_fewer);
}

}  // namespace nearmiss::metamorphic
