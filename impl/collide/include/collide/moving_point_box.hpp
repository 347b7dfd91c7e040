/// When and where a moving point enters a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/enter_box.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The entry of `point`, moving by `velocity` per unit of time, into the solid `box`.
///
/// A start strictly inside is a miss. A start on the surface is a contact at time 0 unless the point
/// leaves: unless velocity points away from every face on which it lies. From outside, touching counts.
///
/// 1. location == point + velocity * time (exactly, in real numbers), on the surface of the box
/// 2. normal is an outward normal of a face on which location lies
///
/// Source: in the box's frame, the face planes in front of the start, the last one reached (Woo, Fast
/// Ray-Box Intersection, in Graphics Gems, 1990).
template <class Tier = Fast, class T>
Impact<T> moving_point_box(const Vec3<T>& point, const Vec3<T>& velocity, const Box<T>& box) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return moving_point_box<decltype(by)>(a...); },
                      point, velocity, box);
  }
  using std::abs;
  const Axes<T> axes = axes_of(box.orientation);
  const std::array<T, 3> half = components(box.half), low = components(-box.half);
  const std::array<T, 3> at = into_frame<Tier>(axes, point - box.center), step = into_frame<Tier>(axes, velocity);
  const auto contact = [&](const T& time, const std::array<T, 3>& where, int axis, const T& side) -> Impact<T> {
    if (!(time <= std::numeric_limits<T>::max())) return Impact<T>::miss();
    return {time, box.center + out_of_frame(axes, where), axes[axis] * side};
  };
  bool outside = false;
  for (int i = 0; i < 3; ++i) outside = outside || abs(at[i]) > half[i];
  if (!outside) {
    for (int i = 0; i < 3; ++i) {
      if (at[i] == half[i] && step[i] <= T(0)) return contact(T(0), at, i, T(1));
      if (at[i] == low[i] && step[i] >= T(0)) return contact(T(0), at, i, T(-1));
    }
    return Impact<T>::miss();
  }
  const auto entry = detail::enter_box(at, step, low, half, [&](const T& gap, int i) -> T { return gap / step[i]; });
  if (entry.axis < 0) return Impact<T>::miss();
  return contact(entry.time, entry.at, entry.axis, entry.side);
}

namespace inputs {
template <class T>
struct moving_point_box {
  Vec3<T> point{};
  Vec3<T> velocity{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_box::point, Role::position),
                      member("velocity", &moving_point_box::velocity, Role::velocity),
                      member("box", &moving_point_box::box));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::moving_point_box<Tier>(point, velocity, box);
  }

  /// First order, G the largest position: an axis carries 16 eps (7 in each product of the quaternion, at
  /// most two of them, and the sums), so a coordinate in the box frame 19 eps of the distance, which is at
  /// most 4 G; the way to the face and back to the world adds 12 eps of 4 G at most.
  static constexpr Contract contract(Fast) {
    return {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
