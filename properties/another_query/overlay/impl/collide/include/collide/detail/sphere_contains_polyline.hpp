/// How collide/sphere_contains_polyline.hpp is computed.
#pragma once

#include <collide/answers.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(sphere_contains_polyline)

namespace kernels {

/// A ball is convex: it contains the segments whose ends it contains.
template <class Tier, class T>
Decision<T> sphere_contains_polyline(const Sphere<T>& sphere, const Polyline<T>& polyline) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(sphere_contains_polyline, sphere, polyline);
  } else {
    for (const Vec3<T>& vertex : polyline.vertices) {
      const Vec3<T> m = vertex - sphere.center;
      if (Tier::dot(m, m) > sphere.radius * sphere.radius) return {false};
    }
    return {true};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
