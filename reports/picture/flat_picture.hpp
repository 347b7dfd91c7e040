/// The picture of a case as flat forms: what stands where in each view.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/shape.hpp"
#include "reports/findings/report.hpp"
#include "reports/picture/picture_shapes.hpp"

namespace nearmiss {

/// In a view: pixels from its middle, to the right and upward.
struct FlatPoint {
  double right = 0, up = 0;

  friend FlatPoint operator+(const FlatPoint& a, const FlatPoint& b) { return {a.right + b.right, a.up + b.up}; }
  friend FlatPoint operator-(const FlatPoint& a, const FlatPoint& b) { return {a.right - b.right, a.up - b.up}; }
  friend FlatPoint operator*(const FlatPoint& a, double k) { return {a.right * k, a.up * k}; }
  /// Not by std::hypot, which libraries round differently.
  double length() const { return std::sqrt(right * right + up * up); }
};

/// What a form stands for. The exact and the given answer differ in colour and in form.
enum class Ink { first_shape, other_shape, way, exact, given, frame };

/// The points within a radius of a convex polygon: a disc, a stadium, a polygon, a line.
struct FlatOutline {
  Ink ink;
  std::vector<FlatPoint> corners;  ///< of the polygon, counterclockwise
  double radius = 0;
  std::vector<std::array<FlatPoint, 2>> edges{};  ///< of a box, inside the outline, toward the viewer
};
/// A normal or a motion. One that is seen from its end is so short that it has no direction.
struct FlatArrow {
  Ink ink;
  FlatPoint from, to;
};
struct FlatMark {
  Ink ink;
  FlatPoint at;
};

/// The case as seen along a line of sight.
struct FlatView {
  static constexpr double width = 260, height = 240;

  double pixels_per_unit = 1;
  double enlarged = 1;                  ///< as many times as the first view
  std::array<FlatPoint, 3> axes{};      ///< the coordinate axes, of length 1
  std::vector<FlatOutline> outlines{};  ///< in the order in which they are drawn
  std::vector<FlatArrow> arrows{};
  std::vector<FlatMark> marks{};
};

struct FlatLegend {
  Ink ink;
  std::string text;
};

struct FlatPicture {
  std::vector<FlatView> views;
  std::vector<FlatLegend> legend;
};

/// Two views along lines of sight that are perpendicular to each other, and the first one enlarged where something that
/// matters is too small to be seen in it: a shape, the gap or the depth, the distance of the given place from the exact
/// one. The first line of sight shows the motion, the normals and the line between the shapes nearly as long as they
/// are: it is a coordinate axis where one of them does.
///
/// A moving shape stands at its start; outlines of the exact and of the given answer show it at the time of contact,
/// or, where the answer has no time, at that of the nearest approach. A place is a mark, a normal an arrow. The arrow
/// of a depth is as long as the depth where that can be seen. Where an answer is a yes without a place, the mark stands
/// where the shapes meet.
///
/// Empty for a case of numbers that are not finite or without a body, and where the shapes are one point.
FlatPicture flat_picture(const Report& r);

/// The points whose convex hull, rounded by the radius, is the shape. Empty for a shape without bounds.
std::vector<PictureVector> rounded_points(const PictureShape& shape);

/// The corners of the convex hull, counterclockwise. Points on one line have its two ends.
std::vector<FlatPoint> convex_hull(std::vector<FlatPoint> points);

}  // namespace nearmiss
