#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/files/errors.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/commands/profile_option.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/run.hpp"
#include "reports/engine/tally.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

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
         fmt::format("The run folder receives index.json with all counts, written from the start and also after an "
                     "interrupt. It also receives findings/QUERY/SUBJECT-FAULT-ID.json for the violations: for each "
                     "query, subject and fault (for a breakage, its reason) the first {} of each variant, up to {}, "
                     "then those that are at least twice as bad as any before. All others are only counted. An "
                     "existing folder keeps its reports; its "
                     "index.json then describes the newest run. Only one run at a time can use a folder. Where a file "
                     "cannot be written, for example on a full disk, the run ends and its index says \"failed\".",
                     FindingRetention::first_few, FindingRetention::most_of_a_kind),
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
         "made is counted in each. The last line is a summary.",
         "With --climb the run searches for the worst errors in place of asking generated cases. Each query, subject "
         "and kind of error (forward, backward) has a climb of its own: from the worst cases known, and from generated "
         "ones, it moves step by step, in ulps and exponents, to the neighbouring case with the largest proved error. "
         "The climbs share the time equally; with --cases each asks so many cases. Their cases are counted and "
         "reported like all others, but not as exact touches, and a table has the worst errors. The run folder "
         "receives the worst case of each climb as worst/QUERY/SUBJECT-KIND.json. A forward error has no bound where "
         "a query is badly conditioned.",
         "With --scene the cases are taken from a scene (docs/scenes.md): a world with its sizes, distances, speeds "
         "and "
         "mix of queries. --cases is then the number of cases of the mix for each subject. No stored worst cases are "
         "asked first. Every subject but the tiers of collide is judged by what the scene requires of a place, a "
         "depth, a "
         "time "
         "and a decision, in the unit of the scene, in place of the measure; the first line states it. --profile does "
         "the same with the scene of a profile, and asks each query only of the subject "
         "that the profile has answer it.",
         "A proof takes several times as long as the look that finds an answer right. Where a fifth of a subject's "
         "first 16,384 answers to a query is proved wrong, every sixteenth further answer is judged, and a line says "
         "how many were not. --every-answer judges all.",
         "Every run first asks the stored worst cases (corpus/worst/) of the chosen queries and subjects, beyond the "
         "number of --cases. With --measure it does not."},
        judging_exit_status(),
        {{"nearmiss run", "10,000 cases for every query and subject."},
         {"nearmiss run --subject fcl --query moving_sphere_box --cases 100000 --seed 1",
          "One subject and one query, reproducibly."},
         {"nearmiss run --measure 1e-6 --subject bullet --subject ode", "Libraries that promise nothing, compared."},
         {"nearmiss run --seconds 60 --out night", "For a minute, into the folder night."},
         {"nearmiss run --climb --update-worst --seconds 600 --subject collide-fast-float",
          "Search for worse cases than the stored ones, and store them."},
         {"nearmiss run --scene game-world --cases 100000", "Cases of the world of an online game."},
         {"nearmiss run --profile profile/profile.json --cases 1e6", "What this profile offers, and nothing else."}}};
  }

  void declare(CLI::App& app) override {
    selection_.declare_subjects(app);
    selection_.declare_queries(app);
    amount_.declare(app, "Cases for each query and subject", "The run folder");
    scene_.declare(app);
    profile_.declare(app);
    app.add_flag("--by-class", by_class_,
                 "Print also each subject's findings by the generator's mutators that made the cases")
        ->disable_flag_override();
    app.add_flag("--every-answer", every_answer_,
                 "Also judge every answer of a subject that is often wrong; otherwise a sample")
        ->disable_flag_override();
    CLI::Option* climb =
        app.add_flag("--climb", climb_, "Search for the worst errors in place of asking generated cases")
            ->disable_flag_override();
    app.add_flag("--update-worst", update_worst_,
                 "With --climb: store the worst cases of the tiers of collide in corpus/worst/, where they are worse "
                 "than the stored ones")
        ->disable_flag_override()
        ->needs(climb)
        ->excludes("--measure");
    climb->excludes("--scene")->excludes("--profile");
  }

  int run(const CLI::App&) override {
    const std::optional<scenes::Scene> scene = scene_.load();
    if (scene) select_queries_of(*scene, selection_);
    std::optional<ChosenProfile> profile;
    if (profile_.is_given()) profile.emplace(profile_.file);
    const scenes::Scene* world = profile ? &profile->scene() : scene ? &*scene : nullptr;
    judge_by(amount_.measure, world);
    selection_.check_offered();
    if (update_worst_) check_own();
    const std::uint64_t seed = seed_or_random(amount_.seed);
    catch_interrupts();
    RunSettings settings{typed_command_line(),
                         amount_.folder(seed),
                         profile ? profile->queries() : selection_.queries(),
                         profile ? profile->subjects() : selection_.subjects(),
                         seed,
                         amount_.until(),
                         by_class_,
                         world,
                         every_answer_};
    Run run(std::move(settings));
    if (world != nullptr) run.note("scene", world->name);
    note_declared(run);
    if (const SceneLimits* limits = scene_limits()) run.note("required", limits_to_json(*limits));
    say("seed {}, {}, into {}\n{}", seed, amount_text(), path_text(run.settings().folder),
        measure_line(run.settings().queries, run.settings().subjects) +
            declarations_line(run.settings().queries, run.settings().subjects));
    std::fflush(stdout);
    if (world == nullptr) run.ask_worst_cases();
    const std::string climbs = climb_ ? climb(run) : "";
    if (!climb_) run.generate(amount_.number());
    run.finish();
    say("\n{}\n", run.counts().table());
    if (by_class_) say("{}\n", run.counts().table_by_class());
    say("{}{}{}{}\n", climbs, run.counts().touches_text(), run.kept().worst_text(), run.summary());
    if (const auto why = run.shortfall()) say_on_stderr(fmt::format("nearmiss: {}\n", *why));
    return run.exit_code();
  }

 private:
  std::string amount_text() const {
    if (amount_.seconds) return fmt::format("{}for {} s", climb_ ? "climbing " : "", *amount_.seconds);
    const std::string_view of = climb_                                        ? " cases for each climb"
                                : scene_.name.empty() && !profile_.is_given() ? " cases for each query and subject"
                                                                              : " cases of the scene for each subject";
    return count_text(*amount_.number()) + std::string(of);
  }
  static void note_declared(Run& run) {
    nlohmann::ordered_json all;
    for (const Subject* s : run.settings().subjects) {
      for (const Query* q : run.settings().queries) {
        const std::vector<Declaration> declared = s->declared_for(q->name);
        if (!declared.empty()) all[s->name][q->name] = declarations_to_json(declared);
      }
    }
    if (!all.empty()) run.note("declared", all);
  }
  void check_own() const {
    for (const Subject* s : selection_.subjects()) {
      if (s->own) return;
    }
    throw BadInput("--update-worst: worst cases are stored of the tiers of collide, and none is chosen");
  }
  /// Returns the table of the worst errors, and the changed files.
  std::string climb(Run& run) const {
    Climber climber({run.settings().queries, run.settings().subjects, run.settings().seed, amount_.number()});
    run.climb(climber);
    std::string text = fmt::format("{}\nclimbed: {}\n\n", climber.table(), climber.summary());
    if (!update_worst_) return text;
    for (const std::string& line : update_worst_cases(climber)) text += line + "\n";
    return text + "\n";
  }

  Selection selection_;
  Amount amount_{10'000, {}, {}, {}, {}, {}};
  SceneOption scene_;
  ProfileOption profile_;
  bool by_class_ = false, climb_ = false, update_worst_ = false, every_answer_ = false;
};

}  // namespace

std::unique_ptr<Command> run_command() { return std::make_unique<RunCommand>(); }

}  // namespace nearmiss
