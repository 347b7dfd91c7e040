/// The function takes a triangle with prepared edges.
#pragma once

#include <collide/closest_point_triangle_perimeter_edges.hpp>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/closest_point_triangle_perimeter_edges.hpp"

namespace nearmiss::adapters {

NEARMISS_COLLIDE_ARGUMENTS(closest_point_triangle_perimeter_edges, collide::prepare_triangle_edges<Tier>(q.triangle),
                           q.point)

}  // namespace nearmiss::adapters
