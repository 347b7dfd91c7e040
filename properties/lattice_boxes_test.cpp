/// Derivations for the queries about pairs of boxes: every corner projected, every pair of edges tried.
#include "properties/lattice.hpp"

namespace nearmiss::lattice {
namespace {

V scaled(const V& a, const Q& s) { return {a[0] * s, a[1] * s, a[2] * s}; }
V add(const V& a, const V& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

std::vector<V> corners_of(const RefBox& b) {
  std::vector<V> corners{b.center};
  for (int i = 0; i < 3; ++i) {
    std::vector<V> next;
    for (const V& c : corners) {
      for (const int side : {-1, 1}) next.push_back(add(c, scaled(b.axes[i], b.half[i] * side)));
    }
    corners = next;
  }
  return corners;
}

V axis_of(const RefBox& a, const RefBox& b, int k) {
  return k < 3 ? a.axes[k] : k < 6 ? b.axes[k - 3] : cross(a.axes[(k - 6) / 3], b.axes[(k - 6) % 3]);
}

/// The gap between the shadows of all corners on the axis; negative where they overlap.
Q gap_of(const RefBox& a, const RefBox& b, const V& axis) {
  const auto shadow = [&](const RefBox& box) {
    std::vector<Q> on;
    for (const V& c : corners_of(box)) on.push_back(dot(c, axis));
    return std::pair(*std::min_element(on.begin(), on.end()), *std::max_element(on.begin(), on.end()));
  };
  const auto [a_low, a_high] = shadow(a);
  const auto [b_low, b_high] = shadow(b);
  return std::max(Q(b_low - a_high), Q(a_low - b_high));
}

double over_root(const Q& x, const Q& square) {
  return mpf_class(mpf_class(x, 512) / sqrt(mpf_class(square, 512))).get_d();
}

Reference reference_box_box_info(Reader r) {
  const RefBox a(r), b(r);
  const V d = sub(b.center, a.center), d1 = a.local(d), d2 = b.local(d);
  Reference reference{true, {}};
  const auto give = [&](const V& v) { for (const Q& x : v) reference.values.push_back(x.get_d()); };
  give(a.half), give(b.half), give(d);
  std::array<V, 3> cosines;
  for (int i = 0; i < 3; ++i) cosines[i] = {dot(a.axes[i], b.axes[0]), dot(a.axes[i], b.axes[1]), dot(a.axes[i], b.axes[2])};
  for (const V& row : cosines) give(row);
  for (const V& row : cosines) give({abs(row[0]), abs(row[1]), abs(row[2])});
  give(d1), give(d2);
  return reference;
}

Reference reference_box_box_projected_distance(Reader r) {
  const RefBox a(r), b(r);
  const int k = int(r.number().get_d());
  return yes(gap_of(a, b, axis_of(a, b, k)).get_d());
}

Reference reference_box_box_separating_axis(Reader r) {
  const RefBox a(r), b(r);
  const V axis = axis_of(a, b, int(r.number().get_d()));
  return yes(axis[0].get_d(), axis[1].get_d(), axis[2].get_d());
}

Reference reference_box_box_parallel_axis(Reader r) {
  const RefBox a(r), b(r);
  const Q epsilon = r.number();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (abs(dot(a.axes[i], b.axes[j])) >= 1 - epsilon) return yes(double(i), double(j));
    }
  }
  return no();
}

/// |D| - |a| - |b| in 512 bits, zero by the squares.
Reference reference_box_box_conservative(Reader r) {
  const RefBox a(r), b(r);
  const V d = sub(b.center, a.center);
  const Q rest = dot(d, d) - dot(a.half, a.half) - dot(b.half, b.half);
  const Q product = 4 * dot(a.half, a.half) * dot(b.half, b.half);
  return {rest <= 0 || rest * rest <= product, {}};
}

/// The point of the segment from a along d (there and back by half) that is nearest to p: how far along.
Q along_edge(const V& middle, const V& d, const Q& half, const V& p) {
  const Q t = dot(sub(p, middle), d);
  return t > half ? half : t < -half ? Q(-half) : t;
}

/// The middle of the shortest segment between two edges: Cramer's rule, or from an end to the other edge.
V middle_between_edges(const V& m1, const V& d1, const Q& h1, const V& m2, const V& d2, const Q& h2) {
  const V w = sub(m2, m1);
  const Q c = dot(d1, d2), det = 1 - c * c;
  const Q s = (dot(w, d1) - c * dot(w, d2)) / det, t = (c * dot(w, d1) - dot(w, d2)) / det;
  const auto at1 = [&](const Q& x) { return add(m1, scaled(d1, x)); };
  const auto at2 = [&](const Q& x) { return add(m2, scaled(d2, x)); };
  std::vector<std::pair<V, V>> pairs;
  if (abs(s) <= h1 && abs(t) <= h2) {
    pairs.push_back({at1(s), at2(t)});
  } else {
    for (const int side : {-1, 1}) {
      const V end1 = at1(h1 * side), end2 = at2(h2 * side);
      pairs.push_back({end1, at2(along_edge(m2, d2, h2, end1))});
      pairs.push_back({at1(along_edge(m1, d1, h1, end2)), end2});
    }
  }
  const auto distance2 = [](const std::pair<V, V>& p) { return dot(sub(p.first, p.second), sub(p.first, p.second)); };
  const auto best = *std::min_element(pairs.begin(), pairs.end(),
                                      [&](const auto& p, const auto& q) { return distance2(p) < distance2(q); });
  return scaled(add(best.first, best.second), Q(1, 2));
}

/// The middles of a box's edges along axis i.
std::vector<V> edges_of(const RefBox& b, int i) {
  std::vector<V> middles;
  for (const int u : {-1, 1}) {
    for (const int v : {-1, 1}) {
      const int k = (i + 1) % 3, l = (i + 2) % 3;
      middles.push_back(add(b.center, add(scaled(b.axes[k], b.half[k] * u), scaled(b.axes[l], b.half[l] * v))));
    }
  }
  return middles;
}

/// The first axis that separates; else the first of least overlap, compared by squares.
Reference reference_box_box_penetration(Reader r) {
  const RefBox a(r), b(r);
  int least = -1;
  Q least_gap, least2;
  for (int k = 0; k < 15; ++k) {
    const V axis = axis_of(a, b, k);
    const Q length2 = dot(axis, axis), gap = gap_of(a, b, axis);
    if (length2 == 0) continue;
    if (gap > 0) return {false, {over_root(-gap, length2), double(k)}};
    if (least < 0 || gap * gap / length2 < least2) least = k, least_gap = gap, least2 = gap * gap / length2;
  }
  V axis = axis_of(a, b, least);
  if (dot(axis, sub(b.center, a.center)) < 0) axis = scaled(axis, -1);
  const Q length2 = dot(axis, axis);
  const auto furthest = [&](const std::vector<V>& points, int sign) {
    return *std::max_element(points.begin(), points.end(),
                             [&](const V& p, const V& q) { return sign * dot(p, axis) < sign * dot(q, axis); });
  };
  V contact;
  if (least < 3) {
    contact = add(furthest(corners_of(b), -1), scaled(axis, -least_gap / 2));
  } else if (least < 6) {
    contact = add(furthest(corners_of(a), 1), scaled(axis, least_gap / 2));
  } else {
    const int i = (least - 6) / 3, j = (least - 6) % 3;
    contact = middle_between_edges(furthest(edges_of(a, i), 1), a.axes[i], a.half[i],  //
                                   furthest(edges_of(b, j), -1), b.axes[j], b.half[j]);
  }
  return yes(over_root(-least_gap, length2), double(least), over_root(axis[0], length2), over_root(axis[1], length2),
             over_root(axis[2], length2), contact[0].get_d(), contact[1].get_d(), contact[2].get_d());
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(
    Boxes, OracleOnLattice,
    testing::Values(std::tuple{"box_box_info", &reference_box_box_info},
                    std::tuple{"box_box_projected_distance", &reference_box_box_projected_distance},
                    std::tuple{"box_box_separating_axis", &reference_box_box_separating_axis},
                    std::tuple{"box_box_parallel_axis", &reference_box_box_parallel_axis},
                    std::tuple{"box_box_conservative", &reference_box_box_conservative},
                    std::tuple{"box_box_penetration", &reference_box_box_penetration}),
    [](const auto& test) { return std::string(std::get<0>(test.param)); });

}  // namespace nearmiss::lattice
