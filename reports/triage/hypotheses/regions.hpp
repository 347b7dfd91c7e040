/// Regions of the inputs of a query that an implementation may leave out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

struct Region {
  std::string name;  ///< "a radius of zero"
  std::function<bool(const Case&)> has;
  /// A limiting case, which an implementation may treat apart: not a turned box, a flag, or a side.
  bool is_special = true;
};

/// The regions that the query's inputs have, from names and roles alone: zero sizes, equal corners, motions along axes,
/// starts in contact, something flat, parallel vectors, turned boxes, vectors that are not of unit length, flags that
/// are set, hits from one side of a triangle.
std::vector<Region> regions_of(const Query& query);

}  // namespace nearmiss
