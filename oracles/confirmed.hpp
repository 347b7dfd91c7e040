/// The judge's second look. Every engine that counts what is wrong with answers asks here, so that nothing is counted
/// on the word of one look.
#pragma once

#include <stdexcept>

#include "oracles/judge.hpp"

namespace nearmiss {

/// Two looks at one answer that cannot both be right: a fault of Nearmiss, never a finding. A program that meets one
/// ends with this exit code.
class InternalError : public std::runtime_error {
 public:
  static constexpr int exit_code = 3;

  /// what() is one line that has both words.
  InternalError(const Case& question, const Finding& first, const Finding& in_full);
  const Case& question() const { return question_; }

 private:
  Case question_;
};

/// Judges as judge() does. What accuses the subject (a violation, a wrong decision, a number that is not finite) is
/// judged a second time, alone and in full, and the second word is the one returned; Detail::full always returns that
/// one. Throws InternalError where the two differ in the verdict or the truth. Which of several wrong members is the
/// worst, the second word alone can tell: a first look knows their distances between bounds.
Finding confirmed(const Case& question, const Answer& answer, const Standard& standard, Detail detail);

}  // namespace nearmiss
