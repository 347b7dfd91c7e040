/// The commands behave as their manuals describe.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "corpus/files/files.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/fuzz_target.hpp"
#include "corpus/storage/store.hpp"
#include "impl/subject/subject.hpp"
#include "reports/engine/answer_sample.hpp"
#include "reports/engine/properties.hpp"
#include "reports/engine/property_tests.hpp"
#include "reports/engine/tally.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json index_of(const fs::path& run) { return json::parse(read_file(run / "index.json")); }

/// A subject and a query for which violations are easy to find.
bool has_fcl() { return find_subject("fcl") != nullptr; }

TEST(List, PrintsTheAgreedJson) {
  const Ran ran = nearmiss({"list", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json queries = json::parse(ran.out).at("queries");
  ASSERT_EQ(queries.size(), catalogue().size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Query& q = catalogue()[i];
    const json& j = queries[i];
    EXPECT_EQ(j.at("query"), q.name);
    EXPECT_EQ(j.at("kind"), name_of(q.kind));
    EXPECT_EQ(j.at("fuzz_target"), "fuzz_" + std::string(fuzz_target_of(q).name));
    EXPECT_EQ(j.at("seeds"), count_seeds(q));
    EXPECT_FALSE(j.at("properties").empty());
    ASSERT_EQ(j.at("subjects").size(), subjects().size());
    for (const Subject& s : subjects()) {
      EXPECT_EQ(j.at("subjects").at(s.name), name_of(s.offering(q.name).offer));
      EXPECT_EQ(j.at("referees").contains(s.name), s.referee);
      EXPECT_TRUE(!s.own || s.offering(q.name).offer == Offer::not_offered || j.at("contracts").contains(s.name))
          << s.name;
    }
  }
}

TEST(List, ShowsEveryQueryAndSubject) {
  const Ran table = nearmiss({"list"}), why = nearmiss({"list", "--why"});
  for (const Query& q : catalogue()) {
    EXPECT_NE(table.out.find(q.name), std::string::npos);
    EXPECT_NE(why.out.find(q.name), std::string::npos);
  }
  for (const Subject& s : subjects()) EXPECT_NE(table.out.find(s.name), std::string::npos);
  EXPECT_NE(why.out.find("not offered"), std::string::npos);
}

TEST(List, ShowsOnlyWhatIsChosen) {
  const std::vector<std::string> chosen{"list", "-s", "collide-fast-double", "-q", "sphere_box_overlap"};
  const auto with = [&](const char* option) {
    std::vector<std::string> words = chosen;
    if (*option != '\0') words.emplace_back(option);
    return nearmiss(words);
  };
  for (const char* option : {"", "--why", "--pairs"}) {
    const Ran ran = with(option);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.out.find("collide-fast-double"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.out.find("collide-fast-float"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.out.find("sphere_sphere_overlap"), std::string::npos) << ran.out;
  }
  const json listed = json::parse(with("--json").out).at("queries");
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(listed[0].at("subjects").size(), 1u);
  EXPECT_EQ(nearmiss({"list", "-q", "sphere_box_overlap", "--names", "queries"}).out, "sphere_box_overlap\n");
  EXPECT_EQ(nearmiss({"list", "-q", "sphere_box"}).exit_code, 2);
}

TEST(List, PairsShowsWhoAnswersWhatAboutTwoShapes) {
  const Ran pairs = nearmiss({"list", "--pairs"});
  ASSERT_EQ(pairs.exit_code, 0) << pairs.err;
  const auto table_of = [&](const std::string& title) {
    const std::size_t at = pairs.out.find(title + ":\n");
    EXPECT_NE(at, std::string::npos) << pairs.out;
    return pairs.out.substr(at, pairs.out.find("\n\n", at) - at);
  };
  const auto row_of = [](const std::string& table, const std::string& shape) {
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(shape + " ")) return line;
    }
    return std::string();
  };
  const std::string overlaps = table_of("whether two shapes overlap");
  for (const char* shape : {"point", "sphere", "segment", "capsule", "triangle", "box"}) {
    EXPECT_NE(row_of(overlaps, shape).find(" A-"), std::string::npos) << shape << overlaps;  // the tiers of collide
  }
  // A cell for each column: a point is asked about no segment.
  const std::string columns = overlaps.substr(overlaps.find('\n') + 1, overlaps.find('\n', overlaps.find('\n') + 1));
  EXPECT_EQ(row_of(overlaps, "point").compare(columns.find("segment"), 3, "   "), 0) << overlaps;
  EXPECT_NE(row_of(table_of("when the first shape, moving, meets the second"), "sphere").find(" A-"),
            std::string::npos);
  if (subjects().size() != 18) return;  // README.md shows the table of a build with all libraries
  const std::string readme = read_file(source_folder() + "/README.md");
  for (const std::string& table : {overlaps, table_of("how far two shapes are apart, or how deep they overlap")})
    EXPECT_NE(readme.find(table.substr(table.find('\n') + 1)), std::string::npos) << table;
}

/// "SUITE.TEST" for each test of properties/ that runs for the query.
std::map<std::string, std::set<std::string>> tests_by_query() {
  const Ran ran = run_program(properties_program(), {"--gtest_list_tests", "--gtest_filter=*"});
  std::map<std::string, std::set<std::string>> tests;
  std::istringstream lines(ran.out);
  std::string suite;
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find("  #"));
    if (!line.starts_with("  ")) {
      suite = line.substr(line.find('/') + 1);  // "Every/Codec."
      continue;
    }
    const std::size_t slash = line.find('/');
    if (slash == std::string::npos) continue;
    const std::string test = line.substr(2, slash - 2), parameter = line.substr(slash + 1);
    for (const Query& q : catalogue()) {
      const std::string name(q.name);
      if (parameter == name || parameter.starts_with(name + "__")) tests[name].insert(suite + test);
    }
  }
  return tests;
}

/// Independent derivations exist for some queries only, so they are not in the list.
bool written_by_query(const std::string& test) {
  return test.starts_with("OracleOnLattice.") || test.starts_with("Watch.");
}

TEST(List, NamesThePropertiesThatRunForEveryQuery) {
  const auto tests = tests_by_query();
  ASSERT_EQ(tests.size(), catalogue().size());
  std::set<std::string> everywhere = tests.begin()->second;
  for (const auto& of_query : tests) {
    const std::set<std::string>& own = of_query.second;
    std::erase_if(everywhere, [&](const std::string& t) { return !own.contains(t) || written_by_query(t); });
  }
  for (const Query& q : catalogue()) {
    const std::vector<std::string> listed = properties_of(q);
    EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()), everywhere)
        << "cmake/PerQueryTests.cmake lists other tests than the program has";
  }
}

TEST(Run, IsTheSameForTheSameSeed) {
  const TemporaryFolder folder;
  std::vector<json> tallies;
  for (const char* name : {"a", "b"}) {
    const Ran ran = nearmiss({"run", "--cases", "120", "--seed", "7", "--out", (folder / name).string()});
    ASSERT_NE(ran.exit_code, 2) << ran.err;
    tallies.push_back(index_of(folder / name).at("tallies"));
  }
  EXPECT_EQ(tallies[0], tallies[1]);
}

std::uint64_t worst_cases_of(const std::string& query, const std::string& subject) {
  const std::vector<WorstCase> all = worst_cases(*find_query(query));
  return std::uint64_t(std::count_if(all.begin(), all.end(), [&](const WorstCase& w) { return w.subject == subject; }));
}

TEST(Run, WritesAValidIndexThatCountsEveryAnswer) {
  const TemporaryFolder folder;
  const Ran ran =
      nearmiss({"run", "--cases", "300", "--seed", "18446744073709551615", "--out", (folder / "r").string()});
  ASSERT_NE(ran.exit_code, 2) << ran.err;
  const json index = index_of(folder / "r");
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index["state"], "finished");
  EXPECT_EQ(index["seed"], 18446744073709551615u);
  EXPECT_EQ(index["tallies"].size() + index["not_offered"].size(), catalogue().size() * subjects().size());
  for (const json& t : index["tallies"]) {
    const std::uint64_t cases = 300 + worst_cases_of(t["query"], t["subject"]);  // those are asked first
    EXPECT_EQ(t["cases"], cases);
    std::uint64_t sum = 0;
    for (const auto& v : t["verdicts"].items()) sum += v.value().get<std::uint64_t>();
    EXPECT_EQ(sum, cases);
  }
  EXPECT_EQ(index["stages"].size(), catalogue().size());
  std::uint64_t exact = 0;
  for (const json& stages : index["stages"]) {
    std::uint64_t interval_of_subjects = 0, exact_of_subjects = 0;
    for (const json& t : index["tallies"]) {
      if (t["query"] != stages["query"]) continue;
      interval_of_subjects += t["decided_by"]["interval"].get<std::uint64_t>();
      exact_of_subjects += t["decided_by"]["exact"].get<std::uint64_t>();
    }
    EXPECT_EQ(stages["interval"], interval_of_subjects);
    EXPECT_EQ(stages["exact"], exact_of_subjects);
    exact += exact_of_subjects;
  }
  EXPECT_GT(exact, 0u);
  EXPECT_NE(ran.out.find("The exact stage decided"), std::string::npos);
  EXPECT_EQ(index["summary"].get<std::string>().substr(0, 10), last_line(ran.out).substr(0, 10));
}

TEST(Run, JudgesASampleOfASubjectThatIsOftenWrong) {
  const TemporaryFolder folder;
  const std::uint64_t cases = AnswerSample::judged_at_first + 16 * AnswerSample::one_in;
  const auto tally_with = [&](const char* name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",     "--plugin", plugin_file("planted"),   "-s",
                                       "planted", "--cases",  fmt::format("{}", cases), "--seed",
                                       "1",       "--out",    (folder / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = nearmiss(arguments, {"NEARMISS_PLANTED=w"});
    EXPECT_EQ(ran.exit_code, 1) << ran.err;
    EXPECT_EQ(ran.out.find("only a sample was judged") == std::string::npos, !more.empty()) << ran.out;
    const json index = index_of(folder / name);
    EXPECT_EQ(complaints(index, "run.schema.json"), "");
    return json(index.at("tallies").at(0));
  };
  const json sampled = tally_with("sampled", {}), every = tally_with("every", {"--every-answer"});
  EXPECT_EQ(sampled.at("not_judged"), 15 * AnswerSample::one_in) << sampled;
  EXPECT_EQ(sampled.at("cases"), cases - 15 * AnswerSample::one_in);
  EXPECT_EQ(every.at("not_judged"), 0);
  EXPECT_EQ(every.at("cases"), cases);
}

TEST(Run, TakesOnlyWhatWasChosen) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"run", "-s", "collide-fast-double", "-q", "box_box_overlap", "-q", "bounce_direction",
                            "--seed", "1", "-n", "100", "--out", (folder / "r").string()});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  EXPECT_EQ(index_of(folder / "r")["tallies"].size(), 2u);
}

TEST(Run, StopsWhenTheTimeIsOver) {
  const TemporaryFolder folder;
  const Ran ran =
      nearmiss({"run", "-s", "collide-fast-double", "--seconds", "4", "--seed", "1", "--out", (folder / "r").string()});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  const json index = index_of(folder / "r");
  for (const json& t : index["tallies"]) EXPECT_GT(t["cases"], 0) << t["query"] << ": every query gets its turn";
}

TEST(Run, PutsNewFoldersBelowTheNamedOne) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"run", "-s", "collide-fast-double", "-n", "10", "--seed", "5"},
                           {"NEARMISS_RUNS=" + (folder / "runs").string()});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  std::vector<fs::path> made;
  for (const auto& e : fs::directory_iterator(folder / "runs")) made.push_back(e.path());
  ASSERT_EQ(made.size(), 1u);
  EXPECT_TRUE(made[0].string().ends_with("Z-5")) << made[0];
}

/// Starts a long run, interrupts it once its first index exists, and waits for its end.
TEST(Run, StopsCleanlyWhenInterrupted) {
  const TemporaryFolder folder;
  const std::string out = (folder / "r").string();
  const std::string script = "'" + nearmiss_program() + "' run -s collide-fast-double --seconds 100 --out '" + out +
                             "' & run=$!; " + "while [ ! -e '" + out + "/index.json' ]; do sleep 0.05; done; " +
                             "kill -TERM $run; wait $run";
  const Ran ran = run_program("bash", {"-c", script});
  EXPECT_EQ(ran.exit_code, 2) << ran.out << ran.err;
  const json index = index_of(folder / "r");
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index["state"], "interrupted");
  EXPECT_TRUE(last_line(ran.out).starts_with("interrupted: ")) << ran.out;
  EXPECT_TRUE(ran.err.starts_with("nearmiss: interrupted after ")) << ran.err;
  EXPECT_NE(ran.err.find(out + "/index.json\n"), std::string::npos) << ran.err;
}

TEST(Run, LeavesAFolderToTheRunThatHasIt) {
  const TemporaryFolder folder;
  const std::string out = (folder / "r").string();
  const std::string program = "'" + nearmiss_program() + "' run -s collide-fast-double --out '" + out + "'";
  const std::string script = program + " --seconds 100 >/dev/null 2>&1 & run=$!; while [ ! -e '" + out +
                             "/index.json' ]; do sleep 0.05; done; " + program + " -n 1; code=$?; kill -KILL $run; " +
                             "wait $run; sleep 0.2; " + program + " -n 1 >/dev/null; echo $code $?";
  const Ran ran = run_program("bash", {"-c", script});
  EXPECT_EQ(ran.out, "2 0\n") << "the second while the first runs, and one after it was killed";
  EXPECT_TRUE(ran.err.starts_with("nearmiss: " + out + ": another run writes there")) << ran.err;
  EXPECT_EQ(index_of(folder / "r")["state"], "finished");
}

/// Runs fcl into `folder` with a limit on the size of files in KiB.
Ran run_with_small_files(const fs::path& folder, const std::string& kibibytes, const std::string& options) {
  return run_program("bash", {"-c", "ulimit -S -f " + kibibytes + "; exec '" + nearmiss_program() +
                                        "' run -s fcl --seed 1 " + options + " --out '" + folder.string() + "'"});
}

TEST(Run, SaysWhatCouldNotBeWrittenAndLeavesAnIndexThatDoesToo) {
  if (!has_fcl()) GTEST_SKIP() << "FCL is not part of this build";
  const TemporaryFolder folder;
  const Ran none = run_with_small_files(folder / "none", "1", "-q moving_sphere_box");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err, "nearmiss: " + (folder / "none/index.json").string() + ": cannot be written: File too large\n");
  EXPECT_TRUE(fs::is_empty(folder / "none")) << "a part of an index was left";

  const Ran one = run_with_small_files(folder / "one", "4", "-q moving_sphere_box");
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_EQ(std::count(one.err.begin(), one.err.end(), '\n'), 1) << one.err;
  for (const char* part : {"/findings/moving_sphere_box/fcl-", "File too large; the run ends after ",
                           " answers, violations: ", " wrong time"}) {
    EXPECT_NE(one.err.find(part), std::string::npos) << one.err;
  }
  json index = index_of(folder / "one");
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index["state"], "failed");
  EXPECT_GT(index["cases"], 0) << "the index could be written once more";

  const Ran many = run_with_small_files(folder / "many", "40", "-n 500");  // the index itself becomes too large
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_NE(many.err.find("/index.json: cannot be written: File too large; "), std::string::npos) << many.err;
  index = index_of(folder / "many");
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index["state"], "failed");
}

TEST(Run, GoesOnWithoutAReaderOfItsOutput) {
  const TemporaryFolder folder;
  const std::string command = "'" + nearmiss_program() + "' run -s collide-fast-double -n 200 --out '" +
                              (folder / "r").string() + "' | true; echo ${PIPESTATUS[0]}";
  const Ran ran = run_program("bash", {"-c", command});
  EXPECT_EQ(ran.out, "141\n") << "ended by SIGPIPE, but not before its work was done";
  EXPECT_EQ(ran.err, "");
  EXPECT_EQ(index_of(folder / "r")["state"], "finished");
}

/// Runs in a process namespace, so that a command that kills other processes cannot kill those outside.
TEST(Run, EndsNobodyElseWhereNoWorkerCanBeStarted) {
  const std::vector<std::string> apart{"--user", "--map-root-user", "--pid", "--fork"};
  std::vector<std::string> arguments = apart;
  arguments.insert(arguments.end(), {"sh", "-c", "echo $$"});
  if (run_program("unshare", arguments).out != "1\n") GTEST_SKIP() << "this machine allows no such space";
  if (is_sanitized) GTEST_SKIP() << "a sanitizer needs files of its own and ends the program";
  const TemporaryFolder folder;
  bool refused = false;
  for (const char* files : {"4", "5", "6", "7", "8", "9", "10", "11"}) {
    const fs::path out = folder / files;
    const std::string run = std::string("ulimit -n ") + files + "; exec '" + nearmiss_program() +
                            "' run -n 20 -q box_box_overlap " + "-s collide-fast-double -s collide-fast-float --out '" +
                            out.string() + "'";
    arguments = apart;
    arguments.insert(arguments.end(), {"bash", "-c",
                                       "sleep 60 & other=$!; (" + run + ") > '" + (folder / "log").string() +
                                           "' 2>&1; echo $?; kill $other && echo alive"});
    const Ran ran = run_program("unshare", arguments);
    if (ran.out == "127\nalive\n") continue;  // too few to load the program itself
    EXPECT_TRUE(ran.out == "2\nalive\n" || ran.out == "0\nalive\n") << files << " files: " << ran.out << ran.err;
    refused = refused || ran.out.starts_with("2");
    if (fs::exists(out / "index.json") && ran.out.starts_with("2")) {
      EXPECT_EQ(index_of(out)["state"], "failed");
    }
  }
  EXPECT_TRUE(refused);
}

TEST(Run, SaysThatNothingWasAsked) {
  const TemporaryFolder folder;
  const Ran run = nearmiss({"run", "--seconds", "1e-9", "--out", (folder / "r").string()});
  const Ran night = nearmiss({"nightly", "--no-triage", "--minutes", "1e-9", "--out", (folder / "n").string()});
  for (const Ran& ran : {run, night}) {
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_TRUE(ran.err.starts_with("nearmiss: nothing was asked: ")) << ran.err;
    EXPECT_EQ(ran.out.find("nothing violated"), std::string::npos) << ran.out;
  }
  EXPECT_NE(index_of(folder / "n")["summary"].get<std::string>().find("nothing asked"), std::string::npos);
}

TEST(Run, TakesAFolderWhoseNameIsNoUtf8) {
  const TemporaryFolder folder;
  const fs::path out = folder / "r\xff\x1b";
  const Ran ran =
      nearmiss({"run", "-s", "collide-fast-double", "-q", "box_box_overlap", "-n", "10", "--out", out.string()});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(complaints(index_of(out), "run.schema.json"), "");
}

/// FCL's distance of boxes aborts at several lines.
TEST(Run, CountsAndKeepsBreakagesByReason) {
  if (!has_fcl()) GTEST_SKIP() << "FCL is not part of this build";
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"run", "-s", "fcl-distance-indep", "-q", "box_box_penetration", "-n", "4000", "--seed", "1",
                            "--out", (folder / "r").string()});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json index = index_of(folder / "r"), tally = index["tallies"][0];
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  ASSERT_GT(tally["breakages"].size(), 1u) << tally;
  std::uint64_t broke = 0;
  for (const auto& [reason, count] : tally["breakages"].items()) {
    broke += count.get<std::uint64_t>();
    const auto kept = std::count_if(index["reports"].begin(), index["reports"].end(),
                                    [&](const json& r) { return r["breakage"] == reason; });
    std::uint64_t in_variants = 0, kept_in_variants = 0;
    for (const json& v : index["variants"]) {
      if (v["clause"] != reason) continue;
      in_variants += v["findings"].get<std::uint64_t>(), kept_in_variants += v["kept"].get<std::uint64_t>();
      EXPECT_EQ(v["kept"], std::min(v["findings"].get<std::uint64_t>(), FindingRetention::first_few)) << v;
    }
    EXPECT_EQ(in_variants, count) << reason;
    EXPECT_EQ(kept_in_variants, std::uint64_t(kept)) << reason;
    EXPECT_GT(kept, 0) << reason;
    EXPECT_NE(ran.out.find(reason), std::string::npos) << ran.out;
    EXPECT_NE(reason.find(" at distance-inl.h:"), std::string::npos);
  }
  EXPECT_EQ(tally["verdicts"]["broke"], broke);
  EXPECT_NE(last_line(ran.out).find(std::to_string(tally["breakages"].size()) + " kinds"), std::string::npos)
      << ran.out;
}

TEST(Run, ReportsTheTunnellingOfFcl) {
  if (!has_fcl()) GTEST_SKIP() << "FCL is not part of this build";
  const TemporaryFolder folder;
  const Ran ran = nearmiss(
      {"run", "-s", "fcl", "-q", "moving_sphere_box", "-n", "1500", "--seed", "1", "--out", (folder / "r").string()});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json index = index_of(folder / "r");
  ASSERT_GT(index["tallies"][0]["disagreements"]["false miss"]["violations"], 0);
  std::set<std::string> files;
  for (const json& listed : index["reports"]) {
    const fs::path file = folder / "r" / listed["file"].get<std::string>();
    const json report = json::parse(read_file(file));
    EXPECT_EQ(complaints(report, "report.schema.json"), "") << file;
    EXPECT_EQ(report["id"], listed["id"]);
    EXPECT_EQ(report["finding"]["verdict"], "violates contract");
    files.insert(file.filename().string());
    const Ran again = nearmiss({"replay", "-s", "fcl", file.string(), "--json"});
    EXPECT_EQ(again.exit_code, 1);
    const json replayed = json::parse(again.out);
    ASSERT_EQ(replayed.size(), 1u);
    EXPECT_EQ(replayed[0]["id"], report["id"]);
    EXPECT_EQ(replayed[0]["finding"], report["finding"]);
  }
  for (const auto& f : fs::directory_iterator(folder / "r" / "findings" / "moving_sphere_box")) {
    EXPECT_TRUE(files.contains(f.path().filename().string())) << f.path();
  }
}

TEST(Run, MeasuresThoseThatPromiseNothing) {
  if (find_subject("bullet") == nullptr) GTEST_SKIP() << "Bullet is not part of this build";
  const TemporaryFolder folder;
  std::vector<std::string> arguments{
      "run", "-s",     "bullet", "-q",    "moving_point_capsule", "-q", "moving_point_box", "-n",
      "300", "--seed", "1",      "--out", (folder / "r").string()};
  const Ran own = nearmiss(arguments);
  EXPECT_EQ(own.exit_code, 1) << own.out << own.err;
  EXPECT_NE(own.out.find("\nmeasure 0.0001: subjects that promise nothing are counted"), std::string::npos) << own.out;
  const json usual = index_of(folder / "r");
  arguments.insert(arguments.end(), {"--measure", "1e-6", "--by-class"});
  const Ran measured = nearmiss(arguments);
  EXPECT_EQ(measured.exit_code, 1) << measured.err;
  EXPECT_NE(measured.out.find("\nall queries\n"), std::string::npos) << measured.out;
  EXPECT_NE(measured.out.find("  small-lattice "), std::string::npos) << measured.out;
  const json index = index_of(folder / "r");
  std::uint64_t bad = 0;
  for (std::size_t i = 0; i < index["tallies"].size(); ++i) {
    const auto beyond = [i](const json& j) {
      return j["tallies"][i]["verdicts"]["differs by more than the measure"].get<std::uint64_t>();
    };
    EXPECT_GE(beyond(index), beyond(usual)) << "a smaller measure";
    EXPECT_EQ(index["tallies"][i]["verdicts"]["violates contract"], 0);
    bad += beyond(index);
  }
  EXPECT_GT(bad, 0u);
  for (const json& listed : index["reports"]) {  // a replay uses the measure of the report
    const Ran again = nearmiss({"replay", "-s", "bullet", (folder / "r" / listed["file"].get<std::string>()).string()});
    EXPECT_EQ(again.exit_code, 1) << again.out;
    EXPECT_EQ(again.out.find("out of domain"), std::string::npos) << again.out;
    break;
  }
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  std::uint64_t bad_scenes = 0;
  for (const json& c : index["by_class"]) {
    if (c["class"] != "none") continue;
    EXPECT_EQ(c["subject"], "bullet");
    EXPECT_GT(c["cases"], 200) << "about half of 600";
    bad_scenes = c["false_hits"].get<std::uint64_t>() + c["false_misses"].get<std::uint64_t>() +
                 c["wrong"].get<std::uint64_t>() + c["broke"].get<std::uint64_t>();
  }
  EXPECT_GT(bad_scenes, 0u);
  EXPECT_LE(bad_scenes, bad);
}

/// The tolerance of libccd is a length: it reports two small overlapping balls as apart, but not after scaling up.
TEST(Report, AsksRefereesAtUnitScaleToo) {
  if (find_subject("libccd-gjk") == nullptr) GTEST_SKIP() << "libccd is not part of this build";
  const TemporaryFolder folder;
  const fs::path file = folder / "case.json";
  write_file(file, R"({"query": "sphere_sphere_overlap", "scalar": "double", "inputs": {
    "sphere1": {"center": [-4.76837158203125e-07, 1.5735626220703125e-05, -2.0503997802734375e-05],
                "radius": 1.3589859008789062e-05},
    "sphere2": {"center": [-2.0265579223632812e-05, 1.3828277587890625e-05, 3.0994415283203125e-06],
                "radius": 1.5020370483398438e-05}}})");
  const Ran ran = nearmiss({"replay", "--json", "-s", "collide-fast-double", file.string()});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json report = json::parse(ran.out).at(0);
  EXPECT_EQ(complaints(report, "report.schema.json"), "");
  std::set<std::string> names;
  for (const json& r : report["referees"]) {
    names.insert(r["name"].get<std::string>());
    if (r["name"] == "libccd-gjk") {
      EXPECT_EQ(r["agrees_on_decision"], false);
    }
    if (r["name"] == "libccd-gjk at unit scale") {
      EXPECT_EQ(r["agrees_on_decision"], true);
    }
  }
  EXPECT_TRUE(names.contains("libccd-gjk") && names.contains("libccd-gjk at unit scale")) << report["referees"];
}

TEST(Run, TellsProgressOnStandardErrorOnly) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"run", "-s", "collide-fast-double", "-n", "200", "--out", (folder / "r").string()});
  EXPECT_EQ(ran.out.find('\r'), std::string::npos);
  EXPECT_EQ(ran.err, "") << "short work says nothing";
}

TEST(Replay, ShowsInputsTruthAndEverySubject) {
  const StoredCase seed = stored_cases(*find_query("moving_sphere_box")).front();
  const Ran ran = nearmiss({"replay", seed.file.string()});
  EXPECT_NE(ran.exit_code, 2) << ran.err;
  for (const char* part : {"moving_sphere_box", "Inputs", "sphere.center", "Truth: ", "SUBJECT", "VERDICT"}) {
    EXPECT_NE(ran.out.find(part), std::string::npos) << ran.out;
  }
  for (const Subject& s : subjects()) EXPECT_NE(ran.out.find(s.name), std::string::npos) << ran.out;
}

/// Two libraries that define the same symbols: each computes in its own scalar in one run.
/// The case of a public report: decimals, a quaternion as an array, the values in a row.
TEST(Replay, TakesDecimalsForTheNearestNumbersAndSaysHowMany) {
  const TemporaryFolder folder;
  const std::string members =
      folder.file("members.json", R"({"query": "moving_point_box", "scalar": "float", "inputs": {
      "point": [-0.187414, 2.5, 0], "velocity": [0, -1, 0],
      "box": {"center": [0, 0, 0], "half": [0.3, 1, 1], "orientation": [0, 0, 0, 1]}}})");
  const std::string values = folder.file("values.json", R"({"query": "moving_point_box", "scalar": "float",
      "values": [-0.187414, 2.5, 0, 0, -1, 0, 0, 0, 0, 0.3, 1, 1, 0, 0, 0, 1]})");
  const Ran both = nearmiss({"replay", "-s", "collide-certified-float", members, values});
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(
      both.err,
      "nearmiss: note: 4 decimals of case files are no floats, and were read as the nearest ones, at most 1.2e-08 "
      "away; --exact refuses them\n");
  const Ran one = nearmiss({"replay", "-s", "collide-certified-float", values}),
            other = nearmiss({"replay", "-s", "collide-certified-float", members});
  EXPECT_EQ(one.out.substr(values.size()), other.out.substr(members.size()));
  for (const std::string& file : {members, values}) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"replay", "--exact", file},
          {"minimise", "--exact", file},
          {"explain", "--exact", file},
          {"show", "--exact", file},
          {"promote", "--exact", "--note", "A case that is no float.", "-s", "collide-fast-float", file},
          {"emit-test", "--exact", "--for", "collide-fast-float", file}}) {
      const Ran exact = nearmiss(command);
      EXPECT_EQ(exact.exit_code, 2) << command[0] << exact.out;
      EXPECT_NE(exact.err.find("exactly a float"), std::string::npos) << exact.err;
    }
  }
}

TEST(Replay, AsksBothBuildsOfBullet) {
  if (find_subject("bullet") == nullptr || find_subject("bullet-float") == nullptr) {
    GTEST_SKIP() << "one of the two is not part of this build";
  }
  const TemporaryFolder folder;
  const std::string file =
      folder.file("case.json", R"({"query": "sphere_sphere_penetration", "scalar": "float", "inputs":
    {"sphere1": {"center": [0, 0, 0], "radius": 1}, "sphere2": {"center": [1, 0.5, 0.25], "radius": 1}}})");
  const Ran ran = nearmiss({"replay", "--json", "-s", "bullet", "-s", "bullet-float", file});
  ASSERT_LE(ran.exit_code, 1) << ran.err;
  const json reports = json::parse(ran.out);
  ASSERT_EQ(reports.size(), 2u);
  for (const json& r : reports) {
    const bool in_float = r["subject"]["name"] == "bullet-float";
    EXPECT_EQ(r["subject"]["scalar"], in_float ? "float" : "double");
    ASSERT_EQ(r["answer"]["status"], "answered") << r["answer"];
    const double depth = r["answer"]["values"]["depth"].get<double>();
    EXPECT_NEAR(depth, 2 - std::sqrt(1.3125), 1e-6);
    EXPECT_EQ(double(float(depth)) == depth, in_float) << "the root of 1.3125 is neither a float nor a double";
  }
}

TEST(Replay, JudgesEveryStoredCase) {
  std::vector<std::string> arguments{"replay", "--json"};  // of all queries at once: each host is started once
  for (const Query& q : catalogue()) {
    for (const StoredCase& s : stored_cases(q)) arguments.push_back(s.file.string());
  }
  const Ran ran = nearmiss(arguments);
  ASSERT_NE(ran.exit_code, 2) << ran.err;
  const json reports = json::parse(ran.out);
  EXPECT_GT(reports.size(), arguments.size());
  for (const json& report : reports) EXPECT_EQ(complaints(report, "report.schema.json"), "");
}

/// A report of schema version 1 can be replayed: only its case is read.
TEST(Replay, ReadsAReportOfTheFirstVersion) {
  const TemporaryFolder folder;
  const std::string report = folder.file("report.json", R"({
    "schema": 1, "id": "0123456789ab", "headline": "old", "explanation": "old", "kind": "decision",
    "query": "sphere_sphere_overlap", "scalar": "double",
    "inputs": {"sphere1": {"center": [0, 0, 0], "radius": 1}, "sphere2": {"center": [3, 0, 0], "radius": 1}},
    "origin": {"from": "generator", "seed": 1, "index": 2, "moves": []},
    "subject": {"name": "collide-fast-double", "version": "0.1.0", "scalar": "double"},
    "answer": {"status": "answered", "yes": true, "values": {}},
    "finding": {"verdict": "violates contract", "disagreement": "false hit", "clause": "backward error at most 16 epsilon",
                "backward": {"above_epsilon": 1024, "relative": 1.1e-13, "epsilon": 1.1e-16, "moved": {}},
                "forward": null, "unit_error_epsilon": 0}})");
  const Ran ran = nearmiss({"replay", "--json", "-s", "collide-fast-double", report});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  const json now = json::parse(ran.out);
  ASSERT_EQ(now.size(), 1u);
  EXPECT_EQ(now[0]["schema"], 2);
  EXPECT_EQ(now[0]["finding"]["verdict"], "agrees");
  EXPECT_EQ(now[0]["inputs"], json::parse(read_file(report))["inputs"]);
}

TEST(Import, ComparesTheShippedSample) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"import", "nyu-ccd", (corpus_folder() / "nyu-ccd" / "sample.csv").string(), "--out",
                            (folder / "cases").string()});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  EXPECT_NE(last_line(ran.out).find("contradicts the truth column on 0"), std::string::npos) << ran.out;
  std::size_t cases = 0;
  for (const auto& e : fs::directory_iterator(folder / "cases")) {
    EXPECT_EQ(read_case(e.path()).query->name, "moving_point_triangle");
    ++cases;
  }
  EXPECT_GT(cases, 0u);
}

/// The sample with every truth inverted.
TEST(Import, ListsWhatContradictsTheTruthColumn) {
  std::string text = read_file(corpus_folder() / "nyu-ccd" / "sample.csv");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at) text[at - 1] ^= 1;
  const TemporaryFolder folder;
  const std::string file = folder.file("turned.csv", text);
  const Ran ran = nearmiss({"import", "nyu-ccd", file});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  EXPECT_NE(ran.out.find("The oracle contradicts the truth column:\n  " + file + ":1: "), std::string::npos) << ran.out;
}

/// Imitates libFuzzer: leaves a case file, an artifact and statistics.
std::string fuzz_target(const StoredCase& c, const std::string& artifact) {
  return "#!/bin/sh\n"
         "cp '" +
         c.file.string() +
         "' \"$NEARMISS_FUZZ_REPORTS/found.json\"\n"
         "for a in \"$@\"; do case $a in -artifact_prefix=*) cp '" +
         artifact +
         "' \"${a#*=}crash-1\";; esac; done\n"
         "ls \"$1\" >&2\n"
         "echo \"asks: collide-fast-double $NEARMISS_SUBJECTS $NEARMISS_PLUGINS\"\n"
         "echo 'stat::number_of_executed_units: 1234'\n"
         "exit 0\n" +
         std::string("\0max_total_time\0", 16);
}

TEST(Nightly, RunsFuzzTargetsAndJudgesWhatTheyFind) {
  const TemporaryFolder folder;
  const StoredCase seed = stored_cases(*find_query("moving_sphere_box")).front();
  const std::vector<std::uint8_t> bytes = case_to_bytes(seed.question);
  const std::string artifact = folder.file("artifact", std::string(bytes.begin(), bytes.end()));
  fs::create_directory(folder / "targets");
  const fs::path target = folder.file("targets/fuzz_moving_sphere_box", fuzz_target(seed, artifact));
  fs::permissions(target, fs::perms::owner_all);
  const std::string plugin = plugin_file("skim_plugin");
  const Ran ran =
      nearmiss({"nightly", "--no-triage", "--minutes", is_sanitized ? "1.5" : "0.7", "--seed", "3", "--plugin", plugin,
                "--fuzz-targets", (folder / "targets").string(), "--out", (folder / "r").string()});
  ASSERT_NE(ran.exit_code, 2) << ran.err;
  const json index = index_of(folder / "r");
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index["state"], "finished");
  EXPECT_GT(index["stored"]["cases"], 0);
  EXPECT_EQ(index["stored"]["unexpected"], json::array());
  EXPECT_NE(index["properties"]["state"], "not built")
      << index["properties"];                               // there may be no time on a slow machine
  for (const json& name : index["properties"]["failed"]) {  // the plugin has mistakes
    EXPECT_NE(name.get<std::string>().find("__skim"), std::string::npos) << name;
  }
  EXPECT_EQ(index["properties"]["ended"], "");
  EXPECT_GT(index["relations"]["pairs"], 0);
  EXPECT_EQ(index["relations"]["oracle"], 0);
  EXPECT_EQ(complaints(json::parse(read_file(folder / "r" / "relations.json")), "relations.schema.json"), "");
  EXPECT_EQ(index["fuzz"]["state"], "ran") << index["fuzz"];
  ASSERT_EQ(index["fuzz"]["targets"].size(), 1u);
  EXPECT_EQ(index["fuzz"]["targets"][0]["executions"], 1234u * index["fuzz"]["targets"][0]["turns"].get<unsigned>());
  EXPECT_EQ(index["fuzz"]["targets"][0]["asked"], json::array({"collide-fast-double", "added", plugin}));
  EXPECT_EQ(index["fuzz"]["missing"].size(), fuzz_targets().size() - 1);
  EXPECT_EQ(index["fuzz"]["left"]["examined"], 2u);
  const std::string log = read_file(folder / "r" / "fuzz" / "moving_sphere_box.log");
  EXPECT_NE(log.find("seed-moving_sphere_box-" + seed.file.stem().string()), std::string::npos) << log;
  for (const json& t : index["tallies"]) EXPECT_GT(t["cases"], 0);
}

/// Replaces the program of property tests.
fs::path property_program(const TemporaryFolder& folder, const std::string& name, const std::string& lines) {
  const fs::path program = folder.file(name, "#!/bin/sh\necho \"$NEARMISS_SEED $NEARMISS_RUNS $RC_PARAMS\"\n" + lines);
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

TEST(Nightly, CountsPropertiesAndGoesOnWithFreshSeedsUntilTheTimeIsOver) {
  ::setenv("RC_PARAMS", "seed=9", 1);  // the night's own seeds replace it
  const TemporaryFolder folder;
  const fs::path program = property_program(folder, "program", R"(
echo "asks $NEARMISS_SUBJECTS $NEARMISS_PLUGINS $NEARMISS_COMMANDS"
echo '[       OK ] Relations/EveryTierRelated.Keeps/one (3 ms)'
echo '[  FAILED  ] Agreement/EveryTier.Answers/two, where GetParam() = two (4 ms)'
echo '[  FAILED  ] Agreement/EveryTier.Answers/two, where GetParam() = two'
sleep 0.6
exit 1
)");
  const PropertyOutcome o = run_property_tests(
      program, {folder / "r", {{"/a.so", "/b.so"}, {"python3 c.py"}}, 41, 2.5, [] {}, [] { return false; }});
  ASSERT_GE(o.seeds.size(), 2u);
  EXPECT_EQ(o.seeds[0], 41u);
  EXPECT_EQ(o.seeds[1], 42u);
  EXPECT_EQ(o.passed, o.seeds.size());
  EXPECT_EQ(o.failed, std::vector<std::string>(o.seeds.size(), "Agreement/EveryTier.Answers/two"));
  EXPECT_EQ(o.ended, "");
  EXPECT_EQ(read_file(folder / "r/properties/41.log").find("41 " + (folder / "r").string() + " seed=41 max_success=4 "),
            0u);
  EXPECT_EQ(
      read_file(folder / "r/properties/42.log").find("42 " + (folder / "r").string() + " seed=42 max_success=200 "),
      0u);
  EXPECT_NE(read_file(folder / "r/properties/42.log").find("\nasks added /a.so:/b.so python3 c.py\n"),
            std::string::npos);
}

TEST(Nightly, SaysHowPropertiesEndWithoutAResult) {
  const TemporaryFolder folder;
  const fs::path none = property_program(folder, "none", "exit 0\n"),
                 killed = property_program(folder, "killed", "kill -SEGV $$\n");
  const auto ended = [&](const fs::path& program) {
    return run_property_tests(program, {folder / "r", {}, 1, 30, [] {}, [] { return false; }}).ended;
  };
  EXPECT_TRUE(ended(none).starts_with("no test ran")) << ended(none);
  EXPECT_TRUE(ended(killed).starts_with("killed by signal 11")) << ended(killed);
}

TEST(Nightly, FailsWithATargetThatEndsWithAnError) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "targets");
  const std::string query(catalogue().front().name);
  const fs::path target =
      folder.file("targets/fuzz_" + query, "#!/bin/sh\nexit 77\n" + std::string("\0max_total_time\0", 16));
  fs::permissions(target, fs::perms::owner_all);
  const Ran ran = nearmiss({"nightly", "--no-triage", "--minutes", is_sanitized ? "1" : "0.25", "--fuzz-targets",
                            (folder / "targets").string(), "--out", (folder / "r").string()});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json index = index_of(folder / "r");
  ASSERT_EQ(index["fuzz"]["targets"].size(), 1u) << index["fuzz"];
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index["fuzz"]["targets"][0]["ended"], "left with exit code 77");
  EXPECT_NE(last_line(ran.out).find("1 ended with an error"), std::string::npos) << ran.out;
}

TEST(Nightly, TellsOfATargetThatCannotBeStarted) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "targets");
  const std::string query(catalogue().front().name);
  folder.file("targets/fuzz_" + query, std::string("\0max_total_time\0", 16));  // not executable
  const Ran ran = nearmiss({"nightly", "--no-triage", "--minutes", is_sanitized ? "0.75" : "0.2", "--fuzz-targets",
                            (folder / "targets").string(), "--out", (folder / "r").string()});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json index = index_of(folder / "r");
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index["state"], "finished");
  ASSERT_EQ(index["fuzz"]["targets"].size(), 1u) << index["fuzz"];
  EXPECT_EQ(index["fuzz"]["targets"][0]["ended"], "cannot be started: Permission denied");
}

TEST(Nightly, SaysThatFuzzTargetsAreNotBuilt) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "targets");
  const Ran ran = nearmiss({"nightly", "--no-triage", "--minutes", is_sanitized ? "0.4" : "0.05", "--fuzz-targets",
                            (folder / "targets").string(), "--out", (folder / "r").string()});
  ASSERT_NE(ran.exit_code, 2) << ran.err;
  EXPECT_TRUE(last_line(ran.out).ends_with("fuzzing: not built")) << ran.out;
  const json index = index_of(folder / "r");
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index["fuzz"]["state"], "not built");
}

TEST(RunSchema, RejectsBrokenDocuments) {
  const TemporaryFolder folder;
  ASSERT_EQ(nearmiss({"run", "-s", "collide-fast-double", "-n", "10", "--out", (folder / "r").string()}).exit_code, 0);
  const json good = index_of(folder / "r");
  ASSERT_EQ(complaints(good, "run.schema.json"), "");
  for (const auto& member : good.items()) {
    json broken = good;
    broken.erase(member.key());
    EXPECT_NE(complaints(broken, "run.schema.json"), "") << "without " << member.key();
    broken = good;
    broken[member.key()] = json::array({1.5});
    EXPECT_NE(complaints(broken, "run.schema.json"), "") << member.key() << " an array";
  }
}

const fs::path sources = source_folder();

TEST(OssFuzz, WritesAKitForALibrary) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "skim" / ".git");
  fs::create_directory(folder / "skim" / "nearmiss");
  fs::copy(sources / "docs" / "example-library", folder / "skim" / "nearmiss" / "adapter");
  const std::string add = (folder / "skim/nearmiss/adapter/nearmiss.cmake").string(), kit = (folder / "kit").string();
  const Ran ran = nearmiss({"oss-fuzz", "--subject", "skim", "--add", add, "--out", kit, "--repository",
                            "https://example.org/me/skim.git", "--contact", "me@example.org"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.out,
            "written: " + kit + ", for skim\nleft to fill in, where OWNER stands, or by these options: --nearmiss\n");
  std::set<std::string> files;
  for (const auto& e : fs::recursive_directory_iterator(kit)) {
    if (!e.is_regular_file()) continue;
    const std::string name = fs::relative(e.path(), kit).string(), text = read_file(e.path());
    files.insert(name);
    for (const char* word : {"@subject@", "@project@", "@add@", "@nearmiss@", "@repository@", "@contact@", "@own@",
                             "@kit@", "@oss@", "@cfl@"}) {
      EXPECT_EQ(text.find(word), std::string::npos) << name << " holds " << word;
    }
  }
  EXPECT_EQ(files,
            (std::set<std::string>{".clusterfuzzlite/Dockerfile", ".clusterfuzzlite/build.sh",
                                   ".clusterfuzzlite/project.yaml", ".github/workflows/cflite_batch.yml",
                                   ".github/workflows/cflite_cron.yml", ".github/workflows/cflite_pr.yml", "README.md",
                                   "oss-fuzz/Dockerfile", "oss-fuzz/build.sh", "oss-fuzz/project.yaml"}));
  const std::string script = read_file(fs::path(kit) / "oss-fuzz/build.sh");
  EXPECT_NE(script.find("\nexport NEARMISS_ADD=$SRC/skim/nearmiss/adapter/nearmiss.cmake "), std::string::npos)
      << script;
  EXPECT_NE(fs::status(fs::path(kit) / "oss-fuzz/build.sh").permissions() & fs::perms::owner_exec, fs::perms::none);
  const std::string image = read_file(fs::path(kit) / "oss-fuzz/Dockerfile");
  EXPECT_NE(image.find("git clone --depth 1 https://example.org/me/skim.git $SRC/skim\n"), std::string::npos) << image;
  EXPECT_EQ(read_file(fs::path(kit) / ".clusterfuzzlite/Dockerfile").find("example.org"), std::string::npos);
}

/// The project's own files are what the command writes for a tier of collide.
TEST(OssFuzz, WroteTheFilesOfThisProject) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"oss-fuzz", "-s", "collide-fast-double", "-o", (folder / "own").string()});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  std::size_t compared = 0;
  for (const auto& e : fs::recursive_directory_iterator(folder / "own")) {
    if (!e.is_regular_file()) continue;
    const fs::path name = fs::relative(e.path(), folder / "own");
    const fs::path own = *name.begin() == "oss-fuzz" ? sources / "fuzz" / name : sources / name;
    EXPECT_EQ(read_file(own), read_file(e.path())) << own << ": nearmiss oss-fuzz -s collide-fast-double writes this";
    ++compared;
  }
  EXPECT_EQ(compared, 9u);
}

TEST(OssFuzz, RefusesWhatItCannotUse) {
  const TemporaryFolder folder;
  const std::string out = (folder / "kit").string(), add = (sources / "docs/example-library/nearmiss.cmake").string();
  const std::string full = folder.file("full", "");
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{"--out", out}, "--subject is missing"},
      {{"--subject", "skim"}, "--out is missing"},
      {{"--subject", "skin", "--add", add, "--out", out}, add + ": it adds no subject 'skin'"},
      {{"--subject", "fcl-of-nobody", "--out", out}, "no file of this build adds 'fcl-of-nobody'"},
      {{"--subject", "skim", "--add", (folder / "none").string(), "--out", out}, "cannot be read"},
      {{"--subject", "skim", "--add", add, "--out", folder.path().string()}, "is not empty"},
      {{"--subject", "skim", "--add", add, "--out", full}, "is not empty"},
      {{"--subject", "skim", "--add", add, "--out", out, "--repository", "git@example.org"}, "is no URL"},
      {{"--subject", "skim", "--add", add, "--out", out, "--nearmiss", "https://a b"}, "is no URL"},
      {{"--subject", "skim", "--add", add, "--out", out, "--contact", "me"}, "is no address"},
  };
  for (const auto& [arguments, message] : cases) {
    std::vector<std::string> all{"oss-fuzz"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ran ran = nearmiss(all);
    EXPECT_EQ(ran.exit_code, 2) << message;
    EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_FALSE(fs::exists(out)) << message;
  }
}

TEST(Help, IsAManualForEveryCommand) {
  const Ran overview = nearmiss({"help"});
  EXPECT_EQ(overview.exit_code, 0);
  EXPECT_EQ(nearmiss({"--help"}).out, overview.out);
  for (const char* command : {"list", "run", "nightly", "relations", "extremes", "sweep", "trade", "builds", "replay",
                              "truth", "minimise", "explain", "promote", "import", "scene", "oss-fuzz", "completion"}) {
    EXPECT_NE(overview.out.find(std::string("\n    ") + command + " "), std::string::npos);
    const Ran page = nearmiss({"help", command});
    EXPECT_EQ(page.exit_code, 0);
    for (const char* part :
         {"NAME\n", "\nSYNOPSIS\n", "\nDESCRIPTION\n", "\nOPTIONS\n", "\nEXIT STATUS\n", "\nEXAMPLES\n"}) {
      EXPECT_NE(page.out.find(part), std::string::npos) << command << part;
    }
    EXPECT_EQ(nearmiss({command, "--help"}).out, page.out);
  }
}

TEST(Version, IsTold) {
  const Ran ran = nearmiss({"--version"});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_TRUE(ran.out.starts_with("nearmiss ")) << ran.out;
}

/// The completions of bash at the end of `words`.
std::string completions(const std::string& words) {
  const std::string script = "source <('" + nearmiss_program() + "' completion bash); COMP_WORDS=('" +
                             nearmiss_program() + "' " + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _nearmiss; printf '%s ' \"${COMPREPLY[@]}\"";
  const Ran ran = run_program("bash", {"-c", script});
  EXPECT_EQ(ran.err, "");
  return ran.out;
}

TEST(Completion, KnowsCommandsOptionsAndNames) {
  EXPECT_EQ(completions("rep"), "replay ");
  EXPECT_EQ(completions("run --sec"), "--seconds ");
  EXPECT_EQ(completions("run --query moving_sphere_b"), "moving_sphere_box ");
  EXPECT_EQ(completions("replay --subject collide-fast-d"), "collide-fast-double ");
  EXPECT_EQ(completions("help nig"), "nightly ");
  EXPECT_EQ(completions("import ny"), "nyu-ccd ");
}

}  // namespace
}  // namespace nearmiss
