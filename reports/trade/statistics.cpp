#include "reports/trade/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearmiss {

namespace {

constexpr double confidence_left_out = 0.05;
constexpr std::uint64_t enough_for_wilson = 1000;

/// The probability of at most `count` in `of` independent draws at the rate p.
double at_most(std::uint64_t count, std::uint64_t of, double p) {
  if (p <= 0) return 1;
  if (p >= 1) return count >= of ? 1 : 0;
  const double n = double(of), log_p = std::log(p), log_q = std::log1p(-p);
  double sum = 0;
  for (std::uint64_t i = 0; i <= count; ++i) {
    const double k = double(i);
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) + k * log_p + (n - k) * log_q);
  }
  return std::min(1.0, sum);
}

/// The rate at which at most `count` of `of` have the probability `probability`, by halving.
double rate_with(std::uint64_t count, std::uint64_t of, double probability) {
  constexpr int halvings = 60;  // down to 2^-60
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (at_most(count, of, middle) > probability ? low : high) = middle;
  }
  return high;
}

/// The interval of Wilson, for many of both kinds: it then agrees with that of Clopper and Pearson to three digits, and
/// its cost does not grow with the counts.
Rate wilson(std::uint64_t count, std::uint64_t of) {
  constexpr double z = 1.959964;  // 95 % of a normal distribution lie within so many standard deviations
  const double n = double(of), p = double(count) / n;
  const double middle = p + z * z / (2 * n), half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {count, of, (middle - half) / (1 + z * z / n), (middle + half) / (1 + z * z / n)};
}

}  // namespace

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
  if (of == 0) return {count, of, 0, 1};
  if (count == 0) return {count, of, 0, -std::expm1(std::log(confidence_left_out) / double(of))};
  if (count == of) return {count, of, std::exp(std::log(confidence_left_out) / double(of)), 1};
  if (std::min(count, of - count) >= enough_for_wilson) return wilson(count, of);
  const double tail = confidence_left_out / 2;
  return {count, of, rate_with(count - 1, of, 1 - tail), rate_with(count, of, tail)};
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
