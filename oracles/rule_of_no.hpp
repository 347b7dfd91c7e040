/// The rules by which an exact answer is no although the bodies meet.
#pragma once

#include <string>

#include "impl/catalogue/case.hpp"
#include "impl/subject/convention.hpp"

namespace nearmiss {

/// For a case whose exact answer is no: the rule of the query without which it would be a yes, as a clause: "the point
/// starts inside the box". Each rule is found by an exact decision about the case without the rule: the shape turned
/// around, the body at rest, a sphere of radius 0 in place of the point, no limit of time. Empty where no rule is
/// needed. A no that the case has only by a declared convention is told by that: "a touch is a miss". Thread-safe.
std::string rule_of_no(const Case& question, Conventions declared = {});

}  // namespace nearmiss
