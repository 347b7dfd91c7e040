/// Emitted tests for engines (docs/engines.md): files of two engines as they are stored, and, where an engine is
/// installed, what they do.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <set>

#include "corpus/files/errors.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "impl/host/engines.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"
#include "reports/findings/version.hpp"
#include "reports/tests/program.hpp"
#include "reports/upstream/asking.hpp"
#include "reports/upstream/emit_test.hpp"

namespace nearmiss {

void PrintTo(const Engine& engine, std::ostream* out) { *out << engine.name; }

namespace {

namespace fs = std::filesystem;

/// Every engine with its usual settings.
std::vector<Engine> engines_by_name() {
  std::vector<Engine> all = engines();
  std::erase_if(all, [](const Engine& e) { return !e.setting.empty(); });
  return all;
}

std::vector<fs::path> cases_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::path& file : fs::directory_iterator(folder, error)) files.push_back(file);
  std::sort(files.begin(), files.end());
  return files;
}
/// A stored case of the ledger, and what is expected of the engine.
struct Wanted {
  StoredCase stored;
  Expected expected;
};
std::vector<Wanted> ledger_of(const Engine& engine) {
  std::vector<Wanted> all;
  for (const fs::path& folder : fs::directory_iterator(corpus_folder() / "upstream")) {
    for (const fs::path& file : cases_in(folder)) {
      const StoredCase stored = read_stored_case(file);
      for (const Expected& e : stored.expected) {
        if (e.subject == engine.name) all.push_back({stored, e});
      }
    }
  }
  return all;
}

/// The text from `begin` up to `end`, which both must be there.
std::string with_replaced(std::string text, const std::string& begin, const std::string& end, const std::string& by) {
  const std::size_t from = text.find(begin), to = text.find(end, from);
  if (from == std::string::npos || to == std::string::npos) return "no " + begin + " or " + end + " in " + text;
  return text.replace(from, to - from, by);
}

/// Of many right normals one along a direction of their cone.
std::array<double, 3> one_of_many(const Alternative& a) {
  for (const Alternative::Face& f : a.facing) {
    for (const double sign : {1.0, -1.0}) {
      const std::array<double, 3> normal{sign * f.direction[0].low, sign * f.direction[1].low,
                                         sign * f.direction[2].low};
      const bool is_right = std::all_of(a.facing.begin(), a.facing.end(), [&](const Alternative::Face& g) {
        double along = 0;
        for (std::size_t i = 0; i < 3; ++i) along += g.direction[i].low * normal[i];
        constexpr double rounding = 6 * 0x1p-52;  // three products of numbers that are each off by one ulp of 1
        return along >= g.range.low - rounding && along <= g.range.high + rounding;
      });
      if (is_right) return normal;
    }
  }
  return {1, 0, 0};
}
/// An exact answer to the case: the one that is right without a choice of normals, where there is one.
Alternative right_answer(const Case& question) {
  const Truth truth = truth_of(question);
  for (const Alternative& a : truth.alternatives) {
    if (!a.many_normals) return a;
  }
  Alternative a = truth.alternatives.at(0);
  for (const Layout::Part& part : question.query->layout.parts) {
    if (part.role != Role::normal || part.end > a.count) continue;
    const std::array<double, 3> normal = one_of_many(a);
    std::copy(normal.begin(), normal.end(), a.nearest.begin() + std::ptrdiff_t(part.begin));
  }
  return a;
}

/// The test with a right answer in place of the statements that ask the engine.
std::string answered_rightly(const std::string& text, const Case& question, bool in_javascript) {
  const Alternative right = right_answer(question);
  const Query& query = *question.query;
  std::string by;
  if (in_javascript) {
    by = fmt::format("  const got = {{ yes: {}", right.yes);
  } else if (decides(query.kind)) {
    by = fmt::format("  got_yes = {};\n", right.yes);
  }
  for (std::size_t m = 0; m < query.layout.parts.size(); ++m) {
    const Layout::Part& part = query.layout.parts[m];
    if (part.end > right.count) continue;
    std::string list;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const bool is_one = part.end - part.begin == 1;
      const std::string index = is_one ? "" : fmt::format("[{}]", i - part.begin);
      if (!in_javascript)
        by += fmt::format("  {}{} = {};\n", variable_of(query.layout.parts[m].name), index, literal(right.nearest[i]));
      list += (list.empty() ? "" : ", ") + literal(right.nearest[i]);
    }
    if (in_javascript)
      by += fmt::format(", \"{}\": [{}]{}", query.layout.parts[m].name, list, part.end - part.begin == 1 ? "[0]" : "");
  }
  return with_replaced(text, in_javascript ? "  const q = " : "  const double in[]", "\n  // Exactly,",
                       by + (in_javascript ? " };\n" : ""));
}

/// The test in JavaScript with the right decision alone in place of the statements that ask the engine.
std::string decided_rightly(const std::string& text, const Case& question) {
  return with_replaced(text, "  const q = ", "\n  // Exactly,",
                       fmt::format("  const got = {{ yes: {} }};\n", right_answer(question).yes));
}

/// Runs the test of a package of npm with the installed package, or compiles the other one by its own command line.
Ran run_emitted(const TemporaryFolder& folder, const Engine& engine, const std::string& text) {
  if (!engine.is_plugin) {
    std::error_code error;
    fs::create_directory_symlink(fs::path(engine.folder) / "node_modules", folder / "node_modules", error);
    return run_program(node(), {"--test", folder.file("finding.test.mjs", text)});
  }
  const std::size_t begin = text.find("g++ ");
  std::string build = text.substr(begin, text.find('\n', begin) - begin);
  const std::string source = folder.file("test.cpp", text), program = (folder / "test").string();
  build.replace(build.find("test.cpp"), 8, shell_quoted(source));
  return run_program(
      "sh", {"-c", fmt::format("{} -O0 -o {} && exec {}", build, shell_quoted(program), shell_quoted(program))});
}

std::string said(const Ran& ran) { return ran.out + ran.err; }

class EmitTestForEngine : public testing::TestWithParam<Engine> {};

TEST_P(EmitTestForEngine, FailsAsSaidAndPassesWithARightAnswer) {
  const Engine& engine = GetParam();
  if (!engine.is_installed) GTEST_SKIP() << engine.name << ": engine not installed";
  const std::vector<Wanted> ledger = ledger_of(engine);
  if (ledger.empty()) GTEST_SKIP() << engine.name << ": the ledger has no case of it";
  for (const auto& [stored, expected] : ledger) {
    SCOPED_TRACE(stored.file);
    const Ran emitted = nearmiss({"emit-test", "--for", engine.name, stored.file.string()});
    ASSERT_EQ(emitted.exit_code, 0) << emitted.err;
    const TemporaryFolder folder;
    const Ran wrong = run_emitted(folder, engine, emitted.out);
    EXPECT_NE(wrong.exit_code, 0) << said(wrong);
    std::string fault = expected.disagreement;
    std::replace(fault.begin(), fault.end(), ' ', '-');
    const std::string words = expected.verdict == "broke" ? "" : "FAILED: " + fault;
    EXPECT_NE(said(wrong).find(words), std::string::npos) << said(wrong);
    const Ran right = run_emitted(folder, engine, answered_rightly(emitted.out, stored.question, !engine.is_plugin));
    EXPECT_EQ(right.exit_code, 0) << said(right) << emitted.out;
    if (engine.is_plugin || !fault.starts_with("false-")) continue;
    const Ran bare = run_emitted(folder, engine, decided_rightly(emitted.out, stored.question));
    EXPECT_EQ(bare.exit_code, 0) << "an engine need not give every number: " << said(bare) << emitted.out;
  }
}

/// The parts of a subject that a test for each of its queries needs are all there.
TEST_P(EmitTestForEngine, HasEveryNameThatItUses) {
  const Engine& engine = GetParam();
  const TemporaryFolder folder;
  std::string files;
  std::size_t count = 0;
  for (const Query& query : catalogue()) {
    const std::string name(query.name);
    const std::vector<fs::path> seeds = cases_in(corpus_folder() / "seeds" / name);
    Asking asking;
    try {
      asking = ask_engine(read_stored_case(seeds.at(0)).question, engine);
    } catch (const BadInput& e) {
      EXPECT_NE(std::string(e.what()).find("has no function for " + name), std::string::npos) << e.what();
      continue;
    }
    ++count;
    EXPECT_EQ(asking.helpers.find("answerBy"), std::string::npos) << asking.helpers;
    EXPECT_EQ((asking.includes + asking.helpers).find("nearmiss"), std::string::npos) << asking.helpers;
    files += folder.file(name + ".mjs", asking.includes + asking.helpers + "{\n" + asking.statements + "}\n") + "\n";
  }
  EXPECT_GE(count, 4u);
  if (engine.is_plugin) return;  // the compiler says it of each test
  if (node().empty()) GTEST_SKIP() << "this system has no node";
  fs::create_directory_symlink(fs::path(engine.folder) / "node_modules", folder / "node_modules");
  constexpr const char* check = R"(
import fs from "node:fs";
import vm from "node:vm";
const [list, isInstalled] = process.argv.slice(-2);
for (const file of fs.readFileSync(list, "utf8").split("\n").filter(Boolean)) {
  try {
    new vm.SourceTextModule(fs.readFileSync(file, "utf8"), { identifier: file });
    if (isInstalled === "1") await import(file);
  } catch (error) {
    const isRefusal = error.why || error.message.startsWith("no answer: ");
    if (!isRefusal) console.log("not understood:", file, error);
  }
}
console.log("checked");
)";
  const Ran ran = run_program(node(), {"--experimental-vm-modules", folder.file("check.mjs", check),
                                       folder.file("list", files), engine.is_installed ? "1" : "0"});
  EXPECT_EQ(ran.out.find("not understood:"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("checked\n"), std::string::npos) << ran.out << ran.err;
}

INSTANTIATE_TEST_SUITE_P(Engines, EmitTestForEngine, testing::ValuesIn(engines_by_name()), [](const auto& i) {
  std::string name = i.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// A subject of an engine that is not there, and its wrong answer to a case of the ledger.
struct Wrong {
  std::string file, version;
  Answer answer;
};
EmittedTest emitted_for(const Wrong& wrong) {
  const Case question = read_stored_case(corpus_folder() / "upstream" / wrong.file).question;
  Subject subject;
  subject.name = wrong.file.substr(0, wrong.file.find('/'));
  subject.version = wrong.version;
  subject.scalar = question.scalar;
  subject.offerings.emplace_back().query = question.query->name;
  Workers workers;
  return emit_test(examine(question, subject, wrong.answer, workers), subject);
}
Answer gives(bool yes, std::uint64_t given, std::initializer_list<double> values) {
  Answer a;
  a.yes = yes, a.given = given, a.count = std::uint8_t(values.size());
  std::copy(values.begin(), values.end(), a.values.begin());
  return a;
}

/// Where the answer is right, the test passes, until the answer is changed.
TEST(EmitTest, AnEngineThatIsRightPasses) {
  for (const Engine& engine : engines()) {
    if (engine.name != "embree-robust") continue;
    if (!engine.is_installed) GTEST_SKIP() << engine.name << ": engine not installed";
    const Ran emitted = nearmiss({"emit-test", "--for", engine.name,
                                  (corpus_folder() / "seeds/moving_point_triangle/hit-oblique.json").string()});
    ASSERT_EQ(emitted.exit_code, 0) << emitted.err;
    EXPECT_NE(emitted.out.find("\"robust\") == \"robust\""), std::string::npos) << emitted.out;
    const TemporaryFolder folder;
    const Ran right = run_emitted(folder, engine, emitted.out);
    EXPECT_EQ(right.exit_code, 0) << said(right);
    const std::string late = with_replaced(emitted.out, "got_time = answer", ".values", "got_time = 1.001 * answer");
    const Ran wrong = run_emitted(folder, engine, late);
    EXPECT_EQ(wrong.exit_code, 1) << said(wrong);
  }
}

/// What is stored is what is written; a difference says where the new file is.
void expect_stored(const std::string& name, std::string text) {
  const std::string now = fmt::format("Nearmiss {}.", version());
  if (const std::size_t at = text.find(now); at != std::string::npos) text.replace(at, now.size(), "Nearmiss VERSION.");
  const fs::path stored = fs::path(source_folder()) / "reports/tests/emitted" / name;
  EXPECT_EQ(text, read_file(stored)) << "where that is intended, it goes to " << stored;
}

TEST(EmitTest, AnEnginesFileIsAsStored) {
  expect_stored("cannon-es.mjs.txt", emitted_for({"cannon-es/ball-on-an-edge.json", "cannon-es 0.20.0",
                                                  gives(true, 0b1111, {1, -1, 0, 0, 0, 0, 0})})
                                         .text);
  expect_stored("gts.cpp.txt",
                emitted_for({"gts/ball-over-an-obtuse-triangle.json", "GTS 0.7.6", gives(false, 0, {})}).text);
}

/// A call of JavaScript that does not return is ended from outside.
TEST(EmitTest, AnEnginesTestEndsThatWouldNotEnd) {
  const EmittedTest emitted = emitted_for({"cannon-es/ball-on-an-edge.json", "cannon-es 0.20.0",
                                           Answer::without(Answer::Status::broke, "too late", BreakCause::time_limit)});
  EXPECT_EQ(emitted.build, "npm install cannon-es@0.20.0 && timeout 10 node finding.test.mjs");
  EXPECT_NE(emitted.text.find(emitted.build), std::string::npos) << emitted.text;
}

}  // namespace
}  // namespace nearmiss
