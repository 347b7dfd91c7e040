/// Sums and products that are exact in a scalar.
#pragma once

#include <cmath>
#include <optional>

#include "impl/catalogue/answer.hpp"

namespace nearmiss::metamorphic {

/// a + b if the scalar can hold it exactly.
inline std::optional<double> exact_sum(double a, double b, Scalar scalar) {
  const double sum = a + b, b_part = sum - a, a_part = sum - b_part;
  if (!std::isfinite(sum) || (a - a_part) + (b - b_part) != 0 || !representable(sum, scalar)) return std::nullopt;
  return sum;
}

inline std::optional<double> exact_product(double a, double b, Scalar scalar) {
  const double product = a * b;
  const bool far_from_underflow = product == 0 ? a == 0 || b == 0 : std::abs(product) > 0x1p-900;
  if (!std::isfinite(product) || !far_from_underflow || std::fma(a, b, -product) != 0 ||
      !representable(product, scalar)) {
    return std::nullopt;
  }
  return product;
}

/// x + factor * y if the scalar can hold it exactly.
inline std::optional<double> exact_step(double x, double factor, double y, Scalar scalar) {
  const auto step = exact_product(factor, y, scalar);
  return step ? exact_sum(x, *step, scalar) : std::nullopt;
}

}  // namespace nearmiss::metamorphic
