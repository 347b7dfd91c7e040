/// The properties that are tested for each query, by name: one closed table for `list` and for properties/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "oracles/query.hpp"

namespace nearmiss {

/// A sentence-named statement about every subject's answers to the queries for which it makes sense.
struct Property {
  std::string_view name;
  std::string_view what;  ///< one line for people
  bool (*holds_for)(const Query& query);
};

std::span<const Property> all_properties();
/// The names of those that hold for the query, in the table's order.
std::vector<std::string> properties_of(const Query& query);

}  // namespace nearmiss
