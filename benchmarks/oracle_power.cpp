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

#include "corpus/case_builder.hpp"
#include "corpus/families.hpp"
#include "corpus/generator.hpp"
#include "corpus/lies.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

constexpr double widening_epsilons = 0x1p24;
constexpr int random_samples = 24;
constexpr double most_median = 4;
constexpr double least_detected = 0.999;

using Hull = std::array<Bounds, Answer::capacity>;

/// Numbers of an answer that are compared together, as the judge does: those of one vector.
struct Part {
  std::string name;
  std::size_t begin, end;
};

std::vector<Part> parts_of(const Query& query) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    const Field& f = query.outputs[i];
    if (f.role == Role::flag || f.role == Role::index) continue;
    const std::string name = f.name.substr(0, f.name.find_last_of('.'));
    if (!parts.empty() && parts.back().name == name && parts.back().end == i) {
      parts.back().end = i + 1;
    } else {
      parts.push_back({name, i, i + 1});
    }
  }
  return parts;
}

class Measured {
 public:
  Measured(const Case& c, bool yes) : case_(c), widening_(widening(*c.query, c.values, c.scalar, widening_epsilons)) {
    about_.yes = yes;
    still_.resize(c.values.size(), 0.0);
  }

  /// Empty where the decision changes within the widening or some input in it breaks a rule.
  std::optional<std::pair<Hull, Hull>> enclosure_and_hull(Random& random) {
    const Query& query = *case_.query;
    const Enclosure wide = oracle_of(query).interval(case_.values, widening_, about_, case_.scalar);
    if (!wide.decided()) return std::nullopt;
    const auto middle = answer_to(case_.values);
    if (!middle) return std::nullopt;
    Hull hull = *middle;
    const auto include = [&](const std::vector<double>& directions) {
      std::vector<double> values = case_.values;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = moved(i, directions[i]);
      const auto answer = answer_to(values);
      if (!answer) return false;
      for (std::size_t n = 0; n < query.outputs.size(); ++n) hull[n].include((*answer)[n]);
      return true;
    };
    const std::size_t inputs = case_.values.size();
    std::vector<Hull> ahead(inputs);
    for (std::size_t i = 0; i < inputs; ++i) {
      std::vector<double> values = case_.values;
      values[i] = moved(i, 1);
      const auto answer = answer_to(values);
      if (!answer) return std::nullopt;
      ahead[i] = *answer;
    }
    std::vector<double> directions(inputs);
    for (std::size_t n = 0; n < query.outputs.size(); ++n) {
      for (const double sign : {-1.0, 1.0}) {
        for (std::size_t i = 0; i < inputs; ++i) directions[i] = ahead[i][n].low < (*middle)[n].low ? -sign : sign;
        if (!include(directions)) return std::nullopt;
      }
    }
    for (int s = 0; s < random_samples; ++s) {
      for (double& d : directions) d = random.one_in(3) ? random.uniform(-1, 1) : random.sign();
      if (!include(directions)) return std::nullopt;
    }
    return std::pair(wide.error, hull);
  }

 private:
  double moved(std::size_t i, double share) const {
    double x = case_.values[i] + share * widening_[i];
    while (std::abs(x - case_.values[i]) > widening_[i]) x = std::nextafter(x, case_.values[i]);
    return case_.query->inputs[i].role == Role::size ? std::max(0.0, x) : x;
  }
  std::optional<Hull> answer_to(const std::vector<double>& values) const {
    if (case_.query->broken(values)) return std::nullopt;
    const Enclosure e = oracle_of(*case_.query).interval(values, still_, about_, case_.scalar);
    if (!e.decided() || e.may_be_yes != about_.yes) return std::nullopt;
    return e.error;
  }

  const Case& case_;
  Answer about_;
  std::vector<double> widening_, still_;
};

double width(const Bounds& b) { return b.empty() ? 0 : b.high - b.low; }

/// The ratios of one part over the scenes.
struct Ratios {
  std::string part;
  std::vector<double> all;

  double at(double share) {
    std::sort(all.begin(), all.end());
    return all[std::min(all.size() - 1, std::size_t(share * double(all.size())))];
  }
};

std::vector<Ratios> ratios_of(const Query& query, std::uint64_t scenes) {
  const std::vector<Part> parts = parts_of(query);
  std::vector<Ratios> ratios;
  for (const Part& p : parts) ratios.push_back({p.name, {}});
  if (parts.empty()) return ratios;
  Random random(7);
  std::uint64_t measured = 0;
  for (std::uint64_t i = 0; i < 16 * scenes && measured < scenes; ++i) {
    const Case c = generate(query, Scalar::float64, 2027, i);
    if (!c.moves.empty()) continue;
    const auto both = Measured(c, true).enclosure_and_hull(random);
    if (!both) continue;
    ++measured;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      double enclosure = 0, hull = 0;
      for (std::size_t n = parts[p].begin; n < parts[p].end; ++n) {
        enclosure = std::max(enclosure, width(both->first[n]));
        hull = std::max(hull, width(both->second[n]));
      }
      if (enclosure > 0) ratios[p].all.push_back(enclosure / hull);
    }
  }
  return ratios;
}

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
    Ratios every{"", {}};
    for (Ratios& r : ratios_of(q, scenes)) {
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
