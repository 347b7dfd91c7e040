/// A query with its types erased: the names and roles of its numbers, and the rules of valid input.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <collide/members.hpp>

#include "impl/catalogue/answer.hpp"
#include "impl/catalogue/counted_inputs.hpp"
#include "impl/catalogue/kind.hpp"
#include "impl/catalogue/layout.hpp"
#include "impl/catalogue/operands.hpp"
#include "impl/catalogue/traits.hpp"

namespace nearmiss {

std::string_view name_of(Role role);
/// A length, signed or not. A velocity and a plane's offset are none.
constexpr bool is_length(Role role) {
  return role == Role::position || role == Role::size || role == Role::depth || role == Role::distance;
}

/// A number with few values, which is exact in every scalar and moves by no ulps.
constexpr bool is_discrete(Role role) { return role == Role::flag || role == Role::index || role == Role::count; }

/// The inputs are a template where they have lists of counted members: a case owns its fields (case.hpp), and `inputs`
/// and `operands` are those of a case whose lists have their fewest entries.
struct Query {
  QueryId id;
  std::string_view name;
  Kind kind;
  std::vector<Field> inputs;
  std::vector<Field> outputs;
  Operands operands;
  Layout layout;  ///< the members of an answer, as ranges of its outputs
  /// The first rule that the inputs break, if any. Expects inputs.size() values where there are no lists.
  std::optional<Invalid> (*broken)(std::span<const double> values);
  Traits traits;
  std::size_t index = 0;  ///< in the catalogue
  CountedInputs lists{};

  /// The fields and the operands of a case with these numbers, in which only the counts matter (CountedInputs).
  const std::vector<Field>& fields_of(std::span<const double> values) const {
    return lists.empty() ? inputs : lists.fields(values).fields;
  }
  const Operands& operands_of(std::span<const double> values) const {
    return lists.empty() ? operands : lists.fields(values).operands;
  }
  std::size_t numbers_of(std::span<const double> values) const {
    return lists.empty() ? inputs.size() : lists.numbers(values);
  }
  /// Numbers of 0, where each list has its fewest entries.
  std::vector<double> zeros() const {
    std::vector<double> values(inputs.size());
    for (std::size_t k = 0; k < lists.size(); ++k) values[lists[k].at] = double(lists[k].least);
    return values;
  }
  /// The numbers before the first list, which are at the same place in every case.
  std::size_t numbers_before_lists() const { return lists.empty() ? inputs.size() : lists[0].at; }
  std::size_t most_numbers() const { return lists.empty() ? inputs.size() : lists.most_numbers(); }
};

/// All queries, in the catalogue's order.
std::span<const Query> catalogue();
const Query& query_of(QueryId id);
/// nullptr where the catalogue has no query of that name.
const Query* find_query(std::string_view name);

}  // namespace nearmiss
