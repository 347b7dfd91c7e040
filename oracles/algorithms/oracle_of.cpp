#include <stdexcept>
#include <string>

#include "oracles/exact/oracle.hpp"

namespace nearmiss {

namespace oracle {
#define NEARMISS_QUERY(query) Oracle query##_oracle();
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
}  // namespace oracle

namespace {

void check_that_answers_fit() {
  for (const Query& query : catalogue()) {
    const std::size_t members = query.layout.parts.size();
    if (members <= Enclosure::most_members) continue;
    throw std::logic_error(std::string(query.name) + ": an answer of " + std::to_string(members) + " members");
  }
}

std::vector<Oracle> every_oracle() {
  check_that_answers_fit();
  return {
#define NEARMISS_QUERY(query) oracle::query##_oracle(),
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
  };
}

}  // namespace

const Oracle& oracle_of(const Query& query) {
  static const std::vector<Oracle> oracles = every_oracle();
  return oracles[query.index];
}

}  // namespace nearmiss
