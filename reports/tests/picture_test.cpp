/// Pictures of findings: what is drawn stands where it should, the exact and the given answer can be told apart, and
/// the stored pictures are what this build draws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files/files.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "impl/host/engines.hpp"
#include "impl/subject/provenance.hpp"
#include "oracles/requirements.hpp"
#include "reports/findings/report.hpp"
#include "reports/picture/flat_picture.hpp"
#include "reports/picture/svg_picture.hpp"
#include "reports/picture/text_picture.hpp"
#include "reports/tests/program.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

/// A report with the truth, and with an answer that gives these numbers.
Report report_on(const char* query, std::vector<double> values, bool yes, std::vector<double> answer = {}) {
  Report r;
  r.question = {find_query(query), Scalar::float64, std::move(values), "test", 0, 0, {}};
  r.subject = "tested";
  r.truth = truth_of(r.question);
  r.answer.yes = yes;
  r.answer.count = std::uint8_t(answer.size());
  r.answer.given = (std::uint64_t{1} << answer.size()) - 1;
  std::ranges::copy(answer, r.answer.values.begin());
  return r;
}

const FlatOutline& outline_of(const FlatView& v, Ink ink) {
  return *std::ranges::find(v.outlines, ink, &FlatOutline::ink);
}
bool has_mark(const FlatView& v, Ink ink) { return std::ranges::count(v.marks, ink, &FlatMark::ink) == 1; }
FlatPoint mark_of(const FlatView& v, Ink ink) { return std::ranges::find(v.marks, ink, &FlatMark::ink)->at; }
FlatPoint arrow_of(const FlatView& v, Ink ink) {
  const FlatArrow& a = *std::ranges::find(v.arrows, ink, &FlatArrow::ink);
  return a.to - a.from;
}
void expect_near(const FlatPoint& is, const FlatPoint& should) {
  EXPECT_NEAR(is.right, should.right, 1e-9);
  EXPECT_NEAR(is.up, should.up, 1e-9);
}
std::string text_of(const FlatPicture& p, Ink ink) { return std::ranges::find(p.legend, ink, &FlatLegend::ink)->text; }

/// A sphere of radius 1 flies along x from 4 to a sphere of radius 2, which it meets at time 1; the answer says 2.
const std::vector<double> flight = {4, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2};
const std::vector<double> late_hit = {2, 2, 0, 0, 1, 0, 0};

TEST(FlatPicture, DrawsAMotionWhereItIs) {
  const FlatPicture p = flat_picture(report_on("moving_sphere_sphere", flight, true, late_hit));
  ASSERT_EQ(p.views.size(), 2u);
  for (const FlatView& v : p.views) {
    const double unit = v.pixels_per_unit;
    const FlatPoint fixed = outline_of(v, Ink::other_shape).corners[0];
    EXPECT_DOUBLE_EQ(outline_of(v, Ink::other_shape).radius, 2 * unit);
    EXPECT_DOUBLE_EQ(outline_of(v, Ink::first_shape).radius, unit);
    expect_near(outline_of(v, Ink::first_shape).corners[0] - fixed, {4 * unit, 0});
    expect_near(outline_of(v, Ink::exact).corners[0] - fixed, {3 * unit, 0});
    expect_near(outline_of(v, Ink::given).corners[0] - fixed, {2 * unit, 0});
    expect_near(mark_of(v, Ink::exact) - fixed, {2 * unit, 0});
    EXPECT_NEAR(arrow_of(v, Ink::exact).up, 0, 1e-9);
    EXPECT_GT(arrow_of(v, Ink::exact).right, 0);
    expect_near(arrow_of(v, Ink::way), {-2 * unit, 0});
    for (const FlatOutline& o : v.outlines) {
      EXPECT_LE(std::abs(o.corners[0].right) + o.radius, FlatView::width / 2);
      EXPECT_LE(std::abs(o.corners[0].up) + o.radius, FlatView::height / 2);
    }
  }
  EXPECT_EQ(text_of(p, Ink::exact), "exactly, it is a hit at time 1, normal (1, 0, 0)");
  EXPECT_EQ(text_of(p, Ink::given), "given: it is a hit at time 2, normal (1, 0, 0)");
  // The axes of both views have x to the right; what is upward differs.
  expect_near(p.views[0].axes[0], {1, 0});
  expect_near(p.views[0].axes[1], {0, 1});
  expect_near(p.views[1].axes[2], {0, 1});
}

/// The angle of two normals, and the ratio of two depths, are in the first view what they are in space.
TEST(FlatPicture, NormalsAndDepthsHaveTheirSize) {
  // Centers 2 apart along (1, 2, 2) / 3, radii 2 and 2: a depth of 2. The given normal is 60 degrees off.
  const double third = 1 / 3.0;
  const PictureVector n{third, 2 * third, 2 * third}, across = unit(cross(n, {0, 0, 1}));
  const PictureVector given = n * PictureReal(0.5) + across * sqrt(PictureReal(0.75));
  const FlatPicture p =
      flat_picture(report_on("sphere_sphere_penetration", {0, 0, 0, 2, 2 * third, 4 * third, 4 * third, 2}, true,
                             {1, rounded(given.x), rounded(given.y), rounded(given.z), 0, 0, 0}));
  const FlatPoint a = arrow_of(p.views.at(0), Ink::exact), b = arrow_of(p.views[0], Ink::given);
  EXPECT_NEAR(a.length(), 2 * p.views[0].pixels_per_unit, 1e-9);
  EXPECT_NEAR(b.length(), p.views[0].pixels_per_unit, 1e-9);
  EXPECT_NEAR((a.right * b.right + a.up * b.up) / (a.length() * b.length()), 0.5, 1e-9);
}

TEST(FlatPicture, MarksWhereTheDecisionsDiffer) {
  // Boxes of half 1, 0.5 apart along x; and overlapping by 0.5.
  const auto boxes = [](double x) {
    return std::vector<double>{0, 0, 0, 1, 1, 1, 0, 0, 0, 1, x, 0, 0, 1, 1, 1, 0, 0, 0, 1, -1};
  };
  const FlatPicture hit = flat_picture(report_on("box_box_overlap", boxes(2.5), true));
  const FlatPicture miss = flat_picture(report_on("box_box_overlap", boxes(1.5), false));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(has_mark(hit.views.at(i), Ink::given));
    EXPECT_FALSE(has_mark(hit.views[i], Ink::exact));
    EXPECT_TRUE(has_mark(miss.views.at(i), Ink::exact));
    EXPECT_FALSE(has_mark(miss.views[i], Ink::given));
  }
  // On the surface of the second box, which begins at x = 1.5: 2.5 units right of the left side.
  const FlatView& v = hit.views[0];
  double left = HUGE_VAL;
  for (const FlatPoint& c : outline_of(v, Ink::first_shape).corners) left = std::min(left, c.right);
  EXPECT_NEAR(mark_of(v, Ink::given).right - left, 2.5 * v.pixels_per_unit, 1e-6);
  EXPECT_EQ(text_of(hit, Ink::given), "given: they touch or overlap");
  EXPECT_EQ(text_of(hit, Ink::exact), "exactly, they are apart");
}

/// Nearly parallel capsules that meet at one end only: an alternating projection hardly moves along them.
TEST(FlatPicture, FindsWhereNearlyParallelShapesMeet) {
  const FlatPicture p = flat_picture(
      report_on("capsule_capsule_overlap", {0, 0.125, 0, 128, 0, 0, 0.01, 0, 0, 0, 128, 0, 0, 0.01}, false));
  ASSERT_EQ(p.views.size(), 3u) << "the capsules are thinner than a line";
  const FlatView& v = p.views[0];
  const std::vector<FlatPoint>& first = outline_of(v, Ink::first_shape).corners;
  EXPECT_GT(mark_of(v, Ink::exact).right, std::max(first[0].right, first[1].right) - 20 * v.pixels_per_unit);
}

TEST(FlatPicture, EnlargesWhatIsTooSmall) {
  const auto in_a_ball = [](double size) {
    return flat_picture(report_on("sphere_triangle_overlap", {0, 0, 0, 1, 0, 0, 0, size, 0, 0, 0, size, 0}, false));
  };
  EXPECT_EQ(in_a_ball(0.5).views.size(), 2u);
  const FlatPicture p = in_a_ball(1e-3);
  ASSERT_EQ(p.views.size(), 3u);
  const FlatView &whole = p.views[0], &enlarged = p.views[2];
  EXPECT_DOUBLE_EQ(enlarged.enlarged, enlarged.pixels_per_unit / whole.pixels_per_unit);
  const std::vector<FlatPoint>& corners = outline_of(enlarged, Ink::other_shape).corners;
  EXPECT_GT((corners[1] - corners[0]).length(), 30) << "pixels";
  // The frame in the first view surrounds the triangle.
  const FlatOutline& frame = outline_of(whole, Ink::frame);
  for (const FlatPoint& c : outline_of(whole, Ink::other_shape).corners) {
    EXPECT_GT(c.right, frame.corners[0].right);
    EXPECT_LT(c.right, frame.corners[2].right);
  }
  // What is exactly 0 cannot be enlarged.
  EXPECT_EQ(in_a_ball(0).views.size(), 2u);
}

/// Of several right answers the one that is nearest to the given one is drawn.
TEST(FlatPicture, DrawsTheRightAnswerThatIsNearest) {
  for (const double side : {-1.0, 1.0}) {
    const FlatPicture p = flat_picture(report_on(
        "closest_point_rectangle_perimeter", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 0}, true, {0, side, 0}));
    const FlatView& v = p.views.at(0);
    expect_near(mark_of(v, Ink::exact), mark_of(v, Ink::given));
    EXPECT_NEAR(mark_of(v, Ink::exact).up, side * v.pixels_per_unit, 1e-9);
  }
}

TEST(FlatPicture, HullsAreConvex) {
  const std::vector<FlatPoint> hull = convex_hull({{0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}, {1, 1}, {0, 0}});
  ASSERT_EQ(hull.size(), 4u);
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i)
    area += (hull[i].right * hull[(i + 1) % 4].up - hull[i].up * hull[(i + 1) % 4].right) / 2;
  EXPECT_EQ(area, 4) << "counterclockwise";
  EXPECT_EQ(convex_hull({{0, 0}, {1, 1}, {2, 2}}).size(), 2u);
  EXPECT_EQ(convex_hull({{1, 1}, {1, 1}}).size(), 1u);
}

TEST(FlatPicture, IsEmptyWhereNothingCanBeDrawn) {
  const double nan = std::nan("");
  Report r = report_on("sphere_sphere_overlap", {0, 0, 0, 1, 3, 0, 0, 1}, true);
  r.question.values[0] = nan;
  EXPECT_TRUE(flat_picture(r).views.empty());
  EXPECT_TRUE(flat_picture(report_on("sphere_sphere_overlap", {1, 1, 1, 0, 1, 1, 1, 0}, true)).views.empty());
  EXPECT_EQ(svg_picture({}), "");
}

TEST(FlatPicture, OfEverySeedCaseIsWithinTheView) {
  std::size_t drawn = 0;
  for (const Query& q : catalogue()) {
    for (const fs::directory_entry& file :
         fs::directory_iterator(source_folder() + "/corpus/seeds/" + std::string(q.name))) {
      Report r;
      r.question = *in_scalar(read_case(file.path()), Scalar::float64);
      r.truth = truth_of(r.question);
      r.answer = Answer::without(Answer::Status::cannot_answer, "");
      const FlatPicture p = flat_picture(r);
      drawn += !p.views.empty();
      for (const FlatView& v : p.views) {
        EXPECT_TRUE(std::isfinite(v.pixels_per_unit) && v.pixels_per_unit > 0) << file.path();
        if (v.enlarged != 1) continue;
        for (const FlatMark& m : v.marks) EXPECT_LE(std::abs(m.at.right), FlatView::width / 2) << file.path();
        for (const FlatMark& m : v.marks) EXPECT_LE(std::abs(m.at.up), FlatView::height / 2) << file.path();
      }
    }
  }
  EXPECT_GT(drawn, 300u);
}

std::size_t count_in(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// In form as in colour: a disc and a cross, in each view and in the legend.
TEST(SvgPicture, TellsTheAnswersApart) {
  const std::string svg = svg_picture(flat_picture(report_on("moving_sphere_sphere", flight, true, late_hit)));
  EXPECT_EQ(count_in(svg, "<circle class=\"d\""), 3u) << svg;
  EXPECT_EQ(count_in(svg, "m-6 -6l12 12m0-12l-12 12"), 3u) << svg;
  EXPECT_EQ(count_in(svg, "<circle class=\"e o\""), 2u) << "the sphere at the exact time";
  EXPECT_EQ(count_in(svg, "<circle class=\"g\""), 2u) << "the sphere at the given time";
  EXPECT_NE(svg.find(".g{stroke:#d0112b;stroke-width:1.7;stroke-dasharray"), std::string::npos);
}

TEST(SvgPicture, EscapesNames) {
  Report r = report_on("moving_sphere_sphere", flight, true, late_hit);
  r.subject = "<script>&";
  const std::string svg = svg_picture(flat_picture(r));
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_NE(svg.find("&lt;script&gt;&amp;"), std::string::npos);
}

/// An error of the last bits, as another compiler may make it, changes no byte, although many coordinates are ties.
TEST(SvgPicture, IgnoresTheLastBits) {
  FlatPicture p;
  FlatView v;
  for (int i = 0; i < 200; ++i) v.marks.push_back({Ink::exact, {i * 0.05, 0.25 - i * 0.05}});
  p.views = {v};
  const std::string svg = svg_picture(p);
  for (const double off : {-1e-12, 1e-12}) {
    FlatPicture other = p;
    for (FlatMark& m : other.views[0].marks) m.at = {m.at.right + off, m.at.up - off};
    EXPECT_EQ(svg_picture(other), svg);
  }
}

struct StoredPicture {
  fs::path question;
  std::string subject;
  fs::path picture;
};
/// One for each cause of the ledger, of the first subject of the stored case.
std::vector<StoredPicture> stored_pictures() {
  std::vector<StoredPicture> all;
  const fs::path folder = corpus_folder() / "upstream";
  for (const fs::directory_entry& e : fs::recursive_directory_iterator(folder)) {
    if (e.path().extension() != ".json" || e.path().parent_path() == folder) continue;
    const nlohmann::json j = nlohmann::json::parse(read_file(e.path()));
    const std::string name = e.path().parent_path().filename().string() + "-" + e.path().stem().string() + ".svg";
    all.push_back(
        {e.path(), j.at("expected")[0].at("subject"), fs::path(source_folder()) / "docs/images/upstream" / name});
  }
  return all;
}

TEST(SvgPicture, IsTheStoredOne) {
  const std::vector<StoredPicture> all = stored_pictures();
  ASSERT_GE(all.size(), 70u);
  Workers workers;
  std::size_t drawn = 0;
  std::set<fs::path> named;
  for (const StoredPicture& s : all) {
    named.insert(s.picture);
    ASSERT_TRUE(fs::exists(s.picture)) << s.picture << " is missing; corpus/upstream-page draws it";
    const std::string stored = read_file(s.picture);
    EXPECT_LE(stored.size(), 4096u) << s.picture;
    const Subject* subject = find_subject(s.subject);
    if (subject == nullptr) continue;  // an engine, or a library that this build lacks
    ++drawn;
    const Report r = examine(*in_scalar(read_case(s.question), subject->scalar), *subject, workers);
    EXPECT_TRUE(svg_picture(flat_picture(r)) == stored)
        << s.picture << " is another; corpus/upstream-page draws it again";
  }
  for (const fs::directory_entry& e : fs::directory_iterator(fs::path(source_folder()) / "docs/images/upstream"))
    EXPECT_TRUE(named.contains(e.path())) << e.path() << " is of no cause";
  if (drawn == 0) GTEST_SKIP() << "this build has none of the libraries";
}

TEST(Show, WritesThePicture) {
  const TemporaryFolder folder;
  const std::string file = (corpus_folder() / "upstream/fcl/naive-tunnels.json").string(),
                    svg = (folder / "a.svg").string();
  const Ran ran = nearmiss({"show", "-s", "collide-fast-double", file, "--picture", svg});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_TRUE(read_file(svg).starts_with("<svg ")) << ran.out;
  EXPECT_EQ(nearmiss({"show", file, file, "--picture", svg}).err, "nearmiss: --picture: it is for one FILE\n");
  EXPECT_EQ(nearmiss({"show", file, "--picture", (folder / "no/a.svg").string()}).exit_code, 2);
}

/// Sphere and box are so far apart that neither covers the middle of a character.
TEST(TextPicture, IsEmptyWhereNoCharacterIsCovered) {
  EXPECT_EQ(text_picture(report_on("sphere_sphere_overlap", {0, 0, 0, 1e-9, 1, 1, 0, 1e-9}, false)), "");
}

}  // namespace
}  // namespace nearmiss
