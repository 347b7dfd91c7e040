/// A case: a query, its inputs as exact floats, and where it came from.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

struct Case {
  const Query* query = nullptr;
  Scalar scalar = Scalar::float64;      ///< every input is exactly a number of this scalar
  std::vector<double> values;           ///< one for each of Query::inputs
  std::string origin;                   ///< "generator", "seeds/touch.json", "fuzz", a file and row …
  std::uint64_t seed = 0;               ///< of the generator
  std::uint64_t index = 0;              ///< of the case within its origin
  std::vector<std::string_view> moves;  ///< names of the generator's mutators that built it
};

}  // namespace nearmiss
