/// Derivations of the queries about pairs of boxes: every corner is projected, every pair of edges is tried.
#include "properties/derivation.hpp"

namespace nearmiss::derived {
namespace {

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

/// The gap between the projections of all corners on the axis; negative if they overlap.
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

Reference reference_box_box_info(Reader r) {
  const RefBox a(r), b(r);
  const V d = sub(b.center, a.center), d1 = a.local(d), d2 = b.local(d);
  Reference reference{true, {}};
  const auto give = [&](const V& v) { reference.give(v); };
  give(a.half), give(b.half), give(d);
  std::array<V, 3> cosines;
  for (int i = 0; i < 3; ++i)
    cosines[i] = {dot(a.axes[i], b.axes[0]), dot(a.axes[i], b.axes[1]), dot(a.axes[i], b.axes[2])};
  for (const V& row : cosines) give(row);
  for (const V& row : cosines) give({abs(row[0]), abs(row[1]), abs(row[2])});
  give(d1), give(d2);
  return reference;
}

Reference reference_box_box_projected_distance(Reader r) {
  const RefBox a(r), b(r);
  const int k = int(r.number().get_d());
  return yes(gap_of(a, b, axis_of(a, b, k)));
}

Reference reference_box_box_separating_axis(Reader r) {
  const RefBox a(r), b(r);
  return yes(axis_of(a, b, int(r.number().get_d())));
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

/// |D| <= |a| + |b|, squared twice.
Reference reference_box_box_conservative(Reader r) {
  const RefBox a(r), b(r);
  const V d = sub(b.center, a.center);
  const Q rest = dot(d, d) - dot(a.half, a.half) - dot(b.half, b.half);
  const Q product = 4 * dot(a.half, a.half) * dot(b.half, b.half);
  return {rest <= 0 || rest * rest <= product, {}};
}

/// The parameter t of the point nearest to p on the segment middle + t d, |t| <= half; d is a unit vector.
Q along_edge(const V& middle, const V& d, const Q& half, const V& p) {
  const Q t = dot(sub(p, middle), d);
  return t > half ? half : t < -half ? Q(-half) : t;
}

/// The middle of the shortest segment between two edges: by Cramer's rule, or from an end to the other edge.
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

/// The middles of a box's edges parallel to axis i.
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

/// An axis that separates, otherwise one of least overlap, compared by squares.
Reference reference_box_box_penetration(Reader r) {
  const RefBox a(r), b(r);
  std::vector<int> separating, least;
  Q least2;
  std::array<Q, 15> gap, length2;
  for (int k = 0; k < 15; ++k) {
    const V axis = axis_of(a, b, k);
    length2[k] = square_of(axis), gap[k] = gap_of(a, b, axis);
    if (length2[k] == 0) continue;
    if (gap[k] > 0) separating.push_back(k);
    const Q overlap2 = gap[k] * gap[k] / length2[k];
    if (least.empty() || overlap2 < least2) least.clear(), least2 = overlap2;
    if (overlap2 == least2) least.push_back(k);
  }
  Reference reference{separating.empty(), {}};
  const int k = r.choose.among(separating.empty() ? least : separating);
  reference.give(over_root(-gap[k], length2[k]));
  reference.give(double(k));
  if (!reference.yes) return reference;
  V axis = axis_of(a, b, k);
  const Q from_1_to_2 = dot(axis, sub(b.center, a.center));
  if (from_1_to_2 < 0 || (from_1_to_2 == 0 && r.choose.below(2) == 1)) axis = scaled(axis, -1);
  const auto furthest = [&](const std::vector<V>& points, int sign) {
    std::vector<V> all;
    for (const V& p : points) {
      const Q further = all.empty() ? Q(1) : Q(sign * dot(sub(p, all.front()), axis));
      if (further > 0) all.clear();
      if (further >= 0) all.push_back(p);
    }
    return all;
  };
  V contact;
  if (k < 3) {
    contact = add(r.choose.between(furthest(corners_of(b), -1)), scaled(axis, -gap[k] / 2));
  } else if (k < 6) {
    contact = add(r.choose.between(furthest(corners_of(a), 1)), scaled(axis, gap[k] / 2));
  } else {
    const int i = (k - 6) / 3, j = (k - 6) % 3;
    contact = middle_between_edges(r.choose.among(furthest(edges_of(a, i), 1)), a.axes[i], a.half[i],  //
                                   r.choose.among(furthest(edges_of(b, j), -1)), b.axes[j], b.half[j]);
  }
  reference.give_unit(axis);
  reference.give(contact);
  return reference;
}

/// Clips points to the half-space n . x <= d; the polygon may be a segment or a point.
std::vector<V> clipped(const std::vector<V>& polygon, const V& n, const Q& d) {
  std::vector<V> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const V &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Q ha = dot(n, a) - d, hb = dot(n, b) - d;
    if (ha <= 0) kept.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) {
      const Q t = ha / (ha - hb);
      kept.push_back({a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t});
    }
  }
  return kept;
}

V corner_of(const RefBox& b, int sx, int sy, int sz) {
  V x = b.center;
  const Q s[3] = {b.half[0] * sx, b.half[1] * sy, b.half[2] * sz};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) x[k] += b.axes[i][k] * s[i];
  }
  return x;
}

/// Boxes overlap if a face of the first, clipped to the second, is not empty, or if the second lies in the first.
bool meet(const RefBox& a, const RefBox& b) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      std::vector<V> face;
      for (const auto& [u, v] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) {
        int s[3];
        s[axis] = side, s[(axis + 1) % 3] = u, s[(axis + 2) % 3] = v;
        face.push_back(corner_of(a, s[0], s[1], s[2]));
      }
      for (int i = 0; i < 3; ++i) {
        const V back{-b.axes[i][0], -b.axes[i][1], -b.axes[i][2]};
        const Q at = dot(b.axes[i], b.center);
        face = clipped(clipped(face, b.axes[i], at + b.half[i]), back, b.half[i] - at);
      }
      if (!face.empty()) return true;
    }
  }
  const V c = a.local(sub(b.center, a.center));
  return abs(c[0]) <= a.half[0] && abs(c[1]) <= a.half[1] && abs(c[2]) <= a.half[2];
}

/// Also gives an axis with a gap if the boxes are apart.
Reference reference_box_box_overlap(Reader r) {
  const RefBox a(r), b(r);
  if (meet(a, b)) return yes();
  std::vector<int> separating;
  for (int k = 0; k < 15; ++k) {
    if (gap_of(a, b, axis_of(a, b, k)) > 0) separating.push_back(k);
  }
  Reference reference = no();
  if (!separating.empty()) reference.give(double(r.choose.among(separating)));
  return reference;
}

}  // namespace

std::span<const Derived> of_boxes() {
  static constexpr Derived all[] = {{"box_box_info", &reference_box_box_info},
                                    {"box_box_projected_distance", &reference_box_box_projected_distance},
                                    {"box_box_separating_axis", &reference_box_box_separating_axis},
                                    {"box_box_parallel_axis", &reference_box_box_parallel_axis},
                                    {"box_box_conservative", &reference_box_box_conservative},
                                    {"box_box_penetration", &reference_box_box_penetration},
                                    {"box_box_overlap", &reference_box_box_overlap}};
  return all;
}

}  // namespace nearmiss::derived
