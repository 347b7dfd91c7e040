/// The maps of extremes: their JSON, their page, and that they show known errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "corpus/generator/extreme_cases.hpp"
#include "corpus/scenes/scene_cases.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/subject.hpp"
#include "reports/engine/extremes.hpp"
#include "reports/engine/map_cases.hpp"
#include "reports/tests/mistaken_subject.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

json swept(const TemporaryFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"extremes", "--out", (folder / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ran ran = nearmiss(arguments);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  return json::parse(read_file(folder / "out/extremes.json"));
}

const json& map_of(const json& report, const std::string& subject, const std::string& y) {
  for (const json& m : report.at("maps")) {
    if (m.at("subject") == subject && m.at("y").at("axis") == y) return m;
  }
  throw std::logic_error("no map of " + subject);
}

TEST(Extremes, WriteJsonThatTheSchemaTakesAndAPageWithTheData) {
  const TemporaryFolder folder;
  const json report =
      swept(folder, {"--query", "sphere_sphere_overlap", "--query", "moving_point_plane", "--cases", "2"});
  EXPECT_EQ(complaints(report, "extremes.schema.json"), "");
  EXPECT_EQ(report.at("state"), "finished");
  for (const json& m : report.at("maps")) {
    const std::size_t columns = m.at("x").at("values").size(), rows = m.at("y").at("values").size();
    for (const char* matrix : {"cases", "false_hits", "false_misses", "forward_ulps", "backward_epsilon"}) {
      ASSERT_EQ(m.at(matrix).size(), rows);
      for (const json& row : m.at(matrix)) ASSERT_EQ(row.size(), columns);
    }
  }
  const auto file = folder / "out/extremes.html";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "SKIP_ this build found no node-d3";
  const std::string page = read_file(file);
  const std::string open = R"(<script type="application/json" id="data">)";
  const std::size_t begin = page.find(open) + open.size();
  std::string data = page.substr(begin, page.find("</script>", begin) - begin);
  EXPECT_EQ(json::parse(data), report);
  EXPECT_NE(page.find("https://d3js.org v5."), std::string::npos);
  for (const char* other_file : {"<script src", "<link", "<img", "@import"}) {
    EXPECT_EQ(page.find(other_file), std::string::npos) << "a page that needs another file";
  }
}

TEST(Extremes, ShowThatFloatEndsBeforeDoubleAndThatCertifiedStaysRight) {
  const TemporaryFolder folder;
  const json report = swept(folder, {"--query", "sphere_sphere_overlap", "--cases", "20"});
  const auto sum = [](const json& matrix, std::size_t first_row, std::size_t rows) {
    std::uint64_t all = 0;
    for (std::size_t j = first_row; j < first_row + rows; ++j) {
      for (const json& count : matrix.at(j)) all += count.get<std::uint64_t>();
    }
    return all;
  };
  const json &fast_float = map_of(report, "collide-fast-float", "scale"),
             &fast_double = map_of(report, "collide-fast-double", "scale");
  const auto scales = values_of(ExtremeAxis::scale);
  const std::size_t rows = scales.size(), last = rows - 1;
  EXPECT_EQ(sum(fast_float.at("cases"), last, 1), 0u) << "2^1000 in float";
  EXPECT_GT(sum(fast_double.at("cases"), last, 1), 0u);
  const auto wrong = [&](const json& m) {
    return sum(m.at("false_hits"), 0, rows) + sum(m.at("false_misses"), 0, rows) + sum(m.at("not_finite"), 0, rows);
  };
  EXPECT_GT(wrong(fast_float), 0u) << "squares of tiny and huge numbers";
  EXPECT_GT(wrong(fast_double), 0u);
  EXPECT_EQ(wrong(map_of(report, "collide-certified-double", "scale")), 0u);
}

TEST(Extremes, WriteWhatTheyHaveWhenInterrupted) {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  const std::string script = "'" + nearmiss_program() + "' extremes --cases 100000 --out '" + out +
                             "' & run=$!; while [ ! -e '" + out + "' ]; do sleep 0.05; done; sleep 0.3; " +
                             "kill -INT $run; wait $run";
  const Ran ran = run_program("bash", {"-m", "-c", script});
  EXPECT_EQ(ran.exit_code, 2) << ran.out << ran.err;
  const json report = json::parse(read_file(folder / "out/extremes.json"));
  EXPECT_EQ(complaints(report, "extremes.schema.json"), "");
  EXPECT_EQ(report.at("state"), "interrupted");
  EXPECT_TRUE(last_line(ran.out).starts_with("interrupted: ")) << ran.out;
}

/// The plugin loops forever on about half of all cases beyond 1e9.
TEST(Extremes, GiveUpASubjectThatDoesNotComeBackAndSaySo) {
  const TemporaryFolder folder;
  const json report = swept(folder, {"--plugin", plugin_file("misbehaves"), "--subject", "misbehaves", "--query",
                                     "sphere_sphere_overlap", "--cases", "12", "--patience", "0.05"});
  EXPECT_EQ(complaints(report, "extremes.schema.json"), "");
  const json& m = map_of(report, "misbehaves", "scale");
  const std::size_t rows = m.at("y").at("values").size(), columns = m.at("x").at("values").size();
  std::uint64_t time_outs = 0, asked_before = 0, given_up = 0;
  for (std::size_t j = 0; j < rows; ++j) {
    std::uint64_t in_row = 0, given_up_in_row = 0;
    for (std::size_t i = 0; i < columns; ++i) {
      in_row += m.at("broke")[j][i].get<std::uint64_t>();
      given_up_in_row += m.at("gave_up")[j][i].get<std::uint64_t>();
      const auto asked = m.at("cases")[j][i].get<std::uint64_t>() + m.at("broke")[j][i].get<std::uint64_t>();
      EXPECT_LE(asked + m.at("gave_up")[j][i].get<std::uint64_t>(), 12u);
      if (given_up == 0) asked_before += asked;
    }
    EXPECT_LE(in_row, 3u + 2u) << "three, and those that were asked together with the third";
    EXPECT_TRUE(given_up_in_row == 0 || in_row + time_outs >= 3);
    time_outs += in_row;
    given_up += given_up_in_row;
  }
  EXPECT_LE(time_outs, 12u + 2u);
  EXPECT_GT(given_up, 0u);
  EXPECT_GT(asked_before, 100u) << "where it answers, it is asked";
}

/// It breaks at once in every case, and a map has thousands.
TEST(Extremes, GiveUpASubjectThatAlwaysBreaksAndSaySo) {
  const TemporaryFolder folder;
  const std::string file = folder.file("breaks.sh", R"(
echo '{"nearmiss": 3, "name": "breaks", "scalar": "double", "batches": "json", "offers": [{"query": "sphere_sphere_overlap"}]}' >&4
read -r batch <&3 && exit 7
)");
  const json report = swept(
      folder, {"--command", "sh " + file, "--subject", "breaks", "--query", "sphere_sphere_overlap", "--cases", "4"});
  EXPECT_EQ(complaints(report, "extremes.schema.json"), "");
  for (const json& m : report.at("maps")) {
    const auto total = [&](const char* member) {
      std::uint64_t sum = 0;
      for (const json& row : m.at(member)) {
        for (const json& cell : row) sum += cell.get<std::uint64_t>();
      }
      return sum;
    };
    const std::uint64_t broke = total("broke"), gave_up = total("gave_up");
    EXPECT_GE(broke, 64u);
    EXPECT_LE(broke, 64u + 2u) << "64, and those that were asked together with the last";
    EXPECT_GT(gave_up, 100u);
  }
}

/// A map begins in a corner of extreme numbers: breaking there says nothing of the rest.
TEST(Extremes, AskOnWhereAnOrdinaryCaseIsAnswered) {
  const Subject s = subject_with("sphere_sphere_overlap", [](std::span<const double> values) -> Answer {
    for (const double x : values) {
      if (std::abs(x) > 1e3 || (x != 0 && std::abs(x) < 1e-3)) throw std::runtime_error("not for such numbers");
    }
    return exact_answer("sphere_sphere_overlap", values);
  });
  const TemporaryFolder folder;
  ExtremesSettings settings;
  settings.folder = folder / "out";
  settings.queries = {find_query("sphere_sphere_overlap")};
  settings.subjects = {&s};
  settings.cases = 8;
  Extremes extremes(settings);
  extremes.fill();
  const json report = extremes.to_json();
  std::uint64_t answered = 0, broke = 0, gave_up = 0;
  for (const json& m : report.at("maps")) {
    for (std::size_t j = 0; j < m.at("cases").size(); ++j) {
      for (std::size_t i = 0; i < m.at("cases")[j].size(); ++i) {
        answered += m.at("cases")[j][i].get<std::uint64_t>();
        broke += m.at("broke")[j][i].get<std::uint64_t>();
        gave_up += m.at("gave_up")[j][i].get<std::uint64_t>();
      }
    }
  }
  EXPECT_GT(broke, 64u);
  EXPECT_GT(answered, 0u);
  EXPECT_EQ(gave_up, 0u);
}

TEST(Extremes, GiveTheSameMapsForTheSameSeed) {
  const TemporaryFolder one, two;
  const std::vector<std::string> words{"--query", "moving_point_plane", "--subject", "collide-fast-float", "--cases",
                                       "5"};
  EXPECT_EQ(swept(one, words).at("maps"), swept(two, words).at("maps"));
}

const MapAxis& axis_of(const MapPlane& plane, const std::string& name) {
  for (const MapAxis* a : {&plane.x, &plane.y}) {
    if (a->name == name) return *a;
  }
  throw std::logic_error("no axis " + name);
}

void expect_within(const MapAxis& axis, double least, double most) {
  for (const double v : axis.values) {
    EXPECT_GE(v, least) << axis.name;
    EXPECT_LE(v, most) << axis.name;
  }
  EXPECT_TRUE(std::is_sorted(axis.values.begin(), axis.values.end()));
}

/// Cars and people of the scene driving: 10^5 to 10^6 m from the origin, 0.25 to 3 m large, 16.7 to 40 m/s fast.
TEST(SceneMaps, HaveTheRangesOfTheScene) {
  const scenes::Scene scene = scenes::load_scene("driving");
  const auto source = scene_map_cases(scene);
  const std::vector<MapPlane> planes = source->planes_of(*find_query("moving_sphere_box"));
  ASSERT_EQ(planes.size(), 2u);
  const double corner = 2000 * std::sqrt(3.0) + 10;  // of the cube, and the way of a step
  expect_within(axis_of(planes[0], "distance"), 1e5 - corner, 1e6 + corner);
  expect_within(axis_of(planes[0], "size"), 0.7, 3);
  expect_within(axis_of(planes[1], "speed"), 16.7, 40);
  EXPECT_EQ(axis_of(planes[0], "distance").unit, "metre from the origin");
  EXPECT_EQ(axis_of(planes[1], "speed").unit, "metre a second");
  for (const MapPlane& p : planes) EXPECT_EQ(p.x.values.size() * p.y.values.size(), 64u);
}

/// Each case of a cell is one of the scene, nearer to the cell's distance than to that of any other column.
TEST(SceneMaps, SortTheCasesOfTheSceneIntoCells) {
  const scenes::Scene scene = scenes::load_scene("driving");
  const Query& query = *find_query("moving_sphere_box");
  const auto source = scene_map_cases(scene);
  const MapPlane plane = source->planes_of(query)[0];
  const MapCases::Cells cells = source->cells(query, 0, Scalar::float64, 3, 4);
  std::size_t all = 0, columns = plane.x.values.size();
  for (std::size_t cell = 0; cell < columns * plane.y.values.size(); ++cell) {
    const std::vector<Case> cases = cells(cell);
    EXPECT_LE(cases.size(), 4u);
    all += cases.size();
    for (const Case& c : cases) {
      EXPECT_EQ(c.values, scenes::draw_case(scene, query, Scalar::float64, 3, c.index).values);
      const double distance = std::hypot(c.values[0], c.values[1], c.values[2]);
      const auto of = [&](std::size_t column) { return std::abs(std::log(distance / plane.x.values[column])); };
      for (std::size_t other = 0; other < columns; ++other) EXPECT_LE(of(cell % columns), of(other) + 1e-4);
    }
  }
  EXPECT_GT(all, 64u * 3);
}

TEST(Sweeps, MakeCasesThatAreValidAndExactInTheirScalarForMostPlaces) {
  for (const Query& q : catalogue()) {
    for (const ExtremePlane& plane : planes_of(q)) {
      int made = 0, places = 0;
      for (const double x : values_of(plane.x)) {
        for (const double y : values_of(plane.y)) {
          ++places;
          const auto c = extreme_case(q, Scalar::float64, 1, 3, plane, x, y);
          if (!c) continue;
          ++made;
          ASSERT_FALSE(q.broken(c->values));
          EXPECT_EQ(extreme_case(q, Scalar::float64, 1, 3, plane, x, y)->values, c->values);
        }
      }
      EXPECT_GE(made, places * 9 / 10) << q.name << " " << name_of(plane.x).name << " " << name_of(plane.y).name;
    }
  }
}

}  // namespace
}  // namespace nearmiss
