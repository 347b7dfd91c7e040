/// The filter of Certified for a moving point and an axis-aligned box, shared by ray_aabox and moving_point_aabox.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include <collide/detail/number.hpp>
#include <collide/detail/wide_lanes.hpp>

#include <collide/detail/strict_begin.hpp>

#if defined(COLLIDE_LANES)

namespace collide::detail {

/// A motion at + step t, and a box { x : low <= x <= high }.
template <class T>
struct MotionInLanes {
  Lanes<T> at, step, low, high;
};

/// What is certain about the entry of a moving point into a box. Where `decided` is false, nothing is. A point that
/// neither enters nor starts inside misses the box.
template <class T>
struct CertainEntry {
  bool decided = false;
  bool inside = false;  ///< the point starts in the closed box
  bool enters = false;  ///< the point starts outside and enters
  T time{};             ///< of the entry
  Lanes<T> at{};        ///< the place of the entry
  Lanes<T> axis{};      ///< mask of the coordinate in which the point enters
};

/// The time and the place of an entry through the plane `face` in the coordinate `axis` (a mask of one lane). Each has
/// an error of less than half a unit in the last place (of the largest number) before the last rounding, or `accurate`
/// is false.
///
/// Let u be the unit roundoff of the wider type, and W u that of T. The time has an error of 2 u of itself: one
/// difference and one quotient. So the place has an error of 3 u of the way there and 1 u of itself. The way is at most
/// |start| + |place|, where |x| is the largest number of x. If |start| <= W / 16 |place|, the error of the place is at
/// most (3 W / 16 + 4) u |place| < W u |place| / 4.
template <class T>
struct EntryNumbers {
  bool accurate = false;
  T time{};
  Lanes<T> at{};
};

template <class T>
bool way_is_short(const Lanes<T>& start, const Lanes<T>& place) {
  constexpr int wider_by = std::numeric_limits<Wider<T>>::digits - std::numeric_limits<T>::digits;
  static_assert(std::same_as<T, double> || wider_by == 29);
  const Lanes<T> most = Lanes<T>::splat(T(1 << (wider_by - 4)));
  return all_three(absolute(start) <= largest_of_three(absolute(place)) * most);
}

inline EntryNumbers<float> entry_numbers(const MotionInLanes<float>& m, const Lanes<float>& face,
                                         const Lanes<float>& axis) {
  const Lanes<double> from = in_doubles(m.at), along = in_doubles(m.step);
  const Lanes<double> times = (in_doubles(face) - from) / along;
  const Lanes<double> time = sum_of_three(times & mask_in_doubles(axis));
  const Lanes<float> at = in_floats(from + along * time);
  return {way_is_short(m.at, at), float(time.first()), at};
}

inline EntryNumbers<double> entry_numbers(const MotionInLanes<double>& m, const Lanes<double>& face,
                                          const Lanes<double>& axis) {
  EntryNumbers<double> numbers;
  if constexpr (has_wider<double>) {
    using W = Wider<double>;
    const auto i = std::size_t((axis.bits() & 7) / 2);  // of one bit
    const std::array<double, 4> from = to_array(m.at), along = to_array(m.step);
    const W time = (W(to_array(face)[i]) - W(from[i])) / W(along[i]);
    const auto reached = [&](std::size_t k) { return double(W(from[k]) + W(along[k]) * time); };
    numbers.at = Lanes<double>::of(reached(0), reached(1), reached(2));
    numbers.time = double(time);
    numbers.accurate = way_is_short(m.at, numbers.at);
  }
  return numbers;
}

/// Whether a moving point certainly enters a box, starts in it, or misses it, and the times of its entries between the
/// pairs of faces (0 for a start between). Where `decided` is false, nothing is certain.
template <class T>
struct CertainPassageOfBox {
  bool decided = false, inside = false, enters = false;
  Lanes<T> entries{};
  Pair<T> entry{};  ///< the last of them
};

/// The factor by which two times have to differ to be in the computed order.
template <class T>
inline constexpr T apart_in_time = T(1) + 4 * std::numeric_limits<T>::epsilon();

/// Filter: what is certain about a moving point and a box. `over(gap)` is the time in which the motion crosses a gap
/// along each axis, with an error of 2 u of itself (u is the unit roundoff of T).
///
/// The point is between a pair of faces from its entry there to its exit, and in the box from the last entry to the
/// first exit. A start in the box is decided by comparing inputs. A pair parallel to the motion has infinite times, of
/// one sign where the start lies beside it; the time to a face in which such a motion lies is NaN and is ignored.
///
/// All numbers are at most `most`, and no step is below `least`, except 0. So no time overflows, and a gap has an error
/// of 1 u: a time has an error of 3 u of itself, or lies below `least` and may have underflowed. Two times in which
/// the later is at least `least` are in the computed order if they differ by more than 8 u. An exit before 0 is a miss
/// without a bound, because signs do not round.
template <class T, class Over>
COLLIDE_INLINE inline CertainPassageOfBox<T> certain_passage(const MotionInLanes<T>& m, Over over) {
  using L = Lanes<T>;
  using P = Pair<T>;
  constexpr T most = std::same_as<T, float> ? T(0x1p40) : T(0x1p400), least = T(1) / most;
  const L zero = L::splat(T(0)), speed = absolute(m.step);
  const L in_range = (absolute(m.at) + absolute(m.low) + absolute(m.high) + speed <= L::splat(most)) &
                     ((L::splat(least) <= speed) | (m.step == zero));
  CertainPassageOfBox<T> passage;
  if (!all_three(in_range)) return passage;
  passage.inside = all_three((m.low <= m.at) & (m.at <= m.high));
  const L to_low = over(m.low - m.at), to_high = over(m.high - m.at);
  // If one of two numbers is NaN, larger and smaller return the first. Exits are clamped to finite numbers, so an
  // infinite entry comes after every exit.
  passage.entries = larger(zero, smaller(to_low, to_high));
  const L exits = smaller(L::splat(std::numeric_limits<T>::max()), larger(to_high, to_low));
  passage.entry = largest_of(passage.entries);
  const P exit = smallest_of(exits), margin = P::splat(apart_in_time<T>);
  const P known = P::splat(least) <= passage.entry;
  passage.enters = (known & (passage.entry * margin < exit)).bits() & 1;
  const bool misses = ((exit < P::splat(T(0))) | (known & (exit * margin < passage.entry))).bits() & 1;
  passage.decided = passage.inside || passage.enters || misses;
  return passage;
}

/// Filter: where and when a point certainly enters a box, starts in it, or misses it. The axis of the entry is certain
/// if every other entry is earlier by more than 8 u.
template <class T, class Over>
inline CertainEntry<T> certain_entry(const MotionInLanes<T>& m, Over over) {
  using L = Lanes<T>;
  const CertainPassageOfBox<T> passage = certain_passage(m, over);
  CertainEntry<T> answer;
  answer.decided = passage.decided, answer.inside = passage.inside, answer.enters = passage.enters;
  if constexpr (std::same_as<T, double>) {  // two registers and long double cost more than a mispredicted branch
    if (!answer.enters) return answer;
  }
  answer.axis = broadcast_first(passage.entry) <= passage.entries * L::splat(apart_in_time<T>);
  const int axis = answer.axis.bits() & 7;
  const L face = select(L::splat(T(0)) < m.step, m.low, m.high);
  const EntryNumbers<T> numbers = entry_numbers(m, face, answer.axis);
  answer.decided = answer.decided && (!answer.enters || (numbers.accurate && (axis & (axis - 1)) == 0));
  answer.time = numbers.time;
  answer.at = select(answer.axis, face, smaller(larger(numbers.at, m.low), m.high));
  return answer;
}

}  // namespace collide::detail

#endif

#include <collide/detail/strict_end.hpp>
