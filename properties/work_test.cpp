/// No case makes the oracle hang. What the exact stage costs is the memory that its numbers take, steps and
/// bits together, so that is what is bounded: the same on every machine, however busy.
#include <gmp.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "corpus/codec.hpp"
#include "corpus/raw_numbers.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

/// What the numbers of GMP and MPFR took since the last reset.
struct Work {
  std::uint64_t allocations = 0, bytes = 0;
};
Work work;

void count_bytes(std::size_t bytes) {
  ++work.allocations;
  work.bytes += bytes;
}

/// Counts for its lifetime; memory stays that of malloc, so that what was taken before can be freed within.
class CountedWork {
 public:
  CountedWork() {
    mp_get_memory_functions(&allocate_, &reallocate_, &free_);
    mp_set_memory_functions(
        [](std::size_t n) { return count_bytes(n), std::malloc(n); },
        [](void* p, std::size_t, std::size_t n) { return count_bytes(n), std::realloc(p, n); },
        [](void* p, std::size_t) { std::free(p); });
    work = {};
  }
  ~CountedWork() { mp_set_memory_functions(allocate_, reallocate_, free_); }
  CountedWork(const CountedWork&) = delete;
  CountedWork& operator=(const CountedWork&) = delete;

 private:
  void* (*allocate_)(std::size_t);
  void* (*reallocate_)(void*, std::size_t, std::size_t);
  void (*free_)(void*, std::size_t);
};

/// Four times what the costliest case takes (two boxes' penetration: 27,000 allocations, 2.2 MB).
constexpr std::uint64_t most_allocations = 100'000;
constexpr std::uint64_t most_bytes = 8'000'000;

class WorkOfTheOracle : public testing::TestWithParam<NamedQuery> {};

TEST_P(WorkOfTheOracle, IsBoundedWhateverTheNumbers) {
  const Query& query = *GetParam().query;
  Work largest;
  const auto watch = [&](const Case& c) {
    const CountedWork counted;
    const Truth truth = truth_of(c);
    EXPECT_FALSE(truth.alternatives.empty());
    largest = {std::max(largest.allocations, work.allocations), std::max(largest.bytes, work.bytes)};
    ASSERT_LE(work.allocations, most_allocations) << case_to_json(c).dump();
    ASSERT_LE(work.bytes, most_bytes) << case_to_json(c).dump();
  };
  for (std::uint64_t i = 0; i < 60; ++i) {
    for (const Scalar scalar : scalars) {
      watch(raw_case(query, scalar, i));
      watch(far_scaled_case(query, scalar, 17, i));
    }
  }
  RecordProperty("allocations", std::to_string(largest.allocations));
  RecordProperty("bytes", std::to_string(largest.bytes));
  EXPECT_GT(largest.allocations, 0u);
}

INSTANTIATE_TEST_SUITE_P(Every, WorkOfTheOracle, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
