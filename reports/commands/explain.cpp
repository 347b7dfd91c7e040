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

class ExplainCommand : public FindingsCommand {
 public:
  ExplainCommand() : FindingsCommand("explained") {}
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
         "docs/triage.md says what each cause means.",
         "The report is written to FOLDER/QUERY/SUBJECT-FAULT-ID.json, with the cause and the evidence under "
         "\"cause\". The result is the same each time, unless --seconds ended the search."},
        judging_exit_status(),
        {{"nearmiss explain reports/runs/*/findings/moving_sphere_box/fcl-false-miss-*.json", "Findings of a run."},
         {"nearmiss explain --subject fcl case.json", "The finding of one subject on a case."}}};
  }
  void declare(CLI::App& app) override {
    declare_work(app, "How often a subject is asked at most for a finding. Default: 24,000",
                 "The most time for a finding. Default: 20", "Print a JSON array with the reports");
  }

 private:
  void work_on(const Task& t, const Case& question, const Subject& subject) override {
    progress_.set_activity(fmt::format("explaining {}", subject.name));
    progress_.show(0, std::nullopt, std::nullopt, std::nullopt);
    Report r = examine(question, subject, workers_);
    if (interrupted()) return;
    if (!is_bad(r.finding)) return say_no_finding(t, subject);
    const CauseLimits usual;
    const Cause cause = cause_of(r, subject, {questions_.value_or(usual.questions), time_or(usual.time)}, workers_);
    if (interrupted()) return;
    const std::filesystem::path file = file_for(r, subject);
    nlohmann::ordered_json j = report_to_json(r);
    keep_ranges(t, r, j);
    j["cause"] = cause_to_json(cause);
    keep(file, std::move(j), [&] {
      return replay_text({r.question, t.file, r.truth, {r}, {}}) + "\n" + cause_text(cause);
    });
  }

  /// A minimised report of the same subject stays one.
  static void keep_ranges(const Task& t, const Report& r, nlohmann::ordered_json& j) {
    const nlohmann::json given = parse_json(t.text, t.file);
    if (!given.is_object() || !given.contains("subject") || !given.contains("minimised")) return;
    const FileValue report(given, t.file);
    if (report.at("subject").at("name").text() == r.subject) j["minimised"] = given["minimised"];
  }
};

}  // namespace

std::unique_ptr<Command> explain_command() { return std::make_unique<ExplainCommand>(); }

}  // namespace nearmiss
