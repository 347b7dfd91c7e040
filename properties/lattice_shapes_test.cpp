/// Derivations for the queries about fixed shapes: closest points, containment, overlap of spheres and
/// triangles, depth behind planes; and for the response along a contact.
#include "properties/lattice.hpp"

namespace nearmiss::lattice {
namespace {

V add(const V& a, const V& b, const Q& t = 1) { return {a[0] + b[0] * t, a[1] + b[1] * t, a[2] + b[2] * t}; }
Q distance2(const V& a, const V& b) { return dot(sub(a, b), sub(a, b)); }
/// x / sqrt(y)
double over_root(const Q& x, const Q& y) { return mpf_class(mpf_class(x, 512) / sqrt(mpf_class(y, 512))).get_d(); }

Reference point(const V& x) { return yes(x[0].get_d(), x[1].get_d(), x[2].get_d()); }

/// The points nearest to p among those listed so far.
struct Nearest {
  V p;
  V best{};
  int label = -1;
  bool any = false;

  explicit Nearest(const V& point) : p(point) {}
  void offer(const V& x, int from = 0) {
    if (any && distance2(x, p) >= distance2(best, p)) return;
    best = x, label = from, any = true;
  }
  void offer_segment(const V& a, const V& b, int from = 0) {
    offer(a, from);
    offer(b, from);
    const V d = sub(b, a);
    if (dot(d, d) == 0) return;
    const Q t = dot(sub(p, a), d) / dot(d, d);
    if (t > 0 && t < 1) offer(add(a, d, t), from);
  }
  /// The two normal equations of |p - a - s u - t v|^2, where they have one solution and it is inside.
  void offer_triangle(const V& a, const V& b, const V& c) {
    offer_segment(a, b);
    offer_segment(b, c);
    offer_segment(c, a);
    const V u = sub(b, a), v = sub(c, a), w = sub(p, a);
    const Q uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
    const Q d = uu * vv - uv * uv;
    if (d == 0) return;
    const Q s = (wu * vv - wv * uv) / d, t = (wv * uu - wu * uv) / d;
    if (s >= 0 && t >= 0 && s + t <= 1) offer(add(add(a, u, s), v, t));
  }
};

Reference reference_closest_point_segment_unit(Reader r) {
  const V a = r.vector(), b = r.vector();
  Nearest n(r.vector());
  n.offer_segment(a, b);
  return point(n.best);
}

Reference reference_triangle_perimeter(Reader r) {
  const V a = r.vector(), b = r.vector(), c = r.vector();
  Nearest n(r.vector());
  n.offer_segment(a, b);
  n.offer_segment(b, c);
  n.offer_segment(c, a);
  return point(n.best);
}

Reference reference_triangle_perimeter_edges(Reader r) {
  const V a = r.vector(), b = r.vector(), c = r.vector();
  Nearest n(r.vector());
  n.offer_segment(a, b, 0);
  n.offer_segment(b, c, 1);
  n.offer_segment(c, a, 2);
  Reference reference = point(n.best);
  reference.values.push_back(n.label);
  return reference;
}

Reference reference_rectangle(Reader r) {
  const V a = r.vector(), b = r.vector(), c = r.vector(), d = r.vector();
  Nearest n(r.vector());
  n.offer_triangle(a, b, c);
  n.offer_triangle(a, c, d);
  return point(n.best);
}

Reference reference_rectangle_perimeter(Reader r) {
  const std::array<V, 4> v{r.vector(), r.vector(), r.vector(), r.vector()};
  Nearest n(r.vector());
  for (int i = 0; i < 4; ++i) n.offer_segment(v[i], v[(i + 1) % 4]);
  return point(n.best);
}

/// (p2 + t d2 - p1 - s d1) at right angles to both directions.
Reference reference_lines(Reader r) {
  const V p1 = r.vector(), d1 = r.vector(), p2 = r.vector(), d2 = r.vector();
  const V w = sub(p2, p1);
  const Q a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2);
  Q s = 0, t = -dot(w, d2) / c;
  if (const Q d = a * c - b * b; d != 0) {
    s = (dot(w, d1) * c - dot(w, d2) * b) / d;
    t = (dot(w, d1) * b - dot(w, d2) * a) / d;
  }
  Reference reference = point(add(p1, d1, s));
  const Reference second = point(add(p2, d2, t));
  reference.values.insert(reference.values.end(), second.values.begin(), second.values.end());
  return reference;
}

/// Weights of the corners that give p in the two coordinates other than `axis`; empty where there are none.
std::vector<Q> weights(const std::array<V, 3>& v, int axis, const V& p) {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  const V u = sub(v[1], v[0]), w = sub(v[2], v[0]), x = sub(p, v[0]);
  if (const Q d = u[j] * w[k] - u[k] * w[j]; d != 0) {
    const Q s = (x[j] * w[k] - x[k] * w[j]) / d, t = (u[j] * x[k] - u[k] * x[j]) / d;
    if (s < 0 || t < 0 || s + t > 1) return {};
    return {1 - s - t, s, t};
  }
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const V along = sub(v[b], v[a]), from = sub(p, v[a]);
      const int at = along[j] != 0 ? j : k;
      const Q share = along[at] != 0 ? Q(from[at] / along[at]) : Q(0);
      if (share < 0 || share > 1 || along[j] * share != from[j] || along[k] * share != from[k]) continue;
      std::vector<Q> found(3);
      found[a] = 1 - share;
      found[b] += share;
      return found;
    }
  }
  return {};
}

int axis_of(const V& normal) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (abs(normal[k]) > abs(normal[axis])) axis = k;
  }
  return axis;
}

Reference reference_point_in_triangle(Reader r) {
  const std::array<V, 3> v{r.vector(), r.vector(), r.vector()};
  const V normal = r.vector();
  const int axis = int(r.number().get_d());
  const V p = r.vector();
  const std::vector<Q> w = weights(v, axis < 0 ? axis_of(normal) : axis, p);
  if (w.empty()) return no();
  return yes(w[0].get_d(), w[1].get_d(), w[2].get_d());
}

Reference reference_point_in_rectangle(Reader r) {
  const V a = r.vector(), b = r.vector(), c = r.vector(), d = r.vector();
  const int axis = axis_of(r.vector());
  const V p = r.vector();
  return {!weights({a, b, c}, axis, p).empty() || !weights({a, c, d}, axis, p).empty(), {}};
}

Reference reference_sphere_sphere_overlap(Reader r) {
  const V a = r.vector();
  const Q ra = r.number();
  const V b = r.vector();
  const Q rb = r.number();
  return {distance2(a, b) <= (ra + rb) * (ra + rb), {}};
}

Reference reference_sphere_box_overlap(Reader r) {
  const V p = r.vector();
  const Q radius = r.number();
  const RefBox box(r);
  const V s = box.local(sub(p, box.center));
  Q d = 0;
  for (int i = 0; i < 3; ++i) d += excess(s[i], box.half[i]) * excess(s[i], box.half[i]);
  return {d <= radius * radius, {}};
}

Reference reference_sphere_triangle_overlap(Reader r) {
  Nearest n(r.vector());
  const Q radius = r.number();
  const V a = r.vector(), b = r.vector(), c = r.vector();
  n.offer_triangle(a, b, c);
  return {distance2(n.best, n.p) <= radius * radius, {}};
}

/// The triangle cut by the six half-spaces of the box: is anything left?
Reference reference_aabox_triangle_overlap(Reader r) {
  const V low = r.vector(), high = r.vector();
  std::vector<V> polygon{r.vector(), r.vector(), r.vector()};
  for (int k = 0; k < 6; ++k) {
    const auto above = [&](const V& x) { return k < 3 ? Q(x[k] - high[k]) : Q(low[k - 3] - x[k - 3]); };
    std::vector<V> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const V &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const Q ha = above(a), hb = above(b);
      if (ha <= 0) kept.push_back(a);
      if (sgn(ha) * sgn(hb) < 0) kept.push_back(add(a, sub(b, a), ha / (ha - hb)));
    }
    polygon = kept;
  }
  return {!polygon.empty(), {}};
}

/// Depth; the normal and the contact as long as there is only one of each.
Reference reference_sphere_sphere_penetration(Reader r) {
  const V a = r.vector();
  const Q ra = r.number();
  const V b = r.vector();
  const Q rb = r.number(), d2 = distance2(a, b);
  Reference reference{d2 <= (ra + rb) * (ra + rb), {}};
  reference.values.push_back(mpf_class(mpf_class(Q(ra + rb), 512) - sqrt(mpf_class(d2, 512))).get_d());
  if (!reference.yes || d2 == 0) return reference;
  for (int k = 0; k < 3; ++k) reference.values.push_back(over_root(b[k] - a[k], d2));
  for (int k = 0; k < 3; ++k) {
    const mpf_class out = mpf_class(Q((b[k] - a[k]) * ra), 512) / sqrt(mpf_class(d2, 512));
    reference.values.push_back(mpf_class(mpf_class(a[k], 512) + out).get_d());
  }
  return reference;
}

Reference reference_sphere_plane_penetration(Reader r) {
  const V c = r.vector();
  const Q radius = r.number();
  const V n = r.vector();
  const Q s = dot(n, c) + r.number(), n2 = dot(n, n);
  Reference reference{s <= 0 || s * s <= radius * radius * n2, {}};
  const mpf_class norm = sqrt(mpf_class(n2, 512));
  reference.values.push_back(mpf_class(mpf_class(radius, 512) - mpf_class(s, 512) / norm).get_d());
  if (!reference.yes) return reference;
  for (int k = 0; k < 3; ++k) reference.values.push_back(over_root(n[k], n2));
  for (int k = 0; k < 3; ++k) {
    reference.values.push_back(mpf_class(mpf_class(c[k], 512) - mpf_class(Q(n[k] * radius), 512) / norm).get_d());
  }
  return reference;
}

/// Depth, normal and every corner.
Reference reference_box_plane_penetration(Reader r) {
  const RefBox box(r);
  const V n = r.vector();
  const Q offset = r.number(), n2 = dot(n, n);
  std::vector<double> corners;
  Q deepest = 0;
  bool any = false;
  for (int i = 0; i < 8; ++i) {
    V x = box.center;
    for (int k = 0; k < 3; ++k) x = add(x, box.axes[k], (i >> k) % 2 == 1 ? box.half[k] : Q(-box.half[k]));
    const Q depth = -dot(n, x) - offset;
    if (!any || depth > deepest) deepest = depth;
    any = true;
    corners.push_back(depth >= 0);
    for (int k = 0; k < 3; ++k) corners.push_back(depth >= 0 ? x[k].get_d() : 0.0);
  }
  Reference reference{deepest >= 0, {over_root(deepest, n2)}};
  if (!reference.yes) return reference;
  for (int k = 0; k < 3; ++k) reference.values.push_back(over_root(n[k], n2));
  reference.values.insert(reference.values.end(), corners.begin(), corners.end());
  return reference;
}

/// The velocity less its part along u: v - (v . u) u / |u|^2, over |v|.
Reference reference_slide_direction(Reader r) {
  const V center = r.vector();
  r.number();  // the radius plays no part
  const V v = r.vector();
  const Q time = r.number();
  const V u = sub(add(center, v, time), r.vector());
  if (dot(v, v) == 0) return yes(0.0, 0.0, 0.0);
  const V along = dot(u, u) == 0 ? v : add(v, u, -dot(v, u) / dot(u, u));
  return yes(over_root(along[0], dot(v, v)), over_root(along[1], dot(v, v)), over_root(along[2], dot(v, v)));
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(
    Shapes, OracleOnLattice,
    testing::Values(std::tuple{"closest_point_segment_unit", &reference_closest_point_segment_unit},
                    std::tuple{"closest_point_triangle_perimeter", &reference_triangle_perimeter},
                    std::tuple{"closest_point_triangle_perimeter_edges", &reference_triangle_perimeter_edges},
                    std::tuple{"closest_point_rectangle", &reference_rectangle},
                    std::tuple{"closest_point_rectangle_perimeter", &reference_rectangle_perimeter},
                    std::tuple{"closest_points_lines", &reference_lines},
                    std::tuple{"point_in_triangle", &reference_point_in_triangle},
                    std::tuple{"point_in_rectangle", &reference_point_in_rectangle},
                    std::tuple{"sphere_sphere_overlap", &reference_sphere_sphere_overlap},
                    std::tuple{"sphere_box_overlap", &reference_sphere_box_overlap},
                    std::tuple{"sphere_triangle_overlap", &reference_sphere_triangle_overlap},
                    std::tuple{"aabox_triangle_overlap", &reference_aabox_triangle_overlap},
                    std::tuple{"sphere_sphere_penetration", &reference_sphere_sphere_penetration},
                    std::tuple{"sphere_plane_penetration", &reference_sphere_plane_penetration},
                    std::tuple{"box_plane_penetration", &reference_box_plane_penetration},
                    std::tuple{"slide_direction", &reference_slide_direction}),
    [](const auto& test) { return std::string(std::get<0>(test.param)); });

}  // namespace nearmiss::lattice
