/// Measures the time of single calls of a subject's functions, without the time to decode inputs or to store answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <span>
#include <vector>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#include "impl/catalogue/answer.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

/// A clock for calls of a few nanoseconds. A tick is a cycle of the time stamp counter where the processor has one, and
/// a nanosecond elsewhere. begin() and end() are ordered with the instructions between them. (The header that declares
/// __rdtsc declares the intrinsics of all processors, and takes a third of a second to read.)
struct CallClock {
#if defined(__x86_64__)
  static std::uint64_t begin() {
    _mm_lfence();
    const std::uint64_t t = __builtin_ia32_rdtsc();
    _mm_lfence();
    return t;
  }
  static std::uint64_t end() {
    unsigned processor;
    const std::uint64_t t = __builtin_ia32_rdtscp(&processor);
    _mm_lfence();
    return t;
  }
#else
  static std::uint64_t begin() { return std::uint64_t(nanoseconds(CLOCK_MONOTONIC)); }
  static std::uint64_t end() { return begin(); }
#endif
  static std::int64_t nanoseconds(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return std::int64_t(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
  }
};

/// Makes the compiler assume that the value is used.
template <class T>
inline void use_value(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

/// The measured times of the cases of a batch. A time function adds one round: each case once, in the given order.
struct TimedRounds {
  std::vector<std::uint64_t> ticks;  ///< of single calls: round after round
  std::vector<std::int64_t>
      processor;           ///< of whole rounds without a clock between the calls: nanoseconds of the thread
  std::int64_t until = 0;  ///< no round begins after this time of the thread's processor clock, but the first
  unsigned most = 1;       ///< rounds
};

/// Calls `call` with each element of `cases`, for some rounds. The first round warms caches and predictors and is not
/// counted.
template <class C, class F>
void time_calls(std::span<const C> cases, F&& call, TimedRounds& rounds) {
  for (const C& c : cases) use_value(call(c));
  for (unsigned round = 0; round < rounds.most; ++round) {
    if (round > 0 && CallClock::nanoseconds(CLOCK_THREAD_CPUTIME_ID) > rounds.until) return;
    const std::int64_t begin = CallClock::nanoseconds(CLOCK_THREAD_CPUTIME_ID);
    for (const C& c : cases) use_value(call(c));
    rounds.processor.push_back(CallClock::nanoseconds(CLOCK_THREAD_CPUTIME_ID) - begin);
    for (const C& c : cases) {
      const std::uint64_t from = CallClock::begin();
      use_value(call(c));
      rounds.ticks.push_back(CallClock::end() - from);
    }
  }
}

/// The typed inputs of a batch.
template <class Q>
std::vector<Q> typed_cases(const CaseNumbers& numbers) {
  std::vector<Q> cases;
  cases.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) cases.push_back(inputs_from<Q>(numbers[i].data()));
  return cases;
}

}  // namespace nearmiss
