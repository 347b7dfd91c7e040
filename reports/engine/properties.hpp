/// The names of the property tests that run for each query.
#pragma once

#include <string>
#include <vector>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

/// "SUITE.TEST" for each test of properties/ that runs for the query. CMake makes the list from the tests' sources; a
/// test compares it with the tests that the program has.
std::vector<std::string> properties_of(const Query& query);

}  // namespace nearmiss
