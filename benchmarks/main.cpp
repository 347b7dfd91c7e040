/// Times every contender on the cases of its query. Google Benchmark's own options apply; --cases=N, a power of two,
/// sets the number of cases for each query.
///
/// The time is that of one call in a sequence of calls, with the cases in random order. Counters: p50 and p99,
/// percentiles over the cases of the latency in ns of a single call that overlaps with no other; hits, the share of
/// cases with a yes; agree, the share of cases with the same decision as Fast in double; and for a tier with stages
/// the share that each stage answered.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <optional>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

#include "benchmarks/contender.hpp"
#include "benchmarks/machine.hpp"
#include "nearmiss/benchmark_entries.hpp"  // written by CMake: enter_all()

namespace nearmiss::benchmarks {

namespace {

using Clock = std::chrono::steady_clock;

double ns_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
}

/// A clock with a resolution of a few nanoseconds. On x86 it is the cycle counter between fences, so that no
/// instruction of the timed call moves across the reading.
std::uint64_t ticks() {
#if defined(__x86_64__)
  _mm_lfence();
  const std::uint64_t now = __rdtsc();
  _mm_lfence();
  return now;
#else
  return std::uint64_t(Clock::now().time_since_epoch().count());
#endif
}

double ns_per_tick() {
  static const double ratio = [] {
    constexpr double long_enough_ns = 2e7;
    const auto begin = Clock::now();
    const std::uint64_t first = ticks();
    while (ns_since(begin) < long_enough_ns) {
    }
    return ns_since(begin) / double(ticks() - first);
  }();
  return ratio;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// An empty call, which measures the overhead of the timing.
class NoQuestion final : public Contender {
  void prepare(const TimedCases&) override {}
  void pass(std::size_t) override {}
  void ask(std::size_t) override {}
  bool yes(std::size_t) override { return false; }
};

/// The latency of each case in ticks: the median of some passes in different orders, so that a load on the machine
/// during one pass does not count.
std::vector<double> costs_of_cases(Contender& contender, std::size_t cases) {
  constexpr std::size_t passes = 9;
  std::vector<std::vector<double>> costs(cases);
  for (std::size_t pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < cases; ++i) {
      const std::size_t index = case_in_pass(i, pass, cases);
      const std::uint64_t begin = ticks();
      contender.ask(index);
      costs[index].push_back(double(ticks() - begin));
    }
  }
  std::vector<double> medians;
  for (const auto& c : costs) medians.push_back(median(c));
  return medians;
}

struct Percentiles {
  double p50, p99, agree;
};

Percentiles percentiles(Contender& contender, const TimedCases& cases) {
  static NoQuestion nothing;
  Contender* volatile no_question = &nothing;  // the compiler must not inline the call
  const double overhead = median(costs_of_cases(*no_question, cases.size()));
  std::vector<double> costs = costs_of_cases(contender, cases.size());
  std::sort(costs.begin(), costs.end());
  const auto ns = [&](std::size_t i) { return std::max(0.0, costs[i] - overhead) * ns_per_tick(); };
  std::size_t agree = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) agree += contender.yes(i) == cases.yes[i];
  return {ns(costs.size() / 2), ns(costs.size() * 99 / 100), double(agree) / double(cases.size())};
}

/// A benchmark. Keeps its percentiles, because Google Benchmark calls run() several times for one result.
struct Entry {
  std::string query;
  std::unique_ptr<Contender> contender;
  std::optional<Percentiles> measured;

  void run(benchmark::State& state) {
    const TimedCases& cases = timed_cases_of(query);
    contender->prepare(cases);
    if (!measured) measured = percentiles(*contender, cases);
    const auto calls = benchmark::IterationCount(cases.size());
    for (std::size_t pass = 0; state.KeepRunningBatch(calls); ++pass) contender->pass(pass);
    state.counters["p50"] = measured->p50;
    state.counters["p99"] = measured->p99;
    state.counters["hits"] = cases.share_of_yes();
    state.counters["agree"] = measured->agree;
    for (const auto& [stage, share] : contender->stages()) state.counters[stage] = share;
    contender->prepare({});  // frees the memory
  }
};

std::vector<std::unique_ptr<Entry>>& entries() {
  static std::vector<std::unique_ptr<Entry>> all;
  return all;
}

/// Removes --cases=N from the arguments; false where N is not a power of two.
bool take_case_count(int& argc, char** argv) {
  constexpr std::string_view option = "--cases=";
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (!argument.starts_with(option)) continue;
    const std::size_t count = std::strtoull(argv[i] + option.size(), nullptr, 10);
    if (!std::has_single_bit(count)) return false;
    set_case_count(count);
    std::copy(argv + i + 1, argv + argc, argv + i);
    --argc;
    return true;
  }
  return true;
}

}  // namespace

void add_context(const std::string& what, const std::string& value) { benchmark::AddCustomContext(what, value); }

void register_contender(std::string query, std::string library, std::string way, std::unique_ptr<Contender> contender) {
  const std::string name = query + "/" + library + "/" + way + "/" NEARMISS_SCALAR_NAME;
  entries().push_back(std::make_unique<Entry>(Entry{std::move(query), std::move(contender), {}}));
  benchmark::RegisterBenchmark(name.c_str(), [entry = entries().back().get()](benchmark::State& s) { entry->run(s); });
}

}  // namespace nearmiss::benchmarks

int main(int argc, char** argv) {
  if (!nearmiss::benchmarks::take_case_count(argc, argv)) {
    std::cerr << "--cases must be a power of two\n";
    return 2;
  }
  nearmiss::benchmarks::add_context("flags", NEARMISS_BENCHMARK_FLAGS);
  nearmiss::benchmarks::add_context("processor", nearmiss::benchmarks::processor());
  nearmiss::benchmarks::add_context("cases", std::to_string(nearmiss::benchmarks::case_count()));
  nearmiss::benchmarks::enter_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
