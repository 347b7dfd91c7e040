/// How tight the oracle's enclosures are, query by query: properties/oracle_power.txt has the bounds. An enclosure that
/// is too wide excuses errors, so a bound may become smaller and not larger.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "properties/judge/width_ratios.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

constexpr std::uint64_t scenes = 60;
/// The ratios are the same on every machine but for what its compiler does to the plain numbers of a case's scene.
constexpr double margin = 1.05;
/// Of a part that has no line yet.
constexpr double bound_of_a_new_query = 4;

/// Bounds of the median and of the ratio that 90 % of the scenes do not exceed.
struct Bound {
  double median = bound_of_a_new_query, most = 16 * bound_of_a_new_query;
};

std::filesystem::path file() { return source_folder() + "/properties/oracle_power.txt"; }

/// By "query part".
std::map<std::string, Bound> stored_bounds() {
  std::map<std::string, Bound> bounds;
  std::ifstream in(file());
  std::string query, part;
  for (Bound b; in >> query >> part >> b.median >> b.most;) bounds[fmt::format("{} {}", query, part)] = b;
  return bounds;
}

class OraclePower : public testing::TestWithParam<NamedQuery> {};

TEST_P(OraclePower, IsAtLeastWhatItWas) {
  const Query& query = *GetParam().query;
  const std::map<std::string, Bound> bounds = stored_bounds();
  ASSERT_FALSE(bounds.empty()) << file();
  for (WidthRatios& r : width_ratios(query, scenes)) {
    if (r.all.empty()) continue;
    const std::string key = fmt::format("{} {}", query.name, r.part);
    const auto found = bounds.find(key);
    const Bound bound = found != bounds.end() ? found->second : Bound{};
    EXPECT_LE(r.at(0.5), bound.median * margin) << key;
    EXPECT_LE(r.at(0.9), bound.most * margin) << key;
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, OraclePower, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

/// NEARMISS_WRITE_POWER=1 writes the bounds anew, after a change that is meant to change them.
TEST(OraclePowerBounds, HaveALineForEveryPart) {
  const std::map<std::string, Bound> bounds = stored_bounds();
  std::string now;
  for (const Query& q : catalogue()) {
    for (WidthRatios& r : width_ratios(q, scenes)) {
      if (r.all.empty()) continue;
      now += fmt::format("{} {} {:.3g} {:.3g}\n", q.name, r.part, r.at(0.5), r.at(0.9));
    }
  }
  if (std::getenv("NEARMISS_WRITE_POWER") != nullptr) write_file(file(), now);
  for (const auto& [key, bound] : stored_bounds()) {
    EXPECT_NE(now.find(key + ' '), std::string::npos) << key << " has a bound and no ratio";
    EXPECT_GE(bound.median, 1) << key;
  }
}

}  // namespace
}  // namespace nearmiss
