#include "reports/trade/sources.hpp"

#include "corpus/generator/fit.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/scenes/scene_cases.hpp"

namespace nearmiss {

namespace {

constexpr std::uint64_t beyond_all_indices = std::uint64_t{1} << 40;

TradeTolerance tolerance_of(const scenes::Scene& scene) {
  constexpr double nanoseconds_of_second = 1e9;
  const scenes::Requirements& r = scene.required;
  const SceneLimits of_answer = *scenes::limits_of(scene);
  TradeTolerance t;
  t.unit = of_answer.unit;
  t.error = of_answer.error;
  t.missed_depth = of_answer.missed_depth;
  t.time = of_answer.time;
  t.missed_rate = r.missed_rate.value;
  t.phantom_rate = r.phantom_rate.value;
  t.nanoseconds = r.time_budget.value / scene.queries_per_step.value * nanoseconds_of_second;
  t.source = "scene " + scene.name;
  return t;
}

}  // namespace

TradeSource generated_cases(TradeTolerance tolerance) {
  TradeSource source;
  source.draw = [](Case& into, const Query& query, std::uint64_t seed, std::uint64_t index, Preconditions required) {
    generate_inside(into, query, Scalar::float32, seed, index, required);
    for (std::uint64_t again = 1; has_extreme_mutator(into); ++again)
      generate_inside(into, query, Scalar::float32, seed, index + again * beyond_all_indices, required);
  };
  source.share = [](const Query&) { return 1.0; };
  source.tolerance = std::move(tolerance);
  return source;
}

TradeSource scene_cases(const std::shared_ptr<const scenes::Scene>& scene) {
  TradeSource source;
  source.scene = scene->name;
  source.title = scene->title;
  source.scalar = scene->scalar;
  source.tolerance = tolerance_of(*scene);
  source.step = scene->step.value;
  source.queries_per_step = scene->queries_per_step.value;
  source.draw = [scene](Case& into, const Query& query, std::uint64_t seed, std::uint64_t index,
                        Preconditions required) {
    scenes::draw_case_inside(into, *scene, query, scene->scalar, seed, index, required);
  };
  source.share = [scene](const Query& query) { return scene->share_of(query); };
  return source;
}

}  // namespace nearmiss
