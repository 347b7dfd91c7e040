/// Derivations of the queries about moving points, and of moving spheres that are points beside something
/// larger: candidate times, tried one after the other, and pieces of the motion.
#include "properties/lattice.hpp"

#include <optional>

namespace nearmiss::lattice {
namespace {

V at(const V& p, const V& v, const Q& t) { return {p[0] + v[0] * t, p[1] + v[1] * t, p[2] + v[2] * t}; }
mpf_class real(const Q& x) { return mpf_class(x, 512); }
mpf_class length(const V& x) { return sqrt(real(dot(x, x))); }
/// Rounded; what 512 bits leave of a zero is zero.
double rounded(const mpf_class& x) { return abs(x) < 1e-100 ? 0.0 : x.get_d(); }
double quotient(const Q& a, const mpf_class& b) { return rounded(real(a) / b); }

/// Time, place, and n as a unit vector.
Reference hit(const Q& t, const V& x, const V& n) {
  const mpf_class l = length(n);
  return yes(t.get_d(), x[0].get_d(), x[1].get_d(), x[2].get_d(), quotient(n[0], l), quotient(n[1], l), quotient(n[2], l));
}

/// The parameter at which the heights at times 0 and 1 interpolate to zero.
Reference reference_moving_point_plane(Reader r) {
  const V p = r.vector(), v = r.vector(), n = r.vector();
  const Q d = r.number();
  const Q now = dot(n, p) + d, later = dot(n, at(p, v, 1)) + d;
  if (now < 0 || later >= now) return no();
  const Q t = now / (now - later);
  return hit(t, at(p, v, t), n);
}

/// Cramer's rule for p + v t = v0 + x (v1 - v0) + y (v2 - v0); the time, empty for a miss.
std::optional<Q> time_at_front(const V& p, const V& v, const V& v0, const V& v1, const V& v2) {
  const V e1 = sub(v1, v0), e2 = sub(v2, v0), s = sub(p, v0);
  const Q volume = -dot(v, cross(e1, e2));
  if (volume <= 0) return std::nullopt;
  const Q t = dot(s, cross(e1, e2)) / volume;
  const Q x = -dot(v, cross(s, e2)) / volume, y = -dot(v, cross(e1, s)) / volume;
  if (t < 0 || x < 0 || y < 0 || x + y > 1) return std::nullopt;
  return t;
}

Reference reference_moving_point_triangle_prepared(Reader r) {
  const V p = r.vector(), v = r.vector(), v0 = r.vector(), v1 = r.vector(), v2 = r.vector();
  const std::optional<Q> t = time_at_front(p, v, v0, v1, v2);
  return t ? hit(*t, at(p, v, *t), cross(sub(v1, v0), sub(v2, v0))) : no();
}

Reference reference_moving_point_rectangle(Reader r) {
  const V p = r.vector(), v = r.vector(), v0 = r.vector(), v1 = r.vector(), v2 = r.vector(), v3 = r.vector();
  const std::optional<Q> first = time_at_front(p, v, v0, v1, v2), second = time_at_front(p, v, v0, v2, v3);
  if (!first && !second) return no();
  const bool use_first = first && (!second || *first <= *second);
  const Q t = use_first ? *first : *second;
  return hit(t, at(p, v, t), use_first ? cross(sub(v1, v0), sub(v2, v0)) : cross(sub(v2, v0), sub(v3, v0)));
}

/// The first t >= 0 at which the point is in [low, high]: 0 or a crossing of a face plane.
std::optional<Q> time_in_box(const V& p, const V& v, const V& low, const V& high) {
  std::vector<Q> times{0};
  for (int i = 0; i < 3; ++i) {
    for (const Q& plane : {low[i], high[i]}) {
      if (v[i] != 0 && (plane - p[i]) / v[i] > 0) times.push_back((plane - p[i]) / v[i]);
    }
  }
  std::sort(times.begin(), times.end());
  for (const Q& t : times) {
    const V x = at(p, v, t);
    bool in = true;
    for (int i = 0; i < 3; ++i) in = in && low[i] <= x[i] && x[i] <= high[i];
    if (in) return t;
  }
  return std::nullopt;
}

Reference reference_moving_point_aabox(Reader r) {
  const V p = r.vector(), v = r.vector(), low = r.vector(), high = r.vector();
  const std::optional<Q> t = time_in_box(p, v, low, high);
  if (!t) return {false, {0}};
  if (*t == 0) return {false, {1, p[0].get_d(), p[1].get_d(), p[2].get_d()}};
  const V x = at(p, v, *t);
  for (int i = 0; i < 3; ++i) {  // a face through which the point enters
    const double side = p[i] < low[i] && x[i] == low[i] ? -1 : p[i] > high[i] && x[i] == high[i] ? 1 : 0;
    if (side == 0) continue;
    std::vector<double> values{0, x[0].get_d(), x[1].get_d(), x[2].get_d(), t->get_d(), 0, 0, 0};
    values[5 + std::size_t(i)] = side;
    return {true, values};
  }
  return no();
}

Reference reference_ray_aabox(Reader r) {
  const V p = r.vector(), v = r.vector(), low = r.vector(), high = r.vector();
  const std::optional<Q> t = time_in_box(p, v, low, high);
  if (!t) return {false, {0}};
  const V x = at(p, v, *t);
  return yes(*t == 0 ? 1.0 : 0.0, x[0].get_d(), x[1].get_d(), x[2].get_d());
}

Reference reference_moving_point_box(Reader r) {
  const V p = r.vector(), v = r.vector();
  const RefBox box(r);
  const V s = box.local(sub(p, box.center)), w = box.local(v);
  const std::optional<Q> t = time_in_box(s, w, {-box.half[0], -box.half[1], -box.half[2]}, box.half);
  if (!t) return no();
  if (*t == 0) {  // on the surface, and a moment later not away from one of its planes
    bool stays = false;
    for (int i = 0; i < 3; ++i) stays = stays || (abs(s[i]) == box.half[i] && (box.half[i] == 0 || s[i] * w[i] <= 0));
    if (!stays) return no();
  }
  const V x = at(p, v, *t);
  return yes(t->get_d(), x[0].get_d(), x[1].get_d(), x[2].get_d());
}

/// The part of x - a beyond the segment from a along d, at a right angle to it or from an end.
V from_segment(const V& x, const V& a, const V& d) {
  const V m = sub(x, a);
  const Q dd = dot(d, d);
  const Q s = dd == 0 ? Q(0) : std::clamp(Q(dot(m, d) / dd), Q(0), Q(1));
  return {m[0] - d[0] * s, m[1] - d[1] * s, m[2] - d[2] * s};
}

/// Time, and where `away` leads from the axis to the center, the place and normal of a contact.
Reference round_contact(const mpf_class& t, const std::array<mpf_class, 3>& center,
                        const std::array<mpf_class, 3>& away, const Q& radius) {
  Reference reference = yes(rounded(t));
  const mpf_class l = sqrt(mpf_class(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]));
  if (l < 1e-100) return reference;
  for (int i = 0; i < 3; ++i) {
    reference.values.push_back(rounded(center[i] - away[i] + away[i] * real(radius) / l));
  }
  for (int i = 0; i < 3; ++i) reference.values.push_back(rounded(away[i] / l));
  return reference;
}
std::array<mpf_class, 3> real(const V& x) { return {real(x[0]), real(x[1]), real(x[2])}; }

/// A ball of radius `own` against all points within `radius` of the segment: the squared distance is one
/// quadratic before the motion passes an end, one between them, one after.
Reference time_past_capsule(const V& p, const Q& own, const V& v, const V& p0, const V& p1, const Q& radius) {
  const V d = sub(p1, p0);
  const Q reach = own + radius, vd = dot(v, d);
  const V away = from_segment(p, p0, d);
  const Q outside = dot(away, away) - reach * reach;
  if (outside < 0 ? own == 0 : outside == 0 && dot(away, v) > 0) return no();
  if (outside <= 0) return round_contact(0, real(p), real(away), radius);
  std::vector<Q> bends{0};
  if (vd != 0) {
    for (const V& end : {p0, p1}) {
      if (const Q t = dot(sub(end, p), d) / vd; t > 0) bends.push_back(t);
    }
  }
  std::sort(bends.begin(), bends.end());
  bends.erase(std::unique(bends.begin(), bends.end()), bends.end());
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const bool last = k + 1 == bends.size();
    const Q from = bends[k], middle = last ? Q(from + 1) : Q((from + bends[k + 1]) / 2);
    // The distance vector is linear on the piece: known from two of its values.
    const V e0 = from_segment(at(p, v, from), p0, d), em = from_segment(at(p, v, middle), p0, d);
    V step;
    for (int i = 0; i < 3; ++i) step[i] = (em[i] - e0[i]) / (middle - from);
    const Q a = dot(step, step), b = dot(e0, step), c = dot(e0, e0) - reach * reach;
    if (c == 0) return round_contact(real(from), real(at(p, v, from)), real(e0), radius);
    if (a == 0 || b >= 0) continue;
    const Q disc = b * b - a * c;
    if (disc < 0) continue;
    if (!last) {  // the root lies on this piece: (-b - a t)^2 <= disc on the falling branch, or beyond it
      const Q x = -b - a * (bends[k + 1] - from);
      if (x > 0 && x * x > disc) continue;
    }
    const mpf_class later = (real(-b) - sqrt(real(disc))) / real(a), t = real(from) + later;
    std::array<mpf_class, 3> center = real(p), apart = real(e0);
    for (int i = 0; i < 3; ++i) center[i] += real(v[i]) * t, apart[i] += real(step[i]) * later;
    return round_contact(t, center, apart, radius);
  }
  return no();
}

Reference reference_moving_point_capsule(Reader r) {
  const V p = r.vector(), v = r.vector(), p0 = r.vector(), p1 = r.vector();
  return time_past_capsule(p, 0, v, p0, p1, r.number());
}

Reference reference_moving_sphere_capsule(Reader r) {
  const V p = r.vector();
  const Q own = r.number();
  const V v = r.vector(), p0 = r.vector(), p1 = r.vector();
  return time_past_capsule(p, own, v, p0, p1, r.number());
}

Reference reference_moving_sphere_sphere(Reader r) {
  const V p = r.vector();
  const Q own = r.number();
  const V v = r.vector(), center = r.vector();
  return time_past_capsule(p, own, v, center, center, r.number());
}

/// Heights times |n|: h against r |n| by squares.
Reference reference_moving_sphere_plane(Reader r) {
  const V c = r.vector();
  const Q radius = r.number();
  const V v = r.vector(), n = r.vector();
  const Q d = r.number();
  const Q h = dot(n, c) + d, speed = dot(n, v), nn = dot(n, n), reach2 = radius * radius * nn;
  if (speed > 0 || (h < 0 && h * h > reach2)) return no();
  if (h * h <= reach2) {
    const V foot = at(c, n, -h / nn);
    return yes(0.0, foot[0].get_d(), foot[1].get_d(), foot[2].get_d());
  }
  if (speed == 0) return no();
  const mpf_class t = (real(h) - sqrt(real(reach2))) / real(-speed);
  Reference reference = yes(t.get_d());
  for (int i = 0; i < 3; ++i) {
    reference.values.push_back(rounded(real(c[i]) + real(v[i]) * t - real(n[i]) * real(radius) / length(n)));
  }
  for (int i = 0; i < 3; ++i) reference.values.push_back(quotient(n[i], length(n)));
  return reference;
}

/// The least distance of the centers up to the limit.
Reference reference_moving_sphere_passes_sphere(Reader r) {
  const V p = r.vector();
  const Q own = r.number();
  const V v = r.vector(), center = r.vector();
  const Q reach = own + r.number(), limit = r.number();
  const bool forever = r.number() != 0;
  Q t = dot(v, v) == 0 ? Q(0) : Q(dot(sub(center, p), v) / dot(v, v));
  if (!forever && t > limit) t = limit;
  if (t < 0) t = 0;
  const V m = sub(at(p, v, t), center);
  return {dot(m, m) <= reach * reach, {}};
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(
    MovingPoint, OracleOnLattice,
    testing::Values(std::tuple{"moving_point_plane", &reference_moving_point_plane},
                    std::tuple{"moving_point_triangle_prepared", &reference_moving_point_triangle_prepared},
                    std::tuple{"moving_point_rectangle", &reference_moving_point_rectangle},
                    std::tuple{"moving_point_capsule", &reference_moving_point_capsule},
                    std::tuple{"moving_point_aabox", &reference_moving_point_aabox},
                    std::tuple{"ray_aabox", &reference_ray_aabox},
                    std::tuple{"moving_point_box", &reference_moving_point_box},
                    std::tuple{"moving_sphere_plane", &reference_moving_sphere_plane},
                    std::tuple{"moving_sphere_sphere", &reference_moving_sphere_sphere},
                    std::tuple{"moving_sphere_capsule", &reference_moving_sphere_capsule},
                    std::tuple{"moving_sphere_passes_sphere", &reference_moving_sphere_passes_sphere}),
    [](const auto& test) { return std::string(std::get<0>(test.param)); });

}  // namespace nearmiss::lattice
