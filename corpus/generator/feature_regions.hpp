/// Regions of the inputs in which implementations take a branch of their own: a zero size, no motion, parallel lines.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// In the order of the bits of a set. A region that concerns no input of a query holds for none of its cases.
enum class FeatureRegion : std::uint8_t {
  zero_size,          ///< a radius or half extent is 0
  flat,               ///< a segment without length, a triangle without area, an axis-aligned box without volume
  no_motion,          ///< the velocity is 0
  starts_in_touch,    ///< the moving body touches or overlaps the other at the start, or starts behind a plane
  same_place,         ///< two positions of different operands are the same point
  parallel,           ///< two of the velocities, directions, normals and segments are parallel
  turned,             ///< a rotation is no multiple of a quarter turn about an axis
  scaled_rotation,    ///< the length of a quaternion is not 1 within 4 epsilon
  scaled_direction,   ///< the length of a direction or normal is not 1 within 4 epsilon
  no_true_rectangle,  ///< the corners of a rectangle are not those of one, within 4 epsilon
};
inline constexpr int feature_region_count = 10;

/// "a zero size", "no motion".
std::string_view name_of(FeatureRegion r);

/// A set of regions.
class FeatureRegions {
 public:
  void add(FeatureRegion r) { bits_ |= 1u << unsigned(r); }
  bool has(FeatureRegion r) const { return (bits_ >> unsigned(r) & 1u) != 0; }
  bool empty() const { return bits_ == 0; }
  /// True where every region of the set is in `other` too.
  bool within(FeatureRegions other) const { return (bits_ & ~other.bits_) == 0; }
  std::vector<std::string_view> names() const;
  std::uint32_t bits() const { return bits_; }
  auto operator<=>(const FeatureRegions&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

/// The regions of a case. Parallel vectors are told exactly, unless a product of two of their numbers is subnormal or
/// infinite. Thread-safe.
FeatureRegions feature_regions_of(const Case& question);
/// The set of regions with these names; names of no region are left out.
FeatureRegions feature_regions_named(const std::vector<std::string>& names);

/// False where a number of the case is so large or so small that no scene has it: for a case of the generator, where an
/// extreme mutator made it; for any other, where a number is neither 0 nor within 2^-20 and 2^20 in magnitude.
bool is_ordinary(const Case& question);

}  // namespace nearmiss
