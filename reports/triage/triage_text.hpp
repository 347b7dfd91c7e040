/// The result of a triage for a terminal.
#pragma once

#include <cstddef>
#include <string>

#include "reports/triage/triage.hpp"

namespace nearmiss {

/// "misses a hit, 12 % of the scene, 88 % of 3,120 findings in ordinary scenes".
std::string severity_text(const TriagedSignature& s);
/// A signature in a few lines of at most 100 columns; file names are not broken.
std::string signature_text(const TriagedSignature& s);
/// "12 signatures in 1,465 findings (171 reports): 0 new, 1 worse, …", a line.
std::string triage_counts_text(const Triage& t);
/// A line of counts, the first `rows` signatures, and what is left out.
std::string triage_text(const Triage& t, std::size_t rows);

}  // namespace nearmiss
