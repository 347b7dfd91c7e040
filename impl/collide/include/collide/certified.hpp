/// The tier `Certified`: every decision is exact for all finite inputs, and every number lies within two units in the
/// last place of the exact one. Needs the library collide::certified, which answers the queries in this tier; it needs
/// MPFR and GMP.
#pragma once

#include <cstdint>

#include <collide/contract.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The number of answers that each stage gave.
struct StageCounts {
  std::uint64_t filter = 0;    ///< doubles with error bounds
  std::uint64_t extended = 0;  ///< double-words with error bounds
  std::uint64_t exact = 0;     ///< exact real numbers
  std::uint64_t invalid = 0;   ///< input that is not finite: answered in plain arithmetic
};

/// The tier `Certified`. For all finite inputs each decision is exact, and each number lies within two units in the
/// last place of the exact one (of a vector: units of its largest number). The processor must round to nearest. If
/// memory runs out, a query throws std::bad_alloc or GMP terminates the program; with -fno-exceptions the program
/// always ends.
struct Certified : Plain {
  static constexpr bool in_library = true;
  static constexpr bool never_throws = false;

  /// The same contract for every query and scalar, without limits on magnitudes.
  template <class T>
  static constexpr Contract contract(const Contract&) {
    return {.forward = 2, .exact_decisions = true, .unit = 4};
  }

  /// The number of answers that each stage gave on this thread.
  static StageCounts& counts();
};

}  // namespace collide
