/// The judge's second look at an answer. Every engine that counts wrong answers calls confirmed(), so that no single
/// judgement is counted unchecked.
#pragma once

#include <functional>
#include <stdexcept>

#include "oracles/judge.hpp"

namespace nearmiss {

/// Two judgements of one answer contradict each other: a fault of Nearmiss, never a finding. A program that meets one
/// ends with this exit code.
class InternalError : public std::runtime_error {
 public:
  static constexpr int exit_code = 3;

  /// what() is one line that quotes both judgements.
  InternalError(const Case& question, const Finding& first, const Finding& in_full);
  const Case& question() const { return question_; }

 private:
  Case question_;
};

/// Tells whether a settled finding needs a second judgement.
using SecondLook = std::function<bool(const Finding&)>;

/// Judges as judge() does, with these requirements of a scene. Where the first judgement accuses the subject (a
/// violation, a wrong decision, a number that is not finite), judges the answer a second time with Detail::full and
/// returns that second judgement. With Detail::full the second judgement is always the one returned. Throws
/// InternalError if the two differ in the verdict or the truth. They may differ in which member is worst, because the
/// first judgement knows distances only between bounds.
///
/// `needs_second` may save the second judgement of a proved violation that is settled (Finding::settled): where it
/// returns false, the first judgement is returned.
Finding confirmed(const Case& question, const Answer& answer, const Standard& standard, Detail detail,
                  const SecondLook& needs_second = {}, const SceneLimits* scene = scene_limits());

}  // namespace nearmiss
