#include "reports/engine/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "corpus/storage/codec.hpp"
#include "impl/host/engines.hpp"
#include "impl/subject/printable.hpp"
#include "oracles/requirements.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

/// Rows of a name and its numbers, one row for each vector: "box.center" 0 1 2.
std::vector<std::vector<std::string>> rows_of(std::span<const Field> fields,
                                              const std::function<std::string(std::size_t)>& number) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string& name = fields[i].name;
    const std::size_t dot = name.find_last_of('.');
    const bool component = dot != std::string::npos && dot + 2 == name.size();
    const std::string owner = component ? name.substr(0, dot) : name;
    if (rows.empty() || rows.back()[0] != owner || !component) rows.push_back({owner});
    rows.back().push_back(number(i));
  }
  return rows;
}

std::string inputs_text(const Case& c) {
  return table_text(rows_of(c.fields(), [&](std::size_t i) { return number_text(c.values[i], c.scalar); }), "  ");
}

std::string alternative_text(const Query& query, const Alternative& a) {
  std::vector<Field> fields;
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < std::min(a.count, query.outputs.size()); ++i) {
    if (a.many_normals && query.outputs[i].role == Role::normal) continue;
    fields.push_back(query.outputs[i]);
    at.push_back(i);
  }
  std::string text = table_text(rows_of(fields, [&](std::size_t i) { return a.decimals[at[i]]; }), "  ");
  if (!a.many_normals) return text;
  if (a.facing.empty()) return text + "  normal  any unit vector\n";
  text += "  normal  any unit vector n with\n";
  for (const Alternative::Face& f : a.facing) {
    text += fmt::format("    ({}) · n from {} to {}\n", fmt::join(f.decimals, ", "), number_text(f.range.low),
                        number_text(f.range.high));
  }
  return text;
}

/// How far an answer is from a right one: the sum of the differences of the numbers that both have. Infinite for
/// another decision, and where a difference is not a number.
double distance(const Query& query, const Answer& answer, const Alternative& right) {
  constexpr double far = std::numeric_limits<double>::infinity();
  if (answer.status != Answer::Status::answered || answer.yes != right.yes) return far;
  double sum = 0;
  for (std::size_t i = 0; i < std::min(right.count, query.outputs.size()); ++i) {
    const bool any = right.many_normals && query.outputs[i].role == Role::normal;
    if (any || !is_part(query, answer, i)) continue;
    const double x = answer.values[i];
    const double apart = std::max({right.values[i].low - x, x - right.values[i].high, 0.0});
    if (std::isnan(apart)) return far;
    sum += apart;
  }
  return sum;
}

/// The right answers for a page: where there are many, the nearest ones to the wrong answers.
std::vector<const Alternative*> shown_alternatives(const Query& query, const Truth& truth,
                                                   std::span<const Report> reports) {
  constexpr std::size_t most = 3;
  std::vector<std::pair<double, const Alternative*>> all;
  for (const Alternative& right : truth.alternatives) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Report& r : reports) {
      if (r.finding.verdict != Verdict::agrees) nearest = std::min(nearest, distance(query, r.answer, right));
    }
    all.emplace_back(nearest, &right);
  }
  if (all.size() > most + 1) {  // one more takes no more space than to say so
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    all.resize(most);
  }
  std::vector<const Alternative*> shown;
  for (const auto& [unused, right] : all) shown.push_back(right);
  return shown;
}

std::string margin_text(const Case& question, const Truth& truth) {
  if (!(truth.margin_at_least > 0)) {
    return "  The decision is on a knife's edge: no distance to its flip can be shown.\n";
  }
  return wrapped_text(
      fmt::format("The decision stays the same after moving {}.", moves_text(question, truth.margin_at_least)), "  ");
}

std::string truth_page(const Case& question, const Truth& truth, std::span<const Report> reports) {
  const Query& query = *question.query;
  std::string text = fmt::format("Truth: {}  (decided by {})\n", truth_text(query, truth),
                                 truth.decided_by == Stage::interval ? "intervals" : "exact arithmetic");
  const std::vector<const Alternative*> shown = shown_alternatives(query, truth, reports);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (i > 0) text += "  or\n";
    text += alternative_text(query, *shown[i]);
  }
  if (const std::size_t more = truth.alternatives.size() - shown.size(); more > 0) {
    text += reports.empty() ? fmt::format("  or one of {} more right answers\n", more)
                            : fmt::format(
                                  "  or one of {} more right answers; these are nearest to the wrong ones above, and "
                                  "--json lists all\n",
                                  more);
  }
  return text + margin_text(question, truth);
}

std::string backward_cell(const Report& r) {
  if (!r.finding.backward) return "-";
  return fmt::format("> {} epsilon", epsilons_text(r.finding.backward->above));
}

std::string findings_table(const Replay& replayed) {
  const Query& query = *replayed.question.query;
  std::vector<std::vector<std::string>> rows{{"SUBJECT", "ANSWER", "VERDICT", "DIFFERENCE", "BACKWARD ERROR"}};
  for (const Report& r : replayed.reports) {
    rows.push_back({r.subject, answer_text(query, r.answer, r.question.scalar), std::string(name_of(r.finding.verdict)),
                    r.finding.disagreement == Disagreement::none ? "-" : std::string(name_of(r.finding.disagreement)),
                    backward_cell(r)});
  }
  for (const Replay::Unasked& u : replayed.unasked) rows.push_back({u.subject, "not asked: " + u.why});
  return table_text(rows);
}

std::string origin_text(const Case& c) {
  std::string text = one_line(c.origin, 200);
  if (c.origin.starts_with("generator") || c.origin.starts_with("scene "))
    text += fmt::format(", seed {}, index {}", c.seed, c.index);
  if (!c.moves.empty()) text += fmt::format(", moves: {}", fmt::join(c.moves, ", "));
  return text;
}

std::string inputs_page(const Case& question) {
  const Query& query = *question.query;
  std::string text = fmt::format("{} ({}), numbers exactly {}", query.name, nearmiss::name_of(query.kind),
                                 nearmiss::name_of(question.scalar));
  if (const std::string origin = origin_text(question); !origin.empty()) text += fmt::format("; from {}", origin);
  return text + fmt::format("\n\nInputs\n{}", inputs_text(question));
}

/// Throws BadInput for a file of Nearmiss that holds no case, and for a report of another version.
void check_kind(const nlohmann::json& j, const std::string& where) {
  if (!j.is_object()) return;
  for (const auto& [member, what] : {std::pair("tallies", "the index of a run"), std::pair("maps", "a map of extremes"),
                                     std::pair("done", "the state of a sweep")}) {
    if (j.contains("schema") && j.contains(member)) {
      throw BadInput(fmt::format("{}: it is {}; what can be replayed is a case or a report", where, what));
    }
  }
  const auto is_readable = [](const nlohmann::json& version) {  // all versions write the case in the same form
    return version.is_number_integer() && version >= 1 && version <= report_schema_version;
  };
  if (j.contains("finding") && (!j.contains("schema") || !is_readable(j["schema"]))) {
    throw BadInput(fmt::format("{}: schema {}; this build reads reports of schema 1 to {}", where,
                               j.contains("schema") ? "is " + one_line(j["schema"].dump(), 60) : "is missing",
                               report_schema_version));
  }
}

}  // namespace

Case read_case_or_report(const std::filesystem::path& file) {
  return case_of(parse_json(read_file(file), file.string()), file.string());
}

Case case_of(const nlohmann::json& j, const std::string& file) {
  check_kind(j, file);
  if (!j.is_object() || !j.contains("finding")) return case_from_json(j, file, decimals_of_users());
  nlohmann::json question;
  for (const char* key : {"query", "scalar", "inputs", "origin"}) {
    if (j.contains(key)) question[key] = j[key];
  }
  return case_from_json(question, file);
}

namespace {

/// The requirements of the scene that a report was judged by.
std::shared_ptr<const SceneLimits> limits_from(const nlohmann::json& j, const std::string& file) {
  SceneLimits limits;
  const auto fail = [&] {
    throw BadInput(
        fmt::format("{}: measure.scene is {}; it must have a name, a unit, and not negative position_error, "
                    "missed_depth and time_error (or null)",
                    file, one_line(j.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace), 60)));
  };
  const auto text = [&](const char* name, std::string& into) {
    if (!j.is_object() || !j.contains(name) || !j[name].is_string()) fail();
    into = j[name].get<std::string>();
    if (into.empty() || printable(into) != into) fail();
  };
  const auto number = [&](const char* name) {
    if (!j.contains(name) || !j[name].is_number() || !(j[name].get<double>() >= 0)) fail();
    return j[name].get<double>();
  };
  text("name", limits.scene), text("unit", limits.unit);
  limits.error = number("position_error"), limits.missed_depth = number("missed_depth");
  if (!j.contains("time_error") || !j["time_error"].is_null()) limits.time = number("time_error");
  return std::make_shared<const SceneLimits>(std::move(limits));
}

}  // namespace

namespace {

/// The conventions with which a report was judged; empty for what is no report.
std::optional<ReportedConventions> conventions_of(const nlohmann::json& j, const std::string& file) {
  const bool names_both = j.is_object() && j.contains("finding") && j.contains("query") && j["query"].is_string() &&
                          j.contains("subject") && j["subject"].is_object() && j["subject"].contains("name") &&
                          j["subject"]["name"].is_string();
  if (!names_both) return std::nullopt;
  ReportedConventions reported{j["subject"]["name"], j["query"], {}};
  if (!j.contains("declared")) return reported;
  const auto text = [](const nlohmann::json& d, const char* name) {
    return d.is_object() && d.contains(name) && d[name].is_string() ? std::optional(d[name].get<std::string>())
                                                                    : std::nullopt;
  };
  const nlohmann::json& declared = j["declared"];
  for (const nlohmann::json& d : declared.is_array() ? declared : nlohmann::json::array({declared})) {
    const auto name = text(d, "convention");
    const auto convention = name ? convention_named(*name) : std::nullopt;
    if (!convention) {
      throw BadInput(fmt::format("{}: declared has {}; it must be a list of objects with a convention, one of {}", file,
                                 one_line(d.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace), 60),
                                 convention_names()));
    }
    reported.declared.push_back({*convention, text(d, "sentence").value_or("")});
  }
  return reported;
}

}  // namespace

SceneMeasure measure_or(std::optional<double> given, const nlohmann::json& j, const std::string& file) {
  return given ? SceneMeasure{{*given, true}, nullptr, conventions_of(j, file)} : measure_of(j, file);
}

SceneMeasure measure_of(const nlohmann::json& j, const std::string& file) {
  std::optional<ReportedConventions> declared = conventions_of(j, file);
  const bool has_measure = j.is_object() && j.contains("finding") && j.contains("measure") && !j["measure"].is_null();
  SceneMeasure m = has_measure ? measure_in(j["measure"], file) : SceneMeasure{};
  m.declared = std::move(declared);
  return m;
}

SceneMeasure measure_in(const nlohmann::json& m, const std::string& file) {
  const bool whole = m.is_object() && m.contains("error") && m["error"].is_number() && m["error"] > 0 &&
                     m.contains("for_all") && m["for_all"].is_boolean();
  if (!whole)
    throw BadInput(
        fmt::format("{}: measure is {}; it must have an error above 0 and for_all", file, one_line(m.dump(), 60)));
  return {{m["error"], m["for_all"]}, m.contains("scene") ? limits_from(m["scene"], file) : nullptr};
}

nlohmann::ordered_json measure_to_json(const SceneMeasure& m) {
  nlohmann::ordered_json j{{"error", m.measure.error}, {"for_all", m.measure.for_all}};
  if (m.scene != nullptr) j["scene"] = limits_to_json(*m.scene);
  return j;
}

std::optional<AddedByReport> added_by(const nlohmann::json& report) {
  if (!report.contains("replay") || !report["replay"].is_string()) return std::nullopt;
  const auto words = words_of_shell(report["replay"].get<std::string>());
  if (!words || words->size() < 3 || (*words)[0] != "nearmiss" || (*words)[1] != "replay") return std::nullopt;
  AddedByReport added;
  for (std::size_t i = 2; i + 1 < words->size(); i += 2) {
    const auto &option = (*words)[i], &value = (*words)[i + 1];
    if ((option != "--plugin" && option != "--command") || i + 2 >= words->size()) return std::nullopt;
    added.options += fmt::format("{}{} {}", added.options.empty() ? "" : " ", option, shell_quoted(value));
    added.started += (added.started.empty() ? "" : " and ") + shell_quoted(value);
  }
  return added;
}

namespace {

/// How to add the subject of a report that is not loaded.
std::string how_to_add(const nlohmann::json& report) {
  const std::optional<AddedByReport> added = added_by(report);
  if (!added || added->options.empty()) return "--plugin and --command add subjects";
  return fmt::format("this adds it, and starts {}: {}", one_line(added->started, 300), one_line(added->options, 600));
}

}  // namespace

std::optional<const Subject*> subject_of_report(const nlohmann::json& j, const std::string& file) {
  if (!j.is_object() || !j.contains("finding") || !j.contains("subject")) return {};
  if (!j["subject"].is_object()) {
    throw BadInput(
        fmt::format("{}: subject is {}; it must be an object with a name", file, one_line(j["subject"].dump(), 60)));
  }
  const nlohmann::json name = j["subject"].value("name", nlohmann::json());
  const Subject* subject = name.is_string() ? find_subject(name.get<std::string>()) : nullptr;
  if (subject != nullptr) return subject;
  const std::string missing = name.is_string() ? how_to_install(name.get<std::string>()) : "";
  throw BadInput(fmt::format("{}: it is about {}, which is no subject here; {}", file, one_line(name.dump(), 60),
                             missing.empty() ? how_to_add(j) : missing));
}

std::string replay_command(const Subject& subject, const std::string& file) {
  const std::string plugin = subject.plugin.empty() ? "" : "--plugin " + shell_quoted(subject.plugin) + " ";
  const std::string command = subject.command.empty() ? "" : "--command " + shell_quoted(subject.command) + " ";
  return "nearmiss replay " + plugin + command +
         shell_quoted(std::filesystem::absolute(file).lexically_normal().string());
}

Replay replay(const Case& question, const std::string& file, std::span<const Subject* const> subjects,
              Workers& workers) {
  Replay r{question, file, {}, {}, {}};
  for (const Subject* s : subjects) {
    const Offering& offering = s->offering(question.query->name);
    const std::optional<Case> same = in_scalar(question, s->scalar);
    if (offering.answer == nullptr) {
      r.unasked.push_back({s->name, "not offered"});
    } else if (!same) {
      r.unasked.push_back({s->name, fmt::format("a number of the case is not exactly a {}", name_of(s->scalar))});
    } else if (const Preconditions unmet = unmet_by(*same, offering.required); !unmet.empty()) {
      r.unasked.push_back({s->name, requires_text(unmet)});
    } else {
      r.reports.push_back(examine(*same, *s, workers));
      r.reports.back().replay = replay_command(*s, file);
    }
  }
  const bool declare_the_same = std::all_of(r.reports.begin(), r.reports.end(), [&](const Report& report) {
    return report.standard.declared == r.reports.front().standard.declared;
  });
  r.truth = truth_of(question, r.reports.empty() || !declare_the_same ? Conventions{} : r.reports[0].standard.declared);
  return r;
}

std::string case_page(const Case& question, const Truth& truth) {
  return inputs_page(question) + "\n" + truth_page(question, truth, {});
}

std::string replay_text(const Replay& r) {
  std::string text = fmt::format("{}\n{}\n{}", path_text(r.file), inputs_page(r.question), findings_table(r));
  for (const Report& report : r.reports) {
    if (report.finding.verdict == Verdict::agrees) continue;
    text += fmt::format("\n{}", wrapped_text(explanation(report), ""));
  }
  return text + "\n" + truth_page(r.question, r.truth, r.reports);
}

}  // namespace nearmiss
