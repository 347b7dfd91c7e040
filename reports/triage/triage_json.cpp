#include "reports/triage/triage_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/causes/cause_json.hpp"
#include "reports/triage/triage_text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

constexpr int triage_schema_version = 1;

template <class T>
Json or_null(const std::optional<T>& x) {
  return x ? Json(*x) : Json(nullptr);
}

Json decision_to_json(const std::optional<SignatureDecision>& d) {
  if (!d) return nullptr;
  return {{"kind", name_of(d->kind)},
          {"url", d->kind == SignatureDecision::Kind::reported ? Json(d->argument) : Json(nullptr)},
          {"version", d->kind == SignatureDecision::Kind::fixed ? Json(d->argument) : Json(nullptr)},
          {"note", d->note},
          {"reopened", d->reopened}};
}

Json case_of_signature(const Case& c) {
  Json j = case_to_json(c);
  j.erase("origin");
  return j;
}

Json cases_of_signature(const std::vector<Case>& cases) {
  Json all = Json::array();
  for (const Case& c : cases) all.push_back(case_of_signature(c));
  return all;
}

Json part_to_json(const FindingPart& p) {
  return {{"query", p.kind.query},
          {"fault", p.kind.fault},
          {"member", p.kind.member},
          {"clause", p.kind.clause},
          {"regions", p.regions.names()}};
}

Json parts_to_json(const std::vector<FindingPart>& parts) {
  Json all = Json::array();
  for (const FindingPart& p : parts) all.push_back(part_to_json(p));
  return all;
}

Json magnitude_or_null(double x) { return x > 0 ? Json(x) : Json(nullptr); }

Json range_to_json(const std::optional<ExtremeMagnitudes>& r) {
  if (!r) return nullptr;
  return {{"up_from", magnitude_or_null(r->up_from)}, {"down_from", magnitude_or_null(r->down_from)}};
}

Json signature_to_json(const TriagedSignature& s) {
  Json cause = cause_to_json(s.cause);
  cause.erase("questions");
  return {{"id", s.id},
          {"names", s.names},
          {"query", s.kind.query},
          {"subject", s.kind.subject},
          {"version", s.version},
          {"asked_as", s.asked_as},
          {"scalar", name_of(s.case_of_simplest.scalar)},
          {"fault", s.kind.fault},
          {"member", s.kind.member},
          {"clause", s.kind.clause},
          {"parts", parts_to_json(s.parts)},
          {"range", range_to_json(s.range)},
          {"cause", cause},
          {"examined", s.examined},
          {"regions", s.regions.names()},
          {"branches", fmt::format("{:016x}", s.branches)},
          {"change", s.change ? Json(name_of(*s.change)) : Json(nullptr)},
          {"why", s.why},
          {"decision", decision_to_json(s.decision)},
          {"severity", s.severity},
          {"severity_text", severity_text(s)},
          {"count", s.reports.size()},
          {"findings", s.findings},
          {"without_report", s.without_report()},
          {"ordinary_share", s.ordinary_share},
          {"headline", s.headline},
          {"above_epsilon", or_null(s.size.above_epsilon)},
          {"relative", s.size.relative},
          {"amount", s.size.amount},
          {"unit", s.size.unit},
          {"worst", s.worst},
          {"simplest", s.simplest},
          {"case", case_of_signature(s.case_of_simplest)},
          {"worst_case", s.case_of_worst ? case_of_signature(*s.case_of_worst) : Json(nullptr)},
          {"cases", cases_of_signature(s.cases)},
          {"reports", s.reports},
          {"ids", s.ids}};
}

Json totals(const Triage& t) {
  std::uint64_t reports = 0, findings = 0, reopened = 0;
  for (const TriagedSignature& s : t.signatures) {
    reports += s.reports.size(), findings += s.findings;
    reopened += s.decision && s.decision->reopened;
  }
  const auto of = [&](SignatureChange c) {
    return std::count_if(t.signatures.begin(), t.signatures.end(), [&](const auto& s) { return s.change == c; });
  };
  return {{"signatures", t.signatures.size()},
          {"reports", reports},
          {"findings", findings},
          {"new", of(SignatureChange::fresh)},
          {"worse", of(SignatureChange::worse)},
          {"known", of(SignatureChange::known)},
          {"unproved", of(SignatureChange::unproved)},
          {"fixed in part", of(SignatureChange::part_fixed)},
          {"fixed", of(SignatureChange::fixed)},
          {"reopened", reopened},
          {"right_now", t.right_now.size()},
          {"findings_right_now", t.findings_right_now},
          {"left_out", t.left_out}};
}

/// The case of a signature, of the signature's query.
Case case_in(const FileValue& j) {
  try {
    return case_from_json(j.json(), j.file());
  } catch (const BadInput& e) {
    throw BadInput(fmt::format("{}, in the case of a signature", e.what()));
  }
}

double number_up_to(double most, const FileValue& j) {
  if (!j.json().is_number() || j.number() < 0 || j.number() > most) j.fail(fmt::format("a number from 0 to {}", most));
  return j.number();
}

std::optional<SignatureChange> change_in(const FileValue& word) {
  if (word.is_null()) return std::nullopt;
  for (const SignatureChange c : all_signature_changes) {
    if (word.json() == name_of(c)) return c;
  }
  word.fail("\"new\", \"worse\", \"known\", \"unproved\", \"fixed in part\", \"fixed\" or null");
}

FindingPart part_in(const FileValue& j, const std::string& subject) {
  return {{j.at("query").text(), subject, j.at("fault").text(), j.at("member").text(), j.at("clause").text()},
          feature_regions_named(j.at("regions").texts())};
}

std::optional<ExtremeMagnitudes> range_in(const FileValue& j) {
  if (j.is_null()) return std::nullopt;
  return ExtremeMagnitudes{j.at("up_from").number_or_null().value_or(0),
                           j.at("down_from").number_or_null().value_or(0)};
}

/// What a file of an older version does not have.
void read_what_identifies(const FileValue& j, TriagedSignature& s) {
  if (const auto range = j.find("range")) s.range = range_in(*range);
  s.may_stand = !s.range;
  if (const auto parts = j.find("parts")) {
    for (const FileValue& p : parts->items()) s.parts.push_back(part_in(p, s.kind.subject));
  } else {
    s.parts = {{s.kind, s.regions}};
  }
  if (const auto names = j.find("names")) {
    for (const std::string& name : names->texts()) s.names.insert(name);
  } else {
    s.names = names_of_finding(s.parts.front(), s.cause);
  }
  s.names.insert(s.id);
  const auto worst = j.find("worst_case");
  if (worst && !worst->is_null()) s.case_of_worst = case_in(*worst);
  if (const auto asked_as = j.find("asked_as")) s.asked_as = asked_as->text();
  if (const auto cases = j.find("cases")) {
    for (const FileValue& c : cases->items()) s.cases.push_back(case_in(c));
  }
}

TriagedSignature signature_from_json(const FileValue& j) {
  TriagedSignature s;
  s.id = j.at("id").text();
  s.kind = {j.at("query").text(), j.at("subject").text(), j.at("fault").text(), j.at("member").text(),
            j.at("clause").text()};
  s.cause = cause_from_json(j.at("cause"));
  s.branches = j.at("branches").hexadecimal();
  s.regions = feature_regions_named(j.at("regions").texts());
  s.version = j.at("version").text();
  s.examined = j.at("examined").flag();
  s.size.relative = j.at("relative").not_negative();
  s.size.above_epsilon = j.at("above_epsilon").number_or_null();
  s.size.amount = j.at("amount").not_negative(), s.size.unit = j.at("unit").text();
  s.severity = number_up_to(100, j.at("severity"));
  s.headline = j.at("headline").text();
  s.findings = j.at("findings").count();
  s.ordinary_share = number_up_to(1, j.at("ordinary_share"));
  s.worst = j.at("worst").text(), s.simplest = j.at("simplest").text();
  s.case_of_simplest = case_in(j.at("case"));
  s.reports = j.at("reports").texts();
  s.ids = j.at("ids").texts();
  read_what_identifies(j, s);
  if (change_in(j.at("change")) == SignatureChange::fixed) s.change = SignatureChange::fixed;
  return s;
}

// SARIF.

std::string level_of(const TriagedSignature& s) {
  if (!s.stands()) return "note";
  return s.kind.fault == "broke" || s.kind.fault == "false-miss" || s.kind.fault == "false-hit" ? "error" : "warning";
}

std::string_view baseline_state(SignatureChange c) {
  switch (c) {
    case SignatureChange::fresh: return "new";
    case SignatureChange::worse: return "updated";
    case SignatureChange::known: return "unchanged";
    case SignatureChange::unproved: return "new";
    case SignatureChange::part_fixed: return "updated";
    case SignatureChange::fixed: return "absent";
  }
  return "none";
}

/// A file as a reference that RFC 3986 allows: other characters than those of plain names are escaped.
std::string uri_of(const std::string& file) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
  std::string uri = file.starts_with('/') ? "file://" : "";
  for (const char c : file) {
    uri += plain.find(c) != std::string_view::npos ? std::string(1, c) : fmt::format("%{:02X}", std::uint8_t(c));
  }
  return uri;
}

Json sarif_result(const TriagedSignature& s) {
  Json r{{"ruleId", s.kind.fault},
         {"level", level_of(s)},
         {"message", {{"text", fmt::format("{}. {} Signature {}.", s.headline, sentences_of(s.cause), s.id)}}},
         {"partialFingerprints", {{"nearmissSignature/v1", s.id}}}};
  const std::string& file = s.simplest.empty() ? s.worst : s.simplest;
  if (!file.empty()) {
    r["locations"] = Json::array({{{"physicalLocation", {{"artifactLocation", {{"uri", uri_of(file)}}}}}}});
  }
  r["occurrenceCount"] = std::max<std::uint64_t>(1, s.findings);
  if (s.change) r["baselineState"] = baseline_state(*s.change);
  if (s.decision && !s.decision->reopened) {
    const std::string why = s.decision->note.empty() ? std::string(name_of(s.decision->kind)) : s.decision->note;
    r["suppressions"] = Json::array({{{"kind", "external"}, {"status", "accepted"}, {"justification", why}}});
  }
  r["properties"] = {{"query", s.kind.query},
                     {"subject", s.kind.subject},
                     {"severity", s.severity},
                     {"cause", name_of(s.cause.kind)},
                     {"reports", s.reports.size()}};
  return r;
}

// JUnit.

std::string junit_outcome(const TriagedSignature& s) {
  if (s.change == SignatureChange::fixed) return "";
  const std::string_view change = s.change ? name_of(*s.change) : "stands";
  if (s.stands()) {
    return fmt::format("      <failure type=\"{}\" message=\"{}\">{}</failure>\n", in_xml(s.kind.fault),
                       in_xml(fmt::format("{}: {}", change, s.headline)), in_xml(signature_text(s)));
  }
  const std::string why = s.decision ? std::string(name_of(s.decision->kind)) : std::string(change);
  return fmt::format("      <skipped message=\"{}\"/>\n", in_xml(why));
}

}  // namespace

Json triage_to_json(const Triage& t) {
  Json skipped = Json::array(), signatures = Json::array();
  for (const auto& [file, why] : t.skipped) skipped.push_back({{"file", file}, {"why", why}});
  for (const TriagedSignature& s : t.signatures) signatures.push_back(signature_to_json(s));
  Json j{{"schema", triage_schema_version},
         {"environment", environment_to_json()},
         {"sources", t.sources},
         {"skipped", skipped},
         {"sample", sample_to_json(t.sample)},
         {"measure", measure_to_json(t.measure)},
         {"signatures", signatures},
         {"totals", totals(t)}};
  for (const ProposedConvention& p : t.proposals)
    j["proposals"].push_back({{"declare", declarations_of(p)}, {"findings", p.findings}});
  return j;
}

std::vector<TriagedSignature> signatures_from_json(const nlohmann::json& j, const std::string& where) {
  const FileValue whole(j, where);
  whole.expect_schema(triage_schema_version);
  std::vector<TriagedSignature> all;
  for (const FileValue& s : whole.at("signatures").items()) all.push_back(signature_from_json(s));
  return all;
}

Sample sample_in_triage(const nlohmann::json& j, const std::string& where) {
  const std::optional<FileValue> sample = FileValue(j, where).find("sample");
  return sample ? sample_from_json(*sample) : Sample();
}

std::optional<SceneMeasure> measure_in_triage(const nlohmann::json& j, const std::string& where) {
  if (!j.contains("measure")) return std::nullopt;
  return measure_in(j["measure"], where);
}

Json triage_to_sarif(const Triage& t) {
  Json rules = Json::array(), results = Json::array();
  for (const TriagedSignature& s : t.signatures) {
    const bool is_known =
        std::any_of(rules.begin(), rules.end(), [&](const Json& r) { return r["id"] == s.kind.fault; });
    std::string words = s.kind.fault;
    std::replace(words.begin(), words.end(), '-', ' ');
    if (!is_known) rules.push_back({{"id", s.kind.fault}, {"shortDescription", {{"text", words}}}});
    results.push_back(sarif_result(s));
  }
  const Json environment = environment_to_json();
  return {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
          {"version", "2.1.0"},
          {"runs",
           Json::array(
               {{{"tool", {{"driver", {{"name", "nearmiss"}, {"version", environment["nearmiss"]}, {"rules", rules}}}}},
                 {"results", results}}})}};
}

std::string triage_to_junit(const Triage& t) {
  std::size_t failures = 0, skipped = 0;
  std::string cases;
  for (const TriagedSignature& s : t.signatures) {
    failures += s.stands();
    skipped += !s.stands() && s.change != SignatureChange::fixed;
    const std::string outcome = junit_outcome(s);
    cases += fmt::format("    <testcase classname=\"{}.{}\" name=\"{} {}\"", in_xml(s.kind.subject),
                         in_xml(s.kind.query), in_xml(s.kind.fault), s.id);
    cases += outcome.empty() ? "/>\n" : ">\n" + outcome + "    </testcase>\n";
  }
  const std::string counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\"", t.signatures.size(), failures, skipped);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n  <testsuite name=\"nearmiss triage\" {0}>\n{1}"
      "  </testsuite>\n</testsuites>\n",
      counts, cases);
}

}  // namespace nearmiss
