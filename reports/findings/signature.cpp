#include "reports/findings/signature.hpp"

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

Signature signature_of(const Finding& f) {
  Signature s;
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
    k.member = head->member == MemberFinding::decision ? "decision" : query.member_name(std::size_t(head->member));
  }
  return k;
}

FindingKind kind_in_report(const nlohmann::json& report) {
  const nlohmann::json& f = report.at("finding");
  FindingKind k{report.at("query"), report.at("subject").at("name"), "", "", ""};
  if (f.at("verdict") == name_of(Verdict::broke)) {
    const std::string reason = report.at("answer").at("reason");
    k.fault = name_of(Verdict::broke);
    k.clause = kind_of_breakage(reason, cause_in_report(reason, report.at("answer").value("late", false)));
    return k;
  }
  k.fault = with_hyphens(f.at("disagreement"));
  k.clause = name_of(clause_in_words(f.at("clause"), f.at("disagreement")));
  if (f.contains("headline") && f.at("headline").is_number_unsigned())
    k.member = f.at("members").at(f.at("headline").get<std::size_t>()).at("member");
  return k;
}

}  // namespace nearmiss
