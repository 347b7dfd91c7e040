#include "reports/triage/triage_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

std::string findings_text(const TriagedSignature& s) {
  if (s.reports.empty()) return "";
  const std::string without =
      s.without_report() == 0 ? "" : fmt::format(" ({} without a report)", count_text(s.without_report()));
  return fmt::format("{}{}, {} in ordinary scenes", plural_text(s.findings, "finding"), without,
                     share_text(s.ordinary_share));
}

std::string decision_text(const SignatureDecision& d) {
  const std::string argument = d.argument.empty() ? "" : " " + d.argument;
  const std::string note = d.note.empty() ? "" : fmt::format(" ({})", one_line(d.note, 80));
  if (!d.reopened) return fmt::format("{}{}{}", name_of(d.kind), argument, note);
  return fmt::format("re-opened: it was {}{}, and is {}{}", name_of(d.kind), argument,
                     d.kind == SignatureDecision::Kind::fixed ? "here again" : "worse now", note);
}

/// "in 4 queries"; empty for one.
std::string queries_text(const TriagedSignature& s) {
  std::set<std::string> queries;
  for (const FindingPart& p : s.parts) queries.insert(p.kind.query);
  return queries.size() < 2 ? "" : fmt::format("in {} queries: {}", queries.size(), fmt::join(queries, ", "));
}

/// The faults of the row but that of its worst finding.
std::string other_faults_text(const TriagedSignature& s) {
  std::set<std::string> faults;
  for (const FindingPart& p : s.parts) faults.insert(p.kind.fault);
  faults.erase(s.kind.fault);
  return faults.empty() ? "" : fmt::format(", {}", fmt::join(faults, ", "));
}

/// "new", "worse", "re-opened: …".
std::string state_text(const TriagedSignature& s) {
  const std::string change = s.change ? std::string(name_of(*s.change)) : "";
  if (!s.decision) return change;
  return change.empty() ? decision_text(*s.decision) : change + ", " + decision_text(*s.decision);
}

std::string needs_text(const TriagedSignature& s) {
  std::vector<std::string> names;
  for (const std::string_view name : s.regions.names()) names.emplace_back(name);
  return names.empty() ? "" : fmt::format(" Only with {}.", list_text(names));
}

}  // namespace

std::string triage_counts_text(const Triage& t) {
  std::uint64_t reports = 0, findings = 0, reopened = 0;
  std::size_t here = 0;
  for (const TriagedSignature& s : t.signatures) {
    reports += s.reports.size(), findings += s.findings, here += s.change != SignatureChange::fixed;
    reopened += s.decision && s.decision->reopened;
  }
  std::string text = fmt::format("{} in {} ({})", plural_text(here, "signature"), plural_text(findings, "finding"),
                                 plural_text(reports, "report"));
  const bool compared = std::any_of(t.signatures.begin(), t.signatures.end(), [](const auto& s) { return s.change; });
  for (const SignatureChange c : all_signature_changes) {
    const auto n =
        std::count_if(t.signatures.begin(), t.signatures.end(), [&](const auto& s) { return s.change == c; });
    if ((c == SignatureChange::unproved || c == SignatureChange::part_fixed) && n == 0) continue;
    if (compared) text += fmt::format("{} {} {}", c == SignatureChange::fresh ? ":" : ",", n, name_of(c));
  }
  if (reopened > 0) text += fmt::format("; {} re-opened", plural_text(reopened, "decision"));
  return text + "\n";
}

std::string severity_text(const TriagedSignature& s) {
  std::string fault = s.kind.fault;
  std::replace(fault.begin(), fault.end(), '-', ' ');
  const std::string size = s.kind.fault == "broke" || s.kind.fault == "not-finite" ? "" : ", " + size_text(s.size);
  const std::string findings = findings_text(s);
  return fmt::format("{}{}{}", fault, size, findings.empty() ? "" : ", " + findings);
}

std::string signature_text(const TriagedSignature& s) {
  const std::string state = state_text(s), behind = state.empty() ? "" : fmt::format(", {}", state);
  const std::string member =
      s.kind.member.empty() || s.kind.member == "decision" ? "" : fmt::format(" ({})", s.kind.member);
  std::string text = wrapped_text(fmt::format("{}  {} {}: {}{}{}{}", s.id, s.kind.subject, s.kind.query, s.kind.fault,
                                              member, other_faults_text(s), behind),
                                  "     ");
  text.replace(0, 5, fmt::format("{:3.0f}  ", s.severity));
  const std::string findings = findings_text(s);
  text += wrapped_text(size_text(s.size) + (findings.empty() ? "" : "; " + findings), "     ");
  if (!s.why.empty()) text += wrapped_text(s.why, "     ");
  if (!s.asked_as.empty()) text += fmt::format("     asked as: {}\n", s.asked_as);  // a line of its own: foreign text
  if (const std::string queries = queries_text(s); !queries.empty()) text += wrapped_text(queries, "     ");
  text += wrapped_text(sentences_of(s.cause) + (s.range ? "" : needs_text(s)), "     ");
  if (!s.simplest.empty()) text += fmt::format("     {}\n", path_text(s.simplest));
  return text;
}

std::string triage_text(const Triage& t, std::size_t rows) {
  std::string text = triage_counts_text(t);
  const std::size_t shown = std::min(rows, t.signatures.size());
  for (std::size_t i = 0; i < shown; ++i) text += fmt::format("\n{}", signature_text(t.signatures[i]));
  if (shown < t.signatures.size()) {
    text +=
        fmt::format("\nand {} less severe: --rows {} shows all\n", t.signatures.size() - shown, t.signatures.size());
  }
  if (!t.right_now.empty()) {
    text += fmt::format("\n{}: the subject, asked again, is right now\n", plural_text(t.right_now.size(), "report"));
  }
  if (!t.proposals.empty()) text += "\nif the documentation says so:\n" + proposals_text(t.proposals);
  if (t.left_out > 0) text += fmt::format("\n{} of extreme magnitudes left out\n", plural_text(t.left_out, "finding"));
  if (!t.all_examined)
    text += "\nNot every kind was examined; the same command goes on, --minutes gives it more time\n";
  return text;
}

}  // namespace nearmiss
