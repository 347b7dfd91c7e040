/// How collide/sphere_contains_point.hpp is computed.
#pragma once

#include <collide/answers.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace compiled {

template <class Tier, class T>
Decision<T> sphere_contains_point(const Sphere<T>& sphere, const Vec3<T>& point);

}  // namespace compiled

namespace kernels {

template <class Tier, class T>
Decision<T> sphere_contains_point(const Sphere<T>& sphere, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift(
        [](auto arithmetic, const auto&... a) { return kernels::sphere_contains_point<decltype(arithmetic)>(a...); },
        sphere, point);
  } else {
    const Vec3<T> m = point - sphere.center;
    return {Tier::dot(m, m) <= sphere.radius * sphere.radius};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
