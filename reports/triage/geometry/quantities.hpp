/// Quantities of a case that an implementation may compare with a constant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

struct Quantity {
  std::string name;  ///< "the distance from sphere.center to box.center"
  double value = 0;  ///< not negative; 0: no meaning in this case
  std::string_view unit = "length";
};

/// The distance that the first operand must move to change the exact decision, rounded: exact to first order for a flat
/// border. 0 where no move along an axis changes it.
double gap_of(const Case& c);

/// Sizes, distances of positions, lengths of vectors, areas of triangles; the distance that the first operand must move
/// to change the exact decision (where `with_gap` is set), and the distance moved until the exact contact. The same
/// list in the same order for each case of a query. Rounded: estimates for a search.
std::vector<Quantity> quantities_of(const Case& c, bool with_gap);

}  // namespace nearmiss
