#include "reports/commands/chosen_finding.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "corpus/storage/codec.hpp"
#include "impl/host/engines.hpp"
#include "oracles/requirements.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

/// The names of libraries, and the subject that stands for each where the report is of none of its subjects.
struct Library {
  std::string_view name, subject, prefix;
};
constexpr std::array libraries = {Library{"fcl", "fcl", "fcl"}, Library{"libccd", "libccd-gjk", "libccd-"},
                                  Library{"bullet", "bullet", "bullet"}, Library{"ode", "ode", "ode"},
                                  Library{"collide", "collide-fast-", "collide-"}};

const Subject& subject_named(const std::string& name, const Case& question, const Subject* of_report) {
  for (const Library& l : libraries) {
    if (name != l.name) continue;
    if (of_report != nullptr && of_report->name.starts_with(l.prefix)) return *of_report;
    const std::string stands_for =
        std::string(l.subject) + (l.subject.ends_with('-') ? std::string(name_of(question.scalar)) : "");
    if (const Subject* s = find_subject(stands_for)) return *s;
  }
  if (const Subject* s = find_subject(name)) return *s;
  if (const std::string how = how_to_install(name); !how.empty()) throw BadInput(how);
  throw BadInput(unknown_text("library or subject", name, subject_names()));
}

/// The subject of a report; nullptr for JSON that is no report, or, unless it is `needed`, where it is not loaded.
const Subject* reported_subject(const nlohmann::json& j, const std::string& file, bool needed) {
  if (!needed) {
    const bool named = j.is_object() && j.contains("subject") && j["subject"].is_object() &&
                       j["subject"].contains("name") && j["subject"]["name"].is_string();
    return named ? find_subject(j["subject"]["name"].get<std::string>()) : nullptr;
  }
  const std::optional<const Subject*> subject = subject_of_report(j, file);
  return subject ? *subject : nullptr;
}

}  // namespace

void ChosenFinding::declare(CLI::App& app, const std::string& what) {
  app.add_option("FILE", file_, "A report or a case file")->required()->type_name("");
  declare_foreign_subjects(app);
  app.add_option("--for", for_,
                 "The library (fcl, libccd, bullet, ode, collide), the engine or the subject to ask. Default: the "
                 "report's subject")
      ->type_name("NAME");
  add_measure(app, measure_);
  add_exact(app);
  app.add_option("--out", out_, fmt::format("Write to this file. Default: print {}", what))->type_name("FILE");
}

void ChosenFinding::write(const std::string& text) const {
  if (out_.empty()) {
    say("{}", text);
    return;
  }
  write_file(out_, text);
  say("{}\n", one_line(out_));
}

ChosenFinding::Asked ChosenFinding::ask() const {
  const std::string& file = file_;
  settle_run_of(file);
  const nlohmann::json j = parse_json(read_file(file), file);
  if (read_relation_case(j, file)) throw BadInput(fmt::format("{}: it has several related cases; one is needed", file));
  const Case question = case_of(j, file);
  use_measure(measure_or(measure_, j, file));
  const Subject* of_report = reported_subject(j, file, for_.empty());
  if (for_.empty() && of_report == nullptr)
    throw BadInput(fmt::format("{}: it is no report, so --for is needed", file));
  const Subject& subject = for_.empty() ? *of_report : subject_named(for_, question, of_report);
  const std::optional<Case> same = in_scalar(question, subject.scalar);
  const Offering& offering = subject.offering(question.query->name);
  if (offering.answer == nullptr)
    throw BadInput(fmt::format("{}: {} does not offer {}", file, subject.name, question.query->name));
  if (!same || !unmet_by(*same, offering.required).empty())
    throw BadInput(fmt::format("{}: {} cannot be asked this case", file, subject.name));
  if (!out_.empty()) check_can_write(out_);
  Workers workers;
  return {examine(*same, subject, workers), &subject};
}

}  // namespace nearmiss
