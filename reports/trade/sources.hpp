/// Where the cases of a trade come from.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "corpus/scenes/scene_file.hpp"
#include "impl/subject/precondition.hpp"
#include "reports/trade/errors.hpp"

namespace nearmiss {

/// The cases of a trade, and what is tolerated of their answers.
struct TradeSource {
  std::string scene;  ///< its name; empty: generated cases
  std::string title;
  Scalar scalar = Scalar::float32;  ///< in which every number of a case is exact
  /// The case with that index. It meets the preconditions where that is possible.
  std::function<void(Case& into, const Query&, std::uint64_t seed, std::uint64_t index, Preconditions)> draw;
  std::function<double(const Query&)> share;  ///< of the query among all queries of the scene
  TradeTolerance tolerance;
  double step = 0;              ///< the time step of the scene, in seconds
  double queries_per_step = 0;  ///< of the scene
};

/// The generator's cases without extreme numbers, in float, so that every subject gets the same numbers. All queries
/// have the same share.
TradeSource generated_cases(TradeTolerance tolerance);
/// The cases of a scene, in its scalar, with what the scene requires.
TradeSource scene_cases(const std::shared_ptr<const scenes::Scene>& scene);

}  // namespace nearmiss
