/// The difference of two points has no facets (collide/detail/signed_distances.hpp).
#pragma once

#include <collide/detail/signed_distances.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// Never called: what is proved of two points is a way. A compiler sees the general function divide by their number of
/// edges, which is 0.
template <class Tier, class T>
Vec3<T> facet_of(const Core<T, 1>&, const Core<T, 1>&, int) {
  return {};
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
