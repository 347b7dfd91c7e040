/// No case makes the oracle or the certified tier hang. The cost of their exact stages is the memory that their numbers
/// take, steps and bits together. The test bounds that memory, which is the same on every machine under any load.
#include <gmp.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "properties/judge/raw_numbers.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

/// The memory that the numbers of GMP and MPFR took since the last reset.
struct Work {
  std::uint64_t allocations = 0, bytes = 0;
};
Work work;

void count_bytes(std::size_t bytes) {
  ++work.allocations;
  work.bytes += bytes;
}

/// Counts during its lifetime. Memory still comes from malloc, so that earlier allocations can be freed meanwhile.
class CountedWork {
 public:
  CountedWork() {
    mp_get_memory_functions(&allocate_, &reallocate_, &free_);
    mp_set_memory_functions([](std::size_t n) { return count_bytes(n), std::malloc(n); },
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

Work larger(const Work& a, const Work& b) {
  return {std::max(a.allocations, b.allocations), std::max(a.bytes, b.bytes)};
}

/// Asks `answer` about numbers of any magnitude, scenes far from 1, stored cases, and touches on lattices with a few
/// numbers of another magnitude. Returns the largest cost of a case.
template <class F>
Work largest_work(const Query& query, Scalar scalar, std::uint64_t raw_cases, const Work& most, F answer) {
  Work largest;
  const auto watch = [&](const Case& c) {
    const CountedWork counted;
    answer(c);
    largest = larger(largest, work);
    ASSERT_LE(work.allocations, most.allocations) << case_to_json(c).dump();
    ASSERT_LE(work.bytes, most.bytes) << case_to_json(c).dump();
  };
  for (std::uint64_t i = 0; i < raw_cases; ++i) {
    watch(raw_case(query, scalar, i));
    watch(far_scaled_case(query, scalar, 17, i));
  }
  for (const StoredCase& s : stored_cases(query)) {
    if (s.question.scalar == scalar) watch(s.question);
  }
  for (std::uint64_t i = 0; i < 40 * raw_cases; ++i) {
    if (const Case c = generate(query, scalar, stream(9), i); has_extreme_mutator(c)) watch(c);
  }
  return largest;
}

void record(const Work& largest) {
  testing::Test::RecordProperty("allocations", std::to_string(largest.allocations));
  testing::Test::RecordProperty("bytes", std::to_string(largest.bytes));
}

bool is_distance_of_box(const Query& q) { return q.name.ends_with("_box_signed_distance"); }

/// Four times the cost of the costliest case (two boxes' penetration: 27,000 allocations, 2.2 MB; the distance of two
/// boxes whose numbers differ by 10^500, so that intervals leave 200 directions for exact numbers: 138,000 allocations,
/// 46 MB).
constexpr Work most_of_the_oracle{100'000, 8'000'000}, most_for_distances_of_boxes{550'000, 184'000'000};

class WorkOfTheOracle : public testing::TestWithParam<NamedQuery> {};

TEST_P(WorkOfTheOracle, IsBoundedWhateverTheNumbers) {
  const Query& query = *GetParam().query;
  const Work& most = is_distance_of_box(query) ? most_for_distances_of_boxes : most_of_the_oracle;
  Work largest;
  for (const Scalar scalar : scalars) {
    largest = larger(largest, largest_work(query, scalar, 60, most,
                                           [](const Case& c) { EXPECT_FALSE(truth_of(c).alternatives.empty()); }));
  }
  record(largest);
  EXPECT_GT(largest.allocations, 0u);
}

INSTANTIATE_FOR_EVERY_QUERY(Every, WorkOfTheOracle, testing::ValuesIn(every_query()),
                            testing::PrintToStringParamName());

/// Four times the cost of the costliest of 10^6 cases (a sphere past a rectangle: 11,000 allocations; the penetration
/// of two boxes: 1.1 MB), and of the costliest signed distance of two triangles (28,000 allocations, 5.8 MB) and of a
/// box (two boxes of doubles: 73,000 allocations, 27 MB).
constexpr Work most_of_the_certified{45'000, 4'500'000}, most_for_two_triangles{115'000, 24'000'000},
    most_of_certified_distances{295'000, 110'000'000};

class WorkOfTheCertified : public testing::TestWithParam<Pairing> {};

TEST_P(WorkOfTheCertified, IsBoundedWhateverTheNumbers) {
  const auto [query, subject] = GetParam();
  const Offering& offering = subject->offering(query->name);
  const bool of_box = is_distance_of_box(*query), of_triangles = query->name == "triangle_triangle_signed_distance";
  const Work& most = of_box         ? most_of_certified_distances
                     : of_triangles ? most_for_two_triangles
                                    : most_of_the_certified;
  const Work largest = largest_work(*query, subject->scalar, of_box ? 50 : 200, most, [&](const Case& c) {
    EXPECT_EQ(offering.answer(c.values).status, Answer::Status::answered);
  });
  record(largest);
}

INSTANTIATE_FOR_EVERY_QUERY(Every, WorkOfTheCertified, testing::ValuesIn(certified_pairings()),
                            testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
