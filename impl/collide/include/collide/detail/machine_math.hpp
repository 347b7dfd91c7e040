/// Square root, absolute value, fused multiply-add and scaling by powers of two for built-in floating-point types.
///
/// These are the functions of <cmath>, taken from the compiler's built-ins where it has them: <cmath> would double the
/// compile time of a query.
#pragma once

#if !defined(__GNUC__)
#include <cmath>
#endif

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

#if defined(__GNUC__)

inline float sqrt(float x) noexcept { return __builtin_sqrtf(x); }
inline double sqrt(double x) noexcept { return __builtin_sqrt(x); }
inline long double sqrt(long double x) noexcept { return __builtin_sqrtl(x); }

constexpr float abs(float x) noexcept { return __builtin_fabsf(x); }
constexpr double abs(double x) noexcept { return __builtin_fabs(x); }
constexpr long double abs(long double x) noexcept { return __builtin_fabsl(x); }

inline float fma(float a, float b, float c) noexcept { return __builtin_fmaf(a, b, c); }
inline double fma(double a, double b, double c) noexcept { return __builtin_fma(a, b, c); }

/// x * 2^power.
inline float ldexp(float x, int power) noexcept { return __builtin_ldexpf(x, power); }
inline double ldexp(double x, int power) noexcept { return __builtin_ldexp(x, power); }

/// The exponent of x, which is finite and not zero: 2^exponent <= |x| < 2^(exponent + 1).
inline int ilogb(float x) noexcept { return __builtin_ilogbf(x); }
inline int ilogb(double x) noexcept { return __builtin_ilogb(x); }

#else

using std::abs;
using std::fma;
using std::ilogb;
using std::ldexp;
using std::sqrt;

#endif

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
