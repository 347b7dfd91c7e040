/// The oracle against a ground truth that others computed symbolically, and the importer.
#include "corpus/importers/nyu_ccd.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

/// Whether a hit has a time of at most 1, exactly: by the sign of (exact time) - 1.
bool hits_within_one(const Case& c) {
  Answer at_one;
  at_one.yes = true;
  at_one.values[0] = 1;
  const Enclosure exact = oracle_of(*c.query).exact(c.values, at_one, c.scalar, nullptr);
  const Bounds beyond_one = exact.error[0];
  if (!exact.may_be_yes) return false;
  EXPECT_TRUE(beyond_one.low > 0 || beyond_one.high <= 0) << "the sign of time - 1 is open: " << c.origin;
  return beyond_one.high <= 0;
}

void expect_truth(const GroundTruths& truths) {
  EXPECT_EQ(truths.fit.size() + truths.skipped, truths.queries);
  for (const GroundTruth& g : truths.fit) {
    ASSERT_FALSE(g.question.query->broken(g.question.values)) << g.where;
    if (g.parallel) {
      EXPECT_FALSE(hits_within_one(g.question)) << g.where << ": parallel motion never hits a one-sided face";
    } else {
      EXPECT_EQ(hits_within_one(g.question), g.collides) << g.where;
    }
  }
}

TEST(NyuCcdSample, IsWhatTheProgramWrites) {
  EXPECT_EQ(read_file(corpus_folder() / "nyu-ccd" / "sample.csv"), nyu_ccd_sample());
}

TEST(NyuCcdSample, HasTheTruthThatTheOracleFinds) {
  const GroundTruths truths = read_nyu_ccd({corpus_folder() / "nyu-ccd" / "sample.csv"});
  expect_truth(truths);
  EXPECT_EQ(truths.skipped, 0u);
  const auto hits = std::count_if(truths.fit.begin(), truths.fit.end(), [](const auto& g) { return g.collides; });
  EXPECT_GE(hits, 5);
  EXPECT_LE(hits, std::ptrdiff_t(truths.fit.size()) - 4);
}

/// The folder of the benchmark: NEARMISS_NYU_CCD, or a folder beside the sources.
fs::path benchmark_folder() {
  const char* value = std::getenv("NEARMISS_NYU_CCD");
  return value != nullptr && *value != '\0' ? fs::path(value) : corpus_folder() / ".." / ".." / "shared" / "nyu-ccd";
}

std::vector<fs::path> csv_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(NyuCcd, GroundTruthIsTheOraclesDecisionOnEveryQueryThatFits) {
  const fs::path folder = benchmark_folder();
  if (!fs::is_directory(folder)) {
    GTEST_SKIP() << "the benchmark is not here; NEARMISS_NYU_CCD may name its folder";
  }
  const GroundTruths truths = read_nyu_ccd(csv_files(folder));
  expect_truth(truths);
  const auto parallel = std::count_if(truths.fit.begin(), truths.fit.end(), [](const auto& g) { return g.parallel; });
  RecordProperty("fit", int(truths.fit.size()));
  RecordProperty("parallel", int(parallel));
  if (std::getenv("NEARMISS_NYU_CCD") == nullptr) {
    EXPECT_EQ(truths.queries, 1585u);
    EXPECT_EQ(truths.fit.size(), 735u);
  }
}

class NyuCcdFiles : public testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }
  void expect_refused(const std::string& text, const std::string& what) {
    write_file(file_, text);
    try {
      (void)read_nyu_ccd({file_});
      ADD_FAILURE() << "was read: " << what;
    } catch (const BadInput& e) {
      EXPECT_EQ(std::string(e.what()), file_.string() + what);
    }
  }
  fs::path file_ = fs::path(testing::TempDir()) / ("nearmiss-" + std::to_string(::getpid()) + ".csv");
};

TEST_F(NyuCcdFiles, AreRefusedWithFileRowAndReason) {
  const std::string good = "1,1,1,1,2,1,1\n";
  expect_refused(good + "1,1,1,1,2,1\n", ":2: 6 columns: it must be 7");
  expect_refused(good + "1,1,1,1,2,1,1,1\n", ":2: more than 7 columns");
  expect_refused(good + "1,1,1,1,2.5,1,1\n", ":2: \"2.5\" is not an integer");
  expect_refused(good + "1,1,1,1,,1,1\n", ":2: \"\" is not an integer");
  expect_refused(good + "1,1,1,0,2,1,1\n", ":2: a denominator is 0");
  expect_refused(good + "1,1,1,1,2,1,yes\n", ":2: the truth is \"yes\": it must be 0 or 1");
  expect_refused(good + "1,1,1,1,2,1,0\n", ":2: the truth differs from that of the query's first row");
  expect_refused(good + good, ":2: the file ends after 2 of a query's 8 rows");
  expect_refused(good + "\n", ":2: 1 columns: it must be 7");
}

TEST_F(NyuCcdFiles, CountWhatDoesNotFit) {
  const std::string at_rest = "0,1,0,1,0,1,0\n4,1,0,1,0,1,0\n0,1,4,1,0,1,0\n";
  const std::string vertex = "1,1,1,1,2,1,0\n";
  const std::string third = "1,3,1,1,2,1,0\n";
  const std::string turned = "0,1,0,1,0,1,0\n4,1,0,1,1,1,0\n0,1,4,1,0,1,0\n";
  write_file(file_, vertex + at_rest + vertex + at_rest + third + at_rest + vertex + at_rest + vertex + at_rest +
                        vertex + turned);
  const GroundTruths truths = read_nyu_ccd({file_});
  EXPECT_EQ(truths.queries, 3u);
  EXPECT_EQ(truths.skipped, 2u);
  ASSERT_EQ(truths.fit.size(), 1u);
  EXPECT_EQ(truths.fit[0].where, file_.string() + ":1");
  EXPECT_EQ(truths.fit[0].question.values, (std::vector<double>{1, 1, 2, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}));
}

TEST_F(NyuCcdFiles, AreRefusedWhenMissing) {
  EXPECT_THROW((void)read_nyu_ccd({file_}), BadInput);
  EXPECT_THROW((void)read_nyu_ccd({file_.parent_path()}), BadInput);
}

}  // namespace
}  // namespace nearmiss
