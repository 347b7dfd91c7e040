#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "impl/subject/provenance.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/commands/profile_option.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/night.hpp"
#include "reports/engine/night_changes.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/progress.hpp"
#include "reports/findings/text.hpp"
#include "reports/page/night_triage.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Clock = Run::Clock;

constexpr double default_minutes = 10, most_minutes = 1e6;
/// The shares of the total time for climbing, for properties, of which half is for relations, and for fuzzing.
constexpr double climbing_share = 1.0 / 12, properties_share = 1.0 / 5, fuzzing_share = 1.0 / 3;
/// Where --triage-minutes is not given: the share of the total time for the triage, and the most.
constexpr double triage_share = 0.25, most_triage_minutes = 30;
static_assert(fuzzing_share * merging_share <= 0.1, "corpora are minimised in at most a tenth of the night");
constexpr std::uint64_t most_jobs = 1024;

/// Shows progress while the launcher builds, before there is a run.
void wait_for(const std::string& step, Building& building) {
  constexpr int patience = 200;  // milliseconds
  Progress progress;
  progress.set_activity("subjects are being built");
  while (building.may_have(step) && !interrupted()) {
    building.poll(patience);
    progress.show(0, std::nullopt, std::nullopt, std::nullopt);
  }
}

constexpr const char* cannot_build =
    "nightly: the launcher could not build the subjects; build/night.log in the source tree says why";

/// The subjects that a night asks while the launcher builds the others: those that it has built, and plugins and
/// commands. Waits for the first.
std::vector<const Subject*> first_subjects(Building& building) {
  wait_for("subjects", building);
  if (!building.has("hosts") && !building.may_have("hosts")) throw BadInput(cannot_build);
  std::vector<const Subject*> first = subjects_named(building.subjects());
  for (const Subject* s : plugins_and_commands()) first.push_back(s);
  return first;
}

class NightlyCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "nightly",
        "examine every subject for a given time: stored and generated cases, relations, properties, fuzzing",
        {"First the tiers of collide answer their stored worst cases (corpus/worst/). Every subject answers the "
         "cases of earlier nights' reports in the run folder, and every stored case (seeds and regressions), whose "
         "findings are compared with the stored expectations. Then new cases are generated for all queries and "
         "subjects. A twelfth of the time goes to climbing towards the worst errors, as in 'nearmiss run --climb'. "
         "A fifth goes to properties: half of it to relations between answers, as in 'nearmiss relations', and half "
         "to the property tests of this build, which ask the tiers of collide new cases with fresh seeds. The last "
         "third is for the fuzz targets. Corpora that have doubled are minimised first, in at most a quarter of "
         "that third. Then the targets run as separate processes, --jobs of them at once: each has a turn, and "
         "those that find most have more. Their cases are judged and reported like all others. The targets ask the "
         "tiers of collide, plugins, commands, and the subjects of NEARMISS_ADD that they were built with. Where "
         "the fuzz targets are not built, the summary and the index say so, and the generated cases get their time.",
         "With --profile the night asks what a profile of 'nearmiss scene advise' offers, and nothing else: cases of "
         "its scene for each of its queries and subjects, their relations, and the fuzz targets of its queries, which "
         "ask the profile's choice alone, start from cases of the scene and stay in its ranges. Stored cases, climbs "
         "and property tests, which "
         "know no scene, are left out, and the cases of the scene get their time.",
         "The night ends with a triage, as in 'nearmiss triage', for a quarter of the time (at most half an hour) or "
         "--triage-minutes: reports are grouped into signatures, and compared with those of the last night: new, worse "
         "(at least twice the proved size), known, and fixed (asked again, and right now). The last night is the one "
         "before in the same folder; without --out the newest run with a triage. The result is triage/triage.json, and "
         "index.html is its page, as 'nearmiss render' writes it. With --no-triage, findings are compared by query, "
         "subject and kind alone, with the earlier nights in the same folder. The first line of the comparison is "
         "about the subjects whose night it is: collide, plugins, "
         "commands and subjects of NEARMISS_ADD. They alone decide the exit status: 1 for a new or worse finding, a "
         "finding that a stored case does not expect, a broken relation, a failed property, or a fuzz target that "
         "ends with an error.",
         "The run folder is that of 'nearmiss run --climb', with relations.json and relations/ of 'nearmiss "
         "relations', properties/ for messages and reports of property tests, corpus/QUERY/ for the corpus of the "
         "fuzz targets, tables.txt for the counts of each query and subject, fuzz/ for their files and messages, and "
         "fixed/ for earlier reports whose findings are "
         "fixed. Give the same folder every night to keep the corpus and to compare."},
        judging_exit_status(),
        {{"nearmiss nightly --minutes 60", "One hour."},
         {"nearmiss nightly --minutes 480 --out nights", "A night, with a corpus that grows from night to night."},
         {"nearmiss nightly --profile profile/profile.json", "A night for what one program asks."}}};
  }
  void declare(CLI::App& app) override {
    declare_foreign_subjects(app);
    add_positive_number(app, "-m,--minutes", minutes_, fmt::format("The total time. Default: {}", default_minutes), "M",
                        most_minutes);
    add_whole_number(app, "--seed", seed_, "The seed of the generator. Default: a random one, which is printed", 0,
                     std::numeric_limits<std::uint64_t>::max());
    add_whole_number(app, "-j,--jobs", jobs_, "How many fuzz targets run at once. Default: the number of processors", 1,
                     most_jobs);
    add_output_folder(app, out_, "The run folder. Default: reports/runs/TIME-SEED of the source tree");
    add_positive_number(app, "--triage-minutes", triage_minutes_,
                        "The most time of the triage, a part of --minutes and at most half of it", "M", most_minutes);
    profile_.declare(app);
    app.add_flag("--no-triage", no_triage_, "End without a triage and without a page")->excludes("--triage-minutes");
    app.add_option("--fuzz-targets", targets_, "Where the fuzz targets are. Default: the build's own folder")
        ->type_name("DIR")
        ->check(CLI::Validator(
            [](const std::string& t) {
              std::error_code error;
              return fs::is_directory(t, error) ? "" : fmt::format("'{}' is no folder", t);
            },
            ""));
  }
  int run(const CLI::App&) override {
    const auto begin = Clock::now();
    const double seconds = 60 * minutes_.value_or(default_minutes);
    const double for_triage = triage_seconds(seconds);
    const auto end =
        begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds - for_triage));
    const std::uint64_t seed = seed_or_random(seed_);
    const Selection all;
    catch_interrupts();
    Building building;
    building.wait_for_a_build_without_work();
    std::optional<ChosenProfile> profile;
    if (profile_.is_given()) {
      wait_for("hosts", building);
      profile.emplace(profile_.file);
    }
    const scenes::Scene* scene = profile ? &profile->scene() : nullptr;
    judge_by(std::nullopt, scene);
    const std::vector<const Query*> queries = profile ? profile->queries() : all.queries();
    foreign_subjects();  // refuses a bad name now rather than in the last third
    const bool is_whole = profile || building.has("hosts");
    BuiltTargets found = fuzz_targets(queries);
    Run run({typed_command_line(), out_.empty() ? new_run_folder(seed) : fs::path(out_), queries,
             profile    ? profile->subjects()
             : is_whole ? all.subjects()
                        : first_subjects(building),
             seed, end, false, scene});
    if (scene != nullptr) run.note("scene", scene->name);
    if (scene != nullptr) run.note("required", limits_to_json(*scene_limits()));
    say("seed {}, for {}, into {}\n{}{}\n", seed, duration_text(seconds), path_text(run.settings().folder),
        measure_line(run.settings().queries, run.settings().subjects), targets_text(found, building));
    std::fflush(stdout);
    const std::vector<WrittenReport> earlier = run.kept().written();
    std::set<std::string> again;
    StoredCasesOfNight stored;
    if (!is_whole) {
      ask_again(run, run.settings().subjects, earlier, again);
      stored.ask(run, run.settings().subjects);
      wait_for("hosts", "the other subjects are being built", building, run);
    }
    const std::vector<const Subject*> joined = is_whole ? run.settings().subjects : join(run, all, building);
    if (!profile) run.ask_worst_cases();
    ask_again(run, joined, earlier, again);
    if (!profile) stored.ask(run, joined);
    const double later = found.targets.empty() && !building.may_have("targets") ? 0 : fuzzing_share;
    const double testing = profile ? 0 : properties_share / 2, relating = properties_share / 2;
    run.set_until(between(begin, end, 1 - later - testing - relating - (profile ? 0 : climbing_share)));
    run.set_activity("generated cases");
    run.generate(std::nullopt);
    run.set_until(between(begin, end, 1 - later - testing - relating));
    if (!profile) climb(run);
    run.set_until(end);
    const int related = relate(run, between(begin, end, 1 - later - testing), scene);
    bool failed = (!profile && ask_properties(run, between(begin, end, 1 - later), building)) || related > 0;
    if (later > 0 && targets_.empty()) {
      wait_for("targets", "the fuzz targets are being built", building, run);
      found = building.has("targets") ? fuzz_targets(queries) : BuiltTargets{{}, found.missing, found.where};
    }
    if (profile) put_seeds_of(*scene, found, run);
    const NightFuzzing fuzzing = fuzz_all(run, found, profile_.file, jobs(), end);
    failed = failed || fuzzing.failed;
    const NightChanges changes(earlier, run.written_now(), again);
    run.note("night", changes.to_json());
    run.finish();
    put_aside_fixed(changes, earlier, run.settings().folder);
    run.write_tables();
    const std::optional<NightTriage> triaged = triage(run, for_triage);
    say("\n{}\n{}\ntables: {}\n\n{}{}; fuzzing: {}\n", run.counts().totals(),
        triaged ? triaged->text() : changes.text(run.settings().folder),
        path_text(run.settings().folder / "tables.txt"), unexpected_text(stored.unexpected()), run.summary(),
        fuzzing.text);
    if (const auto why = run.shortfall()) say_on_stderr(fmt::format("nearmiss: {}\n", *why));
    if (building.has_failed())
      say_on_stderr(
          "nearmiss: this night lacked what the launcher could not build; build/night.log in the source tree says "
          "why\n");
    if (std::max(related, run.exit_code()) == InternalError::exit_code) return InternalError::exit_code;
    if (triaged && triaged->internal_errors() > 0) return InternalError::exit_code;
    if (failed || stored.unexpected() > 0 || (triaged ? triaged->is_regression() : changes.is_regression())) return 1;
    return run.shortfall() || building.has_failed() ? 2 : 0;
  }

 private:
  BuiltTargets fuzz_targets(std::span<const Query* const> queries) const {
    return find_fuzz_targets(targets_.empty() ? std::nullopt : std::optional(fs::path(targets_)), queries);
  }
  /// Adds the subjects that the launcher has built meanwhile to the run, and returns them. Throws BadInput where it
  /// could not build them.
  static std::vector<const Subject*> join(Run& run, const Selection& all, const Building& building) {
    if (run.should_stop()) return {};
    if (!building.has("hosts")) throw BadInput(cannot_build);
    const std::vector<const Subject*> before = run.settings().subjects;
    run.extend(all.subjects());
    std::vector<const Subject*> joined = run.settings().subjects;
    std::erase_if(joined, [&](const Subject* s) { return std::find(before.begin(), before.end(), s) != before.end(); });
    return joined;
  }
  double triage_seconds(double seconds) const {
    if (no_triage_) return 0;
    if (triage_minutes_) return std::min(60 * *triage_minutes_, seconds / 2);
    return std::min(seconds * triage_share, 60 * most_triage_minutes);
  }
  /// The triage of a night that was not interrupted, noted in the index; empty with --no-triage.
  std::optional<NightTriage> triage(Run& run, double seconds) const {
    if (no_triage_ || interrupted()) return std::nullopt;
    const fs::path folder = run.settings().folder;
    const std::optional<fs::path> siblings = out_.empty() ? std::optional(folder.parent_path()) : std::nullopt;
    NightTriage triaged({folder, last_triage(folder, siblings), std::chrono::duration<double>(seconds)});
    run.note("triage", triaged.to_json());
    run.finish();
    return triaged;
  }
  static std::string unexpected_text(std::uint64_t unexpected) {
    if (unexpected == 0) return "";
    return fmt::format("{} that stored cases do not expect: \"stored\" in index.json\n",
                       plural_text(unexpected, "finding"));
  }
  static std::string targets_text(const BuiltTargets& found, const Building& building) {
    if (building.may_have("targets")) {
      return "What is not built yet is built beside this night, and joins it: build/night.log has the progress.";
    }
    if (found.targets.empty()) {
      return fmt::format(
          "The fuzz targets are not built (none with libFuzzer in {}): "
          "cmake --preset fuzz && cmake --build --preset fuzz builds them.",
          found.where);
    }
    return fmt::format("{} of {} fuzz targets in {}", found.targets.size(), found.targets.size() + found.missing.size(),
                       found.where);
  }
  unsigned jobs() const { return unsigned(jobs_.value_or(std::max(1u, std::thread::hardware_concurrency()))); }

  std::optional<double> minutes_, triage_minutes_;
  bool no_triage_ = false;
  std::optional<std::uint64_t> seed_, jobs_;
  std::string out_, targets_;
  ProfileOption profile_;
};

}  // namespace

std::unique_ptr<Command> nightly_command() { return std::make_unique<NightlyCommand>(); }

}  // namespace nearmiss
