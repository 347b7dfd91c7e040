#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "corpus/storage/fuzz_target.hpp"
#include "corpus/storage/store.hpp"
#include "impl/host/engines.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/properties.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view not_built = "not built yet";

std::string_view offer_of(const Subject& s, const Query& query) {
  return s.started ? name_of(s.offering(query.name).offer) : not_built;
}

/// What of the list is shown.
struct Listed {
  std::vector<const Query*> queries;
  std::vector<const Subject*> subjects, engines;

  /// All subjects, then the engines.
  std::vector<const Subject*> all() const {
    std::vector<const Subject*> both = subjects;
    both.insert(both.end(), engines.begin(), engines.end());
    return both;
  }
};

/// Those that are named; all where none is.
std::vector<const Subject*> named_among(const std::vector<Subject>& some, const std::vector<std::string>& names) {
  std::vector<const Subject*> found;
  for (const Subject& s : some) {
    if (names.empty() || std::ranges::find(names, s.name) != names.end()) found.push_back(&s);
  }
  return found;
}

/// The offer of each of these subjects, or of each referee among them, for the query.
Json offers(const Query& query, const std::vector<const Subject*>& all, bool referees_only = false) {
  Json j = Json::object();
  for (const Subject* s : all) {
    if (!referees_only || s->referee) j[s->name] = offer_of(*s, query);
  }
  return j;
}

std::vector<std::string_view> names_of(Preconditions required) {
  std::vector<std::string_view> names;
  for (const Precondition p : all_preconditions) {
    if (required.has(p)) names.push_back(name_of(p));
  }
  return names;
}

/// The preconditions of each subject that has some: {NAME: [PRECONDITION]}.
Json requirements(const Query& query, const Listed& listed) {
  Json j = Json::object();
  for (const Subject* s : listed.all()) {
    if (const Preconditions r = s->offering(query.name).required; !r.empty()) j[s->name] = names_of(r);
  }
  return j;
}

/// What each subject declares: {NAME: [{"convention", "sentence"}]}.
Json declarations(const Query& query, const Listed& listed) {
  Json j = Json::object();
  for (const Subject* s : listed.all()) {
    if (const auto declared = s->declared_for(query.name); !declared.empty())
      j[s->name] = declarations_to_json(declared);
  }
  return j;
}

Json bound_json(double bound) { return std::isfinite(bound) ? Json(bound) : Json(nullptr); }

/// The contract of each subject that promises something: {NAME: {"backward", "forward", "unit", "exact_decisions"}}, in
/// the units of collide/contract.hpp; null: no bound.
Json contracts(const Query& query, const Listed& listed) {
  Json j = Json::object();
  for (const Subject* s : listed.all()) {
    const collide::Contract& c = s->offering(query.name).contract;
    if (s->offering(query.name).offer == Offer::not_offered || promises_nothing(c)) continue;
    j[s->name] = {{"backward", bound_json(c.backward)},
                  {"forward", bound_json(c.forward)},
                  {"unit", bound_json(c.unit)},
                  {"exact_decisions", c.exact_decisions}};
  }
  return j;
}

Json list_json(const Listed& listed) {
  Json queries = Json::array();
  for (const Query* each : listed.queries) {
    const Query& q = *each;
    queries.push_back({{"query", q.name},
                       {"kind", name_of(q.kind)},
                       {"subjects", offers(q, listed.subjects)},
                       {"referees", offers(q, listed.subjects, true)},
                       {"engines", offers(q, listed.engines)},
                       {"requires", requirements(q, listed)},
                       {"declared", declarations(q, listed)},
                       {"contracts", contracts(q, listed)},
                       {"fuzz_target", fmt::format("fuzz_{}", fuzz_target_of(q).name)},
                       {"seeds", count_seeds(q)},
                       {"properties", properties_of(q)}});
  }
  return {{"queries", queries}};
}

char mark_of(const Subject& s, const Query& query) {
  const Offer o = s.offering(query.name).offer;
  return !s.started ? '?' : o == Offer::answers ? '+' : o == Offer::by_equivalence ? '~' : '.';
}

std::string letter(std::size_t i) {
  return i < 26 ? std::string(1, char('A' + i)) : std::string(1, char('A' + i / 26 - 1)) + char('A' + i % 26);
}

std::string subjects_table(const Listed& listed) {
  std::vector<std::vector<std::string>> rows{{"", "SUBJECT", "VERSION", "SCALAR", ""}};
  const std::vector<const Subject*> all = listed.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Subject& s = *all[i];
    const char* note = i >= listed.subjects.size() ? "an engine" : s.referee ? "also a referee" : "";
    if (s.started) {
      rows.push_back({letter(i), s.name, s.version, std::string(name_of(s.scalar)), note});
    } else {
      rows.push_back({letter(i), s.name, std::string(not_built), "", ""});
    }
  }
  return table_text(rows);
}

/// A line about the engines that are not installed; empty where all are.
std::string missing_engines_line() {
  std::vector<std::string> missing;
  for (const Engine& e : engines()) {
    if (!e.is_installed && e.setting.empty()) missing.push_back(e.name);
  }
  return missing.empty() ? "" : fmt::format("'./nearmiss engines NAME' installs {}\n", fmt::join(missing, ", "));
}

std::string queries_table(const Listed& listed) {
  std::vector<std::vector<std::string>> rows{{"QUERY", "KIND"}};
  const std::vector<const Subject*> all = listed.all();
  for (std::size_t i = 0; i < all.size(); ++i) rows[0].push_back(letter(i));
  rows[0].insert(rows[0].end(), {"SEEDS", "PROPERTIES"});
  for (const Query* each : listed.queries) {
    const Query& q = *each;
    std::vector<std::string> row{std::string(q.name), std::string(name_of(q.kind))};
    for (const Subject* s : all) row.emplace_back(1, mark_of(*s, q));
    row.push_back(std::to_string(count_seeds(q)));
    row.push_back(std::to_string(properties_of(q).size()));
    rows.push_back(row);
  }
  return table_text(rows);
}

/// What is asked about two shapes. A query with another number of operands, or about their parts, is none of these.
enum class PairOperation { overlap, signed_distance, penetration, contact, path };
constexpr std::pair<PairOperation, std::string_view> pair_operations[] = {
    {PairOperation::overlap, "whether two shapes overlap"},
    {PairOperation::signed_distance, "how far two shapes are apart, or how deep they overlap"},
    {PairOperation::penetration, "how deep two shapes overlap"},
    {PairOperation::contact, "when the first shape, moving, meets the second"},
    {PairOperation::path, "whether the first shape, moving, meets the second"}};

std::optional<PairOperation> pair_operation_of(const Query& q) {
  if (q.operands.size() != 2) return std::nullopt;
  const bool moves = !q.operands.velocities.empty();
  if (q.kind == Kind::impact && moves) return PairOperation::contact;
  if (q.kind == Kind::depth) return PairOperation::penetration;
  if (q.kind == Kind::points && q.layout.at(Role::distance) != nullptr) return PairOperation::signed_distance;
  if (q.kind != Kind::decision || !q.traits.touching_is_yes || q.traits.projects) return std::nullopt;
  return moves ? PairOperation::path : PairOperation::overlap;
}

/// The letters of the subjects that answer one of the queries, neighbours as a range: "A-H K".
std::string letters_of(const std::vector<const Query*>& queries, const Listed& listed) {
  std::vector<bool> answers;
  for (const Subject* s : listed.subjects) {
    answers.push_back(std::any_of(queries.begin(), queries.end(), [&](const Query* q) {
      return s->started && s->offering(q->name).offer != Offer::not_offered;
    }));
  }
  std::string text;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i]) continue;
    std::size_t last = i;
    while (last + 1 < answers.size() && answers[last + 1]) ++last;
    text += (text.empty() ? "" : " ") + letter(i);
    if (last > i) text += (last > i + 1 ? "-" : " ") + letter(last);
    i = last;
  }
  return text;
}

/// For each operation a table of the pairs of shapes: a row for the first, a column for the second.
std::string pairs_tables(const Listed& listed) {
  std::string text;
  for (const auto& [operation, words] : pair_operations) {
    std::map<std::pair<Shape, Shape>, std::vector<const Query*>> cells;
    std::set<Shape> first, second;
    for (const Query* each : listed.queries) {
      const Query& q = *each;
      if (pair_operation_of(q) != operation) continue;
      cells[{q.operands[0].shape, q.operands[1].shape}].push_back(&q);
      first.insert(q.operands[0].shape), second.insert(q.operands[1].shape);
    }
    if (cells.empty()) continue;
    std::vector<std::vector<std::string>> rows{{""}};
    for (const Shape column : second) rows[0].emplace_back(traits_of(column).words);
    for (const Shape row : first) {
      rows.push_back({std::string(traits_of(row).words)});
      for (const Shape column : second) {
        const auto cell = cells.find({row, column});
        rows.back().push_back(cell == cells.end() ? "" : letters_of(cell->second, listed));
      }
    }
    text += fmt::format("{}{}:\n{}", text.empty() ? "" : "\n", words, table_text(rows));
  }
  return text;
}

std::string declared_cell(const Subject& s, const Query& query) {
  const std::vector<Declaration> declared = s.declared_for(query.name);
  return declared.empty() ? "-" : declarations_text(declared);
}

/// One line for each pair of query and subject, with the reason or the equivalence.
std::string reasons_table(const Listed& listed) {
  std::vector<std::vector<std::string>> rows{{"QUERY", "SUBJECT", "OFFER", "REQUIRES", "DECLARES", "HOW OR WHY NOT"}};
  for (const Query* each : listed.queries) {
    const Query& q = *each;
    for (const Subject* s : listed.all()) {
      const Offering& o = s->offering(q.name);
      rows.push_back({std::string(q.name), s->name, std::string(offer_of(*s, q)),
                      o.required.empty() ? "-" : fmt::format("{}", fmt::join(names_of(o.required), ", ")),
                      declared_cell(*s, q), o.how});
    }
  }
  return table_text(rows);
}

std::string members_table(const Query& query) {
  std::vector<std::vector<std::string>> rows{{"", "MEMBER", "ROLE"}};
  const auto add = [&](const char* side, std::span<const Field> fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      rows.push_back({fmt::format("{}[{}]", side, i), fields[i].name, std::string(name_of(fields[i].role))});
    }
  };
  add("inputs", query.inputs);
  add("values", query.outputs);
  std::string text = table_text(rows);
  for (std::size_t k = 0; k < query.lists.size(); ++k) {
    const CountedInput& list = query.lists[k];
    text += fmt::format("{} has {} to {} entries; with more than {}, the numbers behind it move up.\n", list.name,
                        list.least, list.most, list.least);
  }
  return text;
}

class ListCommand : public Command {
 public:
  Manual manual() const override {
    return {"list",
            "show the queries and the offers of each subject",
            {"For every query: its kind of answer, whether each subject answers it (+), answers it by an "
             "equivalent operation (~), does not offer it (.) or is not built yet (?: './nearmiss build NAME' builds "
             "it, and so "
             "does a command that asks it), the number of stored cases in its seed corpus, and the number of "
             "properties that are tested. Subjects that are marked as referees also give second "
             "opinions in reports. An engine is asked only where --subject names it (docs/engines.md).",
             "--pairs shows the queries about two shapes as tables of shapes, with the subjects that answer each.",
             "--why shows for each query and subject the equivalent operation, or why the query is not offered, "
             "the preconditions of the subject, and the conventions that it declares: it is not asked cases that do "
             "not meet "
             "the former, and judged by the latter. --json prints "
             "one object for programs: {\"queries\": [{\"query\", \"kind\", \"subjects\": {NAME: \"answers\" | \"by "
             "equivalence\" | \"not offered\" | \"not built yet\"}, \"referees\": {the same}, \"engines\": {the same}, "
             "\"requires\": {NAME: "
             "[PRECONDITION]}, \"declared\": {NAME: [{\"convention\", \"sentence\"}]}, "
             "\"fuzz_target\", \"seeds\", \"properties\"}]}."},
            {{"0", "Done."}, {"2", "The corpus cannot be read, or the arguments are wrong."}},
            {{"nearmiss list", "The table."},
             {"nearmiss list --subject fcl --query sphere_box_overlap --why", "Of some subjects and queries."},
             {"nearmiss list --pairs", "Who answers what about which two shapes."},
             {"nearmiss list --why | grep fcl", "How FCL is asked, and what it cannot be asked."},
             {"nearmiss list --members moving_point_sphere", "The inputs and outputs of a plugin's function."},
             {"nearmiss list --json", "For programs."}}};
  }
  void declare(CLI::App& app) override {
    selection_.declare_subjects(app);
    selection_.declare_queries(app);
    app.add_flag("--json", json_, "Print JSON")->disable_flag_override();
    app.add_flag("--why", why_, "Print how each subject answers each query, or why it does not")
        ->excludes("--json")
        ->disable_flag_override();
    app.add_flag("--pairs", pairs_, "Print tables of the queries about two shapes")
        ->excludes("--json")
        ->excludes("--why")
        ->disable_flag_override();
    app.add_option("--names", names_, "Print only the names of all queries or of all subjects, one a line")
        ->type_name("queries|subjects")
        ->check(CLI::Validator(
            [](const std::string& t) {
              return t == "queries" || t == "subjects" ? "" : "'" + t + "' is neither queries nor subjects";
            },
            ""))
        ->excludes("--json")
        ->excludes("--why")
        ->excludes("--pairs");
    app.add_option("--members", members_, "Print the numbers of this query and of its answer, in their order")
        ->type_name("QUERY")
        ->check(known_query())
        ->excludes("--json")
        ->excludes("--why")
        ->excludes("--pairs")
        ->excludes("--names");
  }
  int run(const CLI::App&) override {
    const std::vector<std::string>& chosen = selection_.subject;
    const Listed listed{selection_.queries(), named_among(subjects_at_hand(), chosen),
                        named_among(engines_at_hand(), chosen)};
    if (json_) {
      say("{}", pretty_json(list_json(listed)));
    } else if (why_) {
      say("{}", reasons_table(listed));
    } else if (pairs_) {
      say("{}\n{}", subjects_table(listed), pairs_tables(listed));
    } else if (!members_.empty()) {
      say("{}", members_table(*find_query(members_)));
    } else if (names_ == "queries") {
      for (const Query* q : listed.queries) say("{}\n", q->name);
    } else if (names_ == "subjects") {
      for (const Subject* s : listed.subjects) say("{}\n", s->name);
    } else {
      const bool all = std::ranges::all_of(listed.subjects, &Subject::started);
      say("{}\n{}\n+ answers   ~ by equivalence   . not offered{}   (nearmiss list --why tells how and why)\n{}",
          subjects_table(listed), queries_table(listed), all ? "" : "   ? not built yet",
          chosen.empty() ? missing_engines_line() : "");
    }
    return 0;
  }

 private:
  bool json_ = false, why_ = false, pairs_ = false;
  std::string names_, members_;
  Selection selection_;
};

}  // namespace

std::unique_ptr<Command> list_command() { return std::make_unique<ListCommand>(); }

}  // namespace nearmiss
