/// A pair of boxes: the relative rotation and the separating-axis terms that all queries about two boxes use.
#pragma once

#include <array>
#include <bit>

#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// The number of candidate separating axes of two boxes: 0-2 are the axes of box 1, 3-5 those of box 2, and 6 + 3 i + j
/// is the cross product of axis i of box 1 and axis j of box 2.
inline constexpr int box_box_axes = 15;

namespace detail {

/// conj(a) b: the rotation b relative to the rotation a.
template <class T>
std::array<T, 4> relative_rotation(const std::array<T, 4>& a, const std::array<T, 4>& b) {
  return {(a[3] * b[0] - a[0] * b[3]) - (a[1] * b[2] - a[2] * b[1]),
          (a[3] * b[1] - a[1] * b[3]) - (a[2] * b[0] - a[0] * b[2]),
          (a[3] * b[2] - a[2] * b[3]) - (a[0] * b[1] - a[1] * b[0]),
          (a[3] * b[3] + a[0] * b[0]) + (a[1] * b[1] + a[2] * b[2])};
}

/// The matrix of the rotation q times |q|^2, by columns.
template <class T>
std::array<std::array<T, 3>, 3> scaled_axes(const std::array<T, 4>& q) {
  const auto& [x, y, z, w] = q;
  const T two(2);
  return {{{(w * w - z * z) + (x * x - y * y), two * (x * y + w * z), two * (x * z - w * y)},
           {two * (x * y - w * z), (w * w - x * x) + (y * y - z * z), two * (y * z + w * x)},
           {two * (x * z + w * y), two * (y * z - w * x), (w * w - y * y) + (z * z - x * x)}}};
}

template <class T>
T norm2(const std::array<T, 4>& q) {
  return (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
}

/// Multiplies two numbers by the same power of two if both are so small that products of them underflow.
template <class T>
void scale_up(T& a, T& b) {
  if constexpr (MachineNumber<T>) {
    using detail::abs;
    const T largest = larger(abs(a), abs(b));
    constexpr T least = sizeof(T) == sizeof(float) ? T(0x1p-32) : T(0x1p-300);
    if (!(largest < least && largest > T(0))) return;
    const int up = -detail::ilogb(largest);
    a = detail::ldexp(a, up), b = detail::ldexp(b, up);
  }
}

/// The cross product of axis i of box 1 and axis j of box 2, times norm1 norm2; if it is only needed as a direction,
/// times some other positive number. `in1` holds its components i + 1, i + 2 in the frame of box 1, `in2` its
/// components j + 1, j + 2 in the frame of box 2; the remaining component is 0.
template <class T>
struct CrossAxis {
  std::array<T, 2> in1, in2;
};

#if defined(COLLIDE_LANES)
template <class T>
struct BoxPairInLanes;
#endif

/// A pair of boxes. Quaternions q1 and q2 of extreme lengths are rescaled. All values are multiplied by |q1|^2 |q2|^2
/// (the vector between the centers by |q1|^2), so each is a polynomial of the input and nothing is divided.
template <class T>
struct BoxPair {
  std::array<T, 4> relative;               ///< the rotation of box 2 relative to box 1
  std::array<std::array<T, 3>, 3> cosine;  ///< axis i of box 1 . axis j of box 2, times |q1|^2 |q2|^2
  std::array<T, 3> between;                ///< center 2 - center 1 along the axes of box 1, times |q1|^2
  std::array<T, 3> half1, half2;
  T norm1, norm2;  ///< |q1|^2, |q2|^2

  BoxPair(const Box<T>& box1, const Box<T>& box2) : half1(components(box1.half)), half2(components(box2.half)) {
    const std::array<T, 4> a = rescaled(box1.orientation), b = rescaled(box2.orientation);
    relative = relative_rotation(a, b);
    const auto axes1 = scaled_axes(a), columns = scaled_axes(relative);
    const Vec3<T> d = box2.center - box1.center;
    for (int i = 0; i < 3; ++i) {
      between[i] = axes1[i][0] * d.x + axes1[i][1] * d.y + axes1[i][2] * d.z;
      for (int j = 0; j < 3; ++j) cosine[i][j] = columns[j][i];
    }
    norm1 = detail::norm2(a);
    norm2 = detail::norm2(b);
  }

#if defined(COLLIDE_LANES)
  explicit BoxPair(const BoxPairInLanes<T>& pair)
      : relative(to_array(pair.relative)),
        between(components(to_vec3(pair.between))),
        half1(components(to_vec3(pair.half1))),
        half2(components(to_vec3(pair.half2))),
        norm1(pair.norm1.first()),
        norm2(pair.norm2.first()) {
    const auto axes2 = FrameInLanes<T>::scaled(pair.relative).axes();
    for (std::size_t j = 0; j < 3; ++j) {
      const std::array<T, 4> axis = to_array(axes2[j]);
      for (std::size_t i = 0; i < 3; ++i) cosine[i][j] = axis[i];
    }
  }
#endif

  /// For nearly parallel axes the cross product is small. Each of its components is a sum of products p s of a small p
  /// and a large s; the squares of the p add up to 1 - |cosine|. No component is the difference of large numbers, so
  /// each has the same error, relative to the length of the cross product, as `relative` has.
  CrossAxis<T> cross_axis(int i, int j, bool as_direction = true) const {
    T w = relative[3];
    if (i == j) {
      T v = relative[i], v1 = relative[(i + 1) % 3], v2 = relative[(i + 2) % 3];
      if (as_direction) scale_up(v1, v2), scale_up(v, w);
      const T two(2);
      return {{two * (w * v1 - v * v2), two * (v * v1 + w * v2)}, {two * (v * v2 + w * v1), two * (w * v2 - v * v1)}};
    }
    const bool next = j == (i + 1) % 3;
    const T third = next ? relative[3 - i - j] : -relative[3 - i - j];
    T p = relative[i] - relative[j], s = relative[i] + relative[j], q = w + third, t = w - third;
    if (as_direction) scale_up(p, q), scale_up(s, t);
    const T jj = q * t - p * s, kj = s * q + p * t;  // cosines [j][j] and +-[k][j], where k is the third axis
    const T ii = q * t + p * s, ik = s * q - p * t;  // cosines [i][i] and +-[i][k]
    if (next) return {{-kj, jj}, {ii, -ik}};
    return {{-jj, -kj}, {-ik, -ii}};
  }
};

/// Clamps a component of a unit vector to [-1, 1], which rounding may exceed.
template <class T>
T at_most_one(const T& x) {
  if constexpr (MachineNumber<T>) return clamped(x, T(-1), T(1));
  return x;
}
template <class T>
Vec3<T> at_most_one(const Vec3<T>& v) {
  return {at_most_one(v.x), at_most_one(v.y), at_most_one(v.z)};
}

/// The projections of two boxes onto an axis: `gap` is the distance between them (negative where they overlap),
/// `toward` the component of center 2 - center 1. Both are multiplied by the same positive number.
template <class T>
struct Separation {
  T gap, toward;
};

template <class T>
Separation<T> separation(const BoxPair<T>& p, int axis, bool as_direction = true) {
  using detail::abs;
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

#if defined(COLLIDE_LANES)

/// `Separation` for three axes at once. `length2` is the square of the factor of the gaps, divided by norm1; for a
/// family of cross products it is their squared length.
template <class T>
struct SeparationsInLanes {
  Lanes<T> gap, toward;
  Lanes<T> length2;
};

/// The axis that a bit of a bit set stands for: bit 3 n + i is axis i of group n of BoxPairInLanes. Bit 15 means none,
/// -1.
inline int axis_of_bit(int bit) {
  constexpr signed char axes[] = {0, 1, 2, 3, 4, 5, 6, 10, 14, 7, 11, 12, 8, 9, 13, -1};
  return axes[bit];
}
inline int first_bit(unsigned bits) { return std::countr_zero(bits | 1u << box_box_axes); }

/// `BoxPair` in lanes, with the separation along every axis. Lane i holds the values of axis i of box 1, of axis i of
/// box 2, or of the cross product of axis i of box 1 and axis i + f of box 2, where f = 0, 1, 2 numbers the family.
template <class T>
struct BoxPairInLanes {
  using L = Lanes<T>;
  L relative, between, half1, half2, norm1, norm2;
  bool valid_rotations = true;  ///< whether both quaternions are nonzero and finite

  BoxPairInLanes(const Box<T>& box1, const Box<T>& box2)
      : BoxPairInLanes(box1.orientation, box2.orientation, lanes(box2.center) - lanes(box1.center), lanes(box1.half),
                       lanes(box2.half)) {}
  /// `between_centers` is the vector from the center of box 1 to the center of box 2.
  BoxPairInLanes(const Quaternion<T>& q1, const Quaternion<T>& q2, const L& between_centers, const L& half_of_1,
                 const L& half_of_2)
      : half1(half_of_1), half2(half_of_2) {
    L a = lanes(q1), b = lanes(q2);
    norm1 = sum_of_four(a * a);
    norm2 = sum_of_four(b * b);
    const auto are_in_safe_range = [&] { return is_in_safe_range(norm1.first()) && is_in_safe_range(norm2.first()); };
    if (!are_in_safe_range()) {
      a = out_of_line(rescaled_lanes<T>)(q1), b = out_of_line(rescaled_lanes<T>)(q2);
      norm1 = sum_of_four(a * a);
      norm2 = sum_of_four(b * b);
      valid_rotations = are_in_safe_range();
    }
    const L aw = a.template broadcast<3>(), bw = b.template broadcast<3>();
    const L vector = (aw * b - a * bw) - (yzx(a) * zxy(b) - zxy(a) * yzx(b));
    relative = select(L::mask_of_three(), vector, sum_of_four(a * b));
    between = FrameInLanes<T>::scaled(a).into(between_centers);
  }

  /// Whether both quaternions are nonzero and finite, and the half extents and the vector between the centers are
  /// finite.
  bool is_valid() const { return valid_rotations && all_three(are_finite(half1, half2, between)); }

  /// Calls each(group, separations) for axes 0-2, for axes 3-5, and for the three families of cross products. Returns
  /// false if a cross product is so small that products of its components underflow.
  template <class Each>
  bool for_each_axis(Each each) const {
    for_each_face_axis(each);
    return for_each_cross_axis(each);
  }
  /// The same for axes 0-5 alone.
  template <class Each>
  void for_each_face_axis(Each each) const {
    const auto frame = FrameInLanes<T>::scaled(relative), sizes = frame.magnitudes();
    const L scale = norm1 * norm2;
    const L toward1 = between * norm2, toward2 = frame.into(between);
    each(0, SeparationsInLanes<T>{absolute(toward1) - (half1 * scale + sizes.out_of(half2)), toward1, norm2 * norm2});
    each(1, SeparationsInLanes<T>{absolute(toward2) - (sizes.into(half1) * norm1 + half2 * norm1 * scale), toward2,
                                  scale * scale});
  }
  /// The same for the cross products alone.
  template <class Each>
  bool for_each_cross_axis(Each each) const {
    const L scale = norm1 * norm2;
    const L v = relative, v1 = yzx(relative), v2 = zxy(relative), w = relative.template broadcast<3>();
    const L b1 = yzx(between), b2 = zxy(between), near1 = yzx(half1), near2 = zxy(half1);
    // A threshold far above underflow, independent of the lengths of the quaternions.
    const L least =
        L::splat(std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon() * T(0x1p40)) * scale * scale;
    std::array<L, 3> small;
    const auto family = [&](int number, const L& in1_0, const L& in1_1, const L& in2_0, const L& in2_1, const L& far1,
                            const L& far2) COLLIDE_INLINE {
      const L toward = b1 * in1_0 + b2 * in1_1;
      const L reach1 = near1 * absolute(in1_0) + near2 * absolute(in1_1);
      const L reach2 = far1 * absolute(in2_0) + far2 * absolute(in2_1);
      const L cross2 = in1_0 * in1_0 + in1_1 * in1_1;
      small[std::size_t(number) - 2] = cross2 < least;
      each(number, SeparationsInLanes<T>{absolute(toward) - (reach1 + reach2) * norm1, toward, cross2});
    };
    family(2, w * v1 - v * v2, v * v1 + w * v2, v * v2 + w * v1, w * v2 - v * v1, yzx(half2), zxy(half2));
    const auto mixed = [&](const L& p, const L& s, const L& q, const L& t, auto last) COLLIDE_INLINE {
      const L qt = q * t, ps = p * s, sq = s * q, pt = p * t;
      last(qt - ps, sq + pt, qt + ps, sq - pt);  // jj, kj, ii, ik
    };
    const L zero = L::splat(T(0));
    mixed(v - v1, v + v1, w + v2, w - v2, [&](const L& jj, const L& kj, const L& ii, const L& ik) COLLIDE_INLINE {
      family(3, zero - kj, jj, ii, zero - ik, zxy(half2), half2);
    });
    mixed(v - v2, v + v2, w - v1, w + v1, [&](const L& jj, const L& kj, const L& ii, const L& ik) COLLIDE_INLINE {
      family(4, zero - jj, zero - kj, zero - ik, zero - ii, half2, yzx(half2));
    });
    if (!any_of_three(small[0] | small[1] | small[2])) return true;
    // The cross product of exactly parallel axes is zero, which is a valid result.
    const auto vanish = [&](const L& p, const L& q) { return (p == zero) & (q == zero); };
    const L bad = and_not(small[0], vanish(v1, v2) | vanish(v, w)) |
                  and_not(small[1], vanish(v - v1, w + v2) | vanish(v + v1, w - v2)) |
                  and_not(small[2], vanish(v - v2, w - v1) | vanish(v + v2, w + v1));
    return !any_of_three(bad);
  }
};

#endif

}  // namespace detail
}  // namespace collide

#include <collide/detail/strict_end.hpp>
