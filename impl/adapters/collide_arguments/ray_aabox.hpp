/// The function takes a prepared ray and a prepared box.
#pragma once

#include <collide/ray_aabox.hpp>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/ray_aabox.hpp"

namespace nearmiss::adapters {

NEARMISS_COLLIDE_ARGUMENTS(ray_aabox, collide::prepare_ray<Tier>(q.ray), collide::prepare_aabox<Tier>(q.aabox))

}  // namespace nearmiss::adapters
