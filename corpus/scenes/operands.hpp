/// What a scene fills in of a query's inputs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corpus/scenes/scene_file.hpp"

namespace nearmiss::scenes {

/// The inputs of a query of two shapes, of which the first may move.
struct QueryPlan {
  std::vector<Operand> operands;         ///< two; a ray counts as a point, its origin
  std::optional<std::size_t> velocity;   ///< the index of its x
  std::optional<std::size_t> direction;  ///< of a ray: the index of its x
  std::vector<std::size_t> lone;         ///< times, flags and indices
  bool moves() const { return velocity || direction; }
};

/// Empty for a query whose inputs are not two shapes, at most one velocity, and times, flags and indices.
std::optional<QueryPlan> query_plan(const Query& query);

}  // namespace nearmiss::scenes
