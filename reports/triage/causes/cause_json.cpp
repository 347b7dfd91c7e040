#include "reports/triage/causes/cause_json.hpp"

#include <nlohmann/json.hpp>

namespace nearmiss {

namespace {

CauseKind cause_kind_in(const FileValue& word) {
  for (int k = 0; k <= int(CauseKind::unexplained); ++k) {
    if (word.text() == name_of(CauseKind(k))) return CauseKind(k);
  }
  word.fail("the kind of a cause");
}

nlohmann::ordered_json name_to_json(const CauseName& c) {
  return {{"kind", name_of(c.kind)}, {"key", c.key}, {"text", c.text}};
}

CauseName name_in(const FileValue& j) { return {cause_kind_in(j.at("kind")), j.at("key").text(), j.at("text").text()}; }

}  // namespace

nlohmann::ordered_json cause_to_json(const Cause& cause) {
  nlohmann::ordered_json evidence = nlohmann::ordered_json::array();
  for (const Evidence& e : cause.evidence) evidence.push_back({{"test", e.test}, {"result", e.result}});
  nlohmann::ordered_json j = name_to_json(cause);
  for (const CauseName& other : cause.either) j["either"].push_back(name_to_json(other));
  j["evidence"] = evidence, j["questions"] = cause.questions;
  return j;
}

Cause cause_from_json(const FileValue& j) {
  Cause cause;
  static_cast<CauseName&>(cause) = name_in(j);
  if (const auto either = j.find("either")) {
    for (const FileValue& other : either->items()) cause.either.push_back(name_in(other));
  }
  for (const FileValue& e : j.at("evidence").items())
    cause.evidence.push_back({e.at("test").text(), e.at("result").text()});
  if (const auto questions = j.find("questions")) cause.questions = questions->count();
  return cause;
}

}  // namespace nearmiss
