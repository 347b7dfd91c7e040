#include "reports/tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "reports/report.hpp"

namespace nearmiss {

void Tally::count(const Finding& f) {
  ++cases;
  ++verdicts[std::size_t(f.verdict)];
  if (f.verdict == Verdict::within_contract) ++within_contract[std::size_t(f.disagreement)];
  if (f.verdict == Verdict::violates_contract) ++violations[std::size_t(f.disagreement)];
  if (f.backward) worst_backward = std::max(worst_backward, f.backward->above);
  const bool judged =
      f.verdict == Verdict::agrees || f.verdict == Verdict::within_contract || f.verdict == Verdict::violates_contract;
  if (!judged || f.disagreement == Disagreement::not_finite) return;  // no truth was asked for
  ++(f.decided_by == Stage::interval ? decided_by_interval : decided_by_exact);
  if (f.truth_yes) ++truth_yes;
  if (std::isfinite(f.forward_ulps)) worst_forward = std::max(worst_forward, f.forward_ulps);
}

void Tally::add(const Tally& other) {
  const auto sum = [](auto& to, const auto& from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  cases += other.cases;
  sum(verdicts, other.verdicts);
  sum(within_contract, other.within_contract);
  sum(violations, other.violations);
  decided_by_interval += other.decided_by_interval;
  decided_by_exact += other.decided_by_exact;
  truth_yes += other.truth_yes;
  worst_backward = std::max(worst_backward, other.worst_backward);
  worst_forward = std::max(worst_forward, other.worst_forward);
}

nlohmann::ordered_json tally_to_json(const Tally& t) {
  using Json = nlohmann::ordered_json;
  Json verdicts = Json::object(), disagreements = Json::object();
  for (int v = 0; v < verdict_count; ++v) verdicts[std::string(name_of(Verdict(v)))] = t.verdicts[std::size_t(v)];
  for (int d = 1; d < disagreement_count; ++d) {
    const std::uint64_t within = t.within_contract[std::size_t(d)], violations = t.violations[std::size_t(d)];
    if (within + violations == 0) continue;
    disagreements[std::string(name_of(Disagreement(d)))] = {{"within_contract", within}, {"violations", violations}};
  }
  return {{"query", t.query->name},
          {"subject", t.subject->name},
          {"cases", t.cases},
          {"verdicts", verdicts},
          {"disagreements", disagreements},
          {"worst_backward_above_epsilon", t.worst_backward < 0 ? Json(nullptr) : Json(t.worst_backward)},
          {"worst_forward_ulps", t.worst_forward},
          {"decided_by", {{"interval", t.decided_by_interval}, {"exact", t.decided_by_exact}}},
          {"yes_share", t.decided() == 0 ? Json(nullptr) : Json(double(t.truth_yes) / double(t.decided()))}};
}

bool Keeper::keep(const Tally& of, const Finding& f) {
  Kept& kept = kept_[fmt::format("{}/{}/{}", of.query->name, of.subject->name, fault_of(f))];
  const double above = f.backward ? f.backward->above : 0;
  const bool much_worse = above > 0 && above >= 2 * kept.worst;
  if (kept.count >= first_few && !much_worse) return false;
  ++kept.count;
  kept.worst = std::max(kept.worst, above);
  return true;
}

}  // namespace nearmiss
