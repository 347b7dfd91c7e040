/// The timed cases: plain cases of the generator, about half of them with a yes, in random order.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nearmiss::benchmarks {

/// Distinct cases of a query. Every number is exact in float, so that each scalar and library answers the same cases.
struct TimedCases {
  std::vector<std::vector<double>> values;  ///< one number for each input, as in Case::values
  std::vector<bool> yes;                    ///< the decision of Fast in double

  std::size_t size() const { return values.size(); }
  double share_of_yes() const;
};

/// The number of cases for each query, a power of two. Set it before the first call of timed_cases_of.
void set_case_count(std::size_t count);
std::size_t case_count();

/// The cases of a query of the catalogue: the same in every run. Made at the first call.
const TimedCases& timed_cases_of(std::string_view query);

}  // namespace nearmiss::benchmarks
