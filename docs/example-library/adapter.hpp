/// Skim as a subject of Nearmiss: a function for each query that Skim can answer.
#pragma once

#include "impl/catalogue/queries/closest_point_segment.hpp"
#include "impl/catalogue/queries/moving_point_sphere.hpp"
#include "impl/catalogue/queries/sphere_sphere_overlap.hpp"
#include "impl/subject/adapter.hpp"
#include "skim.h"

namespace skim {

struct Adapter {
  using Number = float;  // what the library computes in: it is asked nothing that is not exactly a float
  static std::string version() { return "skim 1.0"; }

  /// What we expect: answers that are exact for inputs within 8 roundings of the given ones, wherever the largest
  /// number of each kind lies between 2^-20 and 2^20.
  template <class Q>
  static collide::Contract contract() {
    return {.backward = 8, .lowest = -20, .highest = 20};
  }
  template <class Q>
  static std::string why_not() {
    return "Skim has three functions";
  }

  static collide::Decision<float> answer(const nearmiss::inputs::sphere_sphere_overlap<float>& q) {
    return {skim_balls_meet(&q.sphere1.center.x, q.sphere1.radius, &q.sphere2.center.x, q.sphere2.radius) != 0};
  }

  /// Skim tells when, but not where: `only` says so. What it cannot be asked is no miss: `CannotAnswer`.
  static nearmiss::Reply<collide::Impact<float>> answer(const nearmiss::inputs::moving_point_sphere<float>& q) {
    if (!q.solid) return nearmiss::CannotAnswer{"Skim's balls are solid"};
    auto impact = collide::Impact<float>::miss();
    float t = 0;
    if (skim_ray_ball(&q.point.x, &q.velocity.x, &q.sphere.center.x, q.sphere.radius, &t) != 0) impact.time = t;
    return nearmiss::only(impact, {"time"});
  }

  static collide::ClosestPoint<float> answer(const nearmiss::inputs::closest_point_segment<float>& q) {
    collide::ClosestPoint<float> nearest;
    skim_nearest_on_segment(&q.segment.v0.x, &q.segment.v1.x, &q.point.x, &nearest.point.x);
    return nearest;
  }
};

}  // namespace skim
