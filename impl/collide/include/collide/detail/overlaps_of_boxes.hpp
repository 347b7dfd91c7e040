/// The kernels of the overlap of a box with a point, a segment, a capsule and a triangle.
#pragma once

#include <collide/detail/aabox_triangle_overlap.hpp>
#include <collide/detail/capsule_box_filter.hpp>
#include <collide/detail/moving_sphere_passes_box.hpp>
#include <collide/detail/overlaps.hpp>
#include <collide/detail/sphere_box_overlap.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

template <class T>
struct CoreOfBox : Core<T, 8> {
  Vec3<T> center{};
  std::array<Vec3<T>, 3> reach{};  ///< from the center to the middle of a face
  unsigned flat = 0;               ///< bit k is set if the box has no extent along axis k
  bool has_volume() const { return flat == 0; }
};

template <class T>
const Vec3<T>& any_point_of(const Box<T>& box) {
  return box.center;
}

/// Vertex i is center + sum over axes k of (bit k of i ? +1 : -1) * half[k] * axis k.
template <class T>
CoreOfBox<T> core_of_box(const Vec3<T>& center, const Axes<T>& axes, const Vec3<T>& half) {
  CoreOfBox<T> core;
  core.center = center;
  core.reach = {axes[0] * half.x, axes[1] * half.y, axes[2] * half.z};
  int edge = 0;
  for (int i = 0; i < 8; ++i) {
    Vec3<T> to_corner{};
    for (int k = 0; k < 3; ++k) {
      const bool further = (i >> k & 1) != 0;
      if (!further) core.edges[edge++] = {i, k};
      to_corner = further ? to_corner + core.reach[k] : to_corner - core.reach[k];
    }
    core.vertices[i] = core.center + to_corner;
  }
  core.directions = core.normals = axes;
  core.count_of_normals = 3;
  core.flat = unsigned(!(half.x > T(0))) | unsigned(!(half.y > T(0))) << 1 | unsigned(!(half.z > T(0))) << 2;
  return core;
}
template <class Tier, class T>
CoreOfBox<T> core_of(const Box<T>& box, const Vec3<T>& origin) {
  return core_of_box(box.center - origin, axes_of(box.orientation), box.half);
}

template <class Tier, class T>
ProjectedRange<T> projected(const CoreOfBox<T>& core, const Vec3<T>& direction) {
  const T middle = Tier::dot(direction, core.center);
  const T reach = abs(Tier::dot(direction, core.reach[0])) + abs(Tier::dot(direction, core.reach[1])) +
                  abs(Tier::dot(direction, core.reach[2]));
  return {middle - reach, middle + reach};
}

#if defined(COLLIDE_LANES)

/// Filter in doubles: whether triangle and box meet; nullopt if rounding may change the decision. Let u = 2^-53 and S
/// the sum of the magnitudes of all coordinates relative to the box's center. In the box's frame a coordinate has an
/// error of 20 u S, as in sphere_box_overlap, and the magnitudes of a corner's coordinates have a sum of at most
/// sqrt(3) S.
template <class T>
std::optional<bool> filtered_overlap(const Box<T>& box, const Triangle<T>& triangle) {
  using L = Lanes<double>;
  const L center = wide_lanes(box.center), half = wide_lanes(box.half), q = wide_lanes(box.orientation);
  const L v0 = wide_lanes(triangle.v0) - center, v1 = wide_lanes(triangle.v1) - center,
          v2 = wide_lanes(triangle.v2) - center;
  const double size = 2 * sum_of_three(absolute(v0) + absolute(v1) + absolute(v2) + half).first();
  const double norm2 = sum_of_four(q * q).first(), error = 0x1p-48 * size;
  if (!(size >= 0x1p-250 && size <= 0x1p250 && norm2 >= 0x1p-900 && norm2 <= 0x1p900)) return std::nullopt;
  const FrameInLanes<double> frame(q);
  const L a = frame.into(v0), b = frame.into(v1), c = frame.into(v2), zero = L::splat(0.0);
  const L gap = larger(smaller(smaller(a, b), c), zero - larger(larger(a, b), c)) - half;
  if (any_of_three(L::splat(error) < gap)) return false;
  const std::optional<bool> meet = filtered_overlap_at_origin(half, a, b, c, size, error);
  return meet == false || all_three(gap < L::splat(-error)) ? meet : std::nullopt;
}

#endif

}  // namespace detail

namespace kernels {

template <class Tier, class T>
inline Decision<T> point_box_overlap(const Vec3<T>& point, const Box<T>& box) {
  return kernels::sphere_box_overlap<Tier>(Sphere<T>{point, T(0)}, box);
}

/// The ball at one end of the axis, moved to the other end.
template <class Tier, class T>
[[gnu::noinline]] Decision<T> overlap(const Capsule<T>& capsule, const Box<T>& box) {
  return kernels::moving_sphere_passes_box<Tier>(Sphere<T>{capsule.p0, capsule.radius}, capsule.p1 - capsule.p0, box,
                                                 T(1));
}
template <class Tier, class T>
inline Decision<T> overlap(const Segment<T>& segment, const Box<T>& box) {
  return overlap<Tier>(Capsule<T>{segment.v0, segment.v1, T(0)}, box);
}

/// Machine numbers: in the box's frame, where the box is aligned with the axes. Other numbers: by directions that
/// separate, without rounding in the exact ones.
template <class Tier, class T>
inline Decision<T> overlap(const Triangle<T>& triangle, const Box<T>& box) {
  if constexpr (MachineNumber<T>) {
    const Axes<T> axes = axes_of(box.orientation);
    const auto local = [&](const Vec3<T>& v) {
      const std::array<T, 3> x = into_frame<Tier>(axes, v - box.center);
      return Vec3<T>{x[0], x[1], x[2]};
    };
    return kernels::aabox_triangle_overlap<Tier>(
        AABox<T>{-box.half, box.half}, Triangle<T>{local(triangle.v0), local(triangle.v1), local(triangle.v2)});
  } else {
    const detail::CoreOfBox<T> second = detail::core_of<Tier>(box, triangle.v0);
    const auto first = detail::core_of<Tier>(triangle, triangle.v0);
    const auto separation = detail::separation_of<Tier>(first, second);
    return {!(second.has_volume() ? separation.between_faces_and_edges() : separation.exists())};
  }
}
template <class Tier, class T>
inline Decision<T> triangle_box_overlap(const Triangle<T>& triangle, const Box<T>& box) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T> || uses_filter<Tier, T>) {
    if (const auto decided = detail::filtered_overlap(box, triangle)) {
      if constexpr (uses_filter<Tier, T>) return Tier::decided_by_filter(Decision<T>{*decided});
      return {*decided};
    }
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(triangle_box_overlap, triangle, box);
  } else {
    return overlap<Tier>(triangle, box);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
