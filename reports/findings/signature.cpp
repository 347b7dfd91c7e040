#include "reports/findings/signature.hpp"

#include "reports/findings/breakage.hpp"

namespace nearmiss {

Signature signature_of(const Finding& f) {
  Signature s;
  s.verdict = f.verdict;
  s.disagreement = f.disagreement;
  if (const MemberFinding* headline = f.headline_member()) s.member = headline->member;
  s.broken = f.broken;
  if (f.verdict == Verdict::broke) s.breakage = kind_of_breakage(f.clause, f.cause);
  return s;
}

}  // namespace nearmiss
