/// A report in sentences that a stranger can believe.
#pragma once

#include <string>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// One line: who, what, in which query, and how far rounding falls short of explaining it.
std::string headline(const Report& r);
/// Two to four sentences: what the subject said, what is exactly true, how far the inputs would have to
/// move to excuse it, and which promise it breaks.
std::string explanation(const Report& r);

/// "hit at time 0.48", "miss", "depth -1.5", "(1, 2, 3)": an answer in one cell of a table.
std::string answer_text(const Query& query, const Answer& answer, Scalar scalar);
/// What is exactly true, in one sentence without its full stop: "they touch at time 0.48".
std::string truth_text(const Query& query, const Truth& truth);

}  // namespace nearmiss
