#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "corpus/codec.hpp"
#include "corpus/store.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/fuzz_targets.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/property_tests.hpp"
#include "reports/engine/relations_run.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Clock = Run::Clock;

constexpr double default_minutes = 10, most_minutes = 1e6;
/// The shares of the total time for climbing, for properties, of which half is for relations, and for fuzzing; and the
/// share of the fuzzing time for judging the cases that it found.
constexpr double climbing_share = 1.0 / 12, properties_share = 1.0 / 6, fuzzing_share = 1.0 / 3, judging_share = 0.1;

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
  Json unexpected = Json::array();

 private:
  void compare(const Expected& e, const Examined& found) {
    ++compared;
    const std::string_view verdict = name_of(found.finding.verdict), fault = name_of(found.finding.disagreement);
    if (e.verdict == verdict && (e.disagreement.empty() || e.disagreement == fault)) return;
    unexpected.push_back({{"file", stored_->file.filename().string()},
                          {"query", found.question.query->name},
                          {"subject", e.subject},
                          {"expected", e.verdict + (e.disagreement.empty() ? "" : ", " + e.disagreement)},
                          {"found", fmt::format("{}, {}", verdict, fault)}});
  }
  const StoredCase* stored_ = nullptr;
};

/// Asks every stored case of every subject.
void replay_stored(Run& run) {
  run.set_activity("stored cases");
  std::uint64_t cases = 0;
  Expectations expectations;
  for (const Query* q : run.settings().queries) {
    for (const StoredCase& stored : stored_cases(*q)) {
      if (run.should_stop()) break;
      ++cases;
      expectations.about(stored);
      run.examine_by_all(stored.question, &expectations);
    }
  }
  run.note("stored",
           {{"cases", cases}, {"expectations", expectations.compared}, {"unexpected", expectations.unexpected}});
}

Json outcome_json(const FuzzOutcome& o) {
  return {{"query", o.query}, {"seconds", o.seconds}, {"executions", o.executions},
          {"ended", o.ended}, {"failed", o.failed},   {"asked", o.asked}};
}

/// The results of the fuzz targets.
struct Fuzzing {
  std::vector<FuzzOutcome> ran;
  std::vector<std::string> no_time;  ///< queries whose target had no time left

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

/// The loaded plugins and commands, for the targets. Throws BadInput for a name that cannot be passed to them.
ForeignSubjects foreign_subjects() {
  ForeignSubjects foreign;
  for (const Subject& s : subjects()) {
    if (s.plugin.find(':') != std::string::npos) {
      throw BadInput(s.plugin + ": fuzz targets cannot be told of a plugin with ':' in its name; move it elsewhere");
    }
    if (s.command.find('\n') != std::string::npos) {
      throw BadInput(s.command + ": fuzz targets cannot be told of a command of several lines; write it on one");
    }
    if (!s.plugin.empty()) foreign.plugins.push_back(s.plugin);
    if (!s.command.empty()) foreign.commands.push_back(s.command);
  }
  return foreign;
}

/// Runs each target for the same time, at least a second; so the last targets may have no time left. The seed selects
/// the first target, so that the others take turns to have none.
Fuzzing run_targets(Run& run, std::vector<FuzzTarget> targets, Clock::time_point until) {
  std::rotate(targets.begin(), targets.begin() + std::ptrdiff_t(run.settings().seed % targets.size()), targets.end());
  Fuzzing all;
  const ForeignSubjects foreign = foreign_subjects();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const std::string query(targets[i].query->name);
    const double left = seconds_until(until);
    if (left < 1 || run.should_stop()) {
      all.no_time.push_back(query);
      continue;
    }
    run.set_activity(fmt::format("fuzzing {}", query));
    const double share = left / double(targets.size() - i);
    all.ran.push_back(fuzz(targets[i], {run.settings().folder, foreign, unsigned(std::max(1.0, share)),
                                        [&] { run.tick(); }, [&] { return run.should_stop(); }}));
  }
  return all;
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
  fmt::print("climbing: {}; the worst are in worst/\n", climber.summary());
}

/// Related cases of every subject. Returns 0, 1 for broken promises, or InternalError's exit code.
int relate(Run& run, Clock::time_point until) {
  run.set_activity("relations");
  std::vector<const Relation*> all;
  for (const Relation& r : relations()) all.push_back(&r);
  RelationsRun related({run.settings().command, run.settings().folder, run.settings().queries, run.settings().subjects,
                        all, run.settings().seed, false});
  related.run(std::nullopt, until);
  related.write();
  run.note("relations", {{"file", "relations.json"},
                         {"pairs", related.pairs()},
                         {"broken", related.bad()},
                         {"contradictions", related.contradictions()},
                         {"oracle", related.contradicted()},
                         {"reports", related.reports()}});
  fmt::print("relations: {}\n", related.summary());
  return related.contradicted() > 0 ? InternalError::exit_code : related.bad() > 0 ? 1 : 0;
}

/// Runs the property tests with fresh seeds. True where one failed.
bool ask_properties(Run& run, Clock::time_point until) {
  Json note{{"state", "not built"}, {"seeds", Json::array()}, {"passed", 0}, {"failed", Json::array()}, {"ended", ""}};
  const std::optional<fs::path> program = find_property_tests();
  const double left = seconds_until(until);
  if (!program || left < 1) {
    note["state"] = program ? "no time" : "not built";
    run.note("properties", note);
    fmt::print("properties: {}\n", program ? "no time was left" : "not built");
    return false;
  }
  run.set_activity("properties");
  const PropertyOutcome o =
      run_property_tests(*program, {run.settings().folder, foreign_subjects(), run.settings().seed, left,
                                    [&] { run.tick(); }, [&] { return run.should_stop(); }});
  note = {{"state", "ran"}, {"seeds", o.seeds}, {"passed", o.passed}, {"failed", o.failed}, {"ended", o.ended}};
  run.note("properties", note);
  fmt::print("properties: {} with fresh seeds passed, {} failed{}{}\n", plural_text(o.passed, "test"), o.failed.size(),
             o.failed.empty() ? "" : ": see properties/", o.ended.empty() ? "" : fmt::format("; {}", o.ended));
  return !o.failed.empty() || !o.ended.empty();
}

class NightlyCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "nightly",
        "examine every subject for a given time: stored and generated cases, relations, properties, fuzzing",
        {"First the tiers of collide answer their stored worst cases (corpus/worst/), and every subject answers every "
         "stored case (seeds and regressions), and the findings are "
         "compared with the stored expectations. Then new cases are generated for all queries and subjects. A "
         "twelfth of the time goes to climbing towards the worst errors, as in 'nearmiss run --climb'. A "
         "sixth of the time goes to properties: half of it to relations between answers, as in 'nearmiss "
         "relations', and half to the property tests of this build, which ask the tiers of collide new cases "
         "with fresh seeds. In the last third of the time the fuzz targets run as separate processes, and "
         "their cases are judged and reported like all others. They ask the tiers of collide, plugins, "
         "commands, and the subjects of NEARMISS_ADD that they were built with. Where the fuzz targets are "
         "not built, the summary and the index say so, and the generated cases get their time. A target that "
         "ends with an error (for example of a sanitizer) makes the exit code 1, and so does a failed "
         "property.",
         "The run folder is that of 'nearmiss run --climb', with relations.json and relations/ of 'nearmiss "
         "relations', properties/ for messages and reports of property tests, corpus/QUERY/ for the corpus of "
         "the fuzz targets, and fuzz/ for their files and messages. Give the same folder every night to keep "
         "the corpus."},
        judging_exit_status(),
        {{"nearmiss nightly --minutes 60", "One hour."},
         {"nearmiss nightly --minutes 480 --out nights", "A night, with a corpus that grows from night to night."}}};
  }
  void declare(CLI::App& app) override {
    declare_foreign_subjects(app);
    add_positive_number(app, "-m,--minutes", minutes_, fmt::format("The total time. Default: {}", default_minutes), "M",
                        most_minutes);
    add_whole_number(app, "--seed", seed_, "The seed of the generator. Default: a random one, which is printed", 0,
                     std::numeric_limits<std::uint64_t>::max());
    add_output_folder(app, out_, "The run folder. Default: reports/runs/TIME-SEED of the source tree");
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
    const auto end = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const std::uint64_t seed = seed_or_random(seed_);
    const Selection all;
    foreign_subjects();  // refuses a bad name now rather than in the last third
    catch_interrupts();
    const FuzzTargets found =
        find_fuzz_targets(targets_.empty() ? std::nullopt : std::optional(fs::path(targets_)), all.queries());
    Run run({typed_command_line(), out_.empty() ? new_run_folder(seed) : fs::path(out_), all.queries(), all.subjects(),
             seed, end});
    fmt::print("seed {}, for {}, into {}\n{}\n", seed, duration_text(seconds), run.settings().folder.string(),
               targets_text(found));
    std::fflush(stdout);
    run.ask_worst_cases();
    replay_stored(run);
    const double later = (found.targets.empty() ? 0 : fuzzing_share);
    run.set_until(between(begin, end, 1 - later - properties_share - climbing_share));
    run.set_activity("generated cases");
    run.generate(std::nullopt);
    run.set_until(between(begin, end, 1 - later - properties_share));
    climb(run);
    run.set_until(end);
    const int related = relate(run, between(begin, end, 1 - later - properties_share / 2));
    bool failed = ask_properties(run, between(begin, end, 1 - later)) || related > 0;
    const std::string fuzzing = fuzz_all(run, found, end, failed);
    run.finish();
    fmt::print("\n{}\n{}{}{}; fuzzing: {}\n", run.counts().table(), run.counts().touches_text(),
               run.kept().worst_text(), run.summary(), fuzzing);
    if (const auto why = run.shortfall()) say_on_stderr(fmt::format("nearmiss: {}\n", *why));
    const int code = std::max(related, run.exit_code());
    return code == InternalError::exit_code || !failed ? code : 1;
  }

 private:
  static std::string targets_text(const FuzzTargets& found) {
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
  static std::string fuzz_all(Run& run, const FuzzTargets& found, Clock::time_point end, bool& failed) {
    Json note{{"state", "not built"}, {"where", found.where}, {"missing", found.missing}, {"targets", Json::array()}};
    if (found.targets.empty()) {
      run.note("fuzz", note);
      return "not built";
    }
    const Fuzzing all = run_targets(run, found.targets, between(Clock::now(), end, 1 - judging_share));
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

  std::optional<double> minutes_;
  std::optional<std::uint64_t> seed_;
  std::string out_, targets_;
};

}  // namespace

std::unique_ptr<Command> nightly_command() { return std::make_unique<NightlyCommand>(); }

}  // namespace nearmiss
