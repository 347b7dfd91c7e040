/// What isolation costs: writes docs/isolation.md to standard output.
///
///   isolation_cost [--pairs=N] [--subject=NAME] [QUERY ...]
///
/// Times the same work with the subject in a worker process and in this one, in turns, and tells the median of the
/// ratios of wall time. Exit code 1 where a run costs more than 20 % more.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "benchmarks/machine.hpp"
#include "corpus/generator.hpp"
#include "oracles/judge.hpp"
#include "reports/tally.hpp"
#include "reports/workers.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t batch_size = 512, batches = 16;  // as a run has them
constexpr double most_cost = 1.2;

/// The work of a run on one query and subject.
class Measured {
 public:
  Measured(const Query& query, const Subject& subject)
      : query_(query), subject_(subject), offering_(subject.offering(query.name)), tally_{&query, &subject} {
    cases_.resize(batch_size);
    next_.resize(batch_size);
    direct_.resize(batch_size);
  }

  /// Seconds for generating, asking and judging the same cases, in the order in which a run does.
  double run(bool isolated) {
    return seconds([&] {
      generate_batch(0, cases_);
      for (std::size_t b = 0; b < batches; ++b) {
        if (isolated) workers_.send(subject_, cases_);
        if (b + 1 < batches) generate_batch(b + 1, next_);
        const std::span<const Answer> answers = isolated ? workers_.receive(subject_) : ask_here();
        for (std::size_t i = 0; i < batch_size; ++i) {
          tally_.count(judge(cases_[i], answers[i], offering_.contract, Detail::verdict));
        }
        std::swap(cases_, next_);
      }
    });
  }
  /// Seconds for asking alone.
  double ask(bool isolated) {
    generate_batch(0, cases_);
    return seconds([&] {
      for (std::size_t b = 0; b < batches; ++b) {
        if (isolated) {
          workers_.send(subject_, cases_);
          workers_.receive(subject_);
        } else {
          ask_here();
        }
      }
    });
  }

 private:
  static double seconds(const auto& work) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    work();
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }
  void generate_batch(std::size_t number, std::vector<Case>& into) {
    for (std::size_t i = 0; i < batch_size; ++i) {
      generate(into[i], query_, subject_.scalar, 2026, number * batch_size + i);
    }
  }
  std::span<const Answer> ask_here() {
    for (std::size_t i = 0; i < batch_size; ++i) direct_[i] = offering_.answer(cases_[i].values);
    return direct_;
  }

  const Query& query_;
  const Subject& subject_;
  const Offering& offering_;
  Tally tally_;
  Workers workers_;
  std::vector<Case> cases_, next_;
  std::vector<Answer> direct_;
};

double median(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

struct Cost {
  double ratio = 0;        ///< isolated over not isolated, median over the pairs
  double nanoseconds = 0;  ///< of a case without isolation, median
};

/// Pairs of the same work, each kind first in every other pair.
template <class Work>
Cost cost_of(int pairs, const Work& work) {
  work(true);
  work(false);
  std::vector<double> ratios, seconds;
  for (int p = 0; p < pairs; ++p) {
    const double first = work(p % 2 == 0), second = work(p % 2 != 0);
    const double isolated = p % 2 == 0 ? first : second, here = p % 2 == 0 ? second : first;
    ratios.push_back(isolated / here);
    seconds.push_back(here);
  }
  return {median(ratios), 1e9 * median(seconds) / double(batches * batch_size)};
}

std::string percent(double ratio) { return fmt::format("{:+.0f} %", 100 * (ratio - 1)); }

int measure(const std::vector<const Query*>& queries, const Subject& subject, int pairs) {
  fmt::print(R"(# What isolation costs

Written by `build/release/benchmarks/isolation_cost > docs/isolation.md`; the same command makes it anew.

Every subject is asked in a process of its own, so that a crash or an endless loop costs one case and not the run. Here
`{}` gets the same cases in a process of its own and in the caller's, {} times each in turns, {} batches of {}
cases. A *run* generates, asks and judges, as `nearmiss run` does: it makes the next cases while the subject answers. *Asking* is that part of it alone: what handing a case
over and back adds to an answer of some nanoseconds. Times are medians of wall time for one case without isolation,
and costs the medians of the ratios. A run may cost at most {} more; with several cores and subjects it costs less, since
their processes answer side by side.

{}, {} cores, one subject.

| query | run, ns | isolation | asking, ns | isolation |
|---|--:|--:|--:|--:|
)", subject.name, pairs, batches, batch_size, percent(most_cost).substr(1), benchmarks::processor(),
             std::thread::hardware_concurrency());
  bool good = true;
  double worst = 0;
  for (const Query* q : queries) {
    if (subject.offering(q->name).answer == nullptr) continue;
    Measured measured(*q, subject);
    const Cost run = cost_of(pairs, [&](bool isolated) { return measured.run(isolated); });
    const Cost ask = cost_of(pairs, [&](bool isolated) { return measured.ask(isolated); });
    fmt::print("| `{}` | {:.0f} | {} | {:.0f} | {} |\n", q->name, run.nanoseconds, percent(run.ratio), ask.nanoseconds,
               percent(ask.ratio));
    std::fflush(stdout);
    worst = std::max(worst, run.ratio);
    good = good && run.ratio <= most_cost;
  }
  fmt::print("\nThe largest cost of a run is {}.\n", percent(worst));
  return good ? 0 : 1;
}

int complain(const std::string& what) {
  std::cerr << "isolation_cost: " << what << '\n';
  return 2;
}

}  // namespace

}  // namespace nearmiss

int main(int argc, char** argv) {
  using namespace nearmiss;
  std::vector<const Query*> queries;
  const Subject* subject = find_subject("collide-fast-float");
  int pairs = 61;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with("--pairs=")) {
      pairs = std::atoi(argv[i] + 8);
      if (pairs <= 0) return complain("--pairs must be a positive number");
    } else if (argument.starts_with("--subject=")) {
      subject = find_subject(argument.substr(10));
      if (subject == nullptr) return complain(argument.substr(10) + " is no subject of this build");
    } else if (find_query(argument) != nullptr) {
      queries.push_back(find_query(argument));
    } else {
      return complain(argument + " is no query of the catalogue");
    }
  }
  if (queries.empty()) {
    for (const Query& q : catalogue()) queries.push_back(&q);
  }
  return measure(queries, *subject, pairs);
}
