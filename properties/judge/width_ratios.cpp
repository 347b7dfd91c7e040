#include "properties/judge/width_ratios.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

constexpr double widening_epsilons = 0x1p24;
constexpr int random_samples = 24;

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
    return case_.role(i) == Role::size ? std::max(0.0, x) : x;
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

}  // namespace

double WidthRatios::at(double share) {
  std::sort(all.begin(), all.end());
  return all[std::min(all.size() - 1, std::size_t(share * double(all.size())))];
}

std::vector<WidthRatios> width_ratios(const Query& query, std::uint64_t scenes) {
  const std::vector<Part> parts = parts_of(query);
  std::vector<WidthRatios> ratios;
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

}  // namespace nearmiss
