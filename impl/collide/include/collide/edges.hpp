/// Edges and faces of flat shapes: the nearest point on one of them, and which of two is nearer. What the
/// queries about triangles and rectangles share.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide::detail {

/// The point of an edge nearest to a point, seen from both ends of the edge.
template <class T>
struct EdgeFoot {
  Vec3<T> from_start{}, from_end{};
  T share{};  ///< of the way from start to end
  bool at_end = false;

  Vec3<T> on(const Vec3<T>& start, const Vec3<T>& end) const noexcept { return at_end ? end : start + from_start; }
};

template <class Tier, class T>
EdgeFoot<T> foot_on_edge(const Vec3<T>& start, const Vec3<T>& end, const Vec3<T>& point) noexcept {
  const Vec3<T> along = end - start;
  const T projection = Tier::dot(point - start, along);
  const T length2 = Tier::dot(along, along);
  if (projection <= T(0)) return {{}, -along, T(0), false};
  if (projection >= length2) return {along, {}, T(1), true};
  const T share = projection / length2;
  return {along * share, along * (share - T(1)), share, false};
}

/// |b - w|^2 - |a - w|^2: how much further b is than a, all three seen from the same vertex. Where a and b
/// are near that vertex, as two feet on edges that meet there may be, this keeps what the difference of the
/// two squares would lose.
template <class Tier, class T>
T further_by(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& w) noexcept {
  return Tier::dot(b - a, (a - w) + (b - w));
}

template <class T>
bool is_finite(const Vec3<T>& v) noexcept {
  using std::abs;
  constexpr T most = std::numeric_limits<T>::max();
  return abs(v.x) <= most && abs(v.y) <= most && abs(v.z) <= most;
}

/// Which edge of the triangle, i from v[i] to v[(i + 1) % 3], is the nearest: each is compared with each
/// other from the vertex that they share.
template <class Tier, class T>
int nearest_edge(const std::array<Vec3<T>, 3>& v, const std::array<EdgeFoot<T>, 3>& foot,
                 const Vec3<T>& point) noexcept {
  int best = 0;
  for (const int next : {1, 2, 0, 1}) {
    if (next == best) continue;
    const bool after = next == (best + 1) % 3;
    const T by = after ? further_by<Tier>(foot[best].from_end, foot[next].from_start, point - v[next])
                       : further_by<Tier>(foot[best].from_start, foot[next].from_end, point - v[best]);
    if (by < T(0)) best = next;
  }
  return best;
}

/// Where the perpendicular from a point onto the plane of a triangle meets it. The triangle has the corners
/// 0, base and apex; the point w, like both, is seen from the first corner.
template <class T>
struct FaceFoot {
  bool inside = false;     ///< in the triangle; false where it has no area
  T base_share{};          ///< of the nearest point on the line of the base
  Vec3<T> height{};        ///< from that line to the apex
  T base_weight{}, apex_weight{};

  Vec3<T> from_start(const Vec3<T>& base) const noexcept { return base * base_share + height * apex_weight; }
  Vec3<T> from_end(const Vec3<T>& base) const noexcept {
    return base * (base_share - T(1)) + height * apex_weight;
  }
};

/// Source: orthogonalization of base and apex (Gram and Schmidt), and of w before it is measured along the
/// height. So a thin triangle costs no accuracy: the foot is exact for an apex within a few eps of |apex|.
template <class Tier, class T>
FaceFoot<T> foot_on_face(const Vec3<T>& base, const Vec3<T>& apex, const Vec3<T>& w) noexcept {
  FaceFoot<T> foot;
  const T base2 = Tier::dot(base, base);
  if (!(base2 > T(0))) return foot;
  const T apex_share = Tier::dot(apex, base) / base2;
  foot.height = apex - base * apex_share;
  const T height2 = Tier::dot(foot.height, foot.height);
  if (!(height2 > T(0))) return foot;
  foot.base_share = Tier::dot(w, base) / base2;
  foot.apex_weight = Tier::dot(w - base * foot.base_share, foot.height) / height2;
  foot.base_weight = foot.base_share - foot.apex_weight * apex_share;
  foot.inside = foot.apex_weight >= T(0) && foot.base_weight >= T(0) && foot.base_weight + foot.apex_weight <= T(1);
  return foot;
}

template <class T>
std::array<Vec3<T>, 3> corners(const Triangle<T>& t) noexcept { return {t.v0, t.v1, t.v2}; }

}  // namespace collide::detail
