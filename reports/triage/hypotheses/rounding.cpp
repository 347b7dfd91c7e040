#include "reports/triage/hypotheses/hypotheses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corpus/relations/exact_sums.hpp"
#include "reports/triage/trials/border.hpp"

namespace nearmiss {

namespace {

/// "Some, and not nearly all": 1 to 9 of 10.
bool is_mixed(std::size_t part, std::size_t all) { return 10 * part >= all && 10 * part <= 9 * all && part > 0; }

class RoundingErrors : public TestOfCause {
 public:
  using TestOfCause::TestOfCause;

  /// The kernels of `collide` in exact real numbers are its tier Certified.
  std::optional<Named> certified() {
    const Subject& s = trials().subject();
    if (!s.own || !s.name.starts_with("collide-")) return std::nullopt;
    const Subject* exact =
        find_subject(s.scalar == Scalar::float32 ? "collide-certified-float" : "collide-certified-double");
    if (exact == nullptr) return std::nullopt;
    const Answer answer = trials().workers().ask(*exact, question());
    const bool is_right = trials().is_right(question(), answer);
    saw("The same kernel was run in exact real numbers (" + exact->name + ").",
        is_right ? "It is right." : "It has no right answer either.");
    if (is_right)
      return Named{CauseKind::rounding, "", "The kernel is right over the real numbers: its rounding is not."};
    return Named{CauseKind::logic, "", "The kernel is wrong over the real numbers too: the mistake is in its logic."};
  }

  /// Only where there are enough other cases: one case may lie on the border of a tolerance.
  std::optional<Named> rounding_mode() {
    if (asked_.similar().size() < least_others) return std::nullopt;
    return with_roundings();
  }
  std::optional<Named> with_roundings() {
    const bool may_round = has_varying_errors();
    auto named = by_roundings(may_round);
    asked_.set_rounding_seen({may_round, others_depend_});
    return named;
  }

  std::optional<Named> rounding() {
    const std::vector<Trial>& near = asked_.neighbours();
    const std::size_t right = count(near, Outcome::right), all = count_answered(near);
    if (asked_.similar().size() < least_others) {
      if (count(near, Outcome::same) == 0) {
        saw(fmt::format("{} cases were asked whose numbers are a few ulps away.", all),
            "None has the finding: the case lies on a border, and says nothing about rounding.");
        return std::nullopt;
      }
      if (auto named = with_roundings()) return named;
    }
    const auto [may_round, others_depend] = asked_.rounding_seen();
    saw(fmt::format("{} cases were asked whose numbers are a few ulps away.", all),
        fmt::format("{} have the finding, and {} are right.", count(near, Outcome::same), right));
    if (asked_.is_exact()) {
      saw("The flags of floating-point exceptions were read.", "The subject's arithmetic on the case was exact.");
      return std::nullopt;
    }
    if (is_mixed(right, all) && others_depend && may_round && are_others_unstable()) {
      if (!are_on_two_sides(question(), near))
        return Named{CauseKind::rounding,
                     "",
                     "The answer is unstable: it is right or wrong by the last bits of the inputs.",
                     {Prediction::small_error, Prediction::changes_by_rounding}};
      saw("A plane was sought that separates these cases with the finding from those without.",
          "There is one: the case lies on a border, and the answer is not right or wrong by chance.");
    }
    return may_round ? far_from_the_origin() : std::nullopt;
  }

 private:
  static constexpr std::size_t least_others = 4;
  static constexpr double least_moved =
      0.25;  ///< of a number that consists of rounding errors, as a share of its error

  /// Whether the errors differ of the cases a few ulps away with the finding, as rounding errors do. True for a wrong
  /// decision, which has no error.
  bool has_varying_errors() {
    constexpr std::size_t least = 4;
    constexpr double spread = 1.25;
    const std::size_t seen = count(asked_.neighbours(), Outcome::same);
    if (seen == 0) return asked_.is_wrong_decision();
    const auto errors = asked_.errors_of(asked_.neighbours());
    if (!errors) return true;
    saw("The errors of cases were compared whose numbers are a few ulps away.",
        fmt::format("They are between {:.4g} and {:.4g}.", errors->first, errors->second));
    return seen >= least && errors->second >= spread * errors->first;
  }
  /// How far the worst number of the answer moves between the roundings, as a share of its error.
  double moved_by_rounding(const Trial& base, std::span<const Trial> roundings) const {
    const Finding full = trials().in_full(base);
    const MemberFinding* worst = full.headline_member();
    if (worst == nullptr || worst->worst < 0 || !(worst->forward_absolute > 0)) return 0;
    double furthest = 0;
    for (const Trial& t : roundings) {
      const bool is_wrong = t.outcome == Outcome::same || t.outcome == Outcome::other;
      const bool comparable =
          is_wrong && t.answer.status == Answer::Status::answered && t.answer.yes == base.answer.yes;
      const double by = t.answer.values[std::size_t(worst->worst)] - base.answer.values[std::size_t(worst->worst)];
      if (comparable && std::isfinite(by)) furthest = std::max(furthest, std::abs(by));
    }
    return furthest / worst->forward_absolute;
  }
  std::optional<Named> by_roundings(bool may_round) {
    if (asked_.roundings().empty()) {
      saw("The subject answers behind pipes.", "It cannot be asked in other rounding modes.");
      return std::nullopt;
    }
    const std::size_t right = count(asked_.roundings(), Outcome::right),
                      same = count(asked_.roundings(), Outcome::same);
    const double moved = moved_by_rounding(trials().base(), asked_.roundings());
    saw("The case was asked in the four rounding modes.",
        fmt::format(
            "The finding is there in {}, and the answer is right in {}. The worst number moves by {:.2g} % of its "
            "error.",
            same, right, 100 * moved));
    const bool depends = (right > 0 && may_round) || moved >= least_moved;
    others_depend_ = hold_for_others();
    const bool may_be_named = depends || (asked_.is_wrong_decision() && may_round);
    if (!others_depend_ || !may_be_named) return std::nullopt;
    is_right_by_rounding_ = right > 0 || count(asked_.neighbours(), Outcome::right) > 0;
    if (moved >= least_moved)
      return Named{CauseKind::rounding, "", "The error changes with the rounding mode: it consists of rounding errors.",
                   size_of_error()};
    return Named{CauseKind::rounding, "",
                 depends ? "The answer is right in another rounding mode."
                         : "Other answers with the finding are right in another rounding mode.",
                 size_of_error()};
  }
  /// Any error may be one of rounding where most cases depend on the mode, and some rounding of this one is right.
  std::vector<Prediction> size_of_error() const {
    std::vector<Prediction> made{Prediction::changes_by_rounding};
    if (!most_depend_ || !is_right_by_rounding_) made.push_back(Prediction::small_error);
    return made;
  }
  /// Whether most of the other cases with the finding depend on the rounding mode too. A case on a border depends on it
  /// by chance.
  bool hold_for_others() {
    std::size_t all = 0, depend = 0;
    for (std::size_t i = 0; i < asked_.similar_roundings().size(); ++i)
      all += 1, depend += depends_on_rounding(asked_.similar()[i], asked_.similar_roundings()[i]);
    saw("The other cases with the finding were asked in the four rounding modes.",
        fmt::format("{} of them are right in another mode, or their error changes.", of_text(depend, all)));
    most_depend_ = all >= least_others && most(depend, all);
    return proved_of_most(depend, all);
  }
  bool depends_on_rounding(const Trial& base, std::span<const Trial> asked) const {
    return count(asked, Outcome::right) > 0 || moved_by_rounding(base, asked) >= least_moved;
  }

  /// Behind pipes, the last bits of the inputs stand for the rounding modes: whether most of the other cases with the
  /// finding have a right answer nearby. A case on a border has one by chance.
  bool are_others_unstable() {
    constexpr std::size_t most_others = 8, of_each = 8;
    constexpr int ulps = 8;
    if (!asked_.roundings().empty() || asked_.similar().size() < least_others) return true;
    std::vector<Case> near;
    for (const Trial& t : std::span(asked_.similar()).first(std::min(most_others, asked_.similar().size()))) {
      const auto some = ulp_neighbours(t.question, of_each, ulps, asked_.seed() + near.size());
      near.insert(near.end(), some.begin(), some.end());
    }
    const std::vector<Trial> asked = trials().ask(near);
    std::size_t all = 0, unstable = 0;
    for (std::size_t i = 0; i < asked.size(); i += of_each) {
      const auto some = std::span(asked).subspan(i, of_each);
      ++all, unstable += count(some, Outcome::right) > 0;
    }
    saw("Cases were asked that are a few ulps away from other cases with the finding.",
        fmt::format("{} of these others have a right answer nearby.", of_text(unstable, all)));
    return proved_of_most(unstable, all);
  }

  /// Exactly moved toward the origin, in steps that halve the distance.
  std::optional<Named> far_from_the_origin() {
    const std::vector<Case> cases = moved_to_the_origin();
    if (cases.empty()) return std::nullopt;
    const std::vector<Trial> moved = trials().ask(cases);
    const std::size_t first = std::size_t(
        std::find_if(moved.begin(), moved.end(), [](const Trial& t) { return t.outcome != Outcome::same; }) -
        moved.begin());
    const std::size_t right = std::size_t(std::count_if(moved.begin() + std::ptrdiff_t(first), moved.end(),
                                                        [](const Trial& t) { return t.outcome == Outcome::right; }));
    saw("The scene was moved exactly toward the origin, by halves of its distance.",
        fmt::format("The finding stays in {} of {} steps, and then {} are right.", first, moved.size(), right));
    constexpr std::size_t least = 3, least_with_finding = 2;  // a case on a border loses the finding by any change
    if (first < least_with_finding || right < least || right != moved.size() - first) return std::nullopt;
    return Named{
        CauseKind::rounding,
        "far from the origin",
        "The answer is wrong far from the origin and right near it: coordinates lose the bits of the distances.",
        {Prediction::small_error, Prediction::changes_by_rounding}};
  }
  bool most_depend_ = false;  ///< of the other cases, on the rounding mode, which changes nothing but rounding errors
  bool is_right_by_rounding_ = false;  ///< in a rounding mode, or a few ulps away
  bool others_depend_ = true;          ///< on the rounding mode, where the subject can be asked in another

  std::vector<Case> moved_to_the_origin() const {
    std::vector<std::size_t> positions;
    std::vector<Case> cases;
    for (const Operand& o : question().operands()) {
      if (has_one_plane(o.shape)) return cases;
      positions.insert(positions.end(), o.positions.begin(), o.positions.end());
    }
    if (positions.empty()) return cases;
    const double* place = &question().values[positions.front()];
    for (int m = 1; m <= 24; ++m) {
      Case c = question();
      for (std::size_t n = 0; n < 3 * positions.size(); ++n) {
        const std::size_t k = n % 3, i = positions[n / 3] + k;
        const auto kept = metamorphic::exact_product(place[k], std::ldexp(1.0, -m), c.scalar);
        const auto shift = kept ? metamorphic::exact_sum(*kept, -place[k], c.scalar) : std::nullopt;
        const auto moved = shift ? metamorphic::exact_sum(c.values[i], *shift, c.scalar) : std::nullopt;
        if (!moved) return cases;
        c.values[i] = *moved;
      }
      if (c.values != question().values) cases.push_back(std::move(c));
    }
    return cases;
  }
};

}  // namespace

Tested certified_of(AskedCases& asked) {
  RoundingErrors test(asked);
  return test.finished(test.certified());
}

Tested rounding_mode_of(AskedCases& asked) {
  RoundingErrors test(asked);
  return test.finished(test.rounding_mode());
}

Tested rounding_of(AskedCases& asked) {
  RoundingErrors test(asked);
  return test.finished(test.rounding());
}

}  // namespace nearmiss
