/// The instruction sets of batches, and the parts of a batch that do not depend on them.
#pragma once

#include <cstddef>

#include <collide/detail/lanes.hpp>
#include <collide/soa.hpp>

/// COLLIDE_BATCH_LANES is defined if batches have kernels in lanes: on x86-64 with GCC or Clang, unless the program
/// defines COLLIDE_NO_LANES.
#if defined(COLLIDE_LANES) && defined(__GNUC__) && defined(__x86_64__)
#define COLLIDE_BATCH_LANES 1

/// The operations of the struct Wide in batch_sse2.hpp and batch_avx2.hpp whose intrinsics are called alike.
#define COLLIDE_WIDE_OPERATIONS(prefix, suffix)                                                                       \
  COLLIDE_BATCH_FUNCTION static Wide splat(Number x) { return {prefix##_set1_##suffix(x)}; }                          \
  COLLIDE_BATCH_FUNCTION static Wide load(const Number* p) { return {prefix##_loadu_##suffix(p)}; }                   \
  COLLIDE_BATCH_FUNCTION void store(Number* p) const { prefix##_storeu_##suffix(p, v); }                              \
  COLLIDE_BATCH_FUNCTION friend Wide operator+(Wide a, Wide b) { return {prefix##_add_##suffix(a.v, b.v)}; }          \
  COLLIDE_BATCH_FUNCTION friend Wide operator-(Wide a, Wide b) { return {prefix##_sub_##suffix(a.v, b.v)}; }          \
  COLLIDE_BATCH_FUNCTION friend Wide operator*(Wide a, Wide b) { return {prefix##_mul_##suffix(a.v, b.v)}; }          \
  COLLIDE_BATCH_FUNCTION friend Wide operator/(Wide a, Wide b) { return {a.v / b.v}; }                                \
  COLLIDE_BATCH_FUNCTION friend Wide operator&(Wide a, Wide b) { return {prefix##_and_##suffix(a.v, b.v)}; }          \
  COLLIDE_BATCH_FUNCTION friend Wide operator|(Wide a, Wide b) { return {prefix##_or_##suffix(a.v, b.v)}; }           \
  COLLIDE_BATCH_FUNCTION friend Wide operator^(Wide a, Wide b) { return {prefix##_xor_##suffix(a.v, b.v)}; }          \
  COLLIDE_BATCH_FUNCTION friend Wide and_not(Wide a, Wide where) { return {prefix##_andnot_##suffix(where.v, a.v)}; } \
  COLLIDE_BATCH_FUNCTION friend Wide sqrt(Wide a) { return {prefix##_sqrt_##suffix(a.v)}; }                           \
  COLLIDE_BATCH_FUNCTION friend Wide larger(Wide a, Wide b) { return {prefix##_max_##suffix(b.v, a.v)}; }             \
  COLLIDE_BATCH_FUNCTION friend Wide smaller(Wide a, Wide b) { return {prefix##_min_##suffix(b.v, a.v)}; }            \
  COLLIDE_BATCH_FUNCTION int bits() const { return prefix##_movemask_##suffix(v); }
#endif

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// The instructions that a batch uses. The answers are the same.
enum class Simd {
  none,  ///< calls the query for one struct after the other
  sse2,  ///< four floats or two doubles at a time; every x86-64 has it
  avx2,  ///< eight floats or four doubles at a time
};

/// The widest instructions that this machine has.
inline Simd widest_simd() noexcept {
#if defined(COLLIDE_BATCH_LANES)
  return __builtin_cpu_supports("avx2") ? Simd::avx2 : Simd::sse2;
#else
  return Simd::none;
#endif
}

namespace detail {

/// Calls the query for struct i of the arrays and stores the answer. `in` and `out` point to the arrays of the
/// arguments, one argument after the other, and to those of the answers.
using AnswerOne = void (*)(std::size_t i, const void* const* in, void* const* out) noexcept;

template <class S>
S struct_from(std::size_t i, const void* const*& arrays) noexcept {
  S s{};
  for_each_array_leaf(
      s, [&](auto& leaf) { leaf = static_cast<const std::remove_reference_t<decltype(leaf)>*>(*arrays++)[i]; });
  return s;
}

template <class Query, class... Arguments>
void answer_one(std::size_t i, const void* const* in, void* const* out) noexcept {
  const std::tuple<Arguments...> arguments{struct_from<Arguments>(i, in)...};
  const auto answer = std::apply(Query(), arguments);
  for_each_array_leaf(answer,
                      [&](const auto& leaf) { static_cast<std::remove_cvref_t<decltype(leaf)>*>(*out++)[i] = leaf; });
}

}  // namespace detail
}  // namespace collide

#include <collide/detail/strict_end.hpp>
