/// A point and a triangle projected along a coordinate axis. Shared by the oracles of containment.
#pragma once

#include "oracles/algorithms/nearest_piece.hpp"

namespace nearmiss::oracle {

/// Calls f(axis) for each axis that may have the component of largest magnitude; of equal components the first counts.
template <class N, class F>
void for_each_possible_axis(const Vector<N>& normal, F&& f) {
  for (int k = 0; k < 3; ++k) {
    bool largest = true;
    for (int j = 0; j < 3; ++j) {
      const N mine = magnitude(normal[k]), other = magnitude(normal[j]);
      if (j < k) largest = largest && may_be_less(other, mine);
      if (j > k) largest = largest && may_be_at_most(other, mine);
    }
    if (largest) f(k);
  }
}

/// Compares the point with the triangle by the areas of the three triangles that the point forms with the edges.
template <class N>
struct SeenAlong {
  bool may_be_inside = false, may_be_outside = false;
  bool may_be_flat = false;    ///< inside, and the triangle has no area
  bool may_have_area = false;  ///< inside, and the triangle has an area
  std::array<N, 3> weight;     ///< of the corners, if the triangle has an area
  std::array<int, 2> seen;     ///< the two axes of the projection plane

  SeenAlong(const std::array<Vector<N>, 3>& corner, int axis, const Vector<N>& p)
      : seen{(axis + 1) % 3, (axis + 2) % 3} {
    const auto [a, b] = seen;
    const auto area = [a = a, b = b](const Vector<N>& x, const Vector<N>& y) { return x[a] * y[b] - x[b] * y[a]; };
    std::array<N, 3> part;  // opposite to each corner
    for (int i = 0; i < 3; ++i) part[i] = area(minus(corner[(i + 1) % 3], p), minus(corner[(i + 2) % 3], p));
    const N whole = area(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
    bool may_fit = true;  // within the triangle's bounds
    bool must_fit = true;
    for (int k : seen) {
      const N low = lesser(lesser(corner[0][k], corner[1][k]), corner[2][k]);
      const N high = -lesser(lesser(N(-corner[0][k]), N(-corner[1][k])), N(-corner[2][k]));
      may_fit = may_fit && may_be_at_most(low, p[k]) && may_be_at_most(p[k], high);
      must_fit = must_fit && !may_be_less(p[k], low) && !may_be_less(high, p[k]);
    }
    for (const int sign : {-1, 1}) {
      if (!may_be_positive(N(N(sign) * whole))) continue;
      bool may = may_fit;
      for (const N& x : part) {
        may = may && may_be_at_least_zero(N(N(sign) * x));
        may_be_outside = may_be_outside || may_be_negative(N(N(sign) * x));
      }
      may_have_area = may_have_area || may;
    }
    if (may_be_zero(whole)) {
      may_be_flat = may_fit;
      may_be_outside = may_be_outside || !must_fit;
      for (const N& x : part) {
        may_be_flat = may_be_flat && may_be_zero(x);
        may_be_outside = may_be_outside || !surely_zero(x);
      }
    }
    may_be_inside = may_have_area || may_be_flat;
    for (int i = 0; i < 3; ++i) {
      weight[i] = may_be_zero(whole) ? join(N(0), N(1)) : N(assume_within(N(part[i] / whole), 0.0, 1.0));
    }
  }
};

}  // namespace nearmiss::oracle
