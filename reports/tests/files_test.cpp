/// Output files of every kind: regular ones are replaced in one step, links stay, and everything else is written into.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>

#include "corpus/files/files.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/run.hpp"
#include "reports/tests/mistaken_subject.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

/// What a reader of a pipe gets while `write` runs.
std::string read_while(const fs::path& pipe, const std::function<void()>& write) {
  std::future<std::string> reader = std::async(std::launch::async, [&] { return read_file(pipe); });
  write();
  return reader.get();
}

TEST(Files, ReplacesARegularFileInOneStep) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a", "one");
  const std::string other_name = (folder / "b").string();
  fs::create_hard_link(file, other_name);
  write_file(file, "two");
  EXPECT_EQ(read_file(file), "two");
  EXPECT_EQ(read_file(other_name), "one") << "the old content was overwritten in place";
}

TEST(Files, FollowsLinks) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  folder.file("sub/target", "one");
  fs::create_symlink("sub/target", folder / "link");
  fs::create_symlink(folder / "link", folder / "link to a link");
  fs::create_symlink("sub/new", folder / "link to nothing");
  write_file(folder / "link to a link", "two");
  write_file(folder / "link to nothing", "three");
  EXPECT_TRUE(fs::is_symlink(folder / "link") && fs::is_symlink(folder / "link to a link"));
  EXPECT_TRUE(fs::is_symlink(folder / "link to nothing"));
  EXPECT_EQ(read_file(folder / "sub/target"), "two");
  EXPECT_EQ(read_file(folder / "sub/new"), "three");
  fs::create_symlink("loop", folder / "loop");
  EXPECT_THROW(write_file(folder / "loop", "x"), IoError);
  EXPECT_THROW(check_can_write(folder / "loop"), IoError);
}

TEST(Files, WritesIntoPipesAndDevices) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("pipe", folder / "link");
  EXPECT_NO_THROW(check_can_write(pipe)) << "it opens the pipe, or waits";
  EXPECT_EQ(read_while(pipe, [&] { write_file(pipe, "text"); }), "text");
  EXPECT_EQ(read_while(pipe, [&] { write_file(folder / "link", "more"); }), "more");
  EXPECT_TRUE(fs::is_fifo(pipe));
  const fs::path device = folder / "null";
  if (mknod(device.c_str(), S_IFCHR | 0600, makedev(1, 3)) != 0) GTEST_SKIP() << "no device can be made here";
  if (const int opened = open(device.c_str(), O_WRONLY); opened < 0) {
    GTEST_SKIP() << "devices have no effect here";
  } else {  // NOLINT(readability-else-after-return)
    close(opened);
  }
  write_file(device, "text");
  EXPECT_TRUE(fs::is_character_file(device));
}

TEST(Files, WritesIntoAnOpenFileByItsNameInProc) {
  const TemporaryFolder folder;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const std::string by_name = "/proc/self/fd/" + std::to_string(ends[1]);
  EXPECT_NO_THROW(check_can_write(by_name));
  write_file(by_name, "text");
  close(ends[1]);
  EXPECT_EQ(read_file("/proc/self/fd/" + std::to_string(ends[0])), "text");
  close(ends[0]);
}

TEST(Files, SaysBeforehandWhatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string file = folder.file("file", "one");
  for (const fs::path& bad : {folder.path(), folder / "no folder" / "x", fs::path(file) / "x", fs::path("/dev/null/x"),
                              fs::path("/proc/self/fd/999"), folder / std::string(300, 'x')}) {
    EXPECT_THROW(check_can_write(bad), IoError) << bad;
    EXPECT_THROW(write_file(bad, "x"), IoError) << bad;
  }
  EXPECT_THROW(make_writable_folder(file), IoError);
  EXPECT_THROW(make_writable_folder("/dev/null/x"), IoError);
  EXPECT_THROW(check_can_write_in("/dev/null/x/y"), IoError);
  EXPECT_NO_THROW(check_can_write(file));
  EXPECT_NO_THROW(check_can_write(folder / "new"));
  EXPECT_EQ(read_file(file), "one");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1) << "a trial is left";
}

/// A run with findings, and its folder.
class Outputs : public testing::Test {
 protected:
  void SetUp() override {
    const Ran ran = nearmiss(
        {"run", "--plugin", plugin_file("skim_plugin"), "-s", "skim", "--cases", "300", "--seed", "1", "--out", run_});
    ASSERT_EQ(ran.exit_code, 1) << ran.err;
  }
  const TemporaryFolder folder_;
  const std::string run_ = (folder_ / "run").string();
};

/// The links are those of /dev/stdout, in a folder of the test.
TEST_F(Outputs, StandardOutputKeepsWhatWasPrinted) {
  fs::create_symlink("/proc/self/fd/1", folder_ / "stdout");
  fs::create_symlink("stdout", folder_ / "link");
  for (const char* name : {"stdout", "link"}) {
    const Ran ran = nearmiss({"diff", run_, run_, "--json", (folder_ / name).string()});  // onto a regular file
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.out.find("\"kinds\""), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("CHANGE"), std::string::npos) << ran.out;
    EXPECT_LT(ran.out.find("\"kinds\""), ran.out.find("CHANGE"));
    EXPECT_TRUE(fs::is_symlink(folder_ / name));
  }
}

TEST_F(Outputs, CommandsFailBeforeTheWork) {
  const fs::path out = folder_ / "out";
  const std::vector<std::string> triage{"triage", run_, "--plugin", plugin_file("skim_plugin"), "--out", out.string()};
  for (const char* option : {"--json", "--sarif", "--junit"}) {
    std::vector<std::string> arguments = triage;
    arguments.insert(arguments.end(), {option, "/dev/null/x"});
    const Ran ran = nearmiss(arguments);
    EXPECT_EQ(ran.exit_code, 2) << ran.out;
    EXPECT_EQ(ran.err, "nearmiss: /dev/null/x: cannot be written: Not a directory\n");
    EXPECT_FALSE(fs::exists(out / "examined") || fs::exists(out / "triage.json")) << option << ": it worked before";
  }
}

/// Each says so in one line, and prints no result.
TEST(OutputsOfCommands, FailBeforeASubjectIsAsked) {
  const TemporaryFolder folder;
  const std::string file = folder.file("c.json", R"({"query": "sphere_sphere_overlap", "scalar": "double", "inputs": {
    "sphere1": {"center": [0, 0, 0], "radius": 1}, "sphere2": {"center": [3, 0, 0], "radius": 1}}})");
  const std::string subject = "collide-fast-double";
  const std::vector<std::string> commands[] = {{"explain", file, "-s", subject},
                                               {"minimise", file, "-s", subject},
                                               {"run", "-s", subject, "--cases", "10"},
                                               {"relations", "-s", subject, "--cases", "10"},
                                               {"extremes", "-s", subject, "-q", "sphere_sphere_overlap"},
                                               {"trade", "-s", subject, "-q", "sphere_sphere_overlap"},
                                               {"scene", "advise", "driving", "-s", subject},
                                               {"sweep", "-q", "sphere_sphere_overlap", "--number", "sphere1.radius"},
                                               {"emit-test", file, "--for", subject}};
  for (std::vector<std::string> arguments : commands) {
    arguments.insert(arguments.end(), {"--out", "/dev/null/x"});
    const Ran ran = nearmiss(arguments);
    EXPECT_EQ(ran.exit_code, 2) << arguments[0] << ran.out;
    EXPECT_EQ(ran.out, "") << arguments[0] << ": it printed results before";
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_NE(ran.err.find("/dev/null/x"), std::string::npos) << ran.err;
  }
}

/// A subject that answers every case of a query wrongly.
const Subject& always_wrong() {
  static const Subject s = subject_with("sphere_sphere_overlap", [](std::span<const double> values) {
    Answer a = exact_answer("sphere_sphere_overlap", values);
    a.yes = !a.yes;
    return a;
  });
  return s;
}

TEST(Reports, ThatVanishDuringARunAreTold) {
  const TemporaryFolder folder;
  nearmiss::Run run({"test", folder / "r", {find_query("sphere_sphere_overlap")}, {&always_wrong()}, 1, {}, false});
  run.generate(200);
  const std::vector<WrittenReport> written = run.written_now();
  ASSERT_GE(written.size(), 3u);
  fs::remove(folder / "r" / written[0].file);
  fs::remove(folder / "r" / written[2].file);
  run.finish();
  const std::string lost = fmt::format("2 of {} reports have vanished from {}, the first is {}", written.size(),
                                       (folder / "r").string(), written[0].file);
  EXPECT_NE(run.summary().find(lost), std::string::npos) << run.summary();
  ASSERT_TRUE(run.shortfall());
  EXPECT_TRUE(run.shortfall()->starts_with(lost)) << *run.shortfall();
  EXPECT_EQ(run.exit_code(), 1);
  const nlohmann::json index = nlohmann::json::parse(read_file(folder / "r" / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index.at("vanished"), nlohmann::json({written[0].file, written[2].file}));
  EXPECT_EQ(index.at("reports").size(), written.size());
}

/// Also where the hosts of several subjects answer in another order each time.
TEST(Reports, AreListedInTheSameOrderForTheSameSeed) {
  const TemporaryFolder folder;
  const auto reports_of = [&](const std::vector<std::string>& command, const std::string& name, const char* index) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--plugin", plugin_file("skim_plugin"), "--cases", "400", "--seed", "7", "--out",
                                       (folder / name).string()});
    EXPECT_EQ(nearmiss(arguments).exit_code, 1);
    return nlohmann::json::parse(read_file(folder / name / index)).at("reports");
  };
  const auto files_of = [](const nlohmann::json& reports) {
    std::vector<std::string> files;
    for (const auto& r : reports) files.push_back(r.at("file"));
    return files;
  };
  const nlohmann::json once = reports_of({"run", "-s", "skim"}, "a", "index.json");
  EXPECT_EQ(once, reports_of({"run", "-s", "skim"}, "b", "index.json"));
  const std::vector<std::string> files = files_of(once);
  EXPECT_GT(files.size(), 4u);
  EXPECT_TRUE(std::is_sorted(files.begin(), files.end()));
  const std::vector<std::string> related =
      files_of(reports_of({"relations", "-s", "skim", "--bit-for-bit"}, "c", "relations.json"));
  EXPECT_GT(related.size(), 2u);
  EXPECT_TRUE(std::is_sorted(related.begin(), related.end()));
}

}  // namespace
}  // namespace nearmiss
