/// The queries that have a batch form, as types: each calls the query of its name in the tier `Fast`.
#pragma once

#include <collide/box_box_conservative.hpp>
#include <collide/capsule_capsule_overlap.hpp>
#include <collide/capsule_capsule_signed_distance.hpp>
#include <collide/closest_point_segment.hpp>
#include <collide/closest_points_lines.hpp>
#include <collide/moving_point_aabox.hpp>
#include <collide/moving_point_plane.hpp>
#include <collide/moving_point_sphere.hpp>
#include <collide/moving_point_triangle.hpp>
#include <collide/moving_sphere_passes_sphere.hpp>
#include <collide/moving_sphere_plane.hpp>
#include <collide/moving_sphere_sphere.hpp>
#include <collide/point_capsule_overlap.hpp>
#include <collide/point_capsule_signed_distance.hpp>
#include <collide/point_segment_signed_distance.hpp>
#include <collide/point_sphere_overlap.hpp>
#include <collide/point_sphere_signed_distance.hpp>
#include <collide/ray_aabox.hpp>
#include <collide/segment_capsule_overlap.hpp>
#include <collide/segment_capsule_signed_distance.hpp>
#include <collide/segment_segment_signed_distance.hpp>
#include <collide/sphere_box_overlap.hpp>
#include <collide/sphere_capsule_overlap.hpp>
#include <collide/sphere_capsule_signed_distance.hpp>
#include <collide/sphere_plane_penetration.hpp>
#include <collide/sphere_segment_overlap.hpp>
#include <collide/sphere_segment_signed_distance.hpp>
#include <collide/sphere_sphere_overlap.hpp>
#include <collide/sphere_sphere_penetration.hpp>
#include <collide/sphere_sphere_signed_distance.hpp>
#include <collide/sphere_triangle_overlap.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail::batched {

#define COLLIDE_BATCHED(query)                              \
  struct query {                                            \
    template <class... A>                                   \
    auto operator()(const A&... arguments) const noexcept { \
      return collide::query<Fast>(arguments...);            \
    }                                                       \
  };
COLLIDE_BATCHED(box_box_conservative)
COLLIDE_BATCHED(capsule_capsule_overlap)
COLLIDE_BATCHED(capsule_capsule_signed_distance)
COLLIDE_BATCHED(closest_point_segment)
COLLIDE_BATCHED(closest_points_lines)
COLLIDE_BATCHED(moving_point_aabox)
COLLIDE_BATCHED(moving_point_plane)
COLLIDE_BATCHED(moving_point_sphere)
COLLIDE_BATCHED(moving_point_triangle)
COLLIDE_BATCHED(moving_sphere_passes_sphere)
COLLIDE_BATCHED(moving_sphere_plane)
COLLIDE_BATCHED(moving_sphere_sphere)
COLLIDE_BATCHED(point_capsule_overlap)
COLLIDE_BATCHED(point_capsule_signed_distance)
COLLIDE_BATCHED(point_segment_signed_distance)
COLLIDE_BATCHED(point_sphere_overlap)
COLLIDE_BATCHED(point_sphere_signed_distance)
COLLIDE_BATCHED(segment_capsule_overlap)
COLLIDE_BATCHED(segment_capsule_signed_distance)
COLLIDE_BATCHED(segment_segment_signed_distance)
COLLIDE_BATCHED(sphere_box_overlap)
COLLIDE_BATCHED(sphere_capsule_overlap)
COLLIDE_BATCHED(sphere_capsule_signed_distance)
COLLIDE_BATCHED(sphere_plane_penetration)
COLLIDE_BATCHED(sphere_segment_overlap)
COLLIDE_BATCHED(sphere_segment_signed_distance)
COLLIDE_BATCHED(sphere_sphere_overlap)
COLLIDE_BATCHED(sphere_sphere_penetration)
COLLIDE_BATCHED(sphere_sphere_signed_distance)
COLLIDE_BATCHED(sphere_triangle_overlap)
#undef COLLIDE_BATCHED

struct ray_aabox {
  template <class T>
  auto operator()(const Ray<T>& ray, const AABox<T>& aabox) const noexcept {
    return collide::ray_aabox<Fast>(prepare_ray(ray), prepare_aabox(aabox));
  }
};

}  // namespace collide::detail::batched

#include <collide/detail/strict_end.hpp>
