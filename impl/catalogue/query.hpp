/// A query with its types erased: the names and roles of its numbers, and the rules of valid input.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <collide/members.hpp>

#include "impl/catalogue/answer.hpp"
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

/// One number of an input or an answer.
struct Field {
  std::string name;  ///< "box.center.x"
  Role role;
};

/// A rule that an input breaks: the field, its value, and the rule.
struct Invalid {
  std::string field;
  double value;
  std::string rule;
  std::string text() const;
};

struct Query {
  QueryId id;
  std::string_view name;
  Kind kind;
  std::vector<Field> inputs;
  std::vector<Field> outputs;
  Operands operands;
  Layout layout;  ///< the members of an answer, as ranges of its outputs
  /// The first rule that the inputs break, if any. Expects inputs.size() values.
  std::optional<Invalid> (*broken)(std::span<const double> values);
  Traits traits;
  std::size_t index = 0;  ///< in the catalogue

  /// "location", "corners.2.point": the name of the member's outputs without their component.
  std::string member_name(std::size_t part) const;
};

/// All queries, in the catalogue's order.
std::span<const Query> catalogue();
const Query& query_of(QueryId id);
/// nullptr where the catalogue has no query of that name.
const Query* find_query(std::string_view name);

}  // namespace nearmiss
