/// Two boxes and their fifteen axes in the world. Shared by the oracles of the queries about pairs of boxes.
#pragma once

#include "oracles/outcomes.hpp"

namespace nearmiss::oracle {

template <class N>
struct TwoBoxes {
  std::array<Vector<N>, 3> axes1, axes2;
  Vector<N> center1, center2, half1, half2, between;

  template <class B>
  TwoBoxes(const B& box1, const B& box2)
      : axes1(rotation_axes<N>(box1.orientation)), axes2(rotation_axes<N>(box2.orientation)),
        center1(vector(box1.center)), center2(vector(box2.center)),
        half1(vector(box1.half)), half2(vector(box2.half)), between(minus(center2, center1)) {}

  /// 0-2 the axes of box 1, 3-5 of box 2, 6 + 3 i + j the cross product of axis i and axis j.
  Vector<N> axis(int k) const {
    if (k < 3) return axes1[k];
    if (k < 6) return axes2[k - 3];
    Vector<N> cross = outer(axes1[(k - 6) / 3], axes2[(k - 6) % 3]);
    for (N& x : cross) x = assume_within(x, -1.0, 1.0);
    return cross;
  }
  N cosine(int i, int j) const { return assume_within(inner(axes1[i], axes2[j]), -1.0, 1.0); }

  /// Half the lengths of the boxes' shadows on axis k, times |axis k|. A box reaches its half extent along
  /// an axis of its own, and nothing of an edge at a right angle to it.
  N reach1(int k, const Vector<N>& axis) const { return reach(axes1, half1, axis, k < 3 ? k : -1, k < 6 ? -1 : (k - 6) / 3); }
  N reach2(int k, const Vector<N>& axis) const {
    return reach(axes2, half2, axis, k >= 3 && k < 6 ? k - 3 : -1, k < 6 ? -1 : (k - 6) % 3);
  }
  /// How far the shadows lie apart, times |axis k|; negative where they overlap.
  N gap(int k, const Vector<N>& axis) const {
    return magnitude(inner(between, axis)) - reach1(k, axis) - reach2(k, axis);
  }
  N gap(int k) const { return gap(k, axis(k)); }

 private:
  static N reach(const std::array<Vector<N>, 3>& axes, const Vector<N>& half, const Vector<N>& axis, int own,
                 int orthogonal) {
    if (own >= 0) return half[own];
    N sum(0);
    for (int i = 0; i < 3; ++i) {
      if (i != orthogonal) sum = sum + half[i] * assume_within(magnitude(inner(axes[i], axis)), 0.0, 1.0);
    }
    return sum;
  }
};

}  // namespace nearmiss::oracle
