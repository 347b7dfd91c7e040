/// The inputs of a query that have lists of counted members: how many numbers a case has, and what each of them means,
/// follows from the counts among its numbers.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "impl/catalogue/operands.hpp"

namespace nearmiss {

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

/// The inputs of a case, number by number and by their meaning.
struct InputFields {
  std::vector<Field> fields;
  Operands operands;
};

/// A list among the inputs of a query. In the numbers of a case its count stands before its entries.
struct CountedInput {
  std::string name;     ///< "hull.vertices"
  std::size_t at;       ///< the number of its count, where each list before it has its fewest entries
  std::size_t numbers;  ///< of an entry
  std::size_t least, most;

  bool operator==(const CountedInput&) const = default;
};

/// The lists of a query, and the fields of its cases. All functions but broken() take a missing count as the fewest
/// entries and one beyond its bounds as the nearest bound, so that a case can be read number by number. Thread-safe.
class CountedInputs {
 public:
  /// Describes the inputs whose lists have these counts, one for each list in order.
  using Describe = InputFields (*)(std::span<const std::size_t> counts);

  CountedInputs() = default;
  /// Of inputs with `fewest` numbers where each list has its fewest entries.
  CountedInputs(std::vector<CountedInput> lists, std::size_t fewest, Describe describe);

  bool empty() const { return lists_.empty(); }
  std::size_t size() const { return lists_.size(); }
  const CountedInput& operator[](std::size_t list) const { return lists_[list]; }

  /// The index of the number that is the count of the list.
  std::size_t place_of_count(std::size_t list, std::span<const double> values) const;
  std::size_t count_of(std::size_t list, std::span<const double> values) const;
  /// How many numbers inputs with these counts have; at most `most_numbers`.
  std::size_t numbers(std::span<const double> values) const;
  std::size_t most_numbers() const;
  /// A count that is no whole number within its bounds, or values that are not as many as the counts say.
  std::optional<Invalid> broken(std::span<const double> values) const;
  /// The result stays valid as long as this object or a copy of it. Needs at least one list.
  const InputFields& fields(std::span<const double> values) const;

 private:
  class Described;

  std::vector<CountedInput> lists_;
  std::size_t fewest_ = 0;
  std::shared_ptr<Described> described_;
};

}  // namespace nearmiss
