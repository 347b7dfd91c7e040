#include "oracles/exact/nearest_member.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss::oracle {

namespace {

int digits(Scalar s) { return s == Scalar::float32 ? 24 : 53; }
double unit_of(double largest, Scalar s) { return ulp(std::min(largest, largest_finite(s)), s); }

/// The largest distance that the exact stage searches. A vector within that distance has less than twice the largest
/// number of the given one, or both are subnormal: |x - y| <= 2^(digits - 3) ulp(max(|x|, |y|)) <= max(|x|, |y|) / 4.
double looked_ulps(Scalar s) { return std::ldexp(1.0, digits(s) - 3); }

RationalVector moved(const RationalVector& at, const RationalVector& along, const Rational& t) {
  return {at[0] + along[0] * t, at[1] + along[1] * t, at[2] + along[2] * t};
}

/// { x : low <= x <= high }.
struct RationalBox {
  RationalVector low, high;

  bool empty() const { return low[0] > high[0] || low[1] > high[1] || low[2] > high[2]; }
  bool contains(const RationalVector& x) const {
    for (int i = 0; i < 3; ++i) {
      if (x[i] < low[i] || high[i] < x[i]) return false;
    }
    return true;
  }
};

RationalBox common(const RationalBox& a, const RationalBox& b) {
  RationalBox c = a;
  for (int i = 0; i < 3; ++i) c.low[i] = std::max(c.low[i], b.low[i]), c.high[i] = std::min(c.high[i], b.high[i]);
  return c;
}

double largest_of(const GivenVector& g) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    if (g.given[i] && !std::isnan(g.high[i])) largest = std::max(largest, std::abs(g.high[i]));
  }
  return largest;
}

bool all_given(const GivenVector& g) { return g.given[0] && g.given[1] && g.given[2]; }

/// Every vector within `reach` of the given one in each component. No member has a component beyond `bound`.
RationalBox around(const GivenVector& g, const Rational& reach, const Rational& bound) {
  const Rational largest(largest_finite(g.scalar));
  RationalBox box;
  for (int i = 0; i < 3; ++i) {
    box.low[i] = -bound, box.high[i] = bound;
    if (!g.given[i] || std::isnan(g.high[i])) continue;
    if (std::isinf(g.high[i])) {
      (g.high[i] > 0 ? box.low[i] : box.high[i]) =
          g.high[i] > 0 ? Rational(largest - reach) : Rational(reach - largest);
      continue;
    }
    const Rational at = Rational(g.high[i]) + Rational(g.low[i]);
    box.low[i] = std::max(box.low[i], Rational(at - reach)), box.high[i] = std::min(box.high[i], Rational(at + reach));
  }
  return box;
}

/// Boxes whose union is the set of vectors within `ulps`. The first box uses the unit of the given vector. If a right
/// vector may reach the next power of two, where the unit is larger, one more box follows for each component that may
/// reach it.
std::vector<RationalBox> within(const GivenVector& g, double ulps, const Rational& bound) {
  double largest = largest_of(g);
  if (!all_given(g)) largest = std::max(largest, CGAL::to_interval(bound).second);
  const auto reach = [&](double unit) -> Rational { return Rational(ulps) * Rational(unit) + Rational(g.slack); };
  const double unit = unit_of(largest, g.scalar);
  std::vector<RationalBox> boxes{around(g, reach(unit), bound)};
  if (largest == 0 || largest >= largest_finite(g.scalar) / 2) return boxes;
  const double power = std::ldexp(1.0, std::ilogb(largest) + 1), larger_unit = unit_of(power, g.scalar);
  if (larger_unit == unit || Rational(largest) + reach(larger_unit) < Rational(power)) return boxes;
  const RationalBox larger = around(g, reach(larger_unit), bound);
  for (int i = 0; i < 3; ++i) {
    RationalBox up = larger, down = larger;
    up.low[i] = std::max(up.low[i], Rational(power));
    down.high[i] = std::min(down.high[i], Rational(-power));
    boxes.push_back(up), boxes.push_back(down);
  }
  boxes.erase(std::remove_if(boxes.begin() + 1, boxes.end(), [](const RationalBox& b) { return b.empty(); }),
              boxes.end());
  return boxes;
}

bool in_cone(const RationalVector& x, const Cone& cone) {
  return std::all_of(cone.begin(), cone.end(), [&](const Side& s) {
    const Rational height = dot(s.direction, x);
    return s.level ? height == 0 : height <= 0;
  });
}

Interval enclosed(const Rational& x) { return CGAL::to_interval(x); }
Vector<Interval> enclosed(const RationalVector& v) { return {enclosed(v[0]), enclosed(v[1]), enclosed(v[2])}; }

/// A box and the directions of the sides of a cone: as they are, or enclosed by intervals.
template <class N>
struct BoxAndSides {
  Vector<N> low, high;
  std::vector<Vector<N>> sides;
};
BoxAndSides<Rational> exactly(const RationalBox& box, const Cone& cone) {
  BoxAndSides<Rational> result{box.low, box.high, {}};
  for (const Side& side : cone) result.sides.push_back(side.direction);
  return result;
}
BoxAndSides<Interval> enclosed(const BoxAndSides<Rational>& exact) {
  BoxAndSides<Interval> result{enclosed(exact.low), enclosed(exact.high), {}};
  for (const RationalVector& side : exact.sides) result.sides.push_back(enclosed(side));
  return result;
}

/// The line of all at + t along.
template <class N>
struct Line {
  Vector<N> at, along;
};

/// True where a side of the cone separates the box from the cone, or where the whole box lies inside or outside the
/// unit sphere: then no unit vector is in both. This test is cheap, and decides most searches that find none.
bool surely_without_unit_vector(const BoxAndSides<Rational>& in, const Cone& cone) {
  const auto is_apart = [&](const Side& s) {
    Rational least(0), most(0);
    for (int i = 0; i < 3; ++i) {
      const Rational at_low = s.direction[i] * in.low[i], at_high = s.direction[i] * in.high[i];
      least += std::min(at_low, at_high), most += std::max(at_low, at_high);
    }
    return least > 0 || (s.level && most < 0);
  };
  Rational nearest2(0), furthest2(0);
  for (int i = 0; i < 3; ++i) {
    const Rational near = std::clamp(Rational(0), in.low[i], in.high[i]);
    const Rational far = std::max(CGAL::abs(in.low[i]), CGAL::abs(in.high[i]));
    nearest2 += near * near, furthest2 += far * far;
  }
  return nearest2 > 1 || furthest2 < 1 || std::any_of(cone.begin(), cone.end(), is_apart);
}

/// Finds a unit vector in the intersection of a box and a cone. The intersection is convex, so it contains one if some
/// point is at most as long as 1 and some point at least as long. The shortest point is that of the box, or lies on an
/// edge of the intersection; the longest is a vertex, at the end of an edge.
///
/// Interval arithmetic rejects most lines: those that surely have no point in the intersection.
class UnitVectorIn {
 public:
  UnitVectorIn(const RationalBox& box, const Cone& cone) : cone_(cone) {
    if (box.empty()) return;
    exact_ = exactly(box, cone);
    if (!surely_without_unit_vector(exact_, cone)) search();
  }

  std::optional<Vector<Exact>> found() const {
    if (!complete()) return std::nullopt;
    // The point short + t along of length 1.
    const RationalVector along{(*long_)[0] - (*short_)[0], (*long_)[1] - (*short_)[1], (*long_)[2] - (*short_)[2]};
    const Rational a = dot(along, along), b = dot(*short_, along), c = dot(*short_, *short_) - 1;
    Exact t(0);
    if (a != 0) t = (Exact(Rational(-b)) + root(Exact(Rational(b * b - a * c)))) / Exact(a);
    Vector<Exact> n;
    for (int i = 0; i < 3; ++i) n[i] = Exact((*short_)[i]) + Exact(along[i]) * t;
    return n;
  }

 private:
  bool complete() const { return short_ && long_; }
  void add(const RationalVector& x) {
    const Rational length2 = dot(x, x);
    if (!short_ && length2 <= 1) short_ = x;
    if (!long_ && length2 >= 1) long_ = x;
  }

  void search() {
    const CGAL::Protect_FPU_rounding<true> upward(CGAL_FE_UPWARD);
    enclosed_ = enclosed(exact_);
    RationalVector shortest;
    for (int i = 0; i < 3; ++i) shortest[i] = std::clamp(Rational(0), exact_.low[i], exact_.high[i]);
    if (in_cone(shortest, cone_)) add(shortest);
    for (int i = 0; i < 3; ++i) edges_of_box(i);
    for (std::size_t s = 0; s < cone_.size(); ++s) {
      for (int i = 0; i < 3; ++i) edges_of_side_and_faces(s, i);
      for (std::size_t r = 0; r < s; ++r) edge_of_sides(r, s);
    }
  }

  void edges_of_box(int i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (const bool upper_j : {false, true}) {
      for (const bool upper_k : {false, true}) {
        edge([&]<class N>(const BoxAndSides<N>& in) {
          Line<N> line{{N(0), N(0), N(0)}, {N(0), N(0), N(0)}};
          line.at[j] = upper_j ? in.high[j] : in.low[j];
          line.at[k] = upper_k ? in.high[k] : in.low[k];
          line.along[i] = N(1);
          return line;
        });
      }
    }
  }
  /// Where a plane through the origin meets the two faces across axis i.
  void edges_of_side_and_faces(std::size_t s, int i) {
    const RationalVector& direction = exact_.sides[s];
    const int j = direction[(i + 1) % 3] != 0 ? (i + 1) % 3 : (i + 2) % 3;
    if (direction[j] == 0) return;  // parallel to the faces
    for (const bool upper : {false, true}) {
      edge([&]<class N>(const BoxAndSides<N>& in) {
        Vector<N> axis{N(0), N(0), N(0)};
        axis[i] = N(1);
        Line<N> line{{N(0), N(0), N(0)}, cross(in.sides[s], axis)};
        line.at[i] = upper ? in.high[i] : in.low[i];
        line.at[j] = -in.sides[s][i] * line.at[i] / in.sides[s][j];
        return line;
      });
    }
  }
  void edge_of_sides(std::size_t r, std::size_t s) {
    edge([&]<class N>(const BoxAndSides<N>& in) {
      return Line<N>{{N(0), N(0), N(0)}, cross(in.sides[r], in.sides[s])};
    });
  }

  /// Calls cut(height, slope) for each half-space height + slope t <= 0 of the box and the cone.
  template <class N, class Cut>
  void cut_by_all(const BoxAndSides<N>& in, const Line<N>& line, const Cut& cut) const {
    for (int i = 0; i < 3; ++i) {
      cut(N(line.at[i] - in.high[i]), line.along[i]);
      cut(N(in.low[i] - line.at[i]), N(-line.along[i]));
    }
    for (std::size_t s = 0; s < cone_.size(); ++s) {
      const N height = dot(in.sides[s], line.at), slope = dot(in.sides[s], line.along);
      cut(height, slope);
      if (cone_[s].level) cut(N(-height), N(-slope));
    }
  }

  /// A segment of a line, by its parameters.
  struct Piece {
    std::optional<Rational> from, to;
    bool empty = false;

    /// Cuts off where height + slope t > 0.
    void cut(const Rational& height, const Rational& slope) {
      if (empty) return;
      if (slope == 0) {
        empty = height > 0;
        return;
      }
      const Rational t = -height / slope;
      if (slope > 0 && (!to || t < *to)) to = t;
      if (slope < 0 && (!from || *from < t)) from = t;
      empty = from && to && *to < *from;
    }
  };

  /// True only if no point of the line lies in the box and the cone.
  bool surely_misses(const Line<Interval>& line) const {
    double from = -HUGE_VAL, to = HUGE_VAL;
    bool empty = false;
    cut_by_all(enclosed_, line, [&](const Interval& height, const Interval& slope) {
      if (surely_zero(slope)) {
        empty = empty || height.inf() > 0;
      } else if (!may_be_zero(slope)) {
        const Interval t = -height / slope;
        if (slope.inf() > 0 && t.sup() < to) to = t.sup();
        if (slope.sup() < 0 && t.inf() > from) from = t.inf();
      }
    });
    return empty || to < from;
  }

  /// Adds the ends of the line's segment in the box and the cone, and its point nearest to the origin.
  template <class MakeLine>
  void edge(const MakeLine& make_line) {
    if (complete() || surely_misses(make_line(enclosed_))) return;
    const auto [at, along] = make_line(exact_);
    const Rational length2 = dot(along, along);
    if (length2 == 0) return;
    Piece piece;
    cut_by_all(exact_, Line<Rational>{at, along},
               [&](const Rational& height, const Rational& slope) { piece.cut(height, slope); });
    if (piece.empty) return;
    add(moved(at, along, *piece.from));
    add(moved(at, along, *piece.to));
    add(moved(at, along, std::clamp(Rational(-dot(at, along) / length2), *piece.from, *piece.to)));
  }

  const Cone& cone_;
  BoxAndSides<Rational> exact_;
  BoxAndSides<Interval> enclosed_;
  std::optional<RationalVector> short_, long_;
};

/// The part of a convex polygon where sign x[axis] <= sign bound.
std::vector<RationalVector> clipped(const std::vector<RationalVector>& polygon, int axis, int sign,
                                    const Rational& bound) {
  std::vector<RationalVector> kept;
  const auto beyond = [&](const RationalVector& x) -> Rational { return sign * (x[axis] - bound); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const RationalVector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Rational at_a = beyond(a), at_b = beyond(b);
    if (at_a <= 0) kept.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
      const Rational share = at_a / (at_a - at_b);
      kept.push_back(moved(a, {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, share));
    }
  }
  return kept;
}

/// The least distance at which `find` returns a member. Below one ulp it is not resolved; above, to one part in 128.
template <class Nearest, class Find>
Nearest nearest(Scalar scalar, Find find) {
  constexpr double share = 0x1p-7;
  Nearest best;
  double low = 0, high = looked_ulps(scalar);
  const auto finds_at = [&](double ulps) {
    auto member = find(ulps);
    if (!member) return low = ulps, false;
    best.member = std::move(member);
    return high = ulps, true;
  };
  if (!finds_at(1)) {
    if (!finds_at(high)) return best.ulps = {high, HUGE_VAL}, best;
    while (high > 2 * low) finds_at(std::ldexp(1.0, (std::ilogb(low) + std::ilogb(high) + 1) / 2));
    while (high - low > high * share) finds_at(0.5 * low + 0.5 * high);
  }
  best.ulps = {low, high};
  return best;
}

/// Adds the uncertainty of the given numbers, in the smallest unit that may apply.
template <class Nearest>
Nearest with_slack(Nearest n, const GivenVector& g) {
  if (g.slack > 0) n.ulps.high += g.slack / unit_of(largest_of(g), g.scalar);
  return n;
}

}  // namespace

Vector<Exact> some_normal(const Cone& cone) {
  for (int i = 0; i < 3; ++i) {
    for (const int sign : {1, -1}) {
      RationalVector axis{0, 0, 0};
      axis[i] = sign;
      if (in_cone(axis, cone)) return {Exact(axis[0]), Exact(axis[1]), Exact(axis[2])};
    }
  }
  const RationalBox all{{-1, -1, -1}, {1, 1, 1}};
  const auto found = UnitVectorIn(all, cone).found();
  if (!found) throw std::logic_error("oracle: a cone without normals");
  return *found;
}

namespace {

/// True unless both have the same direction.
bool have_two_directions(const RationalVector& x, const RationalVector& y) {
  const RationalVector across = cross(x, y);
  return dot(across, across) != 0 || dot(x, y) < 0;
}

}  // namespace

/// Where the directions of the sides span the space, the cone is spanned by its edges. Each edge is perpendicular to
/// the directions of two sides. Otherwise the cone contains a line, and so no vector or more than one.
std::optional<Vector<Exact>> only_normal(const Cone& cone) {
  std::optional<RationalVector> edge;
  bool spans_space = false;
  for (std::size_t s = 0; s < cone.size(); ++s) {
    for (std::size_t r = 0; r < s; ++r) {
      const RationalVector line = cross(cone[r].direction, cone[s].direction);
      if (dot(line, line) == 0) continue;
      for (const Side& side : cone) spans_space = spans_space || dot(side.direction, line) != 0;
      for (const RationalVector& x : {line, negated(line)}) {
        if (!in_cone(x, cone)) continue;
        if (edge && (have_two_directions(*edge, x))) return std::nullopt;
        edge = x;
      }
    }
  }
  if (!spans_space || !edge) return std::nullopt;
  const Rational length2 = dot(*edge, *edge);
  const Exact scale = root(Exact(Rational(1 / length2)));
  return times(Vector<Exact>{Exact((*edge)[0]), Exact((*edge)[1]), Exact((*edge)[2])}, scale);
}

NearestNormal nearest_normal(const GivenVector& given, const Cone& cone) {
  const auto find = [&](double ulps) -> std::optional<Vector<Exact>> {
    for (const RationalBox& box : within(given, ulps, Rational(1))) {
      if (auto member = UnitVectorIn(box, cone).found()) return member;
    }
    return std::nullopt;
  };
  return with_slack(nearest<NearestNormal>(given.scalar, find), given);
}

NearestNormal nearest_normal(const GivenVector& given, const Cone& cone, const NormalOffset& lever) {
  const NearestTuple nearest = nearest_tuple(given, cone, {lever}, {0, 0, 0});
  return {nearest.ulps, nearest.member ? std::optional(nearest.member->normal) : std::nullopt};
}

namespace {

/// Narrows [low, high] to the t for which factor t lies in [least, most].
void narrow(Rational& low, Rational& high, const Rational& factor, const Rational& least, const Rational& most) {
  if (factor == 0) {
    if (least > 0 || most < 0) low = 1, high = 0;
    return;
  }
  const Rational a = least / factor, b = most / factor;
  low = std::max(low, std::min(a, b)), high = std::min(high, std::max(a, b));
}

/// Finds a normal of the cone in boxes around the given one, whose places lie in boxes around the given places.
class TupleIn {
 public:
  TupleIn(const Cone& cone, const std::vector<NormalOffset>& places, const RationalVector& along)
      : cone_(cone), places_(places), along_(along) {}

  std::optional<NearestTuple::Member> found(const GivenVector& normal, double ulps) const {
    for (const RationalBox& box : within(normal, ulps, Rational(1))) {
      if (auto member = found(0, ulps, box, 0, 1)) return member;
    }
    return std::nullopt;
  }

 private:
  /// With the places from number k on; those before leave the normals of the box, and [low, high] for t.
  std::optional<NearestTuple::Member> found(std::size_t k, double ulps, const RationalBox& normals, const Rational& low,
                                            const Rational& high) const {
    if (normals.empty() || low > high) return std::nullopt;
    if (k == places_.size()) {
      auto normal = UnitVectorIn(normals, cone_).found();
      if (!normal) return std::nullopt;
      return NearestTuple::Member{*normal, (low + high) / 2};
    }
    const NormalOffset& p = places_[k];
    for (RationalBox box : within(p.place, ulps, bound(p))) {
      if (box.empty()) continue;
      for (int i = 0; i < 3; ++i) box.low[i] -= p.base[i], box.high[i] -= p.base[i];
      Rational from = low, to = high;
      if (p.reach == 0) {
        for (int i = 0; i < 3; ++i) narrow(from, to, along_[i], box.low[i], box.high[i]);
        if (auto member = found(k + 1, ulps, normals, from, to)) return member;
        continue;
      }
      narrow_along(box, from, to);
      if (auto member = found(k + 1, ulps, common(normals, normals_of(box, p.reach, from, to)), from, to))
        return member;
    }
    return std::nullopt;
  }
  /// By the part of a place along `along`, to which the normal adds nothing.
  void narrow_along(const RationalBox& box, Rational& low, Rational& high) const {
    const Rational length2 = dot(along_, along_);
    if (length2 == 0) return;
    Rational least(0), most(0);
    for (int i = 0; i < 3; ++i) {
      const Rational x = along_[i] * box.low[i], y = along_[i] * box.high[i];
      least += std::min(x, y), most += std::max(x, y);
    }
    narrow(low, high, length2, least, most);
  }
  /// The normals n with reach n + t along in the box for a t of [low, high], at most.
  RationalBox normals_of(const RationalBox& box, const Rational& reach, const Rational& low,
                         const Rational& high) const {
    RationalBox normals;
    for (int i = 0; i < 3; ++i) {
      const Rational a = along_[i] * low, b = along_[i] * high;
      const Rational x = (box.low[i] - std::max(a, b)) / reach, y = (box.high[i] - std::min(a, b)) / reach;
      normals.low[i] = std::min(x, y), normals.high[i] = std::max(x, y);
    }
    return normals;
  }
  /// No place has a larger component.
  Rational bound(const NormalOffset& p) const {
    Rational largest(0);
    for (int i = 0; i < 3; ++i) largest = std::max(largest, Rational(CGAL::abs(p.base[i]) + CGAL::abs(along_[i])));
    return largest + CGAL::abs(p.reach);
  }

  const Cone& cone_;
  const std::vector<NormalOffset>& places_;
  const RationalVector& along_;
};

}  // namespace

NearestTuple nearest_tuple(const GivenVector& normal, const Cone& cone, const std::vector<NormalOffset>& places,
                           const RationalVector& along) {
  const TupleIn tuple(cone, places, along);
  NearestTuple best = nearest<NearestTuple>(normal.scalar, [&](double ulps) { return tuple.found(normal, ulps); });
  if (dot(along, along) != 0) best.ulps.high = HUGE_VAL;
  best = with_slack(std::move(best), normal);
  for (const NormalOffset& p : places) best = with_slack(std::move(best), p.place);
  return best;
}

NearestPoint nearest_in_polygon(const GivenVector& given, const std::vector<RationalVector>& corners) {
  return nearest_in_polygon(std::vector<PointOffset>{{given, {0, 0, 0}}}, corners);
}

namespace {

/// The part of the polygon whose points have all their places, from number k on, within `ulps` of the given ones.
std::optional<RationalVector> point_within(const std::vector<PointOffset>& places, std::size_t k, double ulps,
                                           const std::vector<RationalVector>& polygon) {
  if (polygon.empty()) return std::nullopt;
  if (k == places.size()) return polygon.front();
  const RationalVector& offset = places[k].offset;
  Rational bound(0);
  for (const RationalVector& corner : polygon) {
    for (int i = 0; i < 3; ++i) bound = std::max(bound, Rational(CGAL::abs(Rational(corner[i] + offset[i]))));
  }
  for (const RationalBox& box : within(places[k].place, ulps, bound)) {
    std::vector<RationalVector> left = polygon;
    for (int i = 0; i < 3; ++i) {
      left = clipped(clipped(left, i, 1, Rational(box.high[i] - offset[i])), i, -1, Rational(box.low[i] - offset[i]));
    }
    if (auto point = point_within(places, k + 1, ulps, left)) return point;
  }
  return std::nullopt;
}

}  // namespace

NearestPoint nearest_in_polygon(const std::vector<PointOffset>& places, const std::vector<RationalVector>& corners) {
  const auto find = [&](double ulps) { return point_within(places, 0, ulps, corners); };
  NearestPoint best = nearest<NearestPoint>(places.front().place.scalar, find);
  for (const PointOffset& p : places) best = with_slack(std::move(best), p.place);
  return best;
}

// If a vector differs from the given one by more than 2^-8 of the given one's largest number, its distance exceeds
// `far_ulps`. For a nearer vector the unit is at most that of a number larger by that share.

double far_ulps(Scalar scalar) { return std::ldexp(1.0, digits(scalar) - 10); }

bool all_finite(const GivenVector& g) {
  return all_given(g) && std::isfinite(g.high[0]) && std::isfinite(g.high[1]) && std::isfinite(g.high[2]);
}
double near_unit(const GivenVector& g) { return unit_of(largest_of(g) * (1 + 0x1p-8), g.scalar); }
Vector<Interval> enclosed(const GivenVector& g) {
  const Interval slack(-g.slack, g.slack);
  return {Interval(g.high[0]) + g.low[0] + slack, Interval(g.high[1]) + g.low[1] + slack,
          Interval(g.high[2]) + g.low[2] + slack};
}
double ulps_across(double apart, const Interval& per_ulp, Scalar scalar) {
  if (!(apart > 0) || !(per_ulp.sup() > 0 && per_ulp.sup() < HUGE_VAL)) return 0;
  return std::clamp((of_bound(apart) / of_bound(per_ulp.sup())).inf(), 0.0, far_ulps(scalar));
}

namespace {

/// Lower bound of the distance between two numbers.
double gap(const Interval& a, const Interval& b) {
  const Interval between = a - b;
  return Bounds{between.inf(), between.sup()}.nearest_to_zero();
}

}  // namespace

double least_ulps(const GivenVector& given, const Form& form) {
  if (!all_finite(given)) return 0;
  const Interval per_ulp =
      (magnitude(form.direction[0]) + magnitude(form.direction[1]) + magnitude(form.direction[2])) * near_unit(given);
  return ulps_across(gap(dot(form.direction, minus(enclosed(given), form.from)), form.value), per_ulp, given.scalar);
}

double least_ulps(const GivenVector& given, const Vector<Interval>& point, const Interval& distance) {
  if (!all_finite(given)) return 0;
  const Interval per_ulp = root(Interval(3)) * near_unit(given);
  return ulps_across(gap(root(norm2(minus(enclosed(given), point))), distance), per_ulp, given.scalar);
}

double least_ulps_together(const GivenVector& normal, const GivenVector& place, const Vector<Interval>& base,
                           const Interval& reach) {
  if (!all_finite(normal) || !all_finite(place)) return 0;
  const Vector<Interval> n = enclosed(normal), x = enclosed(place);
  const Interval per_ulp = Interval(near_unit(place)) + magnitude(reach) * near_unit(normal);
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    most = std::max(most, ulps_across(gap(base[i] + reach * n[i], x[i]), per_ulp, place.scalar));
  }
  return most;
}

}  // namespace nearmiss::oracle
