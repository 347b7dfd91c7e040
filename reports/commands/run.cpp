#include <fmt/format.h>

#include "corpus/errors.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

/// The line that states the measure, where it applies to some subject.
std::string measure_text(const RunSettings& settings) {
  for (const Subject* s : settings.subjects) {
    for (const Query* q : settings.queries) {
      if (s->offering(q->name).answer == nullptr || s->standard_for(q->name).promised) continue;
      return fmt::format("measure {:g}: {} counted as wrong when proved to differ by more\n", measure().error,
                         measure().for_all ? "all subjects are" : "subjects that promise nothing are");
    }
  }
  return "";
}

class RunCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "run",
        "ask subjects many generated cases and judge the answers",
        {"Every chosen subject answers generated cases of every chosen query that it offers, each subject in "
         "a process of its own. The exact oracle computes the truth, and the judge states what is proved "
         "against each answer. Subjects that compute in the same scalar get the same cases, and the same seed "
         "gives the same cases on every machine. A subject with preconditions ('nearmiss list --why') gets "
         "cases that meet them.",
         "The run folder receives index.json with all counts, written from the start and also after an "
         "interrupt. It also receives findings/QUERY/SUBJECT-FAULT-ID.json for the violations: for each "
         "query, subject and fault (for a breakage, its reason) the first 8, then those that are at least "
         "twice as bad as any before. All others are only counted. An existing folder keeps its reports; its "
         "index.json then describes the newest run. Only one run at a time can use a folder. Where a file "
         "cannot be written, for example on a full disk, the run ends and its index says \"failed\".",
         "The table has one row for each query and subject, with counts of answers. AGREE: nothing is proved "
         "against them. NOT PROVED: they differ, but are not proved to differ by more than was promised. "
         "FALSE HIT, FALSE MISS, WRONG: proved to differ by more than was promised, by a wrong yes, a wrong "
         "no, or wrong numbers; an answer that does so in two ways counts in both. For a subject that "
         "promises nothing for a query the measure, which the first line states, takes the place of a "
         "promise. OUTSIDE: the promise does not cover the input, or the case does not meet the subject's "
         "preconditions and was not asked. BACKWARD: the largest proved bound on how far inputs would have to "
         "move to make an answer right, in units of the scalar's epsilon. FORWARD: the largest proved "
         "distance from an exact number, in units in the last place, where the decision is right. YES: the "
         "share of cases whose exact answer is yes. EXACT: the share that intervals could not decide. The "
         "sums over all queries stand below them. With --by-class a second table has a row for each of the "
         "generator's mutators, such as knife-edge contacts or long thin shapes; a case that several mutators "
         "made is counted in each. The last line is a summary."},
        judging_exit_status(),
        {{"nearmiss run", "10,000 cases for every query and subject."},
         {"nearmiss run --subject fcl --query moving_sphere_box --cases 100000 --seed 1",
          "One subject and one query, reproducibly."},
         {"nearmiss run --measure 1e-6 --subject bullet --subject ode", "Libraries that promise nothing, compared."},
         {"nearmiss run --seconds 60 --out night", "For a minute, into the folder night."}}};
  }

  void declare(CLI::App& app) override {
    selection_.declare_subjects(app);
    selection_.declare_queries(app);
    amount_.declare(app, "Cases for each query and subject", "The run folder");
    app.add_flag("--by-class", by_class_,
                 "Print also each subject's findings by the generator's mutators that made the cases")
        ->disable_flag_override();
  }

  int run(const CLI::App&) override {
    if (amount_.measure) set_measure({*amount_.measure, true});
    selection_.check_offered();
    const std::uint64_t seed = seed_or_random(amount_.seed);
    catch_interrupts();
    RunSettings settings{typed_command_line(),
                         amount_.folder(seed),
                         selection_.queries(),
                         selection_.subjects(),
                         seed,
                         amount_.until(),
                         by_class_};
    Run run(std::move(settings));
    fmt::print("seed {}, {}, into {}\n{}", seed,
               amount_.seconds ? fmt::format("for {} s", *amount_.seconds)
                               : count_text(*amount_.number()) + " cases for each query and subject",
               run.settings().folder.string(), measure_text(run.settings()));
    std::fflush(stdout);
    run.generate(amount_.number());
    run.finish();
    fmt::print("\n{}\n", run.counts().table());
    if (by_class_) fmt::print("{}\n", run.counts().table_by_class());
    fmt::print("{}{}{}\n", run.counts().touches_text(), run.kept().worst_text(), run.summary());
    if (const auto why = run.shortfall()) say_on_stderr(fmt::format("nearmiss: {}\n", *why));
    return run.exit_code();
  }

 private:
  Selection selection_;
  Amount amount_{10'000, {}, {}, {}, {}, {}};
  bool by_class_ = false;
};

}  // namespace

std::unique_ptr<Command> run_command() { return std::make_unique<RunCommand>(); }

}  // namespace nearmiss
