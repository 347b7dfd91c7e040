/// All of collide except the batches (batch.hpp), which include the instructions of the processor, and the tier
/// `Certified`, which needs GMP and MPFR (certified.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/checked.hpp>
#include <collide/contract.hpp>
#include <collide/members.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>
#include <collide/vec3.hpp>
#include <collide/version.hpp>

// The queries.
#include <collide/aabox_triangle_overlap.hpp>
#include <collide/bounce_direction.hpp>
#include <collide/box_box_conservative.hpp>
#include <collide/box_box_info.hpp>
#include <collide/box_box_overlap.hpp>
#include <collide/box_box_parallel_axis.hpp>
#include <collide/box_box_penetration.hpp>
#include <collide/box_box_projected_distance.hpp>
#include <collide/box_box_separating_axis.hpp>
#include <collide/box_plane_penetration.hpp>
#include <collide/closest_point_rectangle.hpp>
#include <collide/closest_point_rectangle_perimeter.hpp>
#include <collide/closest_point_segment.hpp>
#include <collide/closest_point_segment_unit.hpp>
#include <collide/closest_point_triangle_perimeter.hpp>
#include <collide/closest_point_triangle_perimeter_edges.hpp>
#include <collide/closest_points_lines.hpp>
#include <collide/moving_point_aabox.hpp>
#include <collide/moving_point_box.hpp>
#include <collide/moving_point_capsule.hpp>
#include <collide/moving_point_plane.hpp>
#include <collide/moving_point_rectangle.hpp>
#include <collide/moving_point_sphere.hpp>
#include <collide/moving_point_triangle.hpp>
#include <collide/moving_point_triangle_prepared.hpp>
#include <collide/moving_sphere_box.hpp>
#include <collide/moving_sphere_capsule.hpp>
#include <collide/moving_sphere_passes_box.hpp>
#include <collide/moving_sphere_passes_sphere.hpp>
#include <collide/moving_sphere_plane.hpp>
#include <collide/moving_sphere_rectangle.hpp>
#include <collide/moving_sphere_sphere.hpp>
#include <collide/moving_sphere_triangle.hpp>
#include <collide/point_in_rectangle.hpp>
#include <collide/point_in_triangle.hpp>
#include <collide/ray_aabox.hpp>
#include <collide/slide_direction.hpp>
#include <collide/sphere_box_overlap.hpp>
#include <collide/sphere_box_penetration.hpp>
#include <collide/sphere_plane_penetration.hpp>
#include <collide/sphere_sphere_overlap.hpp>
#include <collide/sphere_sphere_penetration.hpp>
#include <collide/sphere_triangle_overlap.hpp>
