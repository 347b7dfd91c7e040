/// The filter of Certified for the penetration of two boxes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/box_pair_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

#if defined(COLLIDE_LANES)

namespace collide::detail {

/// The axis that certainly separates two boxes, or along which they certainly overlap least; the side of box 1 on which
/// box 2 certainly lies then (+1 or -1). The axis is -1 where none is certain.
struct CertainAxis {
  int axis = -1;
  bool apart = false;
  int side = 1;
};

/// Along an axis of box 1, a gap times N = N1 N2 has an error of 24 u N S, along another axis, times N N1, of less than
/// 96 u N N1 S (filtered_overlap of two boxes; u = 2^-53). The length of a cross product has one of 66 u N: as a gap is
/// at most sqrt(2) S times it, this counts as 94 u N N1 S of the gap. So with a bound of 2^8 u N S, or N N1 S, a depth
/// lies between those of the gaps that are smaller and larger by the bound, whose squares have an error of less than
/// 2^5 u of themselves.
template <class T>
CertainAxis certain_axis(const Box<T>& box1, const Box<T>& box2) {
  using L = Lanes<double>;
  const L between = wide_lanes(box2.center) - wide_lanes(box1.center), zero = L::splat(0.0);
  const auto wide = [](const Quaternion<T>& q) { return Quaternion<double>{q.x, q.y, q.z, q.w}; };
  const BoxPairInLanes<double> pair(wide(box1.orientation), wide(box2.orientation), between, wide_lanes(box1.half),
                                    wide_lanes(box2.half));
  const double lengths = sum_of_three(absolute(between) + absolute(pair.half1) + absolute(pair.half2)).first();
  if (!(pair.is_valid() && lengths >= 0x1p-400 && lengths <= 0x1p400)) return {};
  const L bound = L::splat(0x1p-45 * lengths) * pair.norm1 * pair.norm2, of_others = bound * pair.norm1;
  std::array<SeparationsInLanes<double>, 5> all;
  unsigned apart = 0, overlap = 0;
  const auto look_at = [&](int n, const auto& s) COLLIDE_INLINE {
    const L& least = n == 0 ? bound : of_others;
    all[std::size_t(n)] = s;
    apart |= unsigned((least < s.gap).bits() & 7) << 3 * n;
    overlap |= unsigned((s.gap < zero - least).bits() & 7) << 3 * n;
  };
  pair.for_each_face_axis(look_at);
  if (apart != 0) {  // a gap of some size has enough digits: the other axes need no look
    const L gap1 = all[0].gap * pair.norm1, widest = largest_of_three(larger(gap1, all[1].gap));
    const unsigned is_widest = unsigned((gap1 == widest).bits() & 7) | unsigned((all[1].gap == widest).bits() & 7) << 3;
    if (widest.first() > 0x1p39 * of_others.first()) return {axis_of_bit(first_bit(is_widest & apart)), true, 1};
  }
  pair.for_each_cross_axis(look_at);
  if (apart == 0 && overlap != (1u << box_box_axes) - 1) return {};
  const auto square = [&](std::size_t n, double by)
                          COLLIDE_INLINE {  // of the gap, closer to zero or farther by the bound
                            const L gap = absolute(all[n].gap) + L::splat(by) * (n == 0 ? bound : of_others);
                            return gap * gap / all[n].length2;
                          };
  if (apart != 0) {  // the widest gap has the most digits
    std::array<L, 5> wide_gap;
    for (std::size_t n = 0; n < 5; ++n) wide_gap[n] = square(n, 0) & (zero < all[n].gap);
    const L most = largest_of_three(
        larger(larger(larger(wide_gap[0], wide_gap[1]), larger(wide_gap[2], wide_gap[3])), wide_gap[4]));
    unsigned is_most = 0;
    for (std::size_t n = 0; n < 5; ++n) is_most |= unsigned((wide_gap[n] == most).bits() & 7) << 3 * n;
    return {axis_of_bit(first_bit(is_most & apart)), true, 1};
  }
  std::array<L, 5> low;
  for (std::size_t n = 0; n < 5; ++n) low[n] = square(n, -1);
  const L least = smallest_of_three(smaller(smaller(smaller(low[0], low[1]), smaller(low[2], low[3])), low[4]));
  unsigned is_least = 0, is_near = 0;
  for (std::size_t n = 0; n < 5; ++n) is_least |= unsigned((low[n] == least).bits() & 7) << 3 * n;
  const int bit = first_bit(is_least);
  if (bit >= box_box_axes) return {};
  const auto number = [bit](const L& lanes) { return to_array(lanes)[std::size_t(bit % 3)]; };
  const auto& s = all[std::size_t(bit / 3)];
  const L most = L::splat(number(square(std::size_t(bit / 3), 1)) * (1 + 0x1p-40));
  for (std::size_t n = 0; n < 5; ++n) is_near |= unsigned((low[n] <= most).bits() & 7) << 3 * n;
  const double toward = number(s.toward);
  if (is_near != 1u << bit || !(detail::abs(toward) > of_others.first() + bound.first())) return {};
  return {axis_of_bit(bit), false, toward < 0 ? -1 : 1};
}

/// The penetration of two boxes whose decisive axis is certain, or nullopt.
template <class T, class W>
std::optional<BoxPenetration<T>> penetration_along(const Box<T>& box1, const Box<T>& box2, const CertainAxis& least,
                                                   double size) {
  const auto n = std::size_t(least.axis);
  if (n >= 6) {
    const std::size_t i = (n - 6) / 3, j = (n - 6) % 3;
    if (!least.apart) return edge_penetration<T, W>(box1, box2, i, j, size);
    // A gap is at most the distance of the centers, so the error of the sine counts as 12 u of the size, by the sine.
    const CrossGap<W> cross = cross_gap<T, W>(box1, box2, i, j);
    const W gap = cross.by_sine / cross.sine;
    const auto sine = double(leading_part(cross.sine / cross.norm));
    if (!is_accurate_length<T>(gap, 28 * size_along_cross(box1, box2, i, j) / sine)) return std::nullopt;
    return BoxPenetration<T>{-T(leading_part(gap)), least.axis, {}, {}};
  }
  const bool first = n < 3;
  const Box<T>&box = first ? box1 : box2, &other = first ? box2 : box1;
  if (least.apart) {
    const W gap = face_gap<T, W>(box, other, n % 3);
    if (!is_accurate_length<T>(gap, 16 * size_along_face(box, other, n % 3))) return std::nullopt;
    return BoxPenetration<T>{-T(leading_part(gap)), least.axis, {}, {}};
  }
  auto answer = face_penetration<T, W>(box, other, n % 3, first ? least.side : -least.side, size);
  if (answer && !first) answer->normal = -answer->normal;
  return answer;
}

/// Filter: the penetration of two boxes, or nullopt. The contact of two edges needs more digits than long double has.
template <class T>
std::optional<BoxPenetration<T>> filtered_penetration(const Box<T>& given1, const Box<T>& given2) {
  const Box<T> box1 = with_rescaled_rotation(given1), box2 = with_rescaled_rotation(given2);
  const double size = size_of_pair(box1, box2);
  if (!(size > 0)) return std::nullopt;
  const CertainAxis least = certain_axis(box1, box2);
  if (least.axis < 0) return std::nullopt;
  std::optional<BoxPenetration<T>> answer;
  if constexpr (has_wider<T>) {
    if (std::same_as<T, float> || least.apart || least.axis < 6)
      answer = penetration_along<T, Wider<T>>(box1, box2, least, size);
  }
  if constexpr (std::same_as<T, double>) {
    if (!answer) answer = penetration_along<T, DoubleWord<double>>(box1, box2, least, size);
  }
  if (answer) answer->axis = least.axis;
  return answer;
}

}  // namespace collide::detail

#endif

#include <collide/detail/strict_end.hpp>
