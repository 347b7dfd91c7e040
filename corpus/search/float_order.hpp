/// The finite numbers of a scalar as consecutive integers.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "impl/catalogue/answer.hpp"

namespace nearmiss {

/// Consecutive integers for consecutive numbers of the scalar, which must hold x exactly. Both zeros are 0.
inline std::int64_t order_of(Scalar scalar, double x) {
  const double magnitude = std::abs(x);
  const std::int64_t n = scalar == Scalar::float32 ? std::int64_t(std::bit_cast<std::uint32_t>(float(magnitude)))
                                                   : std::int64_t(std::bit_cast<std::uint64_t>(magnitude));
  return x < 0 ? -n : n;
}

/// The inverse of order_of().
inline double of_order(Scalar scalar, std::int64_t n) {
  const auto bits = std::uint64_t(n < 0 ? -n : n);
  const double magnitude =
      scalar == Scalar::float32 ? double(std::bit_cast<float>(std::uint32_t(bits))) : std::bit_cast<double>(bits);
  return n < 0 ? -magnitude : magnitude;
}

/// The number of the scalar that is `ulps` numbers above x, or the largest finite one (the lowest one) where there are
/// fewer. `ulps` is at most 2^60 in magnitude.
inline double moved_by_ulps(double x, std::int64_t ulps, Scalar scalar) {
  const std::int64_t last = order_of(scalar, largest_finite(scalar));
  return of_order(scalar, std::clamp(order_of(scalar, x) + ulps, -last, last));
}

}  // namespace nearmiss
