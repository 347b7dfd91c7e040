/// Derivations of the queries about moving points, and about moving spheres that act as points beside something larger:
/// candidate times, tried one after the other, and pieces of the motion.
#include "properties/derivation.hpp"

namespace nearmiss::derived {
namespace {

/// A hit: time, place, and n normalised.
Reference hit(const Q& t, const V& x, const V& n) {
  Reference reference = yes(t, x);
  reference.give_unit(n);
  return reference;
}
/// The same with a normal from a cone; without a normal if none was drawn.
Reference hit(const Q& t, const V& x, const std::optional<V>& n) { return n ? hit(t, x, *n) : yes(t, x); }

/// The parameter at which the linear interpolation of the heights at times 0 and 1 is zero.
Reference reference_moving_point_plane(Reader r) {
  const V p = r.vector(), v = r.vector(), n = r.vector();
  const Q d = r.number();
  const Q now = dot(n, p) + d, later = dot(n, add(p, v, 1)) + d;
  if (now < 0 || later >= now) return no();
  const Q t = now / (now - later);
  return hit(t, add(p, v, t), n);
}

/// The time by Cramer's rule for p + v t = v0 + x (v1 - v0) + y (v2 - v0); empty for a miss.
std::optional<Q> time_at_front(const V& p, const V& v, const V& v0, const V& v1, const V& v2) {
  const V e1 = sub(v1, v0), e2 = sub(v2, v0), s = sub(p, v0);
  const Q volume = -dot(v, cross(e1, e2));
  if (volume <= 0) return std::nullopt;
  const Q t = dot(s, cross(e1, e2)) / volume;
  const Q x = -dot(v, cross(s, e2)) / volume, y = -dot(v, cross(e1, s)) / volume;
  if (t < 0 || x < 0 || y < 0 || x + y > 1) return std::nullopt;
  return t;
}

/// Compares the hit point with the planes through the edges.
Reference reference_moving_point_triangle(Reader r) {
  const V p = r.vector(), v = r.vector();
  const std::array<V, 3> corner{r.vector(), r.vector(), r.vector()};
  const V n = cross(sub(corner[1], corner[0]), sub(corner[2], corner[0]));
  const Q toward = dot(n, v), height = dot(n, sub(p, corner[0]));
  if (toward >= 0 || height < 0) return no();
  const Q t = height / -toward;
  const V x = add(p, v, t);
  for (int i = 0; i < 3; ++i) {
    if (dot(n, cross(sub(corner[(i + 1) % 3], corner[i]), sub(x, corner[i]))) < 0) return no();
  }
  return hit(t, x, n);
}

Reference reference_moving_point_triangle_prepared(Reader r) {
  const V p = r.vector(), v = r.vector(), v0 = r.vector(), v1 = r.vector(), v2 = r.vector();
  const std::optional<Q> t = time_at_front(p, v, v0, v1, v2);
  return t ? hit(*t, add(p, v, *t), cross(sub(v1, v0), sub(v2, v0))) : no();
}

Reference reference_moving_point_rectangle(Reader r) {
  const V p = r.vector(), v = r.vector(), v0 = r.vector(), v1 = r.vector(), v2 = r.vector(), v3 = r.vector();
  const std::optional<Q> first = time_at_front(p, v, v0, v1, v2), second = time_at_front(p, v, v0, v2, v3);
  if (!first && !second) return no();
  const bool tie = first && second && *first == *second;
  const bool use_first = tie ? r.choose.below(2) == 0 : first && (!second || *first < *second);
  const Q t = use_first ? *first : *second;
  return hit(t, add(p, v, t), use_first ? cross(sub(v1, v0), sub(v2, v0)) : cross(sub(v2, v0), sub(v3, v0)));
}

/// Of the times 0 and those at which a face plane is crossed, the ones at which the point is in [low, high], in order:
/// the first one is the first of all times there.
std::vector<Q> times_in_box(const V& p, const V& v, const V& low, const V& high) {
  std::vector<Q> times{0};
  for (int i = 0; i < 3; ++i) {
    for (const Q& plane : {low[i], high[i]}) {
      if (v[i] != 0 && (plane - p[i]) / v[i] > 0) times.push_back((plane - p[i]) / v[i]);
    }
  }
  std::sort(times.begin(), times.end());
  std::erase_if(times, [&](const Q& t) {
    const V x = add(p, v, t);
    bool in = true;
    for (int i = 0; i < 3; ++i) in = in && low[i] <= x[i] && x[i] <= high[i];
    return !in;
  });
  return times;
}
std::optional<Q> time_in_box(const V& p, const V& v, const V& low, const V& high) {
  const std::vector<Q> times = times_in_box(p, v, low, high);
  return times.empty() ? std::nullopt : std::optional(times.front());
}

Reference span_in_box(const V& p, const V& v, const V& low, const V& high) {
  const std::vector<Q> times = times_in_box(p, v, low, high);
  if (times.empty()) return no();
  if (square_of(v) == 0) return yes(0.0, HUGE_VAL);
  return yes(times.front(), times.back());
}

Reference reference_moving_point_span_aabox(Reader r) {
  const V p = r.vector(), v = r.vector(), low = r.vector();
  return span_in_box(p, v, low, r.vector());
}

Reference reference_moving_point_span_box(Reader r) {
  const V p = r.vector(), v = r.vector();
  const RefBox box(r);
  return span_in_box(box.local(sub(p, box.center)), box.local(v), scaled(box.half, -1), box.half);
}

Reference reference_moving_point_aabox(Reader r) {
  const V p = r.vector(), v = r.vector(), low = r.vector(), high = r.vector();
  const std::optional<Q> t = time_in_box(p, v, low, high);
  Reference missed = no();
  missed.give(double(t && *t == 0));
  if (!t) return missed;
  if (*t == 0) return missed.give(p), missed;
  const V x = add(p, v, *t);
  std::vector<V> normals;  // of the faces through which the point enters or along which it moves at that time
  for (int i = 0; i < 3; ++i) {
    for (const int side : {-1, 1}) {
      V n{0, 0, 0};
      n[i] = side;
      if (x[i] == (side < 0 ? low : high)[i] && side * v[i] <= 0) normals.push_back(n);
    }
  }
  return yes(0.0, x, *t, r.choose.among(normals));
}

Reference reference_ray_aabox(Reader r) {
  const V p = r.vector(), v = r.vector(), low = r.vector(), high = r.vector();
  const std::optional<Q> t = time_in_box(p, v, low, high);
  if (!t) return {false, {0}};
  return yes(double(*t == 0), add(p, v, *t));
}

/// An outward direction for `local` on the box's surface that does not point along the motion.
std::optional<V> out_of(const RefBox& box, const V& local, const V& motion, const Choice& choose) {
  std::vector<V> along, against;
  bool may_lead_with_it = true;
  for (int i = 0; i < 3; ++i) {
    const int side = sgn(local[i]);
    const V out = scaled(box.axes[i], side);
    if (abs(local[i]) < box.half[i])
      along.push_back(box.axes[i]);
    else if (box.half[i] > 0)
      against.push_back(scaled(out, -1)), may_lead_with_it = may_lead_with_it && dot(out, motion) > 0;
    else
      may_lead_with_it = false;
  }
  if (!may_lead_with_it)
    against.push_back(motion);  // otherwise, for a sphere of positive radius, every normal may be drawn
  return choose.in_cone(along, against);
}

Reference point_meets_box(const V& p, const V& v, const RefBox& box, const Choice& choose) {
  const V s = box.local(sub(p, box.center)), w = box.local(v);
  const std::optional<Q> t = time_in_box(s, w, {-box.half[0], -box.half[1], -box.half[2]}, box.half);
  if (!t) return no();
  if (*t == 0) {  // on the surface, and shortly afterwards not away from one of its planes
    bool stays = false;
    for (int i = 0; i < 3; ++i) stays = stays || (abs(s[i]) == box.half[i] && (box.half[i] == 0 || s[i] * w[i] <= 0));
    if (!stays) return no();
  }
  return hit(*t, add(p, v, *t), out_of(box, add(s, w, *t), v, choose));
}

Reference reference_moving_point_box(Reader r) {
  const V p = r.vector(), v = r.vector();
  return point_meets_box(p, v, RefBox(r), r.choose);
}

/// A sphere that starts in contact with the box; `s` and `w` are in the box's frame.
Reference contact_at_start(const V& p, const V& v, const RefBox& box, const Choice& choose) {
  const V s = box.local(sub(p, box.center));
  V out;
  Q inside = box.half[0] - abs(s[0]);
  for (int i = 0; i < 3; ++i) out[i] = excess(s[i], box.half[i]), inside = std::min(inside, Q(box.half[i] - abs(s[i])));
  if (square_of(out) > 0) return hit(0, add(box.center, box.world(sub(s, out))), box.world(out));
  if (inside == 0) return hit(0, p, out_of(box, s, v, choose));
  std::vector<V> faces;
  for (int i = 0; i < 3; ++i) {
    for (const int side : {1, -1}) {
      if (box.half[i] - side * s[i] == inside) faces.push_back(scaled(box.axes[i], side));
    }
  }
  if (faces.size() > 1 && !choose.is_free()) return yes(0.0);
  const V normal = choose.among(faces);
  return hit(0, add(p, normal, inside), normal);
}

/// A sphere of positive radius on its way to a box, in the box's frame: the center at time t is start + velocity t.
struct SphereTowardBox {
  const RefBox& box;
  V start, velocity;
  Q radius;

  /// The contact at time t of a center that is then beyond these sides of the box.
  Reference contact(const R& t, const std::array<int, 3>& sides) const {
    VR on_box, away;
    for (int i = 0; i < 3; ++i) {
      const R x = real(start[i]) + real(velocity[i]) * t;
      on_box[i] = sides[i] == 0 ? x : real(sides[i] * box.half[i]);
      away[i] = R(x - on_box[i]) / real(radius);
    }
    VR place = box.world(on_box);
    for (int i = 0; i < 3; ++i) place[i] += real(box.center[i]);
    return yes(t, place, box.world(away));
  }

  /// 0 and the positive times at which the center crosses a face plane, in ascending order.
  std::vector<Q> crossings() const {
    std::vector<Q> times{0};
    for (int i = 0; i < 3; ++i) {
      if (velocity[i] == 0) continue;
      for (const int side : {-1, 1}) {
        if (const Q t = (side * box.half[i] - start[i]) / velocity[i]; t > 0) times.push_back(t);
      }
    }
    std::sort(times.begin(), times.end());
    return times;
  }

  /// The first contact between two successive crossings; `to` is empty after the last one.
  std::optional<Reference> contact_between(const Q& from, const std::optional<Q>& to) const {
    // 1. The nearest feature of the box at the middle, and the excess a t^2 + 2 b t + c of its squared distance.
    const Q middle = to ? Q((from + *to) / 2) : Q(from + 1);
    Q a = 0, b = 0, c = -radius * radius;
    std::array<int, 3> sides{0, 0, 0};
    for (int i = 0; i < 3; ++i) {
      const Q x = start[i] + velocity[i] * middle;
      if (abs(x) <= box.half[i]) continue;
      const Q e = x > 0 ? Q(start[i] - box.half[i]) : Q(start[i] + box.half[i]);
      sides[i] = sgn(x);
      a += velocity[i] * velocity[i], b += velocity[i] * e, c += e * e;
    }
    // 2. A constant distance.
    if (a == 0) return c <= 0 ? std::optional(contact(real(from), sides)) : std::nullopt;
    // 3. The earlier root, where it lies in [from, to]: (-b - a t)^2 against d while the distance decreases.
    const Q d = b * b - a * c;
    if (d < 0) return std::nullopt;
    const auto root_beyond = [&](const Q& t) {
      const Q x = -b - a * t;
      return x >= 0 ? cmp(Q(x * x), d) : -1;
    };
    if (root_beyond(from) < 0 || (to && root_beyond(*to) > 0)) return std::nullopt;
    return contact(root_of(a, b, d), sides);
  }
};

/// Time of impact, piece by piece between the crossings of the face planes.
Reference reference_moving_sphere_box(Reader r) {
  const V p = r.vector();
  const Q radius = r.number();
  const V v = r.vector();
  const RefBox box(r);
  if (radius == 0) return point_meets_box(p, v, box, r.choose);
  const SphereTowardBox motion{box, box.local(sub(p, box.center)), box.local(v), radius};
  Q outside = -radius * radius, slope = 0;
  for (int i = 0; i < 3; ++i) {
    const Q e = excess(motion.start[i], box.half[i]);
    outside += e * e;
    slope += e * motion.velocity[i];
  }
  if (outside < 0 || (outside == 0 && slope <= 0)) return contact_at_start(p, v, box, r.choose);
  if (outside == 0) return no();
  const std::vector<Q> crossings = motion.crossings();
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const std::optional<Q> to = k + 1 < crossings.size() ? std::optional(crossings[k + 1]) : std::nullopt;
    if (const std::optional<Reference> contact = motion.contact_between(crossings[k], to)) return *contact;
  }
  return no();
}

/// The component of x - a perpendicular to the segment from a along d, or the vector from the nearer end.
V from_segment(const V& x, const V& a, const V& d) {
  const V m = sub(x, a);
  const Q dd = square_of(d);
  return add(m, d, dd == 0 ? Q(0) : -std::clamp(Q(dot(m, d) / dd), Q(0), Q(1)));
}

/// A contact of a center at the vector `away` from the axis.
Reference round_contact(const R& t, const VR& center, const VR& away, const Q& radius) {
  const R l = sqrt(R(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]));
  VR normal, place;
  for (int i = 0; i < 3; ++i) normal[i] = away[i] / l, place[i] = center[i] - away[i] + normal[i] * real(radius);
  return yes(t, place, normal);
}

/// The set of points within `radius` of the segment from a along d.
struct Tube {
  V a, d;
  Q radius;
};

/// A contact of a center on the axis: the normal is perpendicular to the axis, or at an end points away from it.
Reference contact_on_axis(const Q& t, const V& center, const V& v, const Tube& tube, const Choice& choose) {
  std::vector<V> along, against;
  if (square_of(tube.d) > 0) {
    if (center == tube.a)
      against.push_back(tube.d);
    else if (center == add(tube.a, tube.d))
      against.push_back(scaled(tube.d, -1));
    else
      along.push_back(tube.d);
  }
  if (tube.radius == 0) against.push_back(v);
  const std::optional<V> normal = choose.in_cone(along, against);
  if (!normal) return yes(t);
  const R l = length(*normal);
  VR place;
  for (int i = 0; i < 3; ++i) place[i] = real(center[i]) + real(tube.radius * (*normal)[i]) / l;
  Reference reference = yes(t, place);
  reference.give_unit(*normal);
  return reference;
}

/// The times, from 0 on, at which the motion passes an end of the axis: between two of them, and after the last one,
/// the vector from the axis is linear.
std::vector<Q> bends_along(const V& p, const V& v, const Tube& tube) {
  std::vector<Q> bends{0};
  if (const Q vd = dot(v, tube.d); vd != 0) {
    for (const V& end : {tube.a, add(tube.a, tube.d)}) {
      if (const Q t = dot(sub(end, p), tube.d) / vd; t > 0) bends.push_back(t);
    }
  }
  std::sort(bends.begin(), bends.end());
  bends.erase(std::unique(bends.begin(), bends.end()), bends.end());
  return bends;
}

/// The first and the last time within the tube; each piece of the motion has a quadratic of its own.
Reference span_in_tube(const V& p, const V& v, const Tube& tube) {
  if (square_of(v) == 0) {
    const V away = from_segment(p, tube.a, tube.d);
    return square_of(away) <= tube.radius * tube.radius ? yes(0.0, HUGE_VAL) : no();
  }
  const std::vector<Q> bends = bends_along(p, v, tube);
  std::optional<R> enter, exit;
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const bool last = k + 1 == bends.size();
    const Q from = bends[k], to = last ? Q(from + 1) : bends[k + 1];
    const V e = from_segment(add(p, v, from), tube.a, tube.d);
    const V step = scaled(sub(from_segment(add(p, v, to), tube.a, tube.d), e), 1 / (to - from));
    const Q a = square_of(step), b = dot(e, step), c = square_of(e) - tube.radius * tube.radius, disc = b * b - a * c;
    const Q at_end = a * (to - from) * (to - from) + 2 * b * (to - from) + c;
    const bool ends_in = !last && at_end <= 0;
    const bool dips = a > 0 && disc >= 0 && b < 0 && (last || -b < a * (to - from));
    if (c > 0 && !ends_in && !dips) continue;
    const R first = c <= 0 ? real(from) : R(real(from) + root_of(a, b, disc));
    if (!enter) enter = first;
    exit = ends_in || a == 0 ? real(to) : R(real(from) + root_of(a, b, disc, +1));
  }
  return enter ? yes(*enter, *exit) : no();
}

Reference reference_moving_point_span_sphere(Reader r) {
  const V p = r.vector(), v = r.vector(), center = r.vector();
  return span_in_tube(p, v, {center, {0, 0, 0}, r.number()});
}

Reference reference_moving_point_span_capsule(Reader r) {
  const V p = r.vector(), v = r.vector(), p0 = r.vector(), p1 = r.vector();
  return span_in_tube(p, v, {p0, sub(p1, p0), r.number()});
}

/// A ball of radius `own` and the tube: the squared distance from the axis is one quadratic before the motion passes an
/// end, one between the ends, one after the other end.
Reference past_tube(const V& p, const Q& own, const V& v, const Tube& tube, const Choice& choose) {
  const V& d = tube.d;
  const Q reach = own + tube.radius;
  const auto contact = [&](const Q& t) {
    const V center = add(p, v, t), away = from_segment(center, tube.a, d);
    if (square_of(away) == 0) return contact_on_axis(t, center, v, tube, choose);
    return round_contact(real(t), real(center), real(away), tube.radius);
  };
  const V away = from_segment(p, tube.a, d);
  const Q outside = square_of(away) - reach * reach;
  if (outside < 0 ? own == 0 : outside == 0 && dot(away, v) > 0) return no();
  if (outside <= 0) return contact(0);
  const std::vector<Q> bends = bends_along(p, v, tube);
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const bool last = k + 1 == bends.size();
    const Q from = bends[k], middle = last ? Q(from + 1) : Q((from + bends[k + 1]) / 2);
    // The distance vector is linear on the piece, so two of its values determine it.
    const V e0 = from_segment(add(p, v, from), tube.a, d), em = from_segment(add(p, v, middle), tube.a, d);
    const V step = scaled(sub(em, e0), 1 / (middle - from));
    const Q a = square_of(step), b = dot(e0, step), c = square_of(e0) - reach * reach;
    if (c == 0) return contact(from);
    if (a == 0 || b >= 0) continue;
    const Q disc = b * b - a * c;
    if (disc < 0) continue;
    if (!last) {  // the root lies on this piece: (-b - a t)^2 <= disc while the distance decreases, or beyond it
      const Q x = -b - a * (bends[k + 1] - from);
      if (x > 0 && x * x > disc) continue;
    }
    if (disc == 0) return contact(from - b / a);
    const R later = root_of(a, b, disc), t = real(from) + later;
    VR center, apart;
    for (int i = 0; i < 3; ++i) center[i] = real(p[i]) + real(v[i]) * t, apart[i] = real(e0[i]) + real(step[i]) * later;
    return round_contact(t, center, apart, tube.radius);
  }
  return no();
}

Reference reference_moving_point_capsule(Reader r) {
  const V p = r.vector(), v = r.vector(), p0 = r.vector(), p1 = r.vector();
  return past_tube(p, 0, v, {p0, sub(p1, p0), r.number()}, r.choose);
}

Reference reference_moving_sphere_capsule(Reader r) {
  const V p = r.vector();
  const Q own = r.number();
  const V v = r.vector(), p0 = r.vector(), p1 = r.vector();
  return past_tube(p, own, v, {p0, sub(p1, p0), r.number()}, r.choose);
}

Reference reference_moving_sphere_sphere(Reader r) {
  const V p = r.vector();
  const Q own = r.number();
  const V v = r.vector(), center = r.vector();
  return past_tube(p, own, v, {center, {0, 0, 0}, r.number()}, r.choose);
}

/// Heights times |n|: compares h with r |n| by squares.
Reference reference_moving_sphere_plane(Reader r) {
  const V c = r.vector();
  const Q radius = r.number();
  const V v = r.vector(), n = r.vector();
  const Q d = r.number();
  const Q h = dot(n, c) + d, speed = dot(n, v), nn = square_of(n), reach2 = radius * radius * nn;
  if (speed > 0 || (h < 0 && h * h > reach2)) return no();
  if (h * h <= reach2) return hit(0, add(c, n, -h / nn), h <= 0 && r.choose.below(2) == 1 ? scaled(n, -1) : n);
  if (speed == 0) return no();
  const R t = (real(h) - sqrt(real(reach2))) / real(-speed);
  VR place;
  for (int i = 0; i < 3; ++i) place[i] = real(c[i]) + real(v[i]) * t - real(n[i] * radius) / length(n);
  Reference reference = yes(t, place);
  reference.give_unit(n);
  return reference;
}

/// From outside the first root, from inside the second root.
Reference reference_moving_point_sphere(Reader r) {
  const V p = r.vector(), v = r.vector(), center = r.vector();
  const Q radius = r.number();
  const bool solid = r.number() != 0;
  const V m = sub(p, center);
  const Q a = square_of(v), b = dot(m, v), c = square_of(m) - radius * radius, d = b * b - a * c;
  if (c <= 0 && solid) {
    if (square_of(m) > 0) return hit(0, p, m);
    return hit(0, p, r.choose.in_cone({}, {}));
  }
  if (a == 0) return no();
  const bool leaves = c <= 0;
  if (!leaves && (b >= 0 || d < 0)) return no();
  if (radius == 0) return hit(-b / a, center, r.choose.in_cone({}, leaves ? std::vector<V>{} : std::vector<V>{v}));
  const R t = root_of(a, b, d, leaves ? +1 : -1);
  VR place, normal;
  for (int i = 0; i < 3; ++i) {
    place[i] = real(p[i]) + real(v[i]) * t;
    normal[i] = R(place[i] - real(center[i])) / real(radius);
  }
  return yes(t, place, normal);
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
  const V m = sub(add(p, v, t), center);
  return {dot(m, m) <= reach * reach, {}};
}

}  // namespace

std::span<const Derived> of_moving_points() {
  static constexpr Derived all[] = {{"moving_point_plane", &reference_moving_point_plane},
                                    {"moving_point_triangle_prepared", &reference_moving_point_triangle_prepared},
                                    {"moving_point_rectangle", &reference_moving_point_rectangle},
                                    {"moving_point_capsule", &reference_moving_point_capsule},
                                    {"moving_point_aabox", &reference_moving_point_aabox},
                                    {"ray_aabox", &reference_ray_aabox},
                                    {"moving_point_span_sphere", &reference_moving_point_span_sphere},
                                    {"moving_point_span_capsule", &reference_moving_point_span_capsule},
                                    {"moving_point_span_box", &reference_moving_point_span_box},
                                    {"moving_point_span_aabox", &reference_moving_point_span_aabox},
                                    {"moving_point_box", &reference_moving_point_box},
                                    {"moving_sphere_plane", &reference_moving_sphere_plane},
                                    {"moving_sphere_sphere", &reference_moving_sphere_sphere},
                                    {"moving_sphere_capsule", &reference_moving_sphere_capsule},
                                    {"moving_sphere_passes_sphere", &reference_moving_sphere_passes_sphere},
                                    {"moving_sphere_box", &reference_moving_sphere_box},
                                    {"moving_point_sphere", &reference_moving_point_sphere},
                                    {"moving_point_triangle", &reference_moving_point_triangle}};
  return all;
}

}  // namespace nearmiss::derived
