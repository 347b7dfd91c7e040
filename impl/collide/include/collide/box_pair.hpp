/// Two boxes seen from each other: what the queries about pairs of boxes compute first.
#pragma once

#include <array>
#include <cmath>

#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The axes of a pair of boxes: 0-2 those of box 1, 3-5 those of box 2, 6 + 3 i + j the cross product of
/// axis i of box 1 and axis j of box 2.
inline constexpr int box_box_axes = 15;

namespace detail {

/// x, y, z, w of a quaternion, brought to a moderate length by a power of two: nothing is rounded.
template <class T>
std::array<T, 4> moderate(const Quaternion<T>& q) noexcept {
  if constexpr (MachineNumber<T>) {
    using std::abs;
    const T largest = larger(larger(abs(q.x), abs(q.y)), larger(abs(q.z), abs(q.w)));
    const bool usable = largest > T(0) && largest <= std::numeric_limits<T>::max();
    if (usable && !(largest >= T(0.0625) && largest <= T(16))) {
      const int down = -std::ilogb(largest);
      return {std::ldexp(q.x, down), std::ldexp(q.y, down), std::ldexp(q.z, down), std::ldexp(q.w, down)};
    }
  }
  return {q.x, q.y, q.z, q.w};
}

/// conj(a) b: the rotation b seen from the rotation a.
template <class T>
std::array<T, 4> seen_from(const std::array<T, 4>& a, const std::array<T, 4>& b) noexcept {
  return {(a[3] * b[0] - a[0] * b[3]) - (a[1] * b[2] - a[2] * b[1]),
          (a[3] * b[1] - a[1] * b[3]) - (a[2] * b[0] - a[0] * b[2]),
          (a[3] * b[2] - a[2] * b[3]) - (a[0] * b[1] - a[1] * b[0]),
          (a[3] * b[3] + a[0] * b[0]) + (a[1] * b[1] + a[2] * b[2])};
}

/// The matrix of the rotation q, times |q|^2, columns first.
template <class T>
std::array<std::array<T, 3>, 3> scaled_axes(const std::array<T, 4>& q) noexcept {
  const auto& [x, y, z, w] = q;
  const T two(2);
  return {{{(w * w - z * z) + (x * x - y * y), two * (x * y + w * z), two * (x * z - w * y)},
           {two * (x * y - w * z), (w * w - x * x) + (y * y - z * z), two * (y * z + w * x)},
           {two * (x * z + w * y), two * (y * z - w * x), (w * w - y * y) + (z * z - x * x)}}};
}

template <class T>
T norm2(const std::array<T, 4>& q) noexcept {
  return (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
}

/// Multiplies two numbers by the same power of two where both are so small that products of them underflow.
template <class T>
void raise(T& a, T& b) noexcept {
  if constexpr (MachineNumber<T>) {
    using std::abs;
    const T largest = larger(abs(a), abs(b));
    constexpr T least = sizeof(T) == sizeof(float) ? T(0x1p-32) : T(0x1p-300);
    if (!(largest < least && largest > T(0))) return;
    const int up = -std::ilogb(largest);
    a = std::ldexp(a, up), b = std::ldexp(b, up);
  }
}

/// The cross product of axis i of box 1 and axis j of box 2, times norm1 norm2 or, where it is asked for as a
/// direction, times another positive number: its numbers i + 1, i + 2 in the frame of box 1, and j + 1, j + 2
/// in that of box 2; the others are 0.
template <class T>
struct CrossAxis {
  std::array<T, 2> in1, in2;
};

/// Both boxes, their quaternions q1 and q2 brought to a moderate length, with every number multiplied by
/// |q1|^2 |q2|^2 (by |q1|^2 for the centers): each is a polynomial of the input, and nothing is divided.
template <class T>
struct BoxPair {
  std::array<T, 4> turn;                   ///< the rotation of box 2 seen from box 1
  std::array<std::array<T, 3>, 3> cosine;  ///< axis i of box 1 . axis j of box 2, times |q1|^2 |q2|^2
  std::array<T, 3> between;                ///< center 2 - center 1 along the axes of box 1, times |q1|^2
  std::array<T, 3> half1, half2;
  T norm1, norm2;                          ///< |q1|^2, |q2|^2

  BoxPair(const Box<T>& box1, const Box<T>& box2) noexcept
      : half1(components(box1.half)), half2(components(box2.half)) {
    const std::array<T, 4> a = moderate(box1.orientation), b = moderate(box2.orientation);
    turn = seen_from(a, b);
    const auto axes1 = scaled_axes(a), columns = scaled_axes(turn);
    const Vec3<T> d = box2.center - box1.center;
    for (int i = 0; i < 3; ++i) {
      between[i] = axes1[i][0] * d.x + axes1[i][1] * d.y + axes1[i][2] * d.z;
      for (int j = 0; j < 3; ++j) cosine[i][j] = columns[j][i];
    }
    norm1 = detail::norm2(a);
    norm2 = detail::norm2(b);
  }

  /// Of nearly parallel axes the cross product is small: each of its numbers is a sum of products p s of
  /// a small p, whose squares add up to 1 - |cosine|, and a large s, so that none is the difference of
  /// large ones and all are as exact, relative to the whole, as `turn` is.
  CrossAxis<T> cross_axis(int i, int j, bool as_direction = true) const noexcept {
    T w = turn[3];
    if (i == j) {
      T v = turn[i], v1 = turn[(i + 1) % 3], v2 = turn[(i + 2) % 3];
      if (as_direction) raise(v1, v2), raise(v, w);
      const T two(2);
      return {{two * (w * v1 - v * v2), two * (v * v1 + w * v2)}, {two * (v * v2 + w * v1), two * (w * v2 - v * v1)}};
    }
    const bool next = j == (i + 1) % 3;
    const T third = next ? turn[3 - i - j] : -turn[3 - i - j];
    T p = turn[i] - turn[j], s = turn[i] + turn[j], q = w + third, t = w - third;
    if (as_direction) raise(p, q), raise(s, t);
    const T jj = q * t - p * s, kj = s * q + p * t;  // cosines [j][j] and +-[k][j], k the third axis
    const T ii = q * t + p * s, ik = s * q - p * t;  // cosines [i][i] and +-[i][k]
    if (next) return {{-kj, jj}, {ii, -ik}};
    return {{-jj, -kj}, {-ik, -ii}};
  }
};

/// A number of a unit vector: rounding does not make it longer than 1.
template <class T>
T at_most_one(const T& x) noexcept {
  if constexpr (MachineNumber<T>) return clamped(x, T(-1), T(1));
  return x;
}
template <class T>
Vec3<T> at_most_one(const Vec3<T>& v) noexcept { return {at_most_one(v.x), at_most_one(v.y), at_most_one(v.z)}; }

/// What an axis says: how far the projections lie apart (negative: they overlap), and the part of
/// center 2 - center 1 along it, both times the same positive number.
template <class T>
struct Separation {
  T gap, toward;
};

template <class T>
Separation<T> separation(const BoxPair<T>& p, int axis, bool as_direction = true) noexcept {
  using std::abs;
  if (axis < 3) {
    const auto& row = p.cosine[axis];
    const T toward = p.between[axis] * p.norm2;
    const T reach1 = p.half1[axis] * p.norm1 * p.norm2;
    const T reach2 = p.half2[0] * abs(row[0]) + p.half2[1] * abs(row[1]) + p.half2[2] * abs(row[2]);
    return {abs(toward) - (reach1 + reach2), toward};
  }
  if (axis < 6) {
    const int j = axis - 3;
    const auto& c = p.cosine;
    const T toward = p.between[0] * c[0][j] + p.between[1] * c[1][j] + p.between[2] * c[2][j];
    const T reach1 = (p.half1[0] * abs(c[0][j]) + p.half1[1] * abs(c[1][j]) + p.half1[2] * abs(c[2][j])) * p.norm1;
    const T reach2 = p.half2[j] * p.norm1 * p.norm1 * p.norm2;
    return {abs(toward) - (reach1 + reach2), toward};
  }
  const int i = (axis - 6) / 3, j = (axis - 6) % 3;
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  const CrossAxis<T> cross = p.cross_axis(i, j, as_direction);
  const T toward = p.between[i1] * cross.in1[0] + p.between[i2] * cross.in1[1];
  const T reach1 = (p.half1[i1] * abs(cross.in1[0]) + p.half1[i2] * abs(cross.in1[1])) * p.norm1;
  const T reach2 = (p.half2[j1] * abs(cross.in2[0]) + p.half2[j2] * abs(cross.in2[1])) * p.norm1;
  return {abs(toward) - (reach1 + reach2), toward};
}

}  // namespace detail
}  // namespace collide
