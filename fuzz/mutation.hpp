/// Mutations of cases for a fuzzing engine. Each keeps the case valid and exact in its scalar.
#pragma once

#include <cstdint>

#include "impl/catalogue/case.hpp"

namespace nearmiss::fuzz {

/// A generated case.
Case fresh_case(const Query& query, unsigned seed);

/// One mutation of the case: the generator's mutators (Case::moves), one number by one or more ulps, one number of a
/// stored case, or one number such that the shapes touch. If the last change by ulps made the answers worse, continues
/// in the same direction half of the time, with twice the step.
void change(Case& c, unsigned seed);

/// Gives the case shapes, vectors or numbers of the other one.
void cross_over(Case& c, const Case& other, unsigned seed);

/// Tells change() how bad the answers to a case are.
void remember(const Case& c, double badness);

}  // namespace nearmiss::fuzz
