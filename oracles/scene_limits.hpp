/// What a scene requires of each single answer (docs/scenes.md).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "impl/subject/subject.hpp"

namespace nearmiss {

/// Lengths are in `unit`, the unit of the scene's cases.
struct SceneLimits {
  std::string scene;           ///< its name
  std::string unit;            ///< "yard"
  double error = 0;            ///< the largest tolerable error of a place or a depth, and the widest gap of a phantom
  double missed_depth = 0;     ///< the largest tolerable depth of a contact that an answer misses
  std::optional<double> time;  ///< the largest tolerable error of a time of impact, in seconds; empty: any

  bool operator==(const SceneLimits&) const = default;
};

/// The measure for subjects that promise nothing. What a scene requires replaces it for decisions, places, depths and
/// times; it stays the bound of all other members. nullptr: no scene. The conventions are those of a report; empty:
/// each subject is judged by what it declares.
struct SceneMeasure {
  Measure measure{};
  std::shared_ptr<const SceneLimits> scene{};
  std::optional<ReportedConventions> declared{};
};
/// Sets all three for the rest of the process.
void use_measure(SceneMeasure m);
/// The requirements of the scene that use_measure() has set; nullptr: none.
const SceneLimits* scene_limits();

}  // namespace nearmiss
