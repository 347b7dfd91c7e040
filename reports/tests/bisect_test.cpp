/// The commit that brought a finding: of a small library with a history, driven as a user would.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/tests/program.hpp"

namespace nearmiss {
namespace {

/// A plugin for sphere_sphere_overlap; `decide` is the right side of its decision.
std::string plugin_source(const std::string& decide) {
  return R"c(#include <math.h>
#include "nearmiss_plugin.h"
static int overlap(const double* in, size_t count, nearmiss_answer* answer) {
  double x = in[0] - in[4], y = in[1] - in[5], z = in[2] - in[6], reach = in[3] + in[7];
  answer->yes = x * x + y * y + z * z <= )c" +
         decide + R"c(;
  (void)reach;
  (void)count;
  return NEARMISS_ANSWERED;
}
static const nearmiss_contract promised = {
    .backward = 16, .forward = INFINITY, .unit = INFINITY, .lowest = -100, .highest = 100};
static const nearmiss_offer offers[] = {{"sphere_sphere_overlap", 8, 0, NULL, &promised, overlap, 0}};
static const nearmiss_plugin plugin = {NEARMISS_PLUGIN_VERSION, "spheres", "spheres 1", NEARMISS_DOUBLE, 1, offers};
const nearmiss_plugin* nearmiss_plugin_entry(void) { return &plugin; }
)c";
}

/// A library with a history of commits, and a report on its last one.
class BisectTest : public testing::Test {
 protected:
  static constexpr const char* right = "reach * reach";
  static constexpr const char* mistake = "in[3] * in[3]";

  void SetUp() override {
    std::filesystem::create_directories(folder_ / "repository");
    git({"init", "-q"});
    build_ = fmt::format("cc -shared -fPIC -I{} -o spheres.so spheres.c", source_folder() + "/impl/plugin");
  }
  void git(const std::vector<std::string>& words) {
    std::vector<std::string> all{"-C", repository(),     "-c", "user.name=a",
                                 "-c", "user.email=a@b", "-c", "commit.gpgsign=false"};
    all.insert(all.end(), words.begin(), words.end());
    const Ran ran = run_program("git", all);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    out_ = ran.out;
  }
  /// The hash of a new commit.
  std::string commit(const std::string& source, const std::string& message) {
    folder_.file("repository/spheres.c", source + "/* " + message + " */\n");
    git({"add", "spheres.c"});
    git({"commit", "-q", "-m", message});
    git({"rev-parse", "HEAD"});
    return out_.substr(0, 40);
  }
  std::string report() {
    const Ran built = run_program("sh", {"-c", "cd " + repository() + " && " + build_});
    EXPECT_EQ(built.exit_code, 0) << built.err;
    const std::string question = folder_.file("case.json", R"({"query": "sphere_sphere_overlap", "scalar": "double",
      "inputs": {"sphere1": {"center": [0, 0, 0], "radius": 1}, "sphere2": {"center": [1.5, 0, 0], "radius": 1}}})");
    const Ran ran =
        nearmiss({"replay", "--json", "--plugin", repository() + "/spheres.so", "--subject", "spheres", question});
    EXPECT_EQ(ran.exit_code, 1) << ran.err;
    return folder_.file("report.json", parse_json(ran.out, "replay").at(0).dump());
  }
  Ran bisect(const std::string& report, const std::string& good, const std::string& bad = "HEAD") {
    return nearmiss({"bisect", report, "--repository", repository(), "--good", good, "--bad", bad, "--build", build_,
                     "--plugin", "./spheres.so"});
  }
  std::string repository() const { return (folder_ / "repository").string(); }

  TemporaryFolder folder_;
  std::string build_, out_;
};

TEST_F(BisectTest, NamesTheCommitAndLeavesTheRepositoryAsItIs) {
  const std::string first = commit(plugin_source(right), "right");
  commit("#error\n", "cannot be built");
  for (int i = 0; i < 3; ++i) commit(plugin_source(right), fmt::format("still right {}", i));
  const std::string culprit = commit(plugin_source(mistake), "forgets a radius");
  for (int i = 0; i < 3; ++i) commit(plugin_source(mistake), fmt::format("still wrong {}", i));
  const std::string report = this->report();
  git({"status", "--porcelain", "--branch"});
  const std::string before = out_;

  const Ran ran = bisect(report, first);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(last_line(ran.out), culprit) << ran.out;
  EXPECT_NE(ran.out.find("with the finding, false miss  forgets a radius"), std::string::npos) << ran.out;

  git({"status", "--porcelain", "--branch"});
  EXPECT_EQ(out_, before);
  git({"worktree", "list"});
  EXPECT_EQ(std::count(out_.begin(), out_.end(), '\n'), 1) << out_;
}

TEST_F(BisectTest, NamesAllCommitsThatItCannotTellApart) {
  const std::string first = commit(plugin_source(right), "right");
  const std::string unknown = commit("#error\n", "cannot be built");
  const std::string wrong = commit(plugin_source(mistake), "wrong");
  const Ran ran = bisect(report(), first);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("is one of these:"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find(unknown), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find(wrong), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("unknown, it cannot be built"), std::string::npos) << ran.out;
}

TEST_F(BisectTest, RejectsEndsThatAreNotAsSaid) {
  const std::string first = commit(plugin_source(right), "right");
  const std::string last = commit(plugin_source(mistake), "wrong");
  const std::string report = this->report();
  const auto expect_error = [](const Ran& ran, const std::string& words) {
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_NE(last_line(ran.err).find(words), std::string::npos) << ran.err;
  };
  expect_error(bisect(report, last), "has the finding already: false miss");
  expect_error(bisect(report, first, first), "does not have the finding: agrees");
  expect_error(bisect(report, "no-such-revision"), "no-such-revision");
  expect_error(bisect((folder_ / "case.json").string(), first), "it is no report");
}

}  // namespace
}  // namespace nearmiss
