/// Triage: mistakes are told apart, compared with a baseline, and decided about; every form of the result is valid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "corpus/generator/feature_regions.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/findings/severity.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"
#include "reports/triage/comparison/baseline.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Runs and triages of planted_plugin.c, whose mistakes are named by letters.
class Triaged : public testing::Test {
 protected:
  static std::vector<std::string> planted(const std::string& mistakes) { return {"NEARMISS_PLANTED=" + mistakes}; }
  std::string run(const std::string& name, const std::string& mistakes, const std::string& cases = "20000",
                  const std::string& seed = "1") {
    const std::string to = (folder_ / name).string();
    const Ran ran =
        nearmiss({"run", "--plugin", plugin_, "-s", "planted", "--cases", cases, "--seed", seed, "--out", to},
                 planted(mistakes));
    EXPECT_EQ(ran.exit_code, mistakes.empty() ? 0 : 1) << ran.err;
    return to;
  }
  Ran triage(const std::string& mistakes, const std::vector<std::string>& arguments) {
    const Ran ran = nearmiss(joined({"triage", "--plugin", plugin_}, arguments), planted(mistakes));
    EXPECT_NE(ran.exit_code, -1);
    return ran;
  }
  json result(const std::string& of) const { return json::parse(read_file(fs::path(of) / "triage" / "triage.json")); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  const std::string plugin_ = plugin_file("planted");
  const TemporaryFolder folder_;
};

/// The signature with this fault and these regions; null where there is none.
json signature_in(const json& result, const std::string& fault, const std::vector<std::string>& regions) {
  for (const json& s : result.at("signatures")) {
    if (s.at("fault") == fault && s.at("regions") == json(regions)) return s;
  }
  return nullptr;
}

constexpr const char* zero_size = "a zero size";
constexpr const char* same_place = "two places alike";

TEST_F(Triaged, TellsThreeMistakesApart) {
  const std::string of = run("r", "abc");
  const Ran ran = triage("abc", {of});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json t = result(of);
  EXPECT_EQ(complaints(t, "triage.schema.json"), "");
  ASSERT_EQ(t["signatures"].size(), 3u) << ran.out;
  const json tolerance = signature_in(t, "false-hit", {}), zero = signature_in(t, "false-miss", {zero_size}),
             same = signature_in(t, "false-miss", {same_place});
  ASSERT_FALSE(tolerance.is_null()) << ran.out;
  ASSERT_FALSE(zero.is_null()) << ran.out;
  ASSERT_FALSE(same.is_null()) << ran.out;
  EXPECT_EQ(tolerance["cause"]["kind"], "absolute tolerance") << tolerance["cause"];
  EXPECT_GT(zero["severity"], tolerance["severity"]) << "a missed hit comes before a false one";
  EXPECT_EQ(t["signatures"][2]["id"], tolerance["id"]);
  const json index = json::parse(read_file(fs::path(of) / "index.json"));
  EXPECT_EQ(t["totals"]["findings"], index["findings"]) << "also those without a report";
  EXPECT_EQ(t["totals"]["reports"], index["reports"].size());
  EXPECT_LT(t["totals"]["reports"], t["totals"]["findings"]);
  for (const json& s : t["signatures"]) {
    const json simplest = json::parse(read_file(s["simplest"].get<std::string>()));
    EXPECT_EQ(complaints(simplest, "report.schema.json"), "");
    EXPECT_EQ(simplest["cause"]["kind"], s["cause"]["kind"]);
    EXPECT_TRUE(s["change"].is_null());
  }
  EXPECT_NE(ran.out.find("3 signatures in "), std::string::npos) << ran.out;
}

TEST_F(Triaged, FitsThePageOfATerminal) {
  const std::string of = run("r", "abc");
  const Ran ran = triage("abc", {of, "--rows", "2"});
  std::istringstream lines(ran.out);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(line.size() <= 100 || line.find(of) != std::string::npos) << line;
  }
  EXPECT_NE(ran.out.find("and 1 less severe: --rows 3 shows all"), std::string::npos) << ran.out;
}

TEST_F(Triaged, GoesOnWithWhatWasExaminedAndGivesTheSameResult) {
  const std::string of = run("r", "abc");
  triage("abc", {of});
  const std::string first = read_file(fs::path(of) / "triage" / "triage.json");
  std::vector<std::pair<fs::path, fs::file_time_type>> written;
  for (const auto& f : fs::recursive_directory_iterator(fs::path(of) / "triage" / "examined"))
    written.emplace_back(f.path(), f.last_write_time());
  ASSERT_FALSE(written.empty());
  triage("abc", {of});
  EXPECT_EQ(read_file(fs::path(of) / "triage" / "triage.json"), first);
  for (const auto& [file, time] : written) EXPECT_EQ(fs::last_write_time(file), time) << file << " was examined again";
}

TEST_F(Triaged, AFixedMistakeIsFixedAndOnlyThat) {
  const std::string before = run("before", "abc"), after = run("after", "ab");
  triage("abc", {before});
  const Ran ran = triage("ab", {after, "--baseline", before});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  const json t = result(after);
  EXPECT_EQ(complaints(t, "triage.schema.json"), "");
  EXPECT_EQ(signature_in(t, "false-miss", {same_place})["change"], "fixed") << ran.out;
  EXPECT_EQ(signature_in(t, "false-miss", {zero_size})["change"], "known") << ran.out;
  EXPECT_EQ(signature_in(t, "false-hit", {})["change"], "known") << ran.out;
  EXPECT_EQ(t["totals"]["fixed"], 1);
  EXPECT_EQ(t["totals"]["new"], 0);
}

/// The run found nothing of mistake c, but the subject still makes it: the file of the baseline holds the cases.
TEST_F(Triaged, WhatWasNotFoundAgainIsAskedBeforeItCountsAsFixed) {
  const std::string before = run("before", "abc"), nothing = run("nothing", "");
  triage("abc", {before, "--json", path("known.json")});
  fs::remove_all(before);
  const Ran still = triage("c", {nothing, "--baseline", path("known.json")});
  EXPECT_EQ(still.exit_code, 0) << still.out << still.err;
  const json t = result(nothing);
  EXPECT_EQ(signature_in(t, "false-miss", {same_place})["change"], "known") << still.out;
  EXPECT_EQ(signature_in(t, "false-miss", {zero_size})["change"], "fixed") << still.out;
  EXPECT_EQ(signature_in(t, "false-hit", {})["change"], "fixed") << still.out;
}

/// The number of rows with this change.
std::size_t with_change(const json& result, const std::string& change) {
  const json& all = result.at("signatures");
  return std::size_t(std::count_if(all.begin(), all.end(), [&](const json& s) { return s.at("change") == change; }));
}

TEST_F(Triaged, ANewMistakeIsNewAgainstARunThatWasNotTriaged) {
  const std::string before = run("before", "b"), after = run("after", "bc");
  const Ran ran = triage("bc", {after, "--baseline", before});
  EXPECT_EQ(ran.exit_code, 1) << ran.out << ran.err;
  const json t = result(after);
  EXPECT_EQ(with_change(t, "new"), 1u) << ran.out;
  EXPECT_EQ(signature_in(t, "false-miss", {zero_size})["change"], "known") << ran.out;
  EXPECT_EQ(triage("b", {before, "--baseline", before}).exit_code, 0);
}

TEST_F(Triaged, TheSameMistakesInOtherCasesAreKnownAndOneMoreIsNew) {
  const std::string before = run("before", "ab", "4000");
  triage("ab", {before});
  for (const std::string seed : {"2", "3"}) {
    const std::string same = run("same" + seed, "ab", "4000", seed), more = run("more" + seed, "abc", "4000", seed);
    const Ran unchanged = triage("ab", {same, "--baseline", before});
    EXPECT_EQ(unchanged.exit_code, 0) << unchanged.out;
    EXPECT_EQ(with_change(result(same), "new") + with_change(result(same), "worse"), 0u) << unchanged.out;
    const Ran changed = triage("abc", {more, "--baseline", before});
    EXPECT_EQ(changed.exit_code, 1) << changed.out;
    const json added = signature_in(result(more), "false-miss", {same_place});
    EXPECT_EQ(added["change"], "new") << changed.out;
    EXPECT_NE(added["why"], "");
    EXPECT_EQ(with_change(result(more), "new"), 1u) << changed.out;
  }
}

/// Some ten findings of 200 cases, and none of 200 others: the numbers alone prove nothing.
TEST_F(Triaged, AFewFindingsAreNewWhereTheCasesOfTheBaselineShowThem) {
  const std::string before = run("before", "a", "200"), after = run("after", "ac", "200", "2");
  triage("a", {before});
  const Ran ran = triage("ac", {after, "--baseline", before});
  EXPECT_EQ(ran.exit_code, 1) << ran.out << ran.err;
  const json added = signature_in(result(after), "false-miss", {same_place});
  ASSERT_FALSE(added.is_null()) << ran.out;
  EXPECT_EQ(added["change"], "new") << ran.out;
  EXPECT_NE(added["why"].get<std::string>().find("of the 200 cases of the baseline, then 0"), std::string::npos);
  json known = json::parse(read_file(fs::path(before) / "triage" / "triage.json"));
  known["sample"]["seed"] = nullptr;
  const Ran unproved = triage("ac", {after, "--baseline", folder_.file("known.json", known.dump())});
  EXPECT_EQ(unproved.exit_code, 0) << unproved.out;
  EXPECT_EQ(signature_in(result(after), "false-miss", {same_place})["change"], "unproved") << unproved.out;
}

/// Two mistakes of one kind that need no regions are one row.
TEST_F(Triaged, AFixBesideAKnownMistakeOfOneRowIsFixedInPartAndOneMoreIsNew) {
  const std::string both = run("both", "xy", "4000"), one = run("one", "x", "4000", "2");
  triage("xy", {both});
  ASSERT_EQ(with_change(result(both), "new") + result(both)["signatures"].size(), 1u);
  const Ran mended = triage("x", {one, "--baseline", both});
  EXPECT_EQ(mended.exit_code, 0) << mended.out;
  EXPECT_EQ(complaints(result(one), "triage.schema.json"), "");
  EXPECT_EQ(with_change(result(one), "fixed in part"), 1u) << mended.out;
  EXPECT_EQ(with_change(result(one), "fixed"), 0u) << mended.out;
  const json& row = signature_in(result(one), "false-miss", {});
  EXPECT_NE(row["why"].get<std::string>().find("kept cases of the baseline: gone"), std::string::npos) << row["why"];
  const std::string more = run("more", "xy", "4000", "3");
  const Ran worse = triage("xy", {more, "--baseline", one});
  EXPECT_EQ(worse.exit_code, 1) << worse.out;
  EXPECT_EQ(complaints(result(more), "triage.schema.json"), "");
  EXPECT_EQ(with_change(result(more), "new"), 1u) << worse.out;
  EXPECT_NE(worse.out.find("of the baseline's run: right then, wrong now"), std::string::npos) << worse.out;
  EXPECT_NE(worse.out.find("1 known"), std::string::npos) << "the row of the known mistake is as it was\n" << worse.out;
}

/// What is asked first is the same in every check.
TEST_F(Triaged, ACheckAsksTheBaselineAndThenFreshCases) {
  const std::string before = run("before", "ab", "2000");
  triage("ab", {before, "--json", path("known.json")});
  fs::remove_all(before);
  const auto check = [&](const std::string& mistakes, const std::string& name) {
    return triage(mistakes, {"--check", "--baseline", path("known.json"), "--minutes", is_sanitized ? "0.6" : "0.15",
                             "--seed", "7", "--out", path(name)});
  };
  const Ran same = check("ab", "same");
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_EQ(with_change(result(path("same")), "new") + with_change(result(path("same")), "worse"), 0u) << same.out;
  EXPECT_NE(same.out.find(" still wrong, 0 gone\n"), std::string::npos) << same.out;
  EXPECT_NE(same.out.find("2,000 cases asked again\n"), std::string::npos) << same.out;
  EXPECT_NE(same.out.find(" with seed 7, "), std::string::npos) << same.out;
  const Ran changed = check("bc", "changed");
  EXPECT_EQ(changed.exit_code, 1) << changed.out << changed.err;
  EXPECT_EQ(complaints(result(path("changed")), "triage.schema.json"), "");
  EXPECT_GE(with_change(result(path("changed")), "new"), 1u) << changed.out;
  EXPECT_EQ(with_change(result(path("changed")), "fixed"), 1u) << changed.out;
  constexpr std::ptrdiff_t lines_of_a_screen = 50;
  EXPECT_LT(std::count(changed.out.begin(), changed.out.end(), '\n'), lines_of_a_screen) << changed.out;
  EXPECT_EQ(check("", "mended").exit_code, 0);
}

TEST_F(Triaged, FindingsOfExtremeMagnitudeAreOneRowThatMakesNoBuildRed) {
  const std::string of = run("r", "o");
  const Ran ran = triage("o", {of});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  const json t = result(of);
  EXPECT_EQ(complaints(t, "triage.schema.json"), "");
  ASSERT_EQ(t["signatures"].size(), 1u) << ran.out;
  const json& range = t["signatures"][0]["range"];
  ASSERT_TRUE(range.is_object()) << ran.out;
  EXPECT_GT(range["up_from"].get<double>(), 1e18);
  EXPECT_TRUE(range["down_from"].is_null());
  EXPECT_EQ(triage("o", {of, "--all-magnitudes"}).exit_code, 1);
  const Ran ordinary = triage("o", {of, "--ordinary"});
  EXPECT_EQ(ordinary.exit_code, 0);
  EXPECT_TRUE(result(of)["signatures"].empty());
  EXPECT_EQ(result(of)["totals"]["left_out"], t["totals"]["findings"]);
  const std::string both = run("both", "bo");
  EXPECT_EQ(triage("bo", {both}).exit_code, 1);
  const json rows = result(both)["signatures"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_TRUE(rows[0]["range"].is_null());
  EXPECT_FALSE(rows[1]["range"].is_null()) << "it is the last";
}

TEST_F(Triaged, TotalsAreThoseOfTheRunAndOfThePage) {
  const std::string of = run("r", "wbo", "30000");
  const json index = json::parse(read_file(fs::path(of) / "index.json"));
  fs::remove(fs::path(of) / index["reports"][0]["file"].get<std::string>());
  triage("wbo", {of});
  const json t = result(of);
  EXPECT_EQ(t["totals"]["findings"], index["findings"]) << "also with a report that is gone";
  std::uint64_t findings = 0, reports = 0, without = 0;
  for (const json& s : t["signatures"]) {
    findings += s["findings"].get<std::uint64_t>(), reports += s["count"].get<std::uint64_t>();
    without += s["without_report"].get<std::uint64_t>();
  }
  EXPECT_EQ(findings, t["totals"]["findings"]);
  EXPECT_EQ(findings, reports + without);
  triage("", {of});
  EXPECT_EQ(result(of)["totals"]["findings_right_now"], index["findings"]);
}

TEST_F(Triaged, TheSimplestCaseIsOrdinaryWhereTheFindingIs) {
  const std::string of = run("r", "bR");
  triage("bR", {of});
  const json rows = result(of)["signatures"];
  for (const json& s : rows) {
    for (const auto& [name, value] : s["case"]["inputs"].items()) {
      for (const json& x : value.is_object() ? value : json::array({value})) {
        const json& numbers = x.is_array() ? x : json::array({x});
        for (const json& n : numbers) {
          if (!n.is_number() || n == 0) continue;
          EXPECT_LE(std::abs(std::log2(std::abs(n.get<double>()))), 10) << s["case"];
        }
      }
    }
  }
}

TEST_F(Triaged, ADecisionHoldsUntilTheFindingGetsWorse) {
  const std::string of = run("r", "b");
  EXPECT_EQ(triage("b", {of}).exit_code, 1);
  const json s = signature_in(result(of), "false-miss", {zero_size});
  const std::string id = s["id"];
  const double percent = 100 * s["relative"].get<double>();
  const auto decided = [&](const std::string& line) {
    const std::string file = folder_.file("decisions.txt", "# Decisions\n\n" + line + "\n");
    return triage("b", {of, "--decisions", file});
  };
  EXPECT_EQ(decided(id + " accepted  # balls of radius 0 are not used").exit_code, 0);
  EXPECT_EQ(result(of)["signatures"][0]["decision"]["note"], "balls of radius 0 are not used");
  EXPECT_EQ(decided(id + " upstream at " + std::to_string(percent) + " %").exit_code, 0);
  EXPECT_EQ(decided(id + " upstream at " + std::to_string(percent / 1.9) + "%").exit_code, 0);
  const Ran worse = decided(id + " reported https://example.org/1 at " + std::to_string(percent / 2.1) + " % # why");
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_TRUE(std::regex_search(worse.out, std::regex("re-opened: it was reported\\s+https://example.org/1")))
      << worse.out;
  const json t = result(of);
  EXPECT_EQ(complaints(t, "triage.schema.json"), "");
  EXPECT_EQ(t["totals"]["reopened"], 1);
  EXPECT_EQ(t["signatures"][0]["decision"]["url"], "https://example.org/1");
  EXPECT_EQ(decided(id + " fixed 1.3").exit_code, 0) << "this is planted 1.2";
  EXPECT_EQ(decided(id + " fixed 1.2").exit_code, 1);
  EXPECT_NE(decided("0123456789ab accepted").err.find("no signature has the id 0123456789ab"), std::string::npos);
}

TEST(Decisions, WrongLinesAreNamed) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      decisions_in(text, "d.txt");
    } catch (const BadInput& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("0123456789ab accepted\n  # no\n"), "");
  EXPECT_NE(complaint("\n0123 accepted").find("d.txt:2: '0123' is no id"), std::string::npos);
  EXPECT_NE(complaint("0123456789ab agreed").find("'agreed' is none of accepted"), std::string::npos);
  EXPECT_NE(complaint("0123456789ab reported # x").find("reported needs a URL"), std::string::npos);
  EXPECT_NE(complaint("0123456789ab fixed").find("fixed needs a version"), std::string::npos);
  EXPECT_NE(complaint("0123456789ab accepted at 3").find("needs a size in percent"), std::string::npos);
  EXPECT_NE(complaint("0123456789ab accepted because").find("unexpected 'because'"), std::string::npos);
  EXPECT_NE(complaint("0123456789ab accepted\n0123456789ab upstream").find("d.txt:2: there is a decision"),
            std::string::npos);
}

TEST_F(Triaged, FilesThatAreNoReportsAreNamedAndSkipped) {
  const std::string of = run("r", "b");
  const json index = json::parse(read_file(fs::path(of) / "index.json"));
  const std::string whole = read_file(fs::path(of) / index["reports"][0]["file"].get<std::string>());
  const fs::path reports = folder_ / "reports";
  fs::create_directory(reports);
  write_file(reports / "whole.json", whole);
  write_file(reports / "truncated.json", whole.substr(0, whole.size() / 2));
  write_file(reports / "foreign.json", "{\"hello\": 1}\n");
  json old = json::parse(whole);
  old["schema"] = 1;
  write_file(reports / "old.json", old.dump());
  json other = json::parse(whole);
  other["subject"]["name"] = "nobody";
  write_file(reports / "other.json", other.dump());
  json odd = json::parse(whole);
  odd["subject"] = 5;
  write_file(reports / "odd.json", odd.dump());
  const Ran ran = triage("b", {reports.string()});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  for (const char* line : {"truncated.json: ", "foreign.json: it is no report", "old.json: its schema is 1",
                           "other.json: it is about \"nobody\"", "odd.json: subject is 5"}) {
    EXPECT_NE(ran.err.find(line), std::string::npos) << line << "\n" << ran.err;
  }
  const json t = result(reports.string());
  EXPECT_EQ(t["skipped"].size(), 5u);
  EXPECT_EQ(t["totals"]["reports"], 1);
  EXPECT_EQ(complaints(t, "triage.schema.json"), "");
  for (int i = 0; i < 20; ++i) write_file(reports / ("more" + std::to_string(i) + ".json"), "[");
  const Ran many = triage("b", {reports.string()});
  EXPECT_NE(many.err.find("nearmiss: and 15 more\n"), std::string::npos) << many.err;
  EXPECT_EQ(std::count(many.err.begin(), many.err.end(), '\n'), 11) << many.err;
}

TEST_F(Triaged, SaysWhyItCannotRun) {
  const std::string of = run("r", "b");
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& what) {
    const Ran ran = triage("b", arguments);
    EXPECT_EQ(ran.exit_code, 2) << ran.out;
    EXPECT_NE(ran.err.find(what), std::string::npos) << ran.err;
  };
  expect({path("nothing")}, "no such file or folder");
  expect({}, "SOURCE is required, or --check");
  expect({"--check"}, "--baseline");
  expect({"--check", "--baseline", folder_.file("z.json", "[]"), "--out", path("z")}, "z.json");
  expect({of, "--seed", "1"}, "--check");
  expect({folder_.file("x.json", "{}")}, "no report could be read; 1 file skipped");
  expect({of, "--baseline", folder_.file("y.json", "{\"schema\": 7}")}, "schema is 7: it must be 1");
  expect({of, "--decisions", path("nothing")}, "nothing");
  const Ran without = nearmiss({"triage", of});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.err.find("it is about \"planted\", which is no subject here"), std::string::npos) << without.err;
}

TEST_F(Triaged, WritesSarifAndJUnit) {
  const std::string before = run("before", "ab"), after = run("after", "bc");
  triage("ab", {before});
  const std::string sarif = path("t.sarif"), junit = path("t.xml");
  const std::string known = signature_in(result(before), "false-miss", {zero_size})["id"];
  const std::string decisions = folder_.file("d.txt", known + " accepted # \"<&>\"\n");
  const Ran ran =
      triage("bc", {after, "--baseline", before, "--decisions", decisions, "--sarif", sarif, "--junit", junit});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json s = json::parse(read_file(sarif));
  EXPECT_EQ(complaints(s, "tests/sarif-subset.schema.json"), "");
  const json& results = s["runs"][0]["results"];
  ASSERT_EQ(results.size(), 3u);
  const auto state = [&](const std::string& wanted) {
    return *std::find_if(results.begin(), results.end(), [&](const json& r) { return r["baselineState"] == wanted; });
  };
  EXPECT_EQ(state("new")["level"], "error");
  EXPECT_EQ(state("absent")["level"], "note");
  EXPECT_EQ(state("unchanged")["suppressions"][0]["justification"], "\"<&>\"");
  const std::string xml = read_file(junit);
  EXPECT_NE(xml.find("<testsuites tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\">"), std::string::npos) << xml;
  const auto times = [&](const std::string& what) {
    const std::regex tag(what);
    return std::distance(std::sregex_iterator(xml.begin(), xml.end(), tag), std::sregex_iterator());
  };
  EXPECT_EQ(times("<testcase classname=\"planted.sphere_sphere_overlap\" name=\"[a-z-]+ [0-9a-f]{12}\"/?>"), 3);
  EXPECT_EQ(times("<failure type=\"false-miss\" message=\"new: "), 1);
  EXPECT_EQ(times("<skipped message=\"accepted\"/>"), 1);
  EXPECT_EQ(times("<[a-z]") - times("/>"), times("</"));  // every element is closed
}

TEST_F(Triaged, DiffComparesTwoRunsWithoutAsking) {
  const std::string before = run("before", "rb"), after = run("after", "Rb", "10000");
  const std::string file = path("d.json");
  const Ran ran = nearmiss({"diff", before, after, "--json", file});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json d = json::parse(read_file(file));
  EXPECT_EQ(complaints(d, "diff.schema.json"), "");
  ASSERT_EQ(d["kinds"].size(), 2u) << ran.out;
  for (const json& k : d["kinds"]) {
    EXPECT_EQ(k["before"]["asked"], 20000);
    EXPECT_EQ(k["after"]["asked"], 10000);
    EXPECT_EQ(k["fault"] == "false-hit" ? "worse" : "known", k["change"]) << k;
    EXPECT_NEAR(k["after"]["rate"].get<double>(), k["after"]["findings"].get<double>() / 10000, 1e-12);
  }
  EXPECT_EQ(nearmiss({"diff", before, before}).exit_code, 0);
  const std::string nothing = run("nothing", "");
  const Ran fresh = nearmiss({"diff", nothing, before});
  EXPECT_EQ(fresh.exit_code, 1);
  EXPECT_NE(fresh.out.find("new "), std::string::npos) << fresh.out;
  const Ran gone = nearmiss({"diff", before, nothing});
  EXPECT_EQ(gone.exit_code, 0);
  EXPECT_NE(gone.out.find("gone "), std::string::npos) << gone.out;
  const Ran no_run = nearmiss({"diff", before, path("nowhere")});
  EXPECT_EQ(no_run.exit_code, 2);
  EXPECT_NE(no_run.err.find("index.json"), std::string::npos) << no_run.err;
}

/// A mistake in every case keeps few reports, and of every variant some.
TEST_F(Triaged, ASubjectThatIsAlwaysWrongFillsNoDisk) {
  const std::string of = run("r", "w", "30000");
  const json index = json::parse(read_file(fs::path(of) / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_GT(index["findings"], 15000) << "of the answers that were judged, a sample";
  EXPECT_GT(index["tallies"][0]["not_judged"], 10000);
  EXPECT_LT(index["reports"].size(), 2 * (32 + 52u)) << "two kinds, and the much worse ones";
  std::uint64_t findings = 0, kept = 0, without = 0, variants = 0;
  for (const json& v : index["variants"]) {
    findings += v["findings"].get<std::uint64_t>(), kept += v["kept"].get<std::uint64_t>();
    without += v["kept"] == 0, ++variants;
  }
  EXPECT_EQ(findings, index["findings"]);
  EXPECT_EQ(kept, index["reports"].size());
  EXPECT_GE(variants, 8u);
  EXPECT_LT(2 * without, variants) << "what is kept is diverse";
}

// Severity.

Finding with_member(Disagreement d, double above, double forward_absolute, int member, int output) {
  Finding f;
  f.verdict = Verdict::violates_contract;
  f.disagreement = d;
  MemberFinding m;
  m.disagreement = d;
  m.member = member, m.worst = output;
  m.backward = Backward{above};
  m.forward_absolute = forward_absolute, m.forward_ulps = forward_absolute > 0 ? 2 : 0;
  f.members = {m};
  f.headline = 0;
  return f;
}

TEST(Severity, ASmallErrorDoesNotTieWithAMissWhereTheLadderEnds) {
  const Query& query = *find_query("moving_sphere_box");
  Case c{&query, Scalar::float64, std::vector<double>(query.inputs.size(), 1.0), "generator", 0, 0, {}};
  const auto normal =
      std::find_if(query.outputs.begin(), query.outputs.end(), [](const Field& f) { return f.role == Role::normal; });
  const int output = int(normal - query.outputs.begin());
  const Finding two_ulps = with_member(Disagreement::wrong_normal, 0x1p50, 0x1p-52, 1, output);
  const Finding miss = with_member(Disagreement::false_miss, 0x1p50, 0, MemberFinding::decision, -1);
  const ErrorSize small = error_size(c, two_ulps), large = error_size(c, miss);
  EXPECT_EQ(small.relative, 0x1p-52);
  EXPECT_EQ(large.relative, 0.125);
  EXPECT_GT(severity_of(miss, large, 1), 10 * severity_of(two_ulps, small, 1));
  EXPECT_GT(severity_of(miss, large, 1), severity_of(miss, large, 0)) << "ordinary scenes matter more";
  const Finding hit = with_member(Disagreement::false_hit, 0x1p50, 0, MemberFinding::decision, -1);
  EXPECT_GT(severity_of(miss, large, 1), severity_of(hit, large, 1));
  Finding broke;
  broke.verdict = Verdict::broke;
  EXPECT_GT(severity_of(broke, error_size(c, broke), 1), severity_of(miss, large, 1));
  EXPECT_EQ(size_text(large), "12 % of the scene, 0.12 units of length (> 2^50 epsilon)");
}

// Regions.

TEST(FeatureRegions, AreToldFromNumbersAlone) {
  const Query& query = *find_query("moving_sphere_box");
  std::vector<double> values;
  for (const Field& f : query.inputs) {
    values.push_back(f.name.ends_with("orientation.w") ? 1 : f.role == Role::size ? 0.5 : 0);
  }
  Case c{&query, Scalar::float64, values, "test", 0, 0, {}};
  const auto set = [&](const std::string& name, double x) {
    for (std::size_t i = 0; i < query.inputs.size(); ++i) {
      if (query.inputs[i].name == name) c.values[i] = x;
    }
  };
  const auto has = [&](FeatureRegion r) { return feature_regions_of(c).has(r); };
  EXPECT_TRUE(has(FeatureRegion::same_place));
  EXPECT_TRUE(has(FeatureRegion::no_motion));
  EXPECT_TRUE(has(FeatureRegion::starts_in_touch));
  set("sphere.center.x", 4), set("velocity.x", -1);
  EXPECT_TRUE(feature_regions_of(c).empty()) << feature_regions_of(c).names().front();
  set("sphere.radius", 0);
  EXPECT_TRUE(has(FeatureRegion::zero_size));
  set("sphere.radius", 3.5);
  EXPECT_TRUE(has(FeatureRegion::starts_in_touch));
  set("sphere.radius", std::nextafter(3.5, 0));
  EXPECT_TRUE(feature_regions_of(c).empty());
}

}  // namespace
}  // namespace nearmiss
