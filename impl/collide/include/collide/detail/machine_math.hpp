/// Square root, absolute value, fused multiply-add and scaling by powers of two for built-in floating-point types.
///
/// These are the functions of <cmath>, taken from the compiler's built-ins where it has them: <cmath> would double the
/// compile time of a query.
#pragma once

#if !defined(__GNUC__)
#include <cmath>
#endif

/// For what a hot function calls rarely: inlined, it would occupy registers.
#if defined(__GNUC__)
#define COLLIDE_COLD __attribute__((noinline, cold))
#else
#define COLLIDE_COLD
#endif

/// One instruction on scalars in SSE registers, where GCC moves the operands of an intrinsic through integer registers,
/// tests the argument of a root for its sign, and often compiles a selection to a branch.
#if defined(__GNUC__) && !defined(__clang__) && defined(__SSE2__)
#define COLLIDE_SCALAR_INSTRUCTIONS 1
#if defined(__AVX__)
#define COLLIDE_SCALAR_INSTRUCTION(name, result, a, b) asm("v" name " %2, %1, %0" : "=x"(result) : "x"(a), "x"(b))
#else
#define COLLIDE_SCALAR_INSTRUCTION(name, result, a, b) asm(name " %2, %0" : "=x"(result) : "0"(a), "x"(b))
#endif
#endif

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

#if defined(COLLIDE_SCALAR_INSTRUCTIONS)

inline float sqrt(float x) noexcept {
  COLLIDE_SCALAR_INSTRUCTION("sqrtss", x, x, x);
  return x;
}
inline double sqrt(double x) noexcept {
  COLLIDE_SCALAR_INSTRUCTION("sqrtsd", x, x, x);
  return x;
}

/// The larger, or smaller, number. A NaN in the first argument is returned.
inline float larger_at_run_time(float a, float b) noexcept {
  COLLIDE_SCALAR_INSTRUCTION("maxss", b, b, a);
  return b;
}
inline double larger_at_run_time(double a, double b) noexcept {
  COLLIDE_SCALAR_INSTRUCTION("maxsd", b, b, a);
  return b;
}
inline float smaller_at_run_time(float a, float b) noexcept {
  COLLIDE_SCALAR_INSTRUCTION("minss", b, b, a);
  return b;
}
inline double smaller_at_run_time(double a, double b) noexcept {
  COLLIDE_SCALAR_INSTRUCTION("minsd", b, b, a);
  return b;
}
#undef COLLIDE_SCALAR_INSTRUCTION

#elif defined(__GNUC__)

inline float sqrt(float x) noexcept { return __builtin_sqrtf(x); }
inline double sqrt(double x) noexcept { return __builtin_sqrt(x); }

#endif

#if defined(__GNUC__)

inline long double sqrt(long double x) noexcept { return __builtin_sqrtl(x); }

constexpr float abs(float x) noexcept { return __builtin_fabsf(x); }
constexpr double abs(double x) noexcept { return __builtin_fabs(x); }
constexpr long double abs(long double x) noexcept { return __builtin_fabsl(x); }

inline float fma(float a, float b, float c) noexcept { return __builtin_fmaf(a, b, c); }
inline double fma(double a, double b, double c) noexcept { return __builtin_fma(a, b, c); }

/// x * 2^power. A product with a power of two that is a normal number rounds as the library's function does, which is a
/// call.
inline float ldexp(float x, int power) noexcept {
  if (power >= -126 && power <= 127) return x * __builtin_bit_cast(float, unsigned(power + 127) << 23);
  return __builtin_ldexpf(x, power);
}
inline double ldexp(double x, int power) noexcept {
  if (power >= -1022 && power <= 1023)
    return x * __builtin_bit_cast(double, static_cast<unsigned long long>(power + 1023) << 52);
  return __builtin_ldexp(x, power);
}

/// The exponent of x, which is finite and not zero: 2^exponent <= |x| < 2^(exponent + 1).
inline int ilogb(float x) noexcept {
  const int biased = int(__builtin_bit_cast(unsigned, x) >> 23 & 0xFF);
  return biased != 0 ? biased - 127 : __builtin_ilogbf(x);
}
inline int ilogb(double x) noexcept {
  const int biased = int(__builtin_bit_cast(unsigned long long, x) >> 52 & 0x7FF);
  return biased != 0 ? biased - 1023 : __builtin_ilogb(x);
}

#else

using std::abs;
using std::fma;
using std::ilogb;
using std::ldexp;
using std::sqrt;

#endif

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
