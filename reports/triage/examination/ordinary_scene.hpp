/// Tells findings about the range of numbers from those of ordinary scenes.
#pragma once

#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The magnitudes with which findings of extreme scenes were seen. 0: none of this side.
struct ExtremeMagnitudes {
  double up_from = 0;    ///< numbers of this magnitude and more
  double down_from = 0;  ///< numbers of this magnitude and less

  /// The widest borders of both.
  void add(const ExtremeMagnitudes& other);
};

/// True where the largest length, speed, direction or rotation is not within 2^-20 and 2^20, or where a number is not
/// 0 but below the rounding error of the largest of its role in double precision, 2^-53 of it.
bool is_extreme_scene(const Case& question);

/// The side on which an extreme scene is extreme: its largest number, or else its smallest.
ExtremeMagnitudes magnitudes_of(const Case& question);

/// The scene with its lengths, speeds, directions and rotations multiplied so that the largest of each is about 1, as
/// far as they are extreme. Where numbers are left that are too small, two scenes: one where they are 0, and one where
/// they are 2^-20 of the largest. Valid cases of the scalar.
std::vector<Case> at_ordinary_magnitude(const Case& question);

/// How much there is to read in a case. The less, the simpler it is: first the numbers that are neither 0 nor of a
/// magnitude from 2^-10 to 2^10, then the digits of its numbers, each number once.
struct Plainness {
  std::size_t odd_numbers = 0, digits = 0;
  auto operator<=>(const Plainness&) const = default;
};
Plainness plainness_of(const Case& question);

}  // namespace nearmiss
