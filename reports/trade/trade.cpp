#include "reports/trade/trade.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "corpus/storage/codec.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/findings/pretty_json.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t judged_at_once = 128;  ///< cases; few, so that an interrupt takes effect soon
constexpr std::size_t most_timed = 2048;     ///< cases of a query

/// A fixed order for calls: neighbours in the stream of cases are no neighbours in time.
std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  std::mt19937_64 random(seed);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

/// The cases that the subject answered, in the fixed order.
TimedSubject timed_subject(const Subject& subject, std::span<const Case> cases, std::span<const TradeAnswer> answers,
                           std::span<const std::size_t> order) {
  TimedSubject timed{&subject, {}, {}};
  for (const std::size_t i : order) {
    if (answers[i].state != TradeAnswer::State::compared) continue;
    timed.cases.push_back(asked_case(cases[i], subject.scalar));
    timed.of_measure.push_back(i);
  }
  return timed;
}

}  // namespace

Trade::Trade(TradeSettings settings)
    : settings_(std::move(settings)),
      started_(fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))),
      dispatcher_([this] { return tick(0), !interrupted(); }),
      internal_errors_(settings_.folder),
      profile_(settings_.subjects.size()) {
  make_writable_folder(settings_.folder);
  for (const Query* q : settings_.queries) total_ += offering(*q).size() * settings_.cases;
}

void Trade::tick(std::uint64_t done) {
  done_ += done;
  progress_.show(done_, total_, std::nullopt, std::nullopt);
}

std::vector<const Subject*> Trade::offering(const Query& query) const {
  std::vector<const Subject*> subjects;
  for (const Subject* s : settings_.subjects) {
    if (s->offering(query.name).answer != nullptr) subjects.push_back(s);
  }
  return subjects;
}

void Trade::measure() {
  double weight = 0;
  for (const Query* q : settings_.queries) weight += offering(*q).empty() ? 0 : settings_.source.share(*q);
  for (const Query* q : settings_.queries) {
    if (interrupted()) return;
    progress_.set_activity(fmt::format("trade of {}", q->name));
    if (!offering(*q).empty()) measure_query(*q, settings_.source.share(*q) / weight);
  }
}

std::vector<Case> Trade::drawn(const Query& query, Preconditions required) const {
  std::vector<Case> cases(settings_.cases);
  for (std::uint64_t i = 0; i < settings_.cases; ++i)
    settings_.source.draw(cases[i], query, settings_.seed, i, required);
  return cases;
}

void Trade::measure_query(const Query& query, double share) {
  const std::vector<const Subject*> subjects = offering(query);
  const std::vector<Case> cases = drawn(query, all_required(subjects, query));
  const auto answers = judged(subjects, cases);
  if (interrupted()) return;
  const std::vector<std::size_t> order = shuffled(std::min(cases.size(), most_timed), settings_.seed);
  std::vector<TimedSubject> timed;
  for (std::size_t s = 0; s < subjects.size(); ++s)
    timed.push_back(timed_subject(*subjects[s], cases, answers[s], order));
  progress_.set_activity(fmt::format("times of {}", query.name));
  const std::vector<TradeTimes> times = trade_times(timed, cases.size(), settings_.repeats, dispatcher_.workers(),
                                                    [this] { return tick(0), !interrupted(); });
  if (interrupted()) return;
  TradedQuery traded{&query, share, cases.size(), 0, {}};
  for (std::size_t s = 0; s < subjects.size(); ++s) {
    traded.subjects.push_back(summarised(*subjects[s], answers[s], times[s], settings_.source.tolerance));
    traded.contacts = std::max(traded.contacts, traded.subjects.back().missed.of);
  }
  mark_front(traded.subjects);
  add_to_profile(traded, answers, times);
  traded_.push_back(std::move(traded));
}

std::vector<std::vector<TradeAnswer>> Trade::judged(std::span<const Subject* const> subjects,
                                                    std::span<const Case> cases) {
  std::vector<std::vector<TradeAnswer>> all(subjects.size());
  for (std::size_t at = 0; at < cases.size() && !interrupted(); at += judged_at_once) {
    const std::span<const Case> batch = cases.subspan(at, std::min(judged_at_once, cases.size() - at));
    for (std::size_t s = 0; s < subjects.size() && !interrupted(); ++s) {
      const std::vector<TradeAnswer> some = judged_batch(*subjects[s], batch);
      all[s].insert(all[s].end(), some.begin(), some.end());
      tick(batch.size());
    }
  }
  return all;
}

std::vector<TradeAnswer> Trade::judged_batch(const Subject& subject, std::span<const Case> batch) {
  std::vector<TradeAnswer> judged(batch.size());
  std::vector<Case> asked;
  for (const Case& c : batch) asked.push_back(asked_case(c, subject.scalar));
  const Subject* const only[] = {&subject};
  dispatcher_.ask(only, asked, {}, [&](const Subject&, std::span<const Answer> answers) {
    for (std::size_t i = 0; i < answers.size() && !interrupted(); ++i)
      judged[i] = judged_answer(subject, batch[i], asked[i], answers[i]);
  });
  return judged;
}

TradeAnswer Trade::judged_answer(const Subject& subject, const Case& question, const Case& asked,
                                 const Answer& answer) {
  const Preconditions required = subject.offering(question.query->name).required;
  if (answer.status == Answer::Status::cannot_answer && !unmet_by(asked, required).empty()) return {};
  const Case exact = judged_case(question, subject.scalar);
  const Standard standard = unbounded_standard(subject.standard_for(question.query->name).declared);
  const auto finding = internal_errors_.judged(exact, subject, answer, standard, Detail::full);
  return finding ? trade_answer(exact, subject.scalar, answer, *finding, settings_.source.tolerance) : TradeAnswer{};
}

void Trade::add_to_profile(const TradedQuery& traded, const std::vector<std::vector<TradeAnswer>>& answers,
                           const std::vector<TradeTimes>& times) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const std::size_t timed = std::min<std::size_t>(traded.cases, most_timed);
  for (std::size_t i = 0; i < timed; ++i) {
    std::vector<double> costs(settings_.subjects.size(), never);
    for (std::size_t s = 0; s < traded.subjects.size(); ++s) {
      const bool solves = answers[s][i].state == TradeAnswer::State::compared &&
                          !is_beyond(answers[s][i], settings_.source.tolerance) && !std::isnan(times[s].of_case[i]);
      const auto at = std::find(settings_.subjects.begin(), settings_.subjects.end(), traded.subjects[s].subject);
      if (solves) costs[std::size_t(at - settings_.subjects.begin())] = times[s].of_case[i];
    }
    profile_.add(costs, traded.share / double(timed));
  }
}

void Trade::write() const {
  write_file(settings_.folder / "trade.json", pretty_json(to_json()));
  write_file(settings_.folder / "trade.csv", csv());
}

int Trade::exit_code() const {
  if (internal_errors_.count() > 0) return InternalError::exit_code;
  return interrupted() ? 2 : 0;
}

}  // namespace nearmiss
