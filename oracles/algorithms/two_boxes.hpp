/// Two boxes and their fifteen axes in the world frame. Shared by the oracles of the queries about pairs of boxes.
///
/// If an enclosure of a cross product a x b contains zero, it may have any direction u perpendicular to a, an axis of
/// one box, and to b, an axis of the other. Projected along a, both boxes are polygons apart from an extent of h |b .
/// u|, where h is the half extent along b; that is at most h |a x b|. The polygons' edges are perpendicular to four
/// axes: the two other axes of a's box, and a's cross products with the two other axes of b's box. Therefore:
/// 1. the overlap along u is at least the least overlap along these four axes minus h |a x b|;
/// 2. a gap along u is at most the distance of the polygons. That is the gap along one of the four axes, or the
///    distance of two corners. In the second case two of the axes, at an angle of at most 90 degrees and with gaps f
///    and g, enclose u, and the distance is at most sqrt(f^2 + g^2) and at most the larger gap over the cosine of half
///    the angle.
#pragma once

#include <algorithm>
#include <limits>

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N>
struct TwoBoxes {
  std::array<Vector<N>, 3> axes1, axes2;
  Vector<N> center1, center2, half1, half2, between;

  template <class B>
  TwoBoxes(const B& box1, const B& box2)
      : axes1(rotation_axes<N>(box1.orientation)),
        axes2(rotation_axes<N>(box2.orientation)),
        center1(vector(box1.center)),
        center2(vector(box2.center)),
        half1(vector(box1.half)),
        half2(vector(box2.half)),
        between(minus(center2, center1)) {}

  /// 0-2 are the axes of box 1, 3-5 those of box 2, 6 + 3 i + j is the cross product of axis i and axis j.
  Vector<N> axis(int k) const {
    if (k < 3) return axes1[k];
    if (k < 6) return axes2[k - 3];
    Vector<N> product = cross(axes1[(k - 6) / 3], axes2[(k - 6) % 3]);
    for (N& x : product) x = assume_within(x, -1.0, 1.0);
    return product;
  }
  N cosine(int i, int j) const { return assume_within(dot(axes1[i], axes2[j]), -1.0, 1.0); }

  /// Half the lengths of the boxes' projections on axis k, times |axis k|. Along one of its own axes a box extends by
  /// its half extent; an edge perpendicular to axis k adds nothing.
  N reach1(int k, const Vector<N>& axis) const {
    return reach(axes1, half1, axis, k < 3 ? k : -1, k < 6 ? -1 : (k - 6) / 3);
  }
  N reach2(int k, const Vector<N>& axis) const {
    return reach(axes2, half2, axis, k >= 3 && k < 6 ? k - 3 : -1, k < 6 ? -1 : (k - 6) % 3);
  }
  /// The gap between the projections, times |axis k|; negative if they overlap.
  N gap(int k, const Vector<N>& axis) const {
    return magnitude(dot(between, axis)) - reach1(k, axis) - reach2(k, axis);
  }
  N gap(int k) const { return gap(k, axis(k)); }

 private:
  static N reach(const std::array<Vector<N>, 3>& axes, const Vector<N>& half, const Vector<N>& axis, int own,
                 int orthogonal) {
    if (own >= 0) return half[own];
    N sum(0);
    for (int i = 0; i < 3; ++i) {
      if (i != orthogonal) sum = sum + half[i] * assume_within(magnitude(dot(axes[i], axis)), 0.0, 1.0);
    }
    return sum;
  }
};

/// One of the fifteen axes, and the boxes' projections on it.
template <class N>
struct PairAxis {
  Vector<N> direction;  // of any length
  N gap{0}, length{1};  // both times the direction's length
  bool may_exist = true, must_exist = true;
  N depth{0};  // minus the gap, along the unit axis; valid if the axis exists

  PairAxis() = default;
  PairAxis(const TwoBoxes<N>& boxes, int k) : direction(boxes.axis(k)), gap(boxes.gap(k, direction)) {
    if (k >= 6) {
      const N length2 = norm2(direction);
      may_exist = may_be_positive(length2);
      must_exist = !may_be_zero(length2);
      length = assume_within(root(length2), 0.0, 1.0);
    }
    if (must_exist) depth = -gap / length;
  }
};
using PairAxes = std::array<PairAxis<Interval>, inputs::box_box_axes>;

inline double least_depth(const PairAxis<Interval>& a) {
  return a.must_exist ? a.depth.inf() : -std::numeric_limits<double>::infinity();
}

/// The four axes perpendicular to a, where a x b is axis k, and the half extent along b.
struct Across {
  std::array<int, 4> axis;
  Interval half;
};
/// Once with a of box 1 and once with a of box 2.
inline std::array<Across, 2> across(const TwoBoxes<Interval>& boxes, int k) {
  const int i = (k - 6) / 3, j = (k - 6) % 3, i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  const auto number_of = [](int of1, int of2) { return 6 + 3 * of1 + of2; };
  return {Across{{i1, i2, number_of(i, j1), number_of(i, j2)}, boxes.half2[j]},
          Across{{3 + j1, 3 + j2, number_of(i1, j), number_of(i2, j)}, boxes.half1[i]}};
}

/// A lower bound, by (1), of the overlap along every unit vector perpendicular to both edges of axis k.
inline double least_depth_across(const TwoBoxes<Interval>& boxes, const PairAxes& axes, int k) {
  double least = -std::numeric_limits<double>::infinity();
  for (const Across& a : across(boxes, k)) {
    double of_four = std::numeric_limits<double>::infinity();
    for (const int other : a.axis) of_four = std::min(of_four, least_depth(axes[other]));
    least = std::max(least, (of_bound(of_four) - a.half * axes[k].length).inf());
  }
  return least;
}

/// An upper bound of the distance of two corners between two unit axes with these gaps >= 0; at least the larger gap.
inline double distance_between(const PairAxis<Interval>& a, const PairAxis<Interval>& b, double gap_a, double gap_b) {
  const Interval cosine = assume_within(magnitude(dot(a.direction, b.direction)) / (a.length * b.length), 0.0, 1.0);
  const Interval over_half_angle = of_bound(std::max(gap_a, gap_b)) * root(Interval(2) / (Interval(1) + cosine));
  return std::min(over_half_angle.sup(), root(square(of_bound(gap_a)) + square(of_bound(gap_b))).sup());
}

/// An upper bound, by (2), of the gap along every unit vector perpendicular to both edges of axis k.
inline double most_gap_across(const TwoBoxes<Interval>& boxes, const PairAxes& axes, int k) {
  double most = std::numeric_limits<double>::infinity();
  for (const Across& a : across(boxes, k)) {
    std::array<double, 4> gap;
    for (int m = 0; m < 4; ++m) {
      gap[m] = std::max(0.0, (a.half * axes[k].length - of_bound(least_depth(axes[a.axis[m]]))).sup());
    }
    double distance = *std::max_element(gap.begin(), gap.end());
    for (int m = 1; m < 4 && distance < most; ++m) {
      for (int l = 0; l < m; ++l) {
        if (gap[m] == 0 || gap[l] == 0) continue;
        distance = std::max(distance, distance_between(axes[a.axis[m]], axes[a.axis[l]], gap[m], gap[l]));
      }
    }
    most = std::min(most, distance);
  }
  return most;
}

}  // namespace nearmiss::oracle
