/// How a night shares its time between fuzz targets, keeps their corpora, and compares itself with earlier nights.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/storage/codec.hpp"
#include "reports/engine/fuzz_night.hpp"
#include "reports/engine/night_changes.hpp"
#include "reports/page/night_triage.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Waits for SIGUSR1, at which libFuzzer prints its statistics and leaves.
const char* const until_told =
    "until_told() { trap told=1 USR1; sleep 100 & while [ -z \"$told\" ]; do wait; done; kill $!; }\n";

/// A shell script in the place of a fuzz target.
BuiltTarget target(const TemporaryFolder& folder, const Query& query, const std::string& lines) {
  const fs::path file = folder.file("fuzz_" + std::string(query.name), std::string("#!/bin/sh\n") + until_told + lines);
  fs::permissions(file, fs::perms::owner_all);
  return {&fuzz_target_of(query), {&query}, file};
}

FuzzNight night_of(const TemporaryFolder& folder, unsigned jobs, std::chrono::milliseconds time) {
  FuzzNight night;
  night.run_folder = folder / "run";
  night.jobs = jobs;
  night.until = FuzzNight::Clock::now() + time;
  night.tick = [] {};
  night.cancelled = [] { return false; };
  night.activity = [](const std::string&) {};
  return night;
}

const FuzzOutcome* of(const FuzzNightOutcome& o, const Query& query) {
  const auto found =
      std::find_if(o.ran.begin(), o.ran.end(), [&](const FuzzOutcome& r) { return r.target == query.name; });
  return found == o.ran.end() ? nullptr : &*found;
}

const char* const some_executions =
    "until_told; echo 'stat::number_of_executed_units: 10'; echo 'stat::new_units_added: 0'\n";

TEST(FuzzNight, GivesEveryTargetATurn) {
  const TemporaryFolder folder;
  std::vector<BuiltTarget> targets;
  for (std::size_t i = 0; i < 6; ++i) targets.push_back(target(folder, catalogue()[i], some_executions));
  const FuzzNightOutcome o = fuzz_in_turns(targets, night_of(folder, 3, 4500ms));
  EXPECT_TRUE(o.no_time.empty()) << o.no_time.front();
  ASSERT_EQ(o.ran.size(), targets.size());
  for (const FuzzOutcome& r : o.ran) EXPECT_GE(r.executions, 10u) << r.target;
}

TEST(FuzzNight, NamesTheTargetsThatHadNoTurn) {
  const TemporaryFolder folder;
  std::vector<BuiltTarget> targets;
  for (std::size_t i = 0; i < 4; ++i) targets.push_back(target(folder, catalogue()[i], some_executions));
  const FuzzNightOutcome o = fuzz_in_turns(targets, night_of(folder, 1, 700ms));
  EXPECT_EQ(o.ran.size(), 1u);
  EXPECT_EQ(o.no_time.size(), 3u);
}

TEST(FuzzNight, GivesMoreTurnsToATargetThatFindsNewInputs) {
  const TemporaryFolder folder;
  const Query &rich = catalogue()[0], &poor = catalogue()[1];
  const std::string finds = "until_told; echo 'stat::number_of_executed_units: 10'; echo 'stat::new_units_added: 50'\n";
  const FuzzNightOutcome o =
      fuzz_in_turns({target(folder, poor, some_executions), target(folder, rich, finds)}, night_of(folder, 1, 9500ms));
  ASSERT_NE(of(o, rich), nullptr);
  ASSERT_NE(of(o, poor), nullptr);
  EXPECT_GT(of(o, rich)->seconds, of(o, poor)->seconds);
  EXPECT_EQ(of(o, rich)->new_inputs, 50 * of(o, rich)->turns);
}

TEST(FuzzNight, TellsTargetsTheirQueriesAndProfileAndPutsNoOtherSeeds) {
  const TemporaryFolder folder;
  const Query& query = catalogue()[0];
  const std::string asked = "," + std::string(query.name) + "\n";
  const std::string told =
      "echo \"$NEARMISS_PROFILE,$NEARMISS_QUERIES\" > \"$NEARMISS_FUZZ_REPORTS/told\"\n" + std::string(some_executions);
  FuzzNight night = night_of(folder, 1, 1500ms);
  night.profile = "profile.json";
  fuzz_in_turns({target(folder, query, told)}, night);
  EXPECT_EQ(read_file(folder / "run" / "fuzz" / "told"), fs::absolute("profile.json").string() + asked);
  EXPECT_TRUE(fs::is_empty(folder / "run" / "corpus" / query.name));
  night = night_of(folder, 1, 1500ms);
  fuzz_in_turns({target(folder, query, told)}, night);
  EXPECT_EQ(read_file(folder / "run" / "fuzz" / "told"), asked);
  EXPECT_FALSE(fs::is_empty(folder / "run" / "corpus" / query.name));
}

TEST(FuzzNight, StopsTurnsOfATargetThatFailsAgainAndAgain) {
  const TemporaryFolder folder;
  const FuzzNightOutcome o = fuzz_in_turns({target(folder, catalogue()[0], "exit 77\n")}, night_of(folder, 1, 60s));
  ASSERT_EQ(o.ran.size(), 1u);
  EXPECT_TRUE(o.ran.front().failed);
  EXPECT_EQ(o.ran.front().turns, 3u);
  EXPECT_TRUE(fs::exists(folder / "run" / "fuzz" / (o.ran.front().target + "-1.log")));
}

/// Imitates libFuzzer's merge: keeps every second input.
const char* const merges = R"(into= ; from=
for a in "$@"; do case $a in -*) ;; *) if [ -z "$into" ]; then into=$a; else from=$a; fi;; esac; done
i=0; for f in "$from"/*; do i=$((i + 1)); [ $((i % 2)) = 0 ] || cp "$f" "$into"; done
)";

std::size_t files_in(const fs::path& folder) {
  return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

fs::path corpus_of(const TemporaryFolder& folder, const Query& query, int inputs) {
  const fs::path corpus = folder / "run" / "corpus" / query.name;
  fs::create_directories(corpus);
  fs::create_directories(folder / "run" / "fuzz");
  for (int i = 0; i < inputs; ++i) write_file(corpus / std::to_string(i), "x");
  return corpus;
}

TEST(Corpora, AreMinimisedOnceTheyHaveDoubled) {
  const TemporaryFolder folder;
  const Query& query = catalogue()[0];
  const fs::path corpus = corpus_of(folder, query, 200);
  const std::vector<BuiltTarget> targets{target(folder, query, merges)};
  const MergeOutcome first = merge_corpora(targets, night_of(folder, 1, 20s));
  EXPECT_EQ(first.before, 200u);
  EXPECT_EQ(first.after, 100u);
  EXPECT_EQ(files_in(corpus), 100u);
  EXPECT_TRUE(merge_corpora(targets, night_of(folder, 1, 20s)).merged.empty());
  for (int i = 200; i < 300; ++i) write_file(corpus / std::to_string(i), "x");
  EXPECT_EQ(merge_corpora(targets, night_of(folder, 1, 20s)).after, 100u);
}

TEST(Corpora, StayAsTheyAreWithoutTimeOrWithAFailedMerge) {
  const TemporaryFolder folder;
  const Query& query = catalogue()[0];
  const fs::path corpus = corpus_of(folder, query, 200);
  EXPECT_TRUE(merge_corpora({target(folder, query, merges)}, night_of(folder, 1, 0ms)).merged.empty());
  EXPECT_TRUE(merge_corpora({target(folder, query, "sleep 60\n")}, night_of(folder, 1, 500ms)).merged.empty());
  EXPECT_TRUE(merge_corpora({target(folder, query, "exit 1\n")}, night_of(folder, 1, 20s)).merged.empty());
  EXPECT_EQ(files_in(corpus), 200u);
}

/// Every state in which a kill can leave the folders of a merge.
TEST(Corpora, SurviveAKillAtAnyMomentOfAMerge) {
  const Query& query = catalogue()[0];
  struct State {
    bool corpus, merging, merged, old;
    std::size_t left;
  };
  for (const State& s :
       {State{true, true, false, false, 5}, State{true, false, true, false, 5}, State{false, false, true, true, 3},
        State{true, false, false, true, 5}, State{false, false, false, true, 5}}) {
    const TemporaryFolder folder;
    const fs::path corpus = folder / "run" / "corpus" / query.name;
    const auto fill = [](const fs::path& f, int inputs) {
      fs::create_directories(f);
      for (int i = 0; i < inputs; ++i) write_file(f / std::to_string(i), "x");
    };
    if (s.corpus) fill(corpus, 5);
    if (s.merging) fill(corpus.string() + ".merging", 1);
    if (s.merged) fill(corpus.string() + ".merged", 3);
    if (s.old) fill(corpus.string() + ".old", 5);
    settle_corpora({{&fuzz_target_of(query), {&query}, {}}}, folder / "run");
    ASSERT_TRUE(fs::exists(corpus));
    EXPECT_EQ(files_in(corpus), s.left);
    EXPECT_FALSE(fs::exists(corpus.string() + ".old"));
    EXPECT_FALSE(fs::exists(corpus.string() + ".merged"));
  }
}

WrittenReport report(const std::string& subject, const std::string& disagreement, std::optional<double> above,
                     const std::string& file) {
  WrittenReport w{file, "id", "moving_sphere_box", subject, "violates contract", disagreement, "headline of " + file};
  w.above = above;
  return w;
}

std::vector<std::string> files_of(const NightChanges& changes, bool ours, Change change) {
  std::vector<std::string> files;
  for (const ChangedKind& k : changes.of(ours, change)) files.push_back(k.worst.file);
  return files;
}

using Files = std::vector<std::string>;

TEST(NightChanges, TellNewFromKnownWorseAndFixed) {
  const std::vector<WrittenReport> earlier{
      report("collide-fast-float", "false miss", 8, "a"), report("collide-fast-float", "wrong time", 8, "b"),
      report("collide-fast-float", "wrong normal", 8, "c"), report("collide-fast-float", "wrong place", 8, "d")};
  const std::vector<WrittenReport> tonight{report("collide-fast-float", "false miss", 8, "e"),
                                           report("collide-fast-float", "wrong time", 16, "f"),
                                           report("collide-fast-float", "false hit", std::nullopt, "g")};
  const NightChanges changes(earlier, tonight, {"c"});
  EXPECT_EQ(files_of(changes, true, Change::known), (Files{"e", "d"}));  // "d" was not asked again
  EXPECT_EQ(files_of(changes, true, Change::worse), Files{"f"});
  EXPECT_EQ(files_of(changes, true, Change::fresh), Files{"g"});
  EXPECT_EQ(files_of(changes, true, Change::fixed), Files{"c"});
  EXPECT_TRUE(changes.is_regression());
}

TEST(NightChanges, OfOtherLibrariesAreNoRegression) {
  const std::vector<WrittenReport> tonight{report("fcl", "false miss", 1024, "a"), report("ode", "broke", {}, "b")};
  const NightChanges changes({}, tonight, {});
  EXPECT_FALSE(changes.is_regression());
  EXPECT_EQ(files_of(changes, false, Change::fresh), (Files{"a", "b"}));
  EXPECT_TRUE(changes.text("run").starts_with("collide: 0 new, 0 worse, 0 known, 0 fixed\n")) << changes.text("run");
}

TEST(NightChanges, KnownFindingsAreNoRegression) {
  const std::vector<WrittenReport> same{report("collide-fast-double", "false miss", 8, "a")};
  EXPECT_FALSE(NightChanges(same, same, {"a"}).is_regression());
  EXPECT_TRUE(NightChanges({}, same, {}).is_regression());
}

TEST(NightChanges, ReportsOfFixedKindsMoveAside) {
  const TemporaryFolder folder;
  const std::vector<WrittenReport> earlier{report("fcl", "false miss", 8, "findings/q/a.json"),
                                           report("fcl", "wrong time", 8, "findings/q/b.json")};
  fs::create_directories(folder / "findings" / "q");
  for (const WrittenReport& w : earlier) write_file(folder / w.file, "{}");
  const NightChanges changes(earlier, {report("fcl", "wrong time", 8, "findings/q/c.json")},
                             {"findings/q/a.json", "findings/q/b.json"});
  put_aside_fixed(changes, earlier, folder.path());
  EXPECT_TRUE(fs::exists(folder / "fixed/q/a.json"));
  EXPECT_FALSE(fs::exists(folder / "findings/q/a.json"));
  EXPECT_TRUE(fs::exists(folder / "findings/q/b.json"));
}

/// The subject skim of docs/example-library has three mistakes.
TEST(Nightly, AnAddedLibrarysFindingsAreNewInTheFirstNightAndKnownInTheSecond) {
  const TemporaryFolder folder;
  const auto night = [&] {
    return nearmiss({"nightly", "--no-triage", "--minutes", "0.2", "--seed", "5", "--plugin",
                     plugin_file("skim_plugin"), "--fuzz-targets", folder.path().string(), "--out",
                     (folder / "r").string()});
  };
  const Ran first = night();
  EXPECT_EQ(first.exit_code, 1) << first.out << first.err;
  const auto kinds = [&](const char* change) {
    const auto index = nlohmann::json::parse(read_file(folder / "r/index.json"));
    return index.at("night").at("ours").at(change).size();
  };
  EXPECT_GT(kinds("new"), 0u) << first.out;
  EXPECT_EQ(kinds("known"), 0u);
  EXPECT_NE(first.out.find("\ncollide, skim: "), std::string::npos) << first.out;
  const Ran second = night();
  EXPECT_LE(second.exit_code, 1) << second.err;
  EXPECT_GT(kinds("known"), 0u) << second.out;
}

/// The planted plugin calls balls larger than they are.
TEST(Nightly, EndsWithATriageAgainstTheLastNightAndAPage) {
  ::setenv("NEARMISS_PLANTED", "R", 1);
  const TemporaryFolder folder;
  const auto night = [&] {
    return nearmiss({"nightly", "--minutes", "0.3", "--triage-minutes", "0.1", "--seed", "5", "--plugin",
                     plugin_file("planted"), "--fuzz-targets", folder.path().string(), "--out",
                     (folder / "r").string()});
  };
  const auto changes_of_planted = [&] {
    std::set<std::string> changes;
    const auto triage = nlohmann::json::parse(read_file(folder / "r/triage/triage.json"));
    for (const auto& s : triage.at("signatures")) {
      if (s.at("subject") == "planted") changes.insert(s.at("change"));
    }
    return changes;
  };
  const Ran first = night();
  EXPECT_EQ(first.exit_code, 1) << first.out << first.err;
  EXPECT_EQ(changes_of_planted(), std::set<std::string>{"new"}) << first.out;
  EXPECT_NE(first.out.find("no earlier night to compare with\n"), std::string::npos) << first.out;
  constexpr std::ptrdiff_t lines_of_a_screen = 60;
  EXPECT_LT(std::count(first.out.begin(), first.out.end(), '\n'), lines_of_a_screen) << first.out;
  const std::string tables = read_file(folder / "r/tables.txt");
  EXPECT_NE(tables.find("\nsphere_sphere_overlap\n"), std::string::npos) << tables;
  const Ran second = night();
  EXPECT_LE(second.exit_code, 1) << second.err;
  EXPECT_TRUE(changes_of_planted().contains("known")) << second.out;
  const auto index = nlohmann::json::parse(read_file(folder / "r/index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index.at("triage").at("compared"), true);
  EXPECT_GT(index.at("triage").at("ours").at("known"), 0) << second.out;
  EXPECT_EQ(fs::exists(folder / "r/index.html"), index.at("triage").at("page").is_string());
  ::unsetenv("NEARMISS_PLANTED");
}

TEST(Nightly, ComparesWithTheNewestRunThatHasATriage) {
  const TemporaryFolder runs;
  for (const char* name : {"20260101T000000Z-9", "20260102T000000Z-1", "20260103T000000Z-5"})
    fs::create_directories(runs / name / "triage");
  EXPECT_FALSE(last_triage(runs / "20260103T000000Z-5", runs.path()));
  for (const char* name : {"20260101T000000Z-9", "20260102T000000Z-1"})
    write_file(runs / name / "triage/triage.json", "{}");
  EXPECT_EQ(last_triage(runs / "20260103T000000Z-5", runs.path()), runs / "20260102T000000Z-1/triage/triage.json");
  EXPECT_EQ(last_triage(runs / "20260101T000000Z-9", std::nullopt), runs / "20260101T000000Z-9/triage/triage.json");
  EXPECT_FALSE(last_triage(runs / "20260103T000000Z-5", std::nullopt));
}

}  // namespace
}  // namespace nearmiss
