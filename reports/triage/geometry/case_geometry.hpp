/// The places, directions, edges and shapes of a case, from names and roles alone.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "impl/catalogue/answer.hpp"
#include "impl/catalogue/case.hpp"
#include "reports/triage/geometry/long_vector.hpp"

namespace nearmiss {

/// The same lists, in the same order, for every case of a query. What a case does not have is not `known`.
struct CaseGeometry {
  struct Place {
    std::string name, operand;  ///< "sphere.center", "sphere"; the operand of an answer is empty
    LongVector at;
    bool known = true;
    bool is_corner = false;  ///< of a triangle, a segment or an axis-aligned box
    std::size_t number = 0;  ///< index of its first input; of no meaning for an answer
  };
  struct Direction {
    std::string name;
    LongVector of;
    bool known = true;
  };
  struct Edge {
    std::string name, operand;
    LongVector from, to;
    std::size_t begin = 0, end = 0;  ///< first inputs of its ends
  };
  struct Triangle {
    std::string operand;
    std::array<LongVector, 3> corners;
    std::array<std::size_t, 3> numbers{};
  };
  struct Plane {
    std::string operand;
    LongVector normal;
    long double offset = 0;
  };
  struct Block {  ///< a box, turned or not
    std::string operand;
    LongVector center, half;
    std::array<LongVector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  };

  std::vector<Place> places;
  std::vector<Direction> directions;
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
  std::vector<Plane> planes;
  std::vector<Block> blocks;
  std::vector<std::pair<std::string, long double>> radii;    ///< by operand
  std::vector<std::pair<std::string, long double>> weights;  ///< of the exact answer; 0 where there is none
  std::optional<LongVector> velocity;
  long double time = 0;   ///< of the exact contact; 0 where there is none
  long double depth = 0;  ///< of the exact answer, not negative; 0 where there is none

  /// 0 where the operand has none.
  long double radius_of(const std::string& operand) const;
};

/// With the numbers of a right answer, or of the exact one where none is given.
CaseGeometry geometry_of(const Case& c, const Answer* right = nullptr);

}  // namespace nearmiss
