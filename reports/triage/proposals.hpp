/// Conventions that a subject does not declare, and that explain rows of a triage.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "impl/subject/convention.hpp"
#include "reports/findings/workers.hpp"
#include "reports/triage/candidates.hpp"

namespace nearmiss {

/// The cases of a row, and the findings that the runs counted for it.
struct CasesOfRow {
  std::vector<const Candidate*> cases;
  std::uint64_t findings = 0;
};

/// The convention makes at least 9 in 10 cases of some rows right.
struct ProposedConvention {
  std::string subject;
  Convention convention = Convention::two_sided;
  std::vector<std::string> queries;  ///< of these rows; empty: it can be declared for all queries that it concerns
  std::uint64_t findings = 0;        ///< of these rows
};

/// For each subject the conventions that explain most findings, each row by one of them. A row's cases are judged again
/// under the convention. So are the answers to generated cases of its query: a convention that makes right answers
/// wrong is not proposed. `goes_on`: false ends the work, with what is found until then.
std::vector<ProposedConvention> proposed_conventions(std::span<const CasesOfRow> rows, Workers& workers,
                                                     const std::function<bool()>& goes_on);

/// "declare "three: two-sided", and 134,634 findings go", a line for each.
std::string proposals_text(std::span<const ProposedConvention> proposals);
/// The arguments of --declare: "three: two-sided".
std::vector<std::string> declarations_of(const ProposedConvention& p);

}  // namespace nearmiss
