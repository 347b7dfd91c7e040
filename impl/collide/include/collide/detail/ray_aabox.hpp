/// The kernel of ray_aabox (collide/ray_aabox.hpp).
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/enter_box.hpp>
#include <collide/detail/entry_filter.hpp>
#include <collide/detail/frame.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// Loads a vector of a prepared struct, with an unspecified number in lane 3. load_three requires a number after the
/// vector, load_last_three one before it.
template <class Prepared>
Lanes<float> load_three(const Prepared& prepared, const Vec3<float>& other) {
  const char* const whole = reinterpret_cast<const char*>(&prepared);
  return Lanes<float>::load(whole + (reinterpret_cast<const char*>(&other) - whole));
}
template <class Prepared>
Lanes<float> load_last_three(const Prepared& prepared, const Vec3<float>& last) {
  const char* const whole = reinterpret_cast<const char*>(&prepared);
  return Lanes<float>::load(whole + (reinterpret_cast<const char*>(&last) - whole) - sizeof(float))
      .shuffled<1, 2, 3, 3>();
}
template <class Prepared>
Lanes<double> load_three(const Prepared&, const Vec3<double>& other) {
  return lanes(other);
}
template <class Prepared>
Lanes<double> load_last_three(const Prepared&, const Vec3<double>& last) {
  return lanes(last);
}

template <class T>
MotionInLanes<T> motion_in_lanes(const PreparedRay<T>& prepared, const PreparedAABox<T>& box) {
  return {load_three(prepared, prepared.ray.origin), load_three(prepared, prepared.ray.direction),
          load_three(box, box.aabox.min), load_last_three(box, box.aabox.max)};
}

/// The ray is in the box from its last entry between a pair of faces to its first exit. For a pair parallel to the ray,
/// entry and exit have infinite times: of the same sign if the ray starts beside the pair, of opposite signs if it
/// starts between. The time to a face in which the ray lies is NaN and is ignored.
///
/// Every time has a relative error of 3 eps, as if the gap had it: moving the faces and the origin accounts for it.
///
/// Calls look(inverse, entry, exit) with the inverses of the direction and the times of the last entry and first exit.
template <class T, class Look>
inline RayHit<T> ray_aabox_in_lanes(const PreparedRay<T>& prepared, const PreparedAABox<T>& box, const Look& look) {
  using L = Lanes<T>;
  using P = Pair<T>;
  const auto [origin, direction, low, high] = motion_in_lanes(prepared, box);
  const L inverse = load_last_three(prepared, prepared.inverse);
  const L to_low = (low - origin) * inverse, to_high = (high - origin) * inverse;
  // If one of two numbers is NaN, larger and smaller return the first. Exits are clamped to finite numbers, so an
  // infinite entry comes after every exit.
  const L entries = larger(L::splat(T(0)), smaller(to_low, to_high));
  const L exits = smaller(L::splat(std::numeric_limits<T>::max()), larger(to_high, to_low));
  const P time = largest_of(entries), exit = smallest_of(exits);
  look(inverse, time, exit);
  const bool hit = time.first() <= exit.first();
  const L location =
      smaller(larger(origin + direction * broadcast_first(time), low), high) & broadcast_first(time <= exit);
  return {to_vec3(location), hit, (int(hit) & int(time.first() == T(0))) != 0};
}

/// Filter: the certain answer, or nullopt. An inverse has an error of 1 u, and its product with a gap one more.
template <class T>
inline std::optional<RayHit<T>> filtered_ray_aabox(const PreparedRay<T>& prepared, const PreparedAABox<T>& box) {
  const MotionInLanes<T> motion = motion_in_lanes(prepared, box);
  const Lanes<T> inverse = load_last_three(prepared, prepared.inverse);
  const CertainEntry<T> entry = certain_entry(motion, [&](const Lanes<T>& gap) { return gap * inverse; });
  if (!entry.decided) return std::nullopt;
  const Lanes<T> location = select(Lanes<T>::mask(entry.inside), motion.at, entry.at & Lanes<T>::mask(entry.enters));
  return RayHit<T>{to_vec3(location), entry.inside || entry.enters, entry.inside};
}

/// Whether the order of the last entry and the first exit is certain, for a ray with these inverses.
///
/// An inverse has an error of 1 u (u is the unit roundoff), unless it was clamped; none is below `least_inverse`. So a
/// time has an error of 3 u of itself, or it has underflowed and is far below `least`, or it or its gap has overflowed
/// and it is far above `most`; the infinite time of a ray parallel to a pair of faces is exact. Two such times are in
/// the computed order if they differ by more than 8 u, the later one is at least `least`, and the earlier one at most
/// `most`. An exit before 0 is a miss without a bound, because signs do not round. An entry of 0 stands for a start
/// inside, or one outside by an underflow.
template <class T>
bool is_certain_order(const Lanes<T>& inverse, const Pair<T>& entry, const Pair<T>& exit) {
  using L = Lanes<T>;
  using P = Pair<T>;
  using limits = std::numeric_limits<T>;
  constexpr T most = std::same_as<T, float> ? T(0x1p80) : T(0x1p700), least = 1 / most;
  constexpr T least_inverse = std::same_as<T, float> ? T(0x1p-40) : T(0x1p-300);
  static_assert(limits::max() * least_inverse > most * 16);
  const L steepness = absolute(inverse), clamped = steepness == L::splat(limits::max());
  const P margin = P::splat(apart_in_time<T>), in_order = (entry * margin < exit) | (exit * margin < entry);
  const P in_range = (P::splat(least) <= larger(entry, exit)) & (smaller(entry, exit) <= P::splat(most));
  const P certain = (in_order & in_range) | (exit < P::splat(T(0)));
  return all_three(and_not(L::splat(least_inverse) <= steepness, clamped) & broadcast_first(certain));
}

}  // namespace detail

#endif

COLLIDE_COMPILED(ray_aabox)

namespace kernels {

template <class Tier, class T>
inline RayHit<T> ray_aabox(const PreparedRay<T>& ray, const PreparedAABox<T>& box) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) return detail::ray_aabox_in_lanes(ray, box, [](const auto&...) {});
  if constexpr (uses_filter<Tier, T>) {
    if (const auto answer = detail::filtered_ray_aabox(ray, box)) return Tier::decided_by_filter(*answer);
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    const auto kernel = [&](auto arithmetic, const auto& r, const auto& b) {
      if constexpr (Tier::template computes_in<T>)
        return kernels::ray_aabox<decltype(arithmetic)>(ray, box);
      else
        return kernels::ray_aabox<decltype(arithmetic)>(prepare_ray<decltype(arithmetic)>(r),
                                                        prepare_aabox<decltype(arithmetic)>(b));
    };
    return Tier::lift(kernel, ray.ray, box.aabox);
  } else {
    const std::array<T, 3> at = components(ray.ray.origin), step = components(ray.ray.direction);
    const std::array<T, 3> low = components(box.aabox.min), high = components(box.aabox.max);
    bool inside = true;
    for (int i = 0; i < 3; ++i) inside = inside && low[i] <= at[i] && at[i] <= high[i];
    if (inside) return {ray.ray.origin, true, true};
    const std::array<T, 3> inverse = components(ray.inverse);
    const auto entry =
        detail::enter_box(at, step, low, high, [&](const T& gap, int i) -> T { return gap * inverse[i]; });
    if (entry.axis < 0) return {};
    return {{entry.at[0], entry.at[1], entry.at[2]}, true, false};
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline RayHit<T> ray_aabox(const PreparedRay<T>& ray, const PreparedAABox<T>& box) {
#if defined(COLLIDE_LANES)
  bool is_certain = false;
  const auto look = [&](const auto&... times) COLLIDE_INLINE { is_certain = detail::is_certain_order(times...); };
  const RayHit<T> answer = detail::ray_aabox_in_lanes(ray, box, look);
  if (is_certain) return answer;
#endif
  return kernels::ray_aabox<TierOfDecisions<Tier>>(ray, box);
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
