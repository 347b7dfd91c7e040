/// A ball that moves past a fixed ball or capsule. One quadratic belongs to each end of the axis and one to the tube
/// between the ends; the earlier root counts if the contact at that time lies on the same part. The distance from a
/// convex set is convex along a line, so the least of these roots is the first contact. Shared by the oracles of
/// spheres and capsules.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "oracles/algorithms/first_contact.hpp"
#include "oracles/algorithms/residual.hpp"
#include "oracles/algorithms/times.hpp"
#include "oracles/algorithms/tuples.hpp"

namespace nearmiss::oracle {

/// The moving ball, and the fixed set of all points within `radius` of the segment between two ends.
template <class N>
struct SphereAndCapsule {
  Vector<N> at, step;  // of the moving center
  N own;               // the moving ball's radius
  std::array<Vector<N>, 2> end;
  N radius;      // of the fixed set
  bool is_ball;  // both ends are one point

  N reach() const { return own + radius; }
  Vector<N> axis() const { return minus(end[1], end[0]); }
};

/// The parts of a capsule; a ball has only the first.
enum class Part { first_end, second_end, tube };

/// A contact: the nearest point of the axis, and the vector from that point to the moving center.
template <class N>
struct CapsuleContact {
  N time;
  Vector<N> on_axis, away;
  Part part;
};

template <class N>
struct CapsuleContacts {
  const SphereAndCapsule<N>& m;
  const Vector<N> d = m.axis();
  const N length2 = norm2(d);

  /// The barycentric weight of the second end, for a center between the ends.
  N share(const Vector<N>& from_first) const {
    if (may_be_zero(length2)) return is_enclosure<N> ? join(N(0), N(1)) : N(0);
    return assume_within(N(dot(d, from_first) / length2), 0.0, 1.0);
  }
  bool may_belong_to_end(const Vector<N>& from_end, Part part) const {
    if (m.is_ball) return true;
    const N along = dot(d, from_end);
    return part == Part::first_end ? may_be_at_most_zero(along) : may_be_at_least_zero(along);
  }
  bool may_belong_to_tube(const Vector<N>& from_first, const Vector<N>& from_second) const {
    return may_be_at_least_zero(dot(d, from_first)) && may_be_at_most_zero(dot(d, from_second));
  }
  static bool all_surely_zero(const Vector<N>& x) {
    return surely_zero(x[0]) && surely_zero(x[1]) && surely_zero(x[2]);
  }

  /// The normals for a center on the axis: those that point out of that part. Every other normal of the part is one of
  /// them.
  Normals<N> normals_of_axis(Part part) const {
    if (m.is_ball || surely_zero(length2)) return Normals<N>::any();
    return Normals<N>::cone({{d, part == Part::first_end ? -1 : 0, part == Part::second_end ? 1 : 0}});
  }
  /// For a center on the axis every outward normal is right, with the place that belongs to it. If the fixed set has
  /// radius 0, it is only its axis, and only the normals against the motion are right.
  template <class Out>
  void yes_on_axis(const CapsuleContact<N>& c, Normals<N> normals, Out& out) const {
    constexpr std::size_t location = begin_of<collide::Impact<double>>("location");
    constexpr std::size_t normal = begin_of<collide::Impact<double>>("normal");
    yes_to_any(NormalWithPlace<N>{std::move(normals), c.on_axis, m.radius, normal, location}, out,
               [&](const Vector<N>& n, const Vector<N>& place) -> collide::Impact<N> {
                 return {c.time, answer_vector(place), answer_vector(n)};
               });
  }

  /// `away` is the exact vector from the axis to the center, of length `distance`. A ball that arrives, and does not
  /// start in contact, has no contact whose normal points along its motion.
  template <class Out>
  void yes(const CapsuleContact<N>& c, const N& distance, bool arrives, Out& out) const {
    if (may_be_zero(distance)) {
      const bool only_against = arrives || (all_surely_zero(c.away) && surely_zero(m.radius));
      const Normals<N> out_of_axis = normals_of_axis(c.part);
      return yes_on_axis(c, only_against ? out_of_axis.against(m.step) : out_of_axis, out);
    }
    const auto unit = [&](const N& x) -> N {
      if constexpr (is_enclosure<N>) {
        return assume_within(N(x / distance), -1.0, 1.0);
      } else {
        return x / distance;
      }
    };
    const Vector<N> normal{unit(c.away[0]), unit(c.away[1]), unit(c.away[2])};
    Vector<N> location = plus(c.on_axis, times(normal, m.radius));
    if constexpr (is_enclosure<N>) {  // also computed from the moving center
      if (c.time.sup() > 0 && is_moderate(c.time) && is_moderate(m.at) && is_moderate(m.step)) {
        const Vector<N> seen = minus(plus(m.at, times(m.step, c.time)), times(normal, m.own));
        for (int i = 0; i < 3; ++i) location[i] = meet(location[i], seen[i]);
      }
    }
    out.yes({c.time, answer_vector(location), answer_vector(normal)});
  }

  // The start.

  /// Reports a contact of that part at time 0. Returns whether the ball may start apart.
  template <class Out>
  bool start(const CapsuleContact<N>& c, const N& distance2, Out& out) const {
    const N outside = distance2 - square(m.reach());
    if (!may_be_at_most_zero(outside)) return true;
    const N leaving = dot(c.away, m.step);
    const bool may_overlap = may_be_negative(outside) && may_be_positive(m.own);
    const bool may_touch = may_be_zero(outside) && may_be_at_most_zero(leaving);
    if (may_be_negative(outside) && may_be_zero(m.own)) out.no();
    if (may_be_zero(outside) && may_be_positive(leaving)) out.no();
    if (may_overlap || may_touch) yes(c, root(assume_at_least_zero(distance2)), false, out);
    return may_be_positive(outside);
  }

  template <class Out>
  bool start(Out& out) const {
    const Vector<N> from[2] = {minus(m.at, m.end[0]), minus(m.at, m.end[1])};
    bool may_start_apart = false;
    const auto from_end = [&](int i, Part part) {
      if (!may_belong_to_end(from[i], part)) return;
      may_start_apart = start({N(0), m.end[i], from[i], part}, norm2(from[i]), out) || may_start_apart;
    };
    from_end(0, Part::first_end);
    if (m.is_ball) return may_start_apart;
    from_end(1, Part::second_end);
    if (!may_be_positive(length2) || !may_belong_to_tube(from[0], from[1])) return may_start_apart;
    const N s = share(from[0]);
    const Vector<N> away = minus(from[0], times(d, s));
    N distance2 = norm2(away);
    if (!may_be_zero(length2)) distance2 = meet(distance2, N(norm2(cross(from[0], d)) / length2));
    const CapsuleContact<N> c{N(0), plus(m.end[0], times(d, s)), away, Part::tube};
    return start(c, distance2, out) || may_start_apart;
  }

  // The roots.

  /// Encloses the times at which the moving center may be within reach; false if there are none.
  bool may_be_near(N& time) const {
    Vector<N> low = m.end[0], high = m.end[0];
    if constexpr (is_enclosure<N>) {
      for (int i = 0; i < 3; ++i) {
        const N ends = join(m.end[0][i], m.end[1][i]);
        low[i] = ends - m.reach(), high[i] = ends + m.reach();
      }
    }
    time = any_time<N>();
    return narrow_to_range(time, m.at, m.step, low, high);
  }

  /// The earlier root of a t^2 - 2 closing t + c, with half the root of the discriminant. Narrows `time`.
  static bool earlier_root(const N& a, const N& closing, const N& c, const N& half, N& time) {
    const N far = assume_at_least_zero(closing) + half;
    if constexpr (is_enclosure<N>) {
      if (!may_be_zero(far) && !narrow(time, N(assume_at_least_zero(c) / far))) return false;
      if (!may_be_zero(a) && !narrow(time, N((closing - half) / a))) return false;
      return true;
    } else {
      time = c / far;
      return true;
    }
  }

  /// The contacts that may be the first, and a time by which the ball certainly reaches the fixed set.
  struct Roots {
    NumberVector<CapsuleContact<N>> list;
    double surely_by = std::numeric_limits<double>::infinity();
  };

  void root_of_end(int i, Part part, N time, Roots& roots) const {
    const Vector<N> from = minus(m.at, m.end[i]);
    const N closing = -dot(from, m.step), speed2 = norm2(m.step);
    if (!may_be_positive(closing)) return;
    const N discriminant = speed2 * square(m.reach()) - norm2(cross(from, m.step));
    const N outside = norm2(from) - square(m.reach());
    if (!may_be_at_least_zero(discriminant) || !may_be_at_least_zero(outside)) return;
    if (!earlier_root(speed2, closing, outside, root(discriminant), time)) return;
    if (!may_be_at_most_zero(closing) && !may_be_negative(discriminant)) reaches_by(time, roots);
    add({time, m.end[i], from, part}, m.step, roots.list,
        [&](const Vector<N>& away) { return may_belong_to_end(away, part); });
  }

  void root_of_tube(N time, Roots& roots) const {
    const Vector<N> from = minus(m.at, m.end[0]);
    if constexpr (is_enclosure<N>) {  // the tube lies in a ball about an end; tightens only short tubes
      const N reach = m.reach() + root(length2);
      const Window near = times_within(from, m.step, square(reach), norm2(cross(from, m.step)));
      if (near.empty() || !narrow(time, N(near.from, near.to))) return;
    }
    const Vector<N> from_d = cross(from, d), step_d = cross(m.step, d);
    const N closing = -dot(from_d, step_d), a = norm2(step_d);
    if (!may_be_positive(closing)) return;
    const N discriminant = length2 * (a * square(m.reach()) - square(dot(d, cross(from, m.step))));
    const N outside = norm2(from_d) - square(m.reach()) * length2;
    if (!may_be_at_least_zero(discriminant) || !may_be_at_least_zero(outside)) return;
    const N half = root(discriminant);
    // Whether the ball certainly touches the line between the ends. Ignores the narrowing of `time`, which assumes that
    // it does.
    N of_line = any_time<N>();
    const bool touches_line = !may_be_at_most_zero(closing) && !may_be_negative(discriminant) &&
                              earlier_root(a, closing, outside, half, of_line);
    if (touches_line && surely_beside(of_line, from)) reaches_by(of_line, roots);
    if (!earlier_root(a, closing, outside, half, time)) return;
    Vector<N> center;
    if (!place_of(time, from, center)) return;
    if (!may_belong_to_tube(center, minus(center, d))) return;
    const N s = share(center);
    CapsuleContact<N> c{time, plus(m.end[0], times(d, s)), minus(center, times(d, s)), Part::tube};
    if (!narrow_to_reach(c.away)) return;
    if constexpr (is_enclosure<N>) {
      if (!may_be_zero(length2) && !narrow_about_middle(c, s)) return;
    }
    roots.list.push_back(c);
  }
  /// Whether `from_first`, moved on by a bounded time, is certainly between the ends.
  bool surely_beside(const N& time, const Vector<N>& from_first) const {
    if constexpr (is_enclosure<N>) {
      if (!(time.sup() < std::numeric_limits<double>::infinity())) return false;
      const Vector<N> center = plus(from_first, times(m.step, time));
      return !may_be_negative(dot(d, center)) && !may_be_positive(dot(d, minus(center, d)));
    }
    return false;  // exact roots are compared
  }
  static void reaches_by(const N& time, Roots& roots) {
    if constexpr (is_enclosure<N>) roots.surely_by = std::min(roots.surely_by, time.sup());
  }

  /// The same about a fixed time and a fixed weight of the second end; false if the intersection is empty.
  bool narrow_about_middle(CapsuleContact<N>& c, const N& s) const {
    if constexpr (is_enclosure<N>) {
      if (!is_moderate(m.at) || !is_moderate(m.step) || !is_moderate(m.end[0]) || !is_moderate(m.end[1])) return true;
      if (!is_moderate(c.time) || !is_moderate(N(N(1) / length2))) return true;
      const N s0(near_middle(s));
      const Vector<N> middle = plus(times(m.end[0], N(N(1) - s0)), times(m.end[1], s0));
      const Vector<N> from = minus(m.at, middle);
      if (!oracle::narrow_to_reach(from, m.step, &d, length2, m.reach(), c.time)) return false;
      const Vector<N> center = plus(from, times(m.step, c.time));
      const Vector<N> on = times(d, N(dot(center, d) / length2));
      return narrow(c.on_axis, plus(middle, on)) && narrow(c.away, minus(center, on));
    }
    return true;
  }

  /// `from` moved on by the time; unknown if the time is unbounded.
  bool place_of(const N& time, const Vector<N>& from, Vector<N>& place) const {
    if constexpr (is_enclosure<N>) {
      if (!(time.sup() < std::numeric_limits<double>::infinity())) {
        for (int i = 0; i < 3; ++i) {
          const N ends = join(m.end[0][i], m.end[1][i]);
          const N reach = m.reach();
          place[i] = join(N(ends - reach), N(ends + reach)) - m.end[0][i];
        }
        return true;
      }
    }
    place = plus(from, times(m.step, time));
    return true;
  }
  /// The vector from the axis to a contact is as long as the sum of the radii. False if that is impossible.
  bool narrow_to_reach(Vector<N>& away) const {
    if constexpr (is_enclosure<N>) {
      const N any(-m.reach().sup(), m.reach().sup());
      return narrow(away, {any, any, any});
    }
    return true;
  }

  template <class Belongs>
  void add(CapsuleContact<N> c, const Vector<N>& step, NumberVector<CapsuleContact<N>>& roots, Belongs belongs) const {
    if constexpr (is_enclosure<N>) {
      if (c.time.sup() < std::numeric_limits<double>::infinity()) {
        c.away = plus(c.away, times(step, c.time));
        if (!narrow_to_reach(c.away)) return;
      } else {
        c.away.fill(N(-m.reach().sup(), m.reach().sup()));
      }
    } else {
      c.away = plus(c.away, times(step, c.time));
    }
    if (belongs(c.away)) roots.push_back(c);
  }

  Roots roots() const {
    Roots found;
    N time;
    if (!may_be_near(time)) return found;
    root_of_end(0, Part::first_end, time, found);
    if (m.is_ball) return found;
    root_of_end(1, Part::second_end, time, found);
    if (may_be_positive(length2)) root_of_tube(time, found);
    if constexpr (is_enclosure<N>) {
      std::erase_if(found.list, [&](const CapsuleContact<N>& c) { return c.time.inf() > found.surely_by; });
      for (CapsuleContact<N>& c : found.list) c.time = N(c.time.inf(), std::min(c.time.sup(), found.surely_by));
    }
    return found;
  }

  /// Whether the ball certainly reaches the fixed set at that time, at that weight of the second end.
  bool surely_reaches(double time, double share_of_second) const {
    const Vector<N> on_axis = plus(m.end[0], times(d, N(share_of_second)));
    const Vector<N> away = minus(plus(m.at, times(m.step, N(time))), on_axis);
    return !may_be_positive(N(norm2(away) - square(m.reach())));
  }
  /// The same near the closest approach. Plain doubles locate it, so the location itself proves nothing.
  bool surely_reaches_somewhere() const {
    const auto middle = [](const Vector<N>& x, int i) {
      const Bounds b = bounds(x[i]);
      return 0.5 * b.low + 0.5 * b.high;
    };
    double c[3], v[3], e[3], speed2 = 0, length2_ = 0;
    for (int i = 0; i < 3; ++i) {
      c[i] = middle(m.at, i) - middle(m.end[0], i), v[i] = middle(m.step, i), e[i] = middle(d, i);
      speed2 += v[i] * v[i], length2_ += e[i] * e[i];
    }
    // Alternating projection onto the two lines. It converges slowly near a parallel.
    double time = 0, s = 0.5;
    for (int step = 0; step < 30; ++step) {
      double along_v = 0, along_e = 0;
      for (int i = 0; i < 3; ++i) along_v += v[i] * (e[i] * s - c[i]);
      time = speed2 > 0 ? std::max(0.0, along_v / speed2) : 0;
      for (int i = 0; i < 3; ++i) along_e += e[i] * (c[i] + v[i] * time);
      s = length2_ > 0 ? std::clamp(along_e / length2_, 0.0, 1.0) : 0;
      if (surely_reaches(time, s)) return true;
      if (m.is_ball) return false;
    }
    return false;
  }
};

/// Reports all right answers about the ball and the fixed set.
template <class N, class Out>
void report_first_contact(const SphereAndCapsule<N>& m, Out& out) {
  const CapsuleContacts<N> past{m};
  if (!past.start(out)) return;
  const auto roots = past.roots();
  for (const CapsuleContact<N>& c : roots.list) {
    const bool later = std::any_of(roots.list.begin(), roots.list.end(),
                                   [&](const CapsuleContact<N>& other) { return may_be_less(other.time, c.time); });
    if (is_enclosure<N> || !later) past.yes(c, m.reach(), true, out);
  }
  if (!out.result().may_be_yes) return out.no();
  if constexpr (is_enclosure<N>) {
    const bool surely = roots.surely_by < std::numeric_limits<double>::infinity() || past.surely_reaches_somewhere();
    if (!surely) out.no();
  }
}

}  // namespace nearmiss::oracle
