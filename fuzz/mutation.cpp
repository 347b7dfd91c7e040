#include "fuzz/mutation.hpp"

#include <array>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/search/crossover.hpp"
#include "corpus/search/float_order.hpp"
#include "corpus/storage/codec.hpp"

namespace nearmiss::fuzz {

namespace {

/// A change of one number by a number of ulps; of 0 ulps: none.
struct Step {
  std::size_t number = 0;
  int ulps = 0;
};

/// The largest step of a walk: 2^20 ulps.
constexpr int longest_step = 1 << 20;

/// What is known of a case that was executed.
struct Known {
  std::uint64_t hash = 0;
  double badness = 0;
  Step step;  ///< the step that led to it from a case with better answers
};

/// Direct-mapped: a new case replaces another one with the same low bits.
std::array<Known, 1 << 12> known_cases;

Known& slot_of(std::uint64_t hash) { return known_cases[hash % known_cases.size()]; }

std::uint64_t hash_of(const Case& c) {
  std::uint64_t h = 0xcbf29ce484222325;  // FNV-1a
  for (const std::uint8_t byte : case_to_bytes(c)) h = (h ^ byte) * 0x100000001b3;
  return h;
}

/// The last step, and the cases before and after it.
struct Taken {
  std::uint64_t child = 0;
  double parents_badness = 0;
  Step step;
} taken;

bool is_real(Role role) { return !is_discrete(role); }

/// Moves one number by some ulps. False, without a change, where the result breaks a rule.
bool apply(Case& c, Step step) {
  if (!is_real(c.role(step.number))) return false;
  const double before = c.values[step.number];
  double& x = c.values[step.number];
  x = moved_by_ulps(x, step.ulps, c.scalar);
  if (std::isfinite(x) && !c.query->broken(c.values)) return true;
  x = before;
  return false;
}

/// A step in a new direction: a power of two of ulps, small ones more often.
Step new_step(const Case& c, Random& random) {
  const int size = 1 << random.below(1 + random.below(20));
  return {random.below(c.values.size()), random.one_in(2) ? size : -size};
}

/// Walks by ulps. A step that made the answers worse is repeated with twice its size.
void walk(Case& c, Random& random) {
  const Known known = slot_of(hash_of(c));
  const bool is_known = known.hash == hash_of(c);
  Step step = is_known && known.step.ulps != 0 && random.one_in(2) ? known.step : new_step(c, random);
  if (!apply(c, step)) return;
  if (std::abs(step.ulps) < longest_step) step.ulps *= 2;
  taken = {hash_of(c), is_known ? known.badness : 0, step};
}

}  // namespace

Case fresh_case(const Query& query, unsigned seed) {
  return generate(query, seed % 2 == 0 ? Scalar::float32 : Scalar::float64, seed, 0);
}

void change(Case& c, unsigned seed) {
  Random random(seed);
  switch (random.below(16)) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 5: return walk(c, random);
    case 6:  // half as often as the next one: it takes as long as three executions
      if (snap_to_touching(c, random.bits())) return;
      break;
    case 7:
    case 8:
      if (take_number_of_stored_case(c, random.bits())) return;
      break;
    default: break;
  }
  mutate(c, random.bits());
}

void cross_over(Case& c, const Case& other, unsigned seed) {
  Random random(seed);
  if (cross(c, other, random.bits())) return;
  walk(c, random);
}

void remember(const Case& c, double badness) {
  const std::uint64_t hash = hash_of(c);
  const bool by_step = taken.child == hash && badness > taken.parents_badness;
  slot_of(hash) = {hash, badness, by_step ? taken.step : Step{}};
}

}  // namespace nearmiss::fuzz
