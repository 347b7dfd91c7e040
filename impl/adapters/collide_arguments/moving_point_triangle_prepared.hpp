/// The function takes a prepared triangle.
#pragma once

#include <collide/moving_point_triangle_prepared.hpp>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/moving_point_triangle_prepared.hpp"

namespace nearmiss::adapters {

NEARMISS_COLLIDE_ARGUMENTS(moving_point_triangle_prepared, q.point, q.velocity,
                           collide::prepare_triangle<Tier>(q.triangle))

}  // namespace nearmiss::adapters
