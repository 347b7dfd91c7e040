/// A case: a query, its inputs as exact floats, and where it came from. Where the inputs have lists of counted members
/// (counted_inputs.hpp), the count of a list is one of the numbers, before those of its entries.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

struct Case {
  const Query* query = nullptr;
  Scalar scalar = Scalar::float64;  ///< every input is exactly a number of this scalar
  std::vector<double> values;
  std::string origin;                   ///< "generator", "seeds/touch.json", "fuzz", a file and row …
  std::uint64_t seed = 0;               ///< of the generator
  std::uint64_t index = 0;              ///< of the case within its origin
  std::vector<std::string_view> moves;  ///< names of the generator's mutators that built it

  /// One for each of `values`. They follow from the counts among these: a change of a count leads to other fields.
  std::span<const Field> fields() const { return query->fields_of(values); }
  Role role(std::size_t number) const { return fields()[number].role; }
  const std::string& name(std::size_t number) const { return fields()[number].name; }
  const Operands& operands() const { return query->operands_of(values); }
};

/// Leaves out an entry of a list, or repeats it behind itself. False, without a change, where the list has its fewest
/// or its most entries.
bool erase_entry(Case& c, std::size_t list, std::size_t entry);
bool repeat_entry(Case& c, std::size_t list, std::size_t entry);

}  // namespace nearmiss
