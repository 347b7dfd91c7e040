#include "reports/engine/counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

/// The singular noun for a disagreement in the summary.
std::string_view noun_of(Disagreement d) {
  switch (d) {
    case Disagreement::none: return "other violation";
    case Disagreement::off_surface: return "off-surface place";
    case Disagreement::wrong_time:
    case Disagreement::wrong_place:
    case Disagreement::wrong_normal:
    case Disagreement::wrong_depth:
    case Disagreement::wrong_distance:
    case Disagreement::wrong_size:
    case Disagreement::wrong_direction:
    case Disagreement::wrong_weight:
    case Disagreement::wrong_flag:
    case Disagreement::wrong_index:
    case Disagreement::wrong_combination:
    case Disagreement::negative_time:
    case Disagreement::false_hit:
    case Disagreement::false_miss: return nearmiss::name_of(d);
    case Disagreement::not_finite: return "non-finite number";
    case Disagreement::not_unit: return "non-unit normal";
  }
  return "?";
}

std::string percent_text(std::uint64_t part, std::uint64_t whole) {
  if (part == 0 || whole == 0) return "0 %";
  const double percent = 100 * double(part) / double(whole);
  return percent >= 10 ? fmt::format("{:.0f} %", percent) : fmt::format("{:.2g} %", percent);
}

/// The cells of one row. A false hit is never added to a false miss.
std::vector<std::string> heading() {
  return {"",      "CASES",   "AGREE",     "NOT PROVED", "FALSE HIT", "FALSE MISS", "WRONG",
          "BROKE", "OUTSIDE", "NO ANSWER", "BACKWARD",   "FORWARD",   "YES",        "EXACT"};
}

std::vector<std::string> table_row(const Tally& t) {
  const std::uint64_t hits = t.violations_by(Disagreement::false_hit),
                      misses = t.violations_by(Disagreement::false_miss);
  return {"  " + t.subject->name,
          count_text(t.cases),
          count_text(t.of(Verdict::agrees)),
          count_text(t.of(Verdict::not_proved)),
          count_text(hits),
          count_text(misses),
          count_text(t.wrong),
          count_text(t.of(Verdict::broke)),
          count_text(t.of(Verdict::out_of_domain) + t.of(Verdict::not_asked)),
          count_text(t.of(Verdict::cannot_answer)),
          t.worst_backward < 0 ? "-" : "> " + epsilons_text(t.worst_backward),
          fmt::format("{:.3g}", t.worst_forward),
          percent_text(t.truth_yes, t.decided()),
          percent_text(t.decided_by_exact, t.decided())};
}

}  // namespace

Counts::Counts(std::vector<const Query*> queries, std::vector<const Subject*> subjects, bool by_class)
    : queries_(std::move(queries)), has_classes_(by_class) {
  extend(std::move(subjects));
}

void Counts::extend(std::vector<const Subject*> subjects) {
  subjects_ = std::move(subjects);
  for (const Query* q : queries_) {
    for (const Subject* s : subjects_) {
      if (!(s->offering(q->name).answer == nullptr)) tallies_.try_emplace({q, s}, Tally{q, s});
    }
  }
}

const Tally* Counts::of(const Query& query, const Subject& subject) const {
  const auto found = tallies_.find({&query, &subject});
  return found == tallies_.end() ? nullptr : &found->second;
}

void Counts::take(const Examined& e) {
  Tally& t = tallies_.at({e.question.query, &e.subject});
  t.count(e.finding);
  t.late += e.answer.late();
  ++cases_;
  bad_ += is_bad(e.finding);
  if (is_bad(e.finding) && WrongCases::may_have(e.question)) t.wrong_cases.add(e.question);
  if (has_classes_) count_by_class(e);
  if (e.of_batch < touching_.size()) {  // only for batches: stored cases touch on purpose
    touch_counts_.count(e.question, e.subject, e.answer, e.finding, touching_[e.of_batch]);
  }
}

bool Counts::needs_second(const Examined& e) const {
  constexpr std::uint64_t one_in = 64;
  const Tally& t = tallies_.at({e.question.query, &e.subject});
  return t.bad() % one_in == 0 || e.finding.forward_at_most > t.worst_forward ||
         (!e.finding.backward && t.worst_backward < 0);
}

void Counts::count_by_class(const Examined& e) {
  if (e.question.moves.empty()) by_class_[{&e.subject, "none"}].count(e.finding);
  for (const auto& move : e.question.moves) by_class_[{&e.subject, std::string(move)}].count(e.finding);
}

void Counts::take_given_up(const Query& query, const Subject& subject, std::uint64_t cases, const Endurance& e) {
  Tally& t = tallies_.at({&query, &subject});
  t.gave_up += cases;
  t.lost = e.lost;
}

void Counts::take_not_judged(const Query& query, const Subject& subject, std::uint64_t answers) {
  tallies_.at({&query, &subject}).not_judged += answers;
  not_judged_ += answers;
}

void Counts::add_to(Json& index) const {
  index["tallies"] = Json::array();
  for (const Query* q : queries_) {
    for (const Subject* s : subjects_) {
      if (const auto t = tallies_.find({q, s}); t != tallies_.end())
        index["tallies"].push_back(tally_to_json(t->second));
    }
  }
  index["stages"] = Json::array();
  for (const Query* q : queries_) {
    const Stages stages = stages_of(*q);
    index["stages"].push_back({{"query", q->name}, {"interval", stages.interval}, {"exact", stages.exact}});
  }
  index["not_offered"] = Json::array();
  for (const Query* q : queries_) {
    for (const Subject* s : subjects_) {
      if (!tallies_.contains({q, s})) {
        index["not_offered"].push_back({{"query", q->name}, {"subject", s->name}, {"why", s->offering(q->name).how}});
      }
    }
  }
  if (has_classes_) index["by_class"] = Json::array();
  for (const auto& [key, t] : by_class_) {
    const std::uint64_t hits = t.violations_by(Disagreement::false_hit);
    const std::uint64_t misses = t.violations_by(Disagreement::false_miss);
    index["by_class"].push_back({{"subject", key.first->name},
                                 {"class", key.second},
                                 {"cases", t.cases},
                                 {"false_hits", hits},
                                 {"false_misses", misses},
                                 {"wrong", t.wrong},
                                 {"broke", t.of(Verdict::broke)}});
  }
  index["touches"] = touch_counts_.to_json();
  index["inconsistent_conventions"] = Json::array();
  for (const TouchCounts::Inconsistent& i : touch_counts_.inconsistent()) {
    index["inconsistent_conventions"].push_back(
        {{"subject", i.subject->name}, {"closed", i.closed}, {"strict", i.strict}});
  }
}

std::string Counts::violated_text() const {
  if (cases_ == 0) return "nothing asked";
  std::map<std::string_view, std::uint64_t> faults;
  std::set<std::string> reasons;
  for (const auto& [key, t] : tallies_) {
    for (const auto& [kind, count] : t.breakages) reasons.insert(kind);
    for (int d = 0; d < disagreement_count; ++d) faults[noun_of(Disagreement(d))] += t.violations[std::size_t(d)];
    faults["breakage"] += t.of(Verdict::broke);
  }
  faults["inconsistent convention"] += touch_counts_.inconsistent().size();
  std::vector<std::string> counted;
  for (const auto& [fault, count] : faults) {
    if (count == 0) continue;
    counted.push_back(plural_text(count, fault));
    if (fault == "breakage" && reasons.size() > 1) counted.back() += fmt::format(" of {} kinds", reasons.size());
  }
  std::map<const Query*, std::uint64_t> asked;
  std::uint64_t not_asked = 0, gave_up = 0;
  for (const auto& [key, t] : tallies_) {
    asked[key.first] += t.cases;
    not_asked += t.of(Verdict::not_asked);
    gave_up += t.gave_up;
  }
  const auto unasked =
      std::uint64_t(std::count_if(asked.begin(), asked.end(), [](const auto& a) { return a.second == 0; }));
  return (counted.empty() ? "nothing violated" : "violations: " + list_text(counted)) +
         (not_asked == 0 ? ""
                         : fmt::format(", {} not asked for what subjects require", plural_text(not_asked, "case"))) +
         (gave_up == 0 ? "" : fmt::format(", {} not asked after breakages", plural_text(gave_up, "case"))) +
         (not_judged_ == 0 ? "" : fmt::format(", {} not judged", plural_text(not_judged_, "answer"))) +
         (unasked == 0 ? "" : fmt::format(", {} of {} queries not asked", unasked, asked.size()));
}

std::vector<std::vector<std::string>> Counts::rows_of_totals() const {
  std::vector<std::vector<std::string>> rows;
  for (const Subject* s : subjects_) {
    Tally all{nullptr, s};
    for (const auto& [key, t] : tallies_) {
      if (key.second == s) all.add(t);
    }
    if (all.cases > 0) rows.push_back(table_row(all));
  }
  return rows;
}

std::string Counts::totals() const {
  if (cases_ == 0) return "";
  std::vector<std::vector<std::string>> rows = rows_of_totals();
  rows.insert(rows.begin(), heading());
  return table_text(rows, "", 1);
}

std::string Counts::table() const {
  if (cases_ == 0) return "";
  std::vector<std::vector<std::string>> rows{heading()};
  for (const Query* q : queries_) {
    bool first = true;
    for (const Subject* s : subjects_) {
      const auto found = tallies_.find({q, s});
      if (found == tallies_.end()) continue;
      if (std::exchange(first, false)) rows.push_back({std::string(q->name)});
      rows.push_back(table_row(found->second));
    }
  }
  if (queries_.size() > 1) {
    rows.push_back({"all queries"});
    const std::vector<std::vector<std::string>> totals = rows_of_totals();
    rows.insert(rows.end(), totals.begin(), totals.end());
  }
  return table_text(rows, "", 1) + breakages_text() + passed_over_text() + stages_text();
}

/// The subjects that were given up or judged by a sample; empty where all were asked and judged to the end.
std::string Counts::passed_over_text() const {
  std::string text;
  for (const auto& [key, t] : tallies_) {
    if (t.gave_up > 0) text += "\n" + t.given_up();
    if (t.not_judged > 0) text += "\n" + not_judged_text(t.subject->name, t.query->name, t.not_judged);
  }
  return text.empty() ? text : text + "\n";
}

/// The reasons of breakages, most frequent first; empty without breakages.
std::string Counts::breakages_text() const {
  struct Row {
    std::uint64_t count;
    std::string subject, query, kind;
  };
  std::vector<Row> all;
  for (const auto& [key, t] : tallies_) {
    for (const auto& [kind, count] : t.breakages) {
      all.push_back({count, key.second->name, std::string(key.first->name), kind});
    }
  }
  if (all.empty()) return "";
  std::sort(all.begin(), all.end(), [](const Row& a, const Row& b) {
    return std::tie(b.count, a.subject, a.query, a.kind) < std::tie(a.count, b.subject, b.query, b.kind);
  });
  std::vector<std::vector<std::string>> rows{{"BROKE", "SUBJECT", "QUERY", "REASON"}};
  for (const Row& r : all) rows.push_back({count_text(r.count), r.subject, r.query, r.kind});
  return fmt::format("\n{}", table_text(rows));
}

Counts::Stages Counts::stages_of(const Query& query) const {
  Stages stages;
  for (const Subject* s : subjects_) {
    const auto found = tallies_.find({&query, s});
    if (found == tallies_.end()) continue;
    stages.interval += found->second.decided_by_interval;
    stages.exact += found->second.decided_by_exact;
  }
  return stages;
}

std::string Counts::stages_text() const {
  Stages all;
  const Query* most = nullptr;
  for (const Query* q : queries_) {
    const Stages stages = stages_of(*q);
    all.interval += stages.interval;
    all.exact += stages.exact;
    if (most == nullptr || stages.exact_share() > stages_of(*most).exact_share()) most = q;
  }
  if (all.interval + all.exact == 0) return "";
  if (all.exact == 0) return "\nIntervals decided every case.\n";
  return fmt::format("\nThe exact stage decided {}, most often of {}: {}; intervals decided the others.\n",
                     percent_text(all.exact, all.interval + all.exact), most->name,
                     percent_text(stages_of(*most).exact, stages_of(*most).interval + stages_of(*most).exact));
}

std::string Counts::touches_text() const {
  std::string text = touch_counts_.text();
  for (const TouchCounts::Inconsistent& i : touch_counts_.inconsistent()) {
    text += fmt::format("{} has an inconsistent convention: exact touches are contact in {}, and none in {}\n",
                        i.subject->name, list_text(i.closed), list_text(i.strict));
  }
  return text.empty() ? text : text + "\n";
}

std::string Counts::table_by_class() const {
  std::vector<std::vector<std::string>> rows{{"", "CASES", "FALSE HIT", "FALSE MISS", "WRONG", "BROKE"}};
  for (const Subject* s : subjects_) {
    bool first = true;
    for (const auto& [key, t] : by_class_) {
      if (key.first != s) continue;
      if (std::exchange(first, false)) rows.push_back({s->name});
      const std::uint64_t hits = t.violations_by(Disagreement::false_hit);
      const std::uint64_t misses = t.violations_by(Disagreement::false_miss);
      rows.push_back({"  " + key.second, count_text(t.cases), count_text(hits), count_text(misses), count_text(t.wrong),
                      count_text(t.of(Verdict::broke))});
    }
  }
  return table_text(rows, "", 1);
}

}  // namespace nearmiss
