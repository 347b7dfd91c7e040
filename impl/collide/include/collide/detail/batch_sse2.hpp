/// Batches with SSE2: four floats or two doubles at a time.
#pragma once

#include <collide/detail/batch_queries.hpp>
#include <collide/detail/batch_simd.hpp>

#if defined(COLLIDE_BATCH_LANES)
#include <cstring>

#define COLLIDE_BATCH_FUNCTION __attribute__((always_inline)) inline
#define COLLIDE_BATCH_LAMBDA __attribute__((always_inline))
#define COLLIDE_BATCH_LOOP __attribute__((noinline))
#endif

#include <collide/detail/strict_begin.hpp>

#if defined(COLLIDE_BATCH_LANES)

namespace collide::detail::sse2 {

/// One number of each of several structs.
template <class T>
struct Wide;

template <>
struct Wide<float> {
  using Number = float;
  static constexpr std::size_t size = 4;
  __m128 v;

  COLLIDE_WIDE_OPERATIONS(_mm, ps)
  COLLIDE_BATCH_FUNCTION static Wide mask(const bool* p) {
    int flags;
    std::memcpy(&flags, p, sizeof flags);
    const __m128i zero = _mm_setzero_si128(), bytes = _mm_unpacklo_epi8(_mm_cvtsi32_si128(flags), zero);
    return {_mm_castsi128_ps(_mm_sub_epi32(zero, _mm_unpacklo_epi16(bytes, zero)))};
  }
  COLLIDE_BATCH_FUNCTION friend Wide operator<(Wide a, Wide b) { return {_mm_cmplt_ps(a.v, b.v)}; }
  COLLIDE_BATCH_FUNCTION friend Wide operator<=(Wide a, Wide b) { return {_mm_cmple_ps(a.v, b.v)}; }
  COLLIDE_BATCH_FUNCTION friend Wide operator==(Wide a, Wide b) { return {_mm_cmpeq_ps(a.v, b.v)}; }
  COLLIDE_BATCH_FUNCTION Wide sign_mask() const { return {_mm_castsi128_ps(_mm_srai_epi32(_mm_castps_si128(v), 31))}; }
};

template <>
struct Wide<double> {
  using Number = double;
  static constexpr std::size_t size = 2;
  __m128d v;

  COLLIDE_WIDE_OPERATIONS(_mm, pd)
  COLLIDE_BATCH_FUNCTION static Wide mask(const bool* p) {
    return {_mm_castsi128_pd(_mm_setr_epi32(-int(p[0]), -int(p[0]), -int(p[1]), -int(p[1])))};
  }
  COLLIDE_BATCH_FUNCTION friend Wide operator<(Wide a, Wide b) { return {_mm_cmplt_pd(a.v, b.v)}; }
  COLLIDE_BATCH_FUNCTION friend Wide operator<=(Wide a, Wide b) { return {_mm_cmple_pd(a.v, b.v)}; }
  COLLIDE_BATCH_FUNCTION friend Wide operator==(Wide a, Wide b) { return {_mm_cmpeq_pd(a.v, b.v)}; }
  COLLIDE_BATCH_FUNCTION Wide sign_mask() const {
    const __m128i high = _mm_srai_epi32(_mm_castpd_si128(v), 31);
    return {_mm_castsi128_pd(_mm_shuffle_epi32(high, _MM_SHUFFLE(3, 3, 1, 1)))};
  }
};

#include <collide/detail/batch/values.hpp>

#include <collide/detail/batch/kernels.hpp>
#include <collide/detail/batch/motions.hpp>
#include <collide/detail/batch/rounded.hpp>

#include <collide/detail/batch/blocks.hpp>

}  // namespace collide::detail::sse2

#undef COLLIDE_BATCH_FUNCTION
#undef COLLIDE_BATCH_LAMBDA
#undef COLLIDE_BATCH_LOOP

#endif

#include <collide/detail/strict_end.hpp>
