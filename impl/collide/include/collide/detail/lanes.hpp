/// SIMD lanes: four floating-point numbers that are computed at once. `Fast` uses them for short queries whose hits and
/// misses a branch predictor cannot predict: a kernel in lanes computes all cases and selects.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include <collide/detail/number.hpp>
#include <collide/shapes.hpp>

/// COLLIDE_LANES is defined if the machine has SSE2, unless the program defines COLLIDE_NO_LANES. Without it the plain
/// kernels are used, with the same contracts.
#if defined(__SSE2__) && !defined(COLLIDE_NO_LANES)
#define COLLIDE_LANES 1
#if defined(__GNUC__)  // for lambdas: a call would pass lanes through memory
#define COLLIDE_INLINE __attribute__((always_inline))
#else
#define COLLIDE_INLINE
#endif
#endif

#include <collide/detail/strict_begin.hpp>

#if defined(COLLIDE_LANES)

namespace collide::detail {

/// Wraps `kernel` so that calls of it are not inlined.
template <class Kernel>
auto out_of_line(Kernel kernel) noexcept {
  return [kernel](const auto&... arguments) COLLIDE_COLD { return kernel(arguments...); };
}

/// a / b in each lane. Clang compiles an intrinsic with the options of the program, which may allow products with a
/// reciprocal; an operator here obeys detail/strict_begin.hpp.
template <class Register>
Register quotient(Register a, Register b) noexcept {
#if defined(__GNUC__)
  return a / b;
#else
  if constexpr (std::same_as<Register, __m128>) {
    return _mm_div_ps(a, b);
  } else {
    return _mm_div_pd(a, b);
  }
#endif
}

/// Four numbers in one register, or in two where one register holds only two of them.
template <class T>
struct Lanes;

template <>
struct Lanes<float> {
  __m128 v;

  static Lanes splat(float x) noexcept { return {_mm_set1_ps(x)}; }
  /// x, 0, 0, 0.
  static Lanes first_lane(float x) noexcept { return {_mm_set_ss(x)}; }
  /// x, y, 0, 0.
  static Lanes two(float x, float y) noexcept { return {_mm_setr_ps(x, y, 0, 0)}; }
  static Lanes of(float x, float y, float z, float w = 0) noexcept { return {_mm_setr_ps(x, y, z, w)}; }
  /// Loads four consecutive numbers.
  static Lanes load(const char* there) noexcept { return {_mm_loadu_ps(reinterpret_cast<const float*>(there))}; }
  /// A mask: all bits set in every lane, or none.
  static Lanes mask(bool yes) noexcept { return {_mm_castsi128_ps(_mm_set1_epi32(-int(yes)))}; }

  /// A mask with all bits set in the first three lanes.
  static Lanes mask_of_three() noexcept { return {_mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0))}; }
  /// A mask with all bits set in lane i.
  static Lanes mask_of_lane(int i) noexcept {
    return {_mm_castsi128_ps(_mm_setr_epi32(-(i == 0), -(i == 1), -(i == 2), -(i == 3)))};
  }

  friend Lanes operator+(Lanes a, Lanes b) noexcept { return {_mm_add_ps(a.v, b.v)}; }
  friend Lanes operator-(Lanes a, Lanes b) noexcept { return {_mm_sub_ps(a.v, b.v)}; }
  friend Lanes operator*(Lanes a, Lanes b) noexcept { return {_mm_mul_ps(a.v, b.v)}; }
  friend Lanes operator/(Lanes a, Lanes b) noexcept { return {quotient(a.v, b.v)}; }
  // Comparisons give a mask: in each lane all bits set, or none.
  friend Lanes operator<(Lanes a, Lanes b) noexcept { return {_mm_cmplt_ps(a.v, b.v)}; }
  friend Lanes operator<=(Lanes a, Lanes b) noexcept { return {_mm_cmple_ps(a.v, b.v)}; }
  friend Lanes operator==(Lanes a, Lanes b) noexcept { return {_mm_cmpeq_ps(a.v, b.v)}; }
  friend Lanes operator&(Lanes a, Lanes b) noexcept { return {_mm_and_ps(a.v, b.v)}; }
  friend Lanes operator|(Lanes a, Lanes b) noexcept { return {_mm_or_ps(a.v, b.v)}; }
  friend Lanes operator^(Lanes a, Lanes b) noexcept { return {_mm_xor_ps(a.v, b.v)}; }
  /// a & ~where: a in the lanes where the mask is not set, 0 elsewhere.
  friend Lanes and_not(Lanes a, Lanes where) noexcept { return {_mm_andnot_ps(where.v, a.v)}; }
  /// Bit i: the sign bit of lane i.
  int bits() const noexcept { return _mm_movemask_ps(v); }

  friend Lanes sqrt(Lanes a) noexcept { return {_mm_sqrt_ps(a.v)}; }
  /// The larger, or smaller, number of each lane. A NaN in the first argument is returned.
  friend Lanes larger(Lanes a, Lanes b) noexcept { return {_mm_max_ps(b.v, a.v)}; }
  friend Lanes smaller(Lanes a, Lanes b) noexcept { return {_mm_min_ps(b.v, a.v)}; }

  void store(float* four) const noexcept { _mm_storeu_ps(four, v); }
  /// Permutes lanes: the result has lanes x, y, z, w of this value.
  template <int x, int y, int z, int w>
  Lanes shuffled() const noexcept {
    return {_mm_shuffle_ps(v, v, _MM_SHUFFLE(w, z, y, x))};
  }
  template <int i>
  Lanes broadcast() const noexcept {
    return shuffled<i, i, i, i>();
  }
  float first() const noexcept { return _mm_cvtss_f32(v); }
};

/// Two doubles in one register.
struct TwoDoubles {
  __m128d v;

  static TwoDoubles splat(double x) noexcept { return {_mm_set1_pd(x)}; }
  static TwoDoubles first_lane(double x) noexcept { return {_mm_set_sd(x)}; }
  static TwoDoubles two(double x, double y) noexcept { return {_mm_setr_pd(x, y)}; }
  static TwoDoubles mask(bool yes) noexcept { return {_mm_castsi128_pd(_mm_set1_epi32(-int(yes)))}; }

  friend TwoDoubles operator+(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_add_pd(a.v, b.v)}; }
  friend TwoDoubles operator-(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_sub_pd(a.v, b.v)}; }
  friend TwoDoubles operator*(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_mul_pd(a.v, b.v)}; }
  friend TwoDoubles operator/(TwoDoubles a, TwoDoubles b) noexcept { return {quotient(a.v, b.v)}; }
  friend TwoDoubles operator<(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_cmplt_pd(a.v, b.v)}; }
  friend TwoDoubles operator<=(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_cmple_pd(a.v, b.v)}; }
  friend TwoDoubles operator==(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_cmpeq_pd(a.v, b.v)}; }
  friend TwoDoubles operator&(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_and_pd(a.v, b.v)}; }
  friend TwoDoubles operator|(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_or_pd(a.v, b.v)}; }
  friend TwoDoubles operator^(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_xor_pd(a.v, b.v)}; }
  friend TwoDoubles and_not(TwoDoubles a, TwoDoubles where) noexcept { return {_mm_andnot_pd(where.v, a.v)}; }
  int bits() const noexcept { return _mm_movemask_pd(v); }

  friend TwoDoubles sqrt(TwoDoubles a) noexcept { return {_mm_sqrt_pd(a.v)}; }
  friend TwoDoubles larger(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_max_pd(b.v, a.v)}; }
  friend TwoDoubles smaller(TwoDoubles a, TwoDoubles b) noexcept { return {_mm_min_pd(b.v, a.v)}; }

  template <int x, int y>
  TwoDoubles shuffled() const noexcept {
    return {_mm_shuffle_pd(v, v, x | y << 1)};
  }
  double first() const noexcept { return _mm_cvtsd_f64(v); }
};

template <>
struct Lanes<double> {
  TwoDoubles low, high;

  static Lanes splat(double x) noexcept { return {TwoDoubles::splat(x), TwoDoubles::splat(x)}; }
  static Lanes of(double x, double y, double z, double w = 0) noexcept {
    return {{_mm_setr_pd(x, y)}, {_mm_setr_pd(z, w)}};
  }
  static Lanes load(const char* there) noexcept {
    const double* const first = reinterpret_cast<const double*>(there);
    return {{_mm_loadu_pd(first)}, {_mm_loadu_pd(first + 2)}};
  }
  static Lanes mask(bool yes) noexcept { return {TwoDoubles::mask(yes), TwoDoubles::mask(yes)}; }

  static Lanes mask_of_three() noexcept {
    return {{_mm_castsi128_pd(_mm_set1_epi32(-1))}, {_mm_castsi128_pd(_mm_setr_epi32(-1, -1, 0, 0))}};
  }
  static Lanes mask_of_lane(int i) noexcept {
    return {{_mm_castsi128_pd(_mm_setr_epi32(-(i == 0), -(i == 0), -(i == 1), -(i == 1)))},
            {_mm_castsi128_pd(_mm_setr_epi32(-(i == 2), -(i == 2), -(i == 3), -(i == 3)))}};
  }

  friend Lanes operator+(Lanes a, Lanes b) noexcept { return {a.low + b.low, a.high + b.high}; }
  friend Lanes operator-(Lanes a, Lanes b) noexcept { return {a.low - b.low, a.high - b.high}; }
  friend Lanes operator*(Lanes a, Lanes b) noexcept { return {a.low * b.low, a.high * b.high}; }
  friend Lanes operator/(Lanes a, Lanes b) noexcept { return {a.low / b.low, a.high / b.high}; }
  friend Lanes operator<(Lanes a, Lanes b) noexcept { return {a.low < b.low, a.high < b.high}; }
  friend Lanes operator<=(Lanes a, Lanes b) noexcept { return {a.low <= b.low, a.high <= b.high}; }
  friend Lanes operator==(Lanes a, Lanes b) noexcept { return {a.low == b.low, a.high == b.high}; }
  friend Lanes operator&(Lanes a, Lanes b) noexcept { return {a.low & b.low, a.high & b.high}; }
  friend Lanes operator|(Lanes a, Lanes b) noexcept { return {a.low | b.low, a.high | b.high}; }
  friend Lanes operator^(Lanes a, Lanes b) noexcept { return {a.low ^ b.low, a.high ^ b.high}; }
  friend Lanes and_not(Lanes a, Lanes where) noexcept {
    return {and_not(a.low, where.low), and_not(a.high, where.high)};
  }
  int bits() const noexcept { return low.bits() | high.bits() << 2; }

  friend Lanes sqrt(Lanes a) noexcept { return {sqrt(a.low), sqrt(a.high)}; }
  friend Lanes larger(Lanes a, Lanes b) noexcept { return {larger(a.low, b.low), larger(a.high, b.high)}; }
  friend Lanes smaller(Lanes a, Lanes b) noexcept { return {smaller(a.low, b.low), smaller(a.high, b.high)}; }

  void store(double* four) const noexcept { _mm_storeu_pd(four, low.v), _mm_storeu_pd(four + 2, high.v); }
  template <int x, int y, int z, int w>
  Lanes shuffled() const noexcept {
    return {pair<x, y>(), pair<z, w>()};
  }
  template <int i>
  Lanes broadcast() const noexcept {
    const TwoDoubles twice = pair<i, i>();
    return {twice, twice};
  }
  double first() const noexcept { return low.first(); }

 private:
  template <int x, int y>
  TwoDoubles pair() const noexcept {
    const TwoDoubles from_x = x < 2 ? low : high, from_y = y < 2 ? low : high;
    return {_mm_shuffle_pd(from_x.v, from_y.v, (x & 1) | (y & 1) << 1)};
  }
};

/// One register whose first two lanes are used. In double it takes half the work of four lanes.
template <class T>
using Pair = std::conditional_t<std::same_as<T, float>, Lanes<float>, TwoDoubles>;

inline Lanes<float> first_pair(Lanes<float> a) noexcept { return a; }
inline TwoDoubles first_pair(Lanes<double> a) noexcept { return a.low; }
inline Lanes<float> second_pair(Lanes<float> a) noexcept { return {_mm_movehl_ps(a.v, a.v)}; }
inline TwoDoubles second_pair(Lanes<double> a) noexcept { return a.high; }

/// A pair x, y as y, x.
inline Lanes<float> swapped(Lanes<float> a) noexcept { return a.shuffled<1, 0, 3, 2>(); }
inline TwoDoubles swapped(TwoDoubles a) noexcept { return a.shuffled<1, 0>(); }
/// A pair x, y as y, x, y, x.
inline Lanes<float> swapped_twice(Lanes<float> a) noexcept { return a.shuffled<1, 0, 1, 0>(); }
inline Lanes<double> swapped_twice(TwoDoubles a) noexcept { return {swapped(a), swapped(a)}; }
/// The first lane of a pair in every lane.
inline Lanes<float> broadcast_first(Lanes<float> a) noexcept { return a.broadcast<0>(); }
inline Lanes<double> broadcast_first(TwoDoubles a) noexcept { return {a.shuffled<0, 0>(), a.shuffled<0, 0>()}; }
/// The first lanes of three pairs, as the first three lanes.
inline Lanes<float> first_lanes(Lanes<float> x, Lanes<float> y, Lanes<float> z) noexcept {
  return {_mm_movelh_ps(_mm_unpacklo_ps(x.v, y.v), z.v)};
}
inline Lanes<double> first_lanes(TwoDoubles x, TwoDoubles y, TwoDoubles z) noexcept {
  return {{_mm_unpacklo_pd(x.v, y.v)}, z};
}

/// x, y, z, 0.
inline Lanes<float> lanes(const Vec3<float>& a) noexcept {
  static_assert(sizeof(Vec3<float>) == 3 * sizeof(float));
  const __m128 z = _mm_load_ss(&a.z);
  return {_mm_movelh_ps(_mm_loadl_pi(_mm_setzero_ps(), reinterpret_cast<const __m64*>(&a)), z)};
}
inline Lanes<double> lanes(const Vec3<double>& a) noexcept {
  static_assert(sizeof(Vec3<double>) == 3 * sizeof(double));
  return {{_mm_loadu_pd(reinterpret_cast<const double*>(&a))}, {_mm_load_sd(&a.z)}};
}
template <class T>
Vec3<T> to_vec3(const Lanes<T>& a) noexcept {
  return {a.first(), a.template broadcast<1>().first(), a.template broadcast<2>().first()};
}

inline Lanes<float> lanes(const Quaternion<float>& q) noexcept {
  static_assert(sizeof q == 4 * sizeof(float));
  return {_mm_loadu_ps(reinterpret_cast<const float*>(&q))};
}
inline Lanes<double> lanes(const Quaternion<double>& q) noexcept {
  static_assert(sizeof q == 4 * sizeof(double));
  return {{_mm_loadu_pd(reinterpret_cast<const double*>(&q))}, {_mm_loadu_pd(&q.z)}};
}

/// A plane as normal.x, normal.y, normal.z, offset; a sphere as center.x, center.y, center.z, radius.
template <class T>
inline Lanes<T> lanes(const Plane<T>& plane) noexcept {
  static_assert(sizeof plane == 4 * sizeof(T));
  return Lanes<T>::load(reinterpret_cast<const char*>(&plane));
}
template <class T>
inline Lanes<T> lanes(const Sphere<T>& sphere) noexcept {
  static_assert(sizeof sphere == 4 * sizeof(T));
  return Lanes<T>::load(reinterpret_cast<const char*>(&sphere));
}
/// The corners of a triangle, with unspecified numbers in lane 3.
template <class T>
struct CornerLanes {
  Lanes<T> v0, v1, v2;
};
inline CornerLanes<float> corner_lanes(const Triangle<float>& triangle) noexcept {
  using S = Triangle<float>;
  static_assert(offsetof(S, v2) + sizeof(Vec3<float>) == sizeof(S));
  const char* const numbers = reinterpret_cast<const char*>(&triangle);
  return {Lanes<float>::load(numbers), Lanes<float>::load(numbers + offsetof(S, v1)),
          Lanes<float>::load(numbers + offsetof(S, v2) - sizeof(float)).shuffled<1, 2, 3, 3>()};
}
inline CornerLanes<double> corner_lanes(const Triangle<double>& triangle) noexcept {
  return {lanes(triangle.v0), lanes(triangle.v1), lanes(triangle.v2)};
}

/// A vector or quaternion converted to lanes of double.
template <class T>
Lanes<double> wide_lanes(const Vec3<T>& a) noexcept {
  return Lanes<double>::of(a.x, a.y, a.z);
}
template <class T>
Lanes<double> wide_lanes(const Quaternion<T>& q) noexcept {
  return Lanes<double>::of(q.x, q.y, q.z, q.w);
}
template <class T>
std::array<T, 4> to_array(const Lanes<T>& a) noexcept {
  std::array<T, 4> numbers;
  a.store(numbers.data());
  return numbers;
}

/// In each lane: a where the mask is set, b elsewhere.
template <class L>
L select(const L& where, const L& a, const L& b) noexcept {
  return (a & where) | and_not(b, where);
}
template <class T>
Lanes<T> absolute(const Lanes<T>& a) noexcept {
  return and_not(a, Lanes<T>::splat(T(-0.0)));
}

/// A mask of the lanes in which every argument is finite.
template <class T, class... More>
Lanes<T> are_finite(const Lanes<T>& a, const More&... more) noexcept {
  return ((a - a) + ... + (more - more)) == Lanes<T>::splat(T(0));
}
/// -a, also of zero.
template <class L>
L negated(const L& a) noexcept {
  return a ^ L::splat(-0.0);
}

/// Whether a mask is set in all four lanes.
template <class T>
bool all_four(const Lanes<T>& mask) noexcept {
  return mask.bits() == 15;
}
/// Whether a mask is set in all of the first three lanes.
template <class T>
bool all_three(const Lanes<T>& mask) noexcept {
  return (mask.bits() & 7) == 7;
}

template <class T>
bool any_of_three(const Lanes<T>& mask) noexcept {
  return (mask.bits() & 7) != 0;
}

/// The first three lanes in cyclic order: y, z, x and z, x, y.
template <class T>
Lanes<T> yzx(const Lanes<T>& a) noexcept {
  return a.template shuffled<1, 2, 0, 3>();
}
template <class T>
Lanes<T> zxy(const Lanes<T>& a) noexcept {
  return a.template shuffled<2, 0, 1, 3>();
}

template <class T>
Lanes<T> cross(const Lanes<T>& a, const Lanes<T>& b) noexcept {
  return yzx(a * yzx(b) - yzx(a) * b);
}

/// Four vectors in structure-of-arrays layout: vector i is lane i of x, y and z.
template <class T>
struct Columns {
  Lanes<T> x, y, z;

  template <int i>
  Columns broadcast() const noexcept {
    return {x.template broadcast<i>(), y.template broadcast<i>(), z.template broadcast<i>()};
  }
  friend Columns operator+(const Columns& a, const Columns& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Columns operator-(const Columns& a, const Columns& b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Columns operator*(const Columns& a, const Lanes<T>& s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
  friend COLLIDE_INLINE Lanes<T> dot(const Columns& a, const Columns& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend COLLIDE_INLINE Columns cross(const Columns& a, const Columns& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  /// Rotates the first three vectors: vector i + 1 takes the place of vector i.
  friend Columns yzx(const Columns& a) noexcept { return {yzx(a.x), yzx(a.y), yzx(a.z)}; }
  friend Columns select(const Lanes<T>& where, const Columns& a, const Columns& b) noexcept {
    return {select(where, a.x, b.x), select(where, a.y, b.y), select(where, a.z, b.z)};
  }
};
inline Columns<float> columns(Lanes<float> a, Lanes<float> b, Lanes<float> c, Lanes<float> d) noexcept {
  const __m128 ab = _mm_unpacklo_ps(a.v, b.v), cd = _mm_unpacklo_ps(c.v, d.v);  // a0 b0 a1 b1
  return {{_mm_movelh_ps(ab, cd)},
          {_mm_movehl_ps(cd, ab)},
          {_mm_movelh_ps(_mm_unpackhi_ps(a.v, b.v), _mm_unpackhi_ps(c.v, d.v))}};
}
inline Columns<double> columns(Lanes<double> a, Lanes<double> b, Lanes<double> c, Lanes<double> d) noexcept {
  return {{{_mm_unpacklo_pd(a.low.v, b.low.v)}, {_mm_unpacklo_pd(c.low.v, d.low.v)}},
          {{_mm_unpackhi_pd(a.low.v, b.low.v)}, {_mm_unpackhi_pd(c.low.v, d.low.v)}},
          {{_mm_unpacklo_pd(a.high.v, b.high.v)}, {_mm_unpacklo_pd(c.high.v, d.high.v)}}};
}

/// The same vector in all four columns.
template <class T>
Columns<T> splat_columns(const Lanes<T>& a) noexcept {
  return {a.template broadcast<0>(), a.template broadcast<1>(), a.template broadcast<2>()};
}

/// Whether `mask`, which is equal in every lane, is set, or all four lanes of a are zero.
inline bool holds_or_all_zero(const Lanes<float>& mask, const Lanes<float>& a) noexcept {
  return (mask | (a == Lanes<float>::splat(0))).bits() == 15;
}
inline bool holds_or_all_zero(const TwoDoubles& mask, const Lanes<double>& a) noexcept {
  return (mask | ((a.low | a.high) == TwoDoubles::splat(0))).bits() == 3;
}

/// Four horizontal sums: lane i is the sum of the first three lanes of argument i.
template <class T>
Lanes<T> sums_of_three(Lanes<T> a, Lanes<T> b, Lanes<T> c, Lanes<T> d) noexcept {
  const Columns<T> n = columns(a, b, c, d);
  return n.x + n.y + n.z;
}

/// The horizontal sum of the first three (or of all four) lanes, in every lane.
template <class T>
Lanes<T> sum_of_three(const Lanes<T>& a) noexcept {
  return a.template broadcast<0>() + a.template broadcast<1>() + a.template broadcast<2>();
}
inline Lanes<float> sum_of_four(const Lanes<float>& a) noexcept {
  const Lanes<float> pairs = a + a.shuffled<1, 0, 3, 2>();
  return pairs + pairs.shuffled<2, 3, 0, 1>();
}
inline Lanes<double> sum_of_four(const Lanes<double>& a) noexcept {
  const TwoDoubles pairs = a.low + a.high, sum = pairs + swapped(pairs);
  return {sum, sum};
}
/// The largest, or smallest, of the first three lanes, in lane 0.
template <class T>
Pair<T> largest_of(const Lanes<T>& a) noexcept {
  const Pair<T> pair = first_pair(a);
  return larger(larger(pair, swapped(pair)), second_pair(a));
}
template <class T>
Pair<T> smallest_of(const Lanes<T>& a) noexcept {
  const Pair<T> pair = first_pair(a);
  return smaller(smaller(pair, swapped(pair)), second_pair(a));
}
/// The same in every lane.
template <class T>
Lanes<T> largest_of_three(const Lanes<T>& a) noexcept {
  return broadcast_first(largest_of(a));
}
template <class T>
Lanes<T> smallest_of_three(const Lanes<T>& a) noexcept {
  return broadcast_first(smallest_of(a));
}
/// The mask of the first lane that is set, among the first three.
template <class T>
Lanes<T> first_of_three(const Lanes<T>& mask) noexcept {
  const Lanes<T> three = mask & Lanes<T>::mask_of_three();
  const Lanes<T> before_z = three.template shuffled<3, 3, 1, 3>();
  return and_not(three, three.template shuffled<3, 0, 0, 3>() | before_z);
}

}  // namespace collide::detail

#endif

#include <collide/detail/strict_end.hpp>
