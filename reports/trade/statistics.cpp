#include "reports/trade/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>

namespace nearmiss {

double quantile(std::span<const double> sorted, double q) {
  const double rank = std::ceil(q * double(sorted.size()));
  return sorted[std::size_t(std::clamp(rank, 1.0, double(sorted.size()))) - 1];
}

std::optional<double> one_in(std::span<const double> sorted, std::uint64_t n) {
  if (sorted.size() < n) return std::nullopt;
  return sorted[sorted.size() - sorted.size() / n];
}

std::optional<Quantiles> quantiles_of(std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  return Quantiles{quantile(values, 0.5), quantile(values, 0.99), values.back()};
}

Rate rate_of(std::uint64_t count, std::uint64_t of) {
  using Binomial = boost::math::binomial_distribution<>;
  constexpr double confidence_left_out = 0.05;
  if (of == 0) return {count, of, 0, 1};
  if (count == 0) return {count, of, 0, -std::expm1(std::log(confidence_left_out) / double(of))};
  if (count == of) return {count, of, std::exp(std::log(confidence_left_out) / double(of)), 1};
  const double n = double(of), k = double(count), tail = confidence_left_out / 2;
  return {count, of, Binomial::find_lower_bound_on_p(n, k, tail), Binomial::find_upper_bound_on_p(n, k, tail)};
}

std::vector<bool> pareto_front(std::span<const Price> choices) {
  const auto beats = [](const Price& a, const Price& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
  };
  std::vector<bool> front;
  for (const Price& own : choices) {
    front.push_back(std::none_of(choices.begin(), choices.end(), [&](const Price& p) { return beats(p, own); }));
  }
  return front;
}

void PerformanceProfile::add(std::span<const double> costs, double weight) {
  ++problems_;
  weight_ += weight;
  const double least = *std::min_element(costs.begin(), costs.end());
  if (!std::isfinite(least)) return;
  for (std::size_t s = 0; s < costs.size(); ++s) {
    if (!std::isfinite(costs[s])) continue;
    ratios_[s].push_back({costs[s] == least ? 1 : costs[s] / least, weight});
  }
}

double PerformanceProfile::share(std::size_t solver, double tau) const {
  if (problems_ == 0) return 0;
  double solved = 0;
  for (const Solved& s : ratios_[solver]) solved += s.ratio <= tau ? s.weight : 0;
  return solved / weight_;
}

double PerformanceProfile::solved(std::size_t solver) const {
  return share(solver, std::numeric_limits<double>::infinity());
}

}  // namespace nearmiss
