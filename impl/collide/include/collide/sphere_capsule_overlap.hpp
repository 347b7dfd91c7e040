/// Whether a sphere and a capsule overlap.
#pragma once

#include <collide/detail/overlaps.hpp>

namespace collide {

/// Whether the closed ball and the closed capsule meet. Touching is an overlap. A radius of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps.hpp.
COLLIDE_OVERLAP(sphere_capsule_overlap, Sphere, sphere, Capsule, capsule)

}  // namespace collide
