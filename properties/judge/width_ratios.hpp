/// How wide the oracle's enclosures are, compared with what the inputs explain.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

/// For one part of an answer (a number, or the numbers of one vector, which the judge compares together): the width of
/// the enclosure over the width of the hull of exact answers, one ratio for each scene.
struct WidthRatios {
  std::string part;
  std::vector<double> all;

  /// The ratio that this share of the scenes does not exceed. `all` must not be empty.
  double at(double share);
};

/// The ratios of each part over that many plain scenes of the generator. Of each scene the inputs are widened by 2^24
/// epsilon of double. The hull contains the exact answers to random inputs within the widening and, for each number of
/// the answer, to the two corners to which its slopes point. Scenes whose decision changes within the widening are left
/// out, so a part may have fewer ratios, or none. The same on every machine.
std::vector<WidthRatios> width_ratios(const Query& query, std::uint64_t scenes);

}  // namespace nearmiss
