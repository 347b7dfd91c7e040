/// The point of a segment nearest to a point, with the segment's unit direction and length at hand.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// A segment with its unit direction (zero for a point) and its length: made once, asked often.
template <class T>
struct PreparedSegment {
  Segment<T> segment{};
  Vec3<T> direction{};
  T length{};
};

template <class Tier = Fast, class T>
PreparedSegment<T> prepare_segment(const Segment<T>& segment) noexcept {
  const Vec3<T> along = segment.v1 - segment.v0;
  return {segment, unit<Tier>(along), length(components(along))};
}

/// The point of `prepared.segment` nearest to `point`. The helps save a division and never change the
/// meaning: closest_point_segment_unit(prepare_segment(s), p) is closest_point_segment(s, p) in real numbers.
///
/// Units: lengths. Never fails. Source: orthogonal projection, clamped to the segment.
template <class Tier = Fast, class T>
ClosestPoint<T> closest_point_segment_unit(const PreparedSegment<T>& prepared, const Vec3<T>& point) noexcept {
  if constexpr (!Tier::template keeps<T>) {
    return Tier::lift(
        [](auto by, const auto& s, const auto& p) {
          return closest_point_segment_unit<decltype(by)>(prepare_segment<decltype(by)>(s), p);
        },
        prepared.segment, point);
  }
  const T distance = Tier::dot(point - prepared.segment.v0, prepared.direction);
  if (distance <= T(0)) return {prepared.segment.v0};
  if (distance >= prepared.length) return {prepared.segment.v1};
  return {prepared.segment.v0 + prepared.direction * distance};
}

namespace contracts {

/// First order, G the largest position: two differences (1 eps of 2 G each), a unit vector and a length
/// (4 eps each, of the segment's 4 G), a dot product (3 eps of |point - v0|, at most 4 G), product and sum
/// (1 eps of at most 2 G each): 2 * 2 + 2 * 4 * 4 + 3 * 4 + 2 * 2 eps G, which moving the point and the
/// ends explains.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_segment_unit() {
  return Tier::template contract<T>({.backward = 52, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
