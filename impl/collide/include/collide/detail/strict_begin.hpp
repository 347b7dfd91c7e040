// Strict IEEE 754 arithmetic from here to detail/strict_end.hpp: every operation rounds once, to its own type. Each
// header of collide with arithmetic puts this pair around its functions, so this file has no include guard.
//
// Contraction (a * b + c with one rounding) and reassociation break the error-free transformations and the error bounds
// of the tiers Accurate and Certified, and they make the answers of Fast depend on the compiler.

#include <collide/detail/strict_check.hpp>

// Pragmas turn contraction off, and in Clang -freciprocal-math and -fapprox-func. GCC does not inline these functions
// into callers with other options; -ffp-contract=off -fno-tree-slp-vectorize for the whole program restores inlining.
// The second option is there because GCC 12 contracts in that optimization whatever -ffp-contract says.
#if defined(__clang__)
#pragma float_control(push)
#pragma float_control(precise, on)
#pragma clang fp contract(off)
#elif defined(__GNUC__) && defined(__FP_FAST_FMA)
#pragma GCC push_options
#pragma GCC optimize("fp-contract=off", "no-tree-slp-vectorize")
#elif defined(_MSC_VER)
#pragma float_control(push)
#pragma fp_contract(off)
#endif

// Indices of axes, edges and corners are of type int, because -1 stands for none. As indices of arrays they are never
// negative; without this, -Wsign-conversion (which -Wconversion contains in Clang) warns of each.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif
