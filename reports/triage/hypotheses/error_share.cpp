#include "reports/triage/hypotheses/hypotheses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "oracles/judge.hpp"
#include "oracles/requirements.hpp"
#include "reports/triage/geometry/ratios.hpp"
#include "reports/triage/hypotheses/written_constant.hpp"
#include "reports/triage/trials/touch_cases.hpp"

namespace nearmiss {

namespace {

class ErrorShare : public TestOfCause {
 public:
  using TestOfCause::TestOfCause;

  std::optional<Named> one_share() {
    if (!find_part()) return std::nullopt;
    collect(trials().base());
    for (const auto* list : {&asked_.sample(), &asked_.similar()}) {
      for (const Trial& t : *list) {
        if (cases_ < most_cases && !trials().is_over()) collect(t);
      }
    }
    if (cases_ < least_cases) return std::nullopt;
    const auto best = best_candidate();
    saw(fmt::format("The errors of {} cases with the finding were compared with their lengths.", cases_),
        best ? fmt::format("In {}, {} is between {:.5g} and {:.5g}.", of_text(best->cases, cases_), best->name,
                           best->low, best->high)
             : "They are one share of none.");
    if (!best) return std::nullopt;
    return Named{CauseKind::relative_tolerance,
                 best->constant.text,
                 fmt::format("The answer is off by {} (unit 1): {} has this value in nearly all cases.",
                             best->constant.text, best->name),
                 {Prediction::at_every_scale}};
  }

  /// The rest of what a tolerance does: errors that are bounded by a small share.
  std::optional<Named> small_errors() {
    constexpr double least = 0x1p-36;
    if (!stays_in_every_rounding() || !is_same_at_every_scale() || !stays_nearby()) return std::nullopt;
    const double largest = largest_error();
    if (largest <= most_share_without_logic() || share_of(trials().base()) <= most_share) asked_.set_small_errors();
    if (largest > most_share || largest < least || asked_.roundings().empty()) return std::nullopt;
    // A search along a motion that ends too early has small errors too.
    if (!trials().query().operands.velocities.empty()) return std::nullopt;
    constexpr double of_floats = 0x1p-22;  // two numbers, each rounded to a float
    const bool may_be_floats =
        largest <= of_floats && trials().subject().scalar == Scalar::float64 && !numbers_err_to_one_side();
    if (may_be_floats && (trials().query().kind != Kind::decision || errs_on_both_sides()))
      return Named{
          CauseKind::rounding, "single precision",
          fmt::format("Every wrong answer is right for numbers that differ by less than {:.2g} of their size, at "
                      "every scale and in every rounding mode: the subject computes or compares floats.",
                      2 * largest)};
    return Named{
        CauseKind::relative_tolerance,
        "",
        fmt::format("Every wrong answer is right for numbers that differ by less than {:.2g} of their size, at "
                    "every scale and in every rounding mode: the subject has a relative tolerance.",
                    2 * largest),
        {Prediction::at_every_scale, Prediction::in_every_rounding}};
  }

 private:
  static constexpr double most_share = 0x1p-9;  ///< of a tolerance
  static constexpr std::size_t most_cases = 12, least_cases = 6, least_varied = 4;
  static constexpr double largest_share = 0.02, spread = 1.002, written = 1.001, variety = 1.5;

  /// The error of a case as a share of a length, or of 1.
  struct Share {
    double value = 0, length = 0;
    std::size_t of_case = 0;
    friend bool operator<(const Share& a, const Share& b) { return a.value < b.value; }
  };
  struct Candidate {
    std::string name;
    std::size_t cases = 0;
    double low = 0, high = 0;
    WrittenConstant constant;
  };

  bool find_part() {
    const Finding full = trials().in_full(trials().base());
    const MemberFinding* member = full.headline_member();
    if (member == nullptr || member->worst < 0 || trials().base().answer.status != Answer::Status::answered)
      return false;
    for (const Layout::Part& p : trials().query().layout.parts) {
      if (p.begin <= std::size_t(member->worst) && std::size_t(member->worst) < p.end) part_ = p;
    }
    return part_.role != Role::index && part_.role != Role::flag && part_.end > part_.begin;
  }
  /// The distance of the given member from that of the nearest exact answer, and the length of the exact one.
  struct Error {
    double distance = 0, largest = 0, length = 0;
    std::vector<double> exact;
  };
  std::optional<Error> error_of(const Trial& t) const {
    std::optional<Error> nearest;
    for (const Alternative& right : truth_of(t.question).alternatives) {
      if (!right.yes || right.many_normals || right.count < part_.end) continue;
      Error e;
      for (std::size_t i = 0; i < right.count; ++i)
        e.exact.push_back(right.values[i].low + (right.values[i].high - right.values[i].low) / 2);
      for (std::size_t i = part_.begin; i < part_.end; ++i) {
        e.distance = std::hypot(e.distance, t.answer.values[i] - e.exact[i]);
        e.largest = std::max(e.largest, std::abs(t.answer.values[i] - e.exact[i]));
        e.length = std::hypot(e.length, e.exact[i]);
      }
      if (!nearest || e.distance < nearest->distance) nearest = std::move(e);
    }
    return nearest;
  }
  /// The length of a vector along the normal of the exact answer; 0 where the answer has none.
  static double along_normal(const Query& q, const Error& e, const std::array<double, 3>& v) {
    const auto& parts = q.layout.parts;
    const auto normal =
        std::find_if(parts.begin(), parts.end(), [](const Layout::Part& p) { return p.role == Role::normal; });
    if (normal == parts.end()) return 0;
    double along = 0;
    for (std::size_t k = 0; k < 3; ++k) along += e.exact[normal->begin + k] * v[k];
    return std::abs(along);
  }
  static double speed_along_normal(const Case& c, const Error& e) {
    const auto& velocities = c.operands().velocities;
    if (velocities.empty()) return 0;
    const double* v = &c.values[velocities[0]];
    return along_normal(*c.query, e, {v[0], v[1], v[2]});
  }
  double distance_along_normal(const Trial& t, const Error& e) const {
    if (part_.end - part_.begin != 3) return 0;
    std::array<double, 3> by;
    for (std::size_t k = 0; k < 3; ++k) by[k] = t.answer.values[part_.begin + k] - e.exact[part_.begin + k];
    return along_normal(*t.question.query, e, by);
  }
  static double speed_of(const Case& c) {
    const auto& velocities = c.operands().velocities;
    if (velocities.empty()) return 0;
    const double* v = &c.values[velocities[0]];
    return std::hypot(v[0], v[1], v[2]);
  }
  void collect(const Trial& t) {
    if (t.outcome != Outcome::same || t.answer.status != Answer::Status::answered || !t.finding.truth_yes) return;
    const auto e = error_of(t);
    if (!e || !(e->distance > 0)) return;
    const std::size_t of_case = cases_++;
    const auto add = [&](const std::string& name, double error, double of) {
      if (of > 0 && error > 0 && std::isfinite(error / of)) shares_[name].push_back({error / of, of, of_case});
    };
    add("the error over the exact value", e->distance, e->length);
    const bool is_pure = part_.role == Role::normal || part_.role == Role::weight || part_.role == Role::direction;
    if (is_pure) {
      add("the error", e->distance, 1);
      add("the error of one number", e->largest, 1);
    }
    const auto over_lengths = [&](const std::string& name, double error) {
      for (const Magnitude& length : magnitudes_of(t.question).lengths)
        add(name + " over " + without_numbers(length.name), error, double(length.value));
    };
    if (is_length(part_.role)) over_lengths("the error", e->distance);
    if (part_.role == Role::position) {
      over_lengths("the error of one number", e->largest);
      over_lengths("the error along the normal", distance_along_normal(t, *e));
    }
    if (part_.role == Role::time) {
      over_lengths("the error of the time, times the speed,", e->distance * speed_of(t.question));
      over_lengths("the error of the time, times the speed along the normal,",
                   e->distance * speed_along_normal(t.question, *e));
    }
  }

  /// The share that has one written value in nearly all cases while the length varies; powers of ten first.
  std::optional<Candidate> best_candidate() const {
    std::optional<Candidate> best;
    for (const auto& [name, shares] : shares_) {
      const auto c = candidate(name, shares);
      if (c && (!best || c->constant.rank < best->constant.rank)) best = c;
    }
    return best;
  }
  std::optional<Candidate> candidate(const std::string& name, std::vector<Share> all) const {
    const bool is_family = all.size() > cases_;  // lengths of several axes, corners or edges
    std::sort(all.begin(), all.end());
    std::vector<int> count(cases_, 0);
    std::size_t begin = 0, now = 0, most = 0;
    std::span<const Share> window;
    for (std::size_t end = 0; end < all.size(); ++end) {
      now += count[all[end].of_case]++ == 0;
      for (; all[end].value > spread * all[begin].value; ++begin) now -= --count[all[begin].of_case] == 0;
      if (now > most) most = now, window = std::span(all).subspan(begin, end + 1 - begin);
    }
    if (most < least_cases || !nearly_all(most, cases_)) return std::nullopt;
    const double low = window.front().value, high = window.back().value;
    const auto constant = written_constant(low, high, written);
    if (!constant || high > largest_share || low < least_share()) return std::nullopt;
    if (is_family && constant->rank > 0) return std::nullopt;
    const bool is_pure = name == "the error" || name == "the error of one number";
    const auto differs = [&](const Share& a) {
      return std::max(a.length / window[0].length, window[0].length / a.length) > variety;
    };
    const auto varied = std::size_t(std::count_if(window.begin(), window.end(), differs));
    if (!is_pure && varied < least_varied) return std::nullopt;
    return Candidate{name, most, low, high, *constant};
  }
  /// Smaller ones are rounding errors.
  double least_share() const {
    constexpr double ulps = 256;
    return ulps * unit_roundoff(question().scalar);
  }

  /// What is searched for as the nearest of many is known to the root of the tolerance alone: a point that is further
  /// than the nearest one by a share e lies in a direction that differs by the angle of cosine 1/(1 + e), which is at
  /// most the root of 2 e. So may the normal and the place of an overlap or a distance.
  double most_share_without_logic() {
    const bool is_nearest = find_part() && (part_.role == Role::normal || part_.role == Role::direction ||
                                            (part_.role == Role::position && !question().operands().start));
    return is_nearest ? std::sqrt(2 * most_share) : most_share;
  }
  /// The largest proved backward error, as a share; infinite where too few cases have the finding.
  double largest_error() {
    constexpr std::size_t least_seen = 8;
    double largest = 0;
    std::size_t seen = 0;
    const auto see = [&](const Trial& t) {
      const bool is_wrong = t.outcome == Outcome::same || t.outcome == Outcome::other;
      if (is_wrong && seen < most_cases && !trials().is_over()) largest = std::max(largest, share_of(t)), ++seen;
    };
    see(trials().base());
    std::for_each(asked_.sample().begin(), asked_.sample().end(), see);
    std::for_each(asked_.similar().begin(), asked_.similar().end(), see);
    saw(fmt::format("The proved backward errors of {} cases were compared.", seen),
        fmt::format("The largest is {:.2g} of the numbers.", largest));
    return seen < least_seen ? INFINITY : largest;
  }
  double share_of(const Trial& t) const {
    const Finding full = trials().in_full(t);
    return full.backward ? full.backward->above * 2 * unit_roundoff(question().scalar) : 1;
  }
  /// Errors of a number that have one sign in all of at least eight cases are none of rounding.
  bool numbers_err_to_one_side() {
    constexpr std::size_t least = 8;
    if (!find_part() || part_.end - part_.begin != 1) return false;
    std::size_t above = 0, below = 0;
    for (const auto* list : {&asked_.sample(), &asked_.similar()}) {
      for (const Trial& t : *list) {
        if (t.outcome != Outcome::same || above + below == most_cases || trials().is_over()) continue;
        const auto e = error_of(t);
        if (!e || !(e->distance > 0)) continue;
        (t.answer.values[part_.begin] > e->exact[part_.begin] ? above : below) += 1;
      }
    }
    if (above + below < least) return false;
    saw(fmt::format("The signs of the errors of {} cases were compared.", above + below),
        fmt::format("{} numbers are too large, and {} too small.", above, below));
    return std::min(above, below) == 0;
  }
  bool errs_on_both_sides() {
    const bool both = errs_beyond_touches(trials(), asked_.sample());
    saw("Generated cases were moved to where the exact decision changes.",
        both ? "There are false hits and false misses: a tolerance errs to one side."
             : "All wrong decisions are of one kind.");
    return both;
  }
  /// Behind pipes there is one rounding mode, and the last bits of the inputs stand for the others.
  bool stays_in_every_rounding() { return asked_.roundings().empty() || asked_.same_in_all_roundings(); }
  bool is_same_at_every_scale() const {
    return std::none_of(asked_.scans().begin(), asked_.scans().end(),
                        [](const ScaleScan& s) { return s.has_clean_flip(); });
  }
  bool stays_nearby() {
    const std::vector<Trial>& near = asked_.neighbours();
    return nearly_all(count(near, Outcome::same) + count(near, Outcome::other), count_answered(near));
  }

  Layout::Part part_{};
  std::map<std::string, std::vector<Share>> shares_;  ///< by the names of their lengths
  std::size_t cases_ = 0;
};

}  // namespace

Tested error_share_of(AskedCases& asked) {
  ErrorShare test(asked);
  return test.finished(test.one_share());
}

Tested small_errors_of(AskedCases& asked) {
  ErrorShare test(asked);
  return test.finished(test.small_errors());
}

}  // namespace nearmiss
