#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/advice/advice.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t advice_width = 100;

/// "12.3 ns".
std::string nanoseconds_text(const std::optional<double>& x) { return three_digits(x) + " ns"; }

double cost_of(const RankedSubject& c) { return c.cost().value_or(0); }

std::vector<std::string> row_of_advice(const AdvisedQuery& a) {
  const std::string query(a.query->name);
  const RankedSubject* choice = a.choice();
  if (choice == nullptr) return {query, "none", "-", "-", "-", "-", "-"};
  const SceneEvidence& e = *choice->evidence;
  return {query,
          choice->subject().name,
          three_digits(choice->cost()),
          three_digits(e.distance.proved),
          three_digits(e.time.proved),
          fmt::format("{} of {}", count_text(e.beyond), count_text(e.cases)),
          three_digits(rate_of(e.beyond, e.cases).high)};
}

/// The rates that no case exceeds, but that need more cases to be shown: "missed contacts: rate below 0.004, at most
/// 0".
std::string open_rates_text(const RankedSubject& c) {
  std::vector<std::string> open;
  for (const MetRequirement& r : c.requirements) {
    if (r.state != MetRequirement::State::so_far) continue;
    const Rate& rate = r.name == "missed contacts" ? c.evidence->missed_deeper : c.evidence->phantom_wider;
    open.push_back(
        fmt::format("{}: rate below {}, at most {}", r.name, three_digits(rate.high), three_digits(r.limit)));
  }
  return open.empty() ? "" : fmt::format("not shown by so few cases: {}", fmt::join(open, "; "));
}

std::string down_text(const AdvisedQuery& a) {
  const RankedSubject* down = a.down();
  if (down == nullptr) return "";
  const std::string_view on = down->evidence ? "fresh cases" : "timed cases";
  return fmt::format("cheaper: {}, {} less, fails on {}: {}", down->subject().name,
                     nanoseconds_text(cost_of(*a.choice()) - cost_of(*down)), on, down->failures());
}

std::string up_text(const AdvisedQuery& a, const std::string& unit) {
  const RankedSubject* up = a.up();
  if (up == nullptr) return "";
  const auto error = [](const RankedSubject& c) { return three_digits(c.measured->shift->max); };
  return fmt::format("more accurate: {}, {} more, largest backward error {} in place of {} {}", up->subject().name,
                     nanoseconds_text(cost_of(*up) - cost_of(*a.choice())), error(*up), error(*a.choice()), unit);
}

std::string failed_text(const std::vector<MetRequirement>& requirements) {
  RankedSubject c;
  c.requirements = requirements;
  return c.failures();
}

std::string remedy_text(const AdvisedQuery& a, const TriedRemedy& r) {
  if (r.subject == nullptr) return fmt::format("{} ({}): not tried", r.name, r.words);
  const std::string what = fmt::format("{} ({}): {}", r.name, r.words, r.subject->name);
  if (!r.meets_all) return fmt::format("{} still fails: {}", what, failed_text(r.requirements));
  std::string text =
      fmt::format("{} then meets everything on {}, with errors up to {} {}", what,
                  plural_text(r.evidence.cases, "case"), three_digits(r.evidence.distance.proved), r.unit);
  if (a.choice() != nullptr && r.cost)
    text += fmt::format(", {} less than the choice", nanoseconds_text(cost_of(*a.choice()) - *r.cost));
  return text;
}

std::string details_of(const AdvisedQuery& a, const std::string& unit) {
  std::string text = fmt::format("{}\n", a.query->name);
  const auto line = [&](const std::string& words) {
    if (!words.empty()) text += wrapped_text(words, "  ", advice_width);
  };
  if (a.candidates.empty()) {
    line("no chosen subject offers it, or none could be timed");
    return text;
  }
  if (a.choice() != nullptr) {
    line(open_rates_text(*a.choice()));
    line(down_text(a));
    line(up_text(a, unit));
  } else {
    for (const RankedSubject& c : a.candidates) line(fmt::format("{} fails: {}", c.subject().name, c.failures()));
  }
  for (const TriedRemedy& r : a.remedies) line(remedy_text(a, r));
  return text;
}

std::string step_text(const TradeSource& source, double seconds) {
  constexpr double microseconds = 1e6;
  const double budget = source.tolerance.nanoseconds.value_or(0) * 1e-9 * source.queries_per_step;
  return wrapped_text(fmt::format("A step of {:g} queries takes {} µs; the budget is {} µs.", source.queries_per_step,
                                  three_digits(seconds * microseconds), three_digits(budget * microseconds)),
                      "", advice_width);
}

}  // namespace

std::string Advice::text() const {
  const std::string& unit = settings_.source.tolerance.unit;
  std::vector<std::vector<std::string>> rows{{"QUERY", "THE CHEAPEST", "NS", "ERROR", "TIME", "BEYOND", "RATE BELOW"}};
  for (const AdvisedQuery& a : advised_) rows.push_back(row_of_advice(a));
  std::string text = table_text(rows, "", 2) + "\n";
  for (const AdvisedQuery& a : advised_) text += details_of(a, unit) + "\n";
  if (const auto step = seconds_per_step()) text += step_text(settings_.source, *step) + "\n";
  return text +
         wrapped_text(fmt::format("{} of each query with the seed {}; times and first errors on {} with the seed {}. "
                                  "NS: of a call in a sequence of calls. "
                                  "ERROR: the largest proved error of a place or depth, in {}; TIME: of a time, in s. "
                                  "BEYOND: answers beyond what is tolerable; RATE BELOW: with 95 % confidence. All "
                                  "figures are sampled.",
                                  plural_text(settings_.cases, "fresh case"), evidence_seed(),
                                  plural_text(std::min(settings_.cases, timed_cases), "case"), settings_.seed, unit),
                      "", advice_width);
}

}  // namespace nearmiss
