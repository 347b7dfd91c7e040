/// Statistics of a trade: quantiles, intervals of rates, Pareto fronts and performance profiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nearmiss {

/// The smallest value with at least the share `q` of all values at or below it. `sorted` is not empty; q is in (0, 1].
double quantile(std::span<const double> sorted, double q);

/// The value that one in `n` values reaches or exceeds; empty where there are fewer than `n` values.
std::optional<double> one_in(std::span<const double> sorted, std::uint64_t n);

/// The median, its neighbours and the end of a distribution.
struct Quantiles {
  double p50 = 0, p99 = 0, max = 0;
};
/// Sorts the values; empty without values.
std::optional<Quantiles> quantiles_of(std::vector<double>& values);

/// How often something happened, and the interval that holds its true rate with 95 % confidence where the cases are
/// independent draws: of Clopper and Pearson. Where it happened never or always, the interval is one-sided: the rule of
/// three, 1 - 0.05^(1/n), or about 3/n.
struct Rate {
  std::uint64_t count = 0, of = 0;
  double low = 0, high = 1;

  double share() const { return of == 0 ? 0 : double(count) / double(of); }
};
Rate rate_of(std::uint64_t count, std::uint64_t of);

/// The price and the error of one choice. Less is better in both.
struct Price {
  double cost = 0, error = 0;
};
/// For each choice, whether no other is better in one of both and at least as good in the other.
std::vector<bool> pareto_front(std::span<const Price> choices);

/// A performance profile of Dolan and Moré ("Benchmarking optimization software with performance profiles", 2002): for
/// each solver the share of all problems that it solves at `tau` times the least cost of any solver, or less.
class PerformanceProfile {
 public:
  explicit PerformanceProfile(std::size_t solvers) : ratios_(solvers) {}

  /// The cost of each solver on a problem; infinity: it does not solve the problem. A problem counts by its weight.
  void add(std::span<const double> costs, double weight = 1);
  std::size_t problems() const { return problems_; }
  double share(std::size_t solver, double tau) const;
  /// The share of problems that the solver solves at any cost.
  double solved(std::size_t solver) const;

 private:
  struct Solved {
    double ratio, weight;
  };
  std::vector<std::vector<Solved>> ratios_;  ///< of each solver, on the problems that it solves
  std::size_t problems_ = 0;
  double weight_ = 0;  ///< of all problems
};

}  // namespace nearmiss
