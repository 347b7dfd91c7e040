/// The kernel of closest_point_rectangle (collide/closest_point_rectangle.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/rectangle_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(closest_point_rectangle)

namespace kernels {

template <class Tier, class T>
inline ClosestPoint<T> closest_point_rectangle(const Rectangle<T>& rectangle, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
#if defined(COLLIDE_LANES)
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_closest_point(rectangle, point)) return Tier::decided_by_filter(*answer);
    }
#endif
    return COLLIDE_LIFTED(closest_point_rectangle, rectangle, point);
  } else {
    const auto& [v0, v1, v2, v3] = rectangle;
    if constexpr (MachineNumber<T>) {
      if (const Vec3<T> all = v0 + v1 + v2 + v3 + point; !detail::is_finite(all)) return {all};
    }
    const Vec3<T> diagonal = v2 - v0, w = point - v0;
    const detail::FaceFoot<T> face1 = detail::foot_on_face<Tier>(diagonal, v1 - v0, w);
    const detail::FaceFoot<T> face2 = detail::foot_on_face<Tier>(diagonal, v3 - v0, w);
    if (face1.inside && face2.inside) {
      // Both feet have the same position along the diagonal. Their distances from the point may differ by less than
      // subtracting the squares would show.
      const Vec3<T> out1 = face1.height * face1.apex_weight, out2 = face2.height * face2.apex_weight;
      const bool first = detail::distance2_excess<Tier>(out1, out2, w - diagonal * face1.base_share) >= T(0);
      return {v0 + (first ? face1 : face2).from_start(diagonal)};
    }

    // One foot lies inside its triangle, and is closer than the diagonal. Compare it with the edges of the other
    // triangle.
    const std::array<Vec3<T>, 4> v{v0, v1, v2, v3};
    const auto foot_on = [&](int edge) { return detail::foot_on_edge<Tier>(v[edge], v[(edge + 1) % 4], point); };
    const auto on = [&](int edge, const detail::EdgeFoot<T>& foot) {
      return ClosestPoint<T>{foot.on(v[edge], v[(edge + 1) % 4])};
    };
    const Vec3<T> w2 = point - v2;
    if (face1.inside) {
      const detail::EdgeFoot<T> foot2 = foot_on(2), foot3 = foot_on(3);
      const bool at_v2 = detail::next_distance2_excess<Tier>(foot2, foot3, point - v3) >= T(0);
      const T difference = at_v2 ? detail::distance2_excess<Tier>(face1.from_end(diagonal), foot2.from_start, w2)
                                 : detail::distance2_excess<Tier>(face1.from_start(diagonal), foot3.from_end, w);
      if (difference < T(0)) return at_v2 ? on(2, foot2) : on(3, foot3);
      return {v0 + face1.from_start(diagonal)};
    }
    if (face2.inside) {
      const detail::EdgeFoot<T> foot0 = foot_on(0), foot1 = foot_on(1);
      const bool at_v0 = detail::next_distance2_excess<Tier>(foot0, foot1, point - v1) >= T(0);
      const T difference = at_v0 ? detail::distance2_excess<Tier>(face2.from_start(diagonal), foot0.from_start, w)
                                 : detail::distance2_excess<Tier>(face2.from_end(diagonal), foot1.from_end, w2);
      if (difference < T(0)) return at_v0 ? on(0, foot0) : on(1, foot1);
      return {v0 + face2.from_start(diagonal)};
    }

    // The closest of the four edges, and the diagonal, which is the ridge of a folded rectangle.
    const std::array<detail::EdgeFoot<T>, 4> foot{foot_on(0), foot_on(1), foot_on(2), foot_on(3)};
    const int edge = detail::nearest_edge<Tier>(v, foot, point);
    const detail::EdgeFoot<T> ridge = detail::foot_on_edge<Tier>(v0, v2, point);
    const Vec3<T>& from_shared = edge == 0 || edge == 2 ? foot[edge].from_start : foot[edge].from_end;
    const bool at_v0 = edge == 0 || edge == 3;
    const T difference =
        detail::distance2_excess<Tier>(from_shared, at_v0 ? ridge.from_start : ridge.from_end, at_v0 ? w : w2);
    return difference < T(0) ? ClosestPoint<T>{ridge.on(v0, v2)} : on(edge, foot[edge]);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
