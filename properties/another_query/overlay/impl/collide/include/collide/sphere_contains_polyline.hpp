/// Whether a sphere contains a polyline.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_contains_polyline.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether all points of `polyline` lie in the closed ball `sphere`.
template <class Tier = Fast, class T>
[[nodiscard]] Decision<T> sphere_contains_polyline(const Sphere<T>& sphere,
                                                   const Polyline<T>& polyline) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(sphere_contains_polyline, TierOfDecisions<Tier>, sphere, polyline);
}

namespace contracts {

/// First order, G the largest position: a difference carries 2 eps G, the squares 4 eps.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_contains_polyline() {
  return Tier::template contract<T>({.backward = 16, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
