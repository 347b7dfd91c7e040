/// The findings that a triage groups: the reports of its sources, asked again.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "reports/findings/severity.hpp"
#include "reports/findings/workers.hpp"
#include "reports/triage/examination/examined_cases.hpp"
#include "reports/triage/examination/ordinary_scene.hpp"
#include "reports/triage/examination/sources.hpp"

namespace nearmiss {

/// A report whose subject was asked again and still has a finding.
struct Candidate {
  const FiledReport* filed = nullptr;
  Answer answer;
  Finding finding;  ///< in full
  FindingKind kind;
  Variant variant;
  ErrorSize size;
  std::string headline;
  Case plain;  ///< the case at ordinary magnitude where the fault is there too; otherwise the case itself
  /// Of an extreme scene without this fault at ordinary magnitude; empty for any other.
  std::optional<ExtremeMagnitudes> extreme;
  std::optional<ExaminedCase> examined;
};

/// The candidates of one kind. Those to be examined come first, in their order.
struct CandidatesOfKind {
  FindingKind kind;
  std::vector<Candidate> all;
  std::size_t to_examine = 0;
};

/// Asks the subject of a report again, and where the scene is extreme also at ordinary magnitude. Empty where it has no
/// finding now.
std::optional<Candidate> asked_again(const FiledReport& r, Workers& workers);

/// How many candidates of a kind are examined at most.
inline constexpr std::size_t most_examined = 6;
/// Moves the candidates that are to be examined to the front: the worst, the simplest, then one of each further
/// variant. Those of ordinary scenes come before those of extreme ones; findings of extreme scenes alone are not
/// examined.
void choose(CandidatesOfKind& group);

/// How well an examined case fits a variant; the larger, the better. Best is one of the same variant, then one whose
/// regions the variant has, and the most of them.
using Likeness = std::tuple<bool, bool, bool, std::size_t, bool>;
Likeness likeness(const Candidate& c, const Variant& variant);

}  // namespace nearmiss
