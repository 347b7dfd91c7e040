/// Derivations of the queries about fixed shapes: closest points, containment, overlap of spheres and triangles,
/// penetration of planes; and of the response at a contact.
#include "properties/derivation.hpp"

namespace nearmiss::derived {
namespace {

Q distance2(const V& a, const V& b) { return square_of(sub(a, b)); }

/// The point nearest to p among those listed so far; of equally near ones any.
struct Nearest {
  V p;
  Choice choose;
  V best{};
  Q best2;
  int label = -1;
  int equal = 0;  ///< number of points as near as the best

  Nearest(const V& point, const Choice& choice) : p(point), choose(choice) {}
  explicit Nearest(Reader& r) : Nearest(r.vector(), r.choose) {}
  void offer(const V& x, int from = 0) {
    const Q d = distance2(x, p);
    if (equal > 0 && d > best2) return;
    equal = equal > 0 && d == best2 ? equal + 1 : 1;
    if (equal > 1 && (!choose.is_free() || choose.below(equal) > 0)) return;
    best = x, best2 = d, label = from;
  }
  void offer_segment(const V& a, const V& b, int from = 0) {
    offer(a, from);
    offer(b, from);
    const V d = sub(b, a);
    if (dot(d, d) == 0) return;
    const Q t = dot(sub(p, a), d) / dot(d, d);
    if (t > 0 && t < 1) offer(add(a, d, t), from);
  }
  /// The solution of the two normal equations of |p - a - s u - t v|^2, if it is unique and inside.
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
  Nearest n(r);
  n.offer_segment(a, b);
  return yes(n.best);
}

Reference reference_triangle_perimeter(Reader r) {
  const V a = r.vector(), b = r.vector(), c = r.vector();
  Nearest n(r);
  n.offer_segment(a, b);
  n.offer_segment(b, c);
  n.offer_segment(c, a);
  return yes(n.best);
}

Reference reference_triangle_perimeter_edges(Reader r) {
  const V a = r.vector(), b = r.vector(), c = r.vector();
  Nearest n(r);
  n.offer_segment(a, b, 0);
  n.offer_segment(b, c, 1);
  n.offer_segment(c, a, 2);
  return yes(n.best, double(n.label));
}

Reference reference_rectangle(Reader r) {
  const V a = r.vector(), b = r.vector(), c = r.vector(), d = r.vector();
  Nearest n(r);
  n.offer_triangle(a, b, c);
  n.offer_triangle(a, c, d);
  return yes(n.best);
}

Reference reference_rectangle_perimeter(Reader r) {
  const std::array<V, 4> v{r.vector(), r.vector(), r.vector(), r.vector()};
  Nearest n(r);
  for (int i = 0; i < 4; ++i) n.offer_segment(v[i], v[(i + 1) % 4]);
  return yes(n.best);
}

/// (p2 + t d2 - p1 - s d1) perpendicular to both directions.
Reference reference_lines(Reader r) {
  const V p1 = r.vector(), d1 = r.vector(), p2 = r.vector(), d2 = r.vector();
  const V w = sub(p2, p1);
  const Q a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2);
  Q s = 0, t = -dot(w, d2) / c;
  if (const Q d = a * c - b * b; d != 0) {
    s = (dot(w, d1) * c - dot(w, d2) * b) / d;
    t = (dot(w, d1) * b - dot(w, d2) * a) / d;
  }
  return yes(add(p1, d1, s), add(p2, d2, t));
}

/// The bounds of all weights of the corners that give p in the two coordinates other than `axis`; empty if there are no
/// such weights.
std::vector<V> weights(const std::array<V, 3>& v, int axis, const V& p) {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  const V u = sub(v[1], v[0]), w = sub(v[2], v[0]), x = sub(p, v[0]);
  if (const Q d = u[j] * w[k] - u[k] * w[j]; d != 0) {
    const Q s = (x[j] * w[k] - x[k] * w[j]) / d, t = (u[j] * x[k] - u[k] * x[j]) / d;
    if (s < 0 || t < 0 || s + t > 1) return {};
    return {{Q(1 - s - t), s, t}};
  }
  std::vector<V> all;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const V along = sub(v[b], v[a]), from = sub(p, v[a]);
      const int at = along[j] != 0 ? j : k;
      const Q share = along[at] != 0 ? Q(from[at] / along[at]) : Q(0);
      if (share < 0 || share > 1 || along[j] * share != from[j] || along[k] * share != from[k]) continue;
      V found{0, 0, 0};
      found[a] = 1 - share;
      found[b] += share;
      all.push_back(found);
    }
  }
  return all;
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
  const std::vector<V> w = weights(v, axis < 0 ? axis_of(normal) : axis, p);
  return w.empty() ? no() : yes(r.choose.between(w));
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
  Nearest n(r);
  const Q radius = r.number();
  const V a = r.vector(), b = r.vector(), c = r.vector();
  n.offer_triangle(a, b, c);
  return {distance2(n.best, n.p) <= radius * radius, {}};
}

/// Clips the triangle to the six half-spaces of the box and tests whether anything is left.
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

/// Depth, normal and contact. If concentric, every direction is a normal.
Reference reference_sphere_sphere_penetration(Reader r) {
  const V a = r.vector();
  const Q ra = r.number();
  const V b = r.vector();
  const Q rb = r.number(), d2 = distance2(a, b);
  Reference reference{d2 <= (ra + rb) * (ra + rb), {}};
  reference.give(R(real(ra + rb) - sqrt(real(d2))));
  if (!reference.yes || (d2 == 0 && !r.choose.is_free())) return reference;
  const V n = d2 == 0 ? r.choose.direction() : sub(b, a);
  reference.give_unit(n);
  for (int k = 0; k < 3; ++k) reference.give(R(real(a[k]) + real(n[k] * ra) / length(n)));
  return reference;
}

Reference reference_sphere_plane_penetration(Reader r) {
  const V c = r.vector();
  const Q radius = r.number();
  const V n = r.vector();
  const Q s = dot(n, c) + r.number();
  Reference reference{s <= 0 || s * s <= radius * radius * square_of(n), {}};
  reference.give(R(real(radius) - real(s) / length(n)));
  if (!reference.yes) return reference;
  reference.give_unit(n);
  for (int k = 0; k < 3; ++k) reference.give(R(real(c[k]) - real(n[k] * radius) / length(n)));
  return reference;
}

/// Depth, normal and every corner.
Reference reference_box_plane_penetration(Reader r) {
  const RefBox box(r);
  const V n = r.vector();
  const Q offset = r.number();
  std::array<V, 8> corner;
  std::array<Q, 8> depth;
  for (int i = 0; i < 8; ++i) {
    corner[i] = box.center;
    for (int k = 0; k < 3; ++k)
      corner[i] = add(corner[i], box.axes[k], (i >> k) % 2 == 1 ? box.half[k] : Q(-box.half[k]));
    depth[i] = -dot(n, corner[i]) - offset;
  }
  const Q deepest = *std::max_element(depth.begin(), depth.end());
  Reference reference{deepest >= 0, {}};
  reference.give(over_root(deepest, square_of(n)));
  if (!reference.yes) return reference;
  reference.give_unit(n);
  for (int i = 0; i < 8; ++i) {
    reference.give(double(depth[i] >= 0));
    reference.give(depth[i] >= 0 ? corner[i] : V{0, 0, 0});
  }
  return reference;
}

/// Depth, negative if apart. Outside the box the normal points to the nearest point, which is the contact. Inside, the
/// normal is the inward normal of the nearest face, and the contact is the sphere's deepest point. On the surface both
/// are right.
Reference reference_sphere_box_penetration(Reader r) {
  const V p = r.vector();
  const Q radius = r.number();
  const RefBox box(r);
  const V s = box.local(sub(p, box.center));
  V out;
  Q inside = box.half[0] - abs(s[0]);
  for (int i = 0; i < 3; ++i) {
    out[i] = excess(s[i], box.half[i]);
    inside = std::min(inside, Q(box.half[i] - abs(s[i])));
  }
  const Q distance2 = square_of(out);
  Reference reference{distance2 <= radius * radius, {}};
  if (distance2 > 0) {
    reference.give(R(real(radius) - sqrt(real(distance2))));
    if (!reference.yes) return reference;
    reference.give_unit(box.world(scaled(out, -1)));
    reference.give(add(box.center, box.world(sub(s, out))));
    return reference;
  }
  reference.give(Q(radius + inside));
  std::vector<V> faces;  // inward normals
  for (int i = 0; i < 3; ++i) {
    for (const int side : {1, -1}) {
      if (box.half[i] - side * s[i] == inside) faces.push_back(scaled(box.axes[i], -side));
    }
  }
  if (faces.size() > 1 && !r.choose.is_free()) return reference;
  const V normal = r.choose.among(faces);
  reference.give(normal);
  reference.give(inside == 0 && r.choose.below(2) == 1 ? p : add(p, normal, radius));
  return reference;
}

/// The foot of the perpendicular, or the nearer end; ends are compared by their distances.
Reference reference_closest_point_segment(Reader r) {
  const V a = r.vector(), b = r.vector(), p = r.vector();
  const V d = sub(b, a);
  const Q length2 = square_of(d);
  V best = distance2(a, p) <= distance2(b, p) ? a : b;
  if (length2 != 0) {
    const Q t = dot(sub(p, a), d) / length2;
    const V foot = add(a, d, t);
    if (t > 0 && t < 1 && distance2(foot, p) < distance2(best, p)) best = foot;
  }
  return yes(best);
}

/// x / |v|, component by component.
Reference over_length(const V& x, const V& v) {
  Reference reference = yes();
  for (const Q& c : x) reference.give(over_root(c, square_of(v)));
  return reference;
}

/// The velocity with its component along u reversed: v - 2 (v . u) u / |u|^2, over |v|.
Reference reference_bounce_direction(Reader r) {
  const V center = r.vector();
  r.number();  // the radius has no effect
  const V v = r.vector();
  const Q time = r.number();
  const V location = r.vector(), normal = r.vector();
  V u = sub(add(center, v, time), location);
  if (u == V{0, 0, 0}) u = normal;
  if (square_of(v) == 0) return yes(v);
  return over_length(add(v, u, -2 * dot(v, u) / square_of(u)), v);
}

/// The velocity minus its component along u: v - (v . u) u / |u|^2, over |v|.
Reference reference_slide_direction(Reader r) {
  const V center = r.vector();
  r.number();  // the radius has no effect
  const V v = r.vector();
  const Q time = r.number();
  const V u = sub(add(center, v, time), r.vector());
  if (square_of(v) == 0) return yes(v);
  return over_length(square_of(u) == 0 ? v : add(v, u, -dot(v, u) / square_of(u)), v);
}

}  // namespace

std::span<const Derived> of_shapes() {
  static constexpr Derived all[] = {{"closest_point_segment_unit", &reference_closest_point_segment_unit},
                                    {"closest_point_triangle_perimeter", &reference_triangle_perimeter},
                                    {"closest_point_triangle_perimeter_edges", &reference_triangle_perimeter_edges},
                                    {"closest_point_rectangle", &reference_rectangle},
                                    {"closest_point_rectangle_perimeter", &reference_rectangle_perimeter},
                                    {"closest_points_lines", &reference_lines},
                                    {"point_in_triangle", &reference_point_in_triangle},
                                    {"point_in_rectangle", &reference_point_in_rectangle},
                                    {"sphere_sphere_overlap", &reference_sphere_sphere_overlap},
                                    {"sphere_box_overlap", &reference_sphere_box_overlap},
                                    {"sphere_triangle_overlap", &reference_sphere_triangle_overlap},
                                    {"aabox_triangle_overlap", &reference_aabox_triangle_overlap},
                                    {"sphere_sphere_penetration", &reference_sphere_sphere_penetration},
                                    {"sphere_plane_penetration", &reference_sphere_plane_penetration},
                                    {"box_plane_penetration", &reference_box_plane_penetration},
                                    {"slide_direction", &reference_slide_direction},
                                    {"sphere_box_penetration", &reference_sphere_box_penetration},
                                    {"closest_point_segment", &reference_closest_point_segment},
                                    {"bounce_direction", &reference_bounce_direction}};
  return all;
}

}  // namespace nearmiss::derived
