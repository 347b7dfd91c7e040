/// The kernel of moving_point_triangle_prepared (collide/moving_point_triangle_prepared.hpp).
#pragma once

#include <collide/detail/moving_point_triangle.hpp>
#include <collide/prepared.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_point_triangle_prepared(const Vec3<T>& point, const Vec3<T>& velocity,
                                                const PreparedTriangle<T>& prepared) {
  if constexpr (Tier::template lifts<T>) {
    const auto kernel = [&](auto arithmetic, const auto& p, const auto& v, const auto& triangle) {
      using Arithmetic = decltype(arithmetic);
      if constexpr (Tier::template computes_in<T>)
        return kernels::moving_point_triangle_prepared<Arithmetic>(p, v, prepared);
      else
        return kernels::moving_point_triangle_prepared<Arithmetic>(p, v, prepare_triangle<Arithmetic>(triangle));
    };
    return Tier::lift(kernel, point, velocity, prepared.triangle);
  } else {
    const T approach = -Tier::dot(prepared.normal, velocity);
    if (!(approach > T(0))) return Impact<T>::miss();
    const Vec3<T> from_v0 = point - prepared.triangle.v0;
    const T height = Tier::dot(prepared.normal, from_v0);
    if (!(height >= T(0))) return Impact<T>::miss();
    const Vec3<T> moment = Tier::cross(from_v0, velocity);
    const T weight1 = Tier::dot(prepared.edge2, moment);   // weight of v1, times approach
    const T weight2 = -Tier::dot(prepared.edge1, moment);  // weight of v2, times approach
    if (!(weight1 >= T(0) && weight2 >= T(0) && weight1 + weight2 <= approach)) return Impact<T>::miss();
    const T time = detail::time_in_triangle<Tier>(T(height / approach), velocity, prepared.normal, -from_v0,
                                                  prepared.edge1, prepared.edge2);
    if (!(time >= T(0))) return Impact<T>::miss();
    return detail::contact(time, point + velocity * time, prepared.unit_normal);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
