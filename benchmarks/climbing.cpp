/// Measures how much worse the errors are that climbing finds than those of random sampling in the same time; writes
/// docs/measured/climbing.md to standard output.
///
///   climbing_gain [--frame] [--seconds=S] [--seeds=N] [--subject=NAME ...] [QUERY ...]
///
/// Each pair climbs and samples with the same seed, for S seconds for each kind of error, in alternating order; both
/// ask and judge alike, and neither knows the stored worst cases. --frame measures nothing and prints the page with a
/// dash in place of each figure.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "benchmarks/machine.hpp"
#include "impl/host/hosts.hpp"
#include "reports/engine/climber.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

struct Options {
  bool frame = false;
  double seconds = 5;
  int seeds = 5;
  std::vector<std::string> subjects{};
  std::vector<const Query*> queries{};
  std::string command_line = "build/release/benchmarks/climbing_gain";
};

/// Connects a campaign with a climber, which is made later.
struct Forward : Sink {
  Climber* to = nullptr;
  void take(const Examined& e) override { to->take(e); }
};

/// The worst errors that one search proved, by kind; 0: none.
struct Worst {
  double of[2] = {0, 0};
};

Worst search(const Query& query, const Subject& subject, std::uint64_t seed, double seconds, Climb::Source source) {
  Climber climber({{&query}, {&subject}, seed, {}, source, false});
  Forward sink;
  sink.to = &climber;
  Campaign campaign({std::filesystem::temp_directory_path(), [] {}}, {&sink});
  const auto time = std::chrono::duration<double>(seconds * double(climber.climbs().size()));
  campaign.set_until(Campaign::Clock::now() + std::chrono::duration_cast<Campaign::Clock::duration>(time));
  climber.run(campaign, [](const Climb&) {});
  Worst worst;
  for (const Climb& c : climber.climbs()) {
    if (c.record()) worst.of[int(c.kind())] = c.record()->error;
  }
  return worst;
}

double median(std::vector<double> all) {
  std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
  return all[all.size() / 2];
}

std::string figure(double x) { return x == 0 ? "-" : fmt::format("{:.3g}", x); }

struct Pairs {
  std::vector<Worst> sampled, climbed;

  std::vector<double> of(const std::vector<Worst>& side, ErrorKind kind) const {
    std::vector<double> all;
    for (const Worst& w : side) all.push_back(w.of[int(kind)]);
    return all;
  }
  /// "1.5 | 3 | 2.0 | 5 of 5": the medians, their ratio, and in how many pairs climbing found the larger error.
  std::string cells(ErrorKind kind) const {
    const std::vector<double> a = of(sampled, kind), b = of(climbed, kind);
    std::size_t larger = 0;
    for (std::size_t i = 0; i < a.size(); ++i) larger += b[i] > a[i];
    const double of_a = median(a), of_b = median(b);
    return fmt::format("{} | {} | {} | {} of {}", figure(of_a), figure(of_b),
                       of_a > 0 && of_b > 0 ? fmt::format("{:.2f}", of_b / of_a) : "-", larger, a.size());
  }
};

Pairs measured(const Query& query, const Subject& subject, const Options& options) {
  Pairs pairs;
  for (int seed = 1; seed <= options.seeds; ++seed) {
    Worst sampled, climbed;
    for (const bool first : {true, false}) {
      const bool climbs = first == (seed % 2 == 0);
      (climbs ? climbed : sampled) = search(query, subject, std::uint64_t(seed), options.seconds,
                                            climbs ? Climb::Source::neighbours : Climb::Source::generator);
    }
    pairs.sampled.push_back(sampled);
    pairs.climbed.push_back(climbed);
  }
  return pairs;
}

void print_head(const Options& options) {
  fmt::print(R"(# How much climbing adds to random sampling

Written by this command; run it again to update this page:

```sh
{}
```

`nearmiss run --climb` moves from bad cases to worse ones ([searches](../searches.md#worst-cases)). Here it is compared with
the generator's cases alone: the same query, subject and seed, {:g} seconds for each kind of error, the same hosts and
judge, without the stored worst cases. Figures are medians of {} pairs: the largest proved error of a search, in ulps
(forward) or epsilon (backward), a sampled lower bound; `-` means that nothing was proved. The last column counts the pairs in
which climbing found the larger error.

A forward error of 2^24 ulps of float is one of the size of the number itself. Badly conditioned queries reach it in both ways.

Processor: {}.

| query | subject | error | sampled | climbed | ratio | climbing ahead |
|---|---|---|--:|--:|--:|--:|
)",
             options.command_line, options.seconds, options.seeds, benchmarks::processor());
}

void print_rows(const Options& options, const std::vector<Subject>& hosted) {
  for (const Query* q : options.queries) {
    for (const Subject& s : hosted) {
      if (s.offering(q->name).answer == nullptr) continue;
      const Pairs pairs = options.frame ? Pairs{} : measured(*q, s, options);
      for (const ErrorKind kind : error_kinds) {
        if (kind == ErrorKind::forward && q->outputs.empty()) continue;
        fmt::print("| `{}` | {} | {} | {} |\n", q->name, s.name, name_of(kind),
                   options.frame ? "- | - | - | -" : pairs.cells(kind));
        std::fflush(stdout);
      }
    }
  }
}

int complain(const std::string& what) {
  std::cerr << "climbing_gain: " << what << '\n';
  return 2;
}

int run(Options options) {
  if (options.queries.empty()) {
    for (const Query& q : catalogue()) options.queries.push_back(&q);
  }
  if (options.subjects.empty()) options.subjects = {"collide-fast-float", "collide-fast-double"};
  std::vector<HostOfBuild> files;
  for (const std::string& name : options.subjects) {
    if (find_subject(name) == nullptr) return complain(name + " is no subject of this build");
    files.push_back({name, NEARMISS_HOSTS "/" + name});
  }
  print_head(options);
  print_rows(options, hosted(files));
  return 0;
}

}  // namespace

}  // namespace nearmiss

int main(int argc, char** argv) {
  using namespace nearmiss;
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--frame") {
      options.frame = true;
      continue;
    }
    options.command_line += fmt::format(" {}", shell_quoted(argument));
    if (argument.starts_with("--seconds=")) {
      options.seconds = std::atof(argv[i] + 10);
      if (!(options.seconds > 0)) return complain("--seconds must be a positive number");
    } else if (argument.starts_with("--seeds=")) {
      options.seeds = std::atoi(argv[i] + 8);
      if (options.seeds <= 0) return complain("--seeds must be a positive number");
    } else if (argument.starts_with("--subject=")) {
      options.subjects.push_back(argument.substr(10));
    } else if (find_query(argument) != nullptr) {
      options.queries.push_back(find_query(argument));
    } else {
      return complain(argument + " is no query of the catalogue");
    }
  }
  options.command_line += " > docs/measured/climbing.md";
  try {
    return run(options);
  } catch (const BadSubject& e) {
    return complain(e.what());
  }
}
