/// The kernel of sphere_triangle_overlap (collide/sphere_triangle_overlap.hpp).
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/lanes.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// The distances of the features of a triangle from the center of a sphere, branchless.
template <class T>
struct SphereFromTriangle {
  using L = Lanes<T>;
  L distances2;                ///< squared distances of the edges from v0, v1, v2 to the next corner, and of the plane
  L lengths2;                  ///< squared lengths of the edges
  L height2;                   ///< squared height of v2 above the line of the first edge; in every lane
  L base_weight, apex_weight;  ///< weights of v1 and v2 at the foot in the plane; in every lane
  L inside;                    ///< mask: the foot lies in the triangle

  SphereFromTriangle(const L& center, const L& v0, const L& v1, const L& v2) {
    const L zero = L::splat(T(0)), one = L::splat(T(1));
    const L edge0 = v1 - v0, edge1 = v2 - v1, edge2 = v0 - v2, w0 = center - v0, w1 = center - v1, w2 = center - v2;
    // The parameter of the center along each edge. Last lane: the corner v0 along the edge that ends there.
    lengths2 = sums_of_three(edge0 * edge0, edge1 * edge1, edge2 * edge2, edge0 * edge0);
    const L along = sums_of_three(w0 * edge0, w1 * edge1, w2 * edge2, edge2 * edge0) / lengths2;
    const L share = smaller(larger(along, zero), one) & (zero < lengths2);
    const L from_edge0 = w0 - edge0 * share.template broadcast<0>(),
            from_edge1 = w1 - edge1 * share.template broadcast<1>();
    const L from_edge2 = w2 - edge2 * share.template broadcast<2>();
    // The foot on the face, as foot_on_face computes it.
    const L base_share = along.template broadcast<0>(), apex_share = zero - along.template broadcast<3>();
    const L height = zero - edge2 - edge0 * apex_share, beside = w0 - edge0 * base_share;
    const L measures = sums_of_three(height * height, beside * height, height, height);
    height2 = measures.template broadcast<0>();
    apex_weight = measures.template broadcast<1>() / height2;
    base_weight = base_share - apex_weight * apex_share;
    inside = (zero <= apex_weight) & (zero <= base_weight) & (base_weight + apex_weight <= one);
    const L from_face = beside - height * apex_weight;
    distances2 =
        sums_of_three(from_edge0 * from_edge0, from_edge1 * from_edge1, from_edge2 * from_edge2, from_face * from_face);
  }
};

/// Filter in doubles: whether sphere and triangle meet; nullopt if rounding may change the decision.
///
/// Let u = 2^-53 and S the sum of |x| + |y| + |z| of the corners relative to the center. The foot on an edge lies on
/// the edge within 8 u S, and the foot on the face in the triangle within 8 u S, whatever the errors of their
/// parameters. So the computed squared distances are too small by at most 128 u S^2. They are too large by at most as
/// much if the parameters are accurate: the parameter of an edge has an error of 8 u S / length, which has no
/// first-order effect on the squared distance. Height and plane have an error of at most 16 u S / height of each
/// other's lengths. If edge and height are no shorter than S / 64, the weights have an error of 2^-29, and the squared
/// distance from the plane 2^12 u S^2.
template <class T>
std::optional<bool> filtered_overlap(const Sphere<T>& sphere, const Triangle<T>& triangle) {
  using L = Lanes<double>;
  const L center = wide_lanes(sphere.center), v0 = wide_lanes(triangle.v0), v1 = wide_lanes(triangle.v1),
          v2 = wide_lanes(triangle.v2);
  const SphereFromTriangle<double> seen(center, v0, v1, v2);
  const double s = sum_of_three(absolute(v0 - center) + absolute(v1 - center) + absolute(v2 - center)).first();
  const double r = sphere.radius, s2 = s * s, scale2 = s2 + r * r;
  if (!(scale2 >= 0x1p-800 && scale2 <= 0x1p800)) return std::nullopt;
  const L beyond = seen.distances2 - L::splat(r * r), bound = L::splat(0x1p-45 * scale2), zero = L::splat(0.0),
          one = L::splat(1.0);
  if (((beyond < zero - bound) & (seen.inside | L::mask_of_three())).bits() != 0) return true;
  const L margin = L::splat(0x1p-20);
  const L outside = (seen.apex_weight < zero - margin) | (seen.base_weight < zero - margin) |
                    (one + margin < seen.base_weight + seen.apex_weight) |
                    (L::splat(0x1p-38 * scale2) < beyond.template broadcast<3>());
  const L well_shaped = L::splat(s2) <= L::splat(0x1p12) * smaller(seen.height2, seen.lengths2);
  if (all_three((bound < beyond) & outside & well_shaped)) return false;
  return std::nullopt;
}

}  // namespace detail

#endif

COLLIDE_COMPILED(sphere_triangle_overlap)

namespace kernels {

template <class Tier, class T>
inline Decision<T> sphere_triangle_overlap(const Sphere<T>& sphere, const Triangle<T>& triangle) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {
    using detail::lanes;
    using L = detail::Lanes<T>;
    const L v0 = lanes(triangle.v0), v1 = lanes(triangle.v1), v2 = lanes(triangle.v2), center = lanes(sphere.center);
    const L radius = L::splat(sphere.radius), finite = are_finite(v0, v1, v2, center, radius);
    const detail::SphereFromTriangle<T> seen(center, v0, v1, v2);
    const L reaches = (seen.distances2 - radius * radius <= L::splat(T(0))) & (seen.inside | L::mask_of_three());
    return {all_three(finite) && reaches.bits() != 0};
  }
  if constexpr (uses_filter<Tier, T>) {
    if (const auto decided = detail::filtered_overlap(sphere, triangle))
      return Tier::decided_by_filter(Decision<T>{*decided});
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(sphere_triangle_overlap, sphere, triangle);
  } else {
    if constexpr (MachineNumber<T>) {
      const Vec3<T> all = triangle.v0 + triangle.v1 + triangle.v2;
      if (!detail::is_finite(all) || !(sphere.radius <= std::numeric_limits<T>::max())) return {false};
    }
    const auto reaches = [&](const Vec3<T>& away) { return Tier::beyond_radius(away, sphere.radius) <= T(0); };
    const Vec3<T> base = triangle.v1 - triangle.v0, w = sphere.center - triangle.v0;
    const detail::FaceFoot<T> face = detail::foot_on_face<Tier>(base, triangle.v2 - triangle.v0, w);
    if (face.inside) return {reaches(w - face.from_start(base))};
    const std::array<Vec3<T>, 3> v = detail::corners(triangle);
    for (int i = 0; i < 3; ++i) {
      if (reaches(sphere.center - v[i] - detail::foot_on_edge<Tier>(v[i], v[(i + 1) % 3], sphere.center).from_start)) {
        return {true};
      }
    }
    return {false};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
