/// The kernel of moving_point_box (collide/moving_point_box.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/point_enters_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_point_box)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_point_box(const Vec3<T>& point, const Vec3<T>& velocity, const Box<T>& box) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_point_box, point, velocity, box);
  } else {
    return detail::point_enters_box<Tier>(point, velocity, box);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
