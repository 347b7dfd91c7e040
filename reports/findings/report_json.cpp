#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"
#include "reports/findings/version.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no numbers that are not finite, so these become strings.
Json number(double x) {
  if (std::isnan(x)) return "NaN";
  if (std::isinf(x)) return x > 0 ? "Infinity" : "-Infinity";
  return x;
}

/// A bound of infinity promises nothing, and becomes null.
Json promise(double x) { return std::isinf(x) ? Json(nullptr) : Json(x); }

Json enclosure(const Bounds& b) { return Json::array({number(b.low), number(b.high)}); }

/// An object of exactly x, y and z becomes [x, y, z], at every depth.
Json with_vectors(const Json& j) {
  if (!j.is_object()) return j;
  if (j.size() == 3 && j.contains("x") && j.contains("y") && j.contains("z")) {
    return Json::array({j["x"], j["y"], j["z"]});
  }
  Json out = Json::object();
  for (const auto& [key, value] : j.items()) out[key] = with_vectors(value);
  return out;
}

/// The first `count` fields nested by name, each leaf an enclosure; normals are left out where `skip_normals` is set.
Json enclosures(std::span<const Field> fields, std::size_t count, std::span<const Bounds> values, bool skip_normals) {
  Json nested = Json::object();
  for (std::size_t i = 0; i < std::min(count, fields.size()); ++i) {
    if (skip_normals && fields[i].role == Role::normal) continue;
    std::string pointer = "/" + fields[i].name;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    nested[Json::json_pointer(pointer)] = enclosure(values[i]);
  }
  return with_vectors(nested);
}

/// The numbers of an alternative as decimals, nested by name.
Json decimals(const Query& query, const Alternative& a) {
  Json nested = Json::object();
  for (std::size_t i = 0; i < std::min(a.count, query.outputs.size()); ++i) {
    if (a.many_normals && query.outputs[i].role == Role::normal) continue;
    std::string pointer = "/" + query.outputs[i].name;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    nested[Json::json_pointer(pointer)] = a.decimals[i];
  }
  return with_vectors(nested);
}

void leave_out_signs_of_rounding(Json& decimals) {
  if (decimals.is_structured()) {
    for (Json& d : decimals) leave_out_signs_of_rounding(d);
    return;
  }
  constexpr std::string_view sign = "≈";
  if (std::string text = decimals.get<std::string>(); text.starts_with(sign)) decimals = text.substr(sign.size());
}

Json normal_cone(const Alternative& a) {
  Json facing = Json::array();
  for (const Alternative::Face& f : a.facing) {
    facing.push_back({{"direction", {enclosure(f.direction[0]), enclosure(f.direction[1]), enclosure(f.direction[2])}},
                      {"product_within", enclosure(f.range)}});
  }
  return facing;
}

Json alternative(const Query& query, const Alternative& a) {
  Json j{{"yes", a.yes}, {"values", enclosures(query.outputs, a.count, a.values, a.many_normals)}};
  if (Json shown = decimals(query, a); !shown.empty()) j["decimals"] = std::move(shown);
  if (a.many_normals) j["normal_cone"] = normal_cone(a);
  return j;
}

Json epsilons(const char* name, double k, Scalar scalar) {
  return {{name, k}, {"relative", k * unit_roundoff(scalar)}, {"epsilon", unit_roundoff(scalar)}};
}

/// The backward bound in absolute terms: how far the numbers of each group may move.
Json moved(const Case& question, double k) {
  const std::vector<double> by = widening(*question.query, question.values, question.scalar, k);
  Json groups = Json::object();
  for (std::size_t i = 0; i < by.size(); ++i) {
    if (by[i] > 0) groups[std::string(name_of(question.role(i)))] = number(by[i]);
  }
  return groups;
}

Json backward(const Case& question, const std::optional<Backward>& b) {
  if (!b) return nullptr;
  Json j = epsilons("above_epsilon", b->above, question.scalar);
  j["moved"] = moved(question, b->above);
  return j;
}

Json forward(const Query& query, int worst, double ulps, double absolute) {
  if (worst < 0 || std::size_t(worst) >= query.outputs.size()) return nullptr;
  return {{"ulps", number(ulps)}, {"absolute", number(absolute)}, {"field", query.outputs[std::size_t(worst)].name}};
}

Json member_finding(const Case& question, const MemberFinding& m) {
  const Query& query = *question.query;
  const bool is_decision = m.member == MemberFinding::decision;
  Json j{{"member", is_decision ? "decision" : query.layout.parts[std::size_t(m.member)].name},
         {"disagreement", name_of(m.disagreement)},
         {"breaks", m.breaks() ? Json(m.clause) : Json(nullptr)}};
  j["backward"] = backward(question, m.backward);
  // With a wrong decision there is no exact number to compare with.
  j["forward"] = m.forward_ulps > 0 ? forward(query, m.worst, m.forward_ulps, m.forward_absolute) : Json(nullptr);
  return j;
}

Json opinion(const Query& query, const Opinion& o) {
  const bool answered = o.answer.status == Answer::Status::answered;
  Json j{{"name", o.referee}, {"version", o.version}, {"answer", answer_to_json(query, o.answer)}};
  j["agrees_on_decision"] = answered ? Json(o.answer.yes == o.finding.truth_yes) : Json(nullptr);
  j["agrees"] = answered ? Json(o.finding.verdict == Verdict::agrees) : Json(nullptr);
  j["disagreement"] = name_of(o.finding.disagreement);
  return j;
}

Json static_check(const StaticCheck& c) {
  Json j{{"name", c.referee}, {"version", c.version}, {"query", c.query}, {"of", c.of}};
  constexpr std::array<const char*, 3> moments{"before", "at", "after"};
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const bool answered = c.said[i].status == Answer::Status::answered;
    j[moments[i]] = {{"time", c.times[i]}, {"touching", answered ? Json(c.said[i].yes) : Json(nullptr)}};
  }
  return j;
}

Json contract_to_json(const collide::Contract& c) {
  return {{"backward_epsilon", promise(c.backward)},
          {"forward_ulps", promise(c.forward)},
          {"exact_decisions", c.exact_decisions},
          {"unit_epsilon", promise(c.unit)},
          {"lowest_exponent", c.lowest},
          {"highest_exponent", c.highest}};
}

Json requires_to_json(Preconditions required) {
  Json names = Json::array();
  for (const Precondition p : all_preconditions) {
    if (required.has(p)) names.push_back(name_of(p));
  }
  return names;
}

}  // namespace

Json answer_to_json(const Query& query, const Answer& answer) {
  Json j;
  switch (answer.status) {
    case Answer::Status::cannot_answer: return {{"status", "cannot answer"}, {"reason", answer.reason()}};
    case Answer::Status::broke: {
      Json broke{{"status", "broke"}, {"reason", answer.reason()}};
      if (answer.late()) broke["late"] = true;
      return broke;
    }
    case Answer::Status::answered: j = {{"status", "answered"}, {"yes", answer.yes}};
  }
  std::vector<Field> fields;
  std::vector<double> values;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (!is_part(query, answer, i)) continue;
    fields.push_back(query.outputs[i]);
    values.push_back(answer.values[i]);
  }
  j["values"] = fields.empty() ? Json::object() : fields_to_json(fields, values);
  return j;
}

Json truth_to_json(const Query& query, Scalar scalar, const Truth& truth) {
  Json alternatives = Json::array();
  for (const Alternative& a : truth.alternatives) alternatives.push_back(alternative(query, a));
  Json j{{"yes", truth.yes},
         {"text", truth_text(query, truth)},
         {"decided_by", truth.decided_by == Stage::interval ? "interval" : "exact"},
         {"alternatives", alternatives}};
  j["margin"] = truth.margin_at_least < 0 ? Json(nullptr) : epsilons("at_least_epsilon", truth.margin_at_least, scalar);
  return j;
}

Json truth_line_to_json(const Case& question, const Truth& truth, bool with_decimals) {
  Json j{{"query", question.query->name}, {"scalar", name_of(question.scalar)}};
  j.update(truth_to_json(*question.query, question.scalar, truth));
  for (Json& a : j["alternatives"]) {
    if (!with_decimals) {
      a.erase("decimals");
    } else if (a.contains("decimals")) {
      leave_out_signs_of_rounding(a["decimals"]);
    }
  }
  return j;
}

Json finding_to_json(const Case& question, const Finding& f) {
  Json j{{"verdict", name_of(f.verdict)}, {"disagreement", name_of(f.disagreement)}, {"clause", f.clause}};
  j["backward"] = backward(question, f.backward);
  j["forward"] = forward(*question.query, f.worst, f.forward_ulps, f.forward_absolute);
  j["unit_error_epsilon"] = number(f.unit_error);
  j["headline"] = f.headline < 0 ? Json(nullptr) : Json(f.headline);
  j["members"] = Json::array();
  for (const MemberFinding& m : f.members) j["members"].push_back(member_finding(question, m));
  return j;
}

Json limits_to_json(const SceneLimits& limits) {
  return {{"name", limits.scene},
          {"unit", limits.unit},
          {"position_error", limits.error},
          {"missed_depth", limits.missed_depth},
          {"time_error", limits.time ? Json(*limits.time) : Json(nullptr)}};
}

Json environment_to_json() {
  return {{"nearmiss", version()}, {"compiler", compiler()}, {"build", build_type()}, {"platform", platform()}};
}

/// The output of a program, line by line.
Json lines_to_json(std::string_view text) {
  Json lines = Json::array();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(one_line(text.substr(0, end), 500));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

Json declarations_to_json(const std::vector<Declaration>& declared) {
  Json list = Json::array();
  for (const Declaration& d : declared) {
    list.push_back({{"convention", name_of(d.convention)}});
    if (!d.sentence.empty()) list.back()["sentence"] = d.sentence;
  }
  return list;
}

Json report_to_json(const Report& r) {
  const Query& query = *r.question.query;
  Json j{{"schema", report_schema_version},
         {"id", id_of(r)},
         {"headline", headline(r)},
         {"explanation", explanation(r)},
         {"kind", name_of(query.kind)}};
  j.update(case_to_json(r.question));
  j["subject"] = {{"name", r.subject}, {"version", r.version}, {"scalar", name_of(r.question.scalar)}};
  j["answer"] = answer_to_json(query, r.answer);
  if (!r.output.empty()) j["output"] = lines_to_json(r.output);
  j["truth"] = truth_to_json(query, r.question.scalar, r.truth);
  j["finding"] = finding_to_json(r.question, r.finding);
  j["contract"] = contract_to_json(r.standard.contract);
  j["measure"] = nullptr;
  if (!r.standard.promised) j["measure"] = {{"error", measure().error}, {"for_all", measure().for_all}};
  if (r.scene) j["measure"]["scene"] = limits_to_json(*r.scene);
  if (!r.standard.required.empty()) j["requires"] = requires_to_json(r.standard.required);
  if (!r.declared.empty()) j["declared"] = declarations_to_json(r.declared);
  j["referees"] = Json::array();
  for (const Opinion& o : r.referees) j["referees"].push_back(opinion(query, o));
  j["static_checks"] = Json::array();
  for (const StaticCheck& c : r.static_checks) j["static_checks"].push_back(static_check(c));
  j["replay"] = r.replay;
  j["cpp"] = case_to_cpp(r.question);
  j["environment"] = environment_to_json();
  return j;
}

}  // namespace nearmiss
