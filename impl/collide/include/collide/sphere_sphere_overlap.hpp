/// Whether two spheres overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_sphere_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed balls meet.
///
/// 1. sphere_sphere_overlap(a, b) == sphere_sphere_overlap(b, a)
/// 2. sphere_sphere_overlap(a, b) == (sphere_sphere_penetration(a, b).depth >= 0) in real numbers
template <class Tier = Fast, class T>
[[nodiscard]] Decision<T> sphere_sphere_overlap(const Sphere<T>& sphere1,
                                                const Sphere<T>& sphere2) noexcept(Tier::never_throws) {
  return kernels::sphere_sphere_overlap<Tier>(sphere1, sphere2);
}

namespace contracts {

/// First order, G the largest position: the distance carries half of 3 + 2 eps (at most 4 G, shared by two
/// centers: 5 eps G); the reach 1 eps and half of 2 eps of two radii: 4 eps of the largest.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_sphere_overlap() {
  return Tier::template contract<T>({.backward = 8, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
