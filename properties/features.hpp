/// Configurations that the generator builds, recognised by the numbers of a case alone.
#pragma once

#include <span>
#include <string_view>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// A configuration, and the share of the generated cases that have it.
struct Configuration {
  std::string_view name;
  bool (*concerns)(const Query&);
  /// Computed in long double: a number that is exact in float or double is told from its neighbour, unless other
  /// numbers of the case are larger than it by more than a few powers of two.
  bool (*found)(const Case&);
  /// Of 1,000 cases, in every query that it concerns and in each scalar.
  double at_least_per_mille, at_most_per_mille;
};

std::span<const Configuration> configurations();

}  // namespace nearmiss
