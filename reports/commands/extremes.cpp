#include <fmt/format.h>

#include "corpus/files/errors.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/commands/profile_option.hpp"
#include "reports/engine/extremes.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/run.hpp"

namespace nearmiss {

namespace {

constexpr std::uint64_t default_cases = 30, most_cases_per_place = 1'000'000;

class ExtremesCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "extremes",
        "map the errors of subjects far out, and for tiny, huge, fast or nearly parallel bodies",
        {"Moves generated cases of every chosen query over planes of two parameters: distance from the origin "
         "and size of everything; speed, ratio of sizes, and nearly parallel directions, where the query has "
         "them. At each place it asks every chosen subject, and keeps the worst proved errors and the wrong "
         "decisions. Contracts play no part: places where nothing is promised are measured too, and no "
         "finding there is a violation.",
         "--profile takes the queries of a profile, their subjects, and the cases of its scene. The axes are the "
         "scene's own ranges: the distance from the origin, the largest size, and the speed.",
         "The folder receives extremes.json and, where the build found the Debian package node-d3, "
         "extremes.html: one self-contained page with a heat map for each query and subject. After an "
         "interrupt both hold the finished part. A subject with 3 time-outs in a row of a map is not asked "
         "again in that row; with 12 in a map, not in that map. Nor is one that broke in each of the first 64 cases of "
         "a map and in the "
         "most ordinary one. The map shows this.",
         "The table has a row for each query and subject: wrong decisions in each direction, answers that are "
         "not finite, and the largest proved errors. GAVE UP: cases that were not asked after too many "
         "time-outs or breakages. BACKWARD: how far inputs would have to move to make an answer right, in units of the "
         "scalar's epsilon. FORWARD: the distance of a number from the exact one, in units in the last place."},
        {{"0", "The maps were written."},
         {"2", "Wrong arguments, nothing to ask, an output that cannot be written, or it was interrupted."},
         internal_error_status()},
        {{"nearmiss extremes", "Every query and subject."},
         {"nearmiss extremes --query moving_sphere_box --subject collide-fast-float --cases 200 --out far",
          "One heat map for each plane, into the folder far."}}};
  }
  void declare(CLI::App& app) override {
    selection_.declare_subjects(app);
    selection_.declare_queries(app);
    profile_.declare(app);
    add_whole_number(app, "-n,--cases", cases_, fmt::format("Cases at each place. Default: {}", default_cases), 1,
                     most_cases_per_place);
    add_whole_number(app, "--seed", seed_, "The seed of the generator. Default: 1", 0,
                     std::numeric_limits<std::uint64_t>::max());
    add_output_folder(app, out_, "The folder. Default: reports/runs/TIME-SEED of the source tree");
  }
  int run(const CLI::App&) override {
    selection_.check_offered();
    std::optional<ChosenProfile> profile;
    if (profile_.is_given()) profile.emplace(profile_.file);
    const std::uint64_t seed = seed_.value_or(1);
    catch_interrupts();
    Extremes extremes({typed_command_line(), out_.empty() ? new_run_folder(seed) : std::filesystem::path(out_),
                       profile ? profile->queries() : selection_.queries(),
                       profile ? profile->subjects() : selection_.subjects(), seed, cases_.value_or(default_cases),
                       profile ? profile->scene().name : "",
                       profile ? scene_map_cases(profile->scene()) : generated_map_cases()});
    extremes.fill();
    extremes.write();
    say("{}\n{}\n", extremes.table(), extremes.summary());
    if (interrupted()) say_on_stderr(fmt::format("nearmiss: {}\n", extremes.summary()));
    return extremes.exit_code();
  }

 private:
  Selection selection_;
  ProfileOption profile_;
  std::optional<std::uint64_t> cases_, seed_;
  std::string out_;
};

}  // namespace

std::unique_ptr<Command> extremes_command() { return std::make_unique<ExtremesCommand>(); }

}  // namespace nearmiss
