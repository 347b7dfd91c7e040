/// Sweeps: the truth of slices, that a wrong subject is found, and that a sweep goes on where it ended.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "corpus/files/errors.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/provenance.hpp"
#include "oracles/judge.hpp"
#include "reports/engine/sweep.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using Random64 = std::mt19937_64;

std::size_t number_named(const Query& query, const std::string& name) {
  for (std::size_t i = 0; i < query.inputs.size(); ++i) {
    if (query.inputs[i].name == name) return i;
  }
  throw std::logic_error("no number " + name);
}

bool may_be_swept(const Field& f) { return f.role != Role::flag && f.role != Role::index; }

TEST(FloatPositions, AreThoseOfTheFiniteFloatsInOrder) {
  EXPECT_EQ(finite_floats, 4'278'190'080u);
  EXPECT_EQ(float_at(0), -0x1.fffffep127f);
  EXPECT_EQ(float_at(finite_floats - 1), 0x1.fffffep127f);
  EXPECT_EQ(position_of(0.0f), position_of(-0.0f) + 1);
  EXPECT_TRUE(std::signbit(float_at(position_of(-0.0f))));
  Random64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t at = random() % (finite_floats - 1);
    ASSERT_EQ(position_of(float_at(at)), at);
    ASSERT_LE(float_at(at), float_at(at + 1));
    ASSERT_TRUE(std::isfinite(float_at(at)));
  }
}

SliceTruth truth_in(const std::vector<TruthRange>& ranges, std::uint64_t at) {
  const auto behind = std::upper_bound(ranges.begin(), ranges.end(), at,
                                       [](std::uint64_t x, const TruthRange& r) { return x < r.begin; });
  return (behind - 1)->truth;
}

/// The whole slice of cases of every query that decides: the truth of each range is the exact decision at both of its
/// ends and at random floats.
TEST(SliceTruths, AreTheExactDecisionsAtEachEndAndAtRandomFloats) {
  Random64 random(2);
  std::size_t changes = 0, slices = 0;
  for (const Query& q : catalogue()) {
    if (!decides(q.kind)) continue;
    std::size_t number = random() % q.inputs.size();
    while (!may_be_swept(q.inputs[number])) number = random() % q.inputs.size();
    const std::optional<Case> touching = touching_case(q, number, 1);
    if (!touching) continue;  // the decision of some queries does not depend on each number
    const Slice slice(*touching, number);
    SCOPED_TRACE(case_to_json(slice.question()).dump() + slice.field().name);
    std::uint64_t proofs = 0;
    const std::vector<TruthRange> ranges = slice.truth(0, finite_floats, [&] { return ++proofs > 2'000; });
    if (ranges.empty()) continue;  // a touch at many floats, of which each needs a proof of its own
    ++slices;
    ASSERT_EQ(ranges.front().begin, 0u);
    ASSERT_LE(ranges.size(), 20u);
    std::vector<std::uint64_t> looked;
    for (const TruthRange& r : ranges) {
      looked.push_back(r.begin);
      if (r.begin > 0) looked.push_back(r.begin - 1);
    }
    for (int i = 0; i < 100; ++i) looked.push_back(random() % finite_floats);
    for (const std::uint64_t at : looked) ASSERT_EQ(slice.truth_at(at), truth_in(ranges, at)) << float_at(at);
    changes += ranges.size() - 1;
  }
  EXPECT_GE(slices, 15u);
  EXPECT_GE(changes, slices);
}

/// A list of ranges is the same in whatever parts it is computed.
TEST(SliceTruths, DoNotDependOnTheParts) {
  const Query& q = *find_query("sphere_box_overlap");
  const std::size_t number = number_named(q, "sphere.center.x");
  const Slice slice(*touching_case(q, number, 1), number);
  const std::vector<TruthRange> whole = slice.truth(0, finite_floats);
  std::vector<SweptRange> parts;
  Random64 random(3);
  std::vector<std::uint64_t> cuts{0, finite_floats};
  for (int i = 0; i < 50; ++i) cuts.push_back(random() % finite_floats);
  for (const TruthRange& r : whole) cuts.insert(cuts.end(), {r.begin, r.begin + 1});
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) order.push_back(i);
  std::shuffle(order.begin(), order.end(), random);
  for (const std::size_t i : order) insert(parts, {cuts[i], cuts[i + 1], slice.truth(cuts[i], cuts[i + 1])});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].truth, whole);
}

/// Which floats are valid is derived from few of them; see Slice::find_cells.
TEST(Slices, KnowWhichFloatsAreValid) {
  Random64 random(4);
  for (const Query& q : catalogue()) {
    if (!decides(q.kind)) continue;
    for (std::size_t number = 0; number < q.inputs.size(); ++number) {
      if (!may_be_swept(q.inputs[number])) continue;
      const Case c = generate(q, Scalar::float32, 5, number);
      const Slice slice(c, number);
      for (int i = 0; i < 40; ++i) {
        std::uint64_t at = random() % finite_floats;
        if (i % 2 == 0) at = position_of(float(c.values[random() % c.values.size()])) + random() % 5;
        at = std::min(at >= 2 ? at - 2 : at, finite_floats - 1);
        const std::vector<TruthRange> one = slice.truth(at, at + 1);
        ASSERT_EQ(one.front().truth == SliceTruth::invalid, q.broken(slice.at(at).values).has_value())
            << case_to_json(c).dump() << q.inputs[number].name << " " << float_at(at);
      }
    }
  }
}

TEST(DecisionsWithin, AreProvedForEveryInputOrNotGiven) {
  const Query& q = *find_query("sphere_sphere_overlap");
  const Case c{&q, Scalar::float32, {0, 0, 0, 1, 3, 0, 0, 1}, "", 0, 0, {}};
  std::vector<double> moves(8, 0.0);
  EXPECT_EQ(decision_within(c, moves), std::optional(false));
  moves[3] = 0.9;
  EXPECT_EQ(decision_within(c, moves), std::optional(false));
  moves[3] = 1.1;
  EXPECT_EQ(decision_within(c, moves), std::nullopt);
}

// Sweeps of a part.

/// A subject that answers as one of our own tiers, but otherwise to numbers where `changes` is true.
Subject planted(const std::string& query, bool (*changes)(double swept)) {
  static Subject honest;
  static bool (*is_changed)(double) = nullptr;
  for (const Subject& s : own_subjects_in_process()) {
    if (s.name == "collide-certified-float") honest = s;
  }
  is_changed = changes;
  Subject wrong = honest;
  std::erase_if(wrong.offerings, [&](const Offering& o) { return o.query != query; });
  wrong.offerings.at(0).answer = AnswerFunction([](std::span<const double> values) {
    Answer a = honest.offering("sphere_sphere_overlap").answer(values);
    if (is_changed(values[3])) a.yes = !a.yes;
    return a;
  });
  return wrong;
}

SweepSettings settings_of(const std::filesystem::path& folder, const Subject& subject, std::uint64_t begin,
                          std::uint64_t end) {
  const Query& q = *find_query("sphere_sphere_overlap");
  const Case c{&q, Scalar::float32, {0, 0, 0, 1, 3, 0, 0, 1}, "test", 0, 0, {}};
  return {"test", folder, Slice(c, 3), {subject}, begin, end, 2};
}

TEST(Sweeps, FindASingleWrongFloatAndReportIt) {
  const TemporaryFolder folder;
  const Subject wrong = planted("sphere_sphere_overlap", [](double x) { return float(x) == 2.125f; });
  Sweep sweep(settings_of(folder / "r", wrong, position_of(1.5f), position_of(3.0f)));
  sweep.run();
  const SweepCounts& c = sweep.counts().at(0);
  EXPECT_EQ(c.asked, position_of(3.0f) - position_of(1.5f));
  EXPECT_EQ(c.false_misses, 1u);
  EXPECT_EQ(c.false_hits, 0u);
  EXPECT_EQ(c.judged, 1u);
  EXPECT_EQ(c.violations, 1u);
  ASSERT_TRUE(c.first.has_value());
  EXPECT_EQ(float_at(c.first->at), 2.125f);
  EXPECT_EQ(sweep.exit_code(), 1);
  const json state = json::parse(read_file(folder / "r" / "sweep.json"));
  EXPECT_EQ(complaints(state, "sweep.schema.json"), "");
  EXPECT_EQ(state["coverage"], "partial");
  ASSERT_EQ(state["reports"].size(), 1u);
  const json report = json::parse(read_file(folder / "r" / state["reports"][0]["file"].get<std::string>()));
  EXPECT_EQ(complaints(report, "report.schema.json"), "");
  EXPECT_EQ(report["inputs"]["sphere1"]["radius"], 2.125);
}

TEST(Sweeps, JudgeEveryFloatOfABand) {
  const TemporaryFolder folder;
  const Subject wrong = planted("sphere_sphere_overlap", [](double x) { return x >= 1.75 && x < 1.751f; });
  Sweep sweep(settings_of(folder / "r", wrong, position_of(1.5f), position_of(2.5f)));
  sweep.run();
  const SweepCounts& c = sweep.counts().at(0);
  EXPECT_EQ(c.false_hits, position_of(1.751f) - position_of(1.75f));
  EXPECT_EQ(c.violations, c.false_hits);
  EXPECT_EQ(float_at(c.first->at), 1.75f);
  EXPECT_EQ(float_at(c.worst->at), 1.75f) << "the one that is farthest from the touch";
  EXPECT_GT(c.worst_backward, 1e5);
}

TEST(Sweeps, CatchAThrowingSubject) {
  const TemporaryFolder folder;
  Subject throws = planted("sphere_sphere_overlap", [](double x) -> bool {
    if (float(x) == 2.5f) throw std::runtime_error("not this one");
    return false;
  });
  Sweep sweep(settings_of(folder / "r", throws, position_of(2.25f), position_of(2.75f)));
  sweep.run();
  EXPECT_EQ(sweep.counts().at(0).broke, 1u);
  EXPECT_EQ(sweep.exit_code(), 1);
  EXPECT_EQ(sweep.counts().at(0).first->at, position_of(2.5f));
}

// The command.

/// Without what differs between two equal sweeps.
json without_times(json state) {
  for (const char* part : {"command", "seconds", "jobs"}) state.erase(part);
  for (json& s : state["subjects"]) s.erase("seconds"), s.erase("judge_seconds");
  return state;
}

json state_in(const std::filesystem::path& folder) { return json::parse(read_file(folder / "sweep.json")); }

/// The results of docs/measured/exhaustive.md.
TEST(StoredSweeps, AreExhaustive) {
  std::size_t found = 0;
  for (const auto& f : std::filesystem::directory_iterator(source_folder() + "/reports/exhaustive")) {
    const json state = json::parse(read_file(f.path()));
    SCOPED_TRACE(f.path().string());
    EXPECT_EQ(complaints(state, "sweep.schema.json"), "");
    EXPECT_EQ(state["coverage"], "exhaustive");
    EXPECT_EQ(state["valid"].get<std::uint64_t>() + state["invalid"].get<std::uint64_t>(), finite_floats);
    for (const json& s : state["subjects"]) EXPECT_EQ(s["asked"], state["valid"]);
    ++found;
  }
  EXPECT_GE(found, 2u);
}

/// About 56 million floats, of one tier.
std::vector<std::string> some(const std::string& out) {
  return {"sweep",
          "--query",
          "sphere_sphere_overlap",
          "--number",
          "sphere1.center.x",
          "--from",
          "0.0001",
          "--to",
          "0.01",
          "--subject",
          "collide-fast-float",
          "--jobs",
          "1",
          "--out",
          out};
}

TEST(SweepCommand, GoesOnAfterAnInterruptAndAfterAKill) {
  const TemporaryFolder folder;
  const Ran whole = nearmiss(some((folder / "whole").string()));
  ASSERT_EQ(whole.exit_code, 0) << whole.out << whole.err;
  for (const int signal : {SIGINT, SIGKILL}) {
    const std::filesystem::path out = folder / std::to_string(signal);
    Started stopped(nearmiss_program(), some(out.string()), {});
    for (int i = 0; i < 500; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (std::filesystem::exists(out / "sweep.json") && !state_in(out)["done"].empty()) break;
    }
    stopped.send(signal);
    const std::optional<Ran> ended = stopped.wait(20);
    ASSERT_TRUE(ended.has_value());
    EXPECT_EQ(ended->exit_code, signal == SIGKILL ? -SIGKILL : 2);
    const bool says_how = ended->err.find("goes on from there") != std::string::npos;
    EXPECT_EQ(says_how, signal == SIGINT) << ended->err;
    const json half = state_in(out);
    EXPECT_EQ(complaints(half, "sweep.schema.json"), "");
    EXPECT_EQ(half["state"], signal == SIGKILL ? "running" : "interrupted");
    EXPECT_GT(half["valid"], 0);
    EXPECT_LT(half["valid"], half["floats"]);
    const Ran rest = nearmiss(some(out.string()));
    EXPECT_EQ(rest.exit_code, 0) << rest.err;
    EXPECT_EQ(without_times(state_in(out)), without_times(state_in(folder / "whole")));
  }
}

TEST(SweepCommand, SaysWhatItSwept) {
  const TemporaryFolder folder;
  const std::string out = (folder / "r").string();
  const std::vector<std::string> words{
      "sweep", "--query", "sphere_sphere_overlap", "--number", "sphere1.radius", "--from", "-1", "--to", "1e-40",
      "--out", out};
  const Ran ran = nearmiss(words);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  const json state = state_in(out);
  EXPECT_EQ(complaints(state, "sweep.schema.json"), "");
  EXPECT_EQ(state["coverage"], "partial");
  EXPECT_EQ(state["state"], "finished");
  EXPECT_EQ(state["valid"], position_of(1e-40f) + 1 - position_of(-0.0f)) << "-0.0 is valid";
  EXPECT_EQ(state["invalid"], position_of(-0.0f) - position_of(-1.0f));
  EXPECT_EQ(state["subjects"].size(), 4u);
  EXPECT_NE(ran.out.find("sphere_sphere_overlap, sphere1.radius through all 71,364 valid floats of a range: "
                         "collide-accurate-float: every decision is exact (partial: -1 to 1e-40)"),
            std::string::npos)
      << ran.out;
  const Ran again = nearmiss(words);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(without_times(state_in(out)), without_times(state));
}

TEST(SweepCommand, RefusesTheFolderOfAnotherSweep) {
  const TemporaryFolder folder;
  const std::string out = (folder / "r").string();
  const auto sweep = [&](const std::string& query, const std::string& number, const std::string& to,
                         const std::string& seed, const std::string& subject) {
    return nearmiss({"sweep", "--query", query, "--number", number, "--from", "0", "--to", to, "--seed", seed,
                     "--subject", subject, "--out", out});
  };
  const std::string q = "sphere_sphere_overlap", n = "sphere1.radius", s = "collide-fast-float";
  ASSERT_EQ(sweep(q, n, "1e-42", "1", s).exit_code, 0);
  const json before = state_in(out);
  const std::pair<Ran, const char*> others[] = {
      {sweep("sphere_sphere_penetration", n, "1e-42", "1", s), "the query differs"},
      {sweep(q, "sphere2.radius", "1e-42", "1", s), "the number differs"},
      {sweep(q, n, "1e-41", "1", s), "the range of floats differs"},
      {sweep(q, n, "1e-42", "2", s), "the case differs"},
      {sweep(q, n, "1e-42", "1", "collide-accurate-float"), "the list of subjects differs"}};
  for (const auto& [ran, words] : others) {
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
  EXPECT_EQ(state_in(out), before);
  folder.file("r/sweep.json", "{}");
  const Ran no_state = sweep(q, n, "1e-42", "1", s);
  EXPECT_EQ(no_state.exit_code, 2);
  EXPECT_NE(no_state.err.find("not the state of a sweep"), std::string::npos) << no_state.err;
}

TEST(SweepCommand, SweepsTheCaseOfAFile) {
  const TemporaryFolder folder;
  const std::string file = folder.file("case.json", R"({"query": "sphere_sphere_overlap", "scalar": "float", "inputs": {
    "sphere1": {"center": [0, 0, 0], "radius": 1}, "sphere2": {"center": [3, 0, 0], "radius": 1}}})");
  const std::string out = (folder / "r").string();
  const Ran ran =
      nearmiss({"sweep", "--case", file, "--number", "sphere1.radius", "--from", "1.99", "--to", "2.01", "--out", out});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("The exact decision changes: yes from 2 on."), std::string::npos) << ran.out;
}

}  // namespace
}  // namespace nearmiss
