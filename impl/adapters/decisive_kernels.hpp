/// The queries for which the tier Decisive of `collide` has a kernel.
#pragma once

#include <algorithm>
#include <string_view>

namespace nearmiss::adapters {

inline constexpr std::string_view decisive_kernels[] = {
    "box_box_penetration",    "box_plane_penetration",          "moving_point_aabox",        "moving_point_plane",
    "moving_point_triangle",  "moving_point_triangle_prepared", "moving_sphere_plane",       "ray_aabox",
    "sphere_box_penetration", "sphere_plane_penetration",       "sphere_sphere_penetration",
};

/// Whether Decisive has a kernel for the query. Elsewhere it has the very bits of Certified, or of Fast where the query
/// always says yes.
constexpr bool has_decisive_kernel(std::string_view query) {
  return std::ranges::binary_search(decisive_kernels, query);
}

}  // namespace nearmiss::adapters
