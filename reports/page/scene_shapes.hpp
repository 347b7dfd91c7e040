/// Shapes with exact coordinates, as the picture of a case needs them.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// 512 bits: the difference of two doubles and the products of a few have no error that a picture could show.
using SceneReal =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<512, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

/// The nearest double; the largest one for a number beyond it, because JSON has no infinity.
double rounded(const SceneReal& x);

struct SceneVector {
  SceneReal x = 0, y = 0, z = 0;

  friend SceneVector operator+(const SceneVector& a, const SceneVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend SceneVector operator-(const SceneVector& a, const SceneVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend SceneVector operator*(const SceneVector& a, const SceneReal& k) { return {a.x * k, a.y * k, a.z * k}; }
};
SceneReal dot(const SceneVector& a, const SceneVector& b);
SceneVector cross(const SceneVector& a, const SceneVector& b);
SceneReal length(const SceneVector& a);
/// The unit vector; zero for zero.
SceneVector unit(const SceneVector& a);

/// One input of a query that is drawn.
struct SceneShape {
  std::string name;            ///< of the input: "sphere", "box1"
  std::optional<Shape> shape;  ///< empty: a direction
  std::vector<SceneVector>
      corners{};         ///< points; of a ray or line the first is one and `axis` the direction; of a box its center
  SceneVector axis{};    ///< of a ray, line, plane or direction; of any length
  SceneReal offset = 0;  ///< of a plane: axis . x + offset = 0
  SceneReal radius = 0;
  std::vector<SceneVector> axes{};  ///< of a box: unit vectors
  std::vector<SceneReal> half{};    ///< of a box: half the length along each
  bool moves = false;

  bool is_body() const { return shape.has_value(); }
};

/// The shapes and the motion of a case.
struct SceneInputs {
  std::vector<SceneShape> shapes;
  std::optional<SceneVector> velocity;  ///< of the shapes that move
  std::optional<double> time;           ///< an input time: where the motion ends
};
SceneInputs scene_inputs(const Case& question);

/// The point of the shape that is nearest to `p`. The shape is a body.
SceneVector nearest_point(const SceneShape& shape, const SceneVector& p);
void move_by(SceneShape& shape, const SceneVector& by);
/// The largest distance of the shape's points from the origin; of a shape without bounds that of its first corner, and
/// 0 for a plane.
SceneReal reach(const SceneShape& shape);
/// The shape in coordinates divided by `unit` (scene_of()).
nlohmann::ordered_json shape_to_json(const SceneShape& shape, const SceneReal& unit);
nlohmann::ordered_json vector_to_json(const SceneVector& v);

}  // namespace nearmiss
