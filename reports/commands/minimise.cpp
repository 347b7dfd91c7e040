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

class MinimiseCommand : public FindingsCommand {
 public:
  MinimiseCommand() : FindingsCommand("minimised") {}
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
    declare_work(app, "How often a subject is asked at most to simplify a case. Default: 20,000",
                 "The most time to simplify a case, and again for its ranges. Default: 60",
                 "Print a JSON array with the reports of the simplest cases");
  }

 private:
  void work_on(const Task& t, const Case& question, const Subject& subject) override {
    progress_.set_activity(fmt::format("minimising for {}", subject.name));
    const MinimiseLimits usual;
    std::optional<Minimised> m =
        minimise(question, subject, {questions_.value_or(usual.questions), time_or(usual.time)}, workers_,
                 [this](std::uint64_t asked) { progress_.show(asked, std::nullopt, std::nullopt, std::nullopt); });
    if (!m) return interrupted() ? void() : say_no_finding(t, subject);
    Report& r = m->report;
    r.question.origin = "minimise";
    r.question.moves.clear();  // they made the case of the file
    const std::filesystem::path file = file_for(r, subject);
    keep(file, minimised_to_json(*m), [&] {
      const std::string end =
          fmt::format("This is the case of {}, minimised in {} questions. The search was ended by {}.",
                      path_text(t.file), count_text(m->questions), name_of(m->end));
      return fmt::format("{}\n{}\n{}", replay_text({r.question, file.string(), r.truth, {r}, {}}), ranges_text(*m),
                         wrapped_text(end, ""));
    });
  }
};

}  // namespace

std::unique_ptr<Command> minimise_command() { return std::make_unique<MinimiseCommand>(); }

}  // namespace nearmiss
