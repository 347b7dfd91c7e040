/// An oracle of sphere_sphere_overlap that contradicts itself. Where the first center's x is positive, the interval
/// stage returns the opposite of the given answer, and the exact stage returns the given answer. Elsewhere both stages
/// return "no", so a yes is a false hit.
#include "oracles/exact/oracle.hpp"

namespace nearmiss::oracle {

namespace {

Enclosure decided(bool yes, const Answer& about) {
  Enclosure e;
  (yes ? e.may_be_yes : e.may_be_no) = true;
  e.may_match = yes == about.yes;
  return e;
}

bool is_planted(std::span<const double> values) { return values[0] > 0; }

Enclosure interval(std::span<const double> values, Widening, const Answer& about, Scalar) {
  return decided(is_planted(values) && !about.yes, about);
}

Enclosure exact(std::span<const double> values, const Answer& about, Scalar, AlternativeList* list) {
  const bool yes = is_planted(values) && about.yes;
  if (list != nullptr) list->all.push_back({.yes = yes});
  return decided(yes, about);
}

bool exact_decision(std::span<const double> values, std::span<const double>, int) { return is_planted(values); }

}  // namespace

Oracle sphere_sphere_overlap_oracle() { return {interval, exact, nullptr, exact_decision}; }

}  // namespace nearmiss::oracle
