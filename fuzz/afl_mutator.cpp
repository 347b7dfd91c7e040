/// The generator's moves as a custom mutator of AFL++: a shared library that afl-fuzz loads
/// (AFL_CUSTOM_MUTATOR_LIBRARY). AFL++ also uses its own mutations, unless AFL_CUSTOM_MUTATOR_ONLY is set.
///
/// NEARMISS_MUTATED_TARGET   the fuzz target whose inputs are mutated: its name without fuzz_
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fuzz/mutated_bytes.hpp"

namespace {

struct MutatorState {
  const nearmiss::FuzzTarget* target;
  std::uint64_t seed;
  std::vector<std::uint8_t> made;  ///< the last result; afl-fuzz reads it until the next call
};

}  // namespace

// The functions that AFL++ looks for. Their types are those of docs/custom_mutators.md in AFL++, without its headers.

extern "C" void* afl_custom_init(void* /*afl_state_t*/, unsigned int seed) {
  const char* name = std::getenv("NEARMISS_MUTATED_TARGET");
  const nearmiss::FuzzTarget* target = nearmiss::find_fuzz_target(name == nullptr ? "" : name);
  if (target == nullptr) {
    std::fprintf(stderr, "afl_mutator: NEARMISS_MUTATED_TARGET is no fuzz target: %s\n",
                 name == nullptr ? "not set" : name);
    return nullptr;  // afl-fuzz ends
  }
  return new MutatorState{target, seed, {}};
}

extern "C" std::size_t afl_custom_fuzz(void* data, std::uint8_t* bytes, std::size_t size, std::uint8_t** out,
                                       std::uint8_t* /*other*/, std::size_t /*other_size*/, std::size_t max_size) {
  auto& mutator = *static_cast<MutatorState*>(data);
  mutator.made = nearmiss::mutated_case(*mutator.target, {bytes, size}, mutator.seed++);
  *out = mutator.made.data();
  return std::min(mutator.made.size(), max_size);
}

extern "C" void afl_custom_deinit(void* data) { delete static_cast<MutatorState*>(data); }
