#include "reports/triage/trials/touch_cases.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "corpus/generator/case_builder.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

/// A generated case, and the moves of its first operand along an axis.
class TouchOfCase {
 public:
  TouchOfCase(const Case& c, std::size_t axis) : c_(c), axis_(axis) {
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const Role role = c.role(i);
      if (role == Role::position || role == Role::size) largest_ = std::max(largest_, std::abs(c.values[i]));
    }
  }

  /// Cases with this decision at growing distances from the border; none where no border is near.
  std::vector<Case> with_decision(bool decision) const {
    const auto way = way_to_border();
    if (!way) return {};
    const double beyond = (exact_decision(c_) == decision ? -1 : 1) * std::copysign(largest_, *way);
    std::vector<Case> cases;
    for (int k = finest; k <= coarsest; k += step) cases.push_back(moved(*way + std::ldexp(beyond, k)));
    return cases;
  }

 private:
  static constexpr int finest = -44, coarsest = -8, step = 6;  ///< distances from the border, as powers of two

  Case moved(double by) const {
    Case other = c_;
    for (const std::size_t at : c_.operands()[0].positions)
      other.values[at + axis_] = rounded_to(c_.scalar, c_.values[at + axis_] + by);
    return other;
  }
  /// The move, with its sign, after which the exact decision is another.
  std::optional<double> way_to_border() const {
    constexpr int nearest = -4, furthest = 2, bisections = 48;
    const bool own = exact_decision(c_);
    for (int k = nearest; k <= furthest; ++k) {
      for (const double sign : {1.0, -1.0}) {
        double far = sign * std::ldexp(largest_, k), near = 0;
        if (!(largest_ > 0) || exact_decision(moved(far)) == own) continue;
        for (int n = 0; n < bisections; ++n) {
          const double middle = (near + far) / 2;
          (exact_decision(moved(middle)) == own ? near : far) = middle;
        }
        return far;
      }
    }
    return std::nullopt;
  }

  const Case& c_;
  std::size_t axis_;
  double largest_ = 0;
};

}  // namespace

std::vector<Trial> cases_at_touches(Trials& trials, std::span<const Trial> from, std::size_t most) {
  constexpr std::size_t most_tries = 32, axes = 3;
  std::vector<Trial> found;
  if (!decides(trials.query().kind)) return found;
  for (std::size_t i = 0; i < std::min(from.size(), most_tries) && found.size() < most && !trials.is_over(); ++i) {
    const TouchOfCase touch(from[i].question, i % axes);
    const std::vector<Trial> asked = trials.ask(touch.with_decision(trials.base().finding.truth_yes));
    const auto furthest =
        std::find_if(asked.rbegin(), asked.rend(), [](const Trial& t) { return t.outcome == Outcome::same; });
    if (furthest != asked.rend()) found.push_back(*furthest);
  }
  return found;
}

bool errs_beyond_touches(Trials& trials, std::span<const Trial> from) {
  constexpr std::size_t most_tries = 32, axes = 3;
  if (!decides(trials.query().kind)) return false;
  const auto is_wrong = [](const Trial& t) {
    const bool is_bad = t.outcome == Outcome::same || t.outcome == Outcome::other;
    return is_bad && t.answer.status == Answer::Status::answered && t.answer.yes != t.finding.truth_yes;
  };
  for (std::size_t i = 0; i < std::min(from.size(), most_tries) && !trials.is_over(); ++i) {
    const TouchOfCase touch(from[i].question, i % axes);
    const std::vector<Trial> asked = trials.ask(touch.with_decision(!trials.base().finding.truth_yes));
    if (std::any_of(asked.begin(), asked.end(), is_wrong)) return true;
  }
  return false;
}

}  // namespace nearmiss
