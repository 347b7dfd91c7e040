#include "reports/engine/relation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/findings/hash.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

bool decides_wrongly(const Report& r) {
  return r.answer.status == Answer::Status::answered && r.answer.yes != r.truth.yes;
}

/// "answer 2 (hit at time 4) is a false hit".
std::vector<std::string> wrong_decisions(const RelationReport& r) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < r.answers.size(); ++i) {
    if (!decides_wrongly(r.answers[i])) continue;
    all.push_back(fmt::format("answer {} is a false {}", i + 1, r.answers[i].answer.yes ? "hit" : "miss"));
  }
  return all;
}

bool some_contract_is_broken(const RelationReport& r) {
  return std::any_of(r.answers.begin(), r.answers.end(), [](const Report& a) { return is_bad(a.finding); });
}

std::string none_of(std::size_t answers) {
  return answers == 2 ? "Neither answer" : fmt::format("None of the {} answers", answers);
}

std::string what_is_wrong(const RelationReport& r) {
  const std::vector<std::string> wrong = wrong_decisions(r);
  if (r.breach == Breach::contradiction) {
    return fmt::format("The decisions contradict each other, and {}. {} is proved to break its contract",
                       list_text(wrong), none_of(r.answers.size()));
  }
  if (r.breach == Breach::none) return "Nothing is proved against these answers";
  const std::string contract =
      some_contract_is_broken(r)
          ? ""
          : fmt::format(". {} is proved to break its contract for that case alone", none_of(r.answers.size()));
  return fmt::format("Broken is: {}{}{}", r.broken, wrong.empty() ? "" : fmt::format("; {}", list_text(wrong)),
                     contract);
}

Json follow_up_to_json(const Report& r) {
  const Json whole = report_to_json(r);
  Json j;
  for (const char* key : {"query", "scalar", "inputs", "answer", "truth", "finding", "contract", "referees", "cpp"}) {
    j[key] = whole[key];
  }
  return j;
}

}  // namespace

RelationReport report_of(const RelationChoice& choice, const RelationFinding& found, const Subject& subject,
                         Workers& workers) {
  RelationReport r{choice, found.agreement, found.breach, found.broken, found.oracle, {}, {}};
  for (std::size_t i = 0; i < found.cases.size(); ++i) {
    r.answers.push_back(examine(found.cases[i], subject, found.answers[i], workers));
  }
  return r;
}

std::optional<RelationReport> examine_relation(const RelationChoice& choice, const Case& question,
                                               const Subject& subject, Workers& workers) {
  const auto found = examine(
      *choice.relation, question, choice.seed, subject, [&](const Case& c) { return workers.ask(subject, c); },
      choice.bit_for_bit);
  if (!found) return std::nullopt;
  return report_of(choice, *found, subject, workers);
}

bool is_bad(Breach b) { return b == Breach::bits || b == Breach::contract || b == Breach::broke; }

std::string_view breach_of(const RelationReport& r) { return r.oracle.empty() ? name_of(r.breach) : "oracle"; }

std::string id_of(const RelationReport& r) {
  Fnv1a fnv;
  fnv.add(r.answers.front().subject);
  fnv.add(r.choice.relation->name);
  fnv.add(breach_of(r));
  for (const Report& a : r.answers) fnv.add(a.question);
  return fnv.id();
}

std::string headline(const RelationReport& r) {
  const Report& first = r.answers.front();
  std::string line = fmt::format("{} breaks the relation {} in {}: ", first.subject, r.choice.relation->name,
                                 first.question.query->name);
  if (!r.oracle.empty()) {
    return fmt::format("Nearmiss contradicts itself by the relation {} in {}: {}", r.choice.relation->name,
                       first.question.query->name, r.oracle);
  }
  switch (r.breach) {
    case Breach::none:
      return fmt::format("{} does not break the relation {} in {}", first.subject, r.choice.relation->name,
                         first.question.query->name);
    case Breach::contradiction: return line + list_text(wrong_decisions(r)) + ", not proved to break its contract";
    case Breach::bits: return line + "its answers differ in some bits";
    case Breach::contract:
    case Breach::broke: return line + r.broken;
  }
  return line;
}

std::string explanation(const RelationReport& r) {
  std::string text = fmt::format("Relation {}: {}.", r.choice.relation->name, r.choice.relation->what);
  for (std::size_t i = 0; i < r.answers.size(); ++i) {
    const Report& a = r.answers[i];
    text += fmt::format(" Case {} ({}): {} answers {}; exactly, {}.", i + 1, a.question.query->name, a.subject,
                        answer_text(*a.question.query, a.answer, a.question.scalar),
                        truth_text(*a.question.query, a.truth));
  }
  text += fmt::format(" {}.", what_is_wrong(r));
  if (!r.oracle.empty()) text += fmt::format(" This is a mistake of Nearmiss itself: {}.", r.oracle);
  return text;
}

Json report_to_json(const RelationReport& r) {
  Json j = report_to_json(r.answers.front());
  j["id"] = id_of(r);
  j["headline"] = headline(r);
  j["explanation"] = explanation(r);
  j["replay"] = r.replay;
  Json follow_ups = Json::array();
  for (std::size_t i = 1; i < r.answers.size(); ++i) follow_ups.push_back(follow_up_to_json(r.answers[i]));
  j["relation"] = {{"name", r.choice.relation->name},
                   {"what", r.choice.relation->what},
                   {"seed", r.choice.seed},
                   {"bit_for_bit", r.choice.bit_for_bit},
                   {"agreement", name_of(r.agreement)},
                   {"breach", breach_of(r)},
                   {"breaks_contract", some_contract_is_broken(r)},
                   {"says", what_is_wrong(r)},
                   {"partners", follow_ups}};
  return j;
}

namespace {

/// Whether these are the follow-ups of the file, without their answers.
bool are_partners(const FileValue& relation, const std::vector<Case>& follow_ups) {
  const std::optional<FileValue> partners = relation.find("partners");
  const std::vector<FileValue> stored = partners ? partners->items() : std::vector<FileValue>();
  if (stored.size() != follow_ups.size()) return false;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    nlohmann::json question;
    for (const char* key : {"query", "scalar", "inputs"}) {
      if (const auto part = stored[i].find(key)) question[key] = part->json();
    }
    const Case follow_up = case_from_json(question, relation.file());
    if (follow_up.query != follow_ups[i].query || follow_up.values != follow_ups[i].values) return false;
  }
  return true;
}

}  // namespace

std::optional<RelationCase> read_relation_case(const std::filesystem::path& file) {
  return read_relation_case(parse_json(read_file(file), file.string()), file.string());
}

std::optional<RelationCase> read_relation_case(const nlohmann::json& j, const std::string& file) {
  if (!j.is_object() || !j.contains("finding") || !j.contains("relation")) return std::nullopt;
  const FileValue whole(j, file);
  const FileValue relation = whole.at("relation");
  const std::string name = relation.at("name").text();
  RelationCase related{case_of(j, file), {}, {}};
  related.choice.relation = find_relation(name);
  if (related.choice.relation == nullptr) relation.at("name").fail("the name of a relation");
  related.choice.seed = relation.at("seed").whole();
  if (const auto bits = relation.find("bit_for_bit")) related.choice.bit_for_bit = bits->flag();
  if (const auto subject = whole.find("subject")) related.subject = subject->at("name").text();
  const auto follow_ups = related.choice.relation->of(related.question, related.choice.seed);
  if (!follow_ups || !are_partners(relation, follow_ups->cases))
    throw BadInput(
        fmt::format("{}: relation: '{}' does not lead from this case to the follow-ups of the file", file, name));
  return related;
}

RelationReplay replay(const RelationCase& related, const std::string& file, std::span<const Subject* const> subjects,
                      Workers& workers) {
  RelationReplay r{file, {}, {}};
  for (const Subject* s : subjects) {
    RelationChoice choice = related.choice;
    choice.bit_for_bit = claims_same_bits(*s) || (choice.bit_for_bit && s->name == related.subject);
    if (s->scalar != related.question.scalar) {
      // Follow-ups depend on the scalar: in another scalar they would be other cases.
      r.unasked.push_back({s->name, fmt::format("the cases are related in {}", name_of(related.question.scalar))});
    } else if (auto report = examine_relation(choice, related.question, *s, workers)) {
      report->replay = replay_command(*s, file);
      r.reports.push_back(std::move(*report));
    } else {
      const bool offered = !(s->offering(related.question.query->name).answer == nullptr);
      r.unasked.push_back(
          {s->name, offered ? "a follow-up is not offered, or a case is outside of what it requires" : "not offered"});
    }
  }
  return r;
}

std::string replay_text(const RelationCase& related, const RelationReplay& r) {
  std::string text = fmt::format("{}\nRelation {}: {}\n", path_text(r.file), related.choice.relation->name,
                                 related.choice.relation->what);
  std::vector<Case> cases{related.question};
  const auto follow_ups = related.choice.relation->of(related.question, related.choice.seed);
  cases.insert(cases.end(), follow_ups->cases.begin(), follow_ups->cases.end());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    text += fmt::format("\nCase {}: {}", i + 1, case_page(cases[i], truth_of(cases[i])));
  }
  std::vector<std::vector<std::string>> rows{{"SUBJECT"}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    rows.front().insert(rows.front().end(), {fmt::format("ANSWER {}", i + 1), fmt::format("VERDICT {}", i + 1)});
  }
  rows.front().push_back("BREACH");
  for (const RelationReport& report : r.reports) {
    rows.push_back({report.answers.front().subject});
    for (const Report& a : report.answers) {
      rows.back().push_back(answer_text(*a.question.query, a.answer, a.question.scalar));
      rows.back().emplace_back(name_of(a.finding.verdict));
    }
    rows.back().emplace_back(breach_of(report));
  }
  for (const Replay::Unasked& u : r.unasked) rows.push_back({u.subject, "not asked: " + u.why});
  text += fmt::format("\n{}", table_text(rows));
  for (const RelationReport& report : r.reports) {
    if (report.breach != Breach::none || !report.oracle.empty())
      text += fmt::format("\n{}", wrapped_text(explanation(report), ""));
  }
  return text;
}

}  // namespace nearmiss
