/// Whether an axis-aligned box and a triangle overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/edges.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed axis-aligned box and the closed triangle, seen from either side, meet. A triangle
/// without area is a segment or a point.
///
/// 1. the order of the triangle's corners plays no part
///
/// Source: thirteen separating axes (Akenine-Moeller, Fast 3D Triangle-Box Overlap Testing, 2001). The
/// coordinate axes are compared without rounding; the plane's normal is made of an edge and of the other one
/// at right angles to it, so that a thin triangle has as good a normal as any other.
template <class Tier = Fast, class T>
Decision<T> aabox_triangle_overlap(const AABox<T>& box, const Triangle<T>& triangle) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return aabox_triangle_overlap<decltype(by)>(a...); }, box, triangle);
  }
  if constexpr (MachineNumber<T>) {
    if (!detail::is_finite(box.min + box.max + triangle.v0 + triangle.v1 + triangle.v2)) return {false};
  }
  using Three = std::array<T, 3>;
  const std::array<Three, 3> v{components(triangle.v0), components(triangle.v1), components(triangle.v2)};
  const Three low = components(box.min), high = components(box.max);
  for (int k = 0; k < 3; ++k) {
    if (!(smaller(smaller(v[0][k], v[1][k]), v[2][k]) <= high[k])) return {false};
    if (!(larger(larger(v[0][k], v[1][k]), v[2][k]) >= low[k])) return {false};
  }

  // Across coordinate axis k and an edge: seen along the axis, the line through the edge.
  for (int i = 0; i < 3; ++i) {
    const Three &start = v[i], &end = v[(i + 1) % 3], &apex = v[(i + 2) % 3];
    Three edge, to_low, to_high, to_apex;
    for (int k = 0; k < 3; ++k) {
      edge[k] = end[k] - start[k];
      to_low[k] = low[k] - start[k];
      to_high[k] = high[k] - start[k];
      to_apex[k] = apex[k] - start[k];
    }
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const T b1 = edge[a] * to_low[b], b2 = edge[a] * to_high[b];
      const T a1 = edge[b] * to_low[a], a2 = edge[b] * to_high[a];
      const T of_apex = Tier::difference_of_products(edge[a], to_apex[b], edge[b], to_apex[a]);
      if (!(smaller(b1, b2) - larger(a1, a2) <= not_negative(of_apex))) return {false};
      if (!(larger(b1, b2) - smaller(a1, a2) >= smaller(of_apex, T(0)))) return {false};
    }
  }

  // The plane, its normal times the square of an edge's length: nothing is divided.
  const Vec3<T> base = triangle.v1 - triangle.v0, apex = triangle.v2 - triangle.v0;
  const Vec3<T> height = apex * Tier::dot(base, base) - base * Tier::dot(apex, base);
  const Three normal = components(Tier::cross(base, height));
  T least(0), most(0);
  for (int k = 0; k < 3; ++k) {
    const T to_low = normal[k] * (low[k] - v[0][k]), to_high = normal[k] * (high[k] - v[0][k]);
    least = least + smaller(to_low, to_high);
    most = most + larger(to_low, to_high);
  }
  return {least <= T(0) && most >= T(0)};
}

namespace inputs {
template <class T>
struct aabox_triangle_overlap {
  AABox<T> box{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("box", &aabox_triangle_overlap::box),
                      member("triangle", &aabox_triangle_overlap::triangle));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::aabox_triangle_overlap<Tier>(box, triangle);
  }

  /// First order, G the largest position: an edge and a corner seen from its start carry 1 eps of 2 G each,
  /// their product and sum 2 eps: two terms for the box and two for the apex, 4 * 4 * 2 eps G along the unit
  /// axis. The plane: the height 8 eps of 4 G, which moving the apex explains, the normal 3 eps and the sum of
  /// three products 5 eps of 4 G. Along the direction between box and triangle at most sqrt(3) times as much.
  static constexpr Contract contract(Fast) {
    return {.backward = 112, .lowest = lowest_for<T>(5), .highest = highest_for<T>(5)};
  }
};
}  // namespace inputs
}  // namespace collide
