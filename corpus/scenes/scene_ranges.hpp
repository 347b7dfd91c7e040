/// The ranges in which the cases of a scene lie, for changes of cases that stay in the scene.
#pragma once

#include <optional>
#include <vector>

#include "corpus/scenes/operands.hpp"
#include "corpus/scenes/scene_file.hpp"

namespace nearmiss::scenes {

/// The numbers from `least` to `most`.
struct Limits {
  double least = 0, most = 0;
};

/// The ranges of one query of a scene, which must outlive this object.
///
/// Drawn cases (draw_case): sizes and speed as the scene states them (of a triangle: no side longer than twice the
/// largest size); the second shape in a cube of the scene's extent, whose middle is at the scene's distance from the
/// origin; the first near enough to it that it could touch it in the step, with the largest sizes and the largest gap
/// that are drawn; times and flags as drawn. Recorded cases: each number between the least and the largest recorded
/// one, positions and offsets up to eight times the tolerable error beyond.
class SceneRanges {
 public:
  /// Throws std::logic_error for a query that the scene does not ask.
  SceneRanges(const Scene& scene, const Query& query);

  /// True for a case of the query within the ranges, but for the rounding to its scalar: limits are rounded too, and
  /// lengths that follow from several numbers may be larger by 8 epsilon of the largest position.
  bool contain(const Case& c) const;
  /// Moves the numbers of a case that lies outside to the nearest limits; directions, normals and quaternions get unit
  /// length. Keeps shapes where they are relative to each other as far as possible. Leaves a case within unchanged, and
  /// keeps a case valid and exact in its scalar. False, with the case unchanged, where it cannot be fitted.
  bool fit(Case& c) const;

 private:
  bool contain_drawn(const Case& c) const;
  bool contain_recorded(const Case& c) const;
  /// Brings coordinates near the scene, so that lengths do not overflow.
  void cap_numbers(Case& c) const;
  void fit_drawn(Case& c) const;
  /// Brings the first shape to the scene, and the plane to the shape.
  void fit_plane(Case& c) const;
  void fit_recorded(Case& c) const;
  Limits recorded_limits(std::size_t number, Scalar scalar) const;
  Limits sizes_of(std::size_t operand, Scalar scalar) const;

  const Scene& scene_;
  const Query& query_;
  std::optional<QueryPlan> plan_;  ///< of drawn cases
  std::vector<const Shapes*> shapes_;
  Limits place_;                  ///< the distance of the second shape's center from the origin
  double apart_ = 0;              ///< the largest distance of the centers
  std::vector<Limits> recorded_;  ///< of each number
};

}  // namespace nearmiss::scenes
