#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "reports/engine/interrupt.hpp"
#include "reports/findings/report.hpp"
#include "reports/trade/trade.hpp"
#include "reports/trade/trade_json.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

nlohmann::ordered_json optional_to_json(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? Json(*x) : Json(nullptr);
}

nlohmann::ordered_json rate_to_json(const Rate& r) {
  return {{"count", r.count}, {"of", r.of}, {"share", r.share()}, {"low", r.low}, {"high", r.high}};
}

nlohmann::ordered_json requirement_to_json(const MetRequirement& r) {
  return {{"name", r.name},
          {"limit", r.limit},
          {"worst", optional_to_json(r.worst)},
          {"unit", r.unit},
          {"state", name_of(r.state)}};
}

nlohmann::ordered_json tolerance_to_json(const TradeTolerance& t) {
  return {{"unit", t.unit},
          {"error", t.error},
          {"missed_depth", t.missed_depth},
          {"time", optional_to_json(t.time)},
          {"missed_rate", t.missed_rate},
          {"phantom_rate", t.phantom_rate},
          {"nanoseconds", optional_to_json(t.nanoseconds)},
          {"source", t.source}};
}

namespace {

/// The ratios of a profile: powers of 2^(1/4) up to 2^10.
constexpr int taus_per_doubling = 4, doublings = 10;

Json quantiles_to_json(const std::optional<Quantiles>& q) {
  if (!q) return nullptr;
  return {{"p50", optional_to_json(q->p50)}, {"p99", optional_to_json(q->p99)}, {"max", optional_to_json(q->max)}};
}

Json times_to_json(const TradeSummary& s) {
  if (!s.nanoseconds) return nullptr;
  return {{"how", name_of(s.timed)},
          {"pinned", s.pinned},
          {"call", quantiles_to_json(s.nanoseconds)},
          {"median_of_repeats", {{"low", s.least_repeat}, {"p50", s.repeats->p50}, {"high", s.repeats->max}}},
          {"sequential", {{"low", s.least_sequential}, {"p50", s.sequential->p50}, {"high", s.sequential->max}}},
          {"calls_per_second", s.sequential->p50 > 0 ? Json(1e9 / s.sequential->p50) : Json(nullptr)}};
}

/// null for a subject without stages.
Json stages_to_json(const TradeSummary& s) {
  if (s.stages.empty()) return nullptr;
  Json stages = Json::array();
  for (const StageCost& c : s.stages) {
    stages.push_back({{"stage", name_of(c.stage)},
                      {"calls", rate_to_json(c.calls)},
                      {"call", quantiles_to_json(c.nanoseconds)},
                      {"mean", c.mean},
                      {"share_of_time", c.share_of_time}});
  }
  return stages;
}

Json tails_to_json(const TradeSummary& s) {
  Json tails = Json::array();
  for (std::size_t i = 0; i < tail_sizes.size(); ++i)
    tails.push_back({{"one_in", tail_sizes[i]}, {"above", optional_to_json(s.tails[i])}});
  return tails;
}

Json summary_to_json(const TradeSummary& s, const Query& query) {
  const Offering& offering = s.subject->offering(query.name);
  Json requirements = Json::array();
  for (const MetRequirement& r : s.requirements) requirements.push_back(requirement_to_json(r));
  return {{"subject", s.subject->name},
          {"offer", name_of(offering.offer)},
          {"how", offering.how},
          {"compared", s.compared},
          {"no_answer", s.no_answer},
          {"not_asked", s.not_asked},
          {"broke", rate_to_json(s.broke)},
          {"missed", rate_to_json(s.missed)},
          {"missed_depth", quantiles_to_json(s.missed_depth)},
          {"phantom", rate_to_json(s.phantom)},
          {"phantom_gap", quantiles_to_json(s.phantom_gap)},
          {"beyond", rate_to_json(s.beyond)},
          {"forward_ulps", quantiles_to_json(s.ulps)},
          {"forward_length", quantiles_to_json(s.distance)},
          {"forward_time", quantiles_to_json(s.time)},
          {"backward", quantiles_to_json(s.backward)},
          {"error", quantiles_to_json(s.shift)},
          {"error_tails", tails_to_json(s)},
          {"time", times_to_json(s)},
          {"stages", stages_to_json(s)},
          {"requirements", requirements},
          {"meets_all", s.meets_all()},
          {"on_front", s.on_front}};
}

Json query_to_json(const TradedQuery& t) {
  Json subjects = Json::array();
  for (const TradeSummary& s : t.subjects) subjects.push_back(summary_to_json(s, *t.query));
  const TradeSummary* best = cheapest(t.subjects);
  return {{"query", t.query->name},
          {"share", t.share},
          {"cases", t.cases},
          {"contacts", t.contacts},
          {"cheapest", best == nullptr ? Json(nullptr) : Json(best->subject->name)},
          {"subjects", std::move(subjects)}};
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) return line.substr(line.find(": ") + 2);
  }
  return "";
}

}  // namespace

nlohmann::ordered_json machine_to_json() {
  double load[1] = {0};
  const bool known = getloadavg(load, 1) == 1;
  return {{"processor", processor_name()},
          {"processors", std::thread::hardware_concurrency()},
          {"load", known ? Json(load[0]) : Json(nullptr)}};
}

nlohmann::ordered_json Trade::profile_to_json() const {
  Json taus = Json::array(), curves = Json::array();
  for (int i = 0; i <= taus_per_doubling * doublings; ++i) taus.push_back(std::exp2(double(i) / taus_per_doubling));
  for (std::size_t s = 0; s < settings_.subjects.size(); ++s) {
    if (profile_.solved(s) == 0) continue;
    Json shares = Json::array();
    for (const Json& tau : taus) shares.push_back(profile_.share(s, tau.get<double>()));
    curves.push_back({{"subject", settings_.subjects[s]->name}, {"share", shares}, {"solved", profile_.solved(s)}});
  }
  return {{"problems", profile_.problems()}, {"taus", taus}, {"curves", curves}};
}

nlohmann::ordered_json Trade::to_json() const {
  Json subjects = Json::array(), queries = Json::array();
  for (const Subject* s : settings_.subjects)
    subjects.push_back({{"name", s->name}, {"version", s->version}, {"scalar", name_of(s->scalar)}, {"own", s->own}});
  for (const TradedQuery& t : traded_) queries.push_back(query_to_json(t));
  return {{"schema", 1},
          {"state", interrupted() ? "interrupted" : "finished"},
          {"coverage", "sampled"},
          {"command", settings_.command},
          {"started", started_},
          {"environment", environment_to_json()},
          {"machine", machine_to_json()},
          {"scene", settings_.source.scene},
          {"title", settings_.source.title},
          {"seed", settings_.seed},
          {"cases", settings_.cases},
          {"repeats", settings_.repeats},
          {"tolerance", tolerance_to_json(settings_.source.tolerance)},
          {"subjects", std::move(subjects)},
          {"queries", std::move(queries)},
          {"profile", profile_to_json()},
          {"internal_errors", internal_errors_.to_json()}};
}

}  // namespace nearmiss
