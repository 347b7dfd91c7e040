#include "reports/triage/hypotheses/written_constant.hpp"

#include <fmt/format.h>

#include <cmath>

namespace nearmiss {

std::optional<WrittenConstant> written_constant(double low, double high, double factor) {
  const double middle = std::sqrt(low) * std::sqrt(high);
  const auto is_near = [&](double x) { return x * factor >= high && x <= low * factor; };
  const int decade = int(std::lround(std::log10(middle)));
  const double round = std::pow(10.0, decade);
  if (is_near(round)) return WrittenConstant{round, fmt::format("1e{}", decade), 0};
  const int octave = int(std::lround(std::log2(middle)));
  const double binary = std::ldexp(1.0, octave);
  if (is_near(binary)) return WrittenConstant{binary, fmt::format("2^{}", octave), 1};
  const int below = int(std::floor(std::log10(middle)));
  for (const int digit : {2, 5}) {
    const double x = digit * std::pow(10.0, below);
    if (is_near(x)) return WrittenConstant{x, fmt::format("{}e{}", digit, below), 2};
  }
  return std::nullopt;
}

}  // namespace nearmiss
