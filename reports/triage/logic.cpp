#include "reports/triage/logic.hpp"

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
                                      [](const ScaleScan& s) { return s.flip.has_value(); });
    if (asked_.is_exact() && no_flip)
      return Named{CauseKind::logic, "",
                   "The subject's arithmetic is exact here, and its answer is wrong at every scale."};
    const std::vector<Trial>& near = asked_.neighbours();
    constexpr std::size_t cases = 64;
    constexpr int order = 13;
    const std::vector<Trial> around = trials().ask(relative_neighbours(question(), cases, order, asked_.seed() + 2));
    const std::size_t same = count(around, Outcome::same), all = around.size() - count(around, Outcome::none);
    saw("Cases were asked whose numbers differ by up to a ten-thousandth.",
        fmt::format("{} have the finding.", of_text(same, all)));
    const bool stays = asked_.same_in_all_roundings() && no_flip &&
                       nearly_all(count(near, Outcome::same), near.size() - count(near, Outcome::none)) &&
                       nearly_all(same, all);
    if (!stays) return std::nullopt;
    return Named{
        CauseKind::logic, "",
        "The answer stays wrong in every rounding mode, at every scale and for all cases nearby: the mistake is in "
        "the logic."};
  }
};

}  // namespace

Tested logic_of(AskedCases& asked) {
  Logic test(asked);
  return test.finished(test.named());
}

}  // namespace nearmiss
