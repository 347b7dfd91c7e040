/// Shapes with exact coordinates, as the picture of a case needs them.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// 512 bits: the difference of two doubles and the products of a few have no error that a picture could show.
using PictureReal =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<512, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

/// The nearest double; the largest one for a number beyond it, because JSON has no infinity.
double rounded(const PictureReal& x);

struct PictureVector {
  PictureReal x = 0, y = 0, z = 0;

  friend PictureVector operator+(const PictureVector& a, const PictureVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend PictureVector operator-(const PictureVector& a, const PictureVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend PictureVector operator*(const PictureVector& a, const PictureReal& k) { return {a.x * k, a.y * k, a.z * k}; }
};
PictureReal dot(const PictureVector& a, const PictureVector& b);
PictureVector cross(const PictureVector& a, const PictureVector& b);
PictureReal length(const PictureVector& a);
/// The unit vector; zero for zero.
PictureVector unit(const PictureVector& a);

/// One input of a query that is drawn.
struct PictureShape {
  std::string name;            ///< of the input: "sphere", "box1"
  std::optional<Shape> shape;  ///< empty: a direction
  std::vector<PictureVector>
      corners{};           ///< points; of a ray or line the first is one and `axis` the direction; of a box its center
  PictureVector axis{};    ///< of a ray, line, plane, half-space or direction; of any length
  PictureReal offset = 0;  ///< of a plane or half-space: axis . x + offset = 0
  PictureReal radius = 0;
  std::vector<PictureVector> axes{};  ///< of a box: unit vectors
  std::vector<PictureReal> half{};    ///< of a box: half the length along each
  bool moves = false;

  bool is_body() const { return shape.has_value(); }
  bool has_one_plane() const { return shape && nearmiss::has_one_plane(*shape); }
};

/// The shapes and the motion of a case.
struct PictureInputs {
  std::vector<PictureShape> shapes;
  std::optional<PictureVector> velocity;  ///< of the shapes that move
  std::optional<double> time;             ///< an input time: where the motion ends

  /// The first shape that moves; nullptr where there is none.
  const PictureShape* moving() const;
  /// The first body; nullptr where there is none.
  const PictureShape* first_body() const;
  /// The last body that is not `shape`; nullptr where there is none.
  const PictureShape* other_than(const PictureShape* shape) const;
  /// When the path of the moving shape's first corner is nearest to the other shape; 0 without a motion.
  PictureReal time_of_approach() const;
  /// A point near the contact of the shapes, or between them where they are apart; where they are now.
  PictureVector where_shapes_meet() const;
};
PictureInputs picture_inputs(const Case& question);

/// The point of the shape that is nearest to `p`. The shape is a body.
PictureVector nearest_point(const PictureShape& shape, const PictureVector& p);
/// Points of two convex bodies that are near each other, by alternating projections.
std::pair<PictureVector, PictureVector> meeting(const PictureShape& a, const PictureShape& b);
void move_by(PictureShape& shape, const PictureVector& by);
/// The largest distance of the shape's points from the origin; of a shape without bounds that of its first corner, and
/// 0 for a plane.
PictureReal reach(const PictureShape& shape);
/// The shape in coordinates divided by `unit` (picture_of()).
nlohmann::ordered_json shape_to_json(const PictureShape& shape, const PictureReal& unit);
nlohmann::ordered_json vector_to_json(const PictureVector& v);

}  // namespace nearmiss
