/// Truth of the grid's casts.
///
/// The signed distance D(t) of two cores of which one is translated is convex: each direction n has a gap that is
/// linear in time, and D is the greatest one. So where the cores are further apart than their radii R along a
/// direction, the gap tells until when they are, for ever if the motion does not lead along it; and where D(t) <= R,
/// they have met by then. At the time of contact the right answers are those about the signed distance of the moved
/// core, and D = R.
///
/// The height of a deepest vertex above the plane of a half-space is linear in time, and the same vertices stay the
/// deepest ones. Any point between them may be met first.
#include <algorithm>
#include <source_location>

#include "impl/catalogue/queries/grid.hpp"
#include "oracles/algorithms/surface_of_shapes.hpp"
#include "oracles/algorithms/times.hpp"
#include "oracles/algorithms/two_cores.hpp"

namespace nearmiss::oracle {

namespace {

constexpr std::size_t location_at = begin_of<collide::Impact<double>>("location");

/// The deepest vertices of a core, and a half-space with a normal of length 1.
template <class N>
struct AboveHalfSpace;

template <>
struct AboveHalfSpace<Exact> {
  ExactVector normal;
  Exact height;
  std::vector<ExactVector> deepest;  ///< the corners of a polygon

  template <class HalfSpace>
  AboveHalfSpace(const ExactCore& core, const HalfSpace& halfspace, const Exact& norm)
      : deepest(furthest(core, negated(vector(halfspace.normal)))) {
    const Exact inverse = Exact(norm / square(norm));  // whose root is that of the norm
    normal = times(vector(halfspace.normal), inverse);
    height = Exact(dot(vector(halfspace.normal), deepest.front()) + halfspace.offset) * inverse;
  }

  /// Contacts at that time and at the deepest vertices, moved by `way`.
  template <class Out>
  void report(const Exact& time, const ExactVector& way, Out& out) const {
    const auto answer = [&](const ExactVector& vertex) {
      return collide::Impact<Exact>{time, answer_vector(plus(vertex, way)), answer_vector(normal)};
    };
    for (const ExactVector& vertex : deepest) out.yes(answer(vertex));
    if (deepest.size() == 1 || !out.compares_yes()) return;
    std::vector<RationalVector> polygon;
    for (const ExactVector& vertex : deepest) polygon.push_back(rational(vertex));
    const NearestPoint nearest = nearest_in_polygon({offset_place(out, location_at, way)}, polygon);
    const RationalVector& x = nearest.member ? *nearest.member : polygon.front();
    out.yes(answer({Exact(x[0]), Exact(x[1]), Exact(x[2])}), SetDistance{{{location_at, nearest.ulps}}, nearest.ulps});
  }
};

template <>
struct AboveHalfSpace<Interval> {
  IntervalVector outward, normal;
  Interval offset, height;
  IntervalVector deepest;  ///< a box around the vertices
  bool is_one = false;     ///< the same vertex for all inputs

  template <class HalfSpace>
  AboveHalfSpace(const IntervalCore& core, const HalfSpace& halfspace, const Interval& norm)
      : outward(vector(halfspace.normal)), normal(unit_of(outward)), offset(halfspace.offset) {
    height = (projection(outward, core).low + offset) / norm;
    const IntervalVector down = negated(normal);
    const MayBeFurthest may_be{core, down};
    deepest = hull_of(core, may_be);
    is_one = std::count_if(core.vertices.begin(), core.vertices.end(), may_be) <= 1;
  }

  /// Where several vertices may be the deepest one, each contact lies between them, on the plane.
  template <class Out>
  void report(const Interval& time, const IntervalVector& way, Out& out) const {
    const collide::Impact<Interval> answer{time, answer_vector(plus(deepest, way)), answer_vector(normal)};
    if (is_one) return out.yes(answer);
    const IntervalVector origin{Interval(0), Interval(0), Interval(0)};
    const double off = least_ulps(out.given_vector(location_at).front(), {outward, origin, -offset});
    out.yes(answer, SetDistance{{{location_at, {off, HUGE_VAL}}}, {off, HUGE_VAL}});
  }
};

template <template <class> class Q, class N, class Out>
void cast_against_half_space(const Q<N>& q, Out& out) {
  Core<N> a = core_of(q.a);
  if constexpr (!is_enclosure<N>) a = in_units(a);
  const Vector<N> velocity = vector(q.velocity), outward = vector(q.b.normal);
  const N length2 = norm2(outward);
  if (may_be_zero(length2)) return out.everything();
  const N norm = root(length2);
  const AboveHalfSpace<N> above(a, q.b, norm);
  const N gap = above.height - a.radius, approach = -dot(outward, velocity);
  const bool may_touch = may_be_zero(gap);
  if (may_be_negative(gap) || (may_touch && may_be_at_least_zero(approach)))
    above.report(N(0), times(above.normal, N(-above.height)), out);
  if ((may_be_positive(gap) && may_be_at_most_zero(approach)) || (may_touch && may_be_negative(approach))) out.no();
  if (!may_be_positive(gap) || !may_be_positive(approach)) return;
  if (may_be_zero(approach)) return out.everything();
  const N time = time_across(N(gap * norm), approach);
  above.report(time, minus(times(velocity, time), times(above.normal, a.radius)), out);
}

// Two cores.

constexpr std::size_t impact_normal_at = begin_of<collide::Impact<double>>("normal");

/// Reports answers about a signed distance as those of a contact at a time. Of shapes that touch, both points are the
/// location; of shapes that overlap, the first one is in no answer.
template <class N, class Out>
class AsContact {
 public:
  using Place = std::source_location;

  AsContact(const N& time, bool touches, Out& out) : time_(time), touches_(touches), out_(out) {}

  bool compares_yes() const { return out_.compares_yes(); }
  NumberVector<GivenVector> given_vector(std::size_t number) const {
    if (number == normal_at) {
      NumberVector<GivenVector> normals = out_.given_vector(impact_normal_at);
      for (GivenVector& n : normals) {
        for (std::size_t k = 0; k < 3; ++k) n.high[k] = -n.high[k], n.low[k] = -n.low[k];
      }
      return normals;
    }
    NumberVector<GivenVector> places = out_.given_vector(location_at);
    if (number == point1_at && !touches_) places.front().given = {};
    return places;
  }
  void yes(const collide::SignedDistance<N>& a, const Place& from = Place::current()) {
    out_.yes(contact(a), Normals<N>::as_given(), from);
  }
  void yes(const collide::SignedDistance<N>& a, const SetDistance& set, const Place& from = Place::current()) {
    SetDistance of_contact{{}, set.together};
    for (const SetDistance::Part& part : set.vectors) {
      if (part.begin == normal_at) of_contact.vectors.push_back({impact_normal_at, part.ulps});
      if (part.begin == point2_at) of_contact.vectors.push_back({location_at, part.ulps});
    }
    out_.yes(contact(a), of_contact, from);
  }

 private:
  collide::Impact<N> contact(const collide::SignedDistance<N>& a) const {
    return {time_, a.point2, answer_vector(negated(vector(a.normal)))};
  }

  const N time_;
  const bool touches_;
  Out& out_;
};

template <class N>
Core<N> moved(Core<N> core, const Vector<N>& way) {
  for (Vector<N>& v : core.vertices) v = plus(v, way);
  if (!core.reach.empty()) core.center = plus(core.center, way);
  return core;
}

/// Two exact cores, of which the first one moves.
class ExactCast {
 public:
  ExactCast(const ExactCore& a, const ExactCore& b, const ExactVector& velocity)
      : a_(a),
        b_(b),
        velocity_(velocity),
        radius_(a.radius + b.radius),
        near_a_(near(a)),
        near_b_(near(b)),
        near_velocity_(near(velocity)) {}

  template <class Out>
  void report(Out& out) const {
    const std::vector<Separating> best = greatest_gaps(a_, b_);
    const bool touch = is_touch(best, a_, b_);
    const Exact rank = touch ? Exact(0) : best.front().rank, radius2 = square(radius_);
    if (may_be_less(rank, radius2)) {
      AsContact<Exact, Out> at_start(Exact(0), false, out);
      return report_tuples(a_, b_, best, at_start);
    }
    if (may_be_less(radius2, rank)) return report_motion(out);
    const bool leaves =
        (!touch || surely_spans(a_, b_)) && std::none_of(best.begin(), best.end(), [&](const Separating& s) {
          return may_be_at_least_zero(dot(s.direction, velocity_));
        });
    if (leaves) return out.no();
    AsContact<Exact, Out> at_start(Exact(0), true, out);
    report_tuples(a_, b_, best, at_start, &velocity_);
  }

 private:
  /// A contact: when, the way between the nearest points of the cores then, and a direction with that length and sense.
  struct Contact {
    Exact time;
    ExactVector way;
  };

  template <class Out>
  void report_motion(Out& out) const {
    if (surely_zero(radius_)) return report_motion_of_cores(out);
    std::optional<Contact> first;
    bool is_tangent = false;
    const auto consider = [&](const Contact& c) {
      if (!may_be_contact(c) || !may_be_positive(c.time) || !is_contact(c)) return false;
      const Exact toward = dot(c.way, velocity_);
      if (may_be_positive(toward)) {  // no other contact is earlier
        first = c, is_tangent = false;
        return true;
      }
      // The time of a tangent is rational.
      if (surely_zero(toward) && (!first || may_be_less(c.time, first->time))) first = c, is_tangent = true;
      return false;
    };
    static_cast<void>(any_contact(consider));
    if (!first) return out.no();
    const ExactCore at_contact = moved(a_, times(velocity_, first->time));
    AsContact<Exact, Out> contact(first->time, true, out);
    report_along_normal(at_contact, b_, times(first->way, Exact(Exact(1) / radius_)), radius_, first->way,
                        first_points(at_contact, b_, first->way, first->way), contact);
  }

  /// Calls f(contact) for what may be one, until it returns true.
  template <class F>
  bool any_contact(F&& f) const {
    const auto of_facet = [&](const ExactVector& d, TwoEdges<Exact>) {
      const Exact length2 = norm2(d);
      if (surely_zero(length2)) return false;
      const Exact length = root(length2);
      const std::array<Exact, 2> both = gaps(d, a_, b_);
      for (const std::size_t side : {0, 1}) {
        const ExactVector direction = side == 0 ? d : negated(d);
        const Exact approach = dot(direction, velocity_);
        if (!may_be_positive(approach)) continue;
        const Exact time = Exact(both[side] - Exact(radius_ * length)) / approach;
        if (f(Contact{time, times(direction, Exact(Exact(radius_ / length2) * length))})) return true;
      }
      return false;
    };
    if (any_direction(a_, b_, true, of_facet)) return true;
    for (const bool is_of_a : {true, false}) {
      const ExactCore &one = is_of_a ? a_ : b_, &other = is_of_a ? b_ : a_;
      for (const auto& [from, along] : one.edges) {
        for (const ExactVector& v : other.vertices) {
          if (edge_meets(one.vertices[from], along, v, is_of_a, f)) return true;
        }
      }
    }
    for (const ExactVector& v : a_.vertices) {
      for (const ExactVector& w : b_.vertices) {
        const ExactVector way = minus(w, v);
        const std::optional<Exact> time =
            first_root(norm2(velocity_), dot(way, velocity_), Exact(norm2(way) - square(radius_)));
        if (time && f(Contact{*time, minus(way, times(velocity_, *time))})) return true;
      }
    }
    return false;
  }

  /// Of the line of an edge of one core and a vertex of the other one.
  template <class F>
  bool edge_meets(const ExactVector& start, const ExactVector& along, const ExactVector& v, bool is_of_a, F& f) const {
    const Exact length2 = norm2(along);
    if (surely_zero(length2)) return false;
    const ExactVector step = is_of_a ? velocity_ : negated(velocity_);  // v moves by its opposite
    const ExactVector way = minus(v, start), across = cross(way, along), turning = cross(step, along);
    const std::optional<Exact> time =
        first_root(norm2(turning), dot(across, turning), Exact(norm2(across) - Exact(square(radius_) * length2)));
    if (!time) return false;
    const ExactVector then = minus(way, times(step, *time));
    const ExactVector gap = minus(then, times(along, Exact(dot(then, along) / length2)));
    return f(Contact{*time, is_of_a ? gap : negated(gap)});
  }

  /// The lesser root of a t^2 - 2 b t + c, where a and b are positive.
  static std::optional<Exact> first_root(const Exact& a, const Exact& b, const Exact& c) {
    if (!may_be_positive(a) || !may_be_positive(b)) return std::nullopt;
    const Exact discriminant = square(b) - a * c;
    if (may_be_negative(discriminant)) return std::nullopt;
    return Exact(b - root(discriminant)) / a;
  }

  /// False where intervals tell that is_contact() is.
  bool may_be_contact(const Contact& c) const {
    const IntervalScope scope;
    arithmetic_barrier();
    const IntervalCore then = moved(near_a_, times(near_velocity_, near(c.time)));
    const Interval beyond = gaps(near(c.way), then, near_b_)[0] - near(square(radius_));
    const bool may_be = may_be_zero(beyond) && may_be_positive(near(c.time));
    arithmetic_barrier();
    return may_be || scope.any_invalid();
  }
  static Interval near(const Exact& x) {
    const Bounds b = bounds(x);
    return {b.low, b.high};
  }
  static IntervalVector near(const ExactVector& v) { return {near(v[0]), near(v[1]), near(v[2])}; }
  static IntervalCore near(const ExactCore& core) {
    IntervalCore enclosure;
    for (const ExactVector& v : core.vertices) enclosure.vertices.push_back(near(v));
    return enclosure;
  }

  /// Whether the cores then have points at the ends of that way, and none further along it.
  bool is_contact(const Contact& c) const {
    const ExactCore then = moved(a_, times(velocity_, c.time));
    const std::array<Exact, 2> gap = gaps(c.way, then, b_);
    if (!surely_zero(Exact(gap[0] - square(radius_)))) return false;
    return !first_points(then, b_, c.way, c.way).empty();
  }

  /// Of cores without radii: their shadows along the velocity meet, or they miss. Then no direction along the velocity
  /// parts them longer than they are apart.
  template <class Out>
  void report_motion_of_cores(Out& out) const {
    const auto is_apart_along = [&](const ExactVector& d) {
      const std::array<Exact, 2> both = gaps(d, a_, b_);
      return may_be_positive(both[0]) || may_be_positive(both[1]);
    };
    std::optional<Exact> time;
    const auto include = [&](const ExactVector& d, TwoEdges<Exact> = {}) {
      const std::array<Exact, 2> both = gaps(d, a_, b_);
      for (const std::size_t side : {0, 1}) {
        const Exact approach = side == 0 ? dot(d, velocity_) : Exact(-dot(d, velocity_));
        if (!may_be_positive(approach)) continue;
        const Exact until = both[side] / approach;
        if (!time || may_be_less(*time, until)) time = until;
      }
      return false;
    };
    for (const ExactCore* core : {&a_, &b_}) {
      for (const ExactVector& e : core->directions) {
        if (is_apart_along(cross(velocity_, e))) return out.no();
        // Perpendicular to the edge: of a flat difference, along which the motion leads.
        include(cross(e, cross(velocity_, e)));
      }
    }
    for (const ExactVector& v : a_.vertices) {
      for (const ExactVector& w : b_.vertices) {
        if (is_apart_along(cross(velocity_, cross(minus(w, v), velocity_)))) return out.no();
      }
    }
    any_direction(a_, b_, true, include);
    include(velocity_);
    if (!time || !may_be_positive(*time)) return out.no();
    const ExactCore at_contact = moved(a_, times(velocity_, *time));
    AsContact<Exact, Out> contact(*time, true, out);
    report_tuples(at_contact, b_, greatest_gaps(at_contact, b_), contact, &velocity_);
  }

  const ExactCore &a_, &b_;
  const ExactVector& velocity_;
  const Exact radius_;
  const IntervalCore near_a_, near_b_;
  const IntervalVector near_velocity_;
};

/// What intervals tell of a motion from a start at which the cores are further apart than their radii.
struct Encounter {
  bool may_hit = true, may_miss = true;
  Interval time{0, HUGE_VAL};
};

/// Finds directions and times in plain numbers, and proves by intervals what they tell of all inputs.
class IntervalCast {
 public:
  IntervalCast(const IntervalCore& a, const IntervalCore& b, const IntervalVector& velocity)
      : a_(a),
        b_(b),
        middle_a_(in_the_middle(a)),
        middle_b_(in_the_middle(b)),
        velocity_(velocity),
        middle_velocity_(in_the_middle(velocity)),
        radius_(a.radius + b.radius) {}

  Encounter encounter() const {
    const Guess guess = guessed();
    Encounter e;
    double least = 0, most = HUGE_VAL;
    const auto try_direction = [&](const IntervalVector& d) {
      const Interval length = root(norm2(d)), approach = dot(d, velocity_), gap = gaps(d, a_, b_)[0] - radius_ * length;
      if (!(gap.inf() > 0)) return;
      if (approach.sup() <= 0) e.may_hit = false;
      if (approach.sup() > 0) least = std::max(least, (of_bound(gap.inf()) / of_bound(approach.sup())).inf());
    };
    const auto try_across_motion = [&](const IntervalVector& d) {  // which is at a right angle to the velocity
      const Interval reach = radius_ * root(norm2(d));
      for (const Interval& gap : gaps(d, a_, b_)) {
        if (Interval(gap - reach).inf() > 0) e.may_hit = false;
      }
    };
    for (const IntervalVector& n : guess.normals) {
      try_direction(n);
      try_across_motion(cross(velocity_, cross(n, velocity_)));
    }
    for (const IntervalCore* core : {&a_, &b_}) {
      for (const IntervalVector& along : core->directions) try_across_motion(cross(velocity_, along));
    }
    any_direction(a_, b_, true, [&](const IntervalVector& d, TwoEdges<Interval>) {
      try_direction(d), try_direction(negated(d));
      return false;
    });
    if (!e.may_hit) return e;
    const auto try_time = [&](double t) {
      if (t >= 0 && t < most && is_met_by(t)) most = t;
    };
    if (is_difference_flat(a_, b_)) most = time_of_crossing();
    for (const double t : guess.times) try_time(t);
    e.may_miss = !(most < HUGE_VAL);
    e.time = Interval(std::min(least, most), most);
    return e;
  }

 private:
  struct Guess {
    std::vector<IntervalVector> normals;
    std::vector<double> times;  ///< by which the cores may have met
  };

  static std::optional<IntervalVector> between_near_points(const IntervalCore& a, const IntervalCore& b) {
    const NearPoints near(a, b);
    if (!near.weights()) return std::nullopt;
    const auto& [of_a, of_b] = *near.weights();
    return minus(point_at(spans_of(b), of_b), point_at(spans_of(a), of_a));
  }
  static double plain(const Interval& x) { return CGAL::to_double(x); }
  IntervalCore middle_at(double t) const { return moved(middle_a_, times(middle_velocity_, Interval(t))); }

  /// Newton's method on D(t) - R from a time before the contact: the steps along the gap's direction never pass it.
  Guess guessed() const {
    Guess g;
    const double radius = plain(radius_);
    double t = 0, closing = 0;
    constexpr int most_steps = 64;
    for (int i = 0; i < most_steps; ++i) {
      const auto way = between_near_points(middle_at(t), middle_b_);
      if (!way) break;
      const double length = plain(root(norm2(*way)));
      if (!(length > 0)) break;
      const IntervalVector n = in_the_middle(times(*way, Interval(1 / length)));
      closing = plain(dot(n, middle_velocity_));
      const double further = length - radius;
      if (g.normals.size() < 2 || further > 0x1p-30 * (length + radius)) g.normals.push_back(n);
      const double next = t + further / closing;
      if (!(closing > 0) || !(next > t)) break;
      t = next;
    }
    if (g.normals.size() > 3) g.normals.erase(g.normals.begin(), g.normals.end() - 3);
    const double reach = reach_at(t), speed = plain(root(norm2(middle_velocity_)));
    for (const double step : {0x1p-45, 0x1p-30, 0x1p-15, 0x1p-6}) g.times.push_back(t + step * t);
    if (closing > 0) {
      for (const double factor : {1.0, 2.0, 8.0, 64.0, 1024.0}) g.times.push_back(t + factor * reach / closing);
    }
    if (speed > 0) {
      for (const double share : {0.25, 0.5, 1.0}) g.times.push_back(t + share * plain(size_of_cores()) / speed);
    }
    std::sort(g.times.rbegin(), g.times.rend());
    return g;
  }
  Interval size_of_cores() const {
    const auto size = [](const IntervalCore& core) {
      double most = 0;
      for (const IntervalVector& v : core.vertices)
        most = std::max(most, root(norm2(minus(v, core.vertices.front()))).sup());
      return of_bound(most);
    };
    return size(middle_a_) + size(middle_b_) + radius_;
  }

  /// By how much the distance of the cores may differ from that in the middle, at most.
  double reach_at(double t) const {
    const auto core_alone = [](IntervalCore core) {
      core.radius = Interval(0);
      return core;
    };
    const IntervalCore then = moved(a_, times(velocity_, Interval(t)));
    return (of_bound(movement(core_alone(then), core_alone(middle_at(t)))) +
            of_bound(movement(core_alone(b_), core_alone(middle_b_))))
        .sup();
  }
  bool is_met_by(double t) const {
    if (!std::isfinite(t)) return false;
    const IntervalCore then = middle_at(t);
    const Interval allowed = of_bound(radius_.inf()) - of_bound(reach_at(t));
    if (!(allowed.inf() > -HUGE_VAL)) return false;
    if (allowed.inf() > 0) {
      const auto way = between_near_points(then, middle_b_);
      if (way && root(norm2(*way)).sup() <= allowed.inf()) return true;
    }
    const std::optional<Bounds> s = signed_distance(then, middle_b_);
    return s && s->high <= allowed.inf();
  }

  /// By when the motion leads across a flat difference, whatever the radii; infinity where that is not certain.
  double time_of_crossing() const {
    for (const IntervalCore* core : {&a_, &b_}) {
      for (const IntervalVector& e : core->directions) {
        for (const Interval& gap : gaps(cross(velocity_, e), a_, b_)) {
          if (!(gap.sup() <= 0)) return HUGE_VAL;
        }
      }
    }
    double by = HUGE_VAL;
    any_direction(a_, b_, true, [&](const IntervalVector& d, TwoEdges<Interval>) {
      const std::array<Interval, 2> both = gaps(d, a_, b_);
      for (const std::size_t side : {0, 1}) {
        const Interval approach = side == 0 ? dot(d, velocity_) : Interval(-dot(d, velocity_));
        if (approach.inf() > 0 && both[side].inf() >= 0)
          by = std::min(by, (of_bound(both[side].sup()) / of_bound(approach.inf())).sup());
      }
      return false;
    });
    return by;
  }

  const IntervalCore &a_, &b_;
  const IntervalCore middle_a_, middle_b_;
  const IntervalVector velocity_, middle_velocity_;
  const Interval radius_;
};

template <template <class> class Q, class Out>
  requires WithHalfSpace<Q, Exact>
void cast_of(const Q<Exact>& q, Out& out) {
  cast_against_half_space(q, out);
}
template <template <class> class Q, class Out>
  requires WithHalfSpace<Q, Interval>
void cast_of(const Q<Interval>& q, Out& out) {
  cast_against_half_space(q, out);
}

template <template <class> class Q, class Out>
void cast_of(const Q<Exact>& q, Out& out) {
  const ExactCore a = in_units(core_of(q.a)), b = in_units(core_of(q.b));
  const ExactVector velocity = vector(q.velocity);
  ExactCast(a, b, velocity).report(out);
}

template <template <class> class Q, class Out>
void cast_of(const Q<Interval>& q, Out& out) {
  IntervalCore a = core_of(q.a), b = core_of(q.b);
  const IntervalVector place = place_near(a), velocity = vector(q.velocity);
  a = relative_to(place, std::move(a)), b = relative_to(place, std::move(b));
  const Interval distance = enclosed_distance<Q>(q, a, b, out.middle()), radius = a.radius + b.radius;
  if (distance.inf() <= radius.sup()) {
    AsContact<Interval, Out> at_start(Interval(0), false, out);
    report_tuples(a, b, place, meet(distance, Interval(-HUGE_VAL, radius.sup())), at_start);
    if (distance.sup() < radius.inf()) return;
    const Interval toward = dot(normals_of(a, b, distance), velocity);
    if (!(toward.inf() >= 0)) out.no();  // it may touch and leave
  }
  if (!(distance.sup() > radius.inf())) return;
  const Encounter e = IntervalCast(a, b, velocity).encounter();
  if (e.may_miss) out.no();
  if (!e.may_hit) return;
  if (!(e.time.sup() < HUGE_VAL)) return out.everything();
  AsContact<Interval, Out> contact(e.time, true, out);
  report_tuples(moved(a, times(velocity, e.time)), b, place, radius, contact);
}

}  // namespace

#define NEARMISS_CAST_AS(query, first, second)                             \
  template <class N, class Out>                                            \
  void query(const inputs::query<N>& q, Out& out) {                        \
    cast_of(q, out);                                                       \
  }                                                                        \
  template <class N>                                                       \
  bool on_surface(const inputs::query<N>& q, const GivenPlace<N>& place) { \
    return may_be_on_surface_of(q.b, place);                               \
  }                                                                        \
  NEARMISS_ORACLE(query)
#include "impl/catalogue/grid.def"

}  // namespace nearmiss::oracle
