/// Truth: in the box's frame, one quadratic for each of the 26 regions around the box. Its earlier root counts if the
/// center is in that region at that time. The distance from a convex set is convex along a line, so the least of these
/// roots is the first contact; the other roots end a graze of constant distance. A ball of radius 0 is a point that
/// enters.
#include "impl/catalogue/queries/moving_sphere_box.hpp"

#include <cmath>
#include <optional>

#include "oracles/algorithms/first_contact.hpp"
#include "oracles/algorithms/point_enters_box.hpp"
#include "oracles/algorithms/ray_and_box.hpp"
#include "oracles/algorithms/residual.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

namespace {

template <class N>
struct Motion {
  std::array<Vector<N>, 3> axes;
  Vector<N> origin;             // the box's center, in the world frame
  Vector<N> start, step, half;  // of the sphere's center, in the box's frame
  N radius;
  Vector<N> from, velocity;  // the same start and step, in the world frame

  Vector<N> at(const N& time) const { return plus(start, times(step, time)); }
  Vector<N> to_world(const Vector<N>& local) const { return plus(origin, out_of(axes, local)); }
};

/// A root of one region's quadratic.
template <class N>
struct Contact {
  collide::Impact<N> impact;
  Normals<N> normals;
};

/// The center at that time in the box's frame, rotated after the motion; empty near overflow.
template <class N>
std::optional<Vector<N>> turned_last(const Motion<N>& m, const N& time) {
  if constexpr (is_enclosure<N>) {
    const bool moderate =
        is_moderate(m.from) && is_moderate(m.velocity) && is_moderate(m.half) && is_moderate(m.radius);
    if (moderate && is_moderate(time)) return into(m.axes, plus(m.from, times(m.velocity, time)));
  }
  return std::nullopt;
}

/// Narrows the time about a fixed one: by the remaining distance from the region's feature at the fixed time, over its
/// slope. False if the intersection is empty.
template <class N>
bool narrow_about_middle(const Motion<N>& m, const Sides& sides, N& time) {
  if constexpr (is_enclosure<N>) {
    if (!is_moderate(time)) return true;
    const N t0(near_middle(time));
    const auto at_t0 = turned_last(m, t0), at_any = turned_last(m, join(time, t0));
    if (!at_t0 || !at_any) return true;
    N left(0), slope(0);
    for (int i = 0; i < 3; ++i) {
      if (sides[i] == 0) continue;
      const N face = sides[i] > 0 ? m.half[i] : N(-m.half[i]);
      if (beyond(sides) == 1) {
        left = N(sides[i]) * ((*at_t0)[i] - face) - m.radius;
        slope = N(sides[i]) * m.step[i];
      } else {
        left = left + square(N((*at_t0)[i] - face));
        slope = slope + N(2) * m.step[i] * ((*at_any)[i] - face);
      }
    }
    if (beyond(sides) > 1) left = left - square(m.radius);
    if (may_be_zero(slope) || !is_moderate(left)) return true;
    return narrow(time, N(t0 - left / slope));
  }
  return true;
}

/// Appends the earlier root of the region's quadratic if the center is in that region at that time; `w` encloses the
/// times at which it is.
template <class N>
void first_root(const Motion<N>& m, const Sides& sides, const Window& w, NumberVector<Contact<N>>& roots) {
  Vector<N> e{N(0), N(0), N(0)}, v{N(0), N(0), N(0)};
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    if (sides[i] == 0) continue;
    axis = i;
    e[i] = sides[i] > 0 ? N(m.start[i] - m.half[i]) : N(m.start[i] + m.half[i]);
    v[i] = m.step[i];
  }
  const N closing = -dot(e, v);
  if (!may_be_positive(closing)) return;
  std::optional<N> crossing;
  if (beyond(sides) == 1) {
    const N speed = sides[axis] > 0 ? N(-v[axis]) : v[axis];
    const N gap = sides[axis] > 0 ? e[axis] : N(-e[axis]);
    if (!may_be_positive(speed)) return;
    crossing = time_within(w, N(gap - m.radius), speed);
  } else {
    const N discriminant = norm2(v) * square(m.radius) - norm2(cross(e, v));
    if (!may_be_at_least_zero(discriminant)) return;
    const N far = assume_at_least_zero(closing) + root(discriminant);
    crossing = time_within(w, N(norm2(e) - square(m.radius)), far);
  }
  if (!crossing || !may_be_at_least_zero(*crossing)) return;
  N time = assume_at_least_zero(*crossing);
  if (!narrow_about_middle(m, sides, time)) return;
  Vector<N> contact = m.at(time), normal{N(0), N(0), N(0)};
  const std::optional<Vector<N>> tighter = turned_last(m, time);
  for (int i = 0; tighter && i < 3; ++i) contact[i] = meet(contact[i], (*tighter)[i]);
  for (int i = 0; i < 3; ++i) {
    if (!may_be_on_side(contact[i], m.half[i], sides[i])) return;
    if (sides[i] == 0) continue;
    const N away = meet(N(e[i] + v[i] * time), N(contact[i] - (sides[i] > 0 ? m.half[i] : N(-m.half[i]))));
    normal[i] = sides[i] > 0 ? N(assume_at_least_zero(away)) : N(assume_at_most_zero(away));
    contact[i] = sides[i] > 0 ? m.half[i] : N(-m.half[i]);
  }
  collide::Impact<N> impact{time, answer_vector(m.to_world(contact)), {}};
  if (beyond(sides) == 1) {
    impact.normal = answer_vector(sides[axis] > 0 ? m.axes[axis] : negated(m.axes[axis]));
    return roots.push_back({impact, {}});
  }
  if (may_be_zero(m.radius)) {
    return roots.push_back({impact, normal_cone(m.axes, sides).against(m.velocity)});
  }
  for (N& component : normal) component = assume_within(N(component / m.radius), -1.0, 1.0);
  impact.normal = answer_vector(out_of(m.axes, normal));
  roots.push_back({impact, {}});
}

/// The least of the exact roots. Of enclosures, each root may be the least.
template <class N, class Out>
void report_first(const NumberVector<Contact<N>>& roots, Out& out) {
  const auto later_than_another = [&](const Contact<N>& c) {
    return std::any_of(roots.begin(), roots.end(),
                       [&](const Contact<N>& other) { return may_be_less(other.impact.time, c.impact.time); });
  };
  for (const Contact<N>& c : roots) {
    if (is_enclosure<N> || !later_than_another(c)) out.yes(c.impact, c.normals);
  }
}

/// The possible results at the start.
struct Start {
  bool may_be_apart = false, may_be_contact = false;
};

/// A start outside the box or on its surface, in that region: a contact at time 0 if the sphere overlaps the box, or
/// touches it and does not leave.
template <class N, class Out>
Start start_in_region(const Motion<N>& m, const Sides& sides, Out& out) {
  const FromFeature<N> from = from_feature(m.start, m.half, sides);
  const N outside = from.distance2 - square(m.radius);
  const Start start{may_be_positive(outside), may_be_at_most_zero(outside)};
  if (!start.may_be_contact) return start;
  collide::Impact<N> impact{N(0), answer_vector(m.to_world(from.nearest)), {}};
  if (may_be_zero(from.distance2)) {
    out.yes(impact, normal_cone(m.axes, sides));
    return start;
  }
  const N leaving = dot(from.away, m.step);
  if (may_be_zero(outside) && may_be_positive(leaving)) out.no();
  if (may_be_negative(outside) || may_be_at_most_zero(leaving)) {
    Vector<N> unit = times(from.away, N(N(1) / from.distance(sides)));
    for (N& component : unit) component = assume_within(component, -1.0, 1.0);
    impact.normal = answer_vector(out_of(m.axes, unit));
    out.yes(impact);
  }
  return start;
}

bool starts_on_surface(const Motion<Exact>& m) {
  bool on_some_face = false;
  for (int i = 0; i < 3; ++i) {
    if (!may_be_on_side(m.start[i], m.half[i], 0)) return false;
    on_some_face =
        on_some_face || may_be_on_side(m.start[i], m.half[i], 1) || may_be_on_side(m.start[i], m.half[i], -1);
  }
  return on_some_face;
}

/// A center on the surface: the normals against the motion are right. If the center moves away from every face, all
/// normals are right.
template <class Out>
void start_on_surface(const Motion<Exact>& m, Out& out) {
  const collide::Impact<Exact> impact{Exact(0), answer_vector(m.to_world(m.start)), {}};
  bool leads_away = true;
  for_each_cone_at(m.start, m.half, [&](const Sides& sides) { leads_away = leads_away && !may_be_met(m.step, sides); });
  for_each_cone_at(m.start, m.half, [&](const Sides& sides) {
    const Normals<Exact> outward = normal_cone(m.axes, sides);
    if (leads_away)
      out.yes(impact, outward);
    else if (may_be_met(m.step, sides))
      out.yes(impact, outward.against(m.velocity));
  });
}

/// Contacts at time 0 of a ball with positive radius.
template <class N, class Out>
Start start(const Motion<N>& m, Out& out) {
  if constexpr (!is_enclosure<N>) {
    if (starts_on_surface(m)) return start_on_surface(m, out), Start{false, true};
  }
  Start start;
  bool may_start_in = true;
  for_each_possible_region(m.start, m.half, [&](const Sides& sides) {
    const Start in_region = start_in_region(m, sides, out);
    start.may_be_apart = start.may_be_apart || in_region.may_be_apart;
    start.may_be_contact = start.may_be_contact || in_region.may_be_contact;
  });
  for (int i = 0; i < 3; ++i) may_start_in = may_start_in && may_be_on_side(m.start[i], m.half[i], 0);
  if (!may_start_in) return start;
  start.may_be_contact = true;
  for_each_nearest_face(m.start, m.half, [&](const Face& face, const N&) {
    Vector<N> nearest = m.start;
    nearest[face.axis] = face.side > 0 ? m.half[face.axis] : N(-m.half[face.axis]);
    const Vector<N>& axis = m.axes[face.axis];
    out.yes({N(0), answer_vector(m.to_world(nearest)), answer_vector(face.side > 0 ? axis : negated(axis))});
  });
  return start;
}

/// Whether a center that starts outside certainly enters the box, however thin the box and small the sphere.
template <class N>
bool surely_enters(const Motion<N>& m) {
  return !may_miss(RayAndBox<N>{m.start, m.step, negated(m.half), m.half});
}

/// Whether the sphere certainly overlaps the box at that time.
template <class N>
bool surely_overlaps(const Motion<N>& m, double time) {
  const Vector<N> c = m.at(N(time));
  N distance2(0);
  for (int i = 0; i < 3; ++i) {
    const N e = magnitude(c[i]) - m.half[i];
    if (may_be_positive(e)) distance2 = distance2 + square(assume_at_least_zero(e));
  }
  return !may_be_positive(N(distance2 - square(m.radius)));
}

/// A time near that of the least distance. Plain doubles locate it, so the time itself proves nothing.
template <class N>
double time_of_least_distance(const Motion<N>& m, Window w) {
  if (!(w.to < Window{}.to)) return w.from;
  double c[3], v[3], h[3];
  const auto middle = [](const N& x) {
    const Bounds b = bounds(x);
    return 0.5 * b.low + 0.5 * b.high;
  };
  for (int i = 0; i < 3; ++i) c[i] = middle(m.start[i]), v[i] = middle(m.step[i]), h[i] = middle(m.half[i]);
  const auto slope = [&](double t) {
    double s = 0;
    for (int i = 0; i < 3; ++i) {
      const double x = c[i] + v[i] * t;
      s += v[i] * (x - std::clamp(x, -h[i], h[i]));
    }
    return s;
  };
  for (int step = 0; step < 40 && w.from < w.to; ++step) {
    const double t = 0.5 * w.from + 0.5 * w.to, s = slope(t);
    if (s == 0) return t;
    (s < 0 ? w.from : w.to) = t;
  }
  return w.from;
}

}  // namespace

template <class N, class Out>
void moving_sphere_box(const inputs::moving_sphere_box<N>& q, Out& out) {
  if (may_be_zero(q.sphere.radius)) report_entry<N>({vector(q.sphere.center), vector(q.velocity), q.box}, out);
  if (!may_be_positive(q.sphere.radius)) return;
  const auto axes = rotation_axes<N>(q.box.orientation);
  const Vector<N> origin = vector(q.box.center);
  const Motion<N> m{axes,
                    origin,
                    into(axes, minus(vector(q.sphere.center), origin)),
                    into(axes, vector(q.velocity)),
                    vector(q.box.half),
                    q.sphere.radius,
                    minus(vector(q.sphere.center), origin),
                    vector(q.velocity)};
  const Start at_start = start(m, out);
  if (!at_start.may_be_apart) return;

  Window near;  // the times at which the projections of sphere and box on each axis meet
  Window on_side[3][3];
  for (int i = 0; i < 3; ++i) {
    near.clip(times_on_side(m.start[i], m.step[i], N(m.half[i] + m.radius), 0));
    for (int side = -1; side <= 1; ++side) {
      on_side[i][side + 1] = times_on_side(m.start[i], m.step[i], m.half[i], side);
    }
  }
  if (near.empty()) return out.no();
  NumberVector<Contact<N>> roots;
  for_each_region([&](const Sides& sides) {
    Window w = near;
    for (int i = 0; i < 3; ++i) w.clip(on_side[i][sides[i] + 1]);
    if (!w.empty()) first_root(m, sides, w, roots);
  });
  report_first(roots, out);
  if (!out.result().may_be_yes) return out.no();
  if constexpr (is_enclosure<N>) {
    const bool surely =
        surely_overlaps(m, time_of_least_distance(m, near)) || (!at_start.may_be_contact && surely_enters(m));
    if (!surely) out.no();
  }
}

template <class N>
bool on_surface(const inputs::moving_sphere_box<N>& q, const GivenPlace<N>& place) {
  return may_be_on_box(place, q.box);
}

NEARMISS_ORACLE(moving_sphere_box)

}  // namespace nearmiss::oracle
