/// What the judge's process and a host of this project must have in common to understand each other's shared memory.
#pragma once

#include <span>
#include <string>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

/// A fingerprint, sixteen hexadecimal digits, of the sizes and offsets of the shared memory, of the values that travel
/// in it, and of the queries with the names and roles of their inputs and outputs. A host states it in its hello. A
/// host with another one is of another build, and its answers would be misread.
std::string shared_layout(std::span<const Query> queries);

}  // namespace nearmiss
