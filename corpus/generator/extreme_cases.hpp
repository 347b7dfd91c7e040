/// Cases moved along plottable axes toward the limits of floating-point numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The parameter that changes in a case whose sizes and distances are about 1.
enum class ExtremeAxis {
  offset,  ///< distance of all shapes from the origin, in sizes
  scale,   ///< all lengths times a power of two; the value is the exponent
  speed,   ///< velocities times this, times divided by it
  ratio,   ///< the first operand's sizes times this
  angle,   ///< deviation, in radians, of a rotation or velocity from parallel to an axis, an edge or another direction
};
struct ExtremeAxisName {
  std::string_view name, unit;
};
ExtremeAxisName name_of(ExtremeAxis axis);
/// The samples of the axis, from the mildest value to the most extreme one; `scale` from low to high.
std::span<const double> values_of(ExtremeAxis axis);

/// Two axes that are meaningful for the query.
struct ExtremePlane {
  ExtremeAxis x, y;
};
std::vector<ExtremePlane> planes_of(const Query& query);

/// The `index`-th generated case of the stream `seed`, moved to a point of the plane. The same on every machine. Empty
/// if its numbers are not finite in the scalar, all its lengths vanish, or they break a rule of the query.
std::optional<Case> extreme_case(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index,
                                 const ExtremePlane& plane, double x, double y);

}  // namespace nearmiss
