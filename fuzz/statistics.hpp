/// Figures of one run of a fuzz target, for experiments. With a file in the environment variable
/// NEARMISS_FUZZ_STATISTICS they are written there as JSON, at the end of the process or before a violation aborts it.
#pragma once

#include <cstddef>

#include "fuzz/asked.hpp"
#include "oracles/judge.hpp"

namespace nearmiss::fuzz {

/// Whether NEARMISS_FUZZ_STATISTICS names a file. The other functions do nothing where it does not.
bool statistics_are_asked();

void count_execution();

/// Counts a feature (fuzz/feedback.hpp) once, however often it is set.
void count_feature(std::size_t counter);

/// Keeps the worst proved backward error of each subject, refined where it passes the last one.
void count_answer(const Asked& asked, const Case& c, const Answer& answer, const Finding& finding);

void write_statistics();

}  // namespace nearmiss::fuzz
