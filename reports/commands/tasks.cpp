#include "reports/commands/tasks.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

Task read_task(const std::string& file, const Selection& selection, std::optional<double> measure,
               const std::string& verb) {
  settle_run_of(file);
  const std::string text = read_file(file);  // once: a pipe cannot be read twice
  const nlohmann::json j = parse_json(text, file);
  if (read_relation_case(j, file))
    throw BadInput(fmt::format("{}: it has several related cases, and one can be {}", file, verb));
  const auto subject = selection.subject.empty() ? subject_of_report(j, file) : std::nullopt;
  return {file, text, case_of(j, file), measure_or(measure, j, file),
          subject ? std::vector<const Subject*>{*subject} : selection.subjects()};
}

namespace {

/// The task's case in the subject's scalar; empty where the subject cannot be asked it. Throws BadInput where that
/// subject is the only one of the task.
std::optional<Case> case_for(const Task& t, const Subject& subject) {
  const Offering& offering = subject.offering(t.question.query->name);
  std::optional<Case> same = in_scalar(t.question, subject.scalar);
  if (offering.answer != nullptr && same && unmet_by(*same, offering.required).empty()) return same;
  if (t.subjects.size() == 1) throw BadInput(fmt::format("{}: {} cannot be asked this case", t.file, subject.name));
  return std::nullopt;
}

/// Calls `work` with each task and each of its subjects, judged by the measure of the task, until an interrupt. An
/// internal error ends the work for its subject alone, and is added to `errors`.
void for_each_subject(const std::vector<Task>& tasks, InternalErrors& errors,
                      const std::function<void(const Task&, const Subject&)>& work) {
  for (const Task& t : tasks) {
    use_measure(t.measure);
    for (const Subject* s : t.subjects) {
      if (interrupted()) return;
      try {
        work(t, *s);
      } catch (const InternalError& e) {
        errors.add(*s, e);
      }
    }
  }
}

std::filesystem::path folder_or_usual(const std::string& given_folder, const char* usual_folder) {
  return given_folder.empty() ? runs_folder() / usual_folder : std::filesystem::path(given_folder);
}

}  // namespace

void FindingsCommand::declare_work(CLI::App& app, const char* questions, const char* seconds, const char* json) {
  app.add_option("FILE", files_, "A case file or a report")->required()->type_name("");
  selection_.declare_subjects(app);
  add_measure(app, measure_);
  add_exact(app);
  add_whole_number(app, "--questions", questions_, questions, 1, 1'000'000'000);
  add_positive_number(app, "--seconds", seconds_, seconds, "S", 1e6);
  add_output_folder(app, out_, fmt::format("The folder. Default: reports/runs/{} of the source tree", verb_));
  app.add_flag("--json", json_, json)->disable_flag_override();
}

int FindingsCommand::run(const CLI::App&) {
  std::vector<Task> tasks;
  for (const std::string& f : files_) tasks.push_back(read_task(f, selection_, measure_, verb_));
  catch_interrupts();
  folder_ = folder_or_usual(out_, verb_);
  check_can_write_in(folder_);
  InternalErrors errors(folder_);
  for_each_subject(tasks, errors, [this](const Task& t, const Subject& subject) {
    if (const auto question = case_for(t, subject)) work_on(t, *question, subject);
  });
  if (json_) say("{}", pretty_json(reports_));
  if (interrupted()) say_on_stderr("nearmiss: interrupted\n");
  if (errors.count() > 0) return InternalError::exit_code;
  return found_ > 0 ? 1 : interrupted() ? 2 : 0;
}

void FindingsCommand::say_no_finding(const Task& t, const Subject& subject) const {
  if (!json_) say("{}: {} has no finding against it\n", path_text(t.file), subject.name);
}

std::filesystem::path FindingsCommand::file_for(Report& r, const Subject& subject) const {
  const auto file =
      folder_ / r.question.query->name / fmt::format("{}-{}-{}.json", r.subject, fault_of(r.finding), id_of(r));
  r.replay = replay_command(subject, file.string());
  return file;
}

void FindingsCommand::keep(const std::filesystem::path& file, nlohmann::ordered_json report,
                           const std::function<std::string()>& text) {
  make_folder(file.parent_path());
  write_file(file, pretty_json(report));
  const bool first = found_++ == 0;
  if (json_) {
    reports_.push_back(std::move(report));
  } else {
    say("{}{}", first ? "" : "\n", text());
  }
}

}  // namespace nearmiss
