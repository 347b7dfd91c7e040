/// Numeric features of an execution, for the fuzzing engine. Straight-line numeric code has nearly the same coverage
/// for every case, so coverage alone does not guide a fuzzer towards wrong answers. Each feature is one of
/// feature_counters counters; an execution that sets a counter for the first time joins the corpus.
#pragma once

#include <cstdint>
#include <optional>

#include "oracles/judge.hpp"

namespace nearmiss::fuzz {

/// False where the environment variable NEARMISS_FEEDBACK is "off": then no counter is ever set. Statistics count the
/// features all the same (fuzz/statistics.hpp).
bool feedback_is_on();

/// Sets the features of the case: the rung of its margin (the distance to the nearest flip of the decision), the stage
/// of the oracle that decides, the number of right answers (one, or a tie), and the branches of the oracle's algorithm.
void note_case(const Case& question, const Finding& finding);

/// Sets the features of an answer: verdict and kind together with the logarithms of the backward error (in epsilon) and
/// of the forward error (in ulps), per subject and per branch of the oracle. `subject` is its index among those asked.
void note_answer(std::size_t subject, const Finding& finding);

/// How bad an answer is: larger for a larger proved backward error and, with equal ones, for a larger forward error. 0
/// where nothing is proved.
double badness(const Finding& finding);

}  // namespace nearmiss::fuzz
