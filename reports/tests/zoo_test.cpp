/// Subjects that misbehave in every known way. Each test checks the reported reason, the affected cases, and that
/// another subject in the same run has exactly its usual counts.
#include <gtest/gtest.h>
#include <sys/shm.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "corpus/storage/codec.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* late = "no answer within";
constexpr const char* no_hello = "no hello within";

/// The expected result of a misdeed.
enum class End {
  refused,   ///< exit code 2 and one line, before the first case
  differs,   ///< the same, at the second start
  broke,     ///< cases that broke, with the reason
  given_up,  ///< cases that broke, until the subject is given up
  either,    ///< one or the other: by the time it is looked at, all may be answered, and what is done after that is no
             ///< matter
  judged,    ///< no case breaks; the answers are judged as usual
};

struct Misdeed {
  const char* name;  ///< its name in NEARMISS_ZOO
  End end;
  const char* says;  ///< a part of the line, or of every reason
};

void PrintTo(const Misdeed& m, std::ostream* out) { *out << m.name; }

/// Seconds of processor time for a case, and five times as many of wall time: few where the misdeed is to be late, more
/// than a busy machine needs where it is another one.
const char* patience_of(const Misdeed& m) {
  const std::string says = m.says;
  if (m.end == End::judged) return "4";
  return says == late || says == no_hello || says.empty() ? "0.04" : "4";
}

std::vector<std::string> zoo(bool plugin) {
  if (plugin) return {"--plugin", plugin_file("zoo")};
  return {"--command", zoo_program()};
}

/// A run of the zoo beside a well-behaved subject, or of that subject alone.
std::vector<std::string> a_run(const std::vector<std::string>& of, const char* patience, const fs::path& out) {
  std::vector<std::string> arguments{"run", "--patience", patience};
  arguments.insert(arguments.end(), of.begin(), of.end());
  for (const char* more :
       {"-q", "sphere_sphere_overlap", "-s", "collide-fast-double", "--cases", "150", "--seed", "11", "--out"}) {
    arguments.emplace_back(more);
  }
  arguments.push_back(out.string());
  return arguments;
}

json tally_of(const json& index, const std::string& subject) {
  for (const json& t : index.at("tallies")) {
    if (t.at("subject") == subject) return t;
  }
  return nullptr;
}

void expect_to_cost_only_itself(const Misdeed& m, bool plugin) {
  const TemporaryFolder folder;
  const std::string mark = new_mark();
  std::vector<std::string> of = zoo(plugin);
  of.insert(of.end(), {"-s", "zoo"});
  fs::create_directory(folder / "marks");
  fs::permissions(folder / "marks", fs::perms::all);  // a host may be of another user
  const Ran ran =
      nearmiss(a_run(of, patience_of(m), folder / "r"),
               {std::string("NEARMISS_ZOO=") + m.name, mark, "NEARMISS_ZOO_MARK=" + (folder / "marks/mark").string()});
  EXPECT_TRUE(nothing_is_left(mark)) << "something that it started lives";
  EXPECT_LT(shmget(0x4e4d, 0, 0), 0) << "its shared memory is left";
  for (const std::string* text : {&ran.out, &ran.err}) {
    EXPECT_EQ(for_terminal(*text), *text);
    EXPECT_FALSE(text->starts_with("INJECTED") || text->find("\nINJECTED") != std::string::npos) << *text;
  }
  if (m.end == End::refused || m.end == End::differs) {
    EXPECT_EQ(ran.exit_code, 2) << ran.out << ran.err;
    EXPECT_TRUE(ran.out.empty() || m.end == End::differs) << ran.out;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_TRUE(ran.err.starts_with("nearmiss: " + zoo(plugin)[1] + ": ")) << ran.err;
    EXPECT_NE(ran.err.find(m.says), std::string::npos) << ran.err;
    EXPECT_LT(ran.err.size(), 1500u);
    return;
  }
  ASSERT_LE(ran.exit_code, 1) << ran.out << ran.err;
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  static const json usual = [] {
    const TemporaryFolder alone;
    const Ran innocent = nearmiss(a_run({}, "4", alone / "r"));
    EXPECT_EQ(innocent.exit_code, 0) << innocent.err;
    return tally_of(json::parse(read_file(alone / "r" / "index.json")), "collide-fast-double");
  }();
  EXPECT_EQ(tally_of(index, "collide-fast-double"), usual) << "another subject pays for it";
  const json own = tally_of(index, "zoo");
  if (m.end == End::judged) {
    EXPECT_EQ(own.at("verdicts").at("broke"), 0) << own.at("breakages");
    EXPECT_EQ(own.at("cases"), 150);
    return;
  }
  EXPECT_EQ(own.at("cases").get<int>() + own.at("gave_up").get<int>(), 150);
  if (m.end == End::either) return;
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_GE(own.at("verdicts").at("broke"), 1);
  EXPECT_EQ(own.at("gave_up") > 0, m.end == End::given_up);
  EXPECT_EQ(ran.out.find("and was not asked") != std::string::npos, m.end == End::given_up) << ran.out;
  EXPECT_EQ(own.contains("given_up"), m.end == End::given_up) << own;
  int reports = 0;
  for (const json& listed : index.at("reports")) {
    if (listed.at("subject") != "zoo") continue;
    const json report = json::parse(read_file(folder / "r" / listed.at("file").get<std::string>()));
    EXPECT_EQ(complaints(report, "report.schema.json"), "");
    if (report.at("finding").at("verdict") != "broke") continue;
    ++reports;
    EXPECT_NE(report.at("answer").at("reason").get<std::string>().find(m.says), std::string::npos)
        << report.at("answer");
  }
  EXPECT_GE(reports, 1);
}

class Plugin : public testing::TestWithParam<Misdeed> {};
TEST_P(Plugin, CostsOnlyItself) { expect_to_cost_only_itself(GetParam(), true); }

class Program : public testing::TestWithParam<Misdeed> {};
TEST_P(Program, CostsOnlyItself) { expect_to_cost_only_itself(GetParam(), false); }

const Misdeed at_load[] = {
    {"load-exit-0", End::refused, "left with exit code 0"},
    {"load-exit-1", End::refused, "left with exit code 1"},
    {"load-quick-exit", End::refused, "left with exit code 7"},
    {"load-abort", End::refused, "killed by signal 6"},
    {"load-assertion", End::refused, "balls.c:42"},
    {"load-segfault", End::refused, "killed by signal 11"},
    {"load-floating-trap", End::refused, "killed by signal 8"},
    {"load-terminates-itself", End::refused, "killed by signal 15"},
    {"load-kills-itself", End::refused, "killed by signal 9"},
    {"load-stack", End::refused, "killed by signal 11"},
    {"load-memory", End::refused, "killed by signal 6"},
    {"load-spins", End::refused, no_hello},
    {"load-takes-a-while", End::judged, ""},
    {"load-sleeps", End::refused, no_hello},
    {"load-stops-itself", End::refused, no_hello},
    {"load-blocks-signals-and-spins", End::refused, no_hello},
    {"load-ignores-signals-and-sleeps", End::refused, no_hello},
    {"load-closes-files-and-sleeps", End::refused, "closed the pipe before it said hello"},
    {"load-execs-true", End::refused, "left with exit code 0"},
    {"load-leaves-a-child", End::refused, "killed by signal 6"},
    {"load-leaves-a-session", End::refused, "killed by signal 6"},
    {"load-leaves-an-orphan", End::refused, "killed by signal 6"},
    {"load-leaves-an-orphan-and-spins", End::refused, no_hello},
    {"load-kills-its-group", End::refused, "killed by signal 9"},
    {"load-noise-to-judge", End::refused, "no hello"},
    {"load-floods-judge", End::refused, "its hello has more than 1,048,576 bytes"},
    {"load-escapes-to-output", End::refused, "\\x1b[2J"},
    {"load-keeps-output-in-buffer", End::judged, ""},
    {"load-changes-folder", End::judged, ""},
};

const Misdeed when_asked[] = {
    {"ask-exit-0", End::broke, "left with exit code 0"},
    {"ask-exit-1", End::broke, "left with exit code 1"},
    {"ask-quick-exit", End::broke, "left with exit code 7"},
    {"ask-abort", End::broke, "killed by signal 6"},
    {"ask-assertion", End::broke, "Assertion `radius > 0' failed"},
    {"ask-segfault", End::broke, "killed by signal 11"},
    {"ask-bus-error", End::broke, "killed by signal 7"},
    {"ask-illegal", End::broke, "killed by signal 4"},
    {"ask-floating-trap", End::broke, "killed by signal 8"},
    {"ask-terminates-itself", End::broke, "killed by signal 15"},
    {"ask-kills-itself", End::broke, "killed by signal 9"},
    {"ask-stack", End::broke, "killed by signal 11"},
    {"ask-memory", End::broke, "killed by signal 6"},
    {"ask-spins", End::broke, late},
    {"ask-sleeps", End::broke, late},
    {"ask-stops-itself", End::broke, late},
    {"ask-blocks-signals-and-spins", End::broke, late},
    {"ask-ignores-signals-and-sleeps", End::broke, late},
    {"ask-closes-files", End::either, ""},
    {"ask-closes-files-and-sleeps", End::broke, "hung up"},
    {"ask-closes-pipes-and-spins", End::broke, "hung up"},
    {"ask-leaves-a-child", End::broke, "killed by signal 6"},
    {"ask-leaves-a-session", End::broke, "killed by signal 6"},
    {"ask-leaves-an-orphan", End::broke, "killed by signal 6"},
    {"ask-leaves-an-orphan-and-exits", End::broke, "left with exit code 0"},
    {"ask-leaves-an-orphan-and-spins", End::broke, late},
    {"ask-leaves-group", End::broke, late},
    {"ask-leaves-shared-memory", End::broke, "killed by signal 6"},
    {"ask-many-children", End::broke, "killed by signal 6"},
    {"ask-kills-its-group", End::broke, "killed by signal 9"},
    {"ask-kills-its-parent", End::broke, "killed by signal 6"},
    {"ask-stops-its-parent", End::broke, "killed by signal 6"},
    {"ask-terminates-its-parent", End::broke, ""},
    {"ask-traces-its-parent", End::broke, ""},
    {"ask-alarm", End::broke, ""},
    {"ask-writes-to-its-input", End::broke, "killed by signal 6"},
    {"ask-noise-to-judge", End::broke, ""},
    {"ask-nul-to-judge", End::broke, ""},
    {"ask-floods-judge", End::broke, ""},
    {"ask-floods-output", End::broke, "killed by signal 6"},
    {"ask-floods-error", End::broke, "killed by signal 6"},
    {"ask-escapes-to-output", End::broke, ""},
    {"ask-json-to-output", End::broke, "killed by signal 6"},
    {"ask-keeps-output-in-buffer", End::judged, ""},
    {"ask-reads-its-input", End::broke, "standard input is empty"},
    {"ask-fills-the-disk", End::broke, "wrote 16777216 bytes"},
    {"ask-changes-folder", End::judged, ""},
    {"ask-limits", End::judged, ""},
    {"ask-thread-that-crashes", End::broke, "killed by signal 11"},
    {"always-sleeps", End::given_up, late},
};

const Misdeed of_plugins[] = {
    {"load-rounds-upward", End::judged, ""},
    {"entry-exit-0", End::refused, "left with exit code 0"},
    {"entry-segfault", End::refused, "killed by signal 11"},
    {"entry-spins", End::refused, no_hello},
    {"told-nothing", End::refused, "returns no description"},
    {"told-wild", End::refused, "killed by signal 11"},
    {"told-version", End::refused, "made for version 99"},
    {"told-scalar", End::refused, "its scalar is 9"},
    {"told-no-name", End::refused, "its name is ''"},
    {"told-bad-name", End::refused, "its name is 'Zoo \\x1b[31m'"},
    {"told-long-name", End::refused, "its name is 'aaaa"},
    {"told-name-without-end", End::refused, "killed by signal 11"},
    {"told-taken-name", End::refused, "there is a subject 'collide-fast-double' already"},
    {"told-count", End::refused, "offers, more than 4096"},
    {"told-count-beyond", End::refused, ""},
    {"told-no-offers", End::refused, "it counts offers and has none"},
    {"told-wild-offers", End::refused, "killed by signal 11"},
    {"told-twice", End::refused, "offers sphere_sphere_overlap twice"},
    {"told-no-query", End::refused, "the query ''"},
    {"told-wild-query", End::refused, "killed by signal 11"},
    {"told-unknown-query", End::refused, "'sphere_sphere_overlaps'"},
    {"told-no-function", End::refused, "without a function"},
    {"told-wild-function", End::given_up, "killed by signal 11"},
    {"always-abort", End::given_up, "killed by signal 6"},
    {"told-inputs", End::refused, "sphere_sphere_overlap has 8 inputs"},
    {"told-outputs", End::refused, "1073741824 outputs"},
    {"told-needs", End::refused, "no such bit"},
    {"told-contract", End::refused, "neither a number nor null"},
    {"told-wild-contract", End::refused, "killed by signal 11"},
    {"told-otherwise", End::differs, "its hello differs from that of its first start: version was \"1\" and is \"2\""},
    {"told-crash-later", End::given_up, "killed by signal 6"},
    {"told-hang-later", End::given_up, no_hello},
    {"answer-status", End::broke, "returned 7"},
    {"answer-yes", End::judged, ""},
    {"answer-reason-without-end", End::judged, ""},
    {"answer-nan", End::judged, ""},
    {"answer-too-much", End::broke, ""},
    {"ask-forks-for-ever", End::broke, ""},
    {"ask-execs-sleep", End::broke, "hung up"},
    {"ask-says-done", End::broke, "says that all is done"},
    {"ask-scribbles", End::broke, "wrote over the memory"},
    {"ask-scribbles-zeros", End::broke, "wrote over the memory"},
    {"ask-scribbles-for-ever", End::either, ""},
    {"ask-seals-answers", End::broke, "killed by signal 6"},
    {"ask-shrinks-shared-memory", End::broke, "killed by signal 6"},
    {"ask-writes-cases", End::broke, "the cases cannot be written"},
};

const Misdeed of_programs[] = {
    {"hello-nothing", End::refused, "is no JSON"},
    {"hello-noise", End::refused, "\\x80\\x81"},
    {"hello-list", End::refused, "its hello is no object"},
    {"hello-deep", End::refused, "nested more than 64 deep"},
    {"hello-deep-requirement", End::refused, "nested more than 64 deep"},
    {"hello-endless", End::refused, "more than 1,048,576 bytes"},
    {"hello-version", End::refused, "speaks version 4"},
    {"hello-no-version", End::refused, "no \"nearmiss\""},
    {"hello-refused", End::refused, "no license \\x1b[31m found"},
    {"hello-typo", End::refused, "'nmae'"},
    {"hello-name", End::refused, "'../zoo'"},
    {"hello-scalar", End::refused, "'half'"},
    {"hello-shared", End::refused, "'shared'"},
    {"hello-offers", End::refused, "\"offers\" is no list"},
    {"hello-inputs", End::refused, "\"inputs\" is no whole number"},
    {"hello-contract", End::refused, "none may be below 0"},
    {"hello-requires", End::refused, "'luck'"},
    {"hello-binary", End::given_up, ""},
    {"hello-name-dash", End::refused, "its name is '-'"},
    {"hello-name-option", End::refused, "its name is '--help'"},
    {"hello-name-word", End::refused, "its name is 'added'"},
    {"hello-name-twice", End::refused, "'name' twice"},
    {"hello-offer-twice", End::refused, "'query' twice"},
    {"hello-gives", End::refused, "it gives 'nomral' for moving_point_triangle, whose outputs are: time, location.x"},
    {"hello-gives-number", End::refused, "it gives '3'"},
    {"hello-drips-without-end", End::refused, no_hello},
    {"hello-otherwise", End::differs, "its hello differs from that of its first start: version was \"1\" and is \"2\""},
    {"hello-and-noise", End::given_up, "more than its hello"},
    {"hello-and-answer", End::given_up, "more than its hello"},
    {"hello-twice", End::given_up, "more than its hello"},
    {"always-exit-1", End::given_up, "left with exit code 1"},
    {"reply-nothing", End::broke, "no JSON"},
    {"reply-noise", End::broke, "no JSON"},
    {"reply-list", End::broke, "no object"},
    {"reply-empty", End::broke, "without \"yes\""},
    {"reply-yes", End::broke, "neither true nor false"},
    {"reply-values", End::broke, "no list of 0 numbers"},
    {"reply-cannot", End::broke, "\"cannot\" is no text"},
    {"reply-cannot-and-yes", End::broke, "beside"},
    {"reply-unknown", End::broke, "'time', which is none of"},
    {"reply-without-case", End::broke, "without \"case\""},
    {"reply-other-case", End::broke, "an answer to case 7"},
    {"reply-none", End::broke, ""},
    {"reply-twice", End::broke, ""},
    {"reply-and-next", End::broke, ""},
    {"reply-long", End::broke, "a line without end"},
    {"reply-drips", End::broke, late},
    {"reply-without-end", End::broke, late},
    {"reply-unflushed", End::given_up, late},
};

/// A misdeed that is run beside many others, in one run of the command line.
struct OfCrowd {
  const char* name;
  int least, most;   ///< how often the subject breaks
  const char* says;  ///< a part of every reason
};

constexpr int crowd_cases = 400;
/// The most breakages of a misdeed that depends on the number of calls or requests, which depend on the machine's load.
constexpr int some = crowd_cases / 4;
constexpr const char* not_again = "in a batch, not again alone";

/// Runs all at once. Each subject breaks as often as it does its misdeed, and all its other answers are judged as those
/// of the same subject without a misdeed: nothing is lost, nothing is forged.
void expect_each_to_cost_only_itself(const std::vector<OfCrowd>& crowd, bool plugins) {
  const TemporaryFolder folder;
  const std::string mark = new_mark();
  std::vector<std::string> arguments{"run", "--patience", "0.2"};  // some of a crowd are late
  const auto add = [&](const std::string& misdeed) {
    if (plugins) {
      const fs::path file = folder / ("zoo-" + misdeed + ".so");
      fs::copy_file(plugin_file("zoo"), file);
      arguments.insert(arguments.end(), {"--plugin", file.string()});
    } else {
      arguments.insert(arguments.end(), {"--command", zoo_program() + " " + misdeed});
    }
    arguments.insert(arguments.end(), {"-s", "zoo-" + misdeed});
  };
  for (const OfCrowd& m : crowd) add(m.name);
  add("well-behaved");
  for (const char* more : {"-q", "sphere_sphere_overlap", "--seed", "11", "--cases"}) arguments.emplace_back(more);
  arguments.insert(arguments.end(), {std::to_string(crowd_cases), "--out", (folder / "r").string()});
  const fs::path marks = folder / "marks";  // a subject may have a user of its own
  fs::create_directory(marks);
  fs::permissions(marks, fs::perms::all);
  const Ran ran = nearmiss(arguments, {mark, "NEARMISS_ZOO_MARK=" + (marks / "mark").string()});
  EXPECT_TRUE(nothing_is_left(mark)) << "something that they started lives";
  ASSERT_LE(ran.exit_code, 1) << ran.out << ran.err;
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  const json usual = tally_of(index, "zoo-well-behaved");
  EXPECT_EQ(usual.at("verdicts").at("broke"), 0);
  for (const OfCrowd& m : crowd) {
    const json own = tally_of(index, std::string("zoo-") + m.name);
    const int broke = own.at("verdicts").at("broke");
    EXPECT_GE(broke, m.least) << own;
    EXPECT_LE(broke, m.most) << own;
    EXPECT_EQ(own.at("cases"), crowd_cases) << own;
    EXPECT_EQ(own.at("gave_up"), 0) << own;
    for (const auto& [reason, count] : own.at("breakages").items()) {
      EXPECT_NE(reason.find(m.says), std::string::npos) << m.name << " says " << reason;
    }
    for (const auto& [verdict, count] : usual.at("verdicts").items()) {
      if (verdict == "broke") continue;
      EXPECT_LE(own.at("verdicts").at(verdict), count) << m.name << ", " << verdict;
    }
    EXPECT_EQ(own.at("verdicts").at("cannot answer"), 0) << m.name;
  }
}

/// Runs them in crowds of ten, for each worker holds some files open.
void expect_all_to_cost_only_themselves(const std::vector<OfCrowd>& all, bool plugins) {
  constexpr std::size_t at_once = 10;
  for (std::size_t at = 0; at < all.size(); at += at_once) {
    const auto begin = all.begin() + std::ptrdiff_t(at);
    expect_each_to_cost_only_itself({begin, begin + std::ptrdiff_t(std::min(at_once, all.size() - at))}, plugins);
  }
}

TEST(Zoo, CrowdOfPlugins) {
  expect_all_to_cost_only_themselves(
      {
          {"ask-abort", 10, 10, "killed by signal 6"},
          {"ask-scribbles", 10, 10, "wrote over the memory"},
          {"ask-scribbles-zeros", 10, 10, "wrote over the memory"},
          {"ask-counts-more", 10, 10, "wrote over the memory"},
          {"ask-counts-from-the-start", 10, 10, "wrote over the memory"},
          {"ask-scribbles-behind-the-count", 10, 10, "wrote over the memory"},
          {"ask-clears-behind-the-count", 10, 10, "wrote over the memory"},
          {"ask-copies-answers", 0, some, "wrote over the memory"},
          {"ask-unmaps-answers", 10, 10, "killed by signal 11"},
          {"ask-protects-answers", 10, 10, "killed by signal 11"},
          {"ask-replaces-answers", 1, some, "says that all is done"},
          {"ask-closes-its-pipe-and-lives-on", 1, some, ""},
          {"ask-child-holds-the-pipe", 10, 10, "killed by signal 6"},
          {"ask-child-lives-on", 0, 0, ""},
          {"ask-exits-in-a-child", 0, 0, ""},
          {"ask-speaks-on-stdout", 0, 0, ""},
          {"ask-frees-twice", 10, 10, "double free"},
          {"ask-leaks", 2, 2, "killed by signal 6"},
          {"ask-profiles-itself", 10, 10, "killed by signal 27"},
          {"ask-divides-by-zero", 10, 10, "killed by signal 8"},
          {"ask-runs-data", 10, 10, "killed by signal 11"},
          {"ask-breaks-a-pipe", 10, 10, "killed by signal 13"},
          {"ask-lowers-its-priority", 0, 0, ""},
          {"ask-many-threads", 0, 0, ""},
          {"ask-opens-every-file", 0, 0, ""},
          {"seldom-points-the-pipe-elsewhere", 1, some, ""},
          {"seldom-waits-for-a-request", 2, 2, "no answer in time"},
          {"seldom-backtracks", 2, 2, "no answer in time"},
          {"seldom-stops-itself", 2, 2, "no answer in time"},
          {"seldom-sleeps", 2, 2, "no answer in time"},
          {"seldom-says-done-twice", 1, some, ""},
          {"seldom-noise-once", 1, some, ""},
          {"once-abort", 1, 1, "killed by signal 6"},
          {"once-sleeps", 1, 1, "no answer in time"},
      },
      true);
}

TEST(Zoo, CrowdOfPrograms) {
  expect_all_to_cost_only_themselves(
      {
          {"ask-abort", 1, some, "killed by signal 6"},
          {"ask-closes-its-pipe-and-lives-on", 1, some, ""},
          {"ask-child-holds-the-pipe", 1, some, "killed by signal 6"},
          {"ask-child-lives-on", 0, 0, ""},
          {"ask-exits-in-a-child", 1, some, ""},
          {"ask-speaks-on-stdout", 0, 0, ""},
          {"ask-frees-twice", 1, some, "double free"},
          {"ask-leaks", 1, some, "killed by signal 6"},
          {"ask-lowers-its-priority", 0, 0, ""},
          {"ask-many-threads", 0, 0, ""},
          {"ask-opens-every-file", 0, 0, ""},
          {"seldom-points-the-pipe-elsewhere", 1, some, ""},
          {"seldom-waits-for-a-request", 1, some, ""},
          {"seldom-backtracks", 1, some, ""},
          {"seldom-stops-itself", 1, some, ""},
          {"seldom-sleeps", 1, some, ""},
          {"seldom-noise-once", 1, some, ""},
          {"once-abort", 1, 1, not_again},
          {"once-sleeps", 1, 1, "late in a batch, not again alone"},
          {"once-noise-once", 1, 1, not_again},
          {"reply-key-twice", 10, 10, "'yes' twice"},
          {"reply-case-twice", 1, some, "'case' twice"},
          {"reply-key-in-escapes-twice", 10, 10, "'yes' twice"},
          {"reply-case-negative", 1, some, "without \"case\""},
          {"reply-case-fraction", 1, some, "without \"case\""},
          {"reply-case-text", 1, some, "without \"case\""},
          {"reply-case-huge", 1, some, ""},
          {"reply-mark", 1, some, "no JSON"},
          {"reply-two-on-a-line", 1, some, "no JSON"},
          {"reply-two-of-one-line", 1, some, "no JSON"},
          {"reply-beside-noise", 1, some, "no JSON"},
          {"reply-cut", 1, some, "left with exit code 0"},
          {"reply-cut-and-killed", 1, some, "killed by signal 9"},
          {"reply-in-pieces", 0, 0, ""},
          {"reply-with-returns", 0, 0, ""},
          {"reply-of-next", 1, some, "an answer to case"},
          {"reply-thousand-times", 1, some, ""},
          {"reply-and-exit", 1, some, "left with exit code 0"},
          {"reply-and-noise", 1, some, ""},
          {"hello-drips", 0, 0, ""},
          {"hello-reordered", 0, 0, ""},
      },
      false);
}
/// Texts that mean something to a terminal, a compiler, a browser, a shell or a reader of files.
const Misdeed texts_of_plugins[] = {
    {"text-version-comment", End::judged, ""},
    {"text-version-lines", End::judged, ""},
    {"text-version-markdown", End::judged, ""},
    {"text-version-html", End::judged, ""},
    {"text-version-escapes", End::judged, ""},
    {"text-version-not-utf8", End::judged, ""},
    {"text-version-long", End::refused, "bytes, more than 500"},
    {"text-equivalence-trigraph", End::judged, ""},
    {"text-equivalence-json", End::judged, ""},
    {"text-equivalence-separator", End::judged, ""},
    {"text-why-shell", End::judged, ""},
    {"text-why-direction", End::judged, ""},
    {"text-why-escapes", End::judged, ""},
    {"text-error-lines", End::broke, "killed by signal 6"},
    {"text-error-cdata", End::broke, "killed by signal 6"},
    {"text-error-formula", End::broke, "killed by signal 6"},
    {"text-error-formats", End::broke, "killed by signal 6"},
    {"text-error-not-utf8", End::broke, "killed by signal 6"},
    {"text-error-long", End::broke, "killed by signal 6"},
    {"text-error-nul", End::broke, "killed by signal 6"},
    {"text-name-escapes", End::refused, "its name is '\\x1b[2J"},
};

const Misdeed texts_of_programs[] = {
    {"text-version-comment", End::judged, ""},
    {"text-version-separator", End::judged, ""},
    {"text-version-not-utf8", End::refused, "is no JSON"},
    {"text-how-html", End::judged, ""},
    {"text-how-formats", End::judged, ""},
    {"text-why-json", End::judged, ""},
    {"text-why-lines", End::judged, ""},
    {"text-error-escapes", End::broke, "killed by signal 6"},
    {"text-error-long", End::broke, "killed by signal 6"},
    {"text-refused-lines", End::refused, "1\\x0a#error INJECTED"},
};

std::string name_of_test(const testing::TestParamInfo<Misdeed>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(AtLoad, Plugin, testing::ValuesIn(at_load), name_of_test);
INSTANTIATE_TEST_SUITE_P(WhenAsked, Plugin, testing::ValuesIn(when_asked), name_of_test);
INSTANTIATE_TEST_SUITE_P(OfPlugins, Plugin, testing::ValuesIn(of_plugins), name_of_test);
INSTANTIATE_TEST_SUITE_P(AtLoad, Program, testing::ValuesIn(at_load), name_of_test);
INSTANTIATE_TEST_SUITE_P(WhenAsked, Program, testing::ValuesIn(when_asked), name_of_test);
INSTANTIATE_TEST_SUITE_P(OfPrograms, Program, testing::ValuesIn(of_programs), name_of_test);
INSTANTIATE_TEST_SUITE_P(Texts, Plugin, testing::ValuesIn(texts_of_plugins), name_of_test);
INSTANTIATE_TEST_SUITE_P(Texts, Program, testing::ValuesIn(texts_of_programs), name_of_test);

}  // namespace
}  // namespace nearmiss
