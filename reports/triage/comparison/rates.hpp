/// Whether findings are more frequent than before: a statement with an error probability.
#pragma once

#include <cstddef>

#include "reports/triage/examination/sample.hpp"

namespace nearmiss {

/// The probability that a comparison of a library with itself, asked other cases, calls any row new or worse. Each of
/// its tests may err with this probability over their number (Bonferroni).
inline constexpr double error_of_a_comparison = 1e-3;

/// The probability of at least so many findings now, where the true rate is that of before. Given the sum of both
/// numbers, each is binomial, with the share of its cases: the conditional test of two Poisson rates (Przyborowski and
/// Wilenski 1940). 1 where a sample is empty.
double chance_without_rise(const FindingRate& before, const FindingRate& now);

}  // namespace nearmiss
