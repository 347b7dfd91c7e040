/// Whether a sphere and a segment overlap.
#pragma once

#include <collide/detail/overlaps_of_axes.hpp>

namespace collide {

/// Whether the closed ball and the segment meet. Touching is an overlap. A radius of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_axes.hpp.
COLLIDE_OVERLAP_OF_AXES(sphere_segment_overlap, Sphere, sphere, Segment, segment)

}  // namespace collide
