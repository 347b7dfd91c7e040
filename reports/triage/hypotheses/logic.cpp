#include "reports/triage/hypotheses/hypotheses.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nearmiss {

namespace {

class Logic : public TestOfCause {
 public:
  using TestOfCause::TestOfCause;

  /// Nothing that changes arithmetic alone changes the finding.
  std::optional<Named> named() {
    const bool no_flip = std::none_of(asked_.scans().begin(), asked_.scans().end(),
                                      [](const ScaleScan& s) { return s.has_clean_flip(); });
    if (asked_.has_small_errors() || !stays_beside_zeros() || !is_of_several()) return std::nullopt;
    if (asked_.is_exact() && no_flip)
      return Named{CauseKind::logic,
                   "",
                   "The subject's arithmetic is exact here, and its answer is wrong at every scale.",
                   {Prediction::at_every_scale, Prediction::in_every_rounding}};
    const std::vector<Trial>& near = asked_.neighbours();
    const std::vector<Trial> around = trials().ask(relative_neighbours(question(), cases, order, asked_.seed() + 2));
    const std::size_t all = count_answered(around);
    saw("Cases were asked whose numbers differ by up to a ten-thousandth.",
        fmt::format("{} are wrong.", of_text(wrong_of(around), all)));
    // Behind pipes there are no other rounding modes, and the last bits of the inputs stand for them.
    const bool stays = wrong_of(asked_.roundings()) == asked_.roundings().size() &&
                       nearly_all(wrong_of(near), count_answered(near)) && nearly_all(wrong_of(around), all);
    if (!stays) return std::nullopt;
    if (!no_flip && asked_.is_wrong_decision() && asked_.errs_to_both_sides())
      return Named{
          CauseKind::logic,
          "",
          fmt::format(
              "The answer stays wrong for all cases nearby{}, depends on the scale, and errs to both sides: the "
              "subject may compare numbers of different units.",
              asked_.and_in_every_rounding()),
          {Prediction::in_every_rounding}};
    if (!no_flip) return std::nullopt;
    return Named{
        CauseKind::logic,
        "",
        fmt::format("The answer stays wrong for all cases nearby, at every scale{}: the mistake is in the logic.",
                    asked_.and_in_every_rounding()),
        {Prediction::at_every_scale, Prediction::in_every_rounding}};
  }

 private:
  static constexpr std::size_t cases = 64;
  static constexpr int order = 13;  ///< moves by up to 2^-order

  /// With the finding, or with another.
  static std::size_t wrong_of(std::span<const Trial> trials) {
    return count(trials, Outcome::same) + count(trials, Outcome::other);
  }
  /// A finding of the case and those nearby alone may be that of a limiting case: so many others must have it that most
  /// of them could be proved to have the same cause.
  bool is_of_several() {
    const std::size_t others = count(asked_.similar(), Outcome::same) + count(asked_.sample(), Outcome::same);
    if (proved_of_most(others, others)) return true;
    saw("Other cases with the finding were counted.",
        fmt::format("There are {}: too few for a mistake of logic.", others));
    return false;
  }
  /// Two thirds of the cases are wrong in which each zero, at random, is a small number: the finding is none of a
  /// limiting case. Where it needs one of the zeros, half are wrong.
  bool stays_beside_zeros() {
    const std::vector<Trial> beside = trials().ask(with_moved_zeros(question(), cases, order, asked_.seed() + 3));
    const std::size_t all = count_answered(beside);
    if (all == 0) return true;
    saw("Cases were asked whose zeros are small numbers instead.",
        fmt::format("{} are wrong.", of_text(wrong_of(beside), all)));
    return 3 * wrong_of(beside) >= 2 * all;
  }
};

}  // namespace

Tested logic_of(AskedCases& asked) {
  Logic test(asked);
  return test.finished(test.named());
}

}  // namespace nearmiss
