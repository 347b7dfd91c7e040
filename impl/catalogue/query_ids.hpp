/// The identifiers of all queries, by name: QueryId::moving_sphere_box.
#pragma once

#include "impl/catalogue/traits.hpp"

namespace nearmiss {

enum class QueryId : std::uint64_t {
#define NEARMISS_QUERY(query) query = std::uint64_t(query_id(#query)),
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
};

}  // namespace nearmiss
