/// The interface of a query's oracle.
#pragma once

#include <span>
#include <vector>

#include "impl/catalogue/query.hpp"
#include "oracles/exact/enclosure.hpp"

namespace nearmiss {

/// The entry points of one query's oracle. `values` are the inputs, `about` is the given answer.
struct Oracle {
  /// Fast, but may be wide. `scalar` is the answer's scalar.
  Enclosure (*interval)(std::span<const double> values, Widening widening, const Answer& about, Scalar scalar);
  /// Exact decision, and errors enclosed to a few units in the last place of the error itself. If `list` is not null,
  /// it receives every right answer.
  Enclosure (*exact)(std::span<const double> values, const Answer& about, Scalar scalar, AlternativeList* list);
  /// True if the point that contains output `number` may lie, within `ulps` units in its last place, on the surface
  /// that the query names, for some input within the widening. False is a proof that it does not. nullptr if the query
  /// names no surface.
  bool (*may_be_on_surface)(std::span<const double> values, Widening widening, const Answer& about, std::size_t number,
                            double ulps, Scalar scalar);
  /// The exact decision for the inputs `values[i] + by[i] * 2^-exponent`.
  bool (*exact_decision)(std::span<const double> values, std::span<const double> by, int exponent);
};

const Oracle& oracle_of(const Query& query);

}  // namespace nearmiss
