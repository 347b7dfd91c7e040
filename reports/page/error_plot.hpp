/// How a subject's error depends on each number of a case.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "reports/findings/workers.hpp"

namespace nearmiss {

/// Asks the subject the case with each number of it, but flags and indices, moved alone, and judges every answer. The
/// changes are those by plus and minus a power of two, from an ulp to four times the largest number of the group.
///
/// {"number", "value", "scale", "samples": [[change, value, fault, above_epsilon, ulps], …]}: `scale` is the largest
/// number of the group, `fault` the disagreement of an answer that breaks the contract or exceeds the measure, "broke",
/// "" for one that does not, or null where the value is invalid or is not asked; `above_epsilon` is the proved backward
/// bound or null, `ulps` the forward error or null. The samples are in the order of the values.
///
/// The subject must offer the query and the case must be in its scalar. `go_on` is called before each question; false
/// ends the sampling, and so does a subject that exceeds a time limit; the result has only the finished numbers.
nlohmann::ordered_json error_plots(const Case& question, const Subject& subject, Workers& workers,
                                   const std::function<bool()>& go_on);

}  // namespace nearmiss
