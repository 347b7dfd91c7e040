/// The kernel of moving_point_triangle_prepared (collide/moving_point_triangle_prepared.hpp).
#pragma once

#include <collide/detail/moving_point_triangle.hpp>
#include <collide/prepared.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Whether the signs of the three weights, times approach, are certain. Each is the signed volume of the velocity and
/// an edge. The weight of v0 is a difference: its error is that of the largest volume, not that of its own edge. The
/// bound is derived at moving_point_triangle_in_lanes, whose volumes are computed in the same way. Vectors so short
/// that products may underflow leave the signs uncertain.
template <class T>
bool weights_are_certain(const Vec3<T>& from_v0, const Vec3<T>& velocity, const PreparedTriangle<T>& prepared,
                         const T& approach, const T& weight1, const T& weight2) {
  constexpr T u = std::numeric_limits<T>::epsilon() / 2;
  constexpr T least_size2 = std::same_as<T, float> ? T(0x1p-30) : T(0x1p-300), least_speed2 = least_size2 / 4;
  const T least = smaller(smaller(weight1, weight2), approach - (weight1 + weight2));
  const T l2 = Plain::dot(prepared.edge1, prepared.edge1) + Plain::dot(prepared.edge2, prepared.edge2) +
               Plain::dot(from_v0, from_v0);
  const T speed2 = Plain::dot(velocity, velocity);
  return l2 >= least_size2 && speed2 >= least_speed2 && T(64 * 64) * u * u * (l2 * l2 * speed2) < least * least;
}

}  // namespace detail

COLLIDE_COMPILED(moving_point_triangle_prepared)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_point_triangle_prepared(const Vec3<T>& point, const Vec3<T>& velocity,
                                                const PreparedTriangle<T>& prepared) {
  if constexpr (Tier::template lifts<T>) {
#if defined(COLLIDE_LANES)
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_impact(point, velocity, prepared.triangle))
        return Tier::decided_by_filter(*answer);
    }
#endif
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
    if constexpr (MachineNumber<T>) {
      if (!detail::weights_are_certain(from_v0, velocity, prepared, approach, weight1, weight2)) {
        return kernels::moving_point_triangle<Tier>(point, velocity, prepared.triangle);
      }
    }
    if (!(weight1 >= T(0) && weight2 >= T(0) && weight1 + weight2 <= approach)) return Impact<T>::miss();
    const T time = detail::time_in_triangle<Tier>(T(height / approach), velocity, prepared.normal, -from_v0,
                                                  prepared.edge1, prepared.edge2);
    if (!(time >= T(0))) return Impact<T>::miss();
    return detail::contact(time, point + velocity * time, prepared.unit_normal);
  }
}

/// The kernel of a tier that takes numbers from another one: moving_point_triangle takes less time.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline Impact<T> moving_point_triangle_prepared(const Vec3<T>& point, const Vec3<T>& velocity,
                                                const PreparedTriangle<T>& prepared) {
  return kernels::moving_point_triangle<Tier>(point, velocity, prepared.triangle);
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
