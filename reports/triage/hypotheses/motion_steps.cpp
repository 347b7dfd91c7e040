#include "reports/triage/hypotheses/hypotheses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

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
    std::set<double> given, exact;
    std::size_t all = 0;
    for (const Trial& t : moved) {
      if (t.answer.status != Answer::Status::answered || !t.answer.yes || !(given_time(t) > 0)) continue;
      ++all, given.insert(given_time(t));
      for (const Alternative& right : truth_of(t.question).alternatives) {
        if (right.yes) exact.insert(right.values[time_of(trials().query())].low);
      }
    }
    saw("The start was moved by different small distances.",
        fmt::format("{} different times of contact were given in {} answers, and {} are exact.", given.size(), all,
                    exact.size()));
    constexpr std::size_t least = 16, shared = 4;
    if (all < least || shared * given.size() > all || !most(exact.size(), all)) return std::nullopt;
    return Named{CauseKind::iteration_limit, "steps along the motion",
                 "The time is one of a few: the subject looks at few steps along the motion."};
  }

  /// The motion begins a little later each time. The error of the time then falls slowly and jumps back by the same
  /// amount again and again, where an interval is halved, or a step is made, a fixed number of times.
  std::optional<Named> errors_of_steps() {
    if (trials().query().kind != Kind::impact || !has_wrong_time()) return std::nullopt;
    const auto own = error_of_time(trials().base());
    if (!own || *own == 0) return std::nullopt;
    constexpr double far = 256, samples_in_jump = 4, longer = 4;
    double largest = 0;
    for (const double e : errors_from(far * std::abs(*own))) largest = std::max(largest, std::abs(e));
    std::optional<double> jump;
    double latest = largest / samples_in_jump * samples;
    for (int tries = 0; !jump && tries < 3; ++tries, latest *= longer) jump = equal_jumps(errors_from(latest));
    saw("The motion began later by different short times.",
        jump ? fmt::format("The error of the time falls and jumps back, by {:.3g} each time.", *jump)
             : "The errors of the time form no steps of one size.");
    if (!jump || !follows_scales()) return std::nullopt;
    return Named{CauseKind::iteration_limit, "steps of the time",
                 "The error of the time is that of a search in steps of one size, at every scale: it ends too early."};
  }

  /// The same motion begins later and later: the contact stays, and less and less of the way to it is left.
  std::optional<Named> starts_of_motion() {
    if (auto named = limits_of_time()) return named;
    const std::vector<Case> cases = later_starts();
    if (cases.empty() || (!asked_.roundings().empty() && !asked_.same_in_all_roundings())) return std::nullopt;
    const std::vector<Trial> later = trials().ask(cases);
    std::size_t right = 0, changes = 0;
    bool before = false;
    for (const Trial& t : later) {
      if (t.outcome == Outcome::none) continue;
      const bool ended = has_ended(t);
      right += ended, changes += ended != before;
      before = ended;
    }
    saw("The same motion began later, at points that come nearer and nearer to the contact.",
        fmt::format("The finding has ended in {}, and comes or goes {} times along the way.",
                    of_text(right, count_answered(later)), changes));
    constexpr std::size_t least_changes = 3, least_in_all = 4, least_right = 8;
    // A search in steps has one such change, and so has a formula that is wrong for all far starts.
    const bool is_either = changes == 1 && trials().base().finding.disagreement == Disagreement::false_miss;
    if (is_either && right >= least_right / 2)
      saw("The places at which the finding ends were counted.",
          "There is one: steps that are too few cannot be told from a mistake in the logic.", {CauseKind::logic});
    if (has_one_wrong_contact(later)) return std::nullopt;
    const bool comes_and_goes = changes >= least_changes && right >= least_right;
    if (!comes_and_goes && changes + changes_of_earlier_starts() < least_in_all) return std::nullopt;
    if (depends_on_last_bits(later)) return std::nullopt;
    return Named{CauseKind::iteration_limit,
                 "steps along the motion",
                 fmt::format("The answer depends on where the same motion begins, at every scale{}: the steps along "
                             "the motion are too few.",
                             asked_.and_in_every_rounding()),
                 {Prediction::at_every_scale, Prediction::in_every_rounding}};
  }

  /// Steps as long as the gap converge slowly where the motion grazes. A search that then gives up misses contacts
  /// below an angle, and finds those above it.
  std::optional<Named> grazing_contacts() {
    constexpr std::size_t least_missed = 8, least_found = 16;
    constexpr double least_sine = 0.02, most_sine = 0.5;  // a smaller one may be a tolerance of the angle
    if (trials().query().kind != Kind::impact || trials().base().finding.disagreement != Disagreement::false_miss)
      return std::nullopt;
    std::vector<double> missed, found;
    add_sine(trials().base(), missed);
    for (const auto* list : {&asked_.similar(), &asked_.sample()}) {
      for (const Trial& t : *list) {
        if (t.outcome == Outcome::same) add_sine(t, missed);
        if (t.outcome == Outcome::right) add_sine(t, found);
      }
    }
    if (missed.size() < least_missed || found.size() < least_found) return std::nullopt;
    const double steepest = *std::max_element(missed.begin(), missed.end());
    const auto below = std::size_t(std::count_if(found.begin(), found.end(), [&](double s) { return s < steepest; }));
    saw("The angles between the motion and the surface at the contact were compared.",
        fmt::format("The {} missed contacts have sines of at most {:.2g}; {} found ones have a smaller one.",
                    missed.size(), steepest, of_text(below, found.size())));
    if (steepest < least_sine || !nearly_all(found.size() - below, found.size())) return std::nullopt;
    if (steepest > most_sine) {
      saw("The largest of these angles was compared with those at which a search converges slowly.",
          "It is larger: what depends on the angle need not be a search, and cannot be told from a mistake in the "
          "logic.",
          {CauseKind::logic});
      return std::nullopt;
    }
    return Named{
        CauseKind::iteration_limit,
        "steps along the motion",
        fmt::format("Contacts are missed where the motion grazes, at every scale{}: a search that converges slowly "
                    "there ends too early.",
                    asked_.and_in_every_rounding()),
        {Prediction::at_every_scale, Prediction::in_every_rounding}};
  }

 private:
  static constexpr std::size_t samples = 64;

  /// The index of the time among the numbers of an impact.
  static std::size_t time_of(const Query& q) { return q.layout.at(Role::time)->begin; }
  static double given_time(const Trial& t) { return t.answer.values[time_of(*t.question.query)]; }

  /// The sine of the angle between the velocity and the surface at the exact contact, unless it is at the start.
  static void add_sine(const Trial& t, std::vector<double>& sines) {
    const auto& velocities = t.question.operands().velocities;
    const Layout::Part* normal = t.question.query->layout.at(Role::normal);
    if (velocities.empty() || normal == nullptr || !t.finding.truth_yes) return;
    const double* v = &t.question.values[velocities[0]];
    for (const Alternative& right : truth_of(t.question).alternatives) {
      if (!right.yes || right.many_normals || normal->end > right.count) continue;
      if (right.values[time_of(*t.question.query)].low <= 0) continue;
      double along = 0;
      for (std::size_t k = 0; k < 3; ++k)
        along += v[k] * (right.values[normal->begin + k].low + right.values[normal->begin + k].high) / 2;
      sines.push_back(std::abs(along) / std::hypot(v[0], v[1], v[2]));
      return;
    }
  }

  /// A contact within a time is one within each longer time.
  std::optional<Named> limits_of_time() {
    constexpr std::size_t least = 2;
    if (!asked_.is_wrong_decision() || !trials().base().finding.truth_yes) return std::nullopt;
    const std::vector<Trial> shorter = trials().ask(with_shorter_limits());
    if (shorter.empty()) return std::nullopt;
    const std::size_t right = count(shorter, Outcome::right);
    saw("The time was limited to shorter times after the contact.",
        fmt::format("{} answers are right.", of_text(right, count_answered(shorter))));
    if (right < least) return std::nullopt;
    return Named{CauseKind::iteration_limit, "steps along the motion",
                 "A contact is found within a shorter time, and missed within a longer one: the steps along the motion "
                 "are too few."};
  }
  /// The index of the limit of time of a decision about a motion.
  std::optional<std::size_t> limit_of_time() const {
    const Query& q = trials().query();
    if (q.kind != Kind::decision || q.operands.velocities.empty()) return std::nullopt;
    const InputMember* limit = question().operands().at(Role::time);
    return limit == nullptr ? std::nullopt : std::optional(limit->begin);
  }
  /// The case with a limit in place of any time.
  Case with_limit(std::size_t limit, double time) const {
    Case c = question();
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (c.role(i) == Role::flag) c.values[i] = 0;
    }
    c.values[limit] = c.scalar == Scalar::float32 ? double(float(time)) : time;
    return c;
  }
  /// From just after the contact to the limit of the case, or to many times of the contact where it has none.
  std::vector<Case> with_shorter_limits() const {
    constexpr double least = 1.01, most = 0x1p20;
    std::vector<Case> cases;
    const auto limit = limit_of_time();
    const double time = contact_time();
    if (!limit || !(time > 0)) return cases;
    const bool is_limited = with_limit(*limit, question().values[*limit]).values == question().values;
    const double longest = is_limited ? question().values[*limit] / time : most;
    for (std::size_t m = 0; m < samples; ++m)
      cases.push_back(with_limit(*limit, time * least * std::pow(longest / least, double(m) / samples)));
    std::erase_if(cases, [](const Case& c) { return !exact_decision(c); });
    return cases;
  }

  bool has_wrong_time() const {
    const Finding full = trials().in_full(trials().base());
    const MemberFinding* member = full.headline_member();
    return member != nullptr && member->worst == int(time_of(trials().query())) && trials().base().answer.yes &&
           !asked_.is_wrong_decision();
  }
  /// Whether starts that are a few ulps away end the finding, or bring it back. The places at which a search in steps
  /// finds the contact have borders, and none of them is so near to more than one start.
  bool depends_on_last_bits(const std::vector<Trial>& later) {
    constexpr std::size_t most_different = 1;
    constexpr int ulps = 8;
    std::vector<Case> twins;
    for (const Trial& t : later)
      twins.push_back(ulp_neighbours(t.question, 1, ulps, asked_.seed() + twins.size()).front());
    const std::vector<Trial> asked = trials().ask(twins);
    std::size_t different = 0, all = 0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const bool is_alike = asked[i].finding.truth_yes == later[i].finding.truth_yes;
      if (asked[i].outcome == Outcome::none || later[i].outcome == Outcome::none || !is_alike) continue;
      ++all, different += has_ended(asked[i]) != has_ended(later[i]);
    }
    if (different <= most_different) return false;
    saw("The numbers of these later motions were moved by a few ulps.",
        fmt::format("In {} the finding comes or goes: what tells them apart is rounding, and no step.",
                    of_text(different, all)),
        {CauseKind::iteration_limit});
    return true;
  }
  /// Wherever the motion begins, a wrong contact is the same one: a search that ends too early finds another one from
  /// each start.
  bool has_one_wrong_contact(const std::vector<Trial>& later) {
    constexpr std::size_t least = 4;
    constexpr double tolerated = 1e-6;  // of the error, for the rounding of the starts
    const auto own = error_of_time(trials().base());
    if (!own || *own == 0) return false;
    std::size_t wrong = 0, alike = 0;
    for (const Trial& t : later) {
      if (has_ended(t) || t.outcome == Outcome::none) continue;
      const auto error = error_of_time(t);
      ++wrong, alike += error && std::abs(*error - *own) <= tolerated * std::abs(*own);
    }
    if (wrong < least || alike != wrong) return false;
    saw("The wrong contacts of the later starts were compared.", "They are at one place.");
    return true;
  }
  /// The given time less the exact one; empty where one of them is no contact, and where answers have no time.
  static std::optional<double> error_of_time(const Trial& t) {
    const Layout::Part* time = t.question.query->layout.at(Role::time);
    if (time == nullptr || t.answer.status != Answer::Status::answered || !t.answer.yes) return std::nullopt;
    for (const Alternative& right : truth_of(t.question).alternatives) {
      if (right.yes)
        return t.answer.values[time->begin] - (right.values[time->begin].low + right.values[time->begin].high) / 2;
    }
    return std::nullopt;
  }
  /// The errors of the time of motions that begin later, evenly up to `latest`; none where one of them has no contact.
  std::vector<double> errors_from(double latest) {
    std::vector<Case> cases;
    for (std::size_t m = 0; m < samples; ++m) {
      if (auto later = begun_later(latest * double(m) / samples)) cases.push_back(std::move(*later));
    }
    std::vector<double> errors;
    for (const Trial& t : trials().ask(cases)) {
      const auto error = error_of_time(t);
      if (!error || *error == given_time(t)) return {};
      errors.push_back(*error);
    }
    return errors;
  }
  /// The size of the jumps of a sawtooth: all differences of neighbours are nearly one small value, but for at least
  /// four, which are larger by nearly one amount.
  static std::optional<double> equal_jumps(const std::vector<double>& errors) {
    constexpr std::size_t least = 4;
    constexpr double tolerated = 0.1;  // of the sawtooth's height
    if (errors.size() < samples) return std::nullopt;
    const auto [low, high] = std::minmax_element(errors.begin(), errors.end());
    const double height = *high - *low;
    std::vector<double> changes;
    for (std::size_t i = 1; i < errors.size(); ++i) changes.push_back(errors[i] - errors[i - 1]);
    std::vector<double> sorted = changes;
    std::sort(sorted.begin(), sorted.end());
    const double usual = sorted[sorted.size() / 2];
    std::vector<double> jumps;
    for (const double c : changes) {
      if (std::abs(c - usual) > tolerated * height) jumps.push_back(c - usual);
    }
    if (!(height > 0) || jumps.size() < least || 2 * jumps.size() > changes.size()) return std::nullopt;
    const auto [least_jump, most_jump] = std::minmax_element(jumps.begin(), jumps.end());
    const bool are_equal = *most_jump - *least_jump <= tolerated * height;
    return are_equal ? std::optional(std::abs(*least_jump + *most_jump) / 2) : std::nullopt;
  }
  /// Whether the error, as a share of the time, is the same at each near scale: the steps are no absolute tolerance.
  bool follows_scales() {
    constexpr int nearest = 8;
    constexpr double tolerated = 0.01;
    const double own = given_time(trials().base()), error = error_of_time(trials().base()).value_or(0);
    return std::all_of(asked_.scans().begin(), asked_.scans().end(), [&](const ScaleScan& s) {
      return std::all_of(s.trials.begin(), s.trials.end(), [&](const ScaleScan::At& a) {
        if (std::abs(a.k) > nearest || a.trial.outcome == Outcome::none) return true;
        const auto e = error_of_time(a.trial);
        return e && std::abs(*e / given_time(a.trial) - error / own) <= tolerated * std::abs(error / own);
      });
    });
  }
  /// The motion that begins where this one is after a time; empty where the numbers leave the range.
  std::optional<Case> begun_later(double passed) const {
    const auto& start = trials().query().operands.start;
    const auto& velocities = trials().query().operands.velocities;
    if (!start || velocities.empty()) return std::nullopt;
    Case c = question();
    for (std::size_t k = 0; k < 3; ++k) c.values[start->place + k] += passed * c.values[velocities[0] + k];
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (c.role(i) == Role::time) c.values[i] = std::max(0.0, c.values[i] - passed);
      if (c.scalar == Scalar::float32) c.values[i] = double(float(c.values[i]));
    }
    return c;
  }
  std::vector<Case> with_moved_starts() const {
    std::vector<Case> cases;
    const auto& start = trials().query().operands.start;
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
    const double time = contact_time();
    if (!(time > 0)) return cases;
    constexpr int starts = 64, halvings = 36;
    const auto add = [&](double passed) {
      auto later = begun_later(passed);
      if (later && exact_decision(*later) == trials().base().finding.truth_yes) cases.push_back(std::move(*later));
    };
    // At uneven distances, so that the starts do not keep pace with the steps.
    for (int m = 1; m <= starts; ++m) add(time * (m + std::sin(double(m)) / 2) / (starts + 1));
    for (int m = 6; m <= halvings; ++m) add(time * (1 - std::ldexp(1.0, -m)));
    return cases;
  }
  /// The earliest limit of time at which the exact decision is yes; 0 where the query has no such limit.
  double time_of_decision() const {
    constexpr int bisections = 40, earliest = -60, latest = 60;
    const auto limit = limit_of_time();
    const auto is_hit = [&](double time) { return exact_decision(with_limit(*limit, time)); };
    if (!limit || is_hit(0)) return 0;
    int k = earliest;
    while (k < latest && !is_hit(std::ldexp(1.0, k))) ++k;
    if (k == latest) return 0;
    double high = std::ldexp(1.0, k), low = k == earliest ? 0 : high / 2;
    for (int n = 0; n < bisections; ++n) (is_hit((low + high) / 2) ? high : low) = (low + high) / 2;
    return high;
  }
  /// How often the finding comes or goes while the motion begins further and further before the case.
  std::size_t changes_of_earlier_starts() {
    constexpr int starts = 64;
    const double time = contact_time();
    std::vector<Case> cases;
    for (int m = 1; m <= starts; ++m) {
      auto earlier = begun_later(-time * (m + std::sin(double(m)) / 2) / starts);
      if (earlier && exact_decision(*earlier) == trials().base().finding.truth_yes)
        cases.push_back(std::move(*earlier));
    }
    std::size_t changes = 0;
    bool before = false;
    for (const Trial& t : trials().ask(cases)) {
      if (t.outcome == Outcome::none) continue;
      const bool ended = has_ended(t);
      changes += ended != before;
      before = ended;
    }
    saw("The same motion began earlier.", fmt::format("The finding comes or goes {} times.", changes));
    return changes;
  }
  /// Of the exact answer, or else of the given one; 0 where there is none.
  double contact_time() const {
    if (trials().query().kind == Kind::decision) return time_of_decision();
    if (trials().query().kind != Kind::impact) return 0;
    for (const Alternative& right : truth_of(question()).alternatives) {
      if (right.yes) return std::max(0.0, right.values[time_of(trials().query())].low);
    }
    const Answer& a = trials().base().answer;
    const double given = given_time(trials().base());
    return a.status == Answer::Status::answered && a.yes && std::isfinite(given) ? std::max(0.0, given) : 0;
  }
};

}  // namespace

Tested times_of_steps_of(AskedCases& asked) {
  MotionSteps test(asked);
  return test.finished(test.times_of_steps());
}

Tested errors_of_steps_of(AskedCases& asked) {
  MotionSteps test(asked);
  return test.finished(test.errors_of_steps());
}

Tested starts_of_motion_of(AskedCases& asked) {
  MotionSteps test(asked);
  return test.finished(test.starts_of_motion());
}

Tested grazing_contacts_of(AskedCases& asked) {
  MotionSteps test(asked);
  return test.finished(test.grazing_contacts());
}

}  // namespace nearmiss
