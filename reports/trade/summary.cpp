#include "reports/trade/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using AnswerState = TradeAnswer::State;

/// One number of some answers.
template <class Has, class Number>
std::vector<double> numbers_of_answers(std::span<const TradeAnswer> answers, Has has, Number number) {
  std::vector<double> numbers;
  for (const TradeAnswer& a : answers) {
    if (a.state == AnswerState::compared && has(a)) numbers.push_back(number(a));
  }
  return numbers;
}

template <class Is>
std::uint64_t count_of(std::span<const TradeAnswer> answers, Is is) {
  return std::uint64_t(std::count_if(answers.begin(), answers.end(), is));
}

void add_counts(TradeSummary& s, std::span<const TradeAnswer> answers, const TradeTolerance& tolerance) {
  const auto in = [&](AnswerState state) {
    return count_of(answers, [&](const TradeAnswer& a) { return a.state == state; });
  };
  s.compared = in(AnswerState::compared);
  s.no_answer = in(AnswerState::no_answer);
  s.not_asked = in(AnswerState::not_asked);
  const std::uint64_t asked = answers.size() - s.not_asked;
  const std::uint64_t contacts = count_of(answers, [](const TradeAnswer& a) { return a.truth_yes; });
  const std::uint64_t reported = count_of(answers, [](const TradeAnswer& a) { return a.yes; });
  const auto rate = [&](auto is, std::uint64_t of) { return rate_of(count_of(answers, is), of); };
  s.broke = rate_of(in(AnswerState::broke), asked);
  s.missed = rate([](const TradeAnswer& a) { return a.missed; }, contacts);
  s.phantom = rate([](const TradeAnswer& a) { return a.phantom; }, reported);
  s.missed_deeper = rate([&](const TradeAnswer& a) { return a.missed && is_beyond(a, tolerance); }, contacts);
  s.phantom_wider = rate([&](const TradeAnswer& a) { return a.phantom && is_beyond(a, tolerance); }, reported);
  s.beyond = rate([&](const TradeAnswer& a) { return is_beyond(a, tolerance); }, asked);
}

void add_errors(TradeSummary& s, std::span<const TradeAnswer> answers) {
  const auto all = [](const TradeAnswer&) { return true; };
  const auto right = [](const TradeAnswer& a) { return !a.missed && !a.phantom && !a.not_finite; };
  const auto quantiles = [&](auto has, auto number) {
    std::vector<double> numbers = numbers_of_answers(answers, has, number);
    return quantiles_of(numbers);
  };
  const auto shift = [](const TradeAnswer& a) { return a.shift; };
  s.missed_depth = quantiles([](const TradeAnswer& a) { return a.missed; }, shift);
  s.phantom_gap = quantiles([](const TradeAnswer& a) { return a.phantom; }, shift);
  s.ulps = quantiles(right, [](const TradeAnswer& a) { return a.ulps; });
  s.distance = quantiles(right, [](const TradeAnswer& a) { return a.distance; });
  s.time = quantiles(right, [](const TradeAnswer& a) { return a.time; });
  s.backward = quantiles(all, [](const TradeAnswer& a) { return a.backward; });
  std::vector<double> shifts = numbers_of_answers(answers, all, shift);
  s.shift = quantiles_of(shifts);
  for (std::size_t i = 0; i < tail_sizes.size(); ++i) s.tails[i] = one_in(shifts, tail_sizes[i]);
}

void add_times(TradeSummary& s, const TradeTimes& times) {
  s.timed = times.how;
  s.pinned = times.pinned;
  std::vector<double> calls, repeats = times.repeats, sequential = times.sequential;
  std::copy_if(times.of_case.begin(), times.of_case.end(), std::back_inserter(calls),
               [](double t) { return !std::isnan(t); });
  s.nanoseconds = quantiles_of(calls);
  s.repeats = quantiles_of(repeats);
  s.sequential = quantiles_of(sequential);
  if (s.repeats) s.least_repeat = repeats.front();
  if (s.sequential) s.least_sequential = sequential.front();
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

/// The times of the calls that the stage answered.
std::vector<double> times_of_stage(const TradeTimes& times, AnswerStage stage) {
  std::vector<double> own;
  for (std::size_t i = 0; i < times.stage_of_case.size(); ++i) {
    if (times.stage_of_case[i] == stage && !std::isnan(times.of_case[i])) own.push_back(times.of_case[i]);
  }
  return own;
}

using MetState = MetRequirement::State;

MetRequirement at_most(std::string name, std::optional<double> worst, double limit, std::string unit) {
  const double value = worst.value_or(0);
  return {std::move(name), limit, value, std::move(unit), value <= limit ? MetState::shown : MetState::failed};
}

MetRequirement rate_at_most(std::string name, const Rate& rate, double limit) {
  const MetState state = rate.share() > limit ? MetState::failed
                         : rate.high <= limit ? MetState::shown
                                              : MetState::so_far;
  return {std::move(name), limit, rate.share(), "", state};
}

std::optional<double> largest_of(const std::optional<Quantiles>& q) { return q ? std::optional(q->max) : std::nullopt; }

}  // namespace

std::string_view name_of(MetRequirement::State s) {
  switch (s) {
    case MetState::shown: return "met";
    case MetState::so_far: return "met so far";
    case MetState::failed: break;
  }
  return "failed";
}

std::vector<MetRequirement> requirements_of(const RequiredFigures& f, const TradeTolerance& t) {
  std::vector<MetRequirement> all{at_most("cases without an answer", double(f.unanswered), 0, "")};
  if (t.unit.empty()) {
    all.push_back(at_most("error of the inputs", f.shift, t.error, "of the largest length"));
  } else {
    all.push_back(at_most("error of places and depths", f.distance, t.error, t.unit));
  }
  all.push_back(at_most("answers that are not finite", double(f.not_finite), 0, ""));
  all.push_back(rate_at_most("missed contacts", f.missed_deeper, t.missed_rate));
  all.push_back(rate_at_most("phantom contacts", f.phantom_wider, t.phantom_rate));
  if (t.time) all.push_back(at_most("error of times of impact", f.time, *t.time, "s"));
  if (t.nanoseconds && f.nanoseconds) all.push_back(at_most("time of a call", f.nanoseconds, *t.nanoseconds, "ns"));
  return all;
}

std::string failure_text(const MetRequirement& r) {
  const std::string unit = r.unit.empty() ? "" : " " + r.unit;
  return fmt::format("{}: {}{}, at most {}", r.name, three_digits(r.worst), unit, three_digits(r.limit));
}

bool none_failed(std::span<const MetRequirement> requirements) {
  return std::none_of(requirements.begin(), requirements.end(),
                      [](const MetRequirement& r) { return r.state == MetState::failed; });
}

std::vector<StageCost> stage_costs(const TradeTimes& times) {
  std::vector<StageCost> costs;
  double all_time = 0;
  std::uint64_t all_calls = 0;
  for (const AnswerStage stage : known_stages) {
    std::vector<double> own = times_of_stage(times, stage);
    if (own.empty()) continue;
    const double sum = sum_of(own);
    all_time += sum;
    all_calls += own.size();
    StageCost& cost = costs.emplace_back();
    cost.stage = stage;
    cost.calls.count = own.size();
    cost.mean = sum / double(own.size());
    cost.nanoseconds = quantiles_of(own);
  }
  for (StageCost& c : costs) {
    c.share_of_time = double(c.calls.count) * c.mean / all_time;
    c.calls = rate_of(c.calls.count, all_calls);
  }
  return costs;
}

bool TradeSummary::meets_all() const { return compared > 0 && none_failed(requirements); }

std::optional<double> TradeSummary::cost() const {
  return nanoseconds ? std::optional(nanoseconds->p50) : std::nullopt;
}

TradeSummary summarised(const Subject& subject, std::span<const TradeAnswer> answers, const TradeTimes& times,
                        const TradeTolerance& tolerance) {
  TradeSummary s;
  s.subject = &subject;
  add_counts(s, answers, tolerance);
  add_errors(s, answers);
  add_times(s, times);
  s.stages = stage_costs(times);
  s.requirements = requirements_of(
      {s.no_answer + s.not_asked + s.broke.count, count_of(answers, [](const TradeAnswer& a) { return a.not_finite; }),
       largest_of(s.shift), largest_of(s.distance), largest_of(s.time), s.missed_deeper, s.phantom_wider,
       s.sequential ? std::optional(s.sequential->p50) : std::nullopt},
      tolerance);
  return s;
}

void mark_front(std::span<TradeSummary> subjects) {
  std::vector<Price> prices;
  std::vector<TradeSummary*> priced;
  for (TradeSummary& s : subjects) {
    if (!s.cost() || !s.shift) continue;
    prices.push_back({*s.cost(), s.shift->max});
    priced.push_back(&s);
  }
  const std::vector<bool> front = pareto_front(prices);
  for (std::size_t i = 0; i < priced.size(); ++i) priced[i]->on_front = front[i];
}

const TradeSummary* cheapest(std::span<const TradeSummary> subjects) {
  const TradeSummary* best = nullptr;
  for (const TradeSummary& s : subjects) {
    if (s.meets_all() && s.cost() && (best == nullptr || *s.cost() < *best->cost())) best = &s;
  }
  return best;
}

}  // namespace nearmiss
