#include "reports/triage/examination/sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "oracles/judge.hpp"
#include "reports/engine/kept_reports.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/version.hpp"

namespace nearmiss {

namespace {

/// Members of an index whose cases depend on the answers, on the time or on files.
constexpr const char* other_cases[] = {"climbs", "stored", "fuzz", "relations", "properties", "scene"};

std::optional<std::uint64_t> seed_of_run(const FileValue& index) {
  for (const char* member : other_cases) {
    if (index.find(member)) return std::nullopt;
  }
  return index.at("seed").whole();
}

std::optional<WrongCases> wrong_cases_in(const FileValue& j) {
  const std::optional<FileValue> digits = j.find("wrong_cases");
  if (!digits) return std::nullopt;
  std::optional<WrongCases> wrong = WrongCases::from_text(digits->text());
  if (!wrong) digits->fail("hexadecimal digits");
  return wrong;
}

/// The cases of a tally that were judged, and all that were drawn for it.
Sample::Asked asked_in(const FileValue& tally) {
  Sample::Asked asked{tally.at("cases").count(), 0, wrong_cases_in(tally)};
  asked.drawn = asked.cases;
  for (const char* passed_over : {"gave_up", "not_judged"}) {
    if (const auto more = tally.find(passed_over)) asked.drawn += more->count();
  }
  return asked;
}

}  // namespace

FindingClass class_of(const FindingKind& kind, FeatureRegions regions) {
  return {kind.query, kind.subject, kind.fault, kind.fault == name_of(Verdict::broke) ? kind.clause : "", regions};
}

std::uint64_t Sample::asked_of(const std::string& query, const std::string& subject) const {
  const auto found = asked.find({query, subject});
  return found == asked.end() ? 0 : found->second.cases;
}

FindingRate Sample::rate_of(const FindingKind& kind, FeatureRegions regions) const {
  FindingRate rate{0, asked_of(kind.query, kind.subject)};
  const FindingClass wanted = class_of(kind, regions);
  for (auto at = findings.lower_bound(class_of(kind, {})); at != findings.end(); ++at) {
    FindingClass same = at->first;
    same.regions = wanted.regions;
    if (same != wanted) break;
    if (regions.within(at->first.regions)) rate.findings += at->second;
  }
  return rate;
}

FindingRate Sample::rate_of(const std::string& query, const std::string& subject) const {
  FindingRate rate{0, asked_of(query, subject)};
  for (const auto& [of, count] : findings) {
    if (of.query == query && of.subject == subject) rate.findings += count;
  }
  return rate;
}

void Sample::add(const FileValue& index) {
  seed = asked.empty() ? seed_of_run(index) : std::nullopt;
  version = index.at("environment").at("nearmiss").text();
  for (const FileValue& t : index.at("tallies").items()) {
    const Asked more = asked_in(t);
    Asked& all = asked[{t.at("query").text(), t.at("subject").text()}];
    all.cases += more.cases, all.drawn += more.drawn;
    all.wrong = more.wrong;  // of use only where the seed is known: of one run
  }
  for (const CountedVariant& v : variants_in(index)) findings[class_of(v.kind, v.variant.regions)] += v.count.findings;
}

bool can_be_drawn_again(const Sample& s) { return s.seed && s.version == version(); }

namespace {

/// Notes which of the cases of a sample have become wrong or right.
class ChangedAnswers : public Sink {
 public:
  explicit ChangedAnswers(const std::optional<WrongCases>& before) : before_(before) {}
  void take(const Examined& e) override {
    if (!before_ || !WrongCases::may_have(e.question) || e.answer.late()) return;
    const bool was_wrong = before_->has(e.question), is_wrong = is_bad(e.finding);
    right_now += was_wrong && !is_wrong;
    if (!was_wrong && is_wrong) wrong_now.push_back(e.question);
  }
  bool needs_second(const Examined&) const override { return false; }

  std::vector<Case> wrong_now;
  std::uint64_t right_now = 0;

 private:
  const std::optional<WrongCases>& before_;
};

}  // namespace

std::optional<AskedAgain> asked_again(const Sample& sample, const std::string& query, const Subject& subject,
                                      std::chrono::steady_clock::time_point until, const std::function<void()>& tick) {
  const Query* q = find_query(query);
  const auto of = sample.asked.find({query, subject.name});
  if (q == nullptr || of == sample.asked.end() || !sample.seed) return std::nullopt;
  // The same sinks as those of a run: which answers are judged twice depends on them.
  Counts counts({q}, {&subject}, false);
  KeptReports kept("", counts, [](const std::filesystem::path&, const std::string&) {});
  ChangedAnswers changed(of->second.wrong);
  Campaign campaign({"", tick}, {&counts, &kept, &changed});
  kept.ask_with(campaign.dispatcher().workers());
  campaign.set_until(until);
  Schedule schedule({q}, {&subject}, of->second.drawn);
  campaign.generate(schedule, *sample.seed);
  const Tally* tally = counts.of(*q, subject);
  if (tally == nullptr || campaign.internal_errors().count() > 0) return std::nullopt;
  AskedAgain again{{}, !campaign.should_stop(), std::move(changed.wrong_now), changed.right_now};
  if (!again.is_whole) return again;
  again.sample.asked[of->first] = {tally->cases, of->second.drawn, tally->wrong_cases};
  const nlohmann::json variants = {{"variants", kept.variants().to_json()}};
  for (const CountedVariant& v : variants_in(FileValue(variants, "the cases of the baseline")))
    again.sample.findings[class_of(v.kind, v.variant.regions)] += v.count.findings;
  return again;
}

nlohmann::ordered_json sample_to_json(const Sample& sample) {
  nlohmann::ordered_json asked = nlohmann::ordered_json::array(), classes = nlohmann::ordered_json::array();
  for (const auto& [of, cases] : sample.asked) {
    asked.push_back({{"query", of.first}, {"subject", of.second}, {"cases", cases.cases}, {"drawn", cases.drawn}});
    if (cases.wrong) asked.back()["wrong_cases"] = cases.wrong->text();
  }
  for (const auto& [of, findings] : sample.findings) {
    classes.push_back({{"query", of.query},
                       {"subject", of.subject},
                       {"fault", of.fault},
                       {"breakage", of.breakage},
                       {"regions", of.regions.names()},
                       {"findings", findings}});
  }
  return {{"seed", sample.seed ? nlohmann::ordered_json(*sample.seed) : nlohmann::ordered_json(nullptr)},
          {"version", sample.version},
          {"asked", asked},
          {"classes", classes}};
}

Sample sample_from_json(const FileValue& j) {
  Sample sample;
  if (const FileValue seed = j.at("seed"); !seed.is_null()) sample.seed = seed.whole();
  sample.version = j.at("version").text();
  for (const FileValue& a : j.at("asked").items())
    sample.asked[{a.at("query").text(), a.at("subject").text()}] = {a.at("cases").count(), a.at("drawn").count(),
                                                                    wrong_cases_in(a)};
  for (const FileValue& c : j.at("classes").items()) {
    const FindingClass of{c.at("query").text(), c.at("subject").text(), c.at("fault").text(), c.at("breakage").text(),
                          feature_regions_named(c.at("regions").texts())};
    sample.findings[of] = c.at("findings").count();
  }
  return sample;
}

}  // namespace nearmiss
