/// The kernels of the overlap of a box with a point, a segment, a capsule and a triangle.
#pragma once

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
  bool has_volume = false;
};

/// Vertex i is center + sum over axes k of (bit k of i ? +1 : -1) * half[k] * axis k.
template <class Tier, class T>
CoreOfBox<T> core_of(const Box<T>& box, const Vec3<T>& origin) {
  CoreOfBox<T> core;
  const Axes<T> axes = axes_of(box.orientation);
  core.center = box.center - origin;
  core.reach = {axes[0] * box.half.x, axes[1] * box.half.y, axes[2] * box.half.z};
  int edge = 0;
  for (int i = 0; i < 8; ++i) {
    Vec3<T> to_corner{};
    for (int k = 0; k < 3; ++k) {
      const bool further = (i >> k & 1) != 0;
      to_corner = further ? to_corner + core.reach[k] : to_corner - core.reach[k];
      if (!further) core.edges[edge++] = {i, k};
    }
    core.vertices[i] = core.center + to_corner;
  }
  core.directions = core.normals = axes;
  core.count_of_normals = 3;
  core.has_volume = box.half.x > T(0) && box.half.y > T(0) && box.half.z > T(0);
  return core;
}

template <class Tier, class T>
ProjectedRange<T> projected(const CoreOfBox<T>& core, const Vec3<T>& direction) {
  const T middle = Tier::dot(direction, core.center);
  const T reach = abs(Tier::dot(direction, core.reach[0])) + abs(Tier::dot(direction, core.reach[1])) +
                  abs(Tier::dot(direction, core.reach[2]));
  return {middle - reach, middle + reach};
}

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
template <class Tier, class T>
inline Decision<T> overlap(const Triangle<T>& triangle, const Box<T>& box) {
  const detail::CoreOfBox<T> second = detail::core_of<Tier>(box, triangle.v0);
  const auto first = detail::core_of<Tier>(triangle, triangle.v0);
  const auto separation = detail::separation_of<Tier>(first, second);
  if constexpr (!MachineNumber<T>) {
    if (second.has_volume) return {!separation.between_faces_and_edges()};
  }
  return {!separation.exists()};
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
