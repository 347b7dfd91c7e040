/// The kernel of moving_point_aabox (collide/moving_point_aabox.hpp).
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/enter_box.hpp>
#include <collide/detail/entry_filter.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

template <class T>
MotionInLanes<T> motion_in_lanes(const Vec3<T>& point, const Vec3<T>& velocity, const AABox<T>& aabox) {
  return {lanes(point), lanes(velocity), lanes(aabox.min), lanes(aabox.max)};
}

/// The time in which the motion crosses a gap, with an error of 1 u of itself. A divisor of -0 becomes +0, because the
/// sign of an infinite time tells on which side of a pair of faces the motion passes.
template <class T>
auto quotient_by_step(const MotionInLanes<T>& motion) {
  return [divisor = motion.step + Lanes<T>::splat(T(0))](const Lanes<T>& gap) { return gap / divisor; };
}

/// The answer for a point that starts inside, for one that enters at a time and a place through a face across `axis` (a
/// mask of one lane), and for one that misses.
template <class T>
Entry<T> entry_from_lanes(const MotionInLanes<T>& motion, bool inside, bool enters, T time, const Lanes<T>& at,
                          const Lanes<T>& axis) {
  using L = Lanes<T>;
  const L entered = L::mask(enters), side = L::splat(T(1)) ^ (motion.step & L::splat(T(-0.0)));
  Entry<T> answer;
  answer.inside = inside;
  answer.location = to_vec3(select(L::mask(inside), motion.at, at & entered));
  answer.time = select(entered, L::splat(time), L::splat(std::numeric_limits<T>::infinity())).first();
  answer.normal = to_vec3(((L::splat(T(0)) - side) & axis) & entered);
  return answer;
}

/// Filter: the certain answer, or nullopt.
template <class T>
inline std::optional<Entry<T>> filtered_entry(const Vec3<T>& point, const Vec3<T>& velocity, const AABox<T>& aabox) {
  const MotionInLanes<T> motion = motion_in_lanes(point, velocity, aabox);
  const CertainEntry<T> entry = certain_entry(motion, quotient_by_step(motion));
  if (!entry.decided) return std::nullopt;
  return entry_from_lanes(motion, entry.inside, entry.enters, entry.time, entry.at, entry.axis);
}

/// Filter: an answer with a certain decision and the numbers of enter_box, or nullopt.
template <class T>
inline std::optional<Entry<T>> decided_entry(const Vec3<T>& point, const Vec3<T>& velocity, const AABox<T>& aabox) {
  using L = Lanes<T>;
  const MotionInLanes<T> motion = motion_in_lanes(point, velocity, aabox);
  const CertainPassageOfBox<T> passage = certain_passage(motion, quotient_by_step(motion));
  if (!passage.decided) return std::nullopt;
  const L time = broadcast_first(passage.entry), axis = time == passage.entries;
  const L face = select(L::splat(T(0)) < motion.step, motion.low, motion.high);
  const L reached = smaller(larger(motion.at + motion.step * time, motion.low), motion.high);
  return entry_from_lanes(motion, passage.inside, passage.enters && !passage.inside, time.first(),
                          select(axis, face, reached), first_of_three(axis));
}

}  // namespace detail

#endif

COLLIDE_COMPILED(moving_point_aabox)

namespace kernels {

template <class Tier, class T>
inline Entry<T> moving_point_aabox(const Vec3<T>& point, const Vec3<T>& velocity, const AABox<T>& aabox) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {
    using L = detail::Lanes<T>;
    using detail::lanes;
    const L step = lanes(velocity);
    const auto entry = detail::enter_box(lanes(point), step, lanes(aabox.min), lanes(aabox.max),
                                         [&](const L& gap) { return gap / step; });
    const bool inside = entry.enters & entry.inside, enters = entry.enters & !inside;
    const L normal = select(entry.below, L::splat(T(-1)), L::splat(T(1))) & first_of_three(entry.axis);
    Entry<T> answer;
    answer.inside = inside;
    answer.location = to_vec3(entry.at & L::mask(entry.enters));
    answer.time = select(L::mask(enters), entry.time, L::splat(std::numeric_limits<T>::infinity())).first();
    answer.normal = to_vec3(normal & L::mask(enters));
    return answer;
  }
  if constexpr (uses_filter<Tier, T>) {
    if (const auto answer = detail::filtered_entry(point, velocity, aabox)) return Tier::decided_by_filter(*answer);
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_point_aabox, point, velocity, aabox);
  } else {
    const std::array<T, 3> at = components(point), step = components(velocity);
    const std::array<T, 3> low = components(aabox.min), high = components(aabox.max);
    bool inside = true;
    for (int i = 0; i < 3; ++i) inside = inside && low[i] <= at[i] && at[i] <= high[i];
    Entry<T> answer;
    if (inside) {
      answer.inside = true;
      answer.location = point;
      return answer;
    }
    const auto entry = detail::enter_box(at, step, low, high, [&](const T& gap, int i) -> T { return gap / step[i]; });
    if (entry.axis < 0 || !(entry.time <= std::numeric_limits<T>::max())) return Entry<T>::miss();
    std::array<T, 3> normal{};
    normal[entry.axis] = entry.side;
    answer.location = {entry.at[0], entry.at[1], entry.at[2]};
    answer.time = entry.time;
    answer.normal = {normal[0], normal[1], normal[2]};
    return answer;
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline Entry<T> moving_point_aabox(const Vec3<T>& point, const Vec3<T>& velocity, const AABox<T>& aabox) {
#if defined(COLLIDE_LANES)
  if (const auto answer = detail::decided_entry(point, velocity, aabox)) return *answer;
#endif
  return kernels::moving_point_aabox<TierOfDecisions<Tier>>(point, velocity, aabox);
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
