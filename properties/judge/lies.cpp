#include "properties/judge/lies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "corpus/generator/case_builder.hpp"
#include "impl/catalogue/query_ids.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/judge.hpp"
#include "properties/judge/bodies.hpp"

namespace nearmiss {

namespace {

using namespace bodies;

// Numbers and vectors with slack: if the operands move within their slacks, the result moves within its own.

Number operator+(const Number& a, const Number& b) { return {a.at + b.at, a.slack + b.slack}; }
Number operator-(const Number& a, const Number& b) { return {a.at - b.at, a.slack + b.slack}; }
Number operator*(const Number& a, const Number& b) {
  return {a.at * b.at, std::abs(a.at) * b.slack + a.slack * (std::abs(b.at) + b.slack)};
}
Number magnitude(const Number& a) { return {std::abs(a.at), a.slack}; }
bool surely_positive(const Number& a) { return a.at > a.slack; }
bool surely_negative(const Number& a) { return -a.at > a.slack; }
bool surely_zero(const Number& a) { return a.at == 0 && a.slack == 0; }
/// The divisor is certainly not zero.
Number operator/(const Number& a, const Number& b) {
  const Real least = std::abs(b.at) - b.slack;
  return {a.at / b.at, (a.slack + std::abs(a.at / b.at) * b.slack) / least};
}

Vector operator+(const Vector& a, const Vector& b) { return {plus(a.at, b.at), a.slack + b.slack}; }
Vector operator-(const Vector& a, const Vector& b) { return {minus(a.at, b.at), a.slack + b.slack}; }
Vector operator*(const Vector& a, const Number& s) {
  return {scaled(a.at, s.at), length(a.at) * s.slack + a.slack * (std::abs(s.at) + s.slack)};
}
Real slack_of_product(const Vector& a, const Vector& b) {
  return length(a.at) * b.slack + a.slack * (length(b.at) + b.slack);
}
Number dot(const Vector& a, const Vector& b) { return {bodies::dot(a.at, b.at), slack_of_product(a, b)}; }
Vector cross(const Vector& a, const Vector& b) { return {bodies::cross(a.at, b.at), slack_of_product(a, b)}; }
Number length(const Vector& a) { return {bodies::length(a.at), a.slack}; }
/// For a vector that is certainly not zero: |x / |x| - y / |y|| <= 2 |x - y| / |x|.
Vector unit(const Vector& a) { return {scaled(a.at, 1 / bodies::length(a.at)), 2 * a.slack / bodies::length(a.at)}; }

/// Reads the inputs of a case in order.
class Inputs {
 public:
  Inputs(const Case& c, std::span<const double> widening) : values_(c.values), widening_(widening) {}

  Number number() {
    const std::size_t i = at_++;
    return {values_[i], more_than(widening_[i])};
  }
  Vector vector() {
    Vector v{};
    Real slack2 = 0;
    for (Real& x : v.at) {
      const Number n = number();
      x = n.at, slack2 += n.slack * n.slack;
    }
    v.slack = more_than(std::sqrt(slack2));
    return v;
  }
  std::vector<Vector> vectors(int count) {
    std::vector<Vector> all;
    for (int i = 0; i < count; ++i) all.push_back(vector());
    return all;
  }
  Body point() { return hull(vectors(1)); }
  Body segment() { return hull(vectors(2)); }
  Body triangle() { return hull(vectors(3)); }
  Body sphere() {
    const Vector center = vector();
    return ball(center, number());
  }
  Body capsule() {
    const std::vector<Vector> ends = vectors(2);
    return hull(ends, number());
  }
  Body aabox() {
    const Vector low = vector();
    return upright_box(low, vector());
  }
  struct Turned {
    Vector center, half;
    Axes axes;
    Body body() const { return turned_box(center, half, axes); }
    Vector axis(int k) const { return {axes.at[k], axes.slack}; }
  };
  Turned turned() {
    const Vector center = vector(), half = vector();
    std::array<Real, 4> q;
    Real slack2 = 0;
    for (Real& x : q) {
      const Number n = number();
      x = n.at, slack2 += n.slack * n.slack;
    }
    return {center, half, axes_of(q, more_than(std::sqrt(slack2)))};
  }
  Body box() { return turned().body(); }
  struct HalfSpace {
    Vector normal;
    Number offset;
    bool is_known() const { return bodies::length(normal.at) > 4 * normal.slack; }
    /// The least distance of a point of the body's core from the plane, negative behind it.
    Number least_height(const Body& body) const {
      const Vector out = unit(normal);
      const Real furthest = body.size() + bodies::length(body.middle()) + body.slack;
      const Number core{-body.reach(scaled(out.at, -1)), body.slack + out.slack * furthest};
      return core + offset / length(normal);
    }
  };
  HalfSpace halfspace() {
    const Vector normal = vector();
    return {normal, number()};
  }
  Motion moving_point() {
    const Vector from = vector();
    return {from, vector(), {0, 0}};
  }
  Motion moving_sphere() {
    const Vector from = vector();
    const Number radius = number();
    return {from, vector(), radius};
  }
  Number time_limit() {
    const Number limit = number();
    const bool forever = number().at != 0;
    return forever ? Number{infinite, 0} : limit;
  }

 private:
  /// One more part in 2^10 covers the rounding of what follows: the widening is at least 2^-44 of all numbers of the
  /// group, and long double has a precision of 2^-64.
  static Real more_than(Real slack) { return slack * (1 + 0x1p-10L); }

  std::span<const double> values_;
  std::span<const double> widening_;
  std::size_t at_ = 0;
};

/// Turns certain bounds into lies.
class Liar {
 public:
  Liar(Scalar scalar, std::uint64_t salt) : scalar_(scalar), random_(salt) {}

  std::vector<Lie> take_lies() { return std::move(lies_); }

  void surely(bool yes) {
    Answer a;
    a.yes = !yes, a.given = 0;
    lies_.push_back({Topic::decision, a});
  }
  /// Every answer with that decision has output `leaf` in [low, high]; `leaf` belongs to a vector with numbers up to
  /// `largest`. A lie lies outside [low, high], but inside [least, most].
  void within(Topic topic, std::size_t leaf, Real low, Real high, Real largest, bool yes = true, Real least = -infinite,
              Real most = infinite) {
    if (!(low <= high)) return;
    const Real size = std::max({std::abs(low), std::abs(high), std::abs(largest)});
    if (!(size < largest_finite(scalar_) / 4)) return;
    const bool above = random_.one_in(2);
    const Real end = above ? high : low, side = above ? 1 : -1;
    const Real wrong = end + side * (by(high - low, size) + pad(size));
    const double wrong_value = nearest(wrong);
    if (!std::isfinite(wrong_value) || !(wrong_value >= least && wrong_value <= most) ||
        !(side * (wrong_value - end) >= pad(std::max<Real>(size, std::abs(wrong_value))) / 2))
      return;
    Answer a;
    a.yes = yes, a.given = std::uint64_t{1} << leaf, a.values[leaf] = wrong_value;
    lies_.push_back({topic, a});
  }
  void about(Topic topic, std::size_t leaf, const Number& x, Real largest, bool yes = true, Real least = -infinite,
             Real most = infinite) {
    within(topic, leaf, x.at - x.slack, x.at + x.slack, largest, yes, least, most);
  }
  /// One number of a vector that lies within its slack of another vector.
  void about(Topic topic, std::size_t leaf, const Vector& x) {
    const std::size_t k = random_.below(3);
    about(topic, leaf + k, {x.at[k], x.slack}, bodies::length(x.at) + x.slack);
  }
  /// A vector as a whole. The caller knows that every vector within `off` of it is wrong too.
  void wrong_point(std::size_t leaf, const Point& x, Real off) {
    Answer a;
    a.given = std::uint64_t{7} << leaf;
    Real moved = 0, size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      a.values[leaf + k] = nearest(x[k]);
      moved += std::abs(a.values[leaf + k] - x[k]), size = std::max(size, std::abs(x[k]));
    }
    if (!(size < largest_finite(scalar_) / 4) || !(off > moved + pad(size))) return;
    a.yes = true;
    lies_.push_back({Topic::place, a});
  }
  std::size_t below(std::size_t n) { return random_.below(n); }
  bool is_a_time(Real t) const { return t < largest_finite(scalar_) / 4; }

 private:
  double nearest(Real x) const { return scalar_ == Scalar::float32 ? double(float(x)) : double(x); }
  /// More than one ulp of the vector's largest number, given or exact, plus the rounding of the lie.
  Real pad(Real size) const {
    constexpr Real ulps = 16;
    const Real smallest = scalar_ == Scalar::float32 ? 0x1p-149L : 0x1p-1074L;
    return ulps * (2 * Real(unit_roundoff(scalar_)) * size + smallest);
  }
  /// Beyond the end by a small part of the range's width, by the size itself, by a large part of it, or up to the
  /// largest number.
  Real by(Real width, Real size) {
    switch (random_.below(8)) {
      case 0: return size;
      case 1: return 0x1p20L * size;
      case 2: return largest_finite(scalar_) - size;
      default: return 0x1p-6L * width;
    }
  }

  Scalar scalar_;
  Random random_;
  std::vector<Lie> lies_;
};

// Closest points.

Point direction(std::size_t axis) {
  Point e{};
  e[axis] = 1;
  return e;
}

/// The nearest point is as near as any point of any piece, and within the pieces' bounds.
void nearest_point(const std::vector<Body>& pieces, const Vector& p, Liar& out) {
  Real near = infinite, slack = 0;
  for (const Body& b : pieces) {
    near = std::min(near, bodies::length(minus(b.nearest(p.at), p.at)));
    slack = std::max(slack, b.slack);
  }
  const Real around = near + slack + 2 * p.slack;
  const std::size_t k = out.below(3);
  Real low = infinite, high = -infinite, largest = 0;
  for (const Body& b : pieces) {
    low = std::min(low, -b.reach(scaled(direction(k), -1)) - slack),
    high = std::max(high, b.reach(direction(k)) + slack);
    for (std::size_t j = 0; j < 3; ++j)
      largest = std::max({largest, b.reach(direction(j)), b.reach(scaled(direction(j), -1))});
  }
  out.within(Topic::place, k, std::max(low, p.at[k] - around), std::min(high, p.at[k] + around), largest);
  const Body& some = pieces[out.below(pieces.size())];
  const Point& corner = some.corners[out.below(some.corners.size())];
  out.wrong_point(0, corner, bodies::length(minus(corner, p.at)) - around);
}

std::vector<Body> edges_of(const std::vector<Vector>& corners) {
  std::vector<Body> edges;
  for (std::size_t i = 0; i < corners.size(); ++i)
    edges.push_back(hull({corners[i], corners[(i + 1) % corners.size()]}));
  return edges;
}
std::vector<Body> halves_of(const std::vector<Vector>& v) {
  return {hull({v[0], v[1], v[2]}), hull({v[0], v[2], v[3]})};
}

void closest_point_segment(Inputs in, Liar& out) {
  const std::vector<Body> pieces{hull(in.vectors(2))};
  nearest_point(pieces, in.vector(), out);
}
template <int corners>
void closest_point_perimeter(Inputs in, Liar& out) {
  const std::vector<Body> pieces = edges_of(in.vectors(corners));
  nearest_point(pieces, in.vector(), out);
}
void closest_point_rectangle(Inputs in, Liar& out) {
  const std::vector<Body> pieces = halves_of(in.vectors(4));
  nearest_point(pieces, in.vector(), out);
}

void closest_points_lines(Inputs in, Liar& out) {
  const std::vector<Vector> all = in.vectors(4);
  const Vector between = all[2] - all[0], normal = cross(all[1], all[3]);
  const std::size_t line = out.below(2);
  const Vector &p = all[2 * line], &d = all[2 * line + 1], &other = all[3 - 2 * line];
  if (bodies::length(normal.at) > 4 * normal.slack) {
    const Number along = dot(cross(between, other), normal) / dot(normal, normal);
    return out.about(Topic::place, 3 * line, p + d * along);
  }
  // A point off the line, in a perpendicular direction.
  Point off = bodies::cross(d.at, direction(out.below(3)));
  const Real n = bodies::length(off), turn = 2 * d.slack / bodies::length(d.at);
  if (!(n > 0) || !(turn < 0.25L)) return;
  const Real far = 4 * p.slack + 0x1p-8L * bodies::length(p.at);
  out.wrong_point(3 * line, plus(p.at, off, far / n), far * (1 - turn) - p.slack);
}

// Containment.

/// Projected along the axis: 1 if certainly in the triangle, -1 if certainly outside, 0 if unknown.
int side_of_triangle(const std::vector<Vector>& corners, std::size_t axis, const Vector& p) {
  const auto seen = [&](Vector v) {
    v.at[axis] = 0;
    return v;
  };
  const Body shadow = hull({seen(corners[0]), seen(corners[1]), seen(corners[2])}), point = ball(seen(p), {0, 0});
  if (surely_apart(point, shadow, gap_of(point, shadow))) return -1;
  int sign = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector part = cross(seen(corners[(i + 1) % 3] - p), seen(corners[(i + 2) % 3] - p));
    const Number area{part.at[axis], part.slack};
    const int own = surely_positive(area) ? 1 : surely_negative(area) ? -1 : 0;
    if (own == 0 || (i > 0 && own != sign)) return 0;
    sign = own;
  }
  return 1;
}
bool may_be_axis(const Vector& normal, std::size_t axis) {
  Real most = 0;
  for (const Real x : normal.at) most = std::max(most, std::abs(x));
  return std::abs(normal.at[axis]) + 2 * normal.slack >= most;
}
template <class Side>
void contained(const Vector& normal, int axis, const Side& side, Liar& out) {
  bool in = true, outside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (axis >= 0 ? k != std::size_t(axis) : !may_be_axis(normal, k)) continue;
    const int s = side(k);
    in = in && s > 0, outside = outside && s < 0;
  }
  if (in || outside) out.surely(in);
}
void point_in_triangle(Inputs in, Liar& out) {
  const std::vector<Vector> corners = in.vectors(3);
  const Vector normal = in.vector();
  const int axis = int(in.number().at);
  const Vector p = in.vector();
  contained(
      normal, axis, [&](std::size_t k) { return side_of_triangle(corners, k, p); }, out);
}
void point_in_rectangle(Inputs in, Liar& out) {
  const std::vector<Vector> v = in.vectors(4);
  const Vector normal = in.vector(), p = in.vector();
  const auto side = [&](std::size_t k) {
    const int first = side_of_triangle({v[0], v[1], v[2]}, k, p), second = side_of_triangle({v[0], v[2], v[3]}, k, p);
    return first > 0 || second > 0 ? 1 : first < 0 && second < 0 ? -1 : 0;
  };
  contained(normal, -1, side, out);
}

// Motions.

constexpr std::size_t time_leaf = 0, location_leaf = 1;

/// A contact lies within the body's bounds. After time 0 it is no further from the center's path than the radius.
void contact_place(const Motion& m, const Body& fixed, Real from, Real to, std::size_t leaf, Liar& out) {
  const std::size_t k = out.below(3);
  const Real thick = fixed.radius + fixed.slack,
             around = m.radius.at + m.radius.slack + m.from.slack + to * m.velocity.slack;
  const Real a = from > 0 ? m.at(from)[k] : -infinite, b = from > 0 ? m.at(to)[k] : infinite;
  Real largest = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    largest = std::max({largest, fixed.reach(direction(j)) + thick, fixed.reach(scaled(direction(j), -1)) + thick});
  }
  out.within(Topic::place, leaf + k, std::max(-fixed.reach(scaled(direction(k), -1)) - thick, std::min(a, b) - around),
             std::min(fixed.reach(direction(k)) + thick, std::max(a, b) + around), largest);
}

void hit(const Motion& m, const Body& fixed, Real from, Real to, std::size_t time, std::size_t location, Liar& out) {
  if (!out.is_a_time(to)) return;
  out.surely(true);
  out.within(Topic::time, time, from, to, 0, true, 0);
  contact_place(m, fixed, from, to, location, out);
}

/// The time at which a plane in front is reached; empty if none.
struct Crossing {
  bool surely = false, surely_not = false;
  Number time{};
};
Crossing crossing_of(const Number& height, const Number& approach) {
  Crossing c;
  c.surely_not = surely_negative(height) || surely_negative(approach);
  c.surely = surely_positive(height) && surely_positive(approach);
  if (c.surely) c.time = height / approach;
  return c;
}

void plane_contact(const Motion& m, const Crossing& c, const Vector& to_contact, Liar& out) {
  if (c.surely_not) out.surely(false);
  if (!c.surely || !out.is_a_time(c.time.at + c.time.slack)) return;
  out.surely(true);
  out.about(Topic::time, time_leaf, c.time, 0, true, 0);
  out.about(Topic::place, location_leaf, m.from + m.velocity * c.time + to_contact);
}
void moving_point_plane(Inputs in, Liar& out) {
  const Motion m = in.moving_point();
  const Vector normal = in.vector();
  const Number offset = in.number();
  const Number approach = Number{0, 0} - dot(normal, m.velocity);
  plane_contact(m, crossing_of(dot(normal, m.from) + offset, approach), {}, out);
}
void moving_sphere_plane(Inputs in, Liar& out) {
  const Motion m = in.moving_sphere();
  const Vector normal = in.vector();
  const Number offset = in.number();
  if (!(bodies::length(normal.at) > 4 * normal.slack)) return;
  const Number height = (dot(normal, m.from) + offset) / length(normal),
               approach = Number{0, 0} - dot(unit(normal), m.velocity);
  Crossing c = crossing_of(height - m.radius, approach);
  c.surely_not = surely_negative(height + m.radius) || surely_negative(approach);
  plane_contact(m, c, unit(normal) * (Number{0, 0} - m.radius), out);
}

struct Front {
  Number toward, height;  // n . v, n . (p - v0)
  Vector normal;
};
Front front_of(const std::vector<Vector>& corners, const Motion& m) {
  const Vector n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  return {dot(n, m.velocity), dot(n, m.from - corners[0]), n};
}

/// What is certain about a moving shape and one side of a triangle.
struct Hit {
  bool surely = false, surely_not = false;
  Real not_before = 0, by = infinite;
};
Hit front_hit(const Motion& m, const std::vector<Vector>& corners) {
  const Front f = front_of(corners, m);
  const Passage p = passage_of(m, hull(corners));
  Hit h;
  h.not_before = p.not_before;
  h.surely_not = p.surely_never || surely_positive(f.toward) || surely_negative(f.height);
  if (h.surely_not || !surely_negative(f.toward) || !surely_positive(f.height)) return h;
  for (int i = 0; i < 3; ++i) {
    const Number moment = dot(m.velocity, cross(corners[i] - m.from, corners[(i + 1) % 3] - m.from));
    if (!surely_negative(moment)) return h;
  }
  const Number time = f.height / (Number{0, 0} - f.toward);
  h.surely = true, h.not_before = std::max(h.not_before, time.at - time.slack), h.by = time.at + time.slack;
  return h;
}
/// First the gate of a sphere, then the general rule.
Hit gated_hit(const Motion& m, const std::vector<Vector>& corners) {
  const Front f = front_of(corners, m);
  const Passage p = passage_of(m, hull(corners));
  const Number depth = f.height + m.radius * length(f.normal);
  Hit h;
  h.not_before = p.not_before;
  h.surely_not = p.surely_never || surely_positive(f.toward) || surely_negative(depth);
  const bool stays = surely_zero(length(m.velocity));
  const bool reaches = surely_positive(m.radius - length(m.from - corners[0])) || surely_positive(depth);
  h.surely = p.surely_meet && surely_positive(m.radius) && (stays || surely_negative(f.toward)) && reaches;
  if (h.surely) h.by = p.by;
  return h;
}
template <class HitOf>
void moving_past_triangles(const Motion& m, const std::vector<std::vector<Vector>>& triangles, HitOf hit_of,
                           Liar& out) {
  Hit all{false, true, infinite, infinite};
  std::vector<Vector> corners;
  for (const std::vector<Vector>& t : triangles) {
    const Hit h = hit_of(m, t);
    all.surely = all.surely || h.surely, all.surely_not = all.surely_not && h.surely_not;
    if (!h.surely_not) all.not_before = std::min(all.not_before, h.not_before);
    all.by = std::min(all.by, h.by);
    corners.insert(corners.end(), t.begin(), t.end());
  }
  if (all.surely_not) out.surely(false);
  if (all.surely) hit(m, hull(corners), all.not_before, all.by, time_leaf, location_leaf, out);
}
std::vector<std::vector<Vector>> halves(const std::vector<Vector>& v) {
  return {{v[0], v[1], v[2]}, {v[0], v[2], v[3]}};
}

void moving_point_triangle(Inputs in, Liar& out) {
  const Motion m = in.moving_point();
  moving_past_triangles(m, {in.vectors(3)}, front_hit, out);
}
void moving_point_rectangle(Inputs in, Liar& out) {
  const Motion m = in.moving_point();
  moving_past_triangles(m, halves(in.vectors(4)), front_hit, out);
}
void moving_sphere_triangle(Inputs in, Liar& out) {
  const Motion m = in.moving_sphere();
  moving_past_triangles(m, {in.vectors(3)}, gated_hit, out);
}
void moving_sphere_rectangle(Inputs in, Liar& out) {
  const Motion m = in.moving_sphere();
  moving_past_triangles(m, halves(in.vectors(4)), gated_hit, out);
}

/// A point that crosses the faces of a box that may be flat: while one coordinate passes from one side to the other,
/// the others stay inside.
bool surely_crosses(const Motion& m, const Body& box) {
  const Point at = box.local(m.from.at);
  Point step;
  for (int k = 0; k < 3; ++k) step[k] = bodies::dot(box.axes[k], m.velocity.at);
  for (int k = 0; k < 3; ++k) {
    if (step[k] == 0) continue;
    const Real middle = -at[k] / step[k], spread = box.half[k] / std::abs(step[k]);
    const Real late = middle + spread,
               slack = m.from.slack + box.slack + 2 * std::max<Real>(late, 0) * m.velocity.slack;
    const Real more = 2 * slack / std::abs(step[k]), first = middle - spread - more, last = late + more;
    if (!(first > 0)) continue;
    bool within = true;
    for (int j = 0; j < 3; ++j) {
      for (const Real t : {first, last}) {
        within = within && (j == k || std::abs(at[j] + step[j] * t) + 2 * slack < box.half[j]);
      }
    }
    if (within) return true;
  }
  return false;
}
Real leaves_flat_box_by(const Motion& m, const Body& box) {
  return 2 * (bodies::length(minus(box.center, m.from.at)) + box.size() + m.from.slack + box.slack) /
         std::max<Real>(bodies::length(m.velocity.at) - m.velocity.slack, 0);
}

/// The general rule for a point or a sphere that enters. A point strictly inside never enters.
void entering(const Motion& m, const Body& fixed, std::size_t time, std::size_t location, Liar& out) {
  const Passage p = passage_of(m, fixed);
  if (p.surely_never) return out.surely(false);
  const bool has_size = surely_positive(m.radius);
  if (p.surely_meet && (has_size || p.surely_start_apart))
    return hit(m, fixed, p.not_before, p.by, time, location, out);
  const bool is_point = surely_zero(m.radius);
  if (is_point && (p.surely_start_overlapping || fixed.depth(m.from.at) > m.from.slack + fixed.slack))
    return out.surely(false);
  if (!fixed.is_box()) return;
  // Deep enough in the box at some time, or through the box.
  const Real about = time_of_least_distance(m, fixed, infinite);
  const Real through = fixed.depth(m.at(about)) - fixed.slack - m.from.slack - about * m.velocity.slack;
  const bool enters = through > 0 || surely_crosses(m, fixed);
  if (enters && p.surely_start_apart)
    hit(m, fixed, p.not_before, through > 0 ? about : leaves_flat_box_by(m, fixed), time, location, out);
}
template <Body (Inputs::*fixed)()>
void moving_point_past(Inputs in, Liar& out) {
  const Motion m = in.moving_point();
  entering(m, (in.*fixed)(), time_leaf, location_leaf, out);
}
template <Body (Inputs::*fixed)()>
void moving_sphere_past(Inputs in, Liar& out) {
  const Motion m = in.moving_sphere();
  entering(m, (in.*fixed)(), time_leaf, location_leaf, out);
}
void moving_point_aabox(Inputs in, Liar& out) {
  const Motion m = in.moving_point();
  constexpr std::size_t location = 1, time = 4;  // after the flag
  entering(m, in.aabox(), time, location, out);
}
/// Whether a moving point certainly starts deep in a box, is deep in it at the time `about`, or crosses it.
struct PassageOfBox {
  bool starts_in = false, is_in = false, crosses = false;
};
PassageOfBox passage_of_box(const Motion& m, const Body& box, Real about) {
  return {box.depth(m.from.at) > box.slack + m.from.slack,
          box.depth(m.at(about)) > box.slack + m.from.slack + about * m.velocity.slack, surely_crosses(m, box)};
}
/// The last time within the bounds of the body, at least where the point is certainly in it at the time `about`.
void last_time(const Motion& m, const Body& fixed, Real about, std::size_t leaf, Liar& out) {
  const Real speed = bodies::length(m.velocity.at) - m.velocity.slack;
  const Real way = bodies::length(minus(fixed.middle(), m.from.at)) + fixed.size() + fixed.radius + fixed.slack;
  const Real by = (way + m.from.slack) / std::max<Real>(speed, 0);
  if (out.is_a_time(by)) out.within(Topic::time, leaf, about, by, 0, true, 0);
}
template <Body (Inputs::*fixed)()>
void span(Inputs in, Liar& out) {
  constexpr std::size_t enter = 0, exit = 1;
  const Motion m = in.moving_point();
  const Body body = (in.*fixed)();
  const Passage p = passage_of(m, body);
  if (p.surely_never) return out.surely(false);
  Real by = p.surely_start_overlapping ? 0 : p.by;
  bool meets = p.surely_meet || p.surely_start_overlapping;
  if (body.is_box()) {
    const Real about = time_of_least_distance(m, body, infinite);
    const PassageOfBox passage = passage_of_box(m, body, about);
    meets = passage.starts_in || passage.is_in || passage.crosses;
    by = passage.starts_in ? 0 : passage.is_in ? about : leaves_flat_box_by(m, body);
  }
  if (!meets || !out.is_a_time(by)) return;
  out.surely(true);
  out.within(Topic::time, enter, by > 0 ? p.not_before : 0, by, 0, true, 0);
  last_time(m, body, by > 0 ? p.not_before : 0, exit, out);
}
void ray_aabox(Inputs in, Liar& out) {
  const Motion m = in.moving_point();
  const Body box = in.aabox();
  const Passage p = passage_of(m, box);
  if (p.surely_never) return out.surely(false);
  const auto [starts_in, is_in, crosses] = passage_of_box(m, box, time_of_least_distance(m, box, infinite));
  if (!starts_in && !is_in && !crosses) return;
  out.surely(true);
  constexpr std::size_t location = 1;  // after the flag
  contact_place(m, box, 0, starts_in ? 0 : leaves_flat_box_by(m, box), location, out);
}
void moving_point_sphere(Inputs in, Liar& out) {
  const Motion m = in.moving_point();
  const Body fixed = in.sphere();
  const bool solid = in.number().at != 0;
  const Passage p = passage_of(m, fixed);
  if (p.surely_never) return out.surely(false);
  if (p.surely_start_apart) {
    if (p.surely_meet) hit(m, fixed, p.not_before, p.by, time_leaf, location_leaf, out);
    return;
  }
  if (!p.surely_start_overlapping) return;
  if (solid) return hit(m, fixed, 0, 0, time_leaf, location_leaf, out);
  const Number speed = length(m.velocity), start = distance_at(m, fixed, 0);
  if (surely_zero(speed)) return out.surely(false);
  if (!(speed.at > 2 * speed.slack)) return;
  const Real way = fixed.radius + fixed.slack + m.from.slack;
  hit(m, fixed, (-start.at - start.slack) / (speed.at + speed.slack), 2 * way / (speed.at - speed.slack), time_leaf,
      location_leaf, out);
}
template <Body (Inputs::*fixed)()>
void moving_sphere_passes(Inputs in, Liar& out) {
  const Motion m = in.moving_sphere();
  const Body body = (in.*fixed)();
  const Number limit = in.time_limit();
  if (passage_of(m, body, limit.at + limit.slack).surely_never) return out.surely(false);
  if (passage_of(m, body, std::max<Real>(0, limit.at - limit.slack)).surely_meet) out.surely(true);
}

// Overlaps.

void overlapping(const Body& a, const Body& b, Liar& out) {
  const Gap g = gap_of(a, b);
  if (surely_apart(a, b, g))
    out.surely(false);
  else if (surely_overlap(a, b, g))
    out.surely(true);
}
template <Body (Inputs::*first)(), Body (Inputs::*second)()>
void overlap(Inputs in, Liar& out) {
  const Body a = (in.*first)();
  overlapping(a, (in.*second)(), out);
}

template <Body (Inputs::*first)(), Inputs::HalfSpace (Inputs::*second)()>
void overlap(Inputs in, Liar& out) {
  const Body a = (in.*first)();
  const Inputs::HalfSpace b = (in.*second)();
  if (!b.is_known()) return;
  const Number above = b.least_height(a) - Number{a.radius, 0};
  if (surely_positive(above)) out.surely(false);
  if (surely_negative(above)) out.surely(true);
}

constexpr std::size_t depth_leaf = 0, normal_leaf = 1, contact_leaf = 4;

/// True if the bodies certainly overlap.
bool about_depth(const Number& depth, Liar& out) {
  if (surely_positive(depth)) {
    out.surely(true);
    out.about(Topic::depth, depth_leaf, depth, 0, true, 0);
    return true;
  }
  if (!surely_negative(depth)) return false;
  out.surely(false);
  out.about(Topic::depth, depth_leaf, depth, 0, false, -infinite, 0);
  return false;
}
void within_ball(const Vector& center, const Number& radius, std::size_t leaf, Liar& out) {
  const std::size_t k = out.below(3);
  const Real reach = radius.at + radius.slack + center.slack;
  out.within(Topic::place, leaf + k, center.at[k] - reach, center.at[k] + reach, bodies::length(center.at) + reach);
}
/// With each of its points near to the other, and each normal, a bound: every right normal n has n . (to - from) at
/// least as large as the distance of the cores.
template <Body (Inputs::*first)(), Body (Inputs::*second)()>
void signed_distance(Inputs in, Liar& out) {
  const Body a = (in.*first)(), b = (in.*second)();
  const Gap g = gap_of(a, b);
  const auto dimensions = [](const Body& body) { return body.is_box() ? 3 : int(body.corners.size()) - 1; };
  const bool may_have_volume = dimensions(a) + dimensions(b) > 2;
  const Real slack = a.slack + b.slack, radii = a.radius + b.radius,
             least = may_have_volume ? g.low : std::max(g.low, -radii);
  constexpr std::size_t distance_leaf = 0, point_leaf = 4;
  out.within(Topic::number, distance_leaf, least - slack, g.high + slack, 0);
  const std::size_t k = out.below(3), which = out.below(2);
  const Body& body = which == 0 ? a : b;
  const Real thick = body.radius + body.slack, low = -body.reach(scaled(direction(k), -1)) - thick,
             high = body.reach(direction(k)) + thick;
  out.within(Topic::place, point_leaf + 3 * which + k, low, high, body.size() + bodies::length(body.middle()) + thick);
  const Point way = minus(g.to, g.from);
  const Real length = bodies::length(way), cosine = (least + radii - 2 * slack) / (length + 2 * slack);
  if (!(cosine > 0.5L) || !(cosine <= 1)) return;
  const Real turn = std::acos(cosine), angle = std::acos(std::clamp<Real>(way[k] / length, -1, 1));
  out.within(Topic::number, normal_leaf + k, std::cos(std::min<Real>(angle + turn, std::numbers::pi_v<Real>)),
             std::cos(std::max<Real>(angle - turn, 0)), 1);
}
/// The distance, the normal, and how far along each coordinate the points may be: the first one is as far from the core
/// as the radius, the second one as the height.
template <Body (Inputs::*first)(), Inputs::HalfSpace (Inputs::*second)()>
void signed_distance(Inputs in, Liar& out) {
  const Body a = (in.*first)();
  const Inputs::HalfSpace b = (in.*second)();
  if (!b.is_known()) return;
  constexpr std::size_t distance_leaf = 0, point_leaf = 4;
  const Number height = b.least_height(a);
  const Real size = a.size() + bodies::length(a.middle());
  out.about(Topic::number, distance_leaf, height - Number{a.radius, 0}, 0);
  out.about(Topic::number, normal_leaf, unit(b.normal * Number{-1, 0}));
  const std::size_t k = out.below(3), which = out.below(2);
  const Real away = (which == 0 ? a.radius : std::abs(height.at) + height.slack) + a.slack;
  out.within(Topic::place, point_leaf + 3 * which + k, -a.reach(scaled(direction(k), -1)) - away,
             a.reach(direction(k)) + away, size + away);
}
/// Where the core is at the time of contact, it is as far from the contact as its radius. At the start it may be
/// deeper.
template <Body (Inputs::*first)(), Inputs::HalfSpace (Inputs::*second)()>
void cast(Inputs in, Liar& out) {
  const Body a = (in.*first)();
  const Vector velocity = in.vector();
  const Inputs::HalfSpace b = (in.*second)();
  if (!b.is_known()) return;
  const Number height = b.least_height(a), gap = height - Number{a.radius, 0},
               approach = Number{0, 0} - dot(unit(b.normal), velocity);
  const bool starts_apart = surely_positive(gap);
  if (starts_apart && surely_negative(approach)) return out.surely(false);
  if (!surely_negative(gap) && !(starts_apart && surely_positive(approach))) return;
  const Number time = starts_apart ? gap / approach : Number{0, 0};
  if (!out.is_a_time(time.at + time.slack)) return;
  out.surely(true);
  out.about(Topic::time, time_leaf, time, 0, true, 0);
  const std::size_t k = out.below(3);
  const Vector way = velocity * time;
  const Real size = a.size() + bodies::length(a.middle()) + bodies::length(way.at),
             away = (starts_apart ? a.radius : std::abs(height.at) + height.slack) + a.slack + way.slack;
  out.within(Topic::place, location_leaf + k, way.at[k] - a.reach(scaled(direction(k), -1)) - away,
             way.at[k] + a.reach(direction(k)) + away, size + away);
}
void sphere_sphere_penetration(Inputs in, Liar& out) {
  const Vector center1 = in.vector();
  const Number radius1 = in.number();
  const Vector center2 = in.vector();
  const Number radius2 = in.number();
  if (about_depth(radius1 + radius2 - length(center2 - center1), out)) within_ball(center1, radius1, contact_leaf, out);
}
void sphere_plane_penetration(Inputs in, Liar& out) {
  const Vector center = in.vector();
  const Number radius = in.number();
  const Vector normal = in.vector();
  const Number offset = in.number();
  if (!(bodies::length(normal.at) > 4 * normal.slack)) return;
  const Number height = (dot(normal, center) + offset) / length(normal);
  if (!about_depth(radius - height, out)) return;
  out.about(Topic::number, normal_leaf, unit(normal));
  out.about(Topic::place, contact_leaf, center - unit(normal) * radius);
}
void box_plane_penetration(Inputs in, Liar& out) {
  const Inputs::Turned box = in.turned();
  const Vector normal = in.vector();
  const Number offset = in.number();
  if (!(bodies::length(normal.at) > 4 * normal.slack)) return;
  const Body body = box.body();
  const Real n = bodies::length(normal.at);
  Number lowest{infinite, 0};
  const std::size_t some = out.below(8);
  Vector corner{};
  bool behind = false;
  for (std::size_t i = 0; i < 8; ++i) {
    Vector x{body.center, body.slack};
    for (std::size_t k = 0; k < 3; ++k)
      x.at = plus(x.at, body.axes[k], (i >> k & 1) != 0 ? body.half[k] : -body.half[k]);
    const Number height = (dot(normal, x) + offset) / length(normal);
    if (height.at < lowest.at) lowest = height;
    lowest.slack = std::max(lowest.slack, height.slack);
    if (i == some) corner = x, behind = surely_negative(height);
  }
  if (!(n > 0) || !about_depth(Number{0, 0} - lowest, out) || !behind) return;
  constexpr std::size_t corners = 4, numbers = 4;
  out.about(Topic::place, corners + numbers * some + 1, corner);
}
void sphere_box_penetration(Inputs in, Liar& out) {
  const Vector center = in.vector();
  const Number radius = in.number();
  const Body box = in.box(), point = ball(center, {0, 0});
  const Gap g = gap_of(point, box);
  const Number slack{0, box.slack + center.slack};
  if (surely_apart(point, box, g)) {
    const Number distance{0.5L * (g.low + g.high), 0.5L * (g.high - g.low) + slack.slack};
    if (about_depth(radius - distance, out)) within_ball(center, distance, contact_leaf, out);
    return;
  }
  const Real inside = box.depth(center.at);
  if (inside <= slack.slack) return;
  if (about_depth(radius + Number{inside, slack.slack}, out)) within_ball(center, radius, contact_leaf, out);
}
void box_box_penetration(Inputs in, Liar& out) {
  const Inputs::Turned box1 = in.turned(), box2 = in.turned();
  const Body a = box1.body(), b = box2.body();
  const Gap g = gap_of(a, b);
  const Real slack = a.slack + b.slack;
  if (surely_apart(a, b, g)) {
    out.surely(false);
    return out.within(Topic::depth, depth_leaf, -g.high - slack, 0, 0, false, -infinite, 0);
  }
  const Real least = least_depth(a, b, g) - slack;
  if (!(least > 0)) return;
  out.surely(true);
  const Vector between = box2.center - box1.center;
  Real most = infinite;
  for (int i = 0; i < 6; ++i) {
    const Point& u = i < 3 ? a.axes[i] : b.axes[i - 3];
    const Real overlap = a.reach(u) - bodies::dot(u, a.center) + b.reach(u) - bodies::dot(u, b.center) -
                         std::abs(bodies::dot(u, between.at));
    most = std::min(most, overlap);
  }
  out.within(Topic::depth, depth_leaf, least, most + slack, 0, true, 0);
  const std::size_t k = out.below(3);
  const Point e = direction(k), back = scaled(e, -1);
  constexpr std::size_t contact = 5;  // after the axis
  // Half the depth away from a point of a box: beside a larger box that point may be in neither box.
  const Real off = (most + slack) / 2 + slack;
  out.within(Topic::place, contact + k, std::min(-a.reach(back), -b.reach(back)) - off,
             std::max(a.reach(e), b.reach(e)) + off,
             std::max(bodies::length(a.center) + a.size(), bodies::length(b.center) + b.size()));
}

// Pairs of boxes.

Number of_axis(const Vector& x, int k) { return {x.at[k], x.slack}; }

void box_box_info(Inputs in, Liar& out) {
  const Inputs::Turned box1 = in.turned(), box2 = in.turned();
  const Vector between = box2.center - box1.center;
  constexpr std::size_t cosines = 9, between1 = 27;
  out.about(Topic::place, 6, between);
  const int i = int(out.below(3)), j = int(out.below(3));
  out.about(Topic::number, cosines + std::size_t(3 * i + j), dot(box1.axis(i), box2.axis(j)), 1);
  out.about(Topic::place, between1 + std::size_t(i), dot(box1.axis(i), between), bodies::length(between.at));
}
Vector pair_axis(const Inputs::Turned& box1, const Inputs::Turned& box2, int k) {
  return k < 3 ? box1.axis(k) : k < 6 ? box2.axis(k - 3) : cross(box1.axis((k - 6) / 3), box2.axis((k - 6) % 3));
}
void box_box_projected_distance(Inputs in, Liar& out) {
  const Inputs::Turned box1 = in.turned(), box2 = in.turned();
  const Vector axis = pair_axis(box1, box2, int(in.number().at));
  Number value = magnitude(dot(box2.center - box1.center, axis));
  for (int i = 0; i < 3; ++i) {
    value = value - of_axis(box1.half, i) * magnitude(dot(box1.axis(i), axis)) -
            of_axis(box2.half, i) * magnitude(dot(box2.axis(i), axis));
  }
  out.about(Topic::number, 0, value, 0);
}
void box_box_separating_axis(Inputs in, Liar& out) {
  const Inputs::Turned box1 = in.turned(), box2 = in.turned();
  out.about(Topic::number, 0, pair_axis(box1, box2, int(in.number().at)));
}
void box_box_parallel_axis(Inputs in, Liar& out) {
  const Inputs::Turned box1 = in.turned(), box2 = in.turned();
  const Number least = Number{1, 0} - in.number();
  bool any = false, none = true;
  for (int i = 0; i < 9; ++i) {
    const Number beyond = magnitude(dot(box1.axis(i / 3), box2.axis(i % 3))) - least;
    any = any || surely_positive(beyond), none = none && surely_negative(beyond);
  }
  if (any || none) out.surely(any);
}
void box_box_conservative(Inputs in, Liar& out) {
  const Inputs::Turned box1 = in.turned(), box2 = in.turned();
  const Number apart = length(box2.center - box1.center) - length(box1.half) - length(box2.half);
  if (surely_positive(apart)) out.surely(false);
  if (surely_negative(apart)) out.surely(true);
}

// Responses.

/// The direction after a response that removes `share` of the component along u.
void response(Inputs in, int share, Liar& out) {
  const Vector center = in.vector();
  in.number();  // the radius has no effect
  const Vector velocity = in.vector();
  const Number time = in.number();
  const Vector u = center + velocity * time - in.vector();
  const auto surely_some = [](const Vector& x) { return bodies::length(x.at) > 4 * x.slack; };
  if (!surely_some(velocity) || !surely_some(u)) return;
  const Vector v = unit(velocity), n = unit(u);
  out.about(Topic::number, 0, v - n * (dot(v, n) * Number{Real(share), 0}));
}
void bounce_direction(Inputs in, Liar& out) { response(in, 2, out); }
void slide_direction(Inputs in, Liar& out) { response(in, 1, out); }

struct Known {
  QueryId query;
  void (*lie)(Inputs in, Liar& out);
};
constexpr Known known[] = {
    {QueryId::closest_point_segment, closest_point_segment},
    {QueryId::closest_point_segment_unit, closest_point_segment},
    {QueryId::closest_point_triangle_perimeter, closest_point_perimeter<3>},
    {QueryId::closest_point_triangle_perimeter_edges, closest_point_perimeter<3>},
    {QueryId::closest_point_rectangle, closest_point_rectangle},
    {QueryId::closest_point_rectangle_perimeter, closest_point_perimeter<4>},
    {QueryId::closest_points_lines, closest_points_lines},
    {QueryId::point_in_triangle, point_in_triangle},
    {QueryId::point_in_rectangle, point_in_rectangle},
    {QueryId::moving_point_plane, moving_point_plane},
    {QueryId::moving_point_triangle, moving_point_triangle},
    {QueryId::moving_point_triangle_prepared, moving_point_triangle},
    {QueryId::moving_point_rectangle, moving_point_rectangle},
    {QueryId::moving_point_sphere, moving_point_sphere},
    {QueryId::moving_point_capsule, moving_point_past<&Inputs::capsule>},
    {QueryId::moving_point_box, moving_point_past<&Inputs::box>},
    {QueryId::moving_point_aabox, moving_point_aabox},
    {QueryId::ray_aabox, ray_aabox},
    {QueryId::moving_point_span_sphere, span<&Inputs::sphere>},
    {QueryId::moving_point_span_capsule, span<&Inputs::capsule>},
    {QueryId::moving_point_span_box, span<&Inputs::box>},
    {QueryId::moving_point_span_aabox, span<&Inputs::aabox>},
    {QueryId::moving_sphere_plane, moving_sphere_plane},
    {QueryId::moving_sphere_triangle, moving_sphere_triangle},
    {QueryId::moving_sphere_rectangle, moving_sphere_rectangle},
    {QueryId::moving_sphere_sphere, moving_sphere_past<&Inputs::sphere>},
    {QueryId::moving_sphere_box, moving_sphere_past<&Inputs::box>},
    {QueryId::moving_sphere_capsule, moving_sphere_past<&Inputs::capsule>},
    {QueryId::moving_sphere_passes_box, moving_sphere_passes<&Inputs::box>},
    {QueryId::moving_sphere_passes_sphere, moving_sphere_passes<&Inputs::sphere>},
    {QueryId::sphere_sphere_overlap, overlap<&Inputs::sphere, &Inputs::sphere>},
    {QueryId::sphere_box_overlap, overlap<&Inputs::sphere, &Inputs::box>},
    {QueryId::box_box_overlap, overlap<&Inputs::box, &Inputs::box>},
    {QueryId::sphere_triangle_overlap, overlap<&Inputs::sphere, &Inputs::triangle>},
    {QueryId::aabox_triangle_overlap, overlap<&Inputs::aabox, &Inputs::triangle>},
    {QueryId::sphere_sphere_penetration, sphere_sphere_penetration},
    {QueryId::sphere_plane_penetration, sphere_plane_penetration},
    {QueryId::box_plane_penetration, box_plane_penetration},
    {QueryId::sphere_box_penetration, sphere_box_penetration},
    {QueryId::box_box_penetration, box_box_penetration},
    {QueryId::box_box_info, box_box_info},
    {QueryId::box_box_projected_distance, box_box_projected_distance},
    {QueryId::box_box_separating_axis, box_box_separating_axis},
    {QueryId::box_box_parallel_axis, box_box_parallel_axis},
    {QueryId::box_box_conservative, box_box_conservative},
    {QueryId::bounce_direction, bounce_direction},
    {QueryId::slide_direction, slide_direction},
#define NEARMISS_OVERLAP(first, second) {QueryId::first##_##second##_overlap, overlap<&Inputs::first, &Inputs::second>},
#define NEARMISS_SIGNED_DISTANCE(first, second) \
  {QueryId::first##_##second##_signed_distance, signed_distance<&Inputs::first, &Inputs::second>},
#define NEARMISS_CAST_AS(query, first, second) {QueryId::query, cast<&Inputs::first, &Inputs::second>},
#include "impl/catalogue/grid.def"
};

const Known* known_of(const Query& query) {
  const auto* found =
      std::find_if(std::begin(known), std::end(known), [&](const Known& k) { return k.query == query.id; });
  return found == std::end(known) ? nullptr : found;
}

}  // namespace

std::string_view name_of(Topic topic) {
  switch (topic) {
    case Topic::decision: return "decision";
    case Topic::time: return "time";
    case Topic::depth: return "depth";
    case Topic::place: return "place";
    case Topic::number: return "number";
  }
  return "?";
}

std::vector<double> widening_of_lies(const Case& c, double backward, double beyond) {
  std::vector<double> wide = widening(*c.query, c.values, c.scalar, beyond * backward);
  const std::vector<double> bound = widening(*c.query, c.values, c.scalar, backward);
  for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = std::max(wide[i], beyond * bound[i]);
  return wide;
}

std::vector<double> bounds_for_lies(const Query& query, Scalar scalar) {
  constexpr double wide = 0x1p30;
  const Subject& fast = *find_subject(scalar == Scalar::float32 ? "collide-fast-float" : "collide-fast-double");
  std::vector<double> bounds;
  if (const Offering& o = fast.offering(query.name); o.offer != Offer::not_offered)
    bounds.push_back(o.contract.backward);
  if (scalar == Scalar::float64) bounds.push_back(wide);
  return bounds;
}

bool is_refuted(const Case& c, const Lie& lie, double backward) {
  collide::Contract contract;
  contract.backward = backward;
  return judge(c, lie.answer, contract, Detail::verdict).is_proved();
}

bool has_lies(const Query& query) { return known_of(query) != nullptr; }

std::vector<Lie> lies_about(const Case& c, std::span<const double> widening, std::uint64_t salt) {
  const Known* k = known_of(*c.query);
  if (k == nullptr) return {};
  Liar liar(c.scalar, salt);
  k->lie(Inputs(c, widening), liar);
  return liar.take_lies();
}

}  // namespace nearmiss
