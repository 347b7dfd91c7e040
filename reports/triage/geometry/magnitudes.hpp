/// Lengths and dimensionless numbers of a case that an implementation may compare with each other.
#pragma once

#include <string>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

struct Magnitude {
  std::string name;       ///< "the distance of sphere.center from plane"
  long double value = 0;  ///< not negative; 0: no meaning in this case
};

/// The same two lists, in the same order, for every case of a query.
struct Magnitudes {
  std::vector<Magnitude> lengths;  ///< sizes, edges, distances, gaps, differences of two distances
  std::vector<Magnitude> pure;     ///< sines, shares of a vector, weights, parameters along edges, shares of a time
};

/// With the distance to the nearest change of the exact decision where `with_gap` is set. From the inputs and, where
/// the decision is yes, from a right answer, or the exact one where none is given. In extended precision: a gap of
/// 1e-12 of the numbers keeps six digits.
Magnitudes magnitudes_of(const Case& c, const Answer* right = nullptr, bool with_gap = false);

}  // namespace nearmiss
