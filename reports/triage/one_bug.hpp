/// Which examined findings are probably one bug.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/triage/candidates.hpp"

namespace nearmiss {

/// What was examined of a kind of finding, and the reports that are most like it. Where nothing was examined, the first
/// report stands for it.
struct ExaminedFinding {
  const Candidate* examined = nullptr;
  std::vector<const Candidate*> cases;

  const FindingKind& kind() const { return examined->kind; }
  bool has_cause() const { return examined->examined.has_value(); }
  const Cause& cause() const { return examined->examined->cause; }
  FeatureRegions regions() const { return has_cause() ? examined->examined->regions : examined->variant.regions; }
  const Case& simplest() const { return has_cause() ? examined->examined->simplest : examined->filed->question; }
};

/// A cause that is no mechanism of arithmetic and no reading: what is wrong is told by the regions of the inputs. 0:
/// any other cause; otherwise the larger, the more it says.
int told_by_regions(const Cause& cause);
/// The key of a reading, or of a constant: where two queries of a subject share it, they share the code.
bool is_shared_by_queries(const Cause& cause);

/// Groups of indices into `all`. Two findings of one subject are one bug where
/// * both have the cause with the same reading or constant, in any query;
/// * the reading that explains one makes most answers of the other right (all, or proved to be more than half), in any
///   query;
/// * both have the same mechanism of arithmetic, in one query;
/// * they are of one kind, no mechanism is known, and both need the same regions;
/// * the answers to one are wrong in the other's way too, and the other way around, in one query;
/// * no mechanism is known, they need the same regions, and each turns into the other where the numbers of its simplest
///   case change, as often as their reports let expect, in one query.
std::vector<std::vector<std::size_t>> one_bug_each(const std::vector<ExaminedFinding>& all, Workers& workers);

}  // namespace nearmiss
