#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <thread>

#include "corpus/scenes/scene_cases.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/commands/profile_option.hpp"
#include "reports/engine/building.hpp"
#include "reports/engine/fuzz_night.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/night_changes.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/property_tests.hpp"
#include "reports/engine/relations_run.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/text.hpp"
#include "reports/page/night_triage.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Clock = Run::Clock;

constexpr double default_minutes = 10, most_minutes = 1e6;
/// The shares of the total time for climbing, for properties, of which half is for relations, and for fuzzing; the
/// shares of the fuzzing time for judging the cases that it found, and for minimising corpora.
constexpr double climbing_share = 1.0 / 12, properties_share = 1.0 / 6, fuzzing_share = 1.0 / 3, judging_share = 0.1,
                 merging_share = 0.25;
/// Where --triage-minutes is not given: the share of the total time for the triage, and the most.
constexpr double triage_share = 0.1, most_triage_minutes = 30;
static_assert(fuzzing_share * merging_share <= 0.1, "corpora are minimised in at most a tenth of the night");
constexpr std::uint64_t most_jobs = 1024;

Clock::time_point between(Clock::time_point a, Clock::time_point b, double share) {
  return a + std::chrono::duration_cast<Clock::duration>((b - a) * share);
}

double seconds_until(Clock::time_point t) { return std::chrono::duration<double>(t - Clock::now()).count(); }

/// Compares the findings of a stored case with its expectations.
class Expectations : public Sink {
 public:
  void about(const StoredCase& stored) { stored_ = &stored; }
  void take(const Examined& e) override {
    for (const Expected& expected : stored_->expected) {
      if (expected.subject == e.subject.name) compare(expected, e);
    }
  }
  std::uint64_t compared = 0;
  std::uint64_t of_ours = 0;  ///< unexpected findings of subjects whose night it is
  Json unexpected = Json::array();

 private:
  void compare(const Expected& e, const Examined& found) {
    ++compared;
    const std::string_view verdict = name_of(found.finding.verdict), fault = name_of(found.finding.disagreement);
    if (e.verdict == verdict && (e.disagreement.empty() || e.disagreement == fault)) return;
    if (is_ours(e.subject)) ++of_ours;
    unexpected.push_back({{"file", stored_->file.filename().string()},
                          {"query", found.question.query->name},
                          {"subject", e.subject},
                          {"expected", e.verdict + (e.disagreement.empty() ? "" : ", " + e.disagreement)},
                          {"found", fmt::format("{}, {}", verdict, fault)}});
  }
  const StoredCase* stored_ = nullptr;
};

/// Asks these subjects every stored case.
class StoredCases {
 public:
  void ask(Run& run, std::span<const Subject* const> subjects) {
    run.set_activity("stored cases");
    for (const Query* q : run.settings().queries) {
      for (const StoredCase& stored : stored_cases(*q)) {
        if (run.should_stop()) break;
        asked_.insert(stored.file);
        expectations_.about(stored);
        run.examine_by(subjects, stored.question, &expectations_);
      }
    }
    run.note(
        "stored",
        {{"cases", asked_.size()}, {"expectations", expectations_.compared}, {"unexpected", expectations_.unexpected}});
  }
  /// The number of unexpected findings of subjects whose night it is.
  std::uint64_t unexpected() const { return expectations_.of_ours; }

 private:
  std::set<fs::path> asked_;
  Expectations expectations_;
};

/// Asks these subjects the cases of earlier nights' reports again. Adds the files of those that were asked.
void ask_again(Run& run, std::span<const Subject* const> subjects, const std::vector<WrittenReport>& earlier,
               std::set<std::string>& again) {
  run.set_activity("findings of earlier nights");
  for (const WrittenReport& w : earlier) {
    if (run.should_stop()) break;
    try {
      run.examine_by(subjects, read_case_or_report(run.settings().folder / w.file));
      again.insert(w.file);
    } catch (const BadInput&) {  // a report of another version; its kind stays known
    }
  }
}

/// Shows the progress of the run while the launcher builds.
void wait_for(const std::string& step, const std::string& what, Building& building, Run& run) {
  constexpr int patience = 200;  // milliseconds
  if (building.may_have(step)) run.set_activity(what);
  while (building.may_have(step) && !run.should_stop()) {
    building.poll(patience);
    run.tick();
  }
}

Json outcome_json(const FuzzOutcome& o) {
  return {{"query", o.query},           {"seconds", o.seconds}, {"turns", o.turns},   {"executions", o.executions},
          {"new_inputs", o.new_inputs}, {"ended", o.ended},     {"failed", o.failed}, {"asked", o.asked}};
}

/// The results of the fuzz targets.
struct Fuzzing : FuzzNightOutcome {
  std::size_t failed() const {
    return std::size_t(std::count_if(ran.begin(), ran.end(), [](const FuzzOutcome& o) { return o.failed; }));
  }
  std::uint64_t executions() const {
    return std::accumulate(ran.begin(), ran.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const FuzzOutcome& o) { return sum + o.executions; });
  }
  /// Subjects of NEARMISS_ADD that a target should ask but does not know, because it was built without them.
  std::vector<std::string> unknown() const {
    std::set<std::string> names;
    for (const FuzzOutcome& o : ran) {
      for (const std::string& name : added_subjects()) {
        const bool offered = find_subject(name)->offering(o.query).offer != Offer::not_offered;
        if (offered && !o.asked.empty() && std::find(o.asked.begin(), o.asked.end(), name) == o.asked.end())
          names.insert(name);
      }
    }
    return {names.begin(), names.end()};
  }
};

/// The loaded plugins and commands.
std::vector<const Subject*> plugins_and_commands() {
  const std::vector<std::string> built_in = built_in_subjects();
  std::vector<std::string> names = subject_names();
  std::erase_if(names, [&](const auto& n) { return std::find(built_in.begin(), built_in.end(), n) != built_in.end(); });
  return subjects_named(names);
}

/// The loaded plugins and commands, for the targets. Throws BadInput for a name that cannot be passed to them.
ForeignSubjects foreign_subjects() {
  ForeignSubjects foreign;
  for (const Subject* s : plugins_and_commands()) {
    if (s->plugin.find(':') != std::string::npos) {
      throw BadInput(s->plugin + ": fuzz targets cannot be told of a plugin with ':' in its name; move it elsewhere");
    }
    if (s->command.find('\n') != std::string::npos) {
      throw BadInput(s->command + ": fuzz targets cannot be told of a command of several lines; write it on one");
    }
    if (!s->plugin.empty()) foreign.plugins.push_back(s->plugin);
    if (!s->command.empty()) foreign.commands.push_back(s->command);
  }
  return foreign;
}

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

/// The case in a file that a fuzz target left: JSON, or an artifact of libFuzzer in its query's folder.
std::optional<Case> fuzzed_case(const fs::path& file) {
  if (file.extension() == ".json") return read_case_or_report(file);
  const Query* query = find_query(file.parent_path().filename().string());
  const std::string bytes = query == nullptr ? "" : read_file(file);
  if (bytes.empty()) return std::nullopt;
  std::optional<Case> c = case_from_bytes(*query, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  if (c) c->origin = "fuzz/" + std::string(query->name) + "/" + file.filename().string();
  return c;
}

/// Puts cases of the scene into the corpora of the targets, for them to start from, in the scalars of the subjects that
/// are asked them.
void put_seeds_of(const scenes::Scene& scene, const FuzzTargets& found, const Run& run) {
  constexpr std::uint64_t seeds_of_scalar = 64;
  for (const FuzzTarget& t : found.targets) {
    const fs::path corpus = run.settings().folder / "corpus" / t.query->name;
    make_folder(corpus);
    for (const Subject* s : run.settings().subjects) {
      if (s->offering(t.query->name).answer == nullptr) continue;
      for (std::uint64_t i = 0; i < seeds_of_scalar; ++i) {
        const auto bytes = case_to_bytes(scenes::draw_case(scene, *t.query, s->scalar, run.settings().seed, i));
        write_file(corpus / fmt::format("scene-{}-{}", name_of(s->scalar), i),
                   {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
      }
    }
  }
}

/// Turns what the targets left into findings of this run.
Json examine_fuzzed(Run& run) {
  run.set_activity("judging what fuzzing found");
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(run.settings().folder / "fuzz")) {
    if (entry.is_regular_file() && entry.path().extension() != ".log") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::uint64_t examined = 0;
  Json unreadable = Json::array();
  for (const fs::path& f : files) {
    if (run.should_stop()) break;
    try {
      if (const std::optional<Case> c = fuzzed_case(f)) run.examine_by_all(*c);
      ++examined;
    } catch (const ReportedError& e) {
      unreadable.push_back(e.what());
    }
  }
  return {{"files", files.size()}, {"examined", examined}, {"unreadable", unreadable}};
}

/// Climbs towards the worst errors of every subject.
void climb(Run& run) {
  Climber climber({run.settings().queries, run.settings().subjects, run.settings().seed});
  run.climb(climber);
  say("climbing: {}; the worst are in worst/\n", climber.summary());
}

/// Related cases of every subject. Returns 0, 1 for broken promises of a subject whose night it is, or InternalError's
/// exit code.
int relate(Run& run, Clock::time_point until, const scenes::Scene* scene) {
  run.set_activity("relations");
  std::vector<const Relation*> all;
  for (const Relation& r : relations()) all.push_back(&r);
  RelationsRun related({run.settings().command, run.settings().folder, run.settings().queries, run.settings().subjects,
                        all, run.settings().seed, false, scene});
  related.run(std::nullopt, until);
  related.write();
  run.note("relations", {{"file", "relations.json"},
                         {"pairs", related.pairs()},
                         {"broken", related.bad()},
                         {"contradictions", related.contradictions()},
                         {"oracle", related.contradicted()},
                         {"reports", related.reports()}});
  say("relations: {}\n", related.summary());
  if (related.contradicted() > 0) return InternalError::exit_code;
  return related.bad_of([](const Subject& s) { return is_ours(s.name); }) > 0 ? 1 : 0;
}

/// Runs the property tests with fresh seeds. True where one failed.
bool ask_properties(Run& run, Clock::time_point until, const Building& building) {
  Json note{{"state", "not built"}, {"seeds", Json::array()}, {"passed", 0}, {"failed", Json::array()}, {"ended", ""}};
  const std::optional<fs::path> program = building.has("properties") ? find_property_tests() : std::nullopt;
  const double left = seconds_until(until);
  if (!program || left < 1) {
    note["state"] = program ? "no time" : "not built";
    run.note("properties", note);
    say("properties: {}\n", program                           ? "no time was left"
                            : building.may_have("properties") ? "not built yet"
                                                              : "not built");
    return false;
  }
  run.set_activity("properties");
  const PropertyOutcome o =
      run_property_tests(*program, {run.settings().folder, foreign_subjects(), run.settings().seed, left,
                                    [&] { run.tick(); }, [&] { return run.should_stop(); }});
  note = {{"state", "ran"}, {"seeds", o.seeds}, {"passed", o.passed}, {"failed", o.failed}, {"ended", o.ended}};
  run.note("properties", note);
  say("properties: {} with fresh seeds passed, {} failed{}{}\n", plural_text(o.passed, "test"), o.failed.size(),
      o.failed.empty() ? "" : ": see properties/", o.ended.empty() ? "" : fmt::format("; {}", o.ended));
  return !o.failed.empty() || !o.ended.empty();
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
         "A sixth goes to properties: half of it to relations between answers, as in 'nearmiss relations', and half "
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
         "The night ends with a triage, as in 'nearmiss triage', for a tenth of the time (at most half an hour) or "
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
         "fuzz targets, fuzz/ for their files and messages, and fixed/ for earlier reports whose findings are "
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
    FuzzTargets found = fuzz_targets(queries);
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
    StoredCases stored;
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
      found = building.has("targets") ? fuzz_targets(queries) : FuzzTargets{{}, found.missing, found.where};
    }
    if (profile) put_seeds_of(*scene, found, run);
    const std::string fuzzing = fuzz_all(run, found, end, failed);
    const NightChanges changes(earlier, run.written_now(), again);
    run.note("night", changes.to_json());
    run.finish();
    put_aside_fixed(changes, earlier, run.settings().folder);
    const std::optional<NightTriage> triaged = triage(run, for_triage);
    say("\n{}\n{}{}\n{}\n{}{}; fuzzing: {}\n", run.counts().table(), run.counts().touches_text(),
        run.kept().worst_text(), triaged ? triaged->text() : changes.text(run.settings().folder),
        unexpected_text(stored.unexpected()), run.summary(), fuzzing);
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
  FuzzTargets fuzz_targets(std::span<const Query* const> queries) const {
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
  static std::string targets_text(const FuzzTargets& found, const Building& building) {
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
  /// Runs the fuzz targets and adds their results to the index. Sets `failed` where a target ended with an error.
  /// Returns the text for the summary.
  std::string fuzz_all(Run& run, const FuzzTargets& found, Clock::time_point end, bool& failed) const {
    Json note{{"state", "not built"}, {"where", found.where}, {"missing", found.missing}, {"targets", Json::array()}};
    if (found.targets.empty()) {
      run.note("fuzz", note);
      return "not built";
    }
    const Clock::time_point now = Clock::now();
    FuzzNight night{run.settings().folder,
                    foreign_subjects(),
                    profile_.file,
                    jobs(),
                    between(now, end, merging_share),
                    [&] { run.tick(); },
                    [&] { return run.should_stop(); },
                    [&](const std::string& what) { run.set_activity(what); }};
    const MergeOutcome merged = merge_corpora(found.targets, night);
    night.until = between(now, end, 1 - judging_share);
    const Fuzzing all{fuzz_in_turns(found.targets, night)};
    note["merged"] = {{"queries", merged.merged}, {"before", merged.before}, {"after", merged.after}};
    for (const FuzzOutcome& o : all.ran) note["targets"].push_back(outcome_json(o));
    note["no_time"] = all.no_time;
    note["state"] = all.ran.empty() ? "no time" : "ran";
    if (!all.ran.empty()) note["left"] = examine_fuzzed(run);
    run.note("fuzz", note);
    if (all.ran.empty()) return "no time was left";
    failed = failed || all.failed() > 0;
    const std::vector<std::string> unknown = all.unknown();
    return fmt::format("{} of {} targets, {}, {}{}{}", all.ran.size(), found.targets.size() + found.missing.size(),
                       plural_text(all.executions(), "execution"),
                       plural_text(note["left"]["files"].get<std::uint64_t>(), "case file"),
                       all.failed() > 0 ? fmt::format(", {} ended with an error, see fuzz/*.log", all.failed()) : "",
                       unknown.empty() ? "" : fmt::format(", built without {}", list_text(unknown)));
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
