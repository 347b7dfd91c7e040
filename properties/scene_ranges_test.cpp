/// The ranges of scenes: every case of a scene lies within, others do not, and mutations are brought back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/scenes/scene_cases.hpp"
#include "corpus/scenes/scene_ranges.hpp"
#include "corpus/storage/codec.hpp"

namespace nearmiss::scenes {
namespace {

/// Calls `each` with some cases of every query of every scene, in both scalars.
template <class Each>
void for_each_case_of_scenes(std::uint64_t cases, const Each& each) {
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    for (const MixedQuery& m : scene.queries) {
      for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
        for (std::uint64_t i = 0; i < cases; ++i) each(scene, m, draw_case(scene, *m.query, scalar, 7, i));
      }
    }
  }
}

TEST(SceneRanges, ContainEveryDrawnCase) {
  for_each_case_of_scenes(400, [](const Scene& scene, const MixedQuery& m, const Case& c) {
    const SceneRanges ranges(scene, *m.query);
    EXPECT_TRUE(ranges.contain(c)) << scene.name << ": " << case_to_json(c).dump();
    Case same = c;
    EXPECT_TRUE(ranges.fit(same));
    EXPECT_EQ(same.values, c.values);
  });
}

/// Numbers a million times as large as those of the scene, in every role: beyond the widest of its ranges.
TEST(SceneRanges, ExcludeWhatIsNoCaseOfTheScene) {
  for_each_case_of_scenes(20, [](const Scene& scene, const MixedQuery& m, const Case& c) {
    const SceneRanges ranges(scene, *m.query);
    for (const Role role : {Role::position, Role::size, Role::velocity, Role::time, Role::offset}) {
      Case other = c;
      double largest = 0;
      for (std::size_t i = 0; i < c.values.size(); ++i) {
        if (c.role(i) != role) continue;
        largest = std::max(largest, std::abs(other.values[i]));
        other.values[i] = rounded_to(c.scalar, 1e6 * other.values[i]);
      }
      const bool is_small =
          role == Role::position || role == Role::offset;  // a case near the origin stays in the scene
      if (largest == 0 || (is_small && largest < (scene.distance.most.value + scene.extent.value) / 8)) continue;
      EXPECT_FALSE(ranges.contain(other)) << scene.name << ", " << int(role) << ": " << case_to_json(other).dump();
    }
  });
}

/// Mutations leave the scene more often than not, and nearly all of them can be brought back.
TEST(SceneRanges, BringMutatedCasesBackIntoTheScene) {
  std::map<std::string, std::pair<int, int>> fitted;  // by scene and query: of those that left the scene
  for_each_case_of_scenes(60, [&](const Scene& scene, const MixedQuery& m, const Case& drawn) {
    const SceneRanges ranges(scene, *m.query);
    Case c = drawn;
    for (std::uint64_t i = 0; i < 4; ++i) mutate(c, 97 * drawn.index + i);
    if (ranges.contain(c)) return;
    auto& [back, left] = fitted[scene.name + " " + std::string(m.query->name)];
    ++left;
    const Case before = c;
    if (!ranges.fit(c)) {
      EXPECT_EQ(c.values, before.values);
      return;
    }
    ++back;
    EXPECT_TRUE(ranges.contain(c));
    EXPECT_FALSE(c.query->broken(c.values));
    for (const double x : c.values) EXPECT_TRUE(std::isfinite(x) && representable(x, c.scalar));
  });
  for (const auto& [name, counts] : fitted) {
    EXPECT_GT(counts.second, 10) << name;
    EXPECT_GE(10 * counts.first, 9 * counts.second) << name << ": " << counts.first << " of " << counts.second;
  }
}

}  // namespace
}  // namespace nearmiss::scenes
