#include "reports/engine/night.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "corpus/scenes/scene_cases.hpp"
#include "corpus/storage/fuzz_target.hpp"
#include "corpus/storage/store.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/engine/fuzz_night.hpp"
#include "reports/engine/night_changes.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/property_tests.hpp"
#include "reports/engine/relations_run.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Clock = Run::Clock;

}  // namespace

Clock::time_point between(Clock::time_point a, Clock::time_point b, double share) {
  return a + std::chrono::duration_cast<Clock::duration>((b - a) * share);
}

void wait_for(const std::string& step, const std::string& what, Building& building, Run& run) {
  constexpr int patience = 200;  // milliseconds
  if (building.may_have(step)) run.set_activity(what);
  while (building.may_have(step) && !run.should_stop()) {
    building.poll(patience);
    run.tick();
  }
}

std::vector<const Subject*> plugins_and_commands() {
  const std::vector<std::string> built_in = built_in_subjects();
  std::vector<std::string> names = subject_names();
  std::erase_if(names, [&](const auto& n) { return std::find(built_in.begin(), built_in.end(), n) != built_in.end(); });
  return subjects_named(names);
}

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

class StoredCasesOfNight::Expectations : public Sink {
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

StoredCasesOfNight::StoredCasesOfNight() : expectations_(std::make_unique<Expectations>()) {}
StoredCasesOfNight::~StoredCasesOfNight() = default;
std::uint64_t StoredCasesOfNight::unexpected() const { return expectations_->of_ours; }

void StoredCasesOfNight::ask(Run& run, std::span<const Subject* const> subjects) {
  run.set_activity("stored cases");
  for (const Query* q : run.settings().queries) {
    for (const StoredCase& stored : stored_cases(*q)) {
      if (run.should_stop()) break;
      asked_.insert(stored.file);
      expectations_->about(stored);
      run.examine_by(subjects, stored.question, expectations_.get());
    }
  }
  run.note(
      "stored",
      {{"cases", asked_.size()}, {"expectations", expectations_->compared}, {"unexpected", expectations_->unexpected}});
}

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

void climb(Run& run) {
  Climber climber({run.settings().queries, run.settings().subjects, run.settings().seed});
  run.climb(climber);
  say("climbing: {}; the worst are in worst/\n", climber.summary());
}

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

bool ask_properties(Run& run, Clock::time_point until, const Building& building) {
  Json note{{"state", "not built"}, {"seeds", Json::array()}, {"passed", 0}, {"failed", Json::array()}, {"ended", ""}};
  const std::optional<fs::path> program = building.has("properties") ? find_property_tests() : std::nullopt;
  const double left = std::chrono::duration<double>(until - Clock::now()).count();
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

void put_seeds_of(const scenes::Scene& scene, const BuiltTargets& found, const Run& run) {
  constexpr std::uint64_t seeds_of_scalar = 64;
  for (const BuiltTarget& t : found.targets) {
    const fs::path corpus = run.settings().folder / "corpus" / t.target->name;
    make_folder(corpus);
    for (const Query* q : t.queries) {
      for (const Subject* s : run.settings().subjects) {
        if (s->offering(q->name).answer == nullptr) continue;
        for (std::uint64_t i = 0; i < seeds_of_scalar; ++i) {
          const auto bytes = t.target->bytes_of(scenes::draw_case(scene, *q, s->scalar, run.settings().seed, i));
          write_file(corpus / fmt::format("scene-{}-{}-{}", q->name, name_of(s->scalar), i),
                     {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        }
      }
    }
  }
}

namespace {

/// The share of the fuzzing time for judging the cases that it found.
constexpr double judging_share = 0.1;

Json outcome_json(const FuzzOutcome& o) {
  return {{"target", o.target},         {"seconds", o.seconds}, {"turns", o.turns},   {"executions", o.executions},
          {"new_inputs", o.new_inputs}, {"ended", o.ended},     {"failed", o.failed}, {"asked", o.asked}};
}

/// The results of the fuzz targets.
struct FuzzedTargets : FuzzNightOutcome {
  std::size_t failed() const {
    return std::size_t(std::count_if(ran.begin(), ran.end(), [](const FuzzOutcome& o) { return o.failed; }));
  }
  std::uint64_t executions() const {
    return std::accumulate(ran.begin(), ran.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const FuzzOutcome& o) { return sum + o.executions; });
  }
  static bool offers_a_query(const std::string& subject, const std::string& target) {
    const std::vector<const Query*>& all = find_fuzz_target(target)->queries;
    return std::any_of(all.begin(), all.end(), [&](const Query* q) {
      return find_subject(subject)->offering(q->name).offer != Offer::not_offered;
    });
  }
  /// Subjects of NEARMISS_ADD that a target should ask but does not know, because it was built without them.
  std::vector<std::string> unknown() const {
    std::set<std::string> names;
    for (const FuzzOutcome& o : ran) {
      for (const std::string& name : added_subjects()) {
        if (offers_a_query(name, o.target) && !o.asked.empty() &&
            std::find(o.asked.begin(), o.asked.end(), name) == o.asked.end())
          names.insert(name);
      }
    }
    return {names.begin(), names.end()};
  }
};

/// The case in a file that a fuzz target left: JSON, or an artifact of libFuzzer in its target's folder.
std::optional<Case> fuzzed_case(const fs::path& file) {
  if (file.extension() == ".json") return read_case_or_report(file);
  const FuzzTarget* target = find_fuzz_target(file.parent_path().filename().string());
  const std::string bytes = target == nullptr ? "" : read_file(file);
  std::optional<Case> c = bytes.empty()
                              ? std::nullopt
                              : target->case_of({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  if (c) c->origin = fmt::format("fuzz/{}/{}", target->name, file.filename().string());
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

}  // namespace

NightFuzzing fuzz_all(Run& run, const BuiltTargets& found, const std::string& profile, unsigned jobs,
                      Clock::time_point end) {
  Json note{{"state", "not built"}, {"where", found.where}, {"missing", found.missing}, {"targets", Json::array()}};
  if (found.targets.empty()) {
    run.note("fuzz", note);
    return {"not built", false};
  }
  const Clock::time_point now = Clock::now();
  FuzzNight night{run.settings().folder,
                  foreign_subjects(),
                  profile,
                  jobs,
                  between(now, end, merging_share),
                  [&] { run.tick(); },
                  [&] { return run.should_stop(); },
                  [&](const std::string& what) { run.set_activity(what); }};
  const MergeOutcome merged = merge_corpora(found.targets, night);
  night.until = between(now, end, 1 - judging_share);
  const FuzzedTargets all{fuzz_in_turns(found.targets, night)};
  note["merged"] = {{"targets", merged.merged}, {"before", merged.before}, {"after", merged.after}};
  for (const FuzzOutcome& o : all.ran) note["targets"].push_back(outcome_json(o));
  note["no_time"] = all.no_time;
  note["state"] = all.ran.empty() ? "no time" : "ran";
  if (!all.ran.empty()) note["left"] = examine_fuzzed(run);
  run.note("fuzz", note);
  if (all.ran.empty()) return {"no time was left", false};
  const std::vector<std::string> unknown = all.unknown();
  const std::string text = fmt::format(
      "{} of {} targets, {}, {}{}{}", all.ran.size(), found.targets.size() + found.missing.size(),
      plural_text(all.executions(), "execution"), plural_text(note["left"]["files"].get<std::uint64_t>(), "case file"),
      all.failed() > 0 ? fmt::format(", {} ended with an error, see fuzz/*.log", all.failed()) : "",
      unknown.empty() ? "" : fmt::format(", built without {}", list_text(unknown)));
  return {text, all.failed() > 0};
}

}  // namespace nearmiss
