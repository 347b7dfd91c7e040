/// A moving point and the front side of a triangle. Shared by the oracles of triangles and rectangles.
#pragma once

#include "oracles/algorithms/residual.hpp"
#include "oracles/algorithms/times.hpp"

namespace nearmiss::oracle {

/// The possible results of the motion; `impact` and `normals` are those of a hit.
template <class N>
struct FrontHit {
  bool may_hit = false, may_miss = true;
  collide::Impact<N> impact{};
  Normals<N> normals{};
};

/// Solves the plane's linear equation, then compares the line's moments about the edges with zero.
template <class N>
FrontHit<N> front_hit(const Vector<N>& p, const Vector<N>& v, const std::array<Vector<N>, 3>& corner) {
  const Vector<N> n = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
  const N approach = -dot(n, v);                 // > 0: toward the front
  const N height = dot(n, minus(p, corner[0]));  // >= 0: starts in front
  FrontHit<N> hit;
  if (!may_be_positive(approach) || !may_be_at_least_zero(height)) return hit;
  bool may_miss = may_be_at_most_zero(approach) || may_be_negative(height);
  // The line of motion passes edge i on its inner side if its moment about the edge is not negative.
  for (int i = 0; i < 3; ++i) {
    const Vector<N> a = minus(corner[i], p), b = minus(corner[(i + 1) % 3], p);
    const N moment = -dot(v, cross(a, b));
    if (!may_be_at_least_zero(moment)) return hit;
    may_miss = may_miss || may_be_negative(moment);
  }
  Vector<N> low = corner[0], high = corner[0];  // the triangle's bounds
  if constexpr (is_enclosure<N>) {
    for (int i = 0; i < 3; ++i) low[i] = join(join(corner[0][i], corner[1][i]), corner[2][i]);
    high = low;
  }
  N time = time_across(height, approach);
  Vector<N> place;
  if (!narrow_to_range(time, p, v, low, high) || !place_in_range(time, p, v, low, high, place)) return hit;
  if constexpr (is_enclosure<N>) {
    if (!may_be_zero(approach) && !narrow_to_crossing(p, v, corner, n, time, place)) return hit;
  }
  hit.may_hit = true;
  hit.may_miss = may_miss;
  hit.impact = {time, answer_vector(place), answer_vector(n)};
  const N length2 = norm2(n);
  if (may_be_zero(length2)) {
    hit.normals = Normals<N>::any();
  } else {
    hit.impact.normal = answer_vector(times(n, N(N(1) / root(length2))));
  }
  return hit;
}

template <class N, class Out>
void report(const FrontHit<N>& hit, Out& out) {
  if (hit.may_miss) out.no();
  if (hit.may_hit) out.yes(hit.impact, hit.normals);
}

}  // namespace nearmiss::oracle
