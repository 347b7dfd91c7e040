/// Measures the cost of isolation; writes docs/measured/isolation.md to standard output.
///
///   isolation_cost [--frame] [--pairs=N] [--subject=NAME] [--command=COMMAND ...] [QUERY ...]
///
/// Times the same work alternately with the subject in its host and in this process, and prints the medians of the
/// ratios of processor time (of both processes) and of wall time; then the cost of a case for each COMMAND, a program
/// over pipes (docs/reference/protocol.md). Exit code 1 where isolation costs a run more than 20 % of processor time;
/// wall time also depends on the load of the machine. --frame measures nothing and prints the page with a dash in place
/// of each figure.
#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>

#include "benchmarks/machine.hpp"
#include "corpus/generator/generator.hpp"
#include "impl/host/hosts.hpp"
#include "oracles/judge.hpp"
#include "reports/engine/tally.hpp"
#include "reports/findings/text.hpp"
#include "reports/findings/workers.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t batch_size = Workers::batch, batches = 16;
constexpr double most_cost = 1.2;

/// The processor time and the wall time of some work, in seconds.
struct Spent {
  double processor = 0, wall = 0;
};

double seconds_of(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// The work of a run on one query and subject.
class Measured {
 public:
  /// `here` and `hosted` are the same subject, with its functions in this process and in a host.
  Measured(const Query& query, const Subject& here, const Subject& hosted, Workers& workers)
      : query_(query),
        subject_(hosted),
        offering_(here.offering(query.name)),
        workers_(workers),
        tally_{&query, &hosted} {
    cases_.resize(batch_size);
    next_.resize(batch_size);
    generate_batch(0, cases_);
    workers_.ask(subject_, cases_.front());  // starts the process
    direct_.resize(batch_size);
  }

  /// Generating, asking and judging the same cases, in the order in which a run does.
  Spent run(bool isolated) {
    return measured([&] {
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
  /// Only asks.
  Spent ask(bool isolated) {
    generate_batch(0, cases_);
    return measured([&] {
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
  Spent spent() const {
    return {seconds_of(CLOCK_PROCESS_CPUTIME_ID) + workers_.processor_seconds(subject_), seconds_of(CLOCK_MONOTONIC)};
  }
  Spent measured(const auto& work) const {
    const Spent before = spent();
    work();
    const Spent after = spent();
    return {after.processor - before.processor, after.wall - before.wall};
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
  Workers& workers_;
  Tally tally_;
  std::vector<Case> cases_, next_;
  std::vector<Answer> direct_;
};

double median(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

/// The ratios of the costs of the same work with and without isolation, and its processor time without isolation.
struct Cost {
  std::vector<double> processor_ratios, wall_ratios, seconds;

  /// Does the work both ways. Either way is first in every other pair.
  void add_pair(int number, const auto& work) {
    const bool isolated_first = number % 2 == 0;
    const Spent first = work(isolated_first), second = work(!isolated_first);
    const Spent isolated = isolated_first ? first : second, here = isolated_first ? second : first;
    processor_ratios.push_back(isolated.processor / here.processor);
    wall_ratios.push_back(isolated.wall / here.wall);
    seconds.push_back(here.processor);
  }
  double processor() const { return median(processor_ratios); }
  double wall() const { return median(wall_ratios); }
  /// Nanoseconds of processor time for a case without isolation.
  double nanoseconds() const { return 1e9 * median(seconds) / double(batches * batch_size); }
};

struct Costs {
  const Query* query;
  Cost run, ask;
};

std::string percent(double ratio) { return fmt::format("{:+.0f} %", 100 * (ratio - 1)); }

/// The load average of the last minute.
std::string load() {
  std::string one_minute;
  std::ifstream("/proc/loadavg") >> one_minute;
  return one_minute;
}

/// Prints the cost of a case for a program over pipes: medians of the processor time of both processes and of wall
/// time. Without rounds dashes take the place of the figures.
void measure_program(const Subject& program, int rounds) {
  Workers workers;
  const char* batch_format = program.host->batches == HostProgram::Batches::json ? "JSON" : "binary";
  for (const Offering& o : program.offerings) {
    if (o.answer == nullptr) continue;
    if (rounds == 0) {
      fmt::print("| `{}` | {} | `{}` | - | - |\n", program.name, batch_format, o.query);
      continue;
    }
    Measured measured(*find_query(o.query), program, program, workers);
    std::vector<double> processor, wall;
    measured.ask(true);  // a program gets small requests at first
    for (int i = 0; i < rounds; ++i) {
      const Spent spent = measured.ask(true);
      processor.push_back(spent.processor);
      wall.push_back(spent.wall);
    }
    const double cases = double(batches * batch_size);
    fmt::print("| `{}` | {} | `{}` | {:.0f} | {:.0f} |\n", program.name, batch_format, o.query,
               1e9 * median(processor) / cases, 1e9 * median(wall) / cases);
  }
}

/// Prints the table of queries. Without pairs dashes take the place of the figures. Returns the exit code.
int measure(const std::vector<const Query*>& queries, const Subject& subject, const Subject& hosted, int pairs,
            const std::string& command_line) {
  Workers workers;
  std::vector<Costs> all;
  for (const Query* q : queries) {
    if (subject.offering(q->name).answer != nullptr) all.push_back({q, {}, {}});
  }
  // Measures round by round, so that a load of some seconds is spread over all queries.
  for (int round = 0; round < pairs; ++round) {
    for (Costs& c : all) {
      Measured measured(*c.query, subject, hosted, workers);
      c.run.add_pair(round, [&](bool isolated) { return measured.run(isolated); });
      c.ask.add_pair(round, [&](bool isolated) { return measured.ask(isolated); });
    }
  }
  fmt::print(R"(# What isolation costs

Written by this command; run it again to update this page:

```sh
{}
```

Every subject runs in a process of its own, its host, so that a crash or an endless loop costs one case and not the run. Here
`{}` answers the same cases in its host and in the caller's process, in {} alternating rounds of {} batches
of {} cases. A *run* generates, asks and judges like `nearmiss run`, which makes the next cases while the subject works.
*Asking* is that part alone: it shows what the transfer of a case and its answer adds to a call of some nanoseconds.
Times are medians of the processor time for one case without isolation. Costs are medians of the ratios of processor
time (of both processes together) and of wall time. A run may take at most {} more processor time. Wall time includes the
time for which a process waits for a processor on a shared machine: this one, with {} cores, had a load of {}.

{}, one subject.

| query | run, ns | processor | wall | asking, ns | processor | wall |
|---|--:|--:|--:|--:|--:|--:|
)",
             command_line, subject.name, pairs, batches, batch_size, percent(most_cost).substr(1),
             std::thread::hardware_concurrency(), load(), benchmarks::processor());
  double worst = 0;
  for (const Costs& c : all) {
    if (pairs == 0) {
      fmt::print("| `{}` | - | - | - | - | - | - |\n", c.query->name);
      continue;
    }
    fmt::print("| `{}` | {:.0f} | {} | {} | {:.0f} | {} | {} |\n", c.query->name, c.run.nanoseconds(),
               percent(c.run.processor()), percent(c.run.wall()), c.ask.nanoseconds(), percent(c.ask.processor()),
               percent(c.ask.wall()));
    worst = std::max(worst, c.run.processor());
  }
  fmt::print("\nThe largest cost of a run is {} of processor time.\n", percent(worst));
  return worst <= most_cost ? 0 : 1;
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
  std::vector<std::string> commands;
  std::string name = "collide-fast-float", command_line = "build/release/benchmarks/isolation_cost";
  int pairs = 31;
  bool frame = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--frame") {
      frame = true;
      continue;
    }
    command_line += fmt::format(" {}", shell_quoted(argument));
    if (argument.starts_with("--pairs=")) {
      pairs = std::atoi(argv[i] + 8);
      if (pairs <= 0) return complain("--pairs must be a positive number");
    } else if (argument.starts_with("--subject=")) {
      name = argument.substr(10);
    } else if (argument.starts_with("--command=")) {
      commands.push_back(argument.substr(10));
    } else if (find_query(argument) != nullptr) {
      queries.push_back(find_query(argument));
    } else {
      return complain(argument + " is no query of the catalogue");
    }
  }
  command_line += " > docs/measured/isolation.md";
  if (frame) pairs = 0;
  if (queries.empty()) {
    for (const Query& q : catalogue()) queries.push_back(&q);
  }
  try {
    const Subject* subject = find_subject(name);
    if (subject == nullptr) return complain(name + " is no subject of this build");
    const std::vector<Subject> hosted = nearmiss::hosted({{name, NEARMISS_HOSTS "/" + name}});
    const int code = measure(queries, *subject, hosted.front(), pairs, command_line);
    if (commands.empty()) return code;
    fmt::print(R"(
## Programs over pipes

The cost of a case that is sent to any other program ([protocol.md](../reference/protocol.md)). The programs compute almost nothing, so the
figures are the cost of the pipes: medians of {} rounds of {} batches of {} cases, in nanoseconds of processor time of both
processes and of wall time.

| program | batches | query | processor, ns | wall, ns |
|---|---|---|--:|--:|
)",
               pairs, batches, batch_size);
    for (const std::string& command : commands) load_command(command);
    for (const Subject& s : subjects()) {
      if (!s.command.empty()) measure_program(s, pairs);
    }
    return code;
  } catch (const BadSubject& e) {
    return complain(e.what());
  }
}
