/// The kernel of sphere_box_overlap (collide/sphere_box_overlap.hpp).
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// |c - b|^2 - r^2 for a ball around c with radius r, relative to the center of a box, where b is the point of the box
/// closest to c.
template <class T>
COLLIDE_INLINE inline Lanes<T> beyond_ball(const Lanes<T>& seen, const Lanes<T>& q, const Lanes<T>& half,
                                           const Lanes<T>& radius) {
  const Lanes<T> away = excess(FrameInLanes<T>(q).into(seen), half);
  return sum_of_three(away * away) - radius * radius;
}

/// Filter in doubles: whether sphere and box meet; nullopt if rounding may change the decision.
///
/// Let u = 2^-53 and S = |x| + |y| + |z| of the vector between the centers. A number of the matrix has an error of
/// 15 u, a coordinate in the box's frame 20 u S, and its excess 21 u S. The sum of the squares has an error of 2
/// sqrt(3) 21 u S^2 + 3 u S^2, and the difference 80 u S^2 + 2 u r^2. Underflow is far smaller if S^2 + r^2 and the
/// quaternion are not tiny.
template <class T>
std::optional<bool> filtered_overlap(const Sphere<T>& sphere, const Box<T>& box) {
  using L = Lanes<double>;
  const L seen = wide_lanes(sphere.center) - wide_lanes(box.center), half = wide_lanes(box.half);
  const L q = wide_lanes(box.orientation), radius = L::splat(sphere.radius);
  const double beyond = beyond_ball(seen, q, half, radius).first();
  const double s = sum_of_three(absolute(seen)).first(), r = sphere.radius, norm2 = sum_of_four(q * q).first();
  const double scale2 = s * s + r * r, bound = 0x1p-46 * scale2;
  const auto in_range = [](double x) { return x >= 0x1p-900 && x <= 0x1p900; };
  if (!(in_range(scale2) && in_range(norm2) && detail::abs(beyond) > bound && all_three(are_finite(half))))
    return std::nullopt;
  return beyond < 0;
}

}  // namespace detail

#endif

COLLIDE_COMPILED(sphere_box_overlap)

namespace kernels {

template <class Tier, class T>
inline Decision<T> sphere_box_overlap(const Sphere<T>& sphere, const Box<T>& box) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {
    using detail::lanes;
    using L = detail::Lanes<T>;
    const L center = lanes(sphere.center), middle = lanes(box.center), half = lanes(box.half);
    const L q = lanes(box.orientation), radius = L::splat(sphere.radius);
    const L beyond = detail::beyond_ball(center - middle, q, half, radius);
    return {all_three((beyond <= L::splat(T(0))) & are_finite(center, middle, half, q, radius))};
  }
  if constexpr (uses_filter<Tier, T>) {
    if (const auto decided = detail::filtered_overlap(sphere, box))
      return Tier::decided_by_filter(Decision<T>{*decided});
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(sphere_box_overlap, sphere, box);
  } else {
    const Axes<T> axes = axes_of(box.orientation);
    const std::array<T, 3> half = components(box.half);
    const std::array<T, 3> local = into_frame<Tier>(axes, sphere.center - box.center);
    const Vec3<T> away{excess(local[0], half[0]), excess(local[1], half[1]), excess(local[2], half[2])};
    if constexpr (MachineNumber<T>) {
      if (!(sphere.radius + half[0] + half[1] + half[2] <= std::numeric_limits<T>::max())) return {false};
    }
    return {Tier::beyond_radius(away, sphere.radius) <= T(0)};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
