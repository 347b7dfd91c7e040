/// The cases of the maps of extremes, and the axes of these maps.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "corpus/scenes/scene_file.hpp"

namespace nearmiss {

/// The columns or the rows of a map.
struct MapAxis {
  std::string name, unit;      ///< "distance", "metre from the origin"
  std::vector<double> values;  ///< one for each column or row
};
struct MapPlane {
  MapAxis x, y;
};

/// Where the cases of maps come from.
class MapCases {
 public:
  /// The cases of the cell with that index; cells count row by row.
  using Cells = std::function<std::vector<Case>(std::size_t cell)>;

  virtual ~MapCases() = default;
  virtual std::vector<MapPlane> planes_of(const Query& query) const = 0;
  /// The cells of a plane of planes_of(), each with at most so many cases. The same on every machine.
  virtual Cells cells(const Query& query, std::size_t plane, Scalar scalar, std::uint64_t seed,
                      std::uint64_t cases) const = 0;
};

/// Generated cases, moved over the planes of corpus/generator/extreme_cases.hpp toward the limits of floating-point
/// numbers.
std::shared_ptr<const MapCases> generated_map_cases();

/// Cases of a scene, which must outlive the result. The axes have the ranges of the scene's own cases: the distance
/// from the origin, the largest size, the speed, each in eight steps, or in one where the scene has one value. A value
/// is the middle of its step. A cell has the scene's cases of that step, in their order, and fewer where they are rare.
std::shared_ptr<const MapCases> scene_map_cases(const scenes::Scene& scene);

}  // namespace nearmiss
