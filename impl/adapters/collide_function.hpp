/// Maps each query of the catalogue to its function in `collide` and the arguments of that function.
#pragma once

#include <cmath>
#include <limits>
#include <tuple>

#include <collide/closest_point_segment_unit.hpp>
#include <collide/closest_point_triangle_perimeter_edges.hpp>
#include <collide/moving_point_triangle_prepared.hpp>
#include <collide/ray_aabox.hpp>

#include "impl/catalogue/queries/closest_point_segment_unit.hpp"
#include "impl/catalogue/queries/closest_point_triangle_perimeter_edges.hpp"
#include "impl/catalogue/queries/moving_point_triangle_prepared.hpp"
#include "impl/catalogue/queries/moving_sphere_passes_box.hpp"
#include "impl/catalogue/queries/moving_sphere_passes_sphere.hpp"
#include "impl/catalogue/queries/ray_aabox.hpp"

namespace nearmiss::adapters {

/// The function of `collide` with the query's name, and its contract.
template <class Q>
struct CollideFunction;

/// Defines CollideFunction for one query. Requires the headers of its function and of its inputs.
#define NEARMISS_COLLIDE_FUNCTION(query)                                              \
  template <class T>                                                                  \
  struct CollideFunction<inputs::query<T>> {                                          \
    template <class Tier, class... Arguments>                                         \
    [[gnu::always_inline]] static auto call(const Arguments&... arguments) noexcept { \
      return collide::query<Tier>(arguments...);                                      \
    }                                                                                 \
    template <class Tier>                                                             \
    static constexpr collide::Contract contract() {                                   \
      return collide::contracts::query<Tier, T>();                                    \
    }                                                                                 \
  };

/// The arguments of the function in a tuple: the members of the inputs, prepared where the function takes prepared
/// ones.
template <class Tier, class Q>
auto arguments(const Q& q) noexcept {
  return std::apply([&](const auto&... member) { return std::tuple(q.*(member.pointer)...); }, Q::members());
}
template <class Tier, class T>
auto arguments(const inputs::closest_point_segment_unit<T>& q) noexcept {
  return std::tuple(collide::prepare_segment<Tier>(q.segment), q.point);
}
template <class Tier, class T>
auto arguments(const inputs::closest_point_triangle_perimeter_edges<T>& q) noexcept {
  return std::tuple(collide::prepare_triangle_edges<Tier>(q.triangle), q.point);
}
template <class Tier, class T>
auto arguments(const inputs::moving_point_triangle_prepared<T>& q) noexcept {
  return std::tuple(q.point, q.velocity, collide::prepare_triangle<Tier>(q.triangle));
}
template <class Tier, class T>
auto arguments(const inputs::ray_aabox<T>& q) noexcept {
  return std::tuple(collide::prepare_ray<Tier>(q.ray), collide::prepare_aabox<Tier>(q.aabox));
}
template <class Tier, class T>
auto arguments(const inputs::moving_sphere_passes_box<T>& q) noexcept {
  return std::tuple(q.sphere, q.velocity, q.box, q.forever ? std::numeric_limits<T>::infinity() : q.limit);
}
/// A limit that is not finite becomes NaN: the query has a flag for an unlimited motion.
template <class Tier, class T>
auto arguments(const inputs::moving_sphere_passes_sphere<T>& q) noexcept {
  const bool valid = q.limit >= T(0) && std::isfinite(q.limit);
  const T until = q.forever ? std::numeric_limits<T>::infinity() : q.limit;
  return std::tuple(q.sphere, q.velocity, q.fixed, valid ? until : std::numeric_limits<T>::quiet_NaN());
}

/// The answer of `collide` in the tier.
template <class Tier, class Q>
auto ask_collide(const Q& q) noexcept {
  return std::apply([](const auto&... a) { return CollideFunction<Q>::template call<Tier>(a...); }, arguments<Tier>(q));
}

}  // namespace nearmiss::adapters
