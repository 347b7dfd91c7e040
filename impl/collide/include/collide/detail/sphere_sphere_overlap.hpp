/// The kernel of sphere_sphere_overlap (collide/sphere_sphere_overlap.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(sphere_sphere_overlap)

namespace kernels {

template <class Tier, class T>
inline Decision<T> sphere_sphere_overlap(const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift(YesIfFinite{COLLIDE_KERNEL(sphere_sphere_overlap)}, sphere1, sphere2);
  } else {
    const Vec3<T> between = sphere2.center - sphere1.center;
    const T reach = sphere1.radius + sphere2.radius;
    const bool meet = Tier::beyond_radius(between, reach) <= T(0);
    if constexpr (MachineNumber<T>) {  // a center that is not finite makes the distance infinite or NaN
      return {bool(unsigned(meet) & unsigned(detail::abs(reach) <= std::numeric_limits<T>::max()))};
    } else {
      return {meet};
    }
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
