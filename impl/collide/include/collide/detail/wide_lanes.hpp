/// Conversions between lanes of float and lanes of double, for filters that compute in the wider type.
#pragma once

#include <collide/detail/lanes.hpp>

#include <collide/detail/strict_begin.hpp>

#if defined(COLLIDE_LANES)

namespace collide::detail {

/// Four floats as doubles, and back. Doubles stay.
inline Lanes<double> in_doubles(const Lanes<float>& a) noexcept {
  return {{_mm_cvtps_pd(a.v)}, {_mm_cvtps_pd(_mm_movehl_ps(a.v, a.v))}};
}
inline Lanes<double> in_doubles(const Lanes<double>& a) noexcept { return a; }
inline Lanes<float> in_floats(const Lanes<double>& a) noexcept {
  return {_mm_movelh_ps(_mm_cvtpd_ps(a.low.v), _mm_cvtpd_ps(a.high.v))};
}

/// A mask of lanes of float as one of lanes of double.
inline Lanes<double> mask_in_doubles(const Lanes<float>& mask) noexcept {
  return {{_mm_castps_pd(_mm_unpacklo_ps(mask.v, mask.v))}, {_mm_castps_pd(_mm_unpackhi_ps(mask.v, mask.v))}};
}

}  // namespace collide::detail

#endif

#include <collide/detail/strict_end.hpp>
