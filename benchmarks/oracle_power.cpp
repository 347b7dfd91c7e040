/// Measures how wide the oracle's enclosures are, and which wrong answers the judge detects; writes
/// docs/measured/oracle-power.md to standard output.
///
///   oracle_power [--cases=N] [--lies=N] [QUERY ...]
///
/// The program widens the inputs of plain cases by 2^24 epsilon of double. It compares the width of the enclosure with
/// that of the hull of exact answers to inputs within the widening: random ones and, for each number of the answer, the
/// two corners in the directions of its slopes. Then the judge gets lies about --lies cases of each family. Exit code 1
/// where the median of a query is above four, or where fewer than 99.9 % of a family's lies are detected.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "oracles/judge.hpp"
#include "properties/judge/families.hpp"
#include "properties/judge/lies.hpp"
#include "properties/judge/width_ratios.hpp"

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
  /// The share in percent, never rounded up to all.
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

/// Prints the second section. True where enough lies of every family are detected.
bool print_lies(std::span<const Query* const> queries, std::uint64_t cases) {
  fmt::print(R"(
## Which wrong answers are detected

An enclosure can also be so wide that it excludes no answer, for example where it divides by the length of a short edge. So
the judge gets *lies*, answers that are wrong by construction: elementary bounds (`properties/judge/lies.cpp`), which share nothing with
the oracle, prove that no input within 2^10 times the bound on the backward error has such an answer. The bounds on the
backward error are the promises of `Fast` in both scalars, and 2^30 ε of double. A lie is wrong in the decision alone, in one
number or in one point. Of each family {} cases are drawn for each scalar and bound; the table has the share of lies that the
judge proves to be further off than the bound. In the cases of `tiny`, `thin` and `degenerate` some bodies are small, nearly
flat, or flat and concentric; `huge` and `minute` have lengths of 2^500 to 2^1018 and of 2^-500 to 2^-1060 (float: 2^60 to
2^122, 2^-60 to 2^-140).

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
  fmt::print("\nOf {} lies {} are detected", every.lies, every.detected);
  for (int i = 0; i < topic_count; ++i) {
    const Detected& t = by_topic[std::size_t(i)];
    fmt::print("{} {} of {} about a {}", i == 0 ? ":" : ",", t.detected, t.lies, name_of(Topic(i)));
  }
  fmt::print(". Families with fewer than {} % detected: {}.\n", 100 * least_detected, few.empty() ? "none" : few);
  return few.empty();
}

int run(const std::vector<std::string>& names, std::uint64_t cases, std::uint64_t cases_with_lies) {
  fmt::print(R"(# How tight the oracle's enclosures are

Written by `build/release/benchmarks/oracle_power`. Run the same command to update this page.

An enclosure that is too wide excuses errors. For each query the inputs of {} plain cases are widened by 2^24 ε of
double. The table has the ratio of the width of the enclosure to the width of the hull of exact answers to inputs within
the widening: random inputs and, for each number of the answer, the two corners in the directions of its slopes. The ratio
of a vector is that of its widest number. Cases whose decision changes within the widening are left out, and so are
answers that consist of decisions, flags and indices only.

| query | part | median | 90 % | 99 % |
|---|---|---|---|---|
)",
             cases);
  bool good = true;
  std::string wide;
  double widest = 0;
  for (const Query& q : catalogue()) {
    if (!names.empty() && std::find(names.begin(), names.end(), q.name) == names.end()) continue;
    WidthRatios every{"", {}};
    for (WidthRatios& r : width_ratios(q, cases)) {
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
  std::uint64_t cases = 400, lies = 1000;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with("--cases=")) {
      cases = std::strtoull(argv[i] + 8, nullptr, 10);
      if (cases == 0) return std::cerr << "oracle_power: --cases must be a positive number\n", 2;
    } else if (argument.starts_with("--lies=")) {
      lies = std::strtoull(argv[i] + 7, nullptr, 10);
      if (lies == 0) return std::cerr << "oracle_power: --lies must be a positive number\n", 2;
    } else if (nearmiss::find_query(argument) != nullptr) {
      names.push_back(argument);
    } else {
      return std::cerr << "oracle_power: " << argument << " is no query of the catalogue\n", 2;
    }
  }
  return nearmiss::run(names, cases, lies);
}
