/// What findings of one fault have in common.
#pragma once

#include <compare>
#include <string>

#include "oracles/judge.hpp"

namespace nearmiss {

/// Two findings of the same query and subject with the same signature are of the same kind: the same member of the
/// answer is wrong in the same way, and breaks the same clause.
struct Signature {
  Verdict verdict = Verdict::agrees;
  Disagreement disagreement = Disagreement::none;
  int member = MemberFinding::decision;  ///< of the headline, an index in the query's layout
  Clause broken = Clause::none;
  std::string breakage;  ///< for a subject that broke: kind_of_breakage()

  auto operator<=>(const Signature&) const = default;
};

Signature signature_of(const Finding& f);

}  // namespace nearmiss
