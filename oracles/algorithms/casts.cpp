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

/// Features of two cores, of which the first one moves, that may be the first to meet: when, and the way between the
/// nearest points then, if the cores have points at its ends and none further along it.
template <class N>
struct Contact {
  N time;
  Vector<N> way;
  bool of_facet;  ///< until that time the cores are apart along the way, whether they meet then or not
};

/// The lesser root of a t^2 - 2 b t + c, where a and b are positive.
template <class N>
std::optional<N> first_root(const N& a, const N& b, const N& c) {
  if (!may_be_positive(a) || !may_be_positive(b)) return std::nullopt;
  const N discriminant = square(b) - a * c;
  if (!may_be_at_least_zero(discriminant)) return std::nullopt;
  return N(b - root(discriminant)) / a;
}

/// Calls f(contact), until it returns true, for the features of cores with a radius. As any_direction() does with
/// directions, it computes only those for which wanted() returns true.
template <class N, class F, class Wanted>
bool any_contact(const Core<N>& a, const Core<N>& b, const Vector<N>& velocity, const N& radius, F&& f,
                 Wanted&& wanted) {
  const auto of_facet = [&](const Vector<N>& d, TwoEdges<N>) {
    const N length2 = norm2(d);
    if (surely_zero(length2)) return false;
    const N length = root(length2);
    const std::array<N, 2> both = gaps(d, a, b);
    for (const std::size_t side : {0, 1}) {
      const Vector<N> direction = side == 0 ? d : negated(d);
      const N approach = dot(direction, velocity);
      if (!may_be_positive(approach)) continue;
      const N time = N(both[side] - N(radius * length)) / approach;
      if (f(Contact<N>{time, times(direction, N(N(radius / length2) * length)), true})) return true;
    }
    return false;
  };
  if (any_direction(a, b, true, of_facet, wanted)) return true;
  for (const bool is_of_a : {true, false}) {
    const Core<N>&one = is_of_a ? a : b, &other = is_of_a ? b : a;
    const Vector<N> step = is_of_a ? velocity : negated(velocity);  // of the vertex, by its opposite
    for (const auto& [from, along] : one.edges) {
      for (const Vector<N>& v : other.vertices) {
        if (!wanted()) continue;
        const N length2 = norm2(along);
        if (surely_zero(length2)) continue;
        const Vector<N> way = minus(v, one.vertices[from]), across = cross(way, along), turning = cross(step, along);
        const std::optional<N> time =
            first_root(norm2(turning), dot(across, turning), N(norm2(across) - N(square(radius) * length2)));
        if (!time) continue;
        const Vector<N> then = minus(way, times(step, *time));
        const Vector<N> gap = minus(then, times(along, N(dot(then, along) / length2)));
        if (f(Contact<N>{*time, is_of_a ? gap : negated(gap), false})) return true;
      }
    }
  }
  for (const Vector<N>& v : a.vertices) {
    for (const Vector<N>& w : b.vertices) {
      if (!wanted()) continue;
      const Vector<N> way = minus(w, v);
      const std::optional<N> time = first_root(norm2(velocity), dot(way, velocity), N(norm2(way) - square(radius)));
      if (time && f(Contact<N>{*time, minus(way, times(velocity, *time)), false})) return true;
    }
  }
  return false;
}

/// Calls f(direction) in this way for directions at a right angle to the motion. Where any parts the cores, one of
/// these does.
template <class N, class F, class Wanted>
bool any_across_motion(const Core<N>& a, const Core<N>& b, const Vector<N>& velocity, F&& f, Wanted&& wanted) {
  for (const Core<N>* core : {&a, &b}) {
    for (const Vector<N>& along : core->directions) {
      if (wanted() && f(cross(velocity, along))) return true;
    }
  }
  for (const Vector<N>& v : a.vertices) {
    for (const Vector<N>& w : b.vertices) {
      if (wanted() && f(cross(velocity, cross(minus(w, v), velocity)))) return true;
    }
  }
  return false;
}

/// Calls f(time) in this way for directions along the motion: until then, they part cores without radii. One of these
/// does until the cores meet.
template <class N, class F, class Wanted>
bool any_end_of_parting(const Core<N>& a, const Core<N>& b, const Vector<N>& velocity, F&& f, Wanted&& wanted) {
  const auto of_direction = [&](const Vector<N>& d) {
    const std::array<N, 2> both = gaps(d, a, b);
    for (const std::size_t side : {0, 1}) {
      const N approach = side == 0 ? dot(d, velocity) : N(-dot(d, velocity));
      if (may_be_positive(approach) && f(N(both[side] / approach))) return true;
    }
    return false;
  };
  for (const Core<N>* core : {&a, &b}) {
    for (const Vector<N>& along : core->directions) {  // of a flat difference
      if (wanted() && of_direction(cross(along, cross(velocity, along)))) return true;
    }
  }
  return any_direction(
             a, b, true, [&](const Vector<N>& d, TwoEdges<N>) { return of_direction(d); }, wanted) ||
         (wanted() && of_direction(velocity));
}

/// Two exact cores, of which the first one moves. Intervals leave few of their features for exact numbers.
class ExactCast {
 public:
  ExactCast(const ExactCore& a, const ExactCore& b, const ExactVector& velocity)
      : a_(a),
        b_(b),
        velocity_(velocity),
        radius_(a.radius + b.radius),
        near_(enclosing(relative_to(place_near(a), a), relative_to(place_near(a), b), true)),
        near_velocity_(enclosed_direction(velocity)) {}

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
  template <class Out>
  void report_motion(Out& out) const {
    if (surely_zero(radius_)) return report_motion_of_cores(out);
    std::optional<Contact<Exact>> first;
    bool is_tangent = false;
    const auto consider = [&](const Contact<Exact>& c) {
      if (!may_be_positive(c.time) || !is_contact(c)) return false;
      const Exact toward = dot(c.way, velocity_);
      if (may_be_positive(toward)) {  // no other contact is earlier
        first = c, is_tangent = false;
        return true;
      }
      // The time of a tangent is rational.
      if (surely_zero(toward) && (!first || may_be_less(c.time, first->time))) first = c, is_tangent = true;
      return false;
    };
    static_cast<void>(any_contact(a_, b_, velocity_, radius_, consider, left_by_intervals(&ExactCast::find_contacts)));
    if (!first) return out.no();
    const ExactCore at_contact = moved(a_, times(velocity_, first->time));
    AsContact<Exact, Out> contact(first->time, true, out);
    report_along_normal(at_contact, b_, times(first->way, Exact(Exact(1) / radius_)), radius_, first->way,
                        first_points(at_contact, b_, first->way, first->way), contact);
  }

  /// Whether the cores then have points at the ends of that way, and none further along it.
  bool is_contact(const Contact<Exact>& c) const {
    const ExactCore then = moved(a_, times(velocity_, c.time));
    const std::array<Exact, 2> gap = gaps(c.way, then, b_);
    if (!surely_zero(Exact(gap[0] - square(radius_)))) return false;
    return !first_points(then, b_, c.way, c.way).empty();
  }

  /// Of cores without radii: their shadows along the velocity meet, or they miss. Then no direction along the velocity
  /// parts them longer than they are apart.
  template <class Out>
  void report_motion_of_cores(Out& out) const {
    const auto parts = [&](const ExactVector& d) {
      const std::array<Exact, 2> both = gaps(d, a_, b_);
      return may_be_positive(both[0]) || may_be_positive(both[1]);
    };
    if (any_across_motion(a_, b_, velocity_, parts, left_by_intervals(&ExactCast::find_directions_across)))
      return out.no();
    std::optional<Exact> time;
    const auto include = [&](const Exact& until) {
      if (!time || may_be_less(*time, until)) time = until;
      return false;
    };
    static_cast<void>(
        any_end_of_parting(a_, b_, velocity_, include, left_by_intervals(&ExactCast::find_ends_of_parting)));
    if (!time || !may_be_positive(*time)) return out.no();
    const ExactCore at_contact = moved(a_, times(velocity_, *time));
    AsContact<Exact, Out> contact(*time, true, out);
    report_tuples(at_contact, b_, greatest_gaps(at_contact, b_), contact, &velocity_);
  }

  /// What intervals tell of candidates, in their order: the latest time of each that may be the contact.
  struct Candidates {
    std::vector<double> latest;
    double last = 0;  ///< the cores meet no earlier

    bool start() {
      latest.push_back(-HUGE_VAL);
      return true;
    }
    void may_be(const Interval& time) { latest.back() = std::max(latest.back(), time.sup()); }
    void no_earlier_than(const Interval& time) { last = std::max(last, time.inf()); }
  };

  /// A function for the parameter `wanted`: a candidate that is too early, or none for certain, is not.
  auto left_by_intervals(void (ExactCast::*find)(Candidates&) const) const {
    const IntervalScope scope;
    arithmetic_barrier();
    Candidates candidates;
    (this->*find)(candidates);
    arithmetic_barrier();
    const bool are_valid = !scope.any_invalid();
    return [candidates, are_valid, i = std::size_t(0)]() mutable {
      return candidates.latest[i++] >= candidates.last || !are_valid;
    };
  }

  void find_contacts(Candidates& found) const {
    const auto& [a, b] = near_;
    const Interval radius = a.radius + b.radius;
    const auto consider = [&](const Contact<Interval>& c) {
      const IntervalCore then = moved(near_[0], times(near_velocity_, c.time));
      if (may_be_zero(Interval(gaps(c.way, then, near_[1])[0] - square(radius)))) found.may_be(c.time);
      if (c.of_facet) found.no_earlier_than(c.time);
      return false;
    };
    any_contact(a, b, near_velocity_, radius, consider, [&] { return found.start(); });
  }
  void find_directions_across(Candidates& found) const {
    const auto consider = [&](const IntervalVector& d) {
      const std::array<Interval, 2> both = gaps(d, near_[0], near_[1]);
      if (may_be_positive(both[0]) || may_be_positive(both[1])) found.may_be(Interval(HUGE_VAL));
      return false;
    };
    any_across_motion(near_[0], near_[1], near_velocity_, consider, [&] { return found.start(); });
  }
  void find_ends_of_parting(Candidates& found) const {
    const auto consider = [&](const Interval& time) {
      found.may_be(time), found.no_earlier_than(time);
      return false;
    };
    any_end_of_parting(near_[0], near_[1], near_velocity_, consider, [&] { return found.start(); });
  }

  const ExactCore &a_, &b_;
  const ExactVector& velocity_;
  const Exact radius_;
  const std::array<IntervalCore, 2> near_;
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
    if (!(most < HUGE_VAL)) try_time(time_of_least_distance());
    // Of a motion that nearly passes, the last steps to a proof are far between.
    constexpr int most_steps = 20;
    for (int i = 0; i < most_steps && most < HUGE_VAL && most > guess.fine; ++i) {
      const double before = most;
      try_time(guess.contact + (most - guess.contact) / 8);
      if (most == before) break;
    }
    e.may_miss = !(most < HUGE_VAL);
    e.time = Interval(std::min(least, most), most);
    return e;
  }

 private:
  struct Guess {
    std::vector<IntervalVector> normals;
    std::vector<double> times;            ///< by which the cores may have met
    double contact = 0, fine = HUGE_VAL;  ///< the time in the middle, and one as late as the inputs may make it
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
    g.contact = t;
    if (closing > 0) {
      for (const double factor : {1.0, 2.0, 8.0, 64.0}) g.times.push_back(t + factor * reach / closing);
      g.fine = g.times.back();
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

  /// When the cores in the middle are nearest, or overlap most, as far as doubles tell.
  double time_of_least_distance() const {
    const auto comes_nearer = [&](double t) {
      const IntervalCore then = middle_at(t);
      const auto way = between_near_points(then, middle_b_);
      if (way && plain(norm2(*way)) > 0) return plain(dot(*way, middle_velocity_)) > 0;
      double greatest = -HUGE_VAL, approach = 0;
      any_direction(then, middle_b_, true, [&](const IntervalVector& d, TwoEdges<Interval>) {
        const std::array<Interval, 2> both = gaps(d, then, middle_b_);
        const double length = plain(root(norm2(d)));
        for (const std::size_t side : {0, 1}) {
          const double gap = plain(both[side]) / length;
          if (!(gap > greatest)) continue;
          greatest = gap, approach = (side == 0 ? 1 : -1) * plain(dot(d, middle_velocity_));
        }
        return false;
      });
      return approach > 0;
    };
    const double speed = plain(root(norm2(middle_velocity_)));
    if (!(speed > 0)) return 0;
    const IntervalVector apart = minus(middle_b_.vertices.front(), middle_a_.vertices.front());
    double low = 0, high = 2 * plain(Interval(root(norm2(apart)) + size_of_cores())) / speed;
    constexpr int steps = 40;
    for (int i = 0; i < steps; ++i) {
      const double middle = 0.5 * (low + high);
      (comes_nearer(middle) ? low : high) = middle;
    }
    return low;
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
