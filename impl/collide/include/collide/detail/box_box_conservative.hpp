/// The kernel of box_box_conservative (collide/box_box_conservative.hpp).
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Whether |between| <= |half1| + |half2|. Rounds to yes: the result is never no where the inequality holds in real
/// numbers.
template <class T>
bool may_reach(const Vec3<T>& half1, const Vec3<T>& half2, const Vec3<T>& between) {
  const std::array<T, 3> d = components(between), a = components(half1), b = components(half2);
  T distance = length(d), reach = length(a) + length(b);
  if constexpr (MachineNumber<T>) {
    // To first order, a length has an error of 1 eps from the difference of the centers, half of 1 + 2 eps from the
    // squares and their sums, and 1 eps from the square root (as much again after a division that avoids underflow).
    // The sum of the two lengths adds 1 eps. A slack of 4 ulps, 8 eps, is more than twice the error of the comparison.
    constexpr T slack = T(4) * std::numeric_limits<T>::epsilon();
    reach = reach + (reach * slack + std::numeric_limits<T>::denorm_min());
    if (distance > std::numeric_limits<T>::max()) {  // the squares overflow
      using detail::abs;
      const T largest = larger(larger(larger(abs(d[0]), abs(d[1])), abs(d[2])),
                               larger(larger(larger(a[0], a[1]), a[2]), larger(larger(b[0], b[1]), b[2])));
      if (!(largest <= std::numeric_limits<T>::max())) return false;
      const T scale = detail::ldexp(T(1), -detail::ilogb(largest) - 1);
      return may_reach(half1 * scale, half2 * scale, between * scale);
    }
  }
  return distance <= reach;
}

/// Filter: whether |between| <= |half1| + |half2|, if that is certain. `between` has an error of 1 u of itself
/// (u = 2^-53).
///
/// Each length, and the sum of two, has an error of 3.5 u of itself, and their difference one of 1 u. Squares that
/// underflow change a length by less than 2^-530. The filter uses a bound of 16 u.
inline std::optional<bool> certainly_reaches(const Vec3<double>& half1, const Vec3<double>& half2,
                                             const Vec3<double>& between) {
  const auto length_of = [](const Vec3<double>& v) { return detail::sqrt(Plain::dot(v, v)); };
  const double distance = length_of(between), reach = length_of(half1) + length_of(half2), all = distance + reach;
  if (!(all >= 0x1p-400 && all <= 0x1p400)) return std::nullopt;
  const double gap = distance - reach, bound = 0x1p-49 * all;
  if (!(detail::abs(gap) > bound)) return std::nullopt;
  return gap < 0;
}

/// The answer of a filter for finite input, or nullopt.
template <class T, class... Args>
std::optional<Decision<T>> certain_reach(const Vec3<double>& half1, const Vec3<double>& half2,
                                         const Vec3<double>& between, const Args&... args) {
  const std::optional<bool> reaches = certainly_reaches(half1, half2, between);
  if (!reaches || !all_finite(args...)) return std::nullopt;
  return Decision<T>{*reaches};
}

}  // namespace detail

COLLIDE_COMPILED(box_box_conservative)

namespace kernels {

template <class Tier, class T>
inline Decision<T> box_box_conservative(const Box<T>& box1, const Box<T>& box2) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      using detail::in_double;
      if (const auto answer = detail::certain_reach<T>(in_double(box1.half), in_double(box2.half),
                                                       in_double(box2.center) - in_double(box1.center), box1, box2))
        return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(box_box_conservative, box1, box2);
  } else {
    return {detail::may_reach(box1.half, box2.half, box2.center - box1.center)};
  }
}

template <class Tier, class T>
inline Decision<T> box_box_conservative(const BoxBoxInfo<T>& info) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      using detail::in_double;
      if (const auto answer =
              detail::certain_reach<T>(in_double(info.half1), in_double(info.half2), in_double(info.between), info))
        return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(box_box_conservative, info);
  } else {
    return {detail::may_reach(info.half1, info.half2, info.between)};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
