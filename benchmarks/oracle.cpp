/// Times the judge on every query, with answers of collide's fast tier that are computed before. Google Benchmark's own
/// options apply; --cases=N sets the number of cases of each measurement.
///
///   QUERY/judge/SCALAR       plain cases: the decision, the contract and the proved backward bound
///   QUERY/wrong/SCALAR       the same, each answer off by a part in 4096, or else with the opposite decision
///   QUERY/forward/SCALAR     as judge, and the forward error to a tenth of an ulp
///   QUERY/degenerate/SCALAR  as judge, of the generator's cases that only the exact stage decides
///   QUERY/worst/SCALAR       everything in a report, for one case: the costliest of the degenerate cases, of raw
///   numbers
///                            and of far-scaled cases
///   QUERY/stages/SCALAR      as judge, for all cases that the generator draws
///
/// Counters: exact, the share of the cases that the exact stage decided; cases, their number.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "benchmarks/machine.hpp"
#include "corpus/generator/generator.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/exact/number_memory.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/judge.hpp"
#include "properties/judge/raw_numbers.hpp"

namespace nearmiss::benchmarks {

namespace {

std::size_t count = 1024;

struct Asked {
  Case question;
  Answer answer;
};

struct Pairing {
  const Query* query;
  Scalar scalar;
  const Offering* offering;

  Asked ask(Case c) const { return {c, offering->answer(c.values)}; }
  Finding judged(const Asked& a, Detail detail) const {
    return judge(a.question, a.answer, offering->contract, detail);
  }
};

bool decided_by_interval(const Case& c) {
  const std::vector<double> still(c.values.size(), 0.0);
  return oracle_of(*c.query).interval(c.values, still, Answer{}, c.scalar).decided();
}

std::vector<Asked> plain_cases(const Pairing& p) {
  std::vector<Asked> all;
  for (std::uint64_t i = 0; all.size() < count; ++i) {
    Case c = generate(*p.query, p.scalar, 2024, i);
    if (c.moves.empty()) all.push_back(p.ask(std::move(c)));
  }
  return all;
}

std::vector<Asked> all_sorts(const Pairing& p) {
  std::vector<Asked> all;
  for (std::uint64_t i = 0; i < count; ++i) all.push_back(p.ask(generate(*p.query, p.scalar, 2024, i)));
  return all;
}

/// The plain cases with wrong answers: each nonzero number is off by a part in 4096; without such a number the
/// decision is wrong.
std::vector<Asked> with_wrong_answers(const Pairing& p) {
  std::vector<Asked> all = plain_cases(p);
  for (Asked& a : all) {
    bool off = false;
    for (std::size_t i = 0; i < p.query->outputs.size(); ++i) {
      const Role role = p.query->outputs[i].role;
      if (role == Role::flag || role == Role::index || role == Role::normal || !std::isfinite(a.answer.values[i]))
        continue;
      off = off || a.answer.values[i] != 0;
      a.answer.values[i] *= 1 + 0x1p-12;
    }
    if (!off) a.answer.yes = !a.answer.yes;
  }
  return all;
}

/// At most count / 4 cases that the exact stage decides; fewer, or none, where they are rare. A case outside the domain
/// of the contract is judged without the exact stage, so it is not among them.
std::vector<Asked> degenerate(const Pairing& p) {
  std::vector<Asked> found;
  for (std::uint64_t i = 0; i < 64 * count && found.size() < std::max<std::size_t>(count / 4, 1); ++i) {
    Case c = generate(*p.query, p.scalar, 2025, i);
    if (decided_by_interval(c)) continue;
    Asked a = p.ask(std::move(c));
    if (p.judged(a, Detail::verdict).decided_by == Stage::exact) found.push_back(std::move(a));
  }
  return found;
}

double thread_cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

/// The costliest case. Its cost is the least of some repetitions, so that a load on the machine does not count.
Asked costliest(const Pairing& p) {
  std::vector<Asked> all = degenerate(p);
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(p.ask(raw_case(*p.query, p.scalar, i)));
    all.push_back(p.ask(far_scaled_case(*p.query, p.scalar, 2026, i)));
  }
  double most = -1;
  const Asked* worst = nullptr;
  for (const Asked& a : all) {
    double least = HUGE_VAL;
    for (int repetition = 0; repetition < 3 && least > most; ++repetition) {
      const double begin = thread_cpu_ms();
      benchmark::DoNotOptimize(p.judged(a, Detail::full));
      least = std::min(least, thread_cpu_ms() - begin);
    }
    if (least > most) most = least, worst = &a;
  }
  return *worst;
}

void set_counters(benchmark::State& state, const Pairing& p, const std::vector<Asked>& cases, Detail detail) {
  std::size_t exact = 0;
  for (const Asked& a : cases) exact += p.judged(a, detail).decided_by == Stage::exact;
  state.counters["exact"] = double(exact) / double(cases.size());
  state.counters["cases"] = double(cases.size());
  state.SetItemsProcessed(state.iterations());
}

void time_cases(benchmark::State& state, const Pairing& p, const std::vector<Asked>& cases, Detail detail) {
  if (cases.empty()) return state.SkipWithError("none of the generator's cases");
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(p.judged(cases[i], detail));
    if (++i == cases.size()) i = 0;
  }
  set_counters(state, p, cases, detail);
}

void register_benchmark(const Pairing& p, const char* way, void (*measure)(benchmark::State&, const Pairing&)) {
  const std::string name = std::string(p.query->name) + "/" + way + "/" + std::string(name_of(p.scalar));
  benchmark::RegisterBenchmark(name.c_str(), [p, measure](benchmark::State& s) { measure(s, p); });
}

void enter_all() {
  for (const Query& q : catalogue()) {
    for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
      const Subject* fast = find_subject("collide-fast-" + std::string(name_of(scalar)));
      const Pairing p{&q, scalar, &fast->offering(q.name)};
      register_benchmark(
          p, "judge", [](benchmark::State& s, const Pairing& x) { time_cases(s, x, plain_cases(x), Detail::verdict); });
      register_benchmark(p, "wrong", [](benchmark::State& s, const Pairing& x) {
        time_cases(s, x, with_wrong_answers(x), Detail::verdict);
      });
      register_benchmark(p, "forward", [](benchmark::State& s, const Pairing& x) {
        time_cases(s, x, plain_cases(x), Detail::forward);
      });
      register_benchmark(p, "degenerate", [](benchmark::State& s, const Pairing& x) {
        time_cases(s, x, degenerate(x), Detail::verdict);
      });
      register_benchmark(p, "worst",
                         [](benchmark::State& s, const Pairing& x) { time_cases(s, x, {costliest(x)}, Detail::full); });
      register_benchmark(
          p, "stages", [](benchmark::State& s, const Pairing& x) { time_cases(s, x, all_sorts(x), Detail::verdict); });
    }
  }
}

/// Removes --cases=N from the arguments; false where N is not positive.
bool take_case_count(int& argc, char** argv) {
  constexpr std::string_view option = "--cases=";
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (!argument.starts_with(option)) continue;
    count = std::strtoull(argv[i] + option.size(), nullptr, 10);
    std::copy(argv + i + 1, argv + argc, argv + i);
    --argc;
  }
  return count > 0;
}

}  // namespace

}  // namespace nearmiss::benchmarks

int main(int argc, char** argv) {
  using namespace nearmiss::benchmarks;
  if (!take_case_count(argc, argv)) {
    std::cerr << "--cases must be a positive number\n";
    return 2;
  }
  nearmiss::use_pool_for_numbers();  // as the command line does
  benchmark::AddCustomContext("flags", NEARMISS_BENCHMARK_FLAGS);
  benchmark::AddCustomContext("processor", processor());
  benchmark::AddCustomContext("cases", std::to_string(count));
  enter_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
