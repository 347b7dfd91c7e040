/// The properties that are tested for each query, by name.
#pragma once

#include <string>
#include <vector>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

/// "SUITE.TEST" for each test of properties/ that runs for the query. One closed table, which a test
/// compares with what properties/ says of itself.
std::vector<std::string> properties_of(const Query& query);

}  // namespace nearmiss
