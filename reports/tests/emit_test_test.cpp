/// Emitted tests: compiled with the libraries' packages, they fail where the library is wrong and pass where it is
/// right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "impl/host/engines.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"
#include "reports/picture/text_picture.hpp"
#include "reports/tests/program.hpp"
#include "reports/upstream/emit_test.hpp"
#include "reports/upstream/right_answers.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A stored case, the subject to ask, and what the emitted test prints; "" for a test that passes.
struct Emitted {
  std::string file, subject, fault;
};

fs::path in_corpus(const std::string& file) { return corpus_folder() / file; }

/// Compiles an emitted file by the command line in its own comment, and runs it.
Ran compiled_and_run(const TemporaryFolder& folder, const std::string& name, const std::string& text,
                     const std::string& extension, const std::string& more_flags = "") {
  const std::size_t at = text.find(extension == "c" ? " *   cc " : "//   g++ ");
  if (at == std::string::npos) return {-1, "", "no command line in " + name};
  const std::size_t start = text.find_first_of("gc", at);
  std::string build = text.substr(start, text.find('\n', start) - start);
  const fs::path source = folder.file(name + "." + extension, text), program = folder / name;
  build.replace(build.find("test." + extension), 5 + extension.size(), shell_quoted(source.string()));
  return run_program("sh", {"-c", fmt::format("{} {} -Wall -Wextra -Werror -O0 -o {} && exec {}", build, more_flags,
                                              shell_quoted(program.string()), shell_quoted(program.string()))});
}

/// Emits, compiles and runs each of them.
void expect_as_said(const std::vector<Emitted>& all, const std::string& more_flags = "") {
  const TemporaryFolder folder;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Emitted& e = all[i];
    if (find_subject(e.subject) == nullptr) GTEST_SKIP() << e.subject << " is not in this build";
    const Ran emitted = nearmiss({"emit-test", "--for", e.subject, in_corpus(e.file).string()});
    ASSERT_EQ(emitted.exit_code, 0) << e.file << ": " << emitted.err;
    const Ran ran = compiled_and_run(folder, fmt::format("t{}", i), emitted.out, "cpp", more_flags);
    const std::string said = ran.out + ran.err;
    if (e.fault.empty()) {
      EXPECT_EQ(ran.exit_code, 0) << e.file << ": " << said;
    } else {
      EXPECT_NE(ran.exit_code, 0) << e.file << ": " << said;
      EXPECT_NE(said.find(e.fault), std::string::npos) << e.file << ": " << said;
    }
  }
}

TEST(EmitTest, FclFailsAndPassesAsSaid) {
  expect_as_said({
      {"regressions/moving_sphere_box/fcl-naive-tunnel.json", "fcl", "false-miss"},
      {"regressions/moving_sphere_box/fcl-naive-tunnel.json", "fcl-conservative-advancement", ""},
      {"upstream/fcl/boxes-normal-of-a-face.json", "fcl", "wrong-normal"},
      {"upstream/fcl/apart-degenerate-triangle.json", "fcl-indep", "false-hit"},
      {"upstream/fcl/distance-aborts-at-a-touch.json", "fcl-distance-indep", "Assertion"},
      {"upstream/fcl/apart-distance-of-kissing-boxes.json", "fcl-distance", "wrong-depth"},
      {"upstream/fcl/capsules-that-overlap.json", "fcl-distance-indep", "Assertion"},
      {"seeds/box_box_signed_distance/gap-corners.json", "fcl-distance-indep", ""},
      {"seeds/sphere_triangle_signed_distance/gap-face.json", "fcl-distance", ""},
      {"seeds/triangle_triangle_signed_distance/gap-face.json", "fcl-distance", ""},
      {"seeds/sphere_triangle_overlap/apart-above.json", "fcl", ""},
  });
}

TEST(EmitTest, LibccdFailsAndPassesAsSaid) {
  expect_as_said({
      {"regressions/box_box_penetration/libccd-25.json", "libccd-gjk", "not-finite"},
      {"regressions/box_box_penetration/libccd-25.json", "libccd-mpr", ""},
      {"upstream/libccd/overlapping-boxes.json", "libccd-gjk", "false-miss"},
      {"upstream/libccd/overlapping-boxes.json", "libccd-mpr", ""},
      {"upstream/libccd/unit-spheres.json", "libccd-gjk", "wrong-normal"},
      {"seeds/sphere_triangle_overlap/overlap-face.json", "libccd-gjk", ""},
      {"seeds/aabox_triangle_overlap/overlap-through.json", "libccd-mpr", ""},
      {"seeds/moving_sphere_passes_box/hit-face.json", "libccd-gjk", ""},
      {"upstream/libccd/segment-and-triangle-in-a-plane.json", "libccd-mpr", "false-hit"},
  });
}

TEST(EmitTest, BulletFailsAndPassesAsSaid) {
  expect_as_said({
      {"upstream/bullet/ray-against-a-capsule.json", "bullet", "wrong-time"},
      {"seeds/moving_point_triangle/hit-oblique.json", "bullet", ""},
      {"seeds/moving_point_aabox/hit-oblique.json", "bullet", ""},
      {"upstream/bullet/boxes-normal-of-a-face.json", "bullet", "wrong-normal"},
      {"upstream/bullet/miss-sweep-within-a-millimetre.json", "bullet", "false-hit"},
      {"upstream/bullet/sphere-on-a-face.json", "bullet", "wrong-normal"},
      {"upstream/bullet/miss-ray-beyond-its-end.json", "bullet-float", "false-hit"},
      {"seeds/moving_sphere_sphere/hit-head-on.json", "bullet", ""},
      {"seeds/moving_sphere_sphere/hit-overlap.json", "bullet", ""},
      {"seeds/sphere_plane_penetration/overlap.json", "bullet-float", ""},
      {"seeds/sphere_triangle_overlap/overlap-face.json", "bullet", ""},
      {"upstream/bullet/triangles-that-cross.json", "bullet", "false-miss"},
      {"seeds/sphere_triangle_signed_distance/gap-face.json", "bullet", ""},
      {"upstream/bullet/cubes-half-in-each-other.json", "bullet", "wrong-normal"},
  });
}

TEST(EmitTest, OdeFailsAndPassesAsSaid) {
  expect_as_said({
      {"regressions/moving_point_sphere/ode-ray-from-afar.json", "ode", ""},
      {"upstream/ode/overlapping-boxes.json", "ode", "false-miss"},
      {"upstream/ode/boxes-normal-of-a-face.json", "ode", "wrong-normal"},
      {"upstream/ode/sphere-on-an-edge.json", "ode", "wrong-normal"},
      {"seeds/moving_point_capsule/hit-tube.json", "ode", ""},
      {"seeds/box_plane_penetration/overlap-corner.json", "ode", ""},
      {"seeds/point_sphere_signed_distance/degenerate-equal.json", "ode", ""},
      {"upstream/ode/parallel-segments.json", "ode", "wrong-place"},
  });
}

/// The tiers of collide are right, and a wrong answer is planted in what is emitted.
TEST(EmitTest, CollidePassesUnlessItsAnswerIsChanged) {
  const std::string headers = " -I" + (fs::path(source_folder()) / "impl/collide/include").string();
  const TemporaryFolder folder;
  const Ran emitted =
      nearmiss({"emit-test", "--for", "collide", in_corpus("seeds/moving_sphere_box/hit-corner.json").string()});
  ASSERT_EQ(emitted.exit_code, 0) << emitted.err;
  const Ran right = compiled_and_run(folder, "right", emitted.out, "cpp", headers);
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  std::string text = emitted.out;
  const std::string given = "got_time = answer.time;";
  ASSERT_NE(text.find(given), std::string::npos) << text;
  text.replace(text.find(given), given.size(), "got_time = answer.time * 1.001;");
  const Ran wrong = compiled_and_run(folder, "wrong", text, "cpp", headers);
  EXPECT_NE(wrong.exit_code, 0) << wrong.out << wrong.err;
  for (const char* file :
       {"seeds/ray_aabox/hit-face.json", "seeds/closest_point_triangle_perimeter_edges/beside-an-edge.json"}) {
    const Ran other = nearmiss({"emit-test", "--for", "collide-accurate-float", in_corpus(file).string()});
    ASSERT_EQ(other.exit_code, 0) << file << other.err;
    const Ran ran = compiled_and_run(folder, "other", other.out, "cpp", headers);
    EXPECT_EQ(ran.exit_code, 0) << file << ran.out << ran.err;
  }
}

/// The compiled tiers are linked as the emitted command line says.
TEST(EmitTest, CollideLinksItsLibrary) {
  const std::string flags =
      " -I" + (fs::path(source_folder()) / "impl/collide/include").string() + " " + certified_library();
  const TemporaryFolder folder;
  for (const char* subject : {"collide-certified-float", "collide-decisive-double"}) {
    const Ran emitted = nearmiss({"emit-test", "--for", subject, in_corpus("seeds/ray_aabox/hit-face.json").string()});
    ASSERT_EQ(emitted.exit_code, 0) << emitted.err;
    const Ran ran = compiled_and_run(folder, "linked", emitted.out, "cpp", flags);
    EXPECT_EQ(ran.exit_code, 0) << subject << ran.out << ran.err;
  }
}

/// A plugin's test is in C and links the plugin. With the plugin's sources in its place it fails with a mistake, and
/// passes without it, also where the plugin gives fewer members than the query has.
TEST(EmitTest, PluginFailsAndPassesAsSaid) {
  const TemporaryFolder folder;
  const fs::path example = fs::path(source_folder()) / "docs/example-library";
  const Ran run = nearmiss({"run", "--plugin", plugin_file("skim_plugin"), "--subject", "skim", "--cases", "20000",
                            "--seed", "1", "--out", (folder / "r").string()});
  ASSERT_EQ(run.exit_code, 1) << run.err;
  const std::string flags =
      fmt::format("-I{} -I{}", example.string(), (fs::path(source_folder()) / "impl/plugin").string());
  for (const auto& [query, fault] :
       {std::pair("sphere_sphere_overlap", "false-hit"), std::pair("moving_point_sphere", "false-miss"),
        std::pair("closest_point_segment", "off-the-surface")}) {
    const fs::path report = fs::directory_iterator(folder / "r/findings" / query)->path();
    const Ran emitted =
        nearmiss({"emit-test", "--plugin", plugin_file("skim_plugin"), "--for", "skim", report.string()});
    ASSERT_EQ(emitted.exit_code, 0) << emitted.err;
    std::string text = emitted.out;
    const std::string library = plugin_file("skim_plugin");
    const std::size_t linked = text.find(library + " -lm");
    ASSERT_NE(linked, std::string::npos) << text;
    text.replace(linked, library.size(), (example / "plugin.c").string() + " " + (example / "skim.c").string());
    const Ran wrong = compiled_and_run(folder, "plugin", text, "c", flags);
    EXPECT_EQ(wrong.exit_code, 1) << wrong.out << wrong.err;
    EXPECT_NE(wrong.out.find(fault), std::string::npos) << wrong.out;
    const Ran mended = compiled_and_run(folder, "plugin", text, "c", flags + " -DSKIM_MENDED");
    EXPECT_EQ(mended.exit_code, 0) << text << mended.out << mended.err;
  }
}

TEST(EmitTest, ItsCommandLineNamesFilesThatExist) {
  const TemporaryFolder folder;
  const std::string ball =
      folder.file("ball.json", R"({"query": "moving_point_sphere", "scalar": "float", "inputs": {"point": [-3, 0, 0],
      "velocity": [1, 0, 0], "sphere": {"center": [0, 0, 0], "radius": 1}, "solid": true}})");
  const std::string bug = (folder / "a bug.c").string();
  const Ran emitted =
      nearmiss({"emit-test", "--plugin", plugin_file("skim_plugin"), "--for", "skim", ball, "--out", bug});
  ASSERT_EQ(emitted.exit_code, 0) << emitted.err;
  const std::string text = read_file(bug);
  const std::string header = (fs::path(source_folder()) / "impl/plugin").string();
  EXPECT_NE(text.find("cc '" + bug + "' -I " + header + " " + plugin_file("skim_plugin") + " -lm -o finding\n"),
            std::string::npos)
      << text;
  const std::size_t at = text.find("cc '");
  const std::string build = text.substr(at, text.find('\n', at) - at) + " -o " + (folder / "bug").string();
  EXPECT_EQ(run_program("sh", {"-c", build}).exit_code, 0) << text;
}

TEST(EmitTest, RefusesInOneLine) {
  const std::string stored = in_corpus("upstream/ode/overlapping-boxes.json").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
      {{"emit-test", stored}, "--for is needed"},
      {{"emit-test", "--for", "fcll", stored}, "did you mean"},
      {{"emit-test", "--for", "bullet", in_corpus("seeds/point_in_triangle/hit-clockwise.json").string()},
       "does not offer"},
      {{"emit-test", "--for", "ode", "/no/such/file"}, "/no/such/file"},
      {{"emit-test", "--for", "jolt", stored}, "jolt is not installed; './nearmiss engines jolt' installs it"},
      {{"upstream-report", "--for", "collide", in_corpus("seeds/moving_sphere_box/hit-corner.json").string()},
       "nothing is to be reported"},
      {{"emit-test", "--command", "python3 docs/example-program/balls.py", "--for", "balls-py",
        in_corpus("seeds/sphere_sphere_overlap/apart.json").string()},
       ""},
  };
  for (const auto& [arguments, said] : wrong) {
    const Ran ran = nearmiss(arguments, {std::string(engines_variable) + "=/no/engines"});
    EXPECT_EQ(ran.exit_code, 2) << arguments.back() << ran.out;
    EXPECT_NE(ran.err.find(said), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
}

/// The conditions of a test accept every right answer, and not the one that was given.
TEST(RightAnswers, AcceptEveryRightAnswerOfTheLedgerAndNotTheGivenOne) {
  Workers workers;
  int findings = 0;
  for (const fs::path& folder : fs::directory_iterator(corpus_folder() / "upstream")) {
    if (!fs::is_directory(folder)) continue;
    for (const fs::path& file : fs::directory_iterator(folder)) {
      const StoredCase stored = read_stored_case(file);
      const Query& query = *stored.question.query;
      for (const Expected& e : stored.expected) {
        const Subject* subject = find_subject(e.subject);
        if (subject == nullptr || e.verdict == "broke") continue;
        const Report r = examine(stored.question, *subject, workers);
        ASSERT_TRUE(is_bad(r.finding)) << file;
        std::vector<std::size_t> members;
        for (std::size_t m = 0; m < query.layout.parts.size(); ++m) {
          if (r.answer.gives(query.layout.parts[m].begin)) members.push_back(m);
        }
        const RightAnswers right = right_answers(r.question, r.answer, r.finding, r.standard, r.truth, members);
        EXPECT_FALSE(accepts(right, query, r.answer)) << file;
        for (const Alternative& a : r.truth.alternatives) {
          Answer exact;
          exact.yes = a.yes;
          for (std::size_t i = 0; i < a.count; ++i) exact.values[i] = a.values[i].low / 2 + a.values[i].high / 2;
          EXPECT_TRUE(a.many_normals || accepts(right, query, exact)) << file;
        }
        ++findings;
      }
    }
  }
  if (findings == 0) GTEST_SKIP() << "no library in this build";
}

TEST(UpstreamReport, HasEverythingAndNoFolderOfThisMachine) {
  if (find_subject("ode") == nullptr) GTEST_SKIP() << "ode is not in this build";
  const Ran ran =
      nearmiss({"upstream-report", "--for", "ode", in_corpus("upstream/ode/sphere-on-an-edge.json").string()});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  for (const char* part :
       {"# ODE 0.16: ode gives a wrong normal", "| library | ODE 0.16 |", "## The scene",
        "\"center\": [-2.0, 2.0, -1.5]", "a: sphere; b: box; #: both", "## The answer", "## What is right",
        "## A program that shows it", "g++ -std=c++17 test.cpp", "## Other libraries"}) {
    EXPECT_NE(ran.out.find(part), std::string::npos) << part << "\n" << ran.out;
  }
  EXPECT_EQ(ran.out.find(source_folder()), std::string::npos);
}

TEST(UpstreamReport, ShowsThePictureBesideIt) {
  if (find_subject("ode") == nullptr) GTEST_SKIP() << "ode is not in this build";
  const TemporaryFolder folder;
  const std::string svg = (folder / "the boxes.svg").string();
  const std::string file = in_corpus("upstream/ode/overlapping-boxes.json").string();
  const Ran ran = nearmiss({"upstream-report", "--for", "ode", file, "--picture", svg});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("![The scene, the exact answer and the given one](<the boxes.svg>)"), std::string::npos)
      << ran.out;
  EXPECT_EQ(ran.out.find(folder.path().string()), std::string::npos) << "a folder of this machine";
  EXPECT_EQ(read_file(svg), read_file(fs::path(source_folder()) / "docs/images/upstream/ode-overlapping-boxes.svg"));
  EXPECT_EQ(nearmiss({"upstream-report", "--for", "ode", file}).out.find("![The scene"), std::string::npos);
}

/// A sphere of radius 1 that moves along x from 4 to a sphere of radius 2.
TEST(CasePicture, DrawsShapesWhereTheyAre) {
  const Case question{
      find_query("moving_sphere_sphere"), Scalar::float64, {4, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2}, "", 0, 0, {}};
  Report r;
  r.question = question;
  r.truth = truth_of(question);
  const std::string picture = text_picture(r);
  const std::string middle = [&] {
    std::size_t at = 0;
    for (std::size_t end = picture.find('\n'); end != std::string::npos; at = end + 1, end = picture.find('\n', at)) {
      if (picture.find('o', at) < end) return picture.substr(at, end - at);
    }
    return std::string();
  }();
  // 7 wide in 64 columns with a margin: b's 4, a gap of 1 with the way and, at 2, the contact; a's 2.
  EXPECT_EQ(middle.find('+'), std::size_t(36)) << picture;
  EXPECT_EQ(middle.find('o'), std::size_t(53)) << picture;
  EXPECT_EQ(middle.size(), std::size_t(63)) << picture;
  EXPECT_NE(picture.find("x to the right, y up"), std::string::npos) << picture;
}

}  // namespace
}  // namespace nearmiss
