/// Changes of a case for fuzzers: numbers of other cases, and the touch that is nearest in one number.
///
/// Each function gives the same result for the same case and seed on every machine. The changed case is valid
/// (Query::broken), and each number is exact in the case's scalar. Case::moves and Case::origin stay as they are.
/// Thread-safe.
#pragma once

#include <cstdint>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// Takes one number, one vector or rotation, or one whole operand from another case of the same query, rounded to the
/// scalar of `into`. It replaces the same part, or in one of four attempts a part of the same roles. Returns false, and
/// changes nothing, if no attempt gives another valid case, or if the queries differ.
bool cross(Case& into, const Case& other, std::uint64_t seed);

/// Moves one number (a coordinate, a size, a time ...) to where the exact decision differs between two neighbouring
/// numbers of the scalar: to one of the two, or up to 3 ulps beyond it. Returns false, and changes nothing, if the
/// query decides nothing, or if steps of 2^-10 ... 2^6 of the largest number of the same role find no other decision,
/// for any of four numbers. Asks at most 72 exact decisions for these steps and 64 to bisect.
bool snap_to_touching(Case& c, std::uint64_t seed);

/// Replaces one number by a number of the same role in a stored case of the query (store.hpp). Stored cases are read at
/// the first call for a query; later changes of the files have no effect. Returns false, and changes nothing, if no
/// attempt gives another valid case, or if there are no stored cases. Throws BadInput as stored_cases() does.
bool take_number_of_stored_case(Case& c, std::uint64_t seed);

}  // namespace nearmiss
