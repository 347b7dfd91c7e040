/// Whether two spheres overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_sphere_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed balls meet. Touching is an overlap. A ball of radius 0 is a point.
///
/// 1. sphere_sphere_overlap(a, b) == sphere_sphere_overlap(b, a)
/// 2. sphere_sphere_overlap(a, b) == (sphere_sphere_penetration(a, b).depth >= 0) in real numbers
///
/// Units: lengths. Never fails. Non-finite input: no. Source: the squared distance of the centers against the squared
/// sum of the radii.
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> sphere_sphere_overlap(const Sphere<T>& sphere1,
                                                       const Sphere<T>& sphere2) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(sphere_sphere_overlap, TierOfDecisions<Tier>, sphere1, sphere2);
}

namespace contracts {

/// First order. The distance has an error of half of 3 + 2 eps (of at most 4 G, shared by two centers: 5 eps of G). The
/// sum of the radii has an error of 1 eps, and half of 2 eps, of two radii: 4 eps of the larger.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_sphere_overlap() {
  return Tier::template contract<T>({.backward = 8, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
