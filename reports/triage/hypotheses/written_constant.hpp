/// Tells whether a measured value is a constant that a person writes.
#pragma once

#include <optional>
#include <string>

namespace nearmiss {

struct WrittenConstant {
  double value = 0;
  std::string text;  ///< "1e-6", "2^-23", "5e-4"
  int rank = 0;      ///< 0: a power of ten; 1: of two; 2: 2 or 5 times a power of ten
};

/// The constant of the least rank that differs from all of [low, high], which are positive, by at most this factor.
std::optional<WrittenConstant> written_constant(double low, double high, double factor);

}  // namespace nearmiss
