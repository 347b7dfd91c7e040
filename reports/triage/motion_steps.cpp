#include "reports/triage/motion_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

class MotionSteps : public TestOfCause {
 public:
  using TestOfCause::TestOfCause;

  /// The start moves a little, so that the exact times differ, and the given times are few.
  std::optional<Named> times_of_steps() {
    if (trials().query().kind != Kind::impact || !trials().base().answer.yes) return std::nullopt;
    const std::vector<Trial> moved = trials().ask(with_moved_starts());
    std::vector<double> times;
    for (const Trial& t : moved) {
      if (t.answer.status == Answer::Status::answered && t.answer.yes && t.answer.values[0] > 0)
        times.push_back(t.answer.values[0]);
    }
    const std::size_t all = times.size();
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    saw("The start was moved by different small distances.",
        fmt::format("{} different times of contact were given in {} answers.", times.size(), all));
    constexpr std::size_t least = 16, shared = 4;
    if (all < least || shared * times.size() > all) return std::nullopt;
    return Named{CauseKind::iteration_limit, "steps along the motion",
                 "The time is one of a few: the subject looks at few steps along the motion."};
  }

  /// The same motion begins later and later: the contact stays, and less and less of the way to it is left.
  std::optional<Named> starts_of_motion() {
    const std::vector<Case> cases = later_starts();
    if (cases.empty() || (!asked_.roundings().empty() && !asked_.same_in_all_roundings())) return std::nullopt;
    const std::vector<Trial> later = trials().ask(cases);
    std::size_t right = 0, changes = 0, last_wrong = 0;
    bool before = false;
    for (std::size_t i = 0; i < later.size(); ++i) {
      const bool ended = has_ended(later[i]);
      right += ended, changes += ended != before;
      if (!ended) last_wrong = i;
      before = ended;
    }
    saw("The same motion began later, at points that come nearer and nearer to the contact.",
        fmt::format("The finding has ended in {}, and comes or goes {} times along the way.",
                    of_text(right, later.size()), changes));
    constexpr std::size_t least_changes = 3;
    const bool ends = changes == 1 && last_wrong + 1 < later.size();
    if (!ends && changes < least_changes) return std::nullopt;
    return Named{CauseKind::iteration_limit, "steps along the motion",
                 "The answer depends on where the same motion begins, in every rounding mode and at every scale: the "
                 "steps along the motion are too few."};
  }

 private:
  std::vector<Case> with_moved_starts() const {
    std::vector<Case> cases;
    const auto& start = parts_of(trials().query()).start;
    if (!start) return cases;
    constexpr std::size_t starts = 64;
    for (std::size_t n = 1; n <= starts; ++n) {
      Case c = question();
      constexpr int furthest = -6;  // as a power of two of the largest length
      const double by = std::ldexp(double(n) / starts, largest_exponent_of(c) + furthest);
      for (std::size_t k = 0; k < 3; ++k) {
        double& x = c.values[start->place + k];
        x = c.scalar == Scalar::float32 ? double(float(x + by)) : x + by;
      }
      cases.push_back(std::move(c));
    }
    return cases;
  }
  /// The answer is right or, where the finding is a wrong decision, the decision is.
  bool has_ended(const Trial& t) const {
    if (t.outcome == Outcome::right) return true;
    return t.outcome == Outcome::other && asked_.is_wrong_decision() && t.answer.status == Answer::Status::answered &&
           t.answer.yes == t.finding.truth_yes;
  }
  std::vector<Case> later_starts() const {
    std::vector<Case> cases;
    const auto& start = parts_of(trials().query()).start;
    const auto& velocities = parts_of(trials().query()).velocities;
    const double time = contact_time();
    if (!start || velocities.empty() || !(time > 0)) return cases;
    constexpr int starts = 32;
    for (int m = 1; m <= starts; ++m) {
      Case c = question();
      const double passed = time * m / (starts + 1);
      for (std::size_t k = 0; k < 3; ++k) c.values[start->place + k] += passed * c.values[velocities[0] + k];
      for (std::size_t i = 0; i < c.values.size(); ++i) {
        const Role role = c.query->inputs[i].role;
        if (role == Role::time) c.values[i] = std::max(0.0, c.values[i] - passed);
        if (c.scalar == Scalar::float32) c.values[i] = double(float(c.values[i]));
      }
      cases.push_back(std::move(c));
    }
    return cases;
  }
  /// Of the exact answer, or else of the given one; 0 where there is none.
  double contact_time() const {
    if (trials().query().kind != Kind::impact) return 0;
    for (const Alternative& right : truth_of(question()).alternatives) {
      if (right.yes) return std::max(0.0, right.values[0].low);
    }
    const Answer& a = trials().base().answer;
    return a.status == Answer::Status::answered && a.yes && std::isfinite(a.values[0]) ? std::max(0.0, a.values[0]) : 0;
  }
};

}  // namespace

Tested times_of_steps_of(AskedCases& asked) {
  MotionSteps test(asked);
  return test.finished(test.times_of_steps());
}

Tested starts_of_motion_of(AskedCases& asked) {
  MotionSteps test(asked);
  return test.finished(test.starts_of_motion());
}

}  // namespace nearmiss
