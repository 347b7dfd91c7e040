/// The point of a rectangle nearest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/edges.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point nearest to `point` in `rectangle`, the union of the triangles v0, v1, v2 and v0, v2, v3; any of
/// them where several are.
///
/// 1. the result lies in one of the two triangles, and no point of either is nearer
///
/// Units: lengths. Never fails. Source: the foot of the perpendicular where it lies in a triangle, else the
/// nearest edge. The triangles are compared from the diagonal or from the vertices that they share.
template <class Tier = Fast, class T>
ClosestPoint<T> closest_point_rectangle(const Rectangle<T>& rectangle, const Vec3<T>& point) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return closest_point_rectangle<decltype(by)>(a...); }, rectangle, point);
  }
  const auto& [v0, v1, v2, v3] = rectangle;
  if constexpr (MachineNumber<T>) {
    if (const Vec3<T> all = v0 + v1 + v2 + v3 + point; !detail::is_finite(all)) return {all};
  }
  const Vec3<T> diagonal = v2 - v0, w = point - v0;
  const detail::FaceFoot<T> face1 = detail::foot_on_face<Tier>(diagonal, v1 - v0, w);
  const detail::FaceFoot<T> face2 = detail::foot_on_face<Tier>(diagonal, v3 - v0, w);
  if (face1.inside && face2.inside) {
    // Both feet are equally far along the diagonal: the one that is further from it is nearer to the point.
    const Vec3<T> out1 = face1.height * face1.apex_weight, out2 = face2.height * face2.apex_weight;
    const bool first = Tier::dot(out1, out1) >= Tier::dot(out2, out2);
    return {v0 + (first ? face1 : face2).from_start(diagonal)};
  }

  // Triangle 1 has the edges v0 v1, v1 v2, v2 v0; triangle 2 has v2 v3, v3 v0, v0 v2.
  const std::array<Vec3<T>, 3> corners1{v0, v1, v2}, corners2{v2, v3, v0};
  const auto nearest_of = [&](const std::array<Vec3<T>, 3>& v, std::array<detail::EdgeFoot<T>, 3>& foot) {
    for (int i = 0; i < 3; ++i) foot[i] = detail::foot_on_edge<Tier>(v[i], v[(i + 1) % 3], point);
    return detail::nearest_edge<Tier>(v, foot, point);
  };
  const auto on = [](const std::array<Vec3<T>, 3>& v, const std::array<detail::EdgeFoot<T>, 3>& foot, int edge) {
    return ClosestPoint<T>{foot[edge].on(v[edge], v[(edge + 1) % 3])};
  };
  constexpr int shared = 2;  // the diagonal's number in either triangle
  std::array<detail::EdgeFoot<T>, 3> foot1, foot2;
  if (face1.inside) {
    const ClosestPoint<T> inside{v0 + face1.from_start(diagonal)};
    const int edge = nearest_of(corners2, foot2);
    if (edge == shared) return inside;
    const T by = edge == 0 ? detail::further_by<Tier>(face1.from_end(diagonal), foot2[0].from_start, point - v2)
                           : detail::further_by<Tier>(face1.from_start(diagonal), foot2[1].from_end, w);
    return by >= T(0) ? inside : on(corners2, foot2, edge);
  }
  if (face2.inside) {
    const ClosestPoint<T> inside{v0 + face2.from_start(diagonal)};
    const int edge = nearest_of(corners1, foot1);
    if (edge == shared) return inside;
    const T by = edge == 0 ? detail::further_by<Tier>(face2.from_start(diagonal), foot1[0].from_start, w)
                           : detail::further_by<Tier>(face2.from_end(diagonal), foot1[1].from_end, point - v2);
    return by >= T(0) ? inside : on(corners1, foot1, edge);
  }
  const int edge1 = nearest_of(corners1, foot1), edge2 = nearest_of(corners2, foot2);
  if (edge1 == shared) return on(corners2, foot2, edge2);
  if (edge2 == shared) return on(corners1, foot1, edge1);
  T by;  // how much further the second is
  if (edge1 == 0 && edge2 == 1) {
    by = detail::further_by<Tier>(foot1[0].from_start, foot2[1].from_end, w);
  } else if (edge1 == 1 && edge2 == 0) {
    by = detail::further_by<Tier>(foot1[1].from_end, foot2[0].from_start, point - v2);
  } else {  // opposite edges move independently
    by = detail::further_by<Tier>(on(corners1, foot1, edge1).point, on(corners2, foot2, edge2).point, point);
  }
  return by >= T(0) ? on(corners1, foot1, edge1) : on(corners2, foot2, edge2);
}

namespace inputs {
template <class T>
struct closest_point_rectangle {
  Rectangle<T> rectangle{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("rectangle", &closest_point_rectangle::rectangle),
                      member("point", &closest_point_rectangle::point, Role::position));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::closest_point_rectangle<Tier>(rectangle, point);
  }

  /// First order, G the largest position: differences carry 1 eps of 2 G, a share of the diagonal 4 eps of
  /// the distance (at most 4 G) along it, the height 6 eps of 4 G, which moving the corners explains; the
  /// foot measured along the height 6 eps of 4 G, sums and products 3 eps of 2 G: in all 2 + 16 + 24 + 24 + 6.
  /// An edge costs less: 46, as in closest_point_triangle_perimeter.
  static constexpr Contract contract(Fast) {
    return {.backward = 72, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
