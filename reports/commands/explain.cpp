#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/commands/tasks.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/hypotheses/cause_of.hpp"

namespace nearmiss {

namespace {

class ExplainCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "explain",
        "find the cause of a finding, and show the evidence",
        {"FILE is a case, a stored case or a report, as JSON. The subject of the report is asked the case again, in "
         "the "
         "four rounding modes, multiplied by powers of two, with neighbouring numbers, and generated cases of the same "
         "query. Each answer is judged. Without a report and without --subject, every subject that offers the query is "
         "examined.",
         "A cause is named only where its test passed: rounding, absolute tolerance, relative tolerance, "
         "iteration limit, unsupported, overflow, underflow, convention, logic. Otherwise the finding is unexplained. "
         "docs/explanation/causes.md has the tests.",
         "The report is written to FOLDER/QUERY/SUBJECT-FAULT-ID.json, with the cause and the evidence under "
         "\"cause\". The result is the same each time, unless --seconds ended the search."},
        judging_exit_status(),
        {{"nearmiss explain reports/runs/*/findings/moving_sphere_box/fcl-false-miss-*.json", "Findings of a run."},
         {"nearmiss explain --subject fcl case.json", "The finding of one subject on a case."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", files_, "A case file or a report")->required()->type_name("");
    selection_.declare_subjects(app);
    add_measure(app, measure_);
    add_exact(app);
    add_whole_number(app, "--questions", questions_,
                     "How often a subject is asked at most for a finding. Default: 24,000", 1, 1'000'000'000);
    add_positive_number(app, "--seconds", seconds_, "The most time for a finding. Default: 20", "S", 1e6);
    add_output_folder(app, out_, "The folder. Default: reports/runs/explained of the source tree");
    app.add_flag("--json", json_, "Print a JSON array with the reports")->disable_flag_override();
  }
  int run(const CLI::App&) override {
    std::vector<Task> tasks;
    for (const std::string& f : files_) tasks.push_back(read_task(f, selection_, measure_, "explained"));
    catch_interrupts();
    folder_ = folder_or_usual(out_, "explained");
    check_can_write_in(folder_);
    InternalErrors errors(folder_);
    for_each_subject(tasks, errors, [this](const Task& t, const Subject& s) { explain_for(t, s); });
    if (json_) say("{}", pretty_json(reports_));
    if (interrupted()) say_on_stderr("nearmiss: interrupted\n");
    if (errors.count() > 0) return InternalError::exit_code;
    return found_ > 0 ? 1 : interrupted() ? 2 : 0;
  }

 private:
  void explain_for(const Task& t, const Subject& subject) {
    const std::optional<Case> question = case_for(t, subject);
    if (!question) return;
    progress_.set_activity(fmt::format("explaining {}", subject.name));
    progress_.show(0, std::nullopt, std::nullopt, std::nullopt);
    Report r = examine(*question, subject, workers_);
    if (interrupted()) return;
    if (!is_bad(r.finding)) {
      if (!json_) say("{}: {} has no finding against it\n", path_text(t.file), subject.name);
      return;
    }
    const CauseLimits usual;
    const Cause cause = cause_of(
        r, subject,
        {questions_.value_or(usual.questions), seconds_ ? std::chrono::duration<double>(*seconds_) : usual.time},
        workers_);
    if (interrupted()) return;
    ++found_;
    keep(t, subject, r, cause);
  }
  void keep(const Task& t, const Subject& subject, Report& r, const Cause& cause) {
    const std::filesystem::path file = file_for(r, folder_);
    r.replay = replay_command(subject, file.string());
    nlohmann::ordered_json j = report_to_json(r);
    keep_ranges(t, r, j);
    j["cause"] = cause_to_json(cause);
    make_folder(file.parent_path());
    write_file(file, pretty_json(j));
    if (json_) {
      reports_.push_back(std::move(j));
      return;
    }
    const Replay page{r.question, t.file, r.truth, {r}, {}};
    say("{}{}\n{}", std::exchange(first_, false) ? "" : "\n", replay_text(page), cause_text(cause));
  }

  /// A minimised report of the same subject stays one.
  static void keep_ranges(const Task& t, const Report& r, nlohmann::ordered_json& j) {
    const nlohmann::json given = parse_json(t.text, t.file);
    if (!given.is_object() || !given.contains("subject") || !given.contains("minimised")) return;
    const FileValue report(given, t.file);
    if (report.at("subject").at("name").text() == r.subject) j["minimised"] = given["minimised"];
  }

  std::vector<std::string> files_;
  Selection selection_;
  std::optional<double> measure_, seconds_;
  std::optional<std::uint64_t> questions_;
  std::string out_;
  std::filesystem::path folder_;
  bool json_ = false, first_ = true;
  nlohmann::ordered_json reports_ = nlohmann::ordered_json::array();
  Workers workers_{[] { return !interrupted(); }};
  Progress progress_;
  std::uint64_t found_ = 0;
};

}  // namespace

std::unique_ptr<Command> explain_command() { return std::make_unique<ExplainCommand>(); }

}  // namespace nearmiss
