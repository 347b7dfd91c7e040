/// The shapes of a case: where they are and how large, as a scene counts sizes (scenes::Shapes).
#pragma once

#include <vector>

#include "corpus/scenes/operands.hpp"
#include "corpus/scenes/solids.hpp"

namespace nearmiss::scenes {

/// A shape among the numbers of a case.
struct MeasuredShape {
  Vector center{};              ///< the mean of its points; the origin for a plane
  std::vector<double> stated;   ///< sizes that are numbers of the case: radii, half extents
  std::vector<double> derived;  ///< sizes that follow from its points: half of an axis, of a side, of a triangle's
                                ///< longest side, half extents between two corners
};
MeasuredShape measured_shape(const Case& c, const Operand& place);

/// Brings the sizes into the range, and keeps the center. An axis of length 0 becomes one along x. Rounds to the case's
/// scalar.
void resize_shape(Case& c, const Operand& place, double least, double most);
/// Moves the points of a shape. Rounds to the case's scalar.
void move_shape(Case& c, const Operand& place, const Vector& by);

/// Three numbers of the case.
Vector vector_at(const Case& c, std::size_t begin);
/// Writes three numbers, rounded to the case's scalar.
void put_vector(Case& c, std::size_t begin, const Vector& v);
/// The height of the point above a plane of the case, if the plane's normal has length 1.
double height_above(const Case& c, const Operand& plane, const Vector& point);

}  // namespace nearmiss::scenes
