#include "reports/engine/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <variant>

#include "corpus/storage/codec.hpp"
#include "impl/host/engines.hpp"
#include "oracles/confirmed.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

class ReplayCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "replay",
        "ask subjects one case again, and show the exact answer",
        {"FILE is a case, a stored case or a report, as JSON (docs/bring-your-own.md has the form). A decimal in a "
         "case "
         "means the nearest number of its scalar; a note says how many were rounded. Every subject that offers its "
         "query is asked again; "
         "answers in the file are ignored. The page shows the inputs, the exact answer, and for each subject "
         "its answer, the verdict and how far the inputs would have to move to make the answer right. Subjects are "
         "judged as in the report: by their contracts or its measure, and by the conventions that it states.",
         "A report of 'nearmiss relations' has several cases: all of them are asked again and compared.",
         "All files are read before the first subject is asked: a malformed one is an error, and nothing is printed."},
        judging_exit_status(),
        {{"nearmiss replay reports/runs/*/findings/moving_sphere_box/fcl-false-miss-*.json", "Findings again."},
         {"nearmiss replay --subject fcl corpus/seeds/moving_sphere_box/hit-corner.json",
          "One subject, a stored case."},
         {"nearmiss replay --json case.json", "As a JSON array of reports."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", files_, "A case file or a report")->required()->type_name("");
    selection_.declare_subjects(app);
    add_measure(app, measure_);
    add_exact(app);
    app.add_flag("--json", json_, "Print a JSON array with a report for each file and subject")
        ->disable_flag_override();
  }
  int run(const CLI::App&) override {
    std::vector<std::variant<Case, RelationCase>> cases;
    std::vector<SceneMeasure> measures;
    for (const std::string& f : files_) {
      settle_run_of(f);
      const nlohmann::json j = parse_json(read_file(f), f);  // once: a pipe cannot be read twice
      take_subject_of_report(j, f);
      measures.push_back(measure_or(measure_, j, f));
      if (auto related = read_relation_case(j, f)) {
        cases.emplace_back(std::move(*related));
      } else {
        cases.emplace_back(case_of(j, f));
      }
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (!json_ && i > 0) say("\n");
      use_measure(measures[i]);
      std::visit([&](const auto& c) { again(c, files_[i]); }, cases[i]);
    }
    if (json_) say("{}", pretty_json(reports_));
    return contradicted_ ? InternalError::exit_code : bad_ ? 1 : 0;
  }

 private:
  /// The subject of a report is asked, also an engine. Warns where it is not loaded: the replay then lacks the reported
  /// answer.
  void take_subject_of_report(const nlohmann::json& report, const std::string& file) {
    if (!report.is_object() || !report.contains("finding") || !report.contains("subject")) return;
    const nlohmann::json& subject = report["subject"];
    if (!subject.is_object() || !subject.contains("name") || !subject["name"].is_string()) return;
    const std::string name = subject["name"];
    if (is_subject(name)) return reported_.push_back(name);
    const std::string missing = how_to_install(name);
    say_on_stderr(fmt::format("nearmiss: {}: it is about '{}', which is no subject here{}\n", one_line(file, 300),
                              one_line(name, 60), missing.empty() ? how_to_ask_again(report, file) : ": " + missing));
  }
  static std::string how_to_ask_again(const nlohmann::json& report, const std::string& file) {
    if (!report.contains("replay")) return "";
    const std::optional<AddedByReport> added = added_by(report);
    if (!added) return "; its command is not one that asks a subject again";
    if (added->options.empty()) return "";
    return fmt::format("; this asks it again, and starts {}: nearmiss replay {} {}", one_line(added->started, 300),
                       one_line(added->options, 600), one_line(shell_quoted(file), 300));
  }
  std::vector<const Subject*> subjects() const {
    if (!selection_.subject.empty()) return selection_.subjects();
    std::vector<std::string> names = subject_names();
    names.insert(names.end(), reported_.begin(), reported_.end());
    return subjects_named(names);
  }
  void again(const Case& question, const std::string& file) {
    const Replay r = replay(question, file, subjects(), workers_);
    for (const Report& report : r.reports) {
      bad_ = bad_ || is_bad(report.finding);
      if (json_) reports_.push_back(report_to_json(report));
    }
    if (!json_) say("{}", replay_text(r));
  }
  void again(const RelationCase& related, const std::string& file) {
    const RelationReplay r = replay(related, file, subjects(), workers_);
    for (const RelationReport& report : r.reports) {
      bad_ = bad_ || is_bad(report.breach);
      contradicted_ = contradicted_ || !report.oracle.empty();
      if (json_) reports_.push_back(report_to_json(report));
    }
    if (!json_) say("{}", replay_text(related, r));
  }

  std::vector<std::string> files_;
  std::vector<std::string> reported_;  ///< the subjects of the files that are reports
  Selection selection_;
  std::optional<double> measure_;
  bool json_ = false, bad_ = false, contradicted_ = false;
  nlohmann::ordered_json reports_ = nlohmann::ordered_json::array();
  Workers workers_;
};

}  // namespace

std::unique_ptr<Command> replay_command() { return std::make_unique<ReplayCommand>(); }

}  // namespace nearmiss
