/// The fuzz targets: what each asks, and the bytes of its inputs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The program fuzz_NAME. It asks one query, or all pairs of shapes of one operation of the grid
/// (impl/catalogue/grid.def).
struct FuzzTarget {
  std::string_view name;  ///< that of the query or of the operation
  std::vector<const Query*> queries;

  bool asks(const Query& query) const;
  /// The bytes of the case (codec.hpp). The bits of the first byte above the lowest are the pair's place among the
  /// queries. Expects a case of one of these.
  std::vector<std::uint8_t> bytes_of(const Case& c) const;
  /// Any first byte chooses a pair. Empty where case_from_bytes() is.
  std::optional<Case> case_of(std::span<const std::uint8_t> bytes) const;
};

/// All targets, in the order of their first queries in the catalogue. Each query is in one of them.
std::span<const FuzzTarget> fuzz_targets();
/// nullptr where no target has that name.
const FuzzTarget* find_fuzz_target(std::string_view name);
const FuzzTarget& fuzz_target_of(const Query& query);

}  // namespace nearmiss
