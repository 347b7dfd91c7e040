/// Every JSON file that a command reads, with each of its members missing, given twice, of another type, negative and
/// huge: the reader takes it, or says in one line what is wrong, where and why. It never says what the JSON library
/// says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files/file_value.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/scenes/scene_file.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/advice/profile.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/engine/sweep.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/page/page_data.hpp"
#include "reports/page/picture.hpp"
#include "reports/tests/program.hpp"
#include "reports/triage/causes/cause_json.hpp"
#include "reports/triage/comparison/run_diff.hpp"
#include "reports/triage/examination/sources.hpp"
#include "reports/triage/minimisation/minimise.hpp"
#include "reports/triage/triage_json.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Pointer = json::json_pointer;

/// The places of a document, of each list only the first item.
std::vector<Pointer> places_of(const json& document) {
  std::vector<Pointer> places;
  const std::function<void(const json&, const Pointer&)> add = [&](const json& j, const Pointer& at) {
    if (!at.empty()) places.push_back(at);
    if (j.is_array() && !j.empty()) add(j[0], at / 0);
    if (!j.is_object()) return;
    for (const auto& item : j.items()) add(item.value(), at / item.key());
  };
  add(document, Pointer());
  return places;
}

struct Changed {
  std::string what, text;
};

/// The document with the member given twice.
std::string with_twice(json document, const Pointer& at) {
  const std::string mark = "a member of which there is no other";
  json& object = document[at.parent_pointer()];
  const json value = object[at.back()];
  object[mark] = value;
  std::string text = document.dump();
  text.replace(text.find(mark), mark.size(), at.back());
  return text;
}

/// The document with the place changed in every way.
std::vector<Changed> changes_at(const json& document, const Pointer& at) {
  std::vector<Changed> all;
  for (const json& other : std::vector<json>{nullptr, true, "x", "", -1, 0, 0.5, 1e300, 18446744073709551615u,
                                             4278190081u, json::array(), json::object(), json::array({nullptr})}) {
    json changed = document;
    changed[at] = other;
    all.push_back({fmt::format("{} = {}", at.to_string(), other.dump()), changed.dump()});
  }
  json without = document;
  without[at.parent_pointer()].is_object() ? (void)without[at.parent_pointer()].erase(at.back())
                                           : without[at.parent_pointer()].erase(std::stoul(at.back()));
  all.push_back({fmt::format("{} is missing", at.to_string()), without.dump()});
  if (document[at.parent_pointer()].is_object())
    all.push_back({fmt::format("{} twice", at.to_string()), with_twice(document, at)});
  return all;
}

void expect_a_reason(const Changed& c, const fs::path& file, const std::string& said) {
  EXPECT_EQ(said.find('\n'), std::string::npos) << c.what << ": " << said;
  EXPECT_NE(said.find(file.filename().string()), std::string::npos) << c.what << ": " << said;
  EXPECT_LT(said.size(), 500u) << c.what << ": " << said;
  for (const char* of_the_library :
       {"json.exception", "type must be", "cannot use", "stoull", "basic_string", "map::at"})
    EXPECT_EQ(said.find(of_the_library), std::string::npos) << c.what << ": " << said;
}

/// Returns how many of the changed documents were refused. The reader reads the file. Members at the top that no reader
/// looks into are left as they are.
std::size_t read_all_changes(const json& document, const fs::path& file, const std::function<void()>& read,
                             std::set<std::string> unread = {}) {
  unread.insert({"environment", "stages", "touches", "not_offered", "inconsistent_conventions", "referees"});
  std::ofstream(file) << document.dump();
  EXPECT_NO_THROW(read()) << file;
  std::size_t refused = 0;
  for (const Pointer& at : places_of(document)) {
    const std::string name = at.to_string().substr(1);
    if (unread.contains(name.substr(0, name.find('/')))) continue;
    for (const Changed& c : changes_at(document, at)) {
      std::ofstream(file, std::ios::trunc) << c.text;
      try {
        read();
        EXPECT_FALSE(c.what.ends_with(" twice")) << c.what << " is accepted";
      } catch (const ReportedError& e) {
        ++refused;
        expect_a_reason(c, file, e.what());
      } catch (const std::exception& e) {
        ADD_FAILURE() << file << ": " << c.what << ": " << e.what();
      }
    }
  }
  std::ofstream(file, std::ios::trunc) << document.dump();
  return refused;
}

/// A run of a library with mistakes, its triage, and what else a command leaves.
class JsonFiles : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    ASSERT_EQ(
        wrong({"run", "-s", "zoo", "-q", "sphere_sphere_overlap", "--cases", "50", "--seed", "1", "--out", in("run")}),
        1);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  /// The folder of the run's triage.
  static std::string triage() {
    if (!fs::exists(in("triage"))) {
      EXPECT_EQ(wrong({"triage", in("run"), "--minutes", "0.005", "--out", in("triage")}), 1);
    }
    return in("triage");
  }
  /// Runs a command with a subject whose every answer is wrong. Returns the exit code.
  static int wrong(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--plugin", plugin_file("zoo")});
    return nearmiss(arguments, {"NEARMISS_ZOO=text-all-formats"}).exit_code;
  }
  static std::string in(const std::string& name) { return (*folder_ / name).string(); }
  static json document(const fs::path& file) { return json::parse(read_file(file)); }
  static fs::path report_of(const std::string& below) {
    for (const auto& file : fs::recursive_directory_iterator(below)) {
      if (file.path().extension() == ".json") return file.path();
    }
    throw std::runtime_error("no report in " + below);
  }
  static std::unique_ptr<TemporaryFolder> folder_;
};
std::unique_ptr<TemporaryFolder> JsonFiles::folder_;

TEST_F(JsonFiles, IndexForDiff) {
  for (const char* name : {"before", "other"}) {
    fs::create_directory(in(name));
    fs::copy(in("run") + "/index.json", in(name));
  }
  const fs::path file = fs::path(in("other")) / "index.json";
  const auto read = [&] { (void)compare_runs(in("before"), in("other")); };
  EXPECT_GT(read_all_changes(document(file), file, read), 100u);
  for (const auto& [at, value] : std::vector<std::pair<std::string, json>>{{"/schema", 99},
                                                                           {"/schema", "2"},
                                                                           {"/schema", 2.5},
                                                                           {"/tallies/0/cases", -3},
                                                                           {"/variants/0/findings", -1}}) {
    json forged = document(in("run") + "/index.json");
    forged[Pointer(at)] = value;
    std::ofstream(file, std::ios::trunc) << forged.dump();
    EXPECT_THROW(read(), BadInput) << at << value;
  }
  fs::remove_all(in("other"));
}

TEST_F(JsonFiles, IndexForThePage) {
  fs::create_directory(in("page"));
  const fs::path file = fs::path(in("page")) / "index.json";
  const auto read = [&] { (void)PageData(in("page"), in("page")).to_json(); };
  EXPECT_GT(read_all_changes(document(in("run") + "/index.json"), file, read), 100u);
  json without = document(in("run") + "/index.json");
  without["reports"][0].erase("subject");
  std::ofstream(file, std::ios::trunc) << without.dump();
  const Ran ran = nearmiss({"render", in("page")});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(ran.err, fmt::format("nearmiss: {}: reports[0].subject is missing\n", file.string()));
}

TEST_F(JsonFiles, IndexForTriage) {
  fs::create_directory(in("sources"));
  fs::copy(in("run") + "/index.json", in("sources"));
  const fs::path file = fs::path(in("sources")) / "index.json";
  const auto read = [&] {
    const Sources found = read_sources({in("sources")});
    for (const auto& [skipped, why] : found.skipped) {
      if (skipped == file)
        throw BadInput(skipped + ": " + why);  // NOLINT(performance-inefficient-string-concatenation)
    }
  };
  EXPECT_GT(read_all_changes(document(file), file, read), 10u);
}

TEST_F(JsonFiles, Baseline) {
  const fs::path file = in("baseline.json");
  const auto read = [&] { (void)signatures_from_json(parse_json(read_file(file), file.string()), file.string()); };
  EXPECT_GT(read_all_changes(document(triage() + "/triage.json"), file, read), 100u);
}

TEST_F(JsonFiles, TriageForThePage) {
  fs::create_directory(in("triaged"));
  const fs::path file = fs::path(in("triaged")) / "triage.json";
  const auto read = [&] { (void)PageData(in("triaged"), in("triaged")).to_json(); };
  EXPECT_GT(read_all_changes(document(triage() + "/triage.json"), file, read), 50u);
}

TEST_F(JsonFiles, ReportOfATriage) {
  const fs::path file = in("report.json");
  const auto read = [&] {
    const json j = parse_json(read_file(file), file.string());
    const FileValue report(j, file.string());
    const Case question = case_of(j, file.string());
    (void)measure_of(j, file.string());
    (void)read_relation_case(j, file.string());
    (void)kind_in_report(report);
    (void)picture_of(question, report);
    (void)cause_from_json(report.at("cause"));
    Report about;
    about.question = question;
    (void)minimised_from_json(report.at("minimised"), about);
  };
  EXPECT_GT(read_all_changes(document(report_of(triage() + "/simplest")), file, read), 100u);
}

TEST_F(JsonFiles, ReportOfARelation) {
  ASSERT_EQ(wrong({"relations", "-s", "zoo", "-q", "sphere_sphere_overlap", "--bit-for-bit", "--cases", "50", "--seed",
                   "1", "--out", in("relations")}),
            1);
  const fs::path file = in("relation.json");
  const auto read = [&] { (void)read_relation_case(file); };
  const json report = document(report_of(in("relations") + "/relations"));
  EXPECT_GT(read_all_changes(report, file, read, {"truth", "answer", "finding", "contract"}), 50u);
}

TEST_F(JsonFiles, CasesAndStoredCases) {
  const fs::path seeds = source_folder() + "/corpus/seeds/moving_sphere_box/hit-corner.json", file = in("case.json");
  EXPECT_GT(read_all_changes(document(seeds), file, [&] { (void)read_stored_case(file); }), 50u);
  const fs::path worst = report_of(source_folder() + "/corpus/worst/ray_aabox");
  EXPECT_GT(read_all_changes(document(worst), file, [&] { (void)read_worst_case(file); }), 50u);
}

TEST_F(JsonFiles, ScenesAndProfiles) {
  const fs::path file = in("scene.json");
  const fs::path scene = source_folder() + "/corpus/scenes/driving.json";
  EXPECT_GT(read_all_changes(document(scene), file, [&] { (void)scenes::load_scene(file.string()); }), 300u);
  const json profile{{"schema", 1},
                     {"scene", {{"name", "driving"}, {"file", nullptr}}},
                     {"seed", 2},
                     {"cases", 100},
                     {"queries", json::array()},
                     {"missing", {{{"query", "ray_aabox"}, {"why", "none"}}}}};
  const fs::path profile_file = in("profile.json");
  EXPECT_GT(read_all_changes(profile, profile_file, [&] { (void)load_profile(profile_file); }), 30u);
}

/// The state of a sweep of a few hundred floats.
TEST_F(JsonFiles, StateOfASweep) {
  Case question{find_query("sphere_sphere_overlap"), Scalar::float32, {0, 0, 0, 1, 3, 0, 0, 1}, "test", 0, 0, {}};
  const std::uint64_t begin = position_of(1.9999f), end = position_of(2.0001f);
  std::vector<Subject> subjects;
  for (const Subject& s : own_subjects_in_process()) {
    if (s.name == "collide-fast-float") subjects.push_back(s);
  }
  fs::create_directory(in("sweep"));
  const fs::path file = fs::path(in("sweep")) / "sweep.json";
  const auto open = [&] {
    return std::make_unique<Sweep>(SweepSettings{"", in("sweep"), Slice(question, 3), subjects, begin, end, 1});
  };
  open()->run();
  const json state = document(file);
  EXPECT_GT(read_all_changes(state, file, [&] { (void)open(); }), 150u);
  const auto forged = [&](const std::string& at, const json& value) {
    json other = state;
    other[Pointer(at)] = value;
    std::ofstream(file, std::ios::trunc) << other.dump();
    EXPECT_THROW((void)open(), BadInput) << at << value;
  };
  ASSERT_EQ(state.at("done").size(), 1u);
  ASSERT_EQ(state.at("done")[0].at("truth").size(), 2u) << "no decision to forge";
  forged("/done/0/begin", 6100955476804807680u);
  forged("/done/0/begin", end);
  forged("/done/0/end", begin);
  forged("/done/0/end", end + 1);
  forged("/done", json::array({state["done"][0], state["done"][0]}));
  forged("/done/0/truth/1/begin", state["done"][0]["truth"][1]["begin"].get<std::uint64_t>() + 1);
  forged("/done/0/truth/0/decision", "yes");
  forged("/done/0/truth/1/decision", "invalid");
  forged("/subjects/0/asked", 0);
  forged("/subjects/0/violations", end);
  std::ofstream(file, std::ios::trunc) << state.dump();
  EXPECT_TRUE(open()->is_complete());
}

}  // namespace
}  // namespace nearmiss
