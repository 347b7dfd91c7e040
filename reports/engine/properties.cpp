#include "reports/engine/properties.hpp"

#include <iterator>

#include "nearmiss/per_query_tests.hpp"

namespace nearmiss {

std::vector<std::string> properties_of(const Query&) {
  return {std::begin(per_query_tests), std::end(per_query_tests)};
}

}  // namespace nearmiss
