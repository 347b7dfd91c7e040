/// Derivations for spheres that move past triangles, rectangles and boxes. The motion is cut wherever the nearest
/// feature may change; on each piece the quadratic of the feature nearest at its middle applies.
#include "properties/derivation.hpp"

namespace nearmiss::derived {
namespace {

/// The nearest point of a triangle, with its weights and the directions in which the feature extends. The distance
/// counts only perpendicular to these: none for a vertex, one for an edge, two for the face.
struct Nearest {
  V point, weights;
  std::vector<V> within;  ///< orthogonal directions in which the feature extends
};

Nearest nearest_of(const std::array<V, 3>& c, const V& p) {
  const V a = sub(c[1], c[0]), b = sub(c[2], c[0]), n = cross(a, b);
  Nearest best{c[0], {1, 0, 0}, {}};
  const auto consider = [&](const V& weights, const std::vector<V>& within) {
    V x{0, 0, 0};
    for (int i = 0; i < 3; ++i) x = add(x, c[i], weights[i]);
    if (square_of(sub(x, p)) < square_of(sub(best.point, p))) best = {x, weights, within};
  };
  for (int i = 0; i < 3; ++i) {
    V weights{0, 0, 0};
    weights[i] = 1;
    consider(weights, {});
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const V e = sub(c[j], c[i]);
    if (square_of(e) == 0) continue;
    const Q t = dot(sub(p, c[i]), e) / square_of(e);
    if (t <= 0 || t >= 1) continue;
    V weights{0, 0, 0};
    weights[i] = 1 - t, weights[j] = t;
    consider(weights, {e});
  }
  if (square_of(n) != 0) {
    // The foot by Cramer's rule for the equations of the two edges.
    const V w = sub(p, c[0]);
    const Q aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = aa * bb - ab * ab;
    const Q s = (dot(w, a) * bb - dot(w, b) * ab) / det, t = (dot(w, b) * aa - dot(w, a) * ab) / det;
    if (s > 0 && t > 0 && s + t < 1) consider({1 - s - t, s, t}, {a, add(b, a, -ab / aa)});
  }
  return best;
}

struct Hit {
  bool yes = false;
  R time{0};
  std::optional<Q> rational{};  ///< the time, if it is rational
  V before{};                   ///< a center on the same piece, to determine the feature

  static Hit at(const Q& time, const V& before) { return {true, real(time), time, before}; }
};

/// The component of x perpendicular to the directions.
V across(V x, const std::vector<V>& directions) {
  for (const V& d : directions) x = add(x, d, -dot(x, d) / square_of(d));
  return x;
}

/// The first contact by the general rule, after the gate.
Hit first_hit(const V& p, const Q& r, const V& v, const std::array<V, 3>& c) {
  const V n = cross(sub(c[1], c[0]), sub(c[2], c[0]));
  const Q height = dot(n, sub(p, c[0]));
  if (dot(n, v) > 0 || (height < 0 && height * height > r * r * square_of(n))) return {};
  const Nearest start = nearest_of(c, p);
  const V away = sub(p, start.point);
  const Q outside = square_of(away) - r * r;
  const Hit now = Hit::at(0, p);
  if (outside < 0) return now;
  if (outside == 0) return dot(away, v) <= 0 ? now : Hit{};
  // The nearest feature changes only where the center crosses one of these planes: the planes through the edges along
  // n, the planes through the corners perpendicular to the edges and, for the side that is hit, the triangle's own.
  std::vector<Q> cuts{0};
  const auto cut = [&](const V& normal, const V& on) {
    if (dot(normal, v) == 0) return;
    const Q t = dot(normal, sub(on, p)) / dot(normal, v);
    if (t > 0) cuts.push_back(t);
  };
  for (int i = 0; i < 3; ++i) {
    const V e = sub(c[(i + 1) % 3], c[i]);
    cut(e, c[i]), cut(e, c[(i + 1) % 3]), cut(cross(e, n), c[i]);
  }
  cut(n, c[0]);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const bool last = k + 1 == cuts.size();
    const Q from = cuts[k], middle = last ? Q(from + 1) : Q((from + cuts[k + 1]) / 2);
    const Nearest feature = nearest_of(c, add(p, v, middle));
    const V w = across(sub(p, feature.point), feature.within), u = across(v, feature.within);
    const Q qa = square_of(u), qb = dot(u, w), qc = square_of(w) - r * r, d = qb * qb - qa * qc;
    const V before = add(p, v, middle);
    if (qa == 0) {
      if (qc > 0) continue;
      return Hit::at(from, before);
    }
    if (d < 0) continue;
    const auto root_beyond = [&](const Q& t) {
      const Q x = -qb - qa * t;
      return x >= 0 ? cmp(Q(x * x), d) : -1;
    };
    if (root_beyond(from) < 0 || (!last && root_beyond(cuts[k + 1]) > 0)) continue;
    if (d == 0) return Hit::at(-qb / qa, before);
    return {true, root_of(qa, qb, d), {}, before};
  }
  return {};
}

/// The weights of a place on a triangle with area: (n x the opposite edge) . (place - its start) over n^2.
VR weights_of(const VR& place, const std::array<V, 3>& c, const V& n) {
  VR weights;
  for (int i = 0; i < 3; ++i) {
    const V& start = c[(i + 1) % 3];
    const V in = cross(n, sub(c[(i + 2) % 3], start));
    weights[i] = 0;
    for (int k = 0; k < 3; ++k) weights[i] += real(in[k]) * (place[k] - real(start[k]));
    weights[i] /= real(square_of(n));
  }
  return weights;
}

/// Time, location, normal. For a center on the triangle, any normal of the cone against the motion.
struct Contact {
  Reference reference;
  VR location;
};
Contact contact_of(const Hit& hit, const V& p, const Q& radius, const V& v, const std::array<V, 3>& c,
                   const Choice& choose) {
  if (hit.rational) {
    const V center = add(p, v, *hit.rational);
    const Nearest nearest = nearest_of(c, center);
    if (radius == 0 || nearest.point == center) {
      Contact contact{yes(*hit.rational, nearest.point), real(nearest.point)};
      std::vector<V> against{v};
      for (const V& corner : c) against.push_back(sub(corner, nearest.point));
      if (const auto normal = choose.in_cone(nearest.within, against)) contact.reference.give_unit(*normal);
      return contact;
    }
  }
  // The feature's nearest point moves with the center: it is linear in time, so two times determine it.
  const Nearest feature = nearest_of(c, hit.before);
  const V rate = sub(v, across(v, feature.within)), from = sub(p, across(sub(p, feature.point), feature.within));
  VR location, away;
  R distance2(0);
  for (int k = 0; k < 3; ++k) {
    location[k] = real(from[k]) + hit.time * real(rate[k]);
    away[k] = real(p[k]) + hit.time * real(v[k]) - location[k];
    distance2 += away[k] * away[k];
  }
  const R distance = sqrt(distance2);
  for (R& x : away) x /= distance;
  return {yes(hit.time, location, away), location};
}

constexpr std::size_t with_normal = 7;

/// Time, location, normal and, for a triangle with area, weights.
Reference reference_moving_sphere_triangle(Reader r) {
  const V p = r.vector();
  const Q radius = r.number();
  const V v = r.vector();
  const std::array<V, 3> c{r.vector(), r.vector(), r.vector()};
  const Hit hit = first_hit(p, radius, v, c);
  if (!hit.yes) return no();
  Contact contact = contact_of(hit, p, radius, v, c, r.choose);
  const V n = cross(sub(c[1], c[0]), sub(c[2], c[0]));
  if (contact.reference.values.size() == with_normal && square_of(n) != 0) {
    contact.reference.give(weights_of(contact.location, c, n));
  }
  return contact.reference;
}

/// The earlier time of the two triangles; if equal, either.
Reference reference_moving_sphere_rectangle(Reader r) {
  const V p = r.vector();
  const Q radius = r.number();
  const V v = r.vector();
  const std::array<V, 4> c{r.vector(), r.vector(), r.vector(), r.vector()};
  const std::array<V, 3> triangle1{c[0], c[1], c[2]}, triangle2{c[0], c[2], c[3]};
  const Hit one = first_hit(p, radius, v, triangle1), two = first_hit(p, radius, v, triangle2);
  if (!one.yes && !two.yes) return no();
  const R between = one.yes && two.yes ? R(one.time - two.time) : R(one.yes ? -1 : 1);
  const bool tie = is_zero(R(between / (1 + one.time)));
  const bool first = tie ? r.choose.below(2) == 0 : between < 0;
  if (tie && !r.choose.is_free()) return yes(one.time);
  return first ? contact_of(one, p, radius, v, triangle1, r.choose).reference
               : contact_of(two, p, radius, v, triangle2, r.choose).reference;
}

/// The least distance of each piece between the crossings of the face planes.
Reference reference_moving_sphere_passes_box(Reader r) {
  const V p = r.vector();
  const Q radius = r.number();
  const V v = r.vector();
  const RefBox box(r);
  const Q limit = r.number();
  const bool forever = r.number() != 0;
  const V s = box.local(sub(p, box.center)), w = box.local(v);
  std::vector<Q> ends{0};
  for (int i = 0; i < 3; ++i) {
    if (w[i] == 0) continue;
    for (const int side : {-1, 1}) {
      if (const Q t = (side * box.half[i] - s[i]) / w[i]; t > 0 && (forever || t < limit)) ends.push_back(t);
    }
  }
  std::sort(ends.begin(), ends.end());
  if (!forever) ends.push_back(limit);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const bool last = k + 1 == ends.size();
    if (last && !forever && k > 0) break;
    const Q from = ends[k], to = last ? from : ends[k + 1], middle = last ? Q(from + 1) : Q((from + to) / 2);
    Q a = 0, b = 0, c = -radius * radius;
    for (int i = 0; i < 3; ++i) {
      const Q x = s[i] + w[i] * middle;
      if (abs(x) <= box.half[i]) continue;
      const Q e = x > 0 ? Q(s[i] - box.half[i]) : Q(s[i] + box.half[i]);
      a += w[i] * w[i], b += w[i] * e, c += e * e;
    }
    Q t = a == 0 ? from : Q(-b / a);
    if (t < from) t = from;
    if (t > to && !(last && forever)) t = to;
    if (a * t * t + 2 * b * t + c <= 0) return yes();
  }
  return no();
}

}  // namespace

std::span<const Derived> of_moving_spheres() {
  static constexpr Derived all[] = {{"moving_sphere_triangle", &reference_moving_sphere_triangle},
                                    {"moving_sphere_rectangle", &reference_moving_sphere_rectangle},
                                    {"moving_sphere_passes_box", &reference_moving_sphere_passes_box}};
  return all;
}

}  // namespace nearmiss::derived
