/// The kernel of the casts of a rounded polytope against a half-space.
///
/// The height of the deepest vertex above the plane is linear in time, and no other vertex becomes the deepest one,
/// because all move alike.
#pragma once

#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/contact.hpp>
#include <collide/detail/half_spaces.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Filter: the first contact of a moving shape with a half-space, or nullopt where the decision is not certain or a
/// number may not be accurate.
///
/// Errors are in units of u, that of an operation in the wider type. As in filtered_distance, the gap between vertex
/// and plane has one of 10 of its terms and of the radius, and twice that of the vertex. The approach, a product of
/// three terms by the length of the normal, has one of 8 of its terms. The time has the sum of the relative errors of
/// both and 1 more, and the way to the contact 2 more than the time. A normal times a length has one of 6 of it.
template <class A, class T>
std::optional<Impact<T>> filtered_cast(const A& a, const Vec3<T>& velocity, const HalfSpace<T>& halfspace) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    using limits = std::numeric_limits<T>;
    constexpr double u = double(std::numeric_limits<W>::epsilon() / 2), enough = double(half_ulp<T>) / 1.5;
    const auto vertex = certain_least<W>(halfspace.normal, a);
    if (!vertex) return std::nullopt;
    const Vec3<W>&at = vertex->at, n = in_wider(halfspace.normal), step = in_wider(velocity);
    const auto product = [&](const Vec3<W>& v) { return Vec3<W>{n.x * v.x, n.y * v.y, n.z * v.z}; };
    const W norm = sqrt(Plain::dot(n, n)), radius = W(radius_of<T>(a)), offset = W(halfspace.offset);
    if (!(norm > W(limits::min()) && magnitudes(step) <= W(limits::max()))) return std::nullopt;
    const W height = (Plain::dot(n, at) + offset) / norm, gap = height - radius, approach = -Plain::dot(n, step) / norm;
    const double of_gap = 10 * double((magnitudes(product(at)) + abs(offset)) / norm + radius) + 2 * vertex->error,
                 of_approach = 8 * double(magnitudes(product(step)) / norm);
    const bool is_apart = double(gap) > u * of_gap;
    if (is_apart && -double(approach) > u * of_approach) return Impact<T>::miss();
    const Vec3<W> normal = n * (W(1) / norm);
    const auto is_accurate = [&](const Vec3<W>& place, double error) {
      const W largest = largest_magnitude(place);
      return error <= enough * double(largest) && largest <= W(limits::max());
    };
    if (-double(gap) > u * of_gap) {
      const Vec3<W> foot = at - normal * height;
      if (is_accurate(foot, of_gap + vertex->error + 8 * double(abs(height))))
        return Impact<T>{T(0), rounded_to<T>(foot), rounded_to<T>(normal)};
      return std::nullopt;
    }
    if (!is_apart || !(double(approach) > u * of_approach)) return std::nullopt;
    const W time = gap / approach;
    const double of_time = of_gap / double(gap) + of_approach / double(approach) + 1;
    const Vec3<W> way = step * time, place = at + way - normal * radius;
    const double of_place = vertex->error + double(largest_magnitude(way)) * (of_time + 2) + 6 * double(radius) +
                            2 * double(magnitudes(at));
    if (of_time <= enough && time >= W(limits::min()) && time <= W(limits::max() / 2) && is_accurate(place, of_place))
      return Impact<T>{T(time), rounded_to<T>(place), rounded_to<T>(normal)};
  }
  return std::nullopt;
}

}  // namespace detail

namespace kernels {

template <class Tier, class A, class T>
inline Impact<T> cast_against_half_space(const A& a, const Vec3<T>& velocity, const HalfSpace<T>& halfspace) {
  const Vec3<T> deepest = detail::least_along<Tier>(halfspace.normal, a);
  const T norm = length(components(halfspace.normal)), radius = detail::radius_of<T>(a);
  const T height = detail::height_above<Tier>(halfspace, deepest), gap = height - radius * norm;
  const T approach = -Tier::dot(halfspace.normal, velocity);
  const bool starts_in_contact = gap < T(0) || (gap == T(0) && approach >= T(0));
  if (!starts_in_contact && !(gap > T(0) && approach > T(0))) return Impact<T>::miss();
  const T time = starts_in_contact ? T(0) : gap / approach;
  const Vec3<T> normal = halfspace.normal / norm;
  Vec3<T> foot = (deepest + velocity * time) - normal * (starts_in_contact ? height / norm : radius);
  // The rounding errors are those of a vertex that may be far away: a second pass removes them. A place that overflows
  // has none.
  if constexpr (MachineNumber<T>) {
    const T off = detail::height_above<Tier>(halfspace, foot) / norm;
    if (detail::abs(off) <= std::numeric_limits<T>::max()) foot = foot - normal * off;
  }
  return detail::contact(time, foot, normal);
}

}  // namespace kernels

namespace contracts {

/// First order. As for the signed distance, moving the vertex, changing the normal and the offset account for the
/// errors of the gap, 5 eps of each; the computed approach is that of a velocity changed by 4 eps, and the quotient
/// adds 1 eps. The way to the contact, at most as long as start and contact together, adds 4 eps of both. A corner of a
/// box adds 64.
template <class Tier, class T>
constexpr Contract cast_against_half_space(double backward) {
  return Tier::template contract<T>(
      {.backward = backward, .unit = 8, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide

// NOLINTBEGIN(bugprone-macro-parentheses): a type and a name that is declared have none

/// Defines the function `name` of a moving shape and a half-space, its kernel and its contract.
#define COLLIDE_CAST_AGAINST_HALF_SPACE(backward, name, First, first)                                    \
  COLLIDE_COMPILED(name)                                                                                 \
  namespace kernels {                                                                                    \
  template <class Tier, class T>                                                                         \
  inline Impact<T> name(const First<T>& first, const Vec3<T>& velocity, const HalfSpace<T>& halfspace) { \
    if constexpr (uses_filter<Tier, T>) {                                                                \
      if (const auto decided = detail::filtered_cast(first, velocity, halfspace))                        \
        return Tier::decided_by_filter(*decided);                                                        \
    }                                                                                                    \
    if constexpr (Tier::template lifts<T>) {                                                             \
      return COLLIDE_LIFTED(name, first, velocity, halfspace);                                           \
    } else {                                                                                             \
      return cast_against_half_space<Tier>(first, velocity, halfspace);                                  \
    }                                                                                                    \
  }                                                                                                      \
  }                                                                                                      \
  namespace contracts {                                                                                  \
  template <class Tier = Fast, class T = double>                                                         \
  constexpr Contract name() {                                                                            \
    return cast_against_half_space<Tier, T>(backward);                                                   \
  }                                                                                                      \
  }                                                                                                      \
  template <class Tier = Fast, class T>                                                                  \
  [[nodiscard]] inline Impact<T> name(const First<T>& first, const Vec3<T>& velocity,                    \
                                      const HalfSpace<T>& halfspace) noexcept(Tier::never_throws) {      \
    COLLIDE_ANSWER(name, TierOfDecisions<Tier>, first, velocity, halfspace);                             \
  }

// NOLINTEND(bugprone-macro-parentheses)

#include <collide/detail/strict_end.hpp>
