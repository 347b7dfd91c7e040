#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/engine/interrupt.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/text.hpp"
#include "reports/trade/trade.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t text_width = 100;

/// "0", or the share in percent.
std::string rate_text(const Rate& r) {
  if (r.of == 0) return "-";
  return r.count == 0 ? "0" : fmt::format("{:.2g} %", 100 * r.share());
}

std::optional<double> p50_of(const std::optional<Quantiles>& q) { return q ? std::optional(q->p50) : std::nullopt; }
std::optional<double> p99_of(const std::optional<Quantiles>& q) { return q ? std::optional(q->p99) : std::nullopt; }
std::optional<double> max_of(const std::optional<Quantiles>& q) { return q ? std::optional(q->max) : std::nullopt; }

std::vector<std::string> row_of_trade(const TradeSummary& s) {
  return {(s.on_front ? "* " : "  ") + s.subject->name,
          three_digits(p50_of(s.nanoseconds)),
          three_digits(p99_of(s.nanoseconds)),
          three_digits(max_of(s.nanoseconds)),
          three_digits(max_of(s.shift)),
          rate_text(s.missed),
          rate_text(s.phantom),
          rate_text(s.broke),
          three_digits(p99_of(s.ulps)),
          s.meets_all() ? "yes" : "no"};
}

/// "cheapest that meets it: collide-fast-float, 5.2 ns a call", or the requirement that nothing meets.
std::string headline_of(const TradedQuery& t) {
  if (const TradeSummary* best = cheapest(t.subjects)) {
    const auto so_far = std::any_of(best->requirements.begin(), best->requirements.end(),
                                    [](const MetRequirement& r) { return r.state == MetRequirement::State::so_far; });
    return fmt::format("the cheapest that meets it is {}, {} ns a call{}", best->subject->name,
                       three_digits(best->cost()), so_far ? "; too few cases to show the rates" : "");
  }
  std::string failed;
  for (std::size_t i = 0; !t.subjects.empty() && i < t.subjects.front().requirements.size(); ++i) {
    const bool by_all = std::all_of(t.subjects.begin(), t.subjects.end(), [&](const TradeSummary& s) {
      return i < s.requirements.size() && s.requirements[i].state == MetRequirement::State::failed;
    });
    if (by_all) failed += (failed.empty() ? "" : ", ") + t.subjects.front().requirements[i].name;
  }
  return failed.empty() ? "nothing meets all requirements" : "nothing meets the requirement of " + failed;
}

std::string table_of(const TradedQuery& t) {
  std::vector<std::vector<std::string>> rows{
      {"  SUBJECT", "NS P50", "P99", "MAX", "ERROR", "MISSED", "PHANTOM", "BROKE", "ULPS P99", "MEETS"}};
  for (const TradeSummary& s : t.subjects) rows.push_back(row_of_trade(s));
  return table_text(rows, "", 1);
}

std::string number_or_empty(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? fmt::format("{}", *x) : "";
}

std::string line_of_csv(const TradedQuery& t, const TradeSummary& s) {
  std::string line =
      fmt::format("{},{},{},{},{},{},{},{},{}", csv_cell(t.query->name), csv_cell(s.subject->name), t.cases, s.compared,
                  s.no_answer, s.not_asked, s.broke.count, name_of(s.timed), s.pinned ? "yes" : "no");
  const auto add = [&](const std::optional<double>& x) { line.append(",").append(number_or_empty(x)); };
  for (const auto& q : {s.nanoseconds, s.shift, s.backward, s.ulps, s.distance, s.time}) {
    for (const auto& x : {p50_of(q), p99_of(q), max_of(q)}) add(x);
  }
  add(p50_of(s.sequential));
  for (const Rate& r : {s.missed, s.phantom, s.beyond}) {
    line += fmt::format(",{},{}", r.count, r.of);
    add(r.low), add(r.high);
  }
  for (const auto& q : {s.missed_depth, s.phantom_gap}) add(max_of(q));
  for (const auto& tail : s.tails) add(tail);
  return line + fmt::format(",{},{}\n", s.meets_all() ? "yes" : "no", s.on_front ? "yes" : "no");
}

}  // namespace

std::string Trade::text() const {
  const TradeTolerance& t = settings_.source.tolerance;
  std::string text;
  for (const TradedQuery& traded : traded_) {
    text += fmt::format("{}, {}, {} of them contacts\n", traded.query->name, plural_text(traded.cases, "case"),
                        count_text(traded.contacts));
    text += table_of(traded);
    text += wrapped_text(headline_of(traded), "  ", text_width) + "\n\n";
  }
  const std::string limit = t.unit.empty() ? fmt::format("{} of the largest length of a case", t.error)
                                           : fmt::format("{} {}", t.error, t.unit);
  return text +
         wrapped_text(fmt::format("Tolerable error: {} ({}). All figures are sampled, with the seed {}. ERROR: the "
                                  "largest proved error of the inputs. *: on the Pareto front of P50 and ERROR.",
                                  limit, t.source, settings_.seed),
                      "", text_width);
}

std::string Trade::csv() const {
  std::string text = "query,subject,cases,compared,no_answer,not_asked,broke,timed,pinned";
  for (const char* of : {"nanoseconds", "error", "backward", "ulps", "length", "time"}) {
    for (const char* q : {"p50", "p99", "max"}) text += fmt::format(",{}_{}", of, q);
  }
  text += ",nanoseconds_in_sequence";
  for (const char* rate : {"missed", "phantom", "beyond"})
    text += fmt::format(",{0},{0}_of,{0}_rate_low,{0}_rate_high", rate);
  text += ",missed_depth_max,phantom_gap_max";
  for (const std::uint64_t n : tail_sizes) text += fmt::format(",error_1_in_{}", n);
  text += ",meets_all,on_front\n";
  for (const TradedQuery& t : traded_) {
    for (const TradeSummary& s : t.subjects) text += line_of_csv(t, s);
  }
  return text;
}

}  // namespace nearmiss
