/// Converts a case to another query, by a link of the catalogue.
#pragma once

#include "impl/catalogue/case.hpp"

namespace nearmiss::metamorphic {

/// The first link of that kind from the case's query; nullptr if there is none.
const Link* link_of(const Case& c, Link::Kind kind);

/// The case of the other query. `renamed` takes precedence over the link's own renames.
Case recast(const Case& c, const Link& link, std::span<const Link::Renamed> renamed = {});

}  // namespace nearmiss::metamorphic
