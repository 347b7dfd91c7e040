/// Four machine numbers side by side, computed at once: what `Fast` computes short queries with, whose hits and
/// misses nobody can predict. A text in lanes has no branches to mispredict: it selects.
#pragma once

#include <collide/number.hpp>
#include <collide/shapes.hpp>

/// Defined where the machine has lanes. Elsewhere the texts in plain numbers serve, with the same contracts.
#if defined(__SSE2__)
#define COLLIDE_LANES 1
#if defined(__GNUC__)  // for lambdas: as functions they would pass lanes through memory
#define COLLIDE_INLINE __attribute__((always_inline))
#else
#define COLLIDE_INLINE
#endif
#endif

#if defined(COLLIDE_LANES)

namespace collide::detail {

/// One register of a machine, or two where four numbers do not fit into one.
template <class T>
struct Lanes;

template <>
struct Lanes<float> {
  __m128 v;

  static Lanes all(float x) noexcept { return {_mm_set1_ps(x)}; }
  static Lanes of(float x, float y, float z, float w = 0) noexcept { return {_mm_setr_ps(x, y, z, w)}; }
  /// The four numbers that lie from there on.
  static Lanes load(const char* there) noexcept { return {_mm_loadu_ps(reinterpret_cast<const float*>(there))}; }
  /// All bits in every lane, or none.
  static Lanes when(bool yes) noexcept { return {_mm_castsi128_ps(_mm_set1_epi32(-int(yes)))}; }

  /// All bits in the first three lanes.
  static Lanes first_three() noexcept { return {_mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0))}; }
  /// All bits in lane i.
  static Lanes only(int i) noexcept { return {_mm_castsi128_ps(_mm_setr_epi32(-(i == 0), -(i == 1), -(i == 2), -(i == 3)))}; }

  friend Lanes operator+(Lanes a, Lanes b) noexcept { return {_mm_add_ps(a.v, b.v)}; }
  friend Lanes operator-(Lanes a, Lanes b) noexcept { return {_mm_sub_ps(a.v, b.v)}; }
  friend Lanes operator*(Lanes a, Lanes b) noexcept { return {_mm_mul_ps(a.v, b.v)}; }
  friend Lanes operator/(Lanes a, Lanes b) noexcept { return {_mm_div_ps(a.v, b.v)}; }
  // Comparisons, in each lane all bits or none.
  friend Lanes operator<(Lanes a, Lanes b) noexcept { return {_mm_cmplt_ps(a.v, b.v)}; }
  friend Lanes operator<=(Lanes a, Lanes b) noexcept { return {_mm_cmple_ps(a.v, b.v)}; }
  friend Lanes operator==(Lanes a, Lanes b) noexcept { return {_mm_cmpeq_ps(a.v, b.v)}; }
  friend Lanes operator&(Lanes a, Lanes b) noexcept { return {_mm_and_ps(a.v, b.v)}; }
  friend Lanes operator|(Lanes a, Lanes b) noexcept { return {_mm_or_ps(a.v, b.v)}; }
  friend Lanes operator^(Lanes a, Lanes b) noexcept { return {_mm_xor_ps(a.v, b.v)}; }
  /// a where `where` has no bits.
  friend Lanes without(Lanes a, Lanes where) noexcept { return {_mm_andnot_ps(where.v, a.v)}; }
  /// Bit i: the sign bit of lane i.
  int bits() const noexcept { return _mm_movemask_ps(v); }

  friend Lanes sqrt(Lanes a) noexcept { return {_mm_sqrt_ps(a.v)}; }
  /// NaN of the first stays.
  friend Lanes larger(Lanes a, Lanes b) noexcept { return {_mm_max_ps(b.v, a.v)}; }
  friend Lanes smaller(Lanes a, Lanes b) noexcept { return {_mm_min_ps(b.v, a.v)}; }

  void store(float* four) const noexcept { _mm_storeu_ps(four, v); }
  /// Lanes x, y, z, w of this one in another order.
  template <int x, int y, int z, int w>
  Lanes shuffled() const noexcept { return {_mm_shuffle_ps(v, v, _MM_SHUFFLE(w, z, y, x))}; }
  template <int i>
  Lanes broadcast() const noexcept { return shuffled<i, i, i, i>(); }
  float first() const noexcept { return _mm_cvtss_f32(v); }
};

template <>
struct Lanes<double> {
  __m128d low, high;

  static Lanes all(double x) noexcept { return {_mm_set1_pd(x), _mm_set1_pd(x)}; }
  static Lanes of(double x, double y, double z, double w = 0) noexcept { return {_mm_setr_pd(x, y), _mm_setr_pd(z, w)}; }
  static Lanes load(const char* there) noexcept {
    const double* const first = reinterpret_cast<const double*>(there);
    return {_mm_loadu_pd(first), _mm_loadu_pd(first + 2)};
  }
  static Lanes when(bool yes) noexcept {
    const __m128d bits = _mm_castsi128_pd(_mm_set1_epi32(-int(yes)));
    return {bits, bits};
  }

  static Lanes first_three() noexcept {
    return {_mm_castsi128_pd(_mm_set1_epi32(-1)), _mm_castsi128_pd(_mm_setr_epi32(-1, -1, 0, 0))};
  }
  static Lanes only(int i) noexcept {
    return {_mm_castsi128_pd(_mm_setr_epi32(-(i == 0), -(i == 0), -(i == 1), -(i == 1))),
            _mm_castsi128_pd(_mm_setr_epi32(-(i == 2), -(i == 2), -(i == 3), -(i == 3)))};
  }

  friend Lanes operator+(Lanes a, Lanes b) noexcept { return {_mm_add_pd(a.low, b.low), _mm_add_pd(a.high, b.high)}; }
  friend Lanes operator-(Lanes a, Lanes b) noexcept { return {_mm_sub_pd(a.low, b.low), _mm_sub_pd(a.high, b.high)}; }
  friend Lanes operator*(Lanes a, Lanes b) noexcept { return {_mm_mul_pd(a.low, b.low), _mm_mul_pd(a.high, b.high)}; }
  friend Lanes operator/(Lanes a, Lanes b) noexcept { return {_mm_div_pd(a.low, b.low), _mm_div_pd(a.high, b.high)}; }
  friend Lanes operator<(Lanes a, Lanes b) noexcept { return {_mm_cmplt_pd(a.low, b.low), _mm_cmplt_pd(a.high, b.high)}; }
  friend Lanes operator<=(Lanes a, Lanes b) noexcept { return {_mm_cmple_pd(a.low, b.low), _mm_cmple_pd(a.high, b.high)}; }
  friend Lanes operator==(Lanes a, Lanes b) noexcept { return {_mm_cmpeq_pd(a.low, b.low), _mm_cmpeq_pd(a.high, b.high)}; }
  friend Lanes operator&(Lanes a, Lanes b) noexcept { return {_mm_and_pd(a.low, b.low), _mm_and_pd(a.high, b.high)}; }
  friend Lanes operator|(Lanes a, Lanes b) noexcept { return {_mm_or_pd(a.low, b.low), _mm_or_pd(a.high, b.high)}; }
  friend Lanes operator^(Lanes a, Lanes b) noexcept { return {_mm_xor_pd(a.low, b.low), _mm_xor_pd(a.high, b.high)}; }
  friend Lanes without(Lanes a, Lanes where) noexcept {
    return {_mm_andnot_pd(where.low, a.low), _mm_andnot_pd(where.high, a.high)};
  }
  int bits() const noexcept { return _mm_movemask_pd(low) | _mm_movemask_pd(high) << 2; }

  friend Lanes sqrt(Lanes a) noexcept { return {_mm_sqrt_pd(a.low), _mm_sqrt_pd(a.high)}; }
  friend Lanes larger(Lanes a, Lanes b) noexcept { return {_mm_max_pd(b.low, a.low), _mm_max_pd(b.high, a.high)}; }
  friend Lanes smaller(Lanes a, Lanes b) noexcept { return {_mm_min_pd(b.low, a.low), _mm_min_pd(b.high, a.high)}; }

  void store(double* four) const noexcept { _mm_storeu_pd(four, low), _mm_storeu_pd(four + 2, high); }
  template <int x, int y, int z, int w>
  Lanes shuffled() const noexcept { return {pair<x, y>(), pair<z, w>()}; }
  template <int i>
  Lanes broadcast() const noexcept {
    const __m128d twice = pair<i, i>();
    return {twice, twice};
  }
  double first() const noexcept { return _mm_cvtsd_f64(low); }

 private:
  template <int x, int y>
  __m128d pair() const noexcept {
    const __m128d from_x = x < 2 ? low : high, from_y = y < 2 ? low : high;
    return _mm_shuffle_pd(from_x, from_y, (x & 1) | (y & 1) << 1);
  }
};

/// x, y, z and 0.
inline Lanes<float> lanes(const Vec3<float>& a) noexcept {
  static_assert(sizeof(Vec3<float>) == 12);
  const __m128 z = _mm_load_ss(&a.z);
  return {_mm_movelh_ps(_mm_loadl_pi(_mm_setzero_ps(), reinterpret_cast<const __m64*>(&a)), z)};
}
inline Lanes<double> lanes(const Vec3<double>& a) noexcept {
  static_assert(sizeof(Vec3<double>) == 24);
  return {_mm_loadu_pd(reinterpret_cast<const double*>(&a)), _mm_load_sd(&a.z)};
}
template <class T>
Vec3<T> first_three(const Lanes<T>& a) noexcept {
  return {a.first(), a.template broadcast<1>().first(), a.template broadcast<2>().first()};
}

inline Lanes<float> lanes(const Quaternion<float>& q) noexcept {
  static_assert(sizeof q == 16);
  return {_mm_loadu_ps(reinterpret_cast<const float*>(&q))};
}
inline Lanes<double> lanes(const Quaternion<double>& q) noexcept {
  static_assert(sizeof q == 32);
  return {_mm_loadu_pd(reinterpret_cast<const double*>(&q)), _mm_loadu_pd(&q.z)};
}

/// The same in doubles.
template <class T>
Lanes<double> wide_lanes(const Vec3<T>& a) noexcept { return Lanes<double>::of(a.x, a.y, a.z); }
template <class T>
Lanes<double> wide_lanes(const Quaternion<T>& q) noexcept { return Lanes<double>::of(q.x, q.y, q.z, q.w); }

/// a where `where` has all bits, b where it has none.
template <class T>
Lanes<T> select(const Lanes<T>& where, const Lanes<T>& a, const Lanes<T>& b) noexcept { return (a & where) | without(b, where); }
template <class T>
Lanes<T> absolute(const Lanes<T>& a) noexcept { return without(a, Lanes<T>::all(T(-0.0))); }

/// All bits in the lanes in which every argument is finite.
template <class T, class... More>
Lanes<T> are_finite(const Lanes<T>& a, const More&... more) noexcept {
  return ((a - a) + ... + (more - more)) == Lanes<T>::all(T(0));
}
/// Whether the first three lanes of a mask have all bits.
template <class T>
bool all_three(const Lanes<T>& mask) noexcept { return (mask.bits() & 7) == 7; }

template <class T>
bool any_of_three(const Lanes<T>& mask) noexcept { return (mask.bits() & 7) != 0; }

/// The sums of the first three lanes of each.
inline Lanes<float> sums_of_three(Lanes<float> a, Lanes<float> b, Lanes<float> c, Lanes<float> d) noexcept {
  const __m128 ab = _mm_unpacklo_ps(a.v, b.v), cd = _mm_unpacklo_ps(c.v, d.v);  // a0 b0 a1 b1
  const Lanes<float> x{_mm_movelh_ps(ab, cd)}, y{_mm_movehl_ps(cd, ab)};
  const Lanes<float> z{_mm_movelh_ps(_mm_unpackhi_ps(a.v, b.v), _mm_unpackhi_ps(c.v, d.v))};
  return x + y + z;
}
inline Lanes<double> sums_of_three(Lanes<double> a, Lanes<double> b, Lanes<double> c, Lanes<double> d) noexcept {
  const Lanes<double> x{_mm_unpacklo_pd(a.low, b.low), _mm_unpacklo_pd(c.low, d.low)};
  const Lanes<double> y{_mm_unpackhi_pd(a.low, b.low), _mm_unpackhi_pd(c.low, d.low)};
  const Lanes<double> z{_mm_unpacklo_pd(a.high, b.high), _mm_unpacklo_pd(c.high, d.high)};
  return x + y + z;
}

/// y, z, x and z, x, y of the first three lanes.
template <class T>
Lanes<T> yzx(const Lanes<T>& a) noexcept { return a.template shuffled<1, 2, 0, 3>(); }
template <class T>
Lanes<T> zxy(const Lanes<T>& a) noexcept { return a.template shuffled<2, 0, 1, 3>(); }

template <class T>
Lanes<T> cross(const Lanes<T>& a, const Lanes<T>& b) noexcept { return yzx(a * yzx(b) - yzx(a) * b); }

/// Of the first three lanes, in every lane.
template <class T>
Lanes<T> sum_of_three(const Lanes<T>& a) noexcept {
  return a.template broadcast<0>() + a.template broadcast<1>() + a.template broadcast<2>();
}
template <class T>
Lanes<T> sum_of_four(const Lanes<T>& a) noexcept {
  const Lanes<T> pairs = a + a.template shuffled<1, 0, 3, 2>();
  return pairs + pairs.template shuffled<2, 3, 0, 1>();
}
template <class T>
Lanes<T> largest_of_three(const Lanes<T>& a) noexcept {
  return larger(larger(a.template broadcast<0>(), a.template broadcast<1>()), a.template broadcast<2>());
}
template <class T>
Lanes<T> smallest_of_three(const Lanes<T>& a) noexcept {
  return smaller(smaller(a.template broadcast<0>(), a.template broadcast<1>()), a.template broadcast<2>());
}
/// Of a mask's first three lanes only the first that has bits.
template <class T>
Lanes<T> first_of_three(const Lanes<T>& mask) noexcept {
  const Lanes<T> three = mask & Lanes<T>::first_three();
  const Lanes<T> before_z = three.template shuffled<3, 3, 1, 3>();
  return without(three, three.template shuffled<3, 0, 0, 3>() | before_z);
}

/// Three vectors, vector i in lane i.
template <class T>
struct ThreeVectors {
  Lanes<T> x, y, z;

  static ThreeVectors of(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) noexcept {
    return {Lanes<T>::of(a.x, b.x, c.x), Lanes<T>::of(a.y, b.y, c.y), Lanes<T>::of(a.z, b.z, c.z)};
  }
  static ThreeVectors all(const Vec3<T>& a) noexcept { return {Lanes<T>::all(a.x), Lanes<T>::all(a.y), Lanes<T>::all(a.z)}; }

  /// Vector i + 1 in the place of vector i.
  ThreeVectors next() const noexcept { return {yzx(x), yzx(y), yzx(z)}; }
  /// Vector 0 in every place.
  ThreeVectors first() const noexcept {
    return {x.template broadcast<0>(), y.template broadcast<0>(), z.template broadcast<0>()};
  }
  friend ThreeVectors operator+(const ThreeVectors& a, const ThreeVectors& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend ThreeVectors operator-(const ThreeVectors& a, const ThreeVectors& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend ThreeVectors operator*(const ThreeVectors& a, const Lanes<T>& s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
  /// All bits where vector i of a is that of b.
  friend Lanes<T> equal(const ThreeVectors& a, const ThreeVectors& b) noexcept {
    return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
  }
  friend Lanes<T> dot(const ThreeVectors& a, const ThreeVectors& b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend ThreeVectors cross(const ThreeVectors& a, const ThreeVectors& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

}  // namespace collide::detail

#endif
