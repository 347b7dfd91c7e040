/// Batches with AVX2: eight floats or four doubles at a time.
#pragma once

#include <collide/detail/batch_queries.hpp>
#include <collide/detail/batch_simd.hpp>

#if defined(COLLIDE_BATCH_LANES)
#include <cstring>

#include <immintrin.h>

#define COLLIDE_BATCH_FUNCTION __attribute__((target("avx2"), always_inline)) inline
#define COLLIDE_BATCH_LAMBDA __attribute__((target("avx2"), always_inline))
#define COLLIDE_BATCH_LOOP __attribute__((target("avx2"), noinline))
#endif

#include <collide/detail/strict_begin.hpp>

#if defined(COLLIDE_BATCH_LANES)

namespace collide::detail::avx2 {

/// One number of each of several structs.
template <class T>
struct Wide;

template <>
struct Wide<float> {
  using Number = float;
  static constexpr std::size_t size = 8;
  __m256 v;

  COLLIDE_WIDE_OPERATIONS(_mm256, ps)
  COLLIDE_BATCH_FUNCTION static Wide mask(const bool* p) {
    const __m128i flags = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
    return {_mm256_castsi256_ps(_mm256_sub_epi32(_mm256_setzero_si256(), _mm256_cvtepu8_epi32(flags)))};
  }
  COLLIDE_BATCH_FUNCTION friend Wide operator<(Wide a, Wide b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OS)}; }
  COLLIDE_BATCH_FUNCTION friend Wide operator<=(Wide a, Wide b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OS)}; }
  COLLIDE_BATCH_FUNCTION friend Wide operator==(Wide a, Wide b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)}; }
  COLLIDE_BATCH_FUNCTION Wide sign_mask() const {
    return {_mm256_castsi256_ps(_mm256_srai_epi32(_mm256_castps_si256(v), 31))};
  }
};

template <>
struct Wide<double> {
  using Number = double;
  static constexpr std::size_t size = 4;
  __m256d v;

  COLLIDE_WIDE_OPERATIONS(_mm256, pd)
  COLLIDE_BATCH_FUNCTION static Wide mask(const bool* p) {
    int flags;
    std::memcpy(&flags, p, sizeof flags);
    const __m256i words = _mm256_cvtepu8_epi64(_mm_cvtsi32_si128(flags));
    return {_mm256_castsi256_pd(_mm256_sub_epi64(_mm256_setzero_si256(), words))};
  }
  COLLIDE_BATCH_FUNCTION friend Wide operator<(Wide a, Wide b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OS)}; }
  COLLIDE_BATCH_FUNCTION friend Wide operator<=(Wide a, Wide b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LE_OS)}; }
  COLLIDE_BATCH_FUNCTION friend Wide operator==(Wide a, Wide b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_EQ_OQ)}; }
  COLLIDE_BATCH_FUNCTION Wide sign_mask() const {
    return {_mm256_castsi256_pd(_mm256_cmpgt_epi64(_mm256_setzero_si256(), _mm256_castpd_si256(v)))};
  }
};

#include <collide/detail/batch/values.hpp>

#include <collide/detail/batch/kernels.hpp>
#include <collide/detail/batch/motions.hpp>
#include <collide/detail/batch/rounded.hpp>

#include <collide/detail/batch/blocks.hpp>

}  // namespace collide::detail::avx2

#undef COLLIDE_BATCH_FUNCTION
#undef COLLIDE_BATCH_LAMBDA
#undef COLLIDE_BATCH_LOOP

#endif

#include <collide/detail/strict_end.hpp>
