/// Families of cases by shape and size. The oracle's bounds may fail for one family alone.
#pragma once

#include <cstdint>
#include <string_view>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

enum class Family {
  scene,       ///< smooth numbers of moderate size
  tiny,        ///< one operand is much smaller than the scene
  thin,        ///< corners nearly collinear, a short axis or side, directions nearly parallel
  degenerate,  ///< equal or collinear corners, sizes of 0, equal centers, parallel directions, no velocity
  far_out,     ///< everything far from the origin
  huge,        ///< lengths up to the end of the range
  minute,      ///< lengths down to subnormal numbers
};
inline constexpr Family families[] = {Family::scene,   Family::tiny, Family::thin,  Family::degenerate,
                                      Family::far_out, Family::huge, Family::minute};
std::string_view name_of(Family family);

/// The `index`-th case of the family in the stream `seed`: valid, and exact in `scalar`.
Case case_of(Family family, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index);

}  // namespace nearmiss
