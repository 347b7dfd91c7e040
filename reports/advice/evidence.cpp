#include "reports/advice/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "oracles/motion_numbers.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/interrupt.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t asked_at_once = 256;  ///< cases; few, so that an interrupt takes effect soon

/// An answer, and upper bounds of its errors where intervals alone judged it.
struct BoundedAnswer {
  TradeAnswer answer;
  double distance_at_most = 0, time_at_most = 0;
  bool by_intervals = false;
};

/// The largest distance of a member of this role from the exact one, in its own unit. Each lies within
/// Finding::forward_at_most ulps of its largest number.
template <class Is>
double error_at_most(const Case& question, const Answer& answer, const Finding& f, Is is) {
  double most = 0;
  for (const Layout::Part& part : question.query->layout.parts) {
    if (!is(part.role)) continue;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (answer.gives(i) && std::isfinite(answer.values[i]))
        most = std::max(most, f.forward_at_most * ulp(answer.values[i], question.scalar));
    }
  }
  return most;
}

/// True where every number that the answer gives has a value to compare: a miss gives an infinite time and no other.
/// The time of leaving may be infinite.
bool is_regular(const Query& query, const Answer& answer) {
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (!answer.gives(i)) continue;
    if (query.kind == Kind::impact && !answer.yes) {
      if (query.outputs[i].role == Role::time && answer.values[i] != HUGE_VAL) return false;
    } else if (!std::isfinite(answer.values[i]) && !(answer.values[i] == HUGE_VAL && is_time_of_leaving(query, i))) {
      return false;
    }
  }
  return true;
}

/// Both bounds of the largest error of the given numbers with this role, by intervals.
template <class Is>
LargestError enclosed_error(const Query& query, const Answer& answer, const Enclosure& e, Is is) {
  LargestError largest;
  if (query.kind == Kind::impact && !answer.yes) return largest;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (!is(query.outputs[i].role) || !answer.gives(i) || e.error[i].empty()) continue;
    largest.proved = std::max(largest.proved, e.error[i].nearest_to_zero());
    largest.at_most = std::max(largest.at_most, e.error[i].furthest_from_zero());
  }
  return largest;
}

/// The share of the tolerance that the proved error uses up.
double use_of(const TradeAnswer& a, const TradeTolerance& t) {
  const auto share = [](double error, double limit) { return error == 0 ? 0 : error / limit; };
  if (a.not_finite) return HUGE_VAL;
  if (a.missed) return share(a.shift, t.missed_depth);
  if (a.phantom) return share(a.shift, t.error);
  return std::max(share(a.distance, t.error), t.time ? share(a.time, *t.time) : 0);
}

class EvidenceMeasurement {
 public:
  EvidenceMeasurement(const EvidenceSettings& settings, Dispatcher& dispatcher, InternalErrors& internal_errors)
      : settings_(settings),
        tolerance_(settings.source->tolerance),
        dispatcher_(dispatcher),
        internal_errors_(internal_errors),
        required_(settings.subject->offering(settings.query->name).required),
        standard_(unbounded_standard(settings.subject->standard_for(settings.query->name).declared)) {
    e_.subject = settings.subject;
    e_.query = settings.query;
    e_.seed = settings.seed;
    e_.cases = settings.cases;
  }

  SceneEvidence measure(const std::function<bool(std::uint64_t)>& goes_on) {
    for (std::uint64_t at = 0; at < settings_.cases && !interrupted(); at += asked_at_once) {
      const std::uint64_t count = std::min<std::uint64_t>(asked_at_once, settings_.cases - at);
      ask(at, std::size_t(count));
      if (!goes_on(count) || (settings_.until_failure && has_failed())) break;
    }
    e_.missed_deeper = rate_of(missed_deeper_, contacts_);
    e_.phantom_wider = rate_of(phantom_wider_, reported_);
    return std::move(e_);
  }

 private:
  /// True where a requirement fails whatever the answers to the cases that are left.
  bool has_failed() const {
    const double all = double(settings_.cases);
    return e_.unanswered > 0 || e_.not_finite > 0 || e_.distance.proved > tolerance_.error ||
           (tolerance_.time && e_.time.proved > *tolerance_.time) ||
           double(missed_deeper_) > tolerance_.missed_rate * all ||
           double(phantom_wider_) > tolerance_.phantom_rate * all;
  }

  void ask(std::uint64_t first, std::size_t count) {
    std::vector<Case> drawn(count), asked;
    for (std::size_t i = 0; i < count; ++i)
      settings_.source->draw(drawn[i], *settings_.query, settings_.seed, first + i, required_);
    for (const Case& c : drawn) asked.push_back(asked_case(c, settings_.subject->scalar));
    const Subject* const only[] = {settings_.subject};
    dispatcher_.ask(only, asked, {}, [&](const Subject&, std::span<const Answer> answers) {
      for (std::size_t i = 0; i < answers.size() && !interrupted(); ++i) take(drawn[i], asked[i], answers[i]);
    });
  }

  void take(const Case& drawn, const Case& asked, const Answer& answer) {
    const bool is_inside = answer.status != Answer::Status::cannot_answer || unmet_by(asked, required_).empty();
    if (const auto a = is_inside ? judged(judged_case(drawn, settings_.subject->scalar), answer) : BoundedAnswer{}) {
      count(*a, drawn);
    } else {
      ++e_.unanswered;  // an internal error is told by itself
    }
  }

  /// Empty: one enclosure leaves open whether the answer is good enough.
  std::optional<BoundedAnswer> good_by_enclosure(const Case& exact, const Answer& answer) const {
    const bool is_of_catalogue = standard_.declared.empty();  // otherwise the judge knows the meaning
    if (answer.status != Answer::Status::answered || !is_regular(*exact.query, answer) || !is_of_catalogue)
      return std::nullopt;
    const Enclosure e = enclosure_of(exact, answer);
    if (!e.decided() || e.may_be_yes != answer.yes) return std::nullopt;
    const LargestError distance = enclosed_error(*exact.query, answer, e, is_length);
    const LargestError time = enclosed_error(*exact.query, answer, e, [](Role r) { return r == Role::time; });
    BoundedAnswer a;
    a.answer.state = TradeAnswer::State::compared;
    a.answer.truth_yes = a.answer.yes = answer.yes;
    a.answer.distance = distance.proved;
    a.answer.time = time.proved;
    a.distance_at_most = distance.at_most;
    a.time_at_most = time.at_most;
    a.by_intervals = is_good(a);
    return a.by_intervals ? std::optional(a) : std::nullopt;
  }

  std::optional<BoundedAnswer> judged(const Case& exact, const Answer& answer) {
    if (const auto good = good_by_enclosure(exact, answer)) return good;
    const Subject& subject = *settings_.subject;
    const auto first = internal_errors_.judged(exact, subject, answer, standard_, Detail::verdict);
    if (!first) return std::nullopt;
    BoundedAnswer a{trade_answer(exact, subject.scalar, answer, *first, tolerance_)};
    if (a.answer.state != TradeAnswer::State::compared) return a;
    a.distance_at_most = error_at_most(exact, answer, *first, is_length);
    a.time_at_most = error_at_most(exact, answer, *first, [](Role r) { return r == Role::time; });
    a.by_intervals = first->settled && first->decided_by == Stage::interval && is_good(a);
    if (a.by_intervals) return a;
    const auto full = internal_errors_.judged(exact, subject, answer, standard_, Detail::full);
    if (!full) return std::nullopt;
    a.answer = trade_answer(exact, subject.scalar, answer, refined(exact, answer, *full), tolerance_);
    a.distance_at_most = a.answer.distance;
    a.time_at_most = a.answer.time;
    return a;
  }
  /// The backward bound of a wrong decision to a sixteenth: the ladder alone may halve the depth of a miss.
  Finding refined(const Case& exact, const Answer& answer, Finding f) const {
    const bool decides_wrongly = f.has(Disagreement::false_miss) || f.has(Disagreement::false_hit);
    if (decides_wrongly && f.backward)
      f.backward->above = finer_backward(exact, answer, *f.backward, {}, standard_.declared);
    return f;
  }
  /// The decision is right and the upper bounds are within the tolerance.
  bool is_good(const BoundedAnswer& a) const {
    return !a.answer.missed && !a.answer.phantom && !a.answer.not_finite && a.distance_at_most <= tolerance_.error &&
           !(tolerance_.time && a.time_at_most > *tolerance_.time);
  }

  void count(const BoundedAnswer& bounded, const Case& drawn) {
    const TradeAnswer& a = bounded.answer;
    const bool beyond = is_beyond(a, tolerance_);
    e_.beyond += beyond;
    if (a.state != TradeAnswer::State::compared) {
      ++e_.unanswered;
      return;
    }
    ++e_.answered;
    e_.by_intervals += bounded.by_intervals;
    e_.not_finite += a.not_finite;
    contacts_ += a.truth_yes;
    reported_ += a.yes;
    missed_deeper_ += a.missed && beyond;
    phantom_wider_ += a.phantom && beyond;
    if (a.missed) e_.missed_depth = std::max(e_.missed_depth, a.shift);
    if (a.phantom) e_.phantom_gap = std::max(e_.phantom_gap, a.shift);
    widen(e_.distance, a.distance, bounded.distance_at_most);
    widen(e_.time, a.time, bounded.time_at_most);
    if (const double use = use_of(a, tolerance_); use > e_.worst_use) {
      e_.worst_use = use;
      e_.worst = drawn;
    }
  }
  static void widen(LargestError& e, double proved, double at_most) {
    e.proved = std::max(e.proved, proved);
    e.at_most = std::max(e.at_most, std::max(proved, at_most));
  }

  const EvidenceSettings& settings_;
  const TradeTolerance& tolerance_;
  Dispatcher& dispatcher_;
  InternalErrors& internal_errors_;
  const Preconditions required_;
  const Standard standard_;
  SceneEvidence e_;
  std::uint64_t contacts_ = 0, reported_ = 0, missed_deeper_ = 0, phantom_wider_ = 0;
};

}  // namespace

std::vector<MetRequirement> SceneEvidence::requirements(const TradeTolerance& tolerance,
                                                        std::optional<double> nanoseconds) const {
  return requirements_of(
      {unanswered, not_finite, std::nullopt, distance.proved, time.proved, missed_deeper, phantom_wider, nanoseconds},
      tolerance);
}

SceneEvidence measured_evidence(const EvidenceSettings& settings, Dispatcher& dispatcher,
                                InternalErrors& internal_errors, const std::function<bool(std::uint64_t)>& goes_on) {
  return EvidenceMeasurement(settings, dispatcher, internal_errors).measure(goes_on);
}

}  // namespace nearmiss
