#include "reports/triage/cause_json.hpp"

#include <nlohmann/json.hpp>

namespace nearmiss {

nlohmann::ordered_json cause_to_json(const Cause& cause) {
  nlohmann::ordered_json evidence = nlohmann::ordered_json::array();
  for (const Evidence& e : cause.evidence) evidence.push_back({{"test", e.test}, {"result", e.result}});
  return {{"kind", name_of(cause.kind)},
          {"key", cause.key},
          {"text", cause.text},
          {"evidence", evidence},
          {"questions", cause.questions}};
}

Cause cause_from_json(const nlohmann::json& j) {
  Cause cause;
  const std::string kind = j.at("kind");
  for (int k = 0; k <= int(CauseKind::unexplained); ++k) {
    if (kind == name_of(CauseKind(k))) cause.kind = CauseKind(k);
  }
  cause.key = j.at("key");
  cause.text = j.at("text");
  for (const nlohmann::json& e : j.at("evidence")) cause.evidence.push_back({e.at("test"), e.at("result")});
  cause.questions = j.value("questions", std::uint64_t(0));
  return cause;
}

}  // namespace nearmiss
