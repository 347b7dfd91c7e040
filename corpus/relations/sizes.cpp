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
  if (!has(c, "box.half.x")) return value(c, "capsule.radius");
  return std::min({value(c, "box.half.x"), value(c, "box.half.y"), value(c, "box.half.z")});
}

/// "fixed" of "fixed.center": the operand that is the ball.
std::string ball_of(const Link& link) {
  constexpr std::string_view center = ".center";
  for (const Link::Renamed& r : link.renamed) {
    if (r.there.ends_with(center)) return std::string(r.there.substr(0, r.there.size() - center.size()));
  }
  return {};
}

/// A sphere of radius 0 that only touches may slide along a small solid and move away from a larger one.
bool may_slide_away(const Case& c) { return has(c, "velocity.x") && value(c, "sphere.radius") == 0; }

}  // namespace

std::optional<FollowUps> grown_size(const Case& c, std::uint64_t seed) {
  if (!c.query->traits.grows) return std::nullopt;
  Random random(seed);
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.query->inputs[i].role == Role::size) sizes.push_back(i);
  }
  const std::size_t at = random.pick(sizes);
  if (may_slide_away(c) && c.query->inputs[at].name != "sphere.radius") return std::nullopt;
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

/// A motion that misses a box or a capsule misses a ball inside it, and hits the ball no earlier.
std::optional<FollowUps> contained_ball(const Case& c, std::uint64_t) {
  const Link* link = link_of(c, Link::Kind::contained_ball);
  if (link == nullptr || may_slide_away(c)) return std::nullopt;
  Case other = recast(c, *link);
  value(other, ball_of(*link) + ".radius") = inner_radius(c);
  const bool impact = c.query->kind == Kind::impact;
  const std::size_t ours = index_of(c.query->outputs, "time"), theirs = index_of(other.query->outputs, "time");
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
