/// A point and a box, in the box's frame: which features of the box may be nearest. Shared by the oracles of queries
/// with boxes.
#pragma once

#include <algorithm>

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

/// The sides of the box beyond which a point lies, per axis: -1, 0 (between the two face planes), +1.
using Sides = std::array<int, 3>;

inline int beyond(const Sides& s) { return (s[0] != 0) + (s[1] != 0) + (s[2] != 0); }

/// Whether `coordinate` may lie on `side` of [-half, half]. Face planes belong to both neighbours.
template <class N>
bool may_be_on_side(const N& coordinate, const N& half, int side) {
  if (side > 0) return may_be_at_most(half, coordinate);
  if (side < 0) return may_be_at_most(coordinate, N(-half));
  return may_be_at_most(N(-half), coordinate) && may_be_at_most(coordinate, half);
}

/// Calls f(sides) for each of the 26 regions around the box, without the inside.
template <class F>
void for_each_region(F&& f) {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) f(Sides{x, y, z});
      }
    }
  }
}

/// Calls f(sides) for each region in which the point may lie.
template <class N, class F>
void for_each_possible_region(const Vector<N>& local, const Vector<N>& half, F&& f) {
  bool may[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int side = -1; side <= 1; ++side) may[i][side + 1] = may_be_on_side(local[i], half[i], side);
  }
  for_each_region([&](const Sides& s) {
    if (may[0][s[0] + 1] && may[1][s[1] + 1] && may[2][s[2] + 1]) f(s);
  });
}

/// The outward normals of the box at the feature of that region.
template <class N>
Normals<N> normal_cone(const std::array<Vector<N>, 3>& axes, const Sides& sides) {
  NumberVector<Facing<N>> facing;
  for (int i = 0; i < 3; ++i) facing.push_back({axes[i], sides[i] < 0 ? -1 : 0, sides[i] > 0 ? 1 : 0});
  return Normals<N>::cone(std::move(facing));
}

/// Calls f(sides) for regions that together have all outward normals at a point that may lie on the surface. A region
/// between two face planes has no further normals than its neighbour beyond one of them.
template <class N, class F>
void for_each_cone_at(const Vector<N>& local, const Vector<N>& half, F&& f) {
  for_each_possible_region(local, half, [&](const Sides& sides) {
    for (int i = 0; i < 3; ++i) {
      if (sides[i] == 0 && (may_be_on_side(local[i], half[i], 1) || may_be_on_side(local[i], half[i], -1))) return;
    }
    f(sides);
  });
}

/// Whether one of the outward normals there may not point along the motion.
template <class N>
bool may_be_met(const Vector<N>& step, const Sides& sides) {
  for (int i = 0; i < 3; ++i) {
    if (sides[i] != 0 && may_be_at_most_zero(N(N(sides[i]) * step[i]))) return true;
  }
  return false;
}

/// Splits a point of that region into the box's nearest point and the rest: `nearest` + `away` = the point.
template <class N>
struct FromFeature {
  Vector<N> nearest, away;
  N distance2;
  /// The length of `away`, without a square root if only one axis counts.
  N distance(const Sides& sides) const {
    return beyond(sides) == 1 ? magnitude(N(away[0] + away[1] + away[2])) : root(distance2);
  }
};

template <class N>
FromFeature<N> from_feature(const Vector<N>& local, const Vector<N>& half, const Sides& sides) {
  FromFeature<N> f{local, {N(0), N(0), N(0)}, N(0)};
  for (int i = 0; i < 3; ++i) {
    if (sides[i] == 0) continue;
    f.nearest[i] = sides[i] > 0 ? half[i] : N(-half[i]);
    const N e = local[i] - f.nearest[i];
    f.away[i] = sides[i] > 0 ? N(assume_at_least_zero(e)) : N(assume_at_most_zero(e));
  }
  f.distance2 = norm2(f.away);
  return f;
}

/// A face: axis and side (+1, -1) of its outward normal.
struct Face {
  int axis;
  int side;
};

/// For a point inside or on the surface: calls f(face, distance) for each face that may be nearest.
template <class N, class F>
void for_each_nearest_face(const Vector<N>& local, const Vector<N>& half, F&& f) {
  std::array<N, 6> distance;
  for (int i = 0; i < 3; ++i) {
    if (!may_be_on_side(local[i], half[i], 0)) return;
    distance[2 * i] = assume_at_least_zero(N(half[i] - local[i]));
    distance[2 * i + 1] = assume_at_least_zero(N(half[i] + local[i]));
  }
  for (int k = 0; k < 6; ++k) {
    const auto nearer_than = [&](const N& other) { return may_be_at_most(distance[k], other); };
    if (std::all_of(distance.begin(), distance.end(), nearer_than)) f(Face{k / 2, k % 2 == 0 ? 1 : -1}, distance[k]);
  }
}

}  // namespace nearmiss::oracle
