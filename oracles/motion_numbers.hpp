/// Where the motion of a case stands among its numbers.
#pragma once

#include <cstddef>
#include <optional>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The first numbers of a motion: of the place where it starts, and of its velocity or the direction of a ray.
struct MotionNumbers {
  std::size_t place, way;
};

/// Whether the output is the time at which a motion leaves a solid, which may be +infinity in a right answer: the
/// second time of a span.
inline bool is_time_of_leaving(const Query& query, std::size_t output) {
  const Layout::Part* first = query.layout.at(Role::time);
  return first != nullptr && query.outputs[output].role == Role::time && output != first->begin;
}

/// Empty where nothing moves.
inline std::optional<MotionNumbers> motion_numbers_of(const Case& c) {
  const Operands& parts = c.operands();
  if (!parts.start) return std::nullopt;
  if (!parts.velocities.empty()) return MotionNumbers{parts.start->place, parts.velocities[0]};
  if (!parts.directions.empty()) return MotionNumbers{parts.start->place, parts.directions[0]};
  return std::nullopt;
}

}  // namespace nearmiss
