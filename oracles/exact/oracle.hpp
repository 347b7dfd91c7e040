/// The oracle of a query: what it can be asked.
#pragma once

#include <span>
#include <vector>

#include "impl/catalogue/query.hpp"
#include "oracles/exact/enclosure.hpp"

namespace nearmiss {

/// The entry points of one query's oracle. `values` are the inputs, `about` the answer in question.
struct Oracle {
  /// Fast; may be wide. `scalar` is that of the answer.
  Enclosure (*interval)(std::span<const double> values, Widening widening, const Answer& about, Scalar scalar);
  /// Exact decision; errors enclosed to a few units in the last place of the error itself.
  /// `list`, where given, receives every right answer.
  Enclosure (*exact)(std::span<const double> values, const Answer& about, Scalar scalar,
                     std::vector<Alternative>* list);
  /// May the place of the answer that number `number` belongs to be, but for `ulps` units in its last place, on the
  /// surface that the query names, for some input within the widening? False is a proof that it is not. Empty where
  /// the query names no surface.
  bool (*may_be_on_surface)(std::span<const double> values, Widening widening, const Answer& about, std::size_t number,
                            double ulps, Scalar scalar);
  /// The exact decision where each number is `values[i] + by[i] * 2^-exponent`.
  bool (*exact_decision)(std::span<const double> values, std::span<const double> by, int exponent);
};

const Oracle& oracle_of(const Query& query);

}  // namespace nearmiss
