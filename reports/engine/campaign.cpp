#include "reports/engine/campaign.hpp"

#include <algorithm>
#include <utility>

#include "reports/engine/interrupt.hpp"

namespace nearmiss {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t least_batch = 32;
constexpr double most_seconds_per_batch = 0.4;

void adapt_batch(Stream& s, double seconds) {
  if (seconds < most_seconds_per_batch / 4) s.batch = std::min(2 * s.batch, Workers::batch);
  if (seconds > most_seconds_per_batch) s.batch = std::max(s.batch / 2, least_batch);
}

/// Cases of a stream, and the time to make them.
struct Batch {
  Stream* of = nullptr;  ///< nullptr: the schedule is over
  std::vector<Case> cases;
  double seconds = 0;
};

void make(Batch& batch, Schedule& schedule, std::uint64_t seed) {
  const auto begin = Campaign::Clock::now();
  batch.of = schedule.next();
  if (batch.of == nullptr) return;
  generate_next(*batch.of, seed, schedule.batch_of(*batch.of, Workers::capacity_for(*batch.of->query)), batch.cases);
  batch.seconds = Campaign::seconds_since(begin);
  batch.of->seconds += batch.seconds;
}

}  // namespace

Campaign::Campaign(Settings settings, std::vector<Sink*> sinks)
    : settings_(std::move(settings)),
      sinks_(std::move(sinks)),
      dispatcher_([this] { return settings_.tick(), keeps_waiting(); }, settings_.give_up),
      internal_errors_(settings_.folder) {}

bool Campaign::should_stop() const { return interrupted() || (until_ && Clock::now() >= *until_); }

/// Reports are also written after the time is over, so the referees get a moment more.
bool Campaign::keeps_waiting() const {
  constexpr auto moment = 300ms;
  return !interrupted() && !(until_ && Clock::now() >= *until_ + moment);
}

Standard Campaign::standard_for(const Subject& subject, const Query& query) const {
  return settings_.standard ? settings_.standard(subject, query) : subject.standard_for(query.name);
}

void Campaign::judge_all(const Subject& subject, std::span<const Case> cases, std::span<const Answer> answers,
                         Detail detail) {
  constexpr std::size_t between_looks = 64;
  const Query& query = *cases.front().query;
  if (answers.size() < cases.size() && !should_stop())
    dispatcher_.pass_over(subject, query, cases.size() - answers.size());
  const Standard standard = standard_for(subject, query);
  AnswerSample* sample = is_generating_ && !settings_.every_answer ? &samples_[{&subject, &query}] : nullptr;
  std::uint64_t not_judged = 0;
  for (std::size_t i = 0; i < answers.size() && (i % between_looks != 0 || !should_stop()); ++i) {
    if (sample != nullptr && !sample->takes_next()) {
      ++not_judged;
      continue;
    }
    const bool proved = judge_one(subject, standard, cases[i], answers[i], i, detail);
    if (sample != nullptr) sample->count(proved);
  }
  if (not_judged == 0) return;
  for (Sink* s : sinks_) s->take_not_judged(query, subject, not_judged);
}

bool Campaign::judge_one(const Subject& subject, const Standard& standard, const Case& question, const Answer& answer,
                         std::size_t i, Detail detail) {
  const auto f = internal_errors_.judged(question, subject, answer, standard, detail, [&](const Finding& first) {
    const Examined e{question, subject, answer, first, {}, i};
    return internal_errors_.count() > 0 ||
           std::any_of(sinks_.begin(), sinks_.end(), [&](const Sink* s) { return s->needs_second(e); });
  });
  if (!f) return false;
  const Examined e{question, subject, answer, *f, dispatcher_.workers().output(subject, i), i};
  for (Sink* s : sinks_) s->take(e);
  return f->is_proved();
}

void Campaign::hand_on_given_up(std::span<const Subject* const> subjects, const Query& query) {
  for (const Subject* subject : subjects) {
    std::uint64_t& known = given_up_[{subject, &query}];
    const Endurance& now = dispatcher_.endurance(*subject, query);
    if (now.gave_up == known) continue;
    for (Sink* s : sinks_) s->take_given_up(query, *subject, now.gave_up - known, now);
    known = now.gave_up;
  }
}

void Campaign::examine(std::span<const Subject* const> subjects, std::span<const Case> cases,
                       const std::function<void()>& meanwhile) {
  for (Sink* s : sinks_) s->begin_batch(cases);
  ask_and_judge(subjects, cases, meanwhile);
}

void Campaign::examine_searched(std::span<const Subject* const> subjects, std::span<const Case> cases, Detail detail) {
  for (Sink* s : sinks_) s->begin_batch({});
  ask_and_judge(subjects, cases, {}, detail);
}

void Campaign::ask_and_judge(std::span<const Subject* const> subjects, std::span<const Case> cases,
                             const std::function<void()>& meanwhile, Detail detail) {
  dispatcher_.ask(subjects, cases, meanwhile,
                  [&](const Subject& s, std::span<const Answer> answers) { judge_all(s, cases, answers, detail); });
  if (!cases.empty()) hand_on_given_up(subjects, *cases.front().query);
  for (Sink* s : sinks_) s->end_batch();
  settings_.tick();
}

void Campaign::examine_in_any_scalar(std::span<const Subject* const> subjects, const Case& question) {
  for (Sink* s : sinks_) s->begin_batch({});
  for (const Subject* subject : subjects) {
    if (should_stop()) return;
    if (const std::optional<Case> same = in_scalar(question, subject->scalar)) {
      ask_and_judge({&subject, 1}, {&*same, 1}, {});
      continue;
    }
    Finding outside;
    outside.verdict = Verdict::out_of_domain;
    for (Sink* s : sinks_) s->take({question, *subject, Answer{}, outside, {}, 0});
  }
}

void Campaign::generate(Schedule& schedule, std::uint64_t seed) {
  Batch now, next;
  is_generating_ = true;
  for (make(now, schedule, seed); now.of != nullptr && !should_stop(); std::swap(now, next)) {
    const Clock::time_point begin = Clock::now();
    examine(now.of->subjects, now.cases, [&] { make(next, schedule, seed); });
    const double seconds = seconds_since(begin) - next.seconds;
    now.of->seconds += seconds;
    adapt_batch(*now.of, seconds);
  }
  is_generating_ = false;
}

}  // namespace nearmiss
