/// An unlimited motion is a limit of infinity.
#pragma once

#include <limits>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/moving_sphere_passes_box.hpp"

namespace nearmiss::adapters {

NEARMISS_COLLIDE_ARGUMENTS(moving_sphere_passes_box, q.sphere, q.velocity, q.box,
                           q.forever ? std::numeric_limits<T>::infinity() : q.limit)

}  // namespace nearmiss::adapters
