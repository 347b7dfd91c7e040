/// Cases moved to where numbers run out: along axes that a person can plot.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// What is changed about a scene whose sizes and distances are about 1.
enum class SweepAxis {
  offset,  ///< everything this far from the origin, in sizes
  scale,   ///< all lengths times a power of two, whose exponent is the value
  speed,   ///< velocities times this, times divided by it
  ratio,   ///< the first thing's sizes times this
  angle,   ///< a turn or a velocity this far from parallel to an axis, an edge or another direction, in radians
};
struct SweepAxisName {
  std::string_view name, unit;
};
SweepAxisName name_of(SweepAxis axis);
/// Where the axis is sampled, from the mildest value to the most extreme one; `scale` from low to high.
std::span<const double> values_of(SweepAxis axis);

/// Two axes that say something about the query.
struct SweepPlane {
  SweepAxis x, y;
};
std::vector<SweepPlane> planes_of(const Query& query);

/// The `index`-th generated case of the stream `seed`, moved to a place on the plane. The same on every machine.
/// Empty where its numbers are not finite in the scalar, all its lengths vanish, or they break a rule of the query.
std::optional<Case> sweep_case(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index,
                               const SweepPlane& plane, double x, double y);

}  // namespace nearmiss
