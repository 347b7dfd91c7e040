/// The instruction sets of batches, and the parts of a batch that do not depend on them.
#pragma once

#include <cstddef>

#include <collide/detail/lanes.hpp>
#include <collide/soa.hpp>

/// COLLIDE_BATCH_LANES is defined if batches have kernels in lanes: on x86-64 with GCC or Clang, unless the program
/// defines COLLIDE_NO_LANES.
#if defined(COLLIDE_LANES) && defined(__GNUC__) && defined(__x86_64__)
#define COLLIDE_BATCH_LANES 1
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
