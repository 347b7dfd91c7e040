/// When and where a moving point enters an axis-aligned box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/enter_box.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The entry of `point`, moving by `velocity` per unit of time, into the solid `aabox`.
///
/// A start in the closed box is a miss with `inside` set and the start as location. From outside, touching
/// counts; the normal is that of a face on which the location lies.
///
/// 1. location == point + velocity * time (exactly, in real numbers), on the surface of the box
/// 2. normal is along an axis, outward
///
/// Source: the face planes in front of the start, the last one reached (Woo, Fast Ray-Box Intersection, in
/// Graphics Gems, 1990).
template <class Tier = Fast, class T>
Entry<T> moving_point_aabox(const Vec3<T>& point, const Vec3<T>& velocity, const AABox<T>& aabox) noexcept {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {
    using L = detail::Lanes<T>;
    using detail::lanes;
    const L step = lanes(velocity);
    const auto entry = detail::enter_box(lanes(point), step, lanes(aabox.min), lanes(aabox.max),
                                         [&](const L& gap) { return gap / step; });
    const bool inside = entry.enters & entry.inside, enters = entry.enters & !inside;
    const L normal = select(entry.below, L::all(T(-1)), L::all(T(1))) & first_of_three(entry.axis);
    Entry<T> answer;
    answer.inside = inside;
    answer.location = first_three(entry.at & L::when(entry.enters));
    answer.time = select(L::when(enters), entry.time, L::all(std::numeric_limits<T>::infinity())).first();
    answer.normal = first_three(normal & L::when(enters));
    return answer;
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return moving_point_aabox<decltype(by)>(a...); }, point, velocity,
                      aabox);
  }
  const std::array<T, 3> at = components(point), step = components(velocity);
  const std::array<T, 3> low = components(aabox.min), high = components(aabox.max);
  bool inside = true;
  for (int i = 0; i < 3; ++i) inside = inside && low[i] <= at[i] && at[i] <= high[i];
  Entry<T> answer;
  if (inside) {
    answer.inside = true;
    answer.location = point;
    return answer;
  }
  const auto entry = detail::enter_box(at, step, low, high, [&](const T& gap, int i) -> T { return gap / step[i]; });
  if (entry.axis < 0 || !(entry.time <= std::numeric_limits<T>::max())) return Entry<T>::miss();
  std::array<T, 3> normal{};
  normal[entry.axis] = entry.side;
  answer.location = {entry.at[0], entry.at[1], entry.at[2]};
  answer.time = entry.time;
  answer.normal = {normal[0], normal[1], normal[2]};
  return answer;
}

namespace contracts {

/// First order, G the largest position: a gap is known to 1 eps of 2 G, the quotient adds 1 eps, product and
/// sum 1 eps each of a way of at most 2 G. Point and faces move by 4 * 2 eps G at most.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_aabox() {
  return Tier::template contract<T>(
      {.backward = 8, .unit = 0, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
