/// The text and the report of a failing property, tested with a deliberately broken adapter.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <collide/sphere_sphere_overlap.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "impl/catalogue/queries/sphere_sphere_overlap.hpp"
#include "impl/subject/adapter.hpp"
#include "properties/support.hpp"
#include "reports/engine/relation_report.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

/// Treats spheres less than a millimetre apart as touching.
struct SlackAdapter {
  static collide::Decision<double> answer(inputs::sphere_sphere_overlap<double> q) {
    q.sphere1.radius += 0.001;
    return collide::sphere_sphere_overlap<collide::Fast>(q.sphere1, q.sphere2);
  }
};

Subject broken_subject() {
  const auto answer = [](std::span<const double> values) {
    return erase(SlackAdapter::answer(inputs_from<inputs::sphere_sphere_overlap<double>>(values.data())));
  };
  constexpr collide::Contract promise{.backward = 8, .lowest = -100, .highest = 100};
  return {.name = "slack",
          .version = "1",
          .scalar = Scalar::float64,
          .offerings = {{"sphere_sphere_overlap", Offer::answers, "", promise, answer}}};
}

/// The runs folder of one test, removed at its end.
class OwnRuns {
 public:
  OwnRuns() {
    std::string name = (fs::temp_directory_path() / "nearmiss-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    if (const char* before = std::getenv("NEARMISS_RUNS")) before_ = before;
    setenv("NEARMISS_RUNS", name.c_str(), 1);
  }
  ~OwnRuns() {
    if (before_) {
      setenv("NEARMISS_RUNS", before_->c_str(), 1);
    } else {
      unsetenv("NEARMISS_RUNS");
    }
    std::error_code ignored;  // a destructor cannot report an error
    fs::remove_all(folder_, ignored);
  }
  /// The one report that was left.
  fs::path report() const {
    std::vector<fs::path> files;
    const fs::path folder = folder_ / "properties" / "sphere_sphere_overlap";
    if (fs::exists(folder)) {
      for (const auto& f : fs::directory_iterator(folder)) files.push_back(f.path());
    }
    if (files.size() != 1) throw std::runtime_error(fmt::format("{} reports", files.size()));
    return files.front();
  }

 private:
  fs::path folder_;
  std::optional<std::string> before_;
};

void expect_reported(const std::string& text, const fs::path& report) {
  const std::string replay = fmt::format("replay:  nearmiss replay {}\n", report.string());
  for (const std::string& part : {std::string("seed:    3, index "), std::string("--seed 3 --cases "), replay,
                                  std::string("\"query\": \"sphere_sphere_overlap\""),
                                  std::string("nearmiss::inputs::sphere_sphere_overlap<double>")}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
  }
}

TEST(FailingProperty, OfAgreementIsToldAndLeavesAReport) {
  const OwnRuns runs;
  const std::string text = failure_of_agreement(*find_query("sphere_sphere_overlap"), broken_subject(), 3, 2000);
  ASSERT_NE(text, "") << "a slack of 0.001 was not found";
  const fs::path file = runs.report();
  expect_reported(text, file);
  const auto report = nlohmann::json::parse(read_file(file));
  EXPECT_EQ(report["finding"]["disagreement"], "false hit");
  EXPECT_EQ(report["replay"], "nearmiss replay " + file.string());
  const Case again = read_case_or_report(file);
  EXPECT_TRUE(is_violation(examined(again, broken_subject())));
}

TEST(FailingProperty, OfARelationIsToldAndLeavesAReportOfAllItsCases) {
  const OwnRuns runs;
  const std::string text = failure_of_relations(*find_query("sphere_sphere_overlap"), broken_subject(), 3, 2000);
  ASSERT_NE(text, "") << "a slack of 0.001 was not found";
  const fs::path file = runs.report();
  expect_reported(text, file);
  EXPECT_NE(text.find("case 2:"), std::string::npos) << text;
  const auto report = nlohmann::json::parse(read_file(file));
  EXPECT_EQ(report["relation"]["breach"], "contract");
  EXPECT_EQ(report["relation"]["breaks_contract"], true);
  EXPECT_GE(report["relation"]["partners"].size(), 1u);
  ASSERT_TRUE(read_relation_case(file));
}

TEST(FailingProperty, IsQuietWhereNothingIsWrong) {
  const OwnRuns runs;
  const Subject& right = *find_subject("collide-certified-double");
  EXPECT_EQ(failure_of_agreement(*find_query("sphere_sphere_overlap"), right, 3, 500), "");
  EXPECT_EQ(failure_of_relations(*find_query("sphere_sphere_overlap"), right, 3, 100), "");
  EXPECT_THROW((void)runs.report(), std::runtime_error);
}

}  // namespace
}  // namespace nearmiss
