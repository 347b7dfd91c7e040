#include <fmt/format.h>

#include "corpus/bad_input.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/folder_lock.hpp"
#include "reports/interrupt.hpp"
#include "reports/progress.hpp"
#include "reports/relations_run.hpp"
#include "reports/run.hpp"
#include "reports/text.hpp"

namespace nearmiss {

namespace {

constexpr std::uint64_t default_cases = 1'000, most_cases = 1'000'000'000;
constexpr double most_seconds = 1e8;

std::vector<std::string> relation_names() {
  std::vector<std::string> names;
  for (const Relation& r : relations()) names.emplace_back(r.name);
  return names;
}

class RelationsCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "relations",
        "ask subjects related cases, and report answers that do not go together",
        {"Every generated case is changed in ways that are exactly representable and have a known effect: turned, mirrored, "
         "moved, scaled by powers of two, started later, asked in another query about the same sets. Each chosen subject "
         "answers the case and what it is related to, in a process of its own. docs/properties.md has the table of relations.",
         "Answers that differ are no fault by themselves, for rounding may make them differ. A promise is broken where the "
         "judge proves one of the answers to be beyond its contract, where no answer came, or where bits differ although "
         "the subject claims that they do not. Decisions that contradict each other, so that one of them is wrong for "
         "certain, are reported too; each report says which one it is, and that no contract is broken.",
         "The folder receives relations.json with all counts, and relations/QUERY/SUBJECT-RELATION-BREACH-ID.json with the "
         "related cases, their answers and truths: of each query, subject and relation the first 3 broken promises and "
         "the first contradiction, then those that are at least twice as bad as any before.",
         "The table has a row for each subject and relation. PAIRS: cases that were compared with their partners. "
         "CONTRADICT: decisions of which one is wrong, within the contract. BITS: differences in spite of a claim. "
         "CONTRACT, BROKE: broken promises. BACKWARD: the largest proved bound on how far inputs would have to move to "
         "make a wrong answer right, in units of the scalar's epsilon."},
        {{"0", "No promise was broken; there may be contradictions within them."},
         {"1", "Broken promises, or a subject that broke."},
         {"2", "It could not run, it was interrupted before it found anything, or Nearmiss contradicted itself."}},
        {{"nearmiss relations --subject bullet", "Every query and relation of one subject."},
         {"nearmiss relations --subject ode --query box_box_overlap --relation swapped --cases 100000", "One of them."},
         {"nearmiss relations --subject skim --plugin ./libskim.so --bit-for-bit", "A plugin without any epsilon, so it says."}}};
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
    add_whole_number(app, "-n,--cases", cases_, fmt::format("Cases of each query and scalar. Default: {}", default_cases),
                     1, most_cases);
    add_positive_number(app, "-t,--seconds", seconds_, "For so long, instead of a number of cases", "S", most_seconds);
    app.get_option("--seconds")->excludes("--cases");
    add_whole_number(app, "--seed", seed_, "Of the generator. Default: a random one, which is printed", 0,
                     std::numeric_limits<std::uint64_t>::max());
    add_positive_number(app, "--measure", measure_,
                        "Judge all subjects by one promise in place of their own: a backward error of at most E, "
                        "relative to the largest number of each kind, say 1e-6",
                        "E", 1);
    app.add_flag("--bit-for-bit", bit_for_bit_,
                 "Every chosen subject claims to answer scaled cases alike bit for bit, as the tiers of collide do")
        ->disable_flag_override();
    add_output_folder(app, out_, "The folder. Default: reports/runs/TIME-SEED of the source tree");
  }
  int run(const CLI::App&) override {
    if (measure_) hold_all_to(*measure_);
    const std::uint64_t seed = seed_or_random(seed_);
    catch_interrupts();
    std::vector<const Relation*> wanted;
    for (const Relation& r : relations()) {
      if (chosen_.empty() || std::find(chosen_.begin(), chosen_.end(), r.name) != chosen_.end()) wanted.push_back(&r);
    }
    const std::filesystem::path folder = out_.empty() ? new_run_folder(seed) : std::filesystem::path(out_);
    RelationsRun run({typed_command_line(), folder, selection_.queries(), selection_.subjects(), wanted, seed, bit_for_bit_});
    const FolderLock lock(folder);
    fmt::print("seed {}\n", seed);
    std::fflush(stdout);
    std::optional<RelationsRun::Clock::time_point> until;
    if (seconds_) {
      until = RelationsRun::Clock::now() +
              std::chrono::duration_cast<RelationsRun::Clock::duration>(std::chrono::duration<double>(*seconds_));
    }
    run.run(seconds_ ? std::nullopt : std::optional(cases_.value_or(default_cases)), until);
    run.write();
    if (run.pairs() == 0 && !interrupted()) {
      if (until && RelationsRun::Clock::now() >= *until) {
        throw BadInput("nothing was compared: the time was over before the first case");
      }
      throw BadInput("nothing was compared: no chosen subject offers a chosen query and its partners by a chosen relation");
    }
    fmt::print("\n{}\n{}{}\n", run.table(), run.worst_findings(), run.summary());
    if (interrupted() || run.contradicted() > 0) say_on_stderr(fmt::format("nearmiss: {}\n", run.summary()));
    if (run.contradicted() > 0) return 2;
    return run.bad() > 0 ? 1 : interrupted() ? 2 : 0;
  }

 private:
  Selection selection_;
  std::vector<std::string> chosen_;
  std::optional<std::uint64_t> cases_, seed_;
  std::optional<double> seconds_, measure_;
  std::string out_;
  bool bit_for_bit_ = false;
};

}  // namespace

std::unique_ptr<Command> relations_command() { return std::make_unique<RelationsCommand>(); }

}  // namespace nearmiss
