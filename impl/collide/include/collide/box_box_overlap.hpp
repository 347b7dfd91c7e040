/// Whether two boxes overlap.
#pragma once

#include <cstdint>

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/double_word.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

namespace detail {

/// Both boxes, their quaternions q1 and q2 brought to a moderate length, with every number multiplied by
/// |q1|^2 |q2|^2 (by |q1|^2 for the centers): each is a polynomial of the input, and nothing is divided.
template <class N>
struct BoxPair {
  std::array<std::array<N, 3>, 3> cosine;  ///< axis i of box 1 . axis j of box 2, times |q1|^2 |q2|^2
  std::array<N, 3> between;                ///< center 2 - center 1 along the axes of box 1, times |q1|^2
  std::array<N, 3> half1, half2;
  N norm1, norm2;                          ///< |q1|^2, |q2|^2
};

/// The matrix of the rotation q, times |q|^2, columns first. Entries are sums of products without
/// cancellation between equal terms: rotations by nearly nothing keep their small entries.
template <class N>
std::array<std::array<N, 3>, 3> scaled_axes(const std::array<N, 4>& q) noexcept {
  const auto& [x, y, z, w] = q;
  const N two(1 + 1);
  return {{{(w * w - z * z) + (x * x - y * y), two * (x * y + w * z), two * (x * z - w * y)},
           {two * (x * y - w * z), (w * w - x * x) + (y * y - z * z), two * (y * z + w * x)},
           {two * (x * z + w * y), two * (y * z - w * x), (w * w - y * y) + (z * z - x * x)}}};
}

template <class N, class T>
BoxPair<N> pair_of(const Box<T>& box1, const Box<T>& box2) noexcept {
  const auto wide = [](const Quaternion<T>& q) {
    if constexpr (!MachineNumber<T>) return std::array<N, 4>{q.x, q.y, q.z, q.w};
    else {
    const T largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)});
    // A power of two, so that nothing is rounded; most quaternions are of moderate length already.
    const bool moderate = largest >= T(0.0625) && largest <= T(16);
    const bool usable = largest > T(0) && largest <= std::numeric_limits<T>::max();
    const T scale = moderate || !usable ? T(1) : std::ldexp(T(1), -std::ilogb(largest));
    return std::array<N, 4>{N(q.x * scale), N(q.y * scale), N(q.z * scale), N(q.w * scale)};
    }
  };
  const std::array<N, 4> a = wide(box1.orientation), b = wide(box2.orientation);
  // conj(a) * b: the rotation of box 2 seen from box 1
  const std::array<N, 4> r{(a[3] * b[0] - a[0] * b[3]) - (a[1] * b[2] - a[2] * b[1]),
                           (a[3] * b[1] - a[1] * b[3]) - (a[2] * b[0] - a[0] * b[2]),
                           (a[3] * b[2] - a[2] * b[3]) - (a[0] * b[1] - a[1] * b[0]),
                           (a[3] * b[3] + a[0] * b[0]) + (a[1] * b[1] + a[2] * b[2])};
  const auto axes1 = scaled_axes(a), axes2 = scaled_axes(r);
  BoxPair<N> pair;
  const std::array<N, 3> d{N(box2.center.x) - N(box1.center.x), N(box2.center.y) - N(box1.center.y),
                           N(box2.center.z) - N(box1.center.z)};
  for (int i = 0; i < 3; ++i) {
    pair.between[i] = axes1[i][0] * d[0] + axes1[i][1] * d[1] + axes1[i][2] * d[2];
    for (int j = 0; j < 3; ++j) pair.cosine[i][j] = axes2[j][i];
  }
  pair.norm1 = (a[0] * a[0] + a[1] * a[1]) + (a[2] * a[2] + a[3] * a[3]);
  pair.norm2 = (b[0] * b[0] + b[1] * b[1]) + (b[2] * b[2] + b[3] * b[3]);
  pair.half1 = {N(box1.half.x), N(box1.half.y), N(box1.half.z)};
  pair.half2 = {N(box2.half.x), N(box2.half.y), N(box2.half.z)};
  return pair;
}

/// What an axis says: how far the projections lie apart (negative: they overlap), and the size of the
/// terms of which that is the difference.
template <class N>
struct Separation {
  N gap, terms;
};

/// `axis`: 0-2 the axes of box 1, 3-5 of box 2, 6 + 3 i + j the cross product of axis i and axis j.
template <class N>
Separation<N> separation(const BoxPair<N>& p, int axis) noexcept {
  using std::abs;
  N distance, reach1, reach2;
  if (axis < 3) {
    const auto& row = p.cosine[axis];
    distance = abs(p.between[axis]) * p.norm2;
    reach1 = p.half1[axis] * p.norm1 * p.norm2;
    reach2 = p.half2[0] * abs(row[0]) + p.half2[1] * abs(row[1]) + p.half2[2] * abs(row[2]);
  } else if (axis < 6) {
    const int j = axis - 3;
    const auto& c = p.cosine;
    distance = abs(p.between[0] * c[0][j] + p.between[1] * c[1][j] + p.between[2] * c[2][j]);
    reach1 = (p.half1[0] * abs(c[0][j]) + p.half1[1] * abs(c[1][j]) + p.half1[2] * abs(c[2][j])) * p.norm1;
    reach2 = p.half2[j] * p.norm1 * p.norm1 * p.norm2;
  } else {
    const int i = (axis - 6) / 3, j = (axis - 6) % 3;
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    const auto& c = p.cosine;
    distance = abs(p.between[i2] * c[i1][j] - p.between[i1] * c[i2][j]);
    reach1 = (p.half1[i1] * abs(c[i2][j]) + p.half1[i2] * abs(c[i1][j])) * p.norm1;
    reach2 = (p.half2[j1] * abs(c[i][j2]) + p.half2[j2] * abs(c[i][j1])) * p.norm1;
  }
  return {distance - (reach1 + reach2), distance + (reach1 + reach2)};
}

}  // namespace detail

/// Whether the closed boxes meet. `hint` (-1, or an axis 0..14 that separated them last time) may
/// speed the answer up and never changes it.
///
/// 1. box_box_overlap(a, b, h) == box_box_overlap(a, b, -1)
///
/// Source: separating axes (Gottschalk, Lin, Manocha, OBBTree, 1996). An axis along the cross product
/// of two nearly parallel edges is nearly nothing but rounding error, so a cross axis whose gap is
/// within its error bound is asked again in twice the precision instead of being believed or dropped.
template <class Tier = Fast, class T>
Decision<T> box_box_overlap(const Box<T>& box1, const Box<T>& box2, int hint = -1) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_overlap<decltype(by)>(a...); }, box1, box2, hint);
  }
  if constexpr (!MachineNumber<T>) {
    const detail::BoxPair<T> pair = detail::pair_of<T>(box1, box2);
    for (int axis = 0; axis < 15; ++axis) {
      if (detail::separation(pair, axis).gap > T(0)) return {false};
    }
    return {true};
  } else {
  // Each cosine is a polynomial of degree 4 in the quaternions; with its rotation it carries at most
  // 16 eps of |q1|^2 |q2|^2, each product and sum after it 1 eps: 32 eps of the largest terms.
  constexpr T error = 32 * (std::numeric_limits<T>::epsilon() / 2);
  const detail::BoxPair<T> pair = detail::pair_of<T>(box1, box2);
  const T largest_half = std::max({box1.half.x, box1.half.y, box1.half.z, box2.half.x, box2.half.y, box2.half.z});
  const T across = std::max({std::abs(pair.between[0]), std::abs(pair.between[1]), std::abs(pair.between[2])}) *
                       pair.norm2 + largest_half * pair.norm1 * pair.norm2;
  std::uint32_t unsure = 0;
  const auto separates = [&](int axis) {
    const detail::Separation<T> s = detail::separation(pair, axis);
    if (axis < 6) return !(s.gap <= T(0));  // NaN separates: it must not look like an overlap
    const T bound = error * across * pair.norm1;
    if (!(s.gap <= bound)) return true;
    if (!(s.gap < -bound) && s.terms > T(0)) unsure |= 1u << axis;
    return false;
  };
  if (hint >= 0 && hint < 15 && separates(hint)) return {false};
  for (int axis = 0; axis < 15; ++axis) {
    if (separates(axis)) return {false};
  }
  if (unsure == 0) return {true};
  const auto wide = detail::pair_of<Wide<T>>(box1, box2);
  const Wide<T> bound(T(2) * T(wide_epsilon<T> / std::numeric_limits<T>::epsilon()) * error * across * pair.norm1);
  for (int axis = 6; axis < 15; ++axis) {
    if ((unsure >> axis & 1u) != 0 && detail::separation(wide, axis).gap > bound) return {false};
  }
  return {true};
  }
}

namespace inputs {
template <class T>
struct box_box_overlap {
  Box<T> box1{}, box2{};
  int hint = -1;

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_overlap::box1), member("box2", &box_box_overlap::box2),
                      member("hint", &box_box_overlap::hint, Role::index));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::box_box_overlap<Tier>(box1, box2, hint);
  }

  /// First order: each cosine carries 32 eps, which a rotation of either box by as much explains; a cross
  /// axis is decided within the error of twice the precision, where a gap of eps remains invisible: its
  /// square root in the wider precision is 1 eps. Lengths take 4 eps.
  static constexpr Contract contract(Fast) {
    return {.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
