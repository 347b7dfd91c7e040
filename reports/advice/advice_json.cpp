#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/advice/advice.hpp"
#include "reports/advice/advice_json.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/findings/report.hpp"
#include "reports/trade/trade_json.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

Json largest_to_json(const LargestError& e) { return {{"proved", e.proved}, {"at_most", e.at_most}}; }

Json requirements_to_json(const std::vector<MetRequirement>& all) {
  Json array = Json::array();
  for (const MetRequirement& r : all) array.push_back(requirement_to_json(r));
  return array;
}

Json nanoseconds_to_json(const RankedSubject& c) {
  const std::optional<Quantiles>& call = c.measured->nanoseconds;
  return {{"p50", optional_to_json(c.measured->cost())},
          {"p99", call ? optional_to_json(call->p99) : Json(nullptr)},
          {"sequential", optional_to_json(c.cost())}};
}

Json candidate_to_json(const RankedSubject& c) {
  return {{"subject", c.subject().name},
          {"nanoseconds", nanoseconds_to_json(c)},
          {"error", c.measured->shift ? optional_to_json(c.measured->shift->max) : Json(nullptr)},
          {"beyond", rate_to_json(c.measured->beyond)},
          {"requirements", requirements_to_json(c.requirements)},
          {"evidence", c.evidence ? evidence_to_json(*c.evidence) : Json(nullptr)}};
}

Json remedy_to_json(const TriedRemedy& r) {
  return {{"name", r.name},
          {"words", r.words},
          {"unit", r.unit},
          {"subject", r.subject == nullptr ? Json(nullptr) : Json(r.subject->name)},
          {"sequential", optional_to_json(r.cost)},
          {"meets_all", r.meets_all},
          {"requirements", requirements_to_json(r.requirements)},
          {"evidence", r.subject == nullptr ? Json(nullptr) : evidence_to_json(r.evidence)}};
}

Json name_or_null(const RankedSubject* c) { return c == nullptr ? Json(nullptr) : Json(c->subject().name); }

Json advised_to_json(const AdvisedQuery& a) {
  Json candidates = Json::array(), remedies = Json::array();
  for (const RankedSubject& c : a.candidates) candidates.push_back(candidate_to_json(c));
  for (const TriedRemedy& r : a.remedies) remedies.push_back(remedy_to_json(r));
  return {{"query", a.query->name},         {"share", a.share},           {"chosen", name_or_null(a.choice())},
          {"down", name_or_null(a.down())}, {"up", name_or_null(a.up())}, {"candidates", std::move(candidates)},
          {"remedies", std::move(remedies)}};
}

}  // namespace

nlohmann::ordered_json evidence_to_json(const SceneEvidence& e) {
  return {{"seed", e.seed},
          {"cases", e.cases},
          {"answered", e.answered},
          {"unanswered", e.unanswered},
          {"not_finite", e.not_finite},
          {"beyond", rate_to_json(rate_of(e.beyond, e.answered + e.unanswered))},
          {"by_intervals", e.by_intervals},
          {"distance", largest_to_json(e.distance)},
          {"time", largest_to_json(e.time)},
          {"missed_depth", e.missed_depth},
          {"missed_deeper", rate_to_json(e.missed_deeper)},
          {"phantom_gap", e.phantom_gap},
          {"phantom_wider", rate_to_json(e.phantom_wider)},
          {"worst_use", optional_to_json(e.worst_use)},
          {"worst", e.worst ? case_to_json(*e.worst) : Json(nullptr)}};
}

nlohmann::ordered_json Advice::to_json() const {
  Json queries = Json::array();
  for (const AdvisedQuery& a : advised_) queries.push_back(advised_to_json(a));
  return {{"schema", 1},
          {"state", interrupted() ? "interrupted" : "finished"},
          {"coverage", "sampled"},
          {"command", settings_.command},
          {"environment", environment_to_json()},
          {"machine", machine_to_json()},
          {"scene", settings_.source.scene},
          {"title", settings_.source.title},
          {"scalar", name_of(settings_.source.scalar)},
          {"seed", settings_.seed},
          {"cases", settings_.cases},
          {"tolerance", tolerance_to_json(settings_.source.tolerance)},
          {"seconds_per_step", optional_to_json(seconds_per_step())},
          {"queries", std::move(queries)},
          {"internal_errors", internal_errors_.to_json()}};
}

}  // namespace nearmiss
