/// The kernel of moving_sphere_passes_box (collide/moving_sphere_passes_box.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_sphere_passes_box)

namespace kernels {

template <class Tier, class T>
inline Decision<T> moving_sphere_passes_box(const Sphere<T>& sphere, const Vec3<T>& velocity, const Box<T>& box,
                                            T limit) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_sphere_passes_box, sphere, velocity, box, limit);
  } else {
    const Axes<T> axes = axes_of(box.orientation);
    const std::array<T, 3> half = components(box.half);
    const std::array<T, 3> at = into_frame<Tier>(axes, sphere.center - box.center);
    const std::array<T, 3> step = into_frame<Tier>(axes, velocity);
    // The times at which each coordinate enters and leaves the interval between its face planes, and how many of the
    // two it has crossed. Between them its part of the distance is exactly zero.
    std::array<T, 3> enters{}, leaves{};
    std::array<int, 3> crossed{};
    for (int i = 0; i < 3; ++i) {
      if (step[i] == T(0)) continue;
      const T near = step[i] > T(0) ? -half[i] : half[i];
      enters[i] = (near - at[i]) / step[i];
      leaves[i] = (-near - at[i]) / step[i];
      crossed[i] = enters[i] > T(0) ? 0 : leaves[i] > T(0) ? 1 : 2;
    }
    const auto beyond_at = [&](const T& time) {
      std::array<T, 3> beyond{};
      for (int i = 0; i < 3; ++i) {
        bool between = crossed[i] == 1;
        if constexpr (MachineNumber<T>) {  // rounding may put the time before or after a crossing
          between = between || (!(step[i] == T(0)) && time >= enters[i] && time <= leaves[i]);
        }
        if (!between) beyond[i] = excess<T>(at[i] + step[i] * time, half[i]);
      }
      return beyond;
    };
    const auto touches = [&](const std::array<T, 3>& beyond) { return length(beyond) <= sphere.radius; };
    std::array<T, 3> beyond = beyond_at(T(0));
    if (touches(beyond)) return {true};
    if (!(limit > T(0))) return {false};
    const auto slope_of = [&](const std::array<T, 3>& e) { return step[0] * e[0] + step[1] * e[1] + step[2] * e[2]; };
    T slope = slope_of(beyond);
    T from(0);
    for (int piece = 0; piece < 7; ++piece) {
      if (!(slope < T(0))) return {false};  // it does not come closer, and never will: the distance is convex
      // The next crossing, and the growth rate of the slope until then: the sum of the squared steps of the coordinates
      // beyond a face.
      T next = limit, speed2(0);
      int beyond_axes = 0, crossing = -1;
      for (int i = 0; i < 3; ++i) {
        if (step[i] == T(0)) continue;
        if (crossed[i] != 1) speed2 = speed2 + step[i] * step[i], ++beyond_axes;
        if (crossed[i] == 2) continue;
        const T& time = crossed[i] == 0 ? enters[i] : leaves[i];
        if (time < next) next = time, crossing = i;
      }
      if (beyond_axes > 1 && speed2 > T(0)) {  // for one axis alone the slope becomes zero where the coordinate enters
        const T least = from - slope / speed2;
        if (least <= next) {
          if (touches(beyond_at(least))) return {true};
          // A point that enters through an edge is closest exactly when it enters; rounding may turn that into a miss.
          if constexpr (!MachineNumber<T>) return {false};
        }
      }
      if (crossing < 0) return {limit <= std::numeric_limits<T>::max() && touches(beyond_at(limit))};
      const bool entering = crossed[crossing] == 0;
      crossed[crossing] = 1;  // on the face plane its part is zero, whether it enters or leaves
      beyond = beyond_at(next);
      if (!entering) crossed[crossing] = 2;
      if (touches(beyond)) return {true};
      from = next;
      slope = slope_of(beyond);
    }
    return {false};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
