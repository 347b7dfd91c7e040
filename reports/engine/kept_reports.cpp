#include "reports/engine/kept_reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "reports/engine/replay.hpp"
#include "reports/engine/worst_findings.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/report_text.hpp"

namespace nearmiss {

KeptReports::KeptReports(std::filesystem::path folder, const Counts& counts, Write write)
    : folder_(std::move(folder)), counts_(counts), write_(std::move(write)) {}

void KeptReports::list_those_on_disk() {
  written_ = reports_on_disk(folder_);
  for (WrittenReport& w : written_) w.earlier = true;
}

namespace {

Variant variant_of(const Examined& e) {
  return {e.finding.branches, feature_regions_of(e.question), is_ordinary(e.question)};
}

}  // namespace

bool KeptReports::needs_second(const Examined& e) const {
  return is_bad(e.finding) &&
         retention_.would_keep(*counts_.of(*e.question.query, e.subject), e.finding, variant_of(e));
}

void KeptReports::take(const Examined& e) {
  if (!is_bad(e.finding)) return;
  const Tally& tally = *counts_.of(*e.question.query, e.subject);
  const Variant variant = variant_of(e);
  const bool kept = retention_.keep(tally, e.finding, variant);
  variants_.count(tally, e, variant, kept);
  if (!kept) return;
  pending_.push_back({e.question, &e.subject, e.answer, std::string(e.output)});
}

void KeptReports::end_batch() {
  for (const Pending& p : pending_) write_report(p);
  pending_.clear();
}

void KeptReports::write_report(const Pending& p) {
  Report r = examine(p.question, *p.subject, p.answer, *workers_);
  r.output = p.output;
  const std::string name = fmt::format("{}-{}-{}.json", r.subject, fault_of(r.finding), id_of(r));
  const std::filesystem::path below = std::filesystem::path("findings") / r.question.query->name / name;
  r.replay = replay_command(*p.subject, (folder_ / below).string());
  write_(below, pretty_json(report_to_json(r)));
  std::erase_if(written_, [&](const WrittenReport& w) { return w.earlier && w.file == below.generic_string(); });
  const bool broke = r.finding.verdict == Verdict::broke;
  put_in_order({below.generic_string(), id_of(r), std::string(r.question.query->name), r.subject,
                std::string(name_of(r.finding.verdict)), std::string(name_of(r.finding.disagreement)), headline(r),
                broke ? counts_.of(*r.question.query, *p.subject)->breakage_of(r.finding) : "",
                r.finding.backward ? std::optional(r.finding.backward->above) : std::nullopt});
}

/// By name: the order in which answers arrive depends on the speed of hosts.
void KeptReports::put_in_order(WrittenReport w) {
  const auto behind = std::upper_bound(written_.begin(), written_.end(), w, [](const auto& a, const auto& b) {
    return std::pair(!a.earlier, std::string_view(a.file)) < std::pair(!b.earlier, std::string_view(b.file));
  });
  written_.insert(behind, std::move(w));
}

std::vector<std::string> KeptReports::vanished() const {
  std::vector<std::string> files;
  for (const WrittenReport& w : written_) {
    if (!w.earlier) files.push_back(w.file);
  }
  return vanished_from(folder_, files);
}

std::size_t KeptReports::count() const {
  return std::size_t(
      std::count_if(written_.begin(), written_.end(), [](const WrittenReport& w) { return !w.earlier; }));
}

std::string KeptReports::worst_text() const {
  std::vector<WorstFinding> findings;
  for (const WrittenReport& w : written_) {
    if (w.earlier) continue;
    findings.push_back({fmt::format("{}/{}/{}/{}/{}", w.query, w.subject, w.verdict, w.disagreement, w.breakage),
                        w.above.value_or(-1), w.headline, w.file});
  }
  return nearmiss::worst_text(findings, folder_, "index.json");
}

}  // namespace nearmiss
