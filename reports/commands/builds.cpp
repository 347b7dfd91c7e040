#include "reports/builds/builds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "corpus/files/errors.hpp"
#include "corpus/files/files.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/host/hosts.hpp"
#include "reports/builds/collide_builds.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/folder_lock.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

constexpr int builds_schema_version = 1;
constexpr std::uint64_t usual_cases = 10'000, usual_questions = 20'000;
constexpr std::size_t most_shown = 3;

class BuildsCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "builds",
        "compare builds of one library bit for bit",
        {"Asks two or more subjects the same generated cases, and compares the answers of each with those of the "
         "base: the first SUBJECT; without any, the first --plugin, or else the first --command. These are builds "
         "of "
         "one library by other compilers, with other flags or for other processors, or two versions. Subjects that "
         "--plugin and --command add are compared without being named; where two of them have the same name, the "
         "second one is NAME-2.",
         "Answers are compared bit for bit: whether there is an answer, the decision, which numbers are given, and "
         "each number "
         "that has a meaning. All NaN are the same, and 0 and -0 differ. Why a subject cannot answer is not "
         "compared.",
         "Of the first case with a difference the command looks for the simplest one with a difference of the same "
         "kind (in a number; in the decision; in what is given; or only one has an answer), tells which numbers "
         "differ and by how many units in the last place, and which of the builds is right: whose decision is the "
         "exact one, and whose numbers are not proved to differ by more than the subject promises, or, where it "
         "promises nothing, by more than the measure. The case is written to DIR/QUERY-SUBJECT.json, for 'nearmiss "
         "replay'.",
         "--collide TIER compares builds of collide itself, in float and in double: those of impl/builds/builds.txt "
         "whose compilers are installed, among them one for an ARM processor, which is emulated. They are built in "
         "DIR. "
         "docs/builds.md says what collide promises.",
         "OUTSIDE counts the differences in cases that the contract of the base does not cover; the first case is one "
         "that it covers, where there is one.",
         "--json prints one object for programs (reports/builds.schema.json)."},
        {{"0", "All answers are the same bit for bit."},
         {"1", "Some differ."},
         {"2", "It could not run, or it was interrupted. One line on standard error states the reason."},
         internal_error_status()},
        {{"nearmiss builds --plugin ./old.so --plugin ./new.so", "Two builds of a plugin."},
         {"nearmiss builds skim skim-wasm --plugin ./libskim.so --command 'node skim.mjs' --cases 1e6",
          "A native build and one in WebAssembly."},
         {"nearmiss builds --collide fast --collide accurate -q moving_sphere_box", "Builds of collide."}}};
  }
  void declare(CLI::App& app) override {
    declare_foreign_subjects(app, &loaded_);
    app.add_option("SUBJECT", named_, "The builds, the base first")->type_name("")->check(known_subject());
    selection_.declare_queries(app);
    app.add_option(
           "--collide", tiers_,
           "Compare builds of this tier of collide: fast, accurate, decisive or certified; may be given several "
           "times")
        ->type_name("TIER")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false)
        ->check(CLI::IsMember(std::vector<std::string>(std::begin(collide_tiers), std::end(collide_tiers))))
        ->excludes("SUBJECT");
    add_whole_number(app, "-n,--cases", cases_, fmt::format("Cases of each query. Default: {}", usual_cases), 1,
                     1'000'000'000'000);
    add_whole_number(app, "--seed", seed_, "The seed of the generator. Default: a random one, which is printed", 0,
                     std::numeric_limits<std::uint64_t>::max());
    add_whole_number(app, "--questions", questions_,
                     fmt::format("The most cases of a search for a simpler one. Default: {}", usual_questions), 1,
                     1'000'000'000);
    add_measure(app, measure_);
    add_output_folder(app, out_, "The folder. Default: reports/runs/builds of the source tree");
    app.add_flag("--json", json_, "Print JSON")->disable_flag_override();
  }
  int run(const CLI::App&) override {
    judge_by(measure_, nullptr);
    catch_interrupts();
    folder_ = out_.empty() ? runs_folder() / "builds" : std::filesystem::path(out_);
    const std::uint64_t seed = seed_or_random(seed_);
    if (tiers_.empty()) {
      compare(chosen(), seed);
    } else {
      compare_tiers(seed);
    }
    if (json_) {
      print_json(seed);
    } else {
      print_text(seed);
    }
    if (interrupted()) throw BadInput("interrupted");
    return std::any_of(all_.begin(), all_.end(), [](const ComparedBuild& c) { return c.different > 0; });
  }

 private:
  /// The named subjects, then those that the command line has loaded.
  std::vector<const Subject*> chosen() const {
    std::vector<std::string> names = named_;
    for (const std::string& name : loaded_) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    if (names.size() < 2)
      throw BadInput(
          fmt::format("builds: it compares two subjects or more, and {} is given; 'nearmiss help builds' "
                      "shows how to name them",
                      names.empty() ? "none" : "only " + names.front()));
    subjects_named(names);  // builds and starts them together
    std::vector<const Subject*> subjects;
    for (const std::string& name : names) subjects.push_back(find_subject(name));
    for (const Subject* s : subjects) {
      if (std::count(subjects.begin(), subjects.end(), s) > 1)
        throw BadInput(fmt::format("builds: {} is named twice", s->name));
      if (s->scalar != subjects.front()->scalar)
        throw BadInput(fmt::format("builds: {} computes in {}, and {} in {}", subjects.front()->name,
                                   name_of(subjects.front()->scalar), s->name, name_of(s->scalar)));
    }
    return subjects;
  }
  void compare(const std::vector<const Subject*>& subjects, std::uint64_t seed) {
    std::uint64_t done = 0;
    const BuildsSettings settings{selection_.queries(), seed, cases_.value_or(usual_cases),
                                  int(questions_.value_or(usual_questions)), [&](const Query& q) {
                                    progress_.set_activity(fmt::format("comparing {}", q.name));
                                    progress_.show(done++, std::nullopt, std::nullopt, std::nullopt);
                                  }};
    const std::size_t before = all_.size();
    for (ComparedBuild& c : compare_builds(settings, subjects)) all_.push_back(std::move(c));
    if (all_.size() == before && !interrupted())
      throw BadInput(fmt::format("builds: nothing to compare: {} and another one offer none of the chosen queries",
                                 subjects.front()->name));
  }
  void compare_tiers(std::uint64_t seed) {
    if (!loaded_.empty()) throw BadInput("--collide cannot be given together with --plugin or --command");
    const FolderLock lock(folder_);
    const CollideBuilds builds = build_collide(folder_, selection_.queries(), tiers_);
    notes_ = builds.notes;
    std::vector<std::vector<std::string>> groups;  // all are loaded first: each load moves the subjects
    for (const std::string& tier : tiers_) {
      for (const std::string scalar : {"float", "double"}) {
        for (const CollideBuild& b : builds.built) {
          if (b.base.empty()) groups.push_back(load(builds, b, tier, scalar));
        }
      }
    }
    for (const std::vector<std::string>& names : groups) {
      std::vector<const Subject*> subjects;
      for (const std::string& name : names) subjects.push_back(find_subject(name));
      if (subjects.size() > 1 && !interrupted()) compare(subjects, seed);
    }
  }
  /// The base and the builds that must have its bits.
  static std::vector<std::string> load(const CollideBuilds& builds, const CollideBuild& base, const std::string& tier,
                                       const std::string& scalar) {
    std::vector<std::string> names;
    const auto add = [&](const CollideBuild& b) {
      if (!b.has_every_tier && is_compiled(tier)) return;
      names.push_back(subject_of(b, tier, scalar));
      load_command(fmt::format("{} {} {} {}", b.command, tier, scalar, names.back()));
    };
    add(base);
    for (const CollideBuild& b : builds.built) {
      if (b.base == base.name) add(b);
    }
    return names;
  }

  void write_cases() const {
    for (const ComparedBuild& c : all_) {
      if (!c.first) continue;
      make_folder(folder_);
      write_file(file_of(c), pretty_json(case_to_json(c.first->question)));
    }
  }
  std::filesystem::path file_of(const ComparedBuild& c) const { return folder_ / (name_of(c) + ".json"); }

  void print_json(std::uint64_t seed) const {
    write_cases();
    nlohmann::ordered_json comparisons = nlohmann::ordered_json::array();
    for (const ComparedBuild& c : all_) {
      comparisons.push_back(compared_to_json(c));
      if (c.first) comparisons.back()["first"]["file"] = file_of(c).string();
    }
    say("{}", pretty_json({{"schema", builds_schema_version},
                           {"environment", environment_to_json()},
                           {"command", typed_command_line()},
                           {"seed", seed},
                           {"cases", cases_.value_or(usual_cases)},
                           {"notes", notes_},
                           {"comparisons", comparisons}}));
  }
  void print_text(std::uint64_t seed) const {
    write_cases();
    for (const std::string& note : notes_) say("{}\n", note);
    std::vector<std::vector<std::string>> rows{{"QUERY", "BUILD", "CASES", "DIFFERENT", "OUTSIDE", "FIRST", "RIGHT"}};
    std::uint64_t asked = 0, different = 0;
    for (const ComparedBuild& c : all_) {
      asked += c.asked, different += c.different;
      if (c.first)
        rows.push_back({std::string(c.query->name), c.other->name, count_text(c.asked), count_text(c.different),
                        count_text(c.outside), differs_text(*c.first), right_text(c)});
    }
    if (rows.size() > 1) say("{}\n", table_text(rows, "", 2));
    std::size_t shown = 0;
    for (const ComparedBuild& c : all_) {
      if (c.first && shown++ < most_shown) say("{}  {}\n\n", difference_text(c), path_text(file_of(c)));
    }
    if (shown > most_shown) say("the cases of all of these are in {}\n", path_text(folder_));
    say("seed {}: {} in {}, {} of them different\n", seed, plural_text(asked, "pair") + " of answers",
        plural_text(all_.size(), "comparison"), different == 0 ? "none" : count_text(different));
  }
  /// "decision", "time and 2 more".
  static std::string differs_text(const FirstDifference& d) {
    if (d.difference.numbers.empty()) return std::string(name_of(d.difference.kind));
    const DifferentNumber& n = d.difference.numbers.front();
    const std::size_t others = d.difference.numbers.size() - 1;
    return d.question.query->outputs[n.output].name + (others == 0 ? "" : fmt::format(" and {} more", others));
  }

  Selection selection_;
  std::vector<std::string> named_, loaded_, tiers_, notes_;
  std::optional<std::uint64_t> cases_, seed_, questions_;
  std::optional<double> measure_;
  std::string out_;
  bool json_ = false;
  std::filesystem::path folder_;
  std::vector<ComparedBuild> all_;
  Progress progress_;
};

}  // namespace

std::unique_ptr<Command> builds_command() { return std::make_unique<BuildsCommand>(); }

}  // namespace nearmiss
