/// Queries whose helps a user prepares once and keeps: the benchmarks prepare them before, too.
#pragma once

#include <collide/tiers.hpp>
#if __has_include(<collide/closest_point_segment_unit.hpp>)
#include <collide/closest_point_segment_unit.hpp>
#endif
#if __has_include(<collide/closest_point_triangle_perimeter_edges.hpp>)
#include <collide/closest_point_triangle_perimeter_edges.hpp>
#endif
#if __has_include(<collide/moving_point_triangle_prepared.hpp>)
#include <collide/moving_point_triangle_prepared.hpp>
#endif
#if __has_include(<collide/ray_aabox.hpp>)
#include <collide/ray_aabox.hpp>
#endif

namespace nearmiss::benchmarks {

/// The inputs of a query as they are when the question comes.
template <class Tier, class Q>
struct Ready {
  explicit Ready(const Q& q) : inputs(q) {}
  auto ask() const noexcept { return inputs.template ask<Tier>(); }
  Q inputs;
};

#if __has_include(<collide/closest_point_segment_unit.hpp>)
template <class Tier, class T>
struct Ready<Tier, collide::inputs::closest_point_segment_unit<T>> {
  explicit Ready(const collide::inputs::closest_point_segment_unit<T>& q)
      : segment(collide::prepare_segment<Tier>(q.segment)), point(q.point) {}
  auto ask() const noexcept { return collide::closest_point_segment_unit<Tier>(segment, point); }
  collide::PreparedSegment<T> segment;
  collide::Vec3<T> point;
};
#endif

#if __has_include(<collide/closest_point_triangle_perimeter_edges.hpp>)
template <class Tier, class T>
struct Ready<Tier, collide::inputs::closest_point_triangle_perimeter_edges<T>> {
  explicit Ready(const collide::inputs::closest_point_triangle_perimeter_edges<T>& q)
      : edges(collide::prepare_edges<Tier>(q.triangle)), point(q.point) {}
  auto ask() const noexcept { return collide::closest_point_triangle_perimeter_edges<Tier>(edges, point); }
  collide::TriangleEdges<T> edges;
  collide::Vec3<T> point;
};
#endif

#if __has_include(<collide/moving_point_triangle_prepared.hpp>)
template <class Tier, class T>
struct Ready<Tier, collide::inputs::moving_point_triangle_prepared<T>> {
  explicit Ready(const collide::inputs::moving_point_triangle_prepared<T>& q)
      : point(q.point), velocity(q.velocity), triangle(collide::prepare_triangle<Tier>(q.triangle)) {}
  auto ask() const noexcept { return collide::moving_point_triangle_prepared<Tier>(point, velocity, triangle); }
  collide::Vec3<T> point, velocity;
  collide::PreparedTriangle<T> triangle;
};
#endif

#if __has_include(<collide/ray_aabox.hpp>)
template <class Tier, class T>
struct Ready<Tier, collide::inputs::ray_aabox<T>> {
  explicit Ready(const collide::inputs::ray_aabox<T>& q)
      : ray(collide::prepare_ray(q.ray)), aabox(collide::prepare_aabox(q.aabox)) {}
  auto ask() const noexcept { return collide::ray_aabox<Tier>(ray, aabox); }
  collide::PreparedRay<T> ray;
  collide::PreparedAABox<T> aabox;
};
#endif

}  // namespace nearmiss::benchmarks
