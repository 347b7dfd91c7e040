/// A report in sentences.
#pragma once

#include <string>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// "two-sided ("The back counts."), motion ends at time 1".
std::string declarations_text(const std::vector<Declaration>& declared);
/// One line: the subject, its fault, the query, and the proved bound of the backward error.
std::string headline(const Report& r);
/// Two to four sentences: the subject's answer, the exact answer, how far the inputs would have to move to make the
/// answer right, and the promise that the answer breaks.
std::string explanation(const Report& r);

/// "places and depths within 0.01 yard, times of impact within 0.0016 s, …".
std::string requirement_text(const SceneLimits& limits);
/// "; the measure is what the scene game-world requires"; empty without a scene.
std::string scene_measure_text();

/// An answer in one cell of a table: "hit at time 0.48", "miss", "(1, 2, 3)".
std::string answer_text(const Query& query, const Answer& answer, Scalar scalar);
/// The exact answer, a sentence without its full stop: "it is a hit at time 0.48".
std::string truth_text(const Query& query, const Truth& truth);

/// "every position by up to 0.0015 and every velocity by up to 0.00058 (6.2 % of the largest number of its group, 2^20
/// epsilon)"; `k` in epsilon.
std::string moves_text(const Case& question, double k);

}  // namespace nearmiss
