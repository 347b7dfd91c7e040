#include "reports/triage/comparison/run_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/engine/variant_counts.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/severity.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/examination/sources.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using nlohmann::json;

constexpr int diff_schema_version = 1;

/// One run: the cases of each query and subject, and the findings of each kind.
struct RunFindings {
  std::map<std::pair<std::string, std::string>, std::uint64_t> asked;  ///< by query and subject
  std::map<FindingKind, KindInRuns::InRun> kinds;

  std::uint64_t asked_of(const FindingKind& k) const {
    const auto found = asked.find({k.query, k.subject});
    return found == asked.end() ? 0 : found->second;
  }
};

/// Adds a report's bound, and in a run without counts of variants the report itself.
void add_report(RunFindings& run, const fs::path& folder, const WrittenReport& w, bool has_counts) {
  const std::string file = (folder / w.file).string();
  const json report = parse_json(read_file(file), file);
  KindInRuns::InRun& kind = run.kinds[kind_in_report(FileValue(report, file))];
  if (!has_counts) ++kind.findings;
  if (!kind.file.empty() && w.above.value_or(-1) <= kind.above.value_or(-1)) return;
  kind.above = w.above;
  kind.file = w.file;
}

RunFindings findings_of(const fs::path& folder) {
  settle_run(folder);
  const std::string file = (folder / "index.json").string();
  const json j = parse_json(read_file(file), file);
  const FileValue index(j, file);
  index.expect_schema(run_schema_version);
  RunFindings run;
  for (const FileValue& t : index.at("tallies").items()) {
    const auto [at, is_new] =
        run.asked.try_emplace({t.at("query").text(), t.at("subject").text()}, t.at("cases").count());
    if (!is_new) t.fail("the only one of its query and subject");
  }
  const bool has_counts = index.find("variants").has_value();
  for (const CountedVariant& v : variants_in(index)) run.kinds[v.kind].findings += v.count.findings;
  for (const WrittenReport& w : reports_on_disk(folder)) add_report(run, folder, w, has_counts);
  for (auto& [kind, in_run] : run.kinds) in_run.asked = run.asked_of(kind);
  // Reports of an earlier run in the same folder may concern what this run did not ask.
  std::erase_if(run.kinds, [](const auto& k) { return k.second.findings == 0; });
  return run;
}

KindInRuns::Change change_of(const KindInRuns& k) {
  if (k.before.findings == 0) return KindInRuns::Change::fresh;
  if (k.after.findings == 0) return KindInRuns::Change::gone;
  const double before = k.before.above.value_or(0), after = k.after.above.value_or(0);
  return after > 0 && after >= much_worse * before ? KindInRuns::Change::worse : KindInRuns::Change::known;
}

Json in_run_to_json(const KindInRuns::InRun& r) {
  return {{"findings", r.findings},
          {"asked", r.asked},
          {"rate", r.rate()},
          {"above_epsilon", r.above ? Json(*r.above) : Json(nullptr)},
          {"worst", r.file.empty() ? Json(nullptr) : Json(r.file)}};
}

std::string what_of(const FindingKind& k) {
  const std::string member = k.member.empty() || k.member == "decision" ? "" : " of " + k.member;
  const std::string reason = k.fault == "broke" ? ": " + first_words(k.clause, 40) : "";
  return k.fault + member + reason;
}

std::string rate_text(const KindInRuns::InRun& r) {
  if (r.findings == 0) return "-";
  return fmt::format("{} ({})", count_text(r.findings), share_text(r.rate()));
}

}  // namespace

std::string_view name_of(KindInRuns::Change c) {
  switch (c) {
    case KindInRuns::Change::fresh: return "new";
    case KindInRuns::Change::gone: return "gone";
    case KindInRuns::Change::worse: return "worse";
    case KindInRuns::Change::known: return "known";
  }
  return "?";
}

std::vector<KindInRuns> compare_runs(const fs::path& before, const fs::path& after) {
  const RunFindings old_run = findings_of(before), new_run = findings_of(after);
  std::set<FindingKind> kinds;
  for (const RunFindings* run : {&old_run, &new_run}) {
    for (const auto& [kind, unused] : run->kinds) kinds.insert(kind);
  }
  std::vector<KindInRuns> all;
  for (const FindingKind& kind : kinds) {
    KindInRuns k{kind, {0, old_run.asked_of(kind)}, {0, new_run.asked_of(kind)}};
    if (k.before.asked == 0 || k.after.asked == 0) continue;
    if (const auto found = old_run.kinds.find(kind); found != old_run.kinds.end()) k.before = found->second;
    if (const auto found = new_run.kinds.find(kind); found != new_run.kinds.end()) k.after = found->second;
    k.change = change_of(k);
    all.push_back(std::move(k));
  }
  std::stable_sort(all.begin(), all.end(), [](const KindInRuns& a, const KindInRuns& b) {
    constexpr int rank[] = {0, 3, 1, 2};  // new, worse, known, gone
    return std::tuple(rank[int(a.change)], -a.after.rate(), -a.before.rate()) <
           std::tuple(rank[int(b.change)], -b.after.rate(), -b.before.rate());
  });
  return all;
}

Json diff_to_json(const fs::path& before, const fs::path& after, const std::vector<KindInRuns>& kinds) {
  Json list = Json::array();
  for (const KindInRuns& k : kinds) {
    list.push_back({{"change", name_of(k.change)},
                    {"query", k.kind.query},
                    {"subject", k.kind.subject},
                    {"fault", k.kind.fault},
                    {"member", k.kind.member},
                    {"clause", k.kind.clause},
                    {"before", in_run_to_json(k.before)},
                    {"after", in_run_to_json(k.after)}});
  }
  return {{"schema", diff_schema_version},
          {"environment", environment_to_json()},
          {"before", before.string()},
          {"after", after.string()},
          {"kinds", list}};
}

std::string diff_text(const fs::path& after, const std::vector<KindInRuns>& kinds) {
  if (kinds.empty()) return "no findings of what both runs asked\n";
  std::vector<std::vector<std::string>> rows{{"CHANGE", "SUBJECT", "QUERY", "FAULT", "BEFORE", "AFTER"}};
  std::string files;
  for (const KindInRuns& k : kinds) {
    rows.push_back({std::string(name_of(k.change)), k.kind.subject, k.kind.query, what_of(k.kind), rate_text(k.before),
                    rate_text(k.after)});
    const bool shows =
        (k.change == KindInRuns::Change::fresh || k.change == KindInRuns::Change::worse) && !k.after.file.empty();
    if (shows) files += fmt::format("{}: {}\n", name_of(k.change), path_text(after / k.after.file));
  }
  return table_text(rows, "", 4) + (files.empty() ? "" : "\n" + files);
}

}  // namespace nearmiss
