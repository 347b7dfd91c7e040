/// The questions that are timed: the generator's plain scenes, about half of them hits, in random order.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nearmiss::benchmarks {

/// Distinct cases of a query. Every number is exact in float, so that each scalar and library is asked
/// the same.
struct Scenes {
  std::vector<std::vector<double>> values;  ///< one per input, as Case::values
  std::vector<bool> yes;                    ///< what Fast in double says

  std::size_t size() const { return values.size(); }
  double share_of_yes() const;
};

/// How many scenes each query gets, a power of two. To be set before the first call of scenes_of.
void set_scene_count(std::size_t count);
std::size_t scene_count();

/// The scenes of a query of the catalogue, made at the first call: always the same.
const Scenes& scenes_of(std::string_view query);

}  // namespace nearmiss::benchmarks
