#include "reports/triage/hypotheses/hypotheses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
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
      if (auto named = right_between(s)) return named;
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
    return Named{kind,
                 std::string(s.group->name),
                 fmt::format("A number that the subject computes leaves the range of the scalar: {}.", name_of(kind)),
                 {Prediction::extreme_numbers}};
  }

  std::optional<Named> ends_together(const ScaleScan& s, const Flip& ends, CauseKind kind) {
    saw(fmt::format("All {} were multiplied by powers of two.", s.group->name),
        fmt::format(
            "From 1 to 2^{} the finding stays, and every answer raises {}. From 2^{} on the finding is another, "
            "or gone, and no answer raises it.",
            ends.wrong, name_of(kind), ends.right));
    return Named{kind,
                 std::string(s.group->name),
                 fmt::format("A number that the subject computes leaves the range of the scalar: {}.", name_of(kind)),
                 {Prediction::extreme_numbers}};
  }

  /// A tolerance is exceeded on one side. The range of a smaller type is left on both. So may be that of a search from
  /// a fixed start, or of a solver with constants: where no type's range is left, nothing is named.
  std::optional<Named> right_between(const ScaleScan& s) {
    constexpr int least_between = 16, furthest = 128;  // the range of floats
    if (!s.has_clean_flip() || largest_of(question(), *s.group) == 0) return std::nullopt;
    const int direction = s.flip->right > s.flip->wrong ? 1 : -1, base = std::ilogb(largest_of(question(), *s.group));
    std::optional<int> again;  // the nearest scale beyond the right answers with the finding
    for (const ScaleScan::At& a : s.trials) {
      const bool is_ordinary = (a.trial.raised & (raised_overflow | raised_underflow)) == 0;
      const int beyond = (a.k - s.flip->right) * direction;
      if (a.trial.outcome != Outcome::same || !is_ordinary || beyond < least_between) continue;
      if (!again || beyond < (*again - s.flip->right) * direction) again = a.k;
    }
    if (!again) return std::nullopt;
    const int smallest = base + std::min(*again, s.flip->wrong), largest = base + std::max(*again, s.flip->wrong);
    if (smallest < -furthest || largest > furthest) return std::nullopt;
    constexpr int sixth_power = 128 / 6;  // of the largest float; its square, fourth and sixth power leave the range
    const bool leaves_floats = largest >= sixth_power - 2 && smallest <= -sixth_power;
    saw(fmt::format("All {} were multiplied by powers of two.", s.group->name),
        fmt::format("The finding is there with 2^{} and again with 2^{}, and the answer is right between the two.",
                    s.flip->wrong, *again),
        leaves_floats ? std::vector{CauseKind::absolute_tolerance, CauseKind::relative_tolerance}
                      : std::vector<CauseKind>{});
    if (!leaves_floats) return std::nullopt;
    return Named{
        direction < 0 ? CauseKind::overflow : CauseKind::underflow,
        std::string(s.group->name),
        "The finding is there for large numbers and for small ones, and not between: a number that the subject "
        "computes leaves the range of a smaller type.",
        {Prediction::extreme_numbers, Prediction::two_borders}};
  }

  /// The binary exponent of the largest of the group's numbers, multiplied by 2^k; 0 where all are zero.
  int exponent_at(const ScaleScan& s, int k) const {
    const double largest = largest_of(k == 0 ? question() : *scaled(question(), *s.group, k), *s.group);
    return largest > 0 ? std::ilogb(largest) : 0;
  }
  /// A subject that broke, or that answers behind pipes, leaves no flags. The range is exceeded if the fourth power of
  /// the largest of the group's numbers exceeds it wherever the finding is there, and the answer is right nearer to
  /// scale 1.
  std::optional<Named> out_of_range_without_flags(const ScaleScan& s) {
    const bool has_flags = trials().sets_rounding() && trials().base().finding.verdict != Verdict::broke;
    if (has_flags || !s.flip) return std::nullopt;
    constexpr int powers = 4;
    const int highest = (trials().subject().scalar == Scalar::float32 ? 128 : 1024) / powers;
    const int base = exponent_at(s, 0), at_flip = exponent_at(s, s.flip->wrong);
    const bool toward_one = at_flip < 0 ? base <= at_flip : base >= at_flip;
    if (!toward_one || (at_flip < highest && at_flip > -highest)) return std::nullopt;
    saw(fmt::format("All {} were multiplied by powers of two.", s.group->name),
        fmt::format(
            "With 2^{} the answer is right. The finding stays from 1 to 2^{}, where the largest of them is about "
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
