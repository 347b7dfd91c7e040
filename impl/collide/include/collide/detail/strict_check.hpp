/// Refuses options of the compiler that give up IEEE 754 arithmetic: -ffast-math, -Ofast, -funsafe-math-optimizations
/// and every option that they imply and that changes a result. The headers need signed zeros, infinities, NaN, and one
/// rounding for each operation. Each header with arithmetic includes this one, through detail/strict_begin.hpp.
///
/// Where the compiler tells by a macro or by a constant, or, in an optimised build, by what it removes, the option is a
/// compile error. Clang tells of -ffp-contract=fast in no way, and no pragma undoes that option: a program that was
/// compiled so, for a machine with fused multiply-add, ends before main, with one line on standard error. Clang's
/// -freciprocal-math and -fapprox-func are without effect here, through the pragmas of detail/strict_begin.hpp.
#pragma once

#define COLLIDE_NEEDS_IEEE_754 \
  "collide needs IEEE 754 arithmetic: compile without -ffast-math, -Ofast and the options that they imply"

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(__NO_SIGNED_ZEROS__) || \
    (defined(__GCC_IEC_559) && __GCC_IEC_559 == 0) || defined(_M_FP_FAST)
#error "collide needs IEEE 754 arithmetic: compile without -ffast-math, -Ofast and the options that they imply"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "collide needs operations that round to their own type: on 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif
static_assert(0.1 != double(0.1f), "collide needs constants in double: compile without -fsingle-precision-constant");

#if defined(__clang__)
#include <cstdio>
#include <cstdlib>

namespace collide::detail {

[[gnu::error(COLLIDE_NEEDS_IEEE_754)]] void refuse_options();

/// Asks the optimiser whether it gives up reassociation, signed zeros, NaN or infinities: each condition depends on `x`
/// under IEEE 754. Never called.
[[gnu::used]] static inline void refuse_unsafe_options(double x) {
  if (__builtin_constant_p((x + 1) - x) || __builtin_constant_p(x != x) || __builtin_constant_p(x + __builtin_inf()) ||
      __builtin_constant_p(__builtin_copysign(1, x + 0.0) == __builtin_copysign(1, x))) {
    refuse_options();
  }
}

#pragma float_control(push)
#pragma clang fp contract(off)
/// Ends the program if the compiler contracts a product and a sum in spite of the pragma.
[[gnu::used]] static const bool refuses_contraction = [] {
  const volatile double x = 1 + 0x1p-30, rounded_square = 1 + 0x1p-29;
  const double rest = x * x - rounded_square;  // 0 with two roundings, 2^-60 with one
  if (rest == 0) return true;
  std::fputs("collide needs IEEE 754 arithmetic: compile without -ffp-contract=fast, which no pragma undoes in Clang\n",
             stderr);
  std::abort();
}();
#pragma float_control(pop)

}  // namespace collide::detail
#endif
