/// Shapes of a scene with places in space, and points of their surfaces. The numbers are the same on every machine:
/// only +, -, *, / and sqrt are used, which IEEE 754 rounds correctly.
#pragma once

#include <array>
#include <cstddef>

#include "corpus/generator/case_builder.hpp"
#include "corpus/scenes/scene_file.hpp"

namespace nearmiss::scenes {

using Vector = CaseBuilder::Numbers;

double dot(const Vector& a, const Vector& b);
Vector cross(const Vector& a, const Vector& b);
Vector scaled(const Vector& a, double factor);
double length_of(const Vector& a);

/// A vector of length 1, uniform over all directions.
Vector draw_direction(Random& random);
/// A vector of length 1 at a right angle to `axis`, which has length 1.
Vector draw_orthogonal(Random& random, const Vector& axis);
double draw_from(Random& random, const Spread& spread);

/// The hull of its corners thickened by a radius, or a box, or a plane through its center. The corners are relative to
/// the center.
struct Solid {
  Shape type = Shape::point;
  Vector center{};
  std::array<Vector, 4> corners{};
  std::size_t corner_count = 1;
  double radius = 0;
  Vector half{};                                                                     ///< of a box, along its axes
  std::array<double, 4> rotation = {0, 0, 0, 1};                                     ///< of a box: x, y, z, w
  std::array<Vector, 3> axes = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};  ///< of a plane: the normal first

  bool is_box() const { return type == Shape::box || type == Shape::aabox; }
  /// The radius of a ball around the center that contains it; 0 for a plane.
  double reach() const;
  /// The point of it that is furthest along the direction, which has length 1, relative to the center.
  Vector support(const Vector& direction) const;
};

/// A solid with its center at the origin. Of the boxes a quarter is upright, and a quarter turned about z alone.
Solid draw_solid(Random& random, const Shapes& shapes);

/// A point of the surface, relative to the center, and a normal there: no point of the solid is further along it.
struct SurfacePoint {
  Vector at, normal;
};
/// On a face, an edge or a vertex, each about equally often where the solid has it.
SurfacePoint draw_surface_point(Random& random, const Solid& solid);

}  // namespace nearmiss::scenes
