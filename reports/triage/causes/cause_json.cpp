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

}  // namespace

nlohmann::ordered_json cause_to_json(const Cause& cause) {
  nlohmann::ordered_json evidence = nlohmann::ordered_json::array();
  for (const Evidence& e : cause.evidence) evidence.push_back({{"test", e.test}, {"result", e.result}});
  return {{"kind", name_of(cause.kind)},
          {"key", cause.key},
          {"text", cause.text},
          {"evidence", evidence},
          {"questions", cause.questions}};
}

Cause cause_from_json(const FileValue& j) {
  Cause cause;
  cause.kind = cause_kind_in(j.at("kind"));
  cause.key = j.at("key").text();
  cause.text = j.at("text").text();
  for (const FileValue& e : j.at("evidence").items())
    cause.evidence.push_back({e.at("test").text(), e.at("result").text()});
  if (const auto questions = j.find("questions")) cause.questions = questions->count();
  return cause;
}

}  // namespace nearmiss
