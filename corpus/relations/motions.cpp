/// Relations in time: the same motion from a later start, and in parts.
#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/relations/exact_sums.hpp"
#include "corpus/relations/follow_ups.hpp"
#include "corpus/relations/operands.hpp"

namespace nearmiss::metamorphic {

namespace {

/// The case at a later time, if it is exact.
std::optional<Case> later(const Case& c, double time) {
  const Operand& mover = c.operands()[0];
  if (!mover.velocity) return std::nullopt;
  Case other = c;
  for (const std::size_t position : mover.positions) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto moved = exact_step(c.values[position + k], time, c.values[*mover.velocity + k], c.scalar);
      if (!moved) return std::nullopt;
      other.values[position + k] = *moved;
    }
  }
  return other;
}

}  // namespace

std::optional<FollowUps> later_start(const Case& c, std::uint64_t seed) {
  if (c.query->kind != Kind::impact) return std::nullopt;
  const double shift = Random(seed).power_of_two(-6, 0);
  const auto other = later(c, shift);
  if (!other || other->values == c.values) return std::nullopt;
  const std::size_t time = time_of(*c.query);
  const Scalar scalar = c.scalar;
  FollowUps follow_ups = ordered({*other}, [=](const Answer& own, std::span<const Answer> others) {
    const Answer& shifted = others[0];
    if (!own.yes) return shifted.yes ? Agreement::decisions_differ : Agreement::same;
    if (!own.gives(time)) return Agreement::same;
    const double t = own.values[time];
    if (t <= shift + slack(scalar, t, shift)) return Agreement::same;  // the later start may be after the contact
    if (!shifted.yes) return Agreement::decisions_differ;
    if (!shifted.gives(time)) return Agreement::same;
    const double s = shifted.values[time];
    return std::abs((t - shift) - s) <= slack(scalar, t, s) ? Agreement::same : Agreement::numbers_differ;
  });
  follow_ups.decisions_alone = false;  // the time tells from when on there is no contact
  return follow_ups;
}

std::optional<FollowUps> split_motion(const Case& c, std::uint64_t seed) {
  if (!has(c, "limit")) return std::nullopt;
  const double limit = value(c, "limit"), part = Random(seed).power_of_two(-6, 0);
  const bool forever = value(c, "forever") != 0;
  if (!forever && part > limit) return std::nullopt;
  const auto rest = exact_sum(limit, -part, c.scalar);
  auto second = later(c, part);
  if (!rest || !second) return std::nullopt;
  Case first = c;
  value(first, "limit") = part;
  value(first, "forever") = 0;
  value(*second, "limit") = forever ? limit : *rest;
  return ordered({first, *second}, [](const Answer& own, std::span<const Answer> others) {
    return own.yes == (others[0].yes || others[1].yes) ? Agreement::same : Agreement::decisions_differ;
  });
}

}  // namespace nearmiss::metamorphic
