#include <fmt/format.h>

#include "corpus/bad_input.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/interrupt.hpp"
#include "reports/run.hpp"
#include "reports/text.hpp"

namespace nearmiss {

namespace {

constexpr std::uint64_t default_cases = 10'000, most_cases = 1'000'000'000'000;
constexpr double most_seconds = 1e8;

class RunCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "run",
        "ask subjects many generated cases and judge the answers",
        {"Every chosen subject answers generated cases of every chosen query that it offers, each in a process of "
         "its own. The exact oracle knows the truth, and the judge tells what is proved against each answer. "
         "Subjects that compute in the same scalar get the same cases, and the same seed gives the same cases on "
         "every machine.",
         "The run folder receives index.json with all counts (written from the start, and also when the run is "
         "interrupted) and findings/QUERY/SUBJECT-FAULT-ID.json for the violations: of each query, subject and "
         "fault the first 8, then those that are at least twice as bad as any before. All others are counted. "
         "A folder that exists is added to; its index.json then describes the newest run. One run at a time can have "
         "it. Where a file cannot be written, say because the disk is full, the run ends and its index says \"failed\".",
         "The table has one row for each query and subject, with counts of answers. AGREE: nothing is proved "
         "against them. WITHIN: they differ, by no more than was promised. FALSE HIT, FALSE MISS, WRONG: violations, "
         "by a wrong yes, a wrong no, or wrong numbers. OUTSIDE: the promise does not cover the input. BACKWARD: the "
         "largest proved bound on how far inputs would have to move to make an answer right, in units of the "
         "scalar's epsilon. FORWARD: the largest proved distance from an exact number, in units in the last place, "
         "where the decision is right. YES: the share of cases whose exact answer is yes. EXACT: the share that "
         "intervals could not decide. Below the queries are the sums over all of them. With --by-class a second table "
         "has a row for each of the generator's moves, such as knife-edge contacts or long thin shapes; a case that "
         "several moves made is counted in each. The last line is a summary."},
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
    add_whole_number(app, "-n,--cases", cases_,
                     fmt::format("Cases for each query and subject. Default: {}", default_cases), 1, most_cases);
    add_positive_number(app, "-t,--seconds", seconds_, "For so long, instead of a number of cases", "S", most_seconds);
    app.get_option("--seconds")->excludes("--cases");
    add_whole_number(app, "--seed", seed_, "Of the generator. Default: a random one, which is printed", 0,
                     std::numeric_limits<std::uint64_t>::max());
    add_positive_number(app, "--measure", measure_,
                        "Judge all subjects by one promise in place of their own: a backward error of at most E, "
                        "relative to the largest number of each kind, say 1e-6",
                        "E", 1);
    app.add_flag("--by-class", by_class_,
                 "Print also each subject's findings by the generator's moves that made the cases")
        ->disable_flag_override();
    add_output_folder(app, out_, "The run folder. Default: reports/runs/TIME-SEED of the source tree");
  }

  int run(const CLI::App&) override {
    if (measure_) hold_all_to(*measure_);
    selection_.check_offered();
    const std::uint64_t seed = seed_or_random(seed_);
    catch_interrupts();
    RunSettings settings{typed_command_line(),
                         out_.empty() ? new_run_folder(seed) : std::filesystem::path(out_),
                         selection_.queries(),
                         selection_.subjects(),
                         seed,
                         std::nullopt,
                         by_class_};
    if (seconds_) {
      settings.until = Run::Clock::now() +
                       std::chrono::duration_cast<Run::Clock::duration>(std::chrono::duration<double>(*seconds_));
    }
    Run run(std::move(settings));
    fmt::print("seed {}, {}, into {}\n", seed,
               seconds_ ? fmt::format("for {} s", *seconds_)
                        : count_text(cases_.value_or(default_cases)) + " cases for each query and subject",
               run.settings().folder.string());
    std::fflush(stdout);
    run.generate(seconds_ ? std::nullopt : std::optional(cases_.value_or(default_cases)));
    run.finish();
    fmt::print("\n{}\n", run.table());
    if (by_class_) fmt::print("{}\n", run.table_by_class());
    fmt::print("{}{}\n", run.worst_findings(), run.summary());
    if (const auto why = run.shortfall()) say_on_stderr(fmt::format("nearmiss: {}\n", *why));
    return run.exit_code();
  }

 private:
  Selection selection_;
  std::optional<std::uint64_t> cases_, seed_;
  std::optional<double> seconds_, measure_;
  std::string out_;
  bool by_class_ = false;
};

}  // namespace

std::unique_ptr<Command> run_command() { return std::make_unique<RunCommand>(); }

}  // namespace nearmiss
