/// The function takes a prepared segment.
#pragma once

#include <collide/closest_point_segment_unit.hpp>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/closest_point_segment_unit.hpp"

namespace nearmiss::adapters {

NEARMISS_COLLIDE_ARGUMENTS(closest_point_segment_unit, collide::prepare_segment<Tier>(q.segment), q.point)

}  // namespace nearmiss::adapters
