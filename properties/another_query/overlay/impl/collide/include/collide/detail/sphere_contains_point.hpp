/// How collide/sphere_contains_point.hpp is computed.
#pragma once

#include <collide/answers.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(sphere_contains_point)

namespace kernels {

template <class Tier, class T>
Decision<T> sphere_contains_point(const Sphere<T>& sphere, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(sphere_contains_point, sphere, point);
  } else {
    const Vec3<T> m = point - sphere.center;
    return {Tier::dot(m, m) <= sphere.radius * sphere.radius};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
