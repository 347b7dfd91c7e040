#include "oracles/derived_case.hpp"

#include <algorithm>
#include <stdexcept>

namespace nearmiss {

DerivedCase::DerivedCase(const Case& from, QueryId query)
    : from_(from), question_{&query_of(query), from.scalar, {}, from.origin, 0, 0, {}} {
  if (!question_.query->lists.empty()) throw std::logic_error("a query with lists is derived from no other");
  question_.values.resize(question_.fields().size());
  index_.resize(question_.values.size());
}

void DerivedCase::set(std::string_view input, std::optional<std::size_t> index) {
  const std::span<const Field> inputs = question_.fields();
  const auto at = std::find_if(inputs.begin(), inputs.end(), [&](const Field& f) { return f.name == input; });
  if (at == inputs.end()) {
    throw std::logic_error(std::string(question_.query->name) + " has no input " + std::string(input));
  }
  set(std::size_t(at - inputs.begin()), index);
}

void DerivedCase::set(std::size_t input, std::optional<std::size_t> index) {
  index_[input] = index;
  question_.values[input] = index ? from_.values[*index] : 0;
}

void DerivedCase::set_vector(const std::string& input, std::size_t begin) {
  for (std::size_t k = 0; k < 3; ++k) set(input + "." + "xyz"[k], begin + k);
}

std::vector<double> DerivedCase::of_inputs(const std::vector<double>& values) const {
  std::vector<double> own(index_.size());
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = index_[i] ? values[*index_[i]] : 0;
  return own;
}

}  // namespace nearmiss
