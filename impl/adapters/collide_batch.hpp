/// The batch forms of the queries of `collide`, for the inputs of the catalogue.
#pragma once

#include <collide/batch.hpp>

#include <tuple>
#include <type_traits>
#include <utility>

#include "impl/adapters/collide_function.hpp"
#include "nearmiss/collide_functions/box_box_conservative.hpp"
#include "nearmiss/collide_functions/capsule_capsule_overlap.hpp"
#include "nearmiss/collide_functions/capsule_capsule_signed_distance.hpp"
#include "nearmiss/collide_functions/closest_point_segment.hpp"
#include "nearmiss/collide_functions/closest_points_lines.hpp"
#include "nearmiss/collide_functions/moving_point_aabox.hpp"
#include "nearmiss/collide_functions/moving_point_plane.hpp"
#include "nearmiss/collide_functions/moving_point_sphere.hpp"
#include "nearmiss/collide_functions/moving_point_triangle.hpp"
#include "nearmiss/collide_functions/moving_sphere_passes_sphere.hpp"
#include "nearmiss/collide_functions/moving_sphere_plane.hpp"
#include "nearmiss/collide_functions/moving_sphere_sphere.hpp"
#include "nearmiss/collide_functions/point_capsule_overlap.hpp"
#include "nearmiss/collide_functions/point_capsule_signed_distance.hpp"
#include "nearmiss/collide_functions/point_segment_signed_distance.hpp"
#include "nearmiss/collide_functions/point_sphere_overlap.hpp"
#include "nearmiss/collide_functions/point_sphere_signed_distance.hpp"
#include "nearmiss/collide_functions/ray_aabox.hpp"
#include "nearmiss/collide_functions/segment_capsule_overlap.hpp"
#include "nearmiss/collide_functions/segment_capsule_signed_distance.hpp"
#include "nearmiss/collide_functions/segment_segment_signed_distance.hpp"
#include "nearmiss/collide_functions/sphere_box_overlap.hpp"
#include "nearmiss/collide_functions/sphere_capsule_overlap.hpp"
#include "nearmiss/collide_functions/sphere_capsule_signed_distance.hpp"
#include "nearmiss/collide_functions/sphere_plane_penetration.hpp"
#include "nearmiss/collide_functions/sphere_segment_overlap.hpp"
#include "nearmiss/collide_functions/sphere_segment_signed_distance.hpp"
#include "nearmiss/collide_functions/sphere_sphere_overlap.hpp"
#include "nearmiss/collide_functions/sphere_sphere_penetration.hpp"
#include "nearmiss/collide_functions/sphere_sphere_signed_distance.hpp"
#include "nearmiss/collide_functions/sphere_triangle_overlap.hpp"

/// Calls f(query) for each query with a batch form.
#define NEARMISS_BATCH_QUERIES(f)                                                                                  \
  f(box_box_conservative) f(capsule_capsule_overlap) f(capsule_capsule_signed_distance) f(closest_point_segment)   \
      f(closest_points_lines) f(moving_point_aabox) f(moving_point_plane) f(moving_point_sphere)                   \
          f(moving_point_triangle) f(moving_sphere_passes_sphere) f(moving_sphere_plane) f(moving_sphere_sphere)   \
              f(point_capsule_overlap) f(point_capsule_signed_distance) f(point_segment_signed_distance)           \
                  f(point_sphere_overlap) f(point_sphere_signed_distance) f(ray_aabox) f(segment_capsule_overlap)  \
                      f(segment_capsule_signed_distance) f(segment_segment_signed_distance) f(sphere_box_overlap)  \
                          f(sphere_capsule_overlap) f(sphere_capsule_signed_distance) f(sphere_plane_penetration)  \
                              f(sphere_segment_overlap) f(sphere_segment_signed_distance) f(sphere_sphere_overlap) \
                                  f(sphere_sphere_penetration) f(sphere_sphere_signed_distance)                    \
                                      f(sphere_triangle_overlap)

namespace nearmiss::adapters {

/// The batch form of a query.
template <class Q>
struct BatchFunction;

#define NEARMISS_BATCH_FUNCTION(query)     \
  template <class T>                       \
  struct BatchFunction<inputs::query<T>> { \
    template <class... A>                  \
    static void call(const A&... a) {      \
      collide::batch::query(a...);         \
    }                                      \
  };
NEARMISS_BATCH_QUERIES(NEARMISS_BATCH_FUNCTION)
#undef NEARMISS_BATCH_FUNCTION

/// The arguments of a query's batch form, in a tuple: those of the query, but a ray and a box are not prepared.
template <class Q>
auto batch_arguments(const Q& q) noexcept {
  return arguments<collide::Fast>(q);
}
template <class T>
auto batch_arguments(const inputs::ray_aabox<T>& q) noexcept {
  return std::tuple(q.ray, q.aabox);
}

/// Inputs of a query and their answers, in structures of arrays.
template <class Q>
class CollideBatch {
 public:
  using Answer = typename Q::Answer;

  std::size_t size() const { return answers_.size(); }
  void push_back(const Q& q) {
    const auto values = batch_arguments(q);
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (std::get<i>(arguments_).push_back(std::get<i>(values)), ...);
    }(std::make_index_sequence<std::tuple_size_v<decltype(values)>>());
    answers_.push_back(Answer{});
  }
  /// Answers `count` inputs from index `first`.
  void answer(std::size_t first, std::size_t count, collide::Simd simd = collide::widest_simd()) {
    std::apply(
        [&](const auto&... arrays) {
          BatchFunction<Q>::call(arrays.view().subview(first, count)..., answers_.span().subview(first, count), simd);
        },
        arguments_);
  }
  void answer(collide::Simd simd = collide::widest_simd()) { answer(0, size(), simd); }
  Answer operator[](std::size_t i) const { return answers_[i]; }
  /// Replaces an answer.
  void put(std::size_t i, const Answer& answer) { answers_.put(i, answer); }

 private:
  template <class... Argument>
  static std::tuple<collide::Soa<Argument>...> arrays_of(const std::tuple<Argument...>&);

  decltype(arrays_of(batch_arguments(std::declval<Q>()))) arguments_;
  collide::Soa<Answer> answers_;
};

}  // namespace nearmiss::adapters
