/// A case of another query that is made of the numbers of a given case.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/catalogue/query_ids.hpp"

namespace nearmiss {

/// Inputs are set by name. An input that is not set is 0. Throws std::logic_error for a name that the other query does
/// not have.
class DerivedCase {
 public:
  /// `from` must outlive this object.
  DerivedCase(const Case& from, QueryId query);

  /// The input takes the number at an index of the given case; 0 without an index.
  void set(std::string_view input, std::optional<std::size_t> index);
  /// The input with that index takes the number at an index of the given case.
  void set(std::size_t input, std::optional<std::size_t> index);
  /// The same for its x, y and z and the numbers from `begin` on.
  void set_vector(const std::string& input, std::size_t begin);

  const Case& question() const { return question_; }
  /// `values` of the given case's numbers, in the order of this one's inputs; 0 for an input that is not set.
  std::vector<double> of_inputs(const std::vector<double>& values) const;

 private:
  const Case& from_;
  Case question_;
  std::vector<std::optional<std::size_t>> index_;  ///< of each input, among the given case's numbers
};

}  // namespace nearmiss
