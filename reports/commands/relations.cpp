#include <fmt/format.h>

#include "corpus/files/errors.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/commands/profile_option.hpp"
#include "reports/engine/folder_lock.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/relations_run.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

std::vector<std::string> relation_names() {
  std::vector<std::string> names;
  for (const Relation& r : relations()) names.emplace_back(r.name);
  return names;
}

class RelationsCommand : public Command {
 public:
  Manual manual() const override {
    return {"relations",
            "ask subjects related cases, and report answers that contradict each other",
            {"Changes every generated case in exactly representable ways with a known effect on the answer: it "
             "turns, mirrors, moves or scales the case by powers of two, starts it later, or asks another query "
             "about the same sets. Each chosen subject answers the case and these follow-ups, in a process of its "
             "own. docs/searches.md has the table of relations.",
             "Answers that differ are no fault by themselves, because rounding may make them differ. A promise is "
             "broken where the judge proves that one of the answers violates its contract, where a subject gives "
             "no answer, or where bits differ although the subject claims that they do not. Decisions that "
             "contradict each other are reported too, because one of them is certainly wrong; the report names "
             "the wrong one, and states that no contract is broken.",
             "The folder receives relations.json with all counts, and "
             "relations/QUERY/SUBJECT-RELATION-BREACH-ID.json with the cases, their answers and truths: for each "
             "query, subject and relation the first 3 broken promises and the first contradiction, then those "
             "that are at least twice as bad as any before.",
             "The table has a row for each subject and relation. PAIRS: cases that were compared with their "
             "follow-ups. CONTRADICT: contradicting decisions, one of them wrong, within the contract. BITS: "
             "differences in spite of a claim. CONTRACT, BROKE: broken promises. BACKWARD: the largest proved "
             "bound on how far inputs would have to move to make a wrong answer right, in units of the scalar's "
             "epsilon."},
            {{"0", "No promise was broken; there may be contradictions."},
             {"1", "Broken promises, or a subject that broke."},
             {"2", "It could not run, or it was interrupted before it found anything."},
             internal_error_status()},
            {{"nearmiss relations --subject bullet", "Every query and relation of one subject."},
             {"nearmiss relations --subject ode --query box_box_overlap --relation swapped --cases 100000",
              "One query and one relation."},
             {"nearmiss relations --subject skim --plugin ./libskim.so --bit-for-bit",
              "A plugin that claims to use no tolerance."}}};
  }
  void declare(CLI::App& app) override {
    selection_.declare_subjects(app);
    selection_.declare_queries(app);
    app.add_option("-r,--relation", chosen_, "Only this relation; may be given several times. Default: all")
        ->type_name("RELATION")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false)
        ->check([](const std::string& name) {
          return find_relation(name) != nullptr ? "" : unknown_text("relation", name, relation_names());
        });
    amount_.declare(app, "Cases of each query and scalar", "The folder");
    scene_.declare(app);
    profile_.declare(app);
    app.add_flag("--bit-for-bit", bit_for_bit_,
                 "Every chosen subject claims to answer scaled cases alike bit for bit, as the tiers of collide do")
        ->disable_flag_override();
  }
  int run(const CLI::App&) override {
    const std::uint64_t seed = seed_or_random(amount_.seed);
    const std::optional<scenes::Scene> scene = scene_.load();
    if (scene) select_queries_of(*scene, selection_);
    std::optional<ChosenProfile> profile;
    if (profile_.is_given()) profile.emplace(profile_.file);
    const scenes::Scene* world = profile ? &profile->scene() : scene ? &*scene : nullptr;
    judge_by(amount_.measure, world);
    catch_interrupts();
    std::vector<const Relation*> wanted;
    for (const Relation& r : relations()) {
      if (chosen_.empty() || std::find(chosen_.begin(), chosen_.end(), r.name) != chosen_.end()) wanted.push_back(&r);
    }
    const std::filesystem::path folder = amount_.folder(seed);
    RelationsRun run({typed_command_line(), folder, profile ? profile->queries() : selection_.queries(),
                      profile ? profile->subjects() : selection_.subjects(), wanted, seed, bit_for_bit_, world});
    const FolderLock lock(folder);
    say("seed {}\n{}", seed, world == nullptr ? "" : measure_line(run.settings().queries, run.settings().subjects));
    std::fflush(stdout);
    const std::optional<RelationsRun::Clock::time_point> until = amount_.until();
    run.run(amount_.number(), until);
    run.write();
    if (run.pairs() == 0 && !interrupted()) {
      if (until && RelationsRun::Clock::now() >= *until) {
        throw BadInput("nothing was compared: the time was over before the first case");
      }
      if (const auto given_up = run.given_up(); !given_up.empty()) {
        throw BadInput(fmt::format("nothing was compared: {}", fmt::join(given_up, "; ")));
      }
      throw BadInput(
          "nothing was compared: no chosen subject offers a chosen query and its follow-ups by a chosen relation");
    }
    say("\n{}\n{}{}\n", run.table(), run.worst_findings(), run.summary());
    if (interrupted() || run.contradicted() > 0 || !run.vanished().empty())
      say_on_stderr(fmt::format("nearmiss: {}\n", run.summary()));
    if (run.contradicted() > 0) return InternalError::exit_code;
    return run.bad() > 0 ? 1 : interrupted() ? 2 : 0;
  }

 private:
  Selection selection_;
  std::vector<std::string> chosen_;
  Amount amount_{1'000, {}, {}, {}, {}, {}};
  bool bit_for_bit_ = false;
  SceneOption scene_;
  ProfileOption profile_;
};

}  // namespace

std::unique_ptr<Command> relations_command() { return std::make_unique<RelationsCommand>(); }

}  // namespace nearmiss
