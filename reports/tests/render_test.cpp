/// The page's data: pictures are complete and exact, plots show where a subject is wrong, and bad folders are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/findings/report.hpp"
#include "reports/page/error_plot.hpp"
#include "reports/page/picture.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const Subject& exact_subject() {
  static const std::vector<Subject> own = own_subjects_in_process();
  return *std::find_if(own.begin(), own.end(), [](const Subject& s) { return s.name == "collide-certified-double"; });
}

/// What a picture takes from a report: the exact answer as the claimed one, or a changed one, and the truth.
json report_on(const Case& question, const std::function<void(Answer&)>& change = {}) {
  Answer answer = exact_subject().offering(question.query->name).answer(question.values);
  if (change) change(answer);
  return {{"answer", answer_to_json(*question.query, answer)},
          {"truth", truth_to_json(*question.query, question.scalar, truth_of(question))}};
}

json picture_in(const Case& question, const json& report) { return picture_of(question, FileValue(report, "report")); }

Case question_of(const char* query, std::vector<double> values) {
  return {find_query(query), Scalar::float64, std::move(values), "test", 0, 0, {}};
}

std::size_t index_of(const Query& query, const std::string& output) {
  const auto at =
      std::find_if(query.outputs.begin(), query.outputs.end(), [&](const Field& f) { return f.name == output; });
  return std::size_t(at - query.outputs.begin());
}

const json& shape_named(const json& picture, const std::string& name) {
  const json& shapes = picture.at("shapes");
  return *std::find_if(shapes.begin(), shapes.end(), [&](const json& s) { return s.at("name") == name; });
}

/// Of every query, including one that was added to the catalogue: whatever is not a number by itself is drawn.
TEST(Picture, HasTheShapesOfEveryQuery) {
  for (const Query& q : catalogue()) {
    std::set<std::string> drawn, expected;
    for (const fs::directory_entry& file :
         fs::directory_iterator(source_folder() + "/corpus/seeds/" + std::string(q.name))) {
      const Case question = *in_scalar(read_case(file.path()), Scalar::float64);
      const json picture = picture_in(question, report_on(question));
      EXPECT_EQ(complaints(picture, "picture.schema.json"), "") << file.path();
      for (const json& s : picture.at("shapes")) drawn.insert(s.at("name").get<std::string>());
      if (!picture.at("motion").is_null()) drawn.insert("velocity");
      for (const Field& f : q.inputs) {
        const std::string name = f.name.substr(0, f.name.find('.'));
        if (name != f.name && (name != "velocity" || !picture.at("motion").is_null())) expected.insert(name);
      }
    }
    EXPECT_EQ(drawn, expected) << q.name;
  }
}

TEST(Picture, KnowsWhatMoves) {
  const Case c = question_of("moving_sphere_sphere", {-4, 0, 0, 1, 2, 0, 0, 3, 0, 0, 2});
  const json picture = picture_in(c, report_on(c));
  EXPECT_EQ(shape_named(picture, "sphere").at("moves"), true);
  EXPECT_EQ(shape_named(picture, "fixed").at("moves"), false);
  const double unit = std::ldexp(1.0, picture.at("unit_exponent").get<int>());
  EXPECT_EQ(picture.at("motion").at("time"), 2);  // the gap of 4 at the speed 2
  EXPECT_EQ(picture.at("motion").at("start").get<double>() * unit, -4);
  EXPECT_EQ(picture.at("anchor"), json({1, 0, 0}));
  EXPECT_DOUBLE_EQ(shape_named(picture, "sphere").at("corners")[0][0].get<double>() * unit,
                   -1);  // at the time of contact
}

/// A claimed place one ulp beside the true one is exactly one ulp away, however far from the origin.
TEST(Picture, TellsAnUlp) {
  const double x = 1e6, next = std::nextafter(x, 2e6);
  const Case c = question_of("ray_aabox", {2e6, 0.5, 0.5, -1, 0, 0, 0, 0, 0, x, 1, 1});
  const std::size_t place = index_of(*c.query, "location.x");
  const json picture = picture_in(c, report_on(c, [&](Answer& a) { a.values[place] = next; }));
  const double unit = std::ldexp(1.0, picture.at("unit_exponent").get<int>());
  EXPECT_EQ(picture.at("anchor")[0], x);
  EXPECT_EQ(picture.at("ulp").get<double>() * unit, next - x);
  for (const json& contact : picture.at("contacts")) {
    EXPECT_EQ(contact.at("at")[0].get<double>() * unit, contact.at("of") == "true" ? 0 : next - x);
  }
}

/// The middle of a square is as near to each of its sides: the true point is that of the side which the subject chose.
TEST(Picture, PrefersTheRightAnswerThatIsNearest) {
  const Case c = question_of("closest_point_rectangle_perimeter", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 0});
  const std::size_t x = index_of(*c.query, "point.x"), y = index_of(*c.query, "point.y");
  for (const double side : {-1.0, 1.0}) {
    const json picture = picture_in(c, report_on(c, [&](Answer& a) { a.values[x] = 0, a.values[y] = side; }));
    EXPECT_EQ(picture.at("anchor"), json({0, side, 0}));
    const json& contacts = picture.at("contacts");
    EXPECT_EQ(std::count_if(contacts.begin(), contacts.end(), [](const json& k) { return k.at("of") == "true"; }), 1);
    EXPECT_EQ(std::count_if(contacts.begin(), contacts.end(), [](const json& k) { return k.at("of") == "also true"; }),
              3);
  }
}

/// The distance of a large ball is right where the square root of doubles has an error of 1e-8.
TEST(Picture, HasNoCancellation) {
  const double r = 1e8 + 1;
  const Case c = question_of("sphere_sphere_overlap", {0, 0, 0, 0, r, 1, 0, r});
  const json picture = picture_in(c, report_on(c));
  const double unit = std::ldexp(1.0, picture.at("unit_exponent").get<int>()),
               gap = 1 / (2 * r);  // of (r, 1, 0) to the origin, but for 1/(8 r^3)
  EXPECT_NEAR(std::hypot(picture.at("anchor")[0].get<double>(), picture.at("anchor")[1].get<double>()), gap,
              1e-6 * gap);
  EXPECT_LT(std::abs(shape_named(picture, "sphere2").at("distances")[0].get<double>()) * unit, 1e-22);
  EXPECT_NEAR(shape_named(picture, "sphere1").at("distances")[0].get<double>() * unit, gap, 1e-6 * gap);
}

/// Of the corners of a box those behind the plane, as the answer lists them.
TEST(Picture, HasEveryContact) {
  const Case c = question_of("box_plane_penetration", {0, 0, 0, 1, 2, 3, 0, 0, 0, 1, 0, 0, 1, 0});
  const json picture = picture_in(c, report_on(c));
  std::map<std::string, std::set<json>> places;
  for (const json& contact : picture.at("contacts")) places[contact.at("of")].insert(contact.at("at"));
  EXPECT_EQ(places["true"].size(), 4u);
  EXPECT_EQ(places["claimed"], places["true"]);
}

/// Numbers of which products and differences leave the range of double.
TEST(Picture, HoldsTheLargestNumbers) {
  const double most = largest_finite(Scalar::float64);
  const Case c = question_of("sphere_sphere_overlap", {-most, 0, 0, 1, most, 0, 0, 1});
  const json picture = picture_in(c, report_on(c));
  EXPECT_EQ(complaints(picture, "picture.schema.json"), "");
}

Answer blind_above_three(std::span<const double> values) {
  Answer a = exact_subject().offering("sphere_sphere_overlap").answer(values);
  if (values[3] > 3) a.yes = false;
  return a;
}

TEST(ErrorPlot, ShowsWhereASubjectIsWrong) {
  Subject s = exact_subject();
  s.name = "mistaken";
  std::erase_if(s.offerings, [](const Offering& o) { return o.query != "sphere_sphere_overlap"; });
  s.offerings.at(0).answer = blind_above_three;
  Workers workers;
  const Case c = question_of("sphere_sphere_overlap", {0, 0, 0, 4, 1, 0, 0, 0});
  const json plots = error_plots(c, s, workers, [] { return true; });
  ASSERT_EQ(plots.size(), 8u);
  const json no_fault("");
  std::size_t misses = 0, invalid = 0, right = 0;
  for (const json& sample : plots[3].at("samples")) {
    const double radius = sample[1];
    const json expected = radius < 0 ? json(nullptr) : radius > 3 ? json("false miss") : no_fault;
    EXPECT_EQ(sample[2], expected) << radius;
    misses += sample[2] == "false miss";
    invalid += sample[2].is_null();
    right += sample[2] == no_fault;
  }
  EXPECT_GT(misses, 5u);
  EXPECT_GT(invalid, 0u);
  EXPECT_GT(right, 0u);
  for (const json& sample : plots[7].at("samples")) {
    EXPECT_TRUE(sample[2].is_null() || sample[2] == "false miss") << sample;
  }
  EXPECT_TRUE(error_plots(c, s, workers, [] { return false; }).empty());
}

/// The data of a written page.
json data_of_page(const fs::path& file) {
  const std::string page = read_file(file), mark = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(mark) + mark.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

class Render : public testing::Test {
 protected:
  void SetUp() override {
    const Ran ran = nearmiss({"render", folder_.path().string()});
    if (ran.err.find("this build writes no pages") != std::string::npos) GTEST_SKIP() << ran.err;
  }
  /// Expects one line on standard error with these words, and no page.
  void expect_refused(const std::string& words) const {
    const Ran ran = nearmiss({"render", folder_.path().string()});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_FALSE(fs::exists(folder_ / "index.html"));
  }
  TemporaryFolder folder_;
};

TEST_F(Render, ShowsARun) {
  const std::string plugin = plugin_file("skim_plugin"), run = (folder_ / "night").string();
  ASSERT_EQ(nearmiss({"run", "--plugin", plugin, "-s", "skim", "-q", "closest_point_segment", "--cases", "2000",
                      "--seed", "1", "--out", run})
                .exit_code,
            1);
  folder_.file("night/findings/closest_point_segment/foreign.json", "{}");
  folder_.file("extremes.html", "maps");
  const Ran ran = nearmiss({"render", "--plugin", plugin, folder_.path().string()});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json data = data_of_page(folder_ / "index.html");
  EXPECT_EQ(complaints(data, "page.schema.json"), "");
  EXPECT_EQ(data.at("trend").size(), 1u);
  EXPECT_EQ(data.at("extremes"), json({"extremes.html"}));
  ASSERT_FALSE(data.at("rows").empty());
  EXPECT_EQ(data.at("reports").size(), data.at("rows").size());
  EXPECT_TRUE(data.at("skipped").empty()) << data.at("skipped");
  for (const json& file : data.at("reports")[0].at("details").at("files"))
    EXPECT_TRUE(fs::exists(folder_ / file.get<std::string>())) << file;
  const json worst = json::parse(data.at("reports")[0].at("worst").get<std::string>());
  EXPECT_EQ(complaints(worst.at("report"), "report.schema.json"), "");
  EXPECT_EQ(complaints(worst.at("picture"), "picture.schema.json"), "");
  EXPECT_EQ(worst.at("plots").size(), 9u);
}

TEST_F(Render, ShowsTheTriageOfARunThatWasMoved) {
  const std::string plugin = plugin_file("skim_plugin"), run = (folder_ / "run").string();
  ASSERT_EQ(nearmiss({"run", "--plugin", plugin, "--subject", "skim", "--cases", "20000", "--seed", "1", "--out", run})
                .exit_code,
            1);
  ASSERT_EQ(nearmiss({"triage", run, "--plugin", plugin}).exit_code, 1);
  fs::rename(run, folder_ / "moved");
  const Ran ran = nearmiss({"render", "--plugin", plugin, (folder_ / "moved").string()});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json data = data_of_page(folder_ / "moved" / "index.html");
  EXPECT_EQ(complaints(data, "page.schema.json"), "");
  EXPECT_EQ(data.at("rows").size(), 3u);
  EXPECT_TRUE(data.at("skipped").empty()) << data.at("skipped");
  ASSERT_EQ(data.at("reports").size(), 3u);
  for (const json& row : data.at("reports")) {
    EXPECT_FALSE(row.at("details").at("cause").at("evidence").empty()) << row.at("details");
    EXPECT_NE(row.at("simplest").get<std::string>(), row.at("worst").get<std::string>());
  }
}

TEST_F(Render, NamesReportsThatItCannotRead) {
  folder_.file("bad.json", "{\"query\": ");
  folder_.file("triage.json", R"({"schema": 1, "environment": {}, "sources": [], "skipped": [], "totals": {},
    "signatures": [{"id": "0123456789ab", "query": "ray_aabox", "subject": "</script>", "worst": "bad.json"},
                   {"id": "0123456789ac", "severity": 3, "worst": "none.json"}]})");
  ASSERT_EQ(nearmiss({"render", folder_.path().string()}).exit_code, 0);
  const json data = data_of_page(folder_ / "index.html");
  EXPECT_EQ(complaints(data, "page.schema.json"), "");
  ASSERT_EQ(data.at("skipped").size(), 2u);
  EXPECT_EQ(data.at("skipped")[0].at("file"), "none.json");  // the more severe one
  EXPECT_EQ(data.at("skipped")[1].at("file"), "bad.json");
  EXPECT_NE(std::find(data.at("words").begin(), data.at("words").end(), "</script>"), data.at("words").end());
}

TEST_F(Render, HoldsTheTradesOfTheFolder) {
  const std::string trade = R"({"schema": 1, "scene": "cell", "title": "</script>", "queries": [], "profile": {},
    "tolerance": {}})";
  folder_.file("triage.json", R"({"schema": 1, "environment": {}, "sources": [], "skipped": [], "totals": {},
    "signatures": []})");
  for (const char* name : {"trade", "a", "b", "c"}) {
    fs::create_directory(folder_ / name);
    folder_.file(std::string(name) + "/trade.json", *name == 'c' ? R"({"schema": "1"})" : trade);
  }
  ASSERT_EQ(nearmiss({"render", folder_.path().string()}).exit_code, 0);
  const json data = data_of_page(folder_ / "index.html");
  EXPECT_EQ(complaints(data, "page.schema.json"), "");
  const json& trades = data.at("trades");
  ASSERT_EQ(trades.size(), 3u);
  EXPECT_EQ(trades[0], json({{"name", "cell"}, {"trade", json::parse(trade)}}));
  EXPECT_EQ(trades[1].at("name"), "cell (a)");
  EXPECT_EQ(trades[2].at("name"), "cell (b)");
  ASSERT_EQ(data.at("skipped").size(), 1u);
  EXPECT_EQ(data.at("skipped")[0].at("why"), "it is not a trade of schema 1");
  EXPECT_FALSE(fs::exists(folder_ / "trade" / "trade.html"));
}

TEST_F(Render, RefusesFoldersWithoutFindings) {
  expect_refused("it holds neither triage.json nor a run's index.json");
  folder_.file("index.json", "[1");
  expect_refused("index.json: at [1]: ");
  folder_.file("index.json", "[1]");
  expect_refused("index.json: it is not a JSON object");
  folder_.file("index.json", R"({"schema": 1})");
  expect_refused("schema is 1: it must be 2");
  folder_.file("triage.json", R"({"schema": 7, "signatures": []})");
  expect_refused("schema is 7: it must be 1");
  folder_.file("triage.json", R"({"schema": 1, "signatures": [3]})");
  expect_refused("signatures[0] is 3: it must be an object");
  EXPECT_EQ(nearmiss({"render", (folder_ / "no such folder").string()}).exit_code, 2);
}

}  // namespace
}  // namespace nearmiss
