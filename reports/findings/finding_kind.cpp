#include "reports/findings/finding_kind.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "reports/findings/breakage.hpp"
#include "reports/findings/report.hpp"

namespace nearmiss {

namespace {

/// The clause that a report states in words (Finding::clause).
Clause clause_in_words(const std::string& words, const std::string& disagreement) {
  if (disagreement == name_of(Disagreement::not_finite)) return Clause::finite_numbers;
  if (disagreement == name_of(Disagreement::negative_time)) return Clause::no_negative_time;
  constexpr std::array<std::pair<std::string_view, Clause>, 5> beginnings = {
      {{"exact decisions", Clause::exact_decisions},
       {"backward error", Clause::backward},
       {"forward error", Clause::forward},
       {"normals of length", Clause::unit},
       {"the scene", Clause::scene}}};
  for (const auto& [beginning, clause] : beginnings) {
    if (words.starts_with(beginning)) return clause;
  }
  return Clause::none;
}

std::string with_hyphens(std::string text) {
  for (char& c : text) c = c == ' ' ? '-' : c;
  return text;
}

}  // namespace

KindKey kind_key_of(const Finding& f) {
  KindKey s;
  s.verdict = f.verdict;
  s.disagreement = f.disagreement;
  if (const MemberFinding* headline = f.headline_member()) s.member = headline->member;
  s.broken = f.broken;
  if (f.verdict == Verdict::broke) s.breakage = kind_of_breakage(f.clause, f.cause);
  return s;
}

std::string_view name_of(Clause c) {
  switch (c) {
    case Clause::none: return "";
    case Clause::exact_decisions: return "exact decisions";
    case Clause::backward: return "backward error";
    case Clause::forward: return "forward error";
    case Clause::unit: return "length of normals";
    case Clause::scene: return "what the scene requires";
    case Clause::finite_numbers: return "finite numbers";
    case Clause::no_negative_time: return "no negative time";
  }
  return "";
}

FindingKind kind_of_finding(const Query& query, const std::string& subject, const Finding& f) {
  FindingKind k{std::string(query.name), subject, fault_of(f), "", std::string(name_of(f.broken))};
  if (f.verdict == Verdict::broke) {
    k.clause = kind_of_breakage(f.clause, f.cause);
  } else if (const MemberFinding* head = f.headline_member()) {
    k.member =
        head->member == MemberFinding::decision ? "decision" : query.layout.parts[std::size_t(head->member)].name;
  }
  return k;
}

namespace {

std::string breakage_in_report(const FileValue& report) {
  const FileValue answer = report.at("answer");
  const std::string reason = answer.at("reason").text();
  const std::optional<FileValue> late = answer.find("late");
  return kind_of_breakage(reason, cause_in_report(reason, late && late->flag()));
}

/// The member of the headline: its index among the members of the finding, or none.
std::string headline_member_in(const FileValue& finding) {
  const std::optional<FileValue> headline = finding.find("headline");
  if (!headline || headline->is_null()) return "";
  const std::vector<FileValue> members = finding.at("members").items();
  const std::uint64_t index = headline->whole();
  if (index >= members.size()) headline->fail("the index of a member of the finding");
  return members[index].at("member").text();
}

}  // namespace

FindingKind kind_in_report(const FileValue& report) {
  const FileValue f = report.at("finding");
  FindingKind k{report.at("query").text(), report.at("subject").at("name").text(), "", "", ""};
  if (f.at("verdict").text() == name_of(Verdict::broke)) {
    k.fault = name_of(Verdict::broke);
    k.clause = breakage_in_report(report);
    return k;
  }
  k.fault = with_hyphens(f.at("disagreement").text());
  k.clause = name_of(clause_in_words(f.at("clause").text(), f.at("disagreement").text()));
  k.member = headline_member_in(f);
  return k;
}

}  // namespace nearmiss
