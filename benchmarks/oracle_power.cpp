/// How wide the oracle's enclosures are, and which lies the judge tells: writes docs/oracle-power.md to standard
/// output.
///
///   oracle_power [--cases=N] [--lies=N] [QUERY ...]
///
/// Of each plain scene the inputs are widened by 2^24 epsilon of double. The enclosure's width is compared with
/// that of the hull of the exact answers to inputs within: random ones and, for each number of the answer, the two
/// corners to which its slopes point. Then lies are told about --lies cases of each family. Exit code 1 where a query's
/// median is above four times, or where fewer than 99.9 % of a family's lies are told.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "corpus/families.hpp"
#include "corpus/lies.hpp"
#include "corpus/width_ratios.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

constexpr double most_median = 4;
constexpr double least_detected = 0.999;

/// A ratio as the page shows it.
std::string shown(double ratio) { return ratio < 1e6 ? fmt::format("{:.3g}", ratio) : "above 10⁶"; }

// Lies.

struct Detected {
  std::uint64_t lies = 0, detected = 0;

  void add(bool is_refuted) { ++lies, detected += is_refuted; }
  void add(const Detected& t) { lies += t.lies, detected += t.detected; }
  bool enough() const { return double(lies - detected) <= (1 - least_detected) * double(lies); }
  /// Never rounded up to all of them.
  std::string share() const {
    if (lies == 0) return "";
    return detected == lies ? "all" : fmt::format("{:.2f} %", std::floor(1e4 * double(detected) / double(lies)) / 100);
  }
};

/// By family.
using DetectedOf = std::array<Detected, std::size(families)>;

DetectedOf lies_detected(const Query& query, std::uint64_t cases, std::array<Detected, topic_count>& by_topic) {
  DetectedOf all;
  for (const Family family : families) {
    for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
      for (const double bound : bounds_for_lies(query, scalar)) {
        for (std::uint64_t i = 0; i < cases; ++i) {
          const Case c = case_of(family, query, scalar, 2028, i);
          for (const Lie& lie : lies_about(c, widening_of_lies(c, bound), i)) {
            const bool refuted = is_refuted(c, lie, bound);
            all[std::size_t(family)].add(refuted);
            by_topic[std::size_t(lie.topic)].add(refuted);
          }
        }
      }
    }
  }
  return all;
}

/// True where enough are told everywhere.
bool print_lies(std::span<const Query* const> queries, std::uint64_t cases) {
  fmt::print(R"(
## Which lies are told

An answer can also be too wide to be wrong: a bound that divides by the length of a short edge may be no bound. So the judge
is given answers that are wrong by construction: plain bounds (`corpus/lies.cpp`), which share nothing with the oracle,
prove that no input within 2^10 times the bound on the backward error has such an answer. The bounds are what `Fast` promises,
in both scalars, and 2^30 ε of double. A lie is about the decision alone, or about one number or one point. Of each family
{} cases are drawn for each scalar and bound; the table has the share of lies that the judge proves to be further off than the
bound. `tiny`, `thin` and `degenerate` are scenes of which some things are small, nearly flat, or flat and concentric;
`huge` and `minute` have lengths of 2^500 to 2^1018 and of 2^-500 to 2^-1060 (float: 2^60 to 2^122, 2^-60 to 2^-140).

| query | lies |)",
             cases);
  for (const Family f : families) fmt::print(" {} |", name_of(f));
  fmt::print("\n|---|---|");
  for (std::size_t i = 0; i < std::size(families); ++i) fmt::print("---|");
  fmt::print("\n");
  std::array<Detected, topic_count> by_topic;
  Detected every;
  std::string few;
  for (const Query* q : queries) {
    const DetectedOf detected = lies_detected(*q, cases, by_topic);
    Detected sum;
    for (const Detected& t : detected) sum.add(t);
    every.add(sum);
    fmt::print("| `{}` | {} |", q->name, sum.lies);
    for (const Family f : families) {
      const Detected& t = detected[std::size_t(f)];
      fmt::print(" {} |", t.share());
      if (!t.enough()) few += fmt::format("{}`{}` {}", few.empty() ? "" : ", ", q->name, name_of(f));
    }
    fmt::print("\n");
  }
  fmt::print("\nOf {} lies {} are told", every.lies, every.detected);
  for (int i = 0; i < topic_count; ++i) {
    const Detected& t = by_topic[std::size_t(i)];
    fmt::print("{} {} of {} about a {}", i == 0 ? ":" : ",", t.detected, t.lies, name_of(Topic(i)));
  }
  fmt::print(". Fewer than {} % of them: {}.\n", 100 * least_detected, few.empty() ? "nowhere" : few);
  return few.empty();
}

int run(const std::vector<std::string>& names, std::uint64_t scenes, std::uint64_t cases_with_lies) {
  fmt::print(R"(# How tight the oracle's enclosures are

Written by `build/release/benchmarks/oracle_power`; the same command makes it anew.

An enclosure that is too wide excuses errors. The inputs of {} plain scenes of each query are widened by 2^24 ε of
double. The width of the enclosure is compared with that of the hull of exact answers to inputs within the widening:
random ones and, for each number of the answer, the two corners to which its slopes point. A vector counts by its widest
number. Scenes whose decision is not the same throughout are left out; so are answers that are decisions, flags and
indices alone.

| query | part | median | 90 % | 99 % |
|---|---|---|---|---|
)",
             scenes);
  bool good = true;
  std::string wide;
  double widest = 0;
  for (const Query& q : catalogue()) {
    if (!names.empty() && std::find(names.begin(), names.end(), q.name) == names.end()) continue;
    WidthRatios every{"", {}};
    for (WidthRatios& r : width_ratios(q, scenes)) {
      if (r.all.empty()) continue;
      every.all.insert(every.all.end(), r.all.begin(), r.all.end());
      if (r.at(0.5) > most_median) wide += fmt::format("{}`{}` {}", wide.empty() ? "" : ", ", q.name, r.part);
      fmt::print("| `{}` | {} | {} | {} | {} |\n", q.name, r.part, shown(r.at(0.5)), shown(r.at(0.9)),
                 shown(r.at(0.99)));
    }
    if (every.all.empty()) continue;
    widest = std::max(widest, every.at(0.5));
    good = good && every.at(0.5) <= most_median;
  }
  fmt::print("\nThe largest median of a query, over all its numbers, is {}; parts with a median above {}: {}.\n",
             shown(widest), most_median, wide.empty() ? "none" : wide);
  std::vector<const Query*> with_lies;
  for (const Query& q : catalogue()) {
    const bool chosen = names.empty() || std::find(names.begin(), names.end(), q.name) != names.end();
    if (chosen && has_lies(q)) with_lies.push_back(&q);
  }
  return print_lies(with_lies, cases_with_lies) && good ? 0 : 1;
}

}  // namespace

}  // namespace nearmiss

int main(int argc, char** argv) {
  std::vector<std::string> names;
  std::uint64_t scenes = 400, lies = 1000;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with("--cases=")) {
      scenes = std::strtoull(argv[i] + 8, nullptr, 10);
      if (scenes == 0) return std::cerr << "oracle_power: --cases must be a positive number\n", 2;
    } else if (argument.starts_with("--lies=")) {
      lies = std::strtoull(argv[i] + 7, nullptr, 10);
      if (lies == 0) return std::cerr << "oracle_power: --lies must be a positive number\n", 2;
    } else if (nearmiss::find_query(argument) != nullptr) {
      names.push_back(argument);
    } else {
      return std::cerr << "oracle_power: " << argument << " is no query of the catalogue\n", 2;
    }
  }
  return nearmiss::run(names, scenes, lies);
}
