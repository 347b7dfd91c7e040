#include <fmt/format.h>

#include <nlohmann/json.hpp>

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
#include "reports/triage/minimisation/minimise.hpp"

namespace nearmiss {

namespace {

class MinimiseCommand : public Command {
 public:
  Manual manual() const override {
    std::vector<Manual::Line> status = judging_exit_status();
    return {
        "minimise",
        "simplify the case of a finding, and show which of its numbers matter",
        {"FILE is a case, a stored case or a report, as JSON. The subject of the report is asked simpler and simpler "
         "cases. A simpler case is kept where the subject's answer has the same finding: the same member of the answer "
         "is wrong in the same way, proved for the simpler case by itself, or the subject breaks for the same reason. "
         "Simpler numbers are zeros, small integers, numbers of few digits, and numbers that the case has already. "
         "Without a report and without --subject, every subject that offers the query is examined, and those with a "
         "finding get a simpler case.",
         "Then each number of the simplest case is moved alone, up and down, as long as the finding stays the same. "
         "The page shows these ranges under \"What matters\", and names the numbers that play no part.",
         "The report of the simplest case is written to FOLDER/QUERY/SUBJECT-FAULT-ID.json. It says under "
         "\"minimised\" how the search ended. The result is the same each time, unless --seconds ended the search; "
         "minimise the written report to go on."},
        std::move(status),
        {{"nearmiss minimise reports/runs/*/findings/moving_sphere_box/fcl-false-miss-*.json", "Findings of a run."},
         {"nearmiss minimise --subject fcl --out small case.json", "The finding of one subject on a case."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", files_, "A case file or a report")->required()->type_name("");
    selection_.declare_subjects(app);
    add_measure(app, measure_);
    add_exact(app);
    add_whole_number(app, "--questions", questions_,
                     "How often a subject is asked at most to simplify a case. Default: 20,000", 1, 1'000'000'000);
    add_positive_number(app, "--seconds", seconds_,
                        "The most time to simplify a case, and again for its ranges. Default: 60", "S", 1e6);
    add_output_folder(app, out_, "The folder. Default: reports/runs/minimised of the source tree");
    app.add_flag("--json", json_, "Print a JSON array with the reports of the simplest cases")->disable_flag_override();
  }
  int run(const CLI::App&) override {
    std::vector<Task> tasks;
    for (const std::string& f : files_) tasks.push_back(read_task(f, selection_, measure_, "minimised"));
    catch_interrupts();
    folder_ = folder_or_usual(out_, "minimised");
    check_can_write_in(folder_);
    InternalErrors errors(folder_);
    for_each_subject(tasks, errors, [this](const Task& t, const Subject& s) { minimise_for(t, s); });
    if (json_) say("{}", pretty_json(reports_));
    if (interrupted()) say_on_stderr("nearmiss: interrupted\n");
    if (errors.count() > 0) return InternalError::exit_code;
    return found_ > 0 ? 1 : interrupted() ? 2 : 0;
  }

 private:
  void minimise_for(const Task& t, const Subject& subject) {
    const std::optional<Case> question = case_for(t, subject);
    if (!question) return;
    progress_.set_activity(fmt::format("minimising for {}", subject.name));
    const MinimiseLimits limits{questions_.value_or(MinimiseLimits().questions),
                                seconds_ ? std::chrono::duration<double>(*seconds_) : MinimiseLimits().time};
    std::optional<Minimised> m = minimise(*question, subject, limits, workers_, [this](std::uint64_t questions) {
      progress_.show(questions, std::nullopt, std::nullopt, std::nullopt);
    });
    if (interrupted() && !m) return;
    if (!m) {
      if (!json_) say("{}: {} has no finding against it\n", path_text(t.file), subject.name);
      return;
    }
    ++found_;
    keep(t, subject, *m);
  }
  void keep(const Task& t, const Subject& subject, Minimised& m) {
    Report& r = m.report;
    r.question.origin = "minimise";
    r.question.moves.clear();  // they made the case of the file
    const std::filesystem::path file = file_for(r, folder_);
    r.replay = replay_command(subject, file.string());
    make_folder(file.parent_path());
    write_file(file, pretty_json(minimised_to_json(m)));
    if (json_) {
      reports_.push_back(minimised_to_json(m));
      return;
    }
    const Replay page{r.question, file.string(), r.truth, {r}, {}};
    const std::string end =
        fmt::format("This is the case of {}, minimised in {} questions. The search was ended by {}.", path_text(t.file),
                    count_text(m.questions), name_of(m.end));
    say("{}{}\n{}\n{}", separator(), replay_text(page), ranges_text(m), wrapped_text(end, ""));
  }
  /// An empty line between pages.
  std::string separator() { return std::exchange(first_, false) ? "" : "\n"; }

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

std::unique_ptr<Command> minimise_command() { return std::make_unique<MinimiseCommand>(); }

}  // namespace nearmiss
