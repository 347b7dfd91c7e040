/// Whether two capsules overlap.
#pragma once

#include <collide/detail/overlaps_of_axes.hpp>

namespace collide {

/// Whether the two closed capsules meet. Touching is an overlap. A radius of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_axes.hpp.
COLLIDE_OVERLAP_OF_AXES(capsule_capsule_overlap, Capsule, capsule1, Capsule, capsule2)

}  // namespace collide
