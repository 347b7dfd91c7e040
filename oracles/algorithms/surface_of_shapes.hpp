/// Whether a place of the answer may lie on the surface of a shape of the grid.
#pragma once

#include "oracles/algorithms/rounded_polytopes.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

/// At the radius from the core, whose edges and vertices are those of a point or a segment.
template <class N, class Shape>
bool may_be_on_surface_of(const Shape& shape, const GivenPlace<N>& place) {
  const Core<N> core = core_of(shape);
  const N distance2 = distance2_of_segment(place, core.vertices.front(), core.vertices.back());
  return may_be_at_radius(place, distance2, core.radius);
}
template <class N>
bool may_be_on_surface_of(const collide::Triangle<N>& triangle, const GivenPlace<N>& place) {
  return may_be_on_triangle(place, triangle);
}
template <class N>
bool may_be_on_surface_of(const collide::Box<N>& box, const GivenPlace<N>& place) {
  return may_be_on_box(place, box);
}
template <class N>
bool may_be_on_surface_of(const collide::HalfSpace<N>& halfspace, const GivenPlace<N>& place) {
  return may_be_on_plane(place, halfspace);
}

}  // namespace nearmiss::oracle
