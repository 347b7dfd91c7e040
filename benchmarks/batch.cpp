/// Measures the throughput of batches beside that of single calls of `Fast`; writes docs/measured/batch.md to standard
/// output.
///
///   batch_gain [--cases=N] [--repeats=N] [QUERY ...]
///
/// All ways answer the same plain cases of the generator, one way after the other in each repeat. A figure is the
/// median of the repeats; a ratio is the median of the ratios within a repeat.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/machine.hpp"
#include "benchmarks/prepared.hpp"
#include "benchmarks/timed_cases.hpp"
#include "impl/adapters/collide_batch.hpp"
#include "impl/catalogue/answer.hpp"
#include "impl/catalogue/query.hpp"
#include "impl/subject/timed_calls.hpp"
#include "nearmiss/collide_functions.hpp"

namespace nearmiss::benchmarks {

namespace {

constexpr std::int64_t least_time = 1'000'000;  // ns of one measurement

/// Nanoseconds of processor time for each case of one pass, from passes that together take at least `least_time`.
double time_of(const std::function<void()>& pass, std::size_t cases) {
  const std::int64_t begin = CallClock::nanoseconds(CLOCK_THREAD_CPUTIME_ID);
  for (std::int64_t passes = 1;; ++passes) {
    pass();
    const std::int64_t taken = CallClock::nanoseconds(CLOCK_THREAD_CPUTIME_ID) - begin;
    if (taken >= least_time) return double(taken) / double(passes) / double(cases);
  }
}

double median(std::vector<double> of) {
  std::nth_element(of.begin(), of.begin() + std::ptrdiff_t(of.size() / 2), of.end());
  return of[of.size() / 2];
}

struct Gain {
  double single, sse2, avx2;      ///< ns
  double ratio_sse2, ratio_avx2;  ///< single / batch
};

/// The single calls of the cases, in their order, with their answers in an array.
template <class Q>
struct Singles {
  std::vector<Ready<collide::Fast, Q>> cases;
  std::vector<typename Q::Answer> answers;

  [[gnu::noinline]] void pass() {
    for (std::size_t i = 0; i < cases.size(); ++i) answers[i] = cases[i].ask();
    use_value(answers.front());
  }
};

template <class Q>
Gain measured(const TimedCases& cases, unsigned repeats) {
  Singles<Q> singles;
  adapters::CollideBatch<Q> batch;
  for (const auto& values : cases.values) {
    const Q q = inputs_from<Q>(values.data());
    singles.cases.emplace_back(q);
    batch.push_back(q);
  }
  singles.answers.resize(cases.size());
  const std::function<void()> passes[] = {[&] { singles.pass(); }, [&] { batch.answer(collide::Simd::sse2); },
                                          [&] { batch.answer(collide::Simd::avx2); }};
  std::vector<double> times[3], ratios[3];
  for (unsigned r = 0; r <= repeats; ++r) {
    double t[3];
    for (int way = 0; way < 3; ++way) t[way] = time_of(passes[way], cases.size());
    if (r == 0) continue;  // warms caches and predictors
    for (int way = 0; way < 3; ++way) times[way].push_back(t[way]), ratios[way].push_back(t[0] / t[way]);
  }
  return {median(times[0]), median(times[1]), median(times[2]), median(ratios[1]), median(ratios[2])};
}

using MeasuringFunction = Gain (*)(const TimedCases&, unsigned repeats);
struct Batched {
  const char* query;
  MeasuringFunction in_float, in_double;
};
#define NEARMISS_BATCHED(name) Batched{#name, measured<inputs::name<float>>, measured<inputs::name<double>>},
constexpr Batched batched[] = {NEARMISS_BATCH_QUERIES(NEARMISS_BATCHED)};
#undef NEARMISS_BATCHED

void print_head(unsigned repeats) {
  fmt::print(R"(# What batches gain

Written by `build/release/benchmarks/batch_gain`. Run the same command to update this page.

The [batch form](../explanation/numerics.md#batch-forms) of a query answers it for many arguments in one call. The tables have the
processor time of a query in ns: by single calls of `Fast` in a loop over an array of structs, and by a batch with SSE2 and
with AVX2 over structures of arrays. The bits of the answers are the same. × is the time of the single calls divided by
that of the batch. All ways answer the same {} plain cases of the generator in the same order and store the answers. Half
of the cases have the answer no where the query has a decision. The cases stay in the processor's caches. A figure is the
median of {} repeats, in each of which all ways run one after the other; so is a ratio. Single calls of `ray_aabox` get
prepared rays and boxes.

Processor: {}.
)",
             case_count(), repeats, processor());
}

void print_table(const char* scalar, const std::vector<std::pair<const char*, Gain>>& gains) {
  fmt::print("\n## {}\n\n| query | single | SSE2 | × | AVX2 | × |\n|---|---|---|---|---|---|\n", scalar);
  std::vector<double> sse2, avx2;
  for (const auto& [query, g] : gains) {
    fmt::print("| `{}` | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", query, g.single, g.sse2, g.ratio_sse2, g.avx2,
               g.ratio_avx2);
    sse2.push_back(g.ratio_sse2), avx2.push_back(g.ratio_avx2);
  }
  fmt::print("\nThe ratio in the median query is {:.1f} with SSE2 and {:.1f} with AVX2.\n", median(sse2), median(avx2));
}

int run(const std::vector<std::string>& names, unsigned repeats) {
  if (collide::widest_simd() != collide::Simd::avx2)
    std::cerr << "batch_gain: this machine has no AVX2: the figures are those of narrower instructions\n";
  print_head(repeats);
  std::vector<std::pair<const char*, Gain>> in_float, in_double;
  for (const Batched& b : batched) {
    if (!names.empty() && std::find(names.begin(), names.end(), b.query) == names.end()) continue;
    const TimedCases& cases = timed_cases_of(b.query);
    in_float.emplace_back(b.query, b.in_float(cases, repeats));
    in_double.emplace_back(b.query, b.in_double(cases, repeats));
  }
  print_table("float", in_float);
  print_table("double", in_double);
  return 0;
}

bool has_batch(const std::string& query) {
  return std::any_of(std::begin(batched), std::end(batched), [&](const Batched& b) { return query == b.query; });
}

}  // namespace
}  // namespace nearmiss::benchmarks

int main(int argc, char** argv) {
  using namespace nearmiss::benchmarks;
  std::vector<std::string> names;
  unsigned repeats = 31;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with("--cases=")) {
      const std::size_t cases = std::strtoull(argv[i] + 8, nullptr, 10);
      if (cases == 0) return std::cerr << "batch_gain: --cases must be a positive number\n", 2;
      set_case_count(cases);
    } else if (argument.starts_with("--repeats=")) {
      repeats = unsigned(std::strtoul(argv[i] + 10, nullptr, 10));
      if (repeats == 0) return std::cerr << "batch_gain: --repeats must be a positive number\n", 2;
    } else if (has_batch(argument)) {
      names.push_back(argument);
    } else {
      return std::cerr << "batch_gain: " << argument << " is no query with a batch form\n", 2;
    }
  }
  return run(names, repeats);
}
