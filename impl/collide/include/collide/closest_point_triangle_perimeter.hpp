/// The point of a triangle's perimeter nearest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/edges.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point nearest to `point` on the three edges of `triangle`; any of them where several are.
///
/// 1. the result lies on an edge, and no point of any edge is nearer
///
/// Units: lengths. Never fails. Source: the nearest point of each edge; two edges are compared from the
/// vertex that they share.
template <class Tier = Fast, class T>
ClosestPoint<T> closest_point_triangle_perimeter(const Triangle<T>& triangle, const Vec3<T>& point) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return closest_point_triangle_perimeter<decltype(by)>(a...); }, triangle, point);
  }
  if constexpr (MachineNumber<T>) {
    if (const Vec3<T> all = triangle.v0 + triangle.v1 + triangle.v2 + point; !detail::is_finite(all)) return {all};
  }
  const std::array<Vec3<T>, 3> v = detail::corners(triangle);
  const std::array<detail::EdgeFoot<T>, 3> foot{detail::foot_on_edge<Tier>(v[0], v[1], point),
                                                detail::foot_on_edge<Tier>(v[1], v[2], point),
                                                detail::foot_on_edge<Tier>(v[2], v[0], point)};
  const int edge = detail::nearest_edge<Tier>(v, foot, point);
  return {foot[edge].on(v[edge], v[(edge + 1) % 3])};
}

namespace inputs {
template <class T>
struct closest_point_triangle_perimeter {
  Triangle<T> triangle{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("triangle", &closest_point_triangle_perimeter::triangle),
                      member("point", &closest_point_triangle_perimeter::point, Role::position));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::closest_point_triangle_perimeter<Tier>(triangle, point);
  }

  /// First order, G the largest position: a foot as in closest_point_segment, 22 eps G; a comparison takes
  /// two more differences, sums and a dot product, 6 eps of the distance (at most 4 G), which moving the
  /// further end of either edge explains.
  static constexpr Contract contract(Fast) {
    return {.backward = 46, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
