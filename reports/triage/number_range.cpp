#include "reports/triage/number_range.hpp"

#include <fmt/format.h>

#include <utility>

namespace nearmiss {

namespace {

class NumberRange : public TestOfCause {
 public:
  using TestOfCause::TestOfCause;

  std::optional<Named> named() {
    for (const ScaleScan& s : asked_.scans()) {
      if (s.explained_by(raised_overflow)) return out_of_range(s, CauseKind::overflow);
      if (s.explained_by(raised_underflow)) return out_of_range(s, CauseKind::underflow);
      if (auto named = out_of_range_without_flags(s)) return named;
      for (const auto& [exception, kind] :
           {std::pair(raised_overflow, CauseKind::overflow), std::pair(raised_underflow, CauseKind::underflow)}) {
        if (const auto ends = s.ends_with(exception)) return ends_together(s, *ends, kind);
      }
    }
    return std::nullopt;
  }

 private:
  std::optional<Named> out_of_range(const ScaleScan& s, CauseKind kind) {
    saw(fmt::format("All {} were multiplied by powers of two.", s.group->name),
        fmt::format("With 2^{} the answer is right and no {} is raised. From 1 to 2^{} the finding stays, and every "
                    "answer raises the exception.",
                    s.flip->right, name_of(kind), s.flip->wrong));
    return Named{kind, std::string(s.group->name),
                 fmt::format("A number that the subject computes leaves the range of the scalar: {}.", name_of(kind))};
  }

  std::optional<Named> ends_together(const ScaleScan& s, const Flip& ends, CauseKind kind) {
    saw(fmt::format("All {} were multiplied by powers of two.", s.group->name),
        fmt::format(
            "From 1 to 2^{} the finding stays, and every answer raises {}. From 2^{} on the finding is another, "
            "or gone, and no answer raises it.",
            ends.wrong, name_of(kind), ends.right));
    return Named{kind, std::string(s.group->name),
                 fmt::format("A number that the subject computes leaves the range of the scalar: {}.", name_of(kind))};
  }

  /// A subject that broke, or that answers behind pipes, leaves no flags. The range is exceeded if the fourth power of
  /// the largest number exceeds it wherever the finding is there, and the answer is right nearer to scale 1.
  std::optional<Named> out_of_range_without_flags(const ScaleScan& s) {
    const bool has_flags = trials().sets_rounding() && trials().base().finding.verdict != Verdict::broke;
    if (has_flags || !s.flip) return std::nullopt;
    constexpr int powers = 4;
    const int highest = (trials().subject().scalar == Scalar::float32 ? 128 : 1024) / powers;
    const int at_flip = largest_exponent_of(question()) + s.flip->wrong;
    const int base = largest_exponent_of(question());
    const bool toward_one = at_flip < 0 ? base <= at_flip : base >= at_flip;
    if (!toward_one || (at_flip < highest && at_flip > -highest)) return std::nullopt;
    saw(fmt::format("All {} were multiplied by powers of two.", s.group->name),
        fmt::format(
            "With 2^{} the answer is right. The finding stays from 1 to 2^{}, where the largest number is about "
            "2^{}: its fourth power leaves the range of the scalar.",
            s.flip->right, s.flip->wrong, at_flip));
    return Named{at_flip > 0 ? CauseKind::overflow : CauseKind::underflow, std::string(s.group->name),
                 "The finding is there where products of the inputs leave the range of the scalar, and only there."};
  }
};

}  // namespace

Tested number_range_of(AskedCases& asked) {
  NumberRange test(asked);
  return test.finished(test.named());
}

}  // namespace nearmiss
