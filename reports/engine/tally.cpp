#include "reports/engine/tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "reports/engine/dispatcher.hpp"
#include "reports/findings/breakage.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

/// The disagreements of the members of the answer, each once.
std::set<Disagreement> ways(const Finding& f, bool breaking) {
  std::set<Disagreement> ways;
  for (const MemberFinding& m : f.members) {
    if (m.breaks() || !breaking) ways.insert(m.disagreement);
  }
  if (f.headline < 0) ways.insert(f.disagreement);
  return ways;
}

bool is_wrong_decision(Disagreement d) { return d == Disagreement::false_hit || d == Disagreement::false_miss; }

}  // namespace

std::string not_judged_text(std::string_view subject, std::string_view query, std::uint64_t answers) {
  return fmt::format("{} is often wrong of {}: only a sample was judged, and {} were not (--every-answer judges all)",
                     subject, query, plural_text(answers, "answer"));
}

void Tally::count(const Finding& f) {
  ++cases;
  ++verdicts[std::size_t(f.verdict)];
  if (f.verdict == Verdict::not_proved) {
    for (const Disagreement d : ways(f, false)) ++not_proved[std::size_t(d)];
  }
  const bool violates = f.is_proved();
  if (violates) {
    const std::set<Disagreement> all = ways(f, true);
    for (const Disagreement d : all) ++violations[std::size_t(d)];
    wrong += std::any_of(all.begin(), all.end(), [](Disagreement d) { return !is_wrong_decision(d); });
  }
  if (f.verdict == Verdict::broke) ++breakages[breakage_of(f)];
  if (f.backward) worst_backward = std::max(worst_backward, f.backward->above);
  if (!violates && f.verdict != Verdict::agrees && f.verdict != Verdict::not_proved)
    return;  // the judge did not compute the exact answer
  ++(f.decided_by == Stage::interval ? decided_by_interval : decided_by_exact);
  if (f.truth_yes) ++truth_yes;
  if (std::isfinite(f.forward_ulps)) worst_forward = std::max(worst_forward, f.forward_ulps);
}

std::string Tally::given_up() const {
  const std::uint64_t answered = cases - of(Verdict::broke) - of(Verdict::not_asked);
  return given_up_text(subject->name, query->name, {cases, late, of(Verdict::broke), answered, gave_up, lost});
}

std::string Tally::breakage_of(const Finding& f) const {
  std::string kind = kind_of_breakage(f.clause, f.cause);
  return breakages.contains(kind) || breakages.size() < most_kinds ? kind : other_kind;
}

void Tally::add(const Tally& other) {
  const auto sum = [](auto& to, const auto& from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  cases += other.cases;
  sum(verdicts, other.verdicts);
  sum(not_proved, other.not_proved);
  sum(violations, other.violations);
  for (const auto& [kind, n] : other.breakages) breakages[kind] += n;
  wrong += other.wrong;
  late += other.late;
  gave_up += other.gave_up;
  if (lost.empty()) lost = other.lost;
  not_judged += other.not_judged;
  decided_by_interval += other.decided_by_interval;
  decided_by_exact += other.decided_by_exact;
  truth_yes += other.truth_yes;
  worst_backward = std::max(worst_backward, other.worst_backward);
  worst_forward = std::max(worst_forward, other.worst_forward);
}

nlohmann::ordered_json tally_to_json(const Tally& t) {
  Json verdicts = Json::object(), disagreements = Json::object();
  for (int v = 0; v < verdict_count; ++v) verdicts[std::string(name_of(Verdict(v)))] = t.verdicts[std::size_t(v)];
  for (int d = 1; d < disagreement_count; ++d) {
    const std::uint64_t unproved = t.not_proved[std::size_t(d)], violations = t.violations[std::size_t(d)];
    if (unproved + violations == 0) continue;
    disagreements[std::string(name_of(Disagreement(d)))] = {{"not_proved", unproved}, {"violations", violations}};
  }
  Json j{{"query", t.query->name},
         {"subject", t.subject->name},
         {"cases", t.cases},
         {"verdicts", verdicts},
         {"disagreements", disagreements},
         {"wrong", t.wrong},
         {"breakages", t.breakages},
         {"late", t.late},
         {"gave_up", t.gave_up},
         {"not_judged", t.not_judged},
         {"worst_backward_above_epsilon", t.worst_backward < 0 ? Json(nullptr) : Json(t.worst_backward)},
         {"worst_forward_ulps", t.worst_forward},
         {"decided_by", {{"interval", t.decided_by_interval}, {"exact", t.decided_by_exact}}},
         {"yes_share", t.decided() == 0 ? Json(nullptr) : Json(double(t.truth_yes) / double(t.decided()))}};
  if (t.gave_up > 0) {
    j["given_up"] = t.given_up();
  } else {
    j["wrong_cases"] = t.wrong_cases.text();
  }
  return j;
}

namespace {

/// True where `keeps` is true of the kind and the bound of any fault of the finding; asks about each one.
template <class Keeps>
bool any_is_kept(const Tally& of, const Finding& f, Keeps keeps) {
  const auto keeps_fault = [&](std::string_view fault, const std::optional<Backward>& bound) {
    return keeps(fmt::format("{}/{}/{}", of.query->name, of.subject->name, fault), bound ? bound->above : 0);
  };
  if (f.verdict == Verdict::broke) return keeps_fault("broke/" + of.breakage_of(f), std::nullopt);
  if (f.headline < 0) return keeps_fault(fault_of(f), f.backward);
  bool any = false;
  for (const MemberFinding& m : f.members) {
    if (m.breaks()) any = keeps_fault(fmt::format("{}/{}", name_of(m.disagreement), m.member), m.backward) || any;
  }
  return any;
}

/// Two variants with one number would share their first few.
std::uint64_t number_of(const Variant& v) {
  return (v.branches ^ std::uint64_t{v.regions.bits()} << 1) * 2 + v.ordinary;
}

}  // namespace

bool FindingRetention::keep(const Tally& of, const Finding& f, const Variant& variant) {
  return any_is_kept(of, f, [&](const std::string& kind, double above) {
    return retention_.keep(kind, number_of(variant), above, {first_few, most_of_a_kind});
  });
}

bool FindingRetention::would_keep(const Tally& of, const Finding& f, const Variant& variant) const {
  return any_is_kept(of, f, [&](const std::string& kind, double above) {
    return retention_.would_keep(kind, number_of(variant), above, {first_few, most_of_a_kind});
  });
}

}  // namespace nearmiss
