#include "properties/features.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "oracles/requirements.hpp"
#include "properties/judge/bodies.hpp"

namespace nearmiss {
namespace {

using bodies::Body;
using bodies::Point;
using bodies::Real;

Point point_at(const Case& c, std::size_t i) { return {c.values[i], c.values[i + 1], c.values[i + 2]}; }
bodies::Vector exactly(const Case& c, std::size_t i) { return {point_at(c, i), 0}; }

// Rectangles.

bool has_rectangle(const Query& q) { return !q.operands.rectangles.empty(); }

bool is_true_rectangle(const Case& c) { return meets(c, Precondition::true_rectangle); }

struct Sides {
  Point first, second;
  bool exact;  ///< the sides have a right angle, and the corners are those of a parallelogram
};

Sides sides_of(const Case& c) {
  const Operands::Corners r = c.operands().rectangles.front();
  const Point v0 = point_at(c, r[0]), e = bodies::minus(point_at(c, r[1]), v0),
              f = bodies::minus(point_at(c, r[3]), v0), diagonal = bodies::minus(point_at(c, r[2]), v0);
  const bool sides = bodies::length(e) > 0 && bodies::length(f) > 0;
  return {e, f, sides && bodies::dot(e, f) == 0 && bodies::plus(e, f) == diagonal};
}

bool is_along_an_axis(const Point& x) { return std::count(x.begin(), x.end(), Real(0)) == 2; }

bool is_upright_rectangle(const Case& c) {
  const Sides s = sides_of(c);
  return s.exact && is_along_an_axis(s.first) && is_along_an_axis(s.second);
}
bool is_tilted_rectangle(const Case& c) {
  const Sides s = sides_of(c);
  return s.exact && !is_along_an_axis(s.first) && !is_along_an_axis(s.second);
}

// Pairs of boxes.

bool has_two_boxes(const Query& q) { return q.operands.quaternions.size() == 2; }

/// The box whose rotation begins at `quaternion`: its center and half extents are the six numbers before.
Body box_at(const Case& c, std::size_t quaternion) {
  const double* q = &c.values[quaternion];
  return bodies::turned_box(exactly(c, quaternion - 6), exactly(c, quaternion - 3),
                            bodies::axes_of({q[0], q[1], q[2], q[3]}, 0));
}

/// The largest gap of two boxes along one of some unit axes; negative where they overlap along each.
struct Separation {
  Real by_faces = -bodies::infinite, by_edges = -bodies::infinite;
  Real degrees = 0;  ///< between the edges with the largest gap
};

Separation separation_of(const Body& a, const Body& b) {
  Separation s;
  const auto gap = [&](const Point& u) {
    return std::max(bodies::gap_along(a, b, u), bodies::gap_along(a, b, bodies::scaled(u, -1)));
  };
  for (const Body* box : {&a, &b}) {
    for (const Point& axis : box->axes) s.by_faces = std::max(s.by_faces, gap(axis));
  }
  constexpr Real degrees_per_radian = 57.295779513082320877L;
  for (const Point& first : a.axes) {
    for (const Point& second : b.axes) {
      const Point u = bodies::cross(first, second);
      const Real g = gap(u);
      if (g > s.by_edges)
        s.by_edges = g, s.degrees = degrees_per_radian * std::asin(std::min<Real>(1, bodies::length(u)));
    }
  }
  return s;
}

/// Whether the nearly parallel edges decide, by at most an eighth of the thinnest half extent.
bool is_decided_by_crossed_edges(const Case& c, bool apart) {
  const auto& at = c.operands().quaternions;
  const Body a = box_at(c, at[0]), b = box_at(c, at[1]);
  const Separation s = separation_of(a, b);
  const Real thinnest = std::min({a.half[0], a.half[1], a.half[2], b.half[0], b.half[1], b.half[2]});
  const Real gap = apart ? s.by_edges : -s.by_edges;
  return gap > 0 && gap <= thinnest / 8 && s.by_faces < 0 && s.by_edges > s.by_faces && s.degrees >= 1e-5L &&
         s.degrees <= 0.3L;
}
bool is_apart_by_crossed_edges(const Case& c) { return is_decided_by_crossed_edges(c, true); }
bool overlaps_by_crossed_edges(const Case& c) { return is_decided_by_crossed_edges(c, false); }

// Motions.

/// The moving point or ball of a case, and its obstacle.
class Encounter {
 public:
  explicit Encounter(const Case& c) : case_(c), start_(*c.operands().start) {
    from_ = point_at(c, start_.place);
    velocity_ = point_at(c, c.operands().velocities.front());
    radius_ = start_.radius ? c.values[*start_.radius] : 0;
    make_bodies();
  }

  /// The distance of the surfaces at a time: negative inside a solid, and for a point behind something flat.
  Real distance(Real time) const { return distance_at(bodies::plus(from_, velocity_, time)); }
  Real distance_at(const Point& x) const {
    if (start_.obstacle.shape == Shape::halfspace) return above_plane(x) - radius_;
    const Real least = start_.obstacle.shape == Shape::plane ? std::abs(above_plane(x)) : distance_of_bodies(x);
    return radius_ == 0 && is_behind(x) ? -least : least - radius_;
  }

  Real speed() const { return bodies::length(velocity_); }
  Real radius() const { return radius_; }
  const Point& from() const { return from_; }
  const Point& velocity() const { return velocity_; }
  const std::vector<Body>& obstacles() const { return bodies_; }
  /// The largest coordinate or size.
  Real scale() const {
    Real most = 0;
    for (std::size_t i = 0; i < case_.values.size(); ++i) {
      const Role role = case_.role(i);
      if (role == Role::position || role == Role::size) most = std::max(most, std::abs(Real(case_.values[i])));
    }
    return most;
  }

 private:
  static Real signed_distance(const Body& b, const Point& x) {
    const Real depth = b.depth(x);
    return depth > 0 ? -depth : bodies::length(bodies::minus(x, b.nearest(x))) - b.radius;
  }
  Real distance_of_bodies(const Point& x) const {
    Real least = bodies::infinite;
    for (const Body& b : bodies_) least = std::min(least, signed_distance(b, x));
    return least;
  }
  Real above_plane(const Point& x) const {
    const Point n = point_at(case_, start_.obstacle.begin);
    return (bodies::dot(n, x) + case_.values[start_.obstacle.begin + 3]) / bodies::length(n);
  }
  bool is_behind(const Point& x) const {
    if (start_.obstacle.shape == Shape::plane) return above_plane(x) < 0;
    if (start_.obstacle.shape != Shape::triangle && start_.obstacle.shape != Shape::rectangle) return false;
    const std::vector<Point>& v = bodies_.front().corners;
    const Point normal = bodies::cross(bodies::minus(v[1], v[0]), bodies::minus(v[2], v[0]));
    return bodies::dot(normal, bodies::minus(x, v[0])) < 0;
  }
  void make_bodies() {
    const std::size_t i = start_.obstacle.begin;
    const auto corner = [&](std::size_t k) { return exactly(case_, i + 3 * k); };
    switch (start_.obstacle.shape) {
      case Shape::plane:
      case Shape::halfspace:
      case Shape::point:  // these four are no obstacles
      case Shape::segment:
      case Shape::line:
      case Shape::ray: return;
      case Shape::sphere: return bodies_.push_back(bodies::ball(corner(0), {case_.values[i + 3], 0}));
      case Shape::capsule: return bodies_.push_back(bodies::hull({corner(0), corner(1)}, {case_.values[i + 6], 0}));
      case Shape::box: return bodies_.push_back(box_at(case_, i + 6));
      case Shape::aabox: return bodies_.push_back(bodies::upright_box(corner(0), corner(1)));
      case Shape::triangle: return bodies_.push_back(bodies::hull({corner(0), corner(1), corner(2)}));
      case Shape::rectangle:
        bodies_.push_back(bodies::hull({corner(0), corner(1), corner(2)}));
        bodies_.push_back(bodies::hull({corner(0), corner(2), corner(3)}));
    }
  }

  const Case& case_;
  const Operands::Start& start_;
  Point from_{}, velocity_{};
  Real radius_ = 0;
  std::vector<Body> bodies_;
};

bool has_motion(const Query& q) { return q.operands.start && !q.operands.velocities.empty(); }

/// Below an ulp of double, above the rounding of a distance in long double.
constexpr Real exact_within = 0x1p-57L;

enum class Way { in, along, out };

/// Whether the distance of a start on the surface grows or shrinks along two axes or more: the surface is tilted there,
/// or it is an edge or a vertex.
bool is_off_axes(const Encounter& e, Real scale) {
  constexpr Real step = 0x1p-20L;
  int changes = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    Point there = e.from(), back = e.from();
    there[k] += step * scale, back[k] -= step * scale;
    changes += std::abs(e.distance_at(there) - e.distance_at(back)) >= step * scale / 16;
  }
  return changes >= 2;
}

/// The way of a start on the surface at a place off the axes; empty for other starts.
std::optional<Way> way_from_surface(const Case& c) {
  const Encounter e(c);
  const Real scale = e.scale();
  if (!(e.speed() > 0) || !(std::abs(e.distance(0)) <= exact_within * scale)) return std::nullopt;
  if (!is_off_axes(e, scale)) return std::nullopt;
  // In this time a motion along a surface of about that scale leaves it by 2^-41 of the scale.
  const Real after = e.distance(0x1p-20L * scale / e.speed());
  constexpr Real along_within = 0x1p-34L;
  if (std::abs(after) <= along_within * scale) return Way::along;
  return after < 0 ? Way::in : Way::out;
}
bool starts_on_surface_inwards(const Case& c) { return way_from_surface(c) == Way::in; }
bool starts_on_surface_along(const Case& c) { return way_from_surface(c) == Way::along; }
bool starts_on_surface_outwards(const Case& c) { return way_from_surface(c) == Way::out; }

bool moves_past_capsule(const Query& q) { return has_motion(q) && q.operands.start->obstacle.shape == Shape::capsule; }

/// The motion starts at least eight lengths away, is at most a tenth of a radian off the axis, and comes within an
/// eighth of the radii to a touch.
bool passes_along_capsule(const Case& c) {
  const Encounter e(c);
  const Body& capsule = e.obstacles().front();
  const Point axis = bodies::minus(capsule.corners[1], capsule.corners[0]);
  const Real reach = capsule.radius + e.radius(), length = bodies::length(axis);
  const bool far = e.distance(0) >= 8 * (length + reach);
  const Real sine = bodies::length(bodies::cross(axis, e.velocity())) / (length * e.speed());
  if (!far || !(sine <= 0.1L)) return false;
  const bodies::Motion motion{{e.from(), 0}, {e.velocity(), 0}, {0, 0}};
  const Real nearest = bodies::time_of_least_distance(motion, capsule, bodies::infinite);
  return std::abs(e.distance(nearest)) <= reach / 8;
}

bool has_limit(const Query& q) {
  const auto is_time = [](const Field& f) { return f.role == Role::time; };
  return has_motion(q) && decides(q.kind) && std::any_of(q.inputs.begin(), q.inputs.end(), is_time);
}

double first_of_role(const Case& c, Role role) {
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == role) return c.values[i];
  }
  return 0;
}

/// The distance at the limit, for a motion that is apart until just before it; empty for other motions and without a
/// limit.
std::optional<Real> distance_at_limit(const Case& c) {
  const Encounter e(c);
  const Real limit = first_of_role(c, Role::time), before = limit * (1 - 0x1p-10L);
  const bool unlimited = first_of_role(c, Role::flag) != 0;
  if (unlimited || !(limit > 0) || !(e.speed() > 0)) return std::nullopt;
  constexpr Real surely_apart = 0x1p-20L;
  if (!(e.distance(before) > surely_apart * e.speed() * limit)) return std::nullopt;
  return e.distance(limit);
}

bool meets_limit_exactly(const Case& c) {
  const auto d = distance_at_limit(c);
  return d && std::abs(*d) <= exact_within * Encounter(c).scale();
}
/// Not exact, but within two ulps of the limit.
bool nearly_meets_limit(const Case& c) {
  const auto d = distance_at_limit(c);
  const Real ulp = 2 * unit_roundoff(c.scalar) * first_of_role(c, Role::time);
  return d && !meets_limit_exactly(c) && std::abs(*d) <= 2 * ulp * Encounter(c).speed();
}

constexpr Configuration table[] = {
    {"a true rectangle", has_rectangle, is_true_rectangle, 300, 450},
    {"an exact upright rectangle", has_rectangle, is_upright_rectangle, 8, 40},
    {"an exact tilted rectangle", has_rectangle, is_tilted_rectangle, 8, 40},
    {"boxes apart only along crossed edges", has_two_boxes, is_apart_by_crossed_edges, 5, 20},
    {"boxes that overlap least along crossed edges", has_two_boxes, overlaps_by_crossed_edges, 5, 20},
    {"a motion along a capsule", moves_past_capsule, passes_along_capsule, 12, 30},
    {"a start on the surface off the axes, moving in", has_motion, starts_on_surface_inwards, 2, 40},
    {"a start on the surface off the axes, moving along", has_motion, starts_on_surface_along, 2, 20},
    {"a start on the surface off the axes, moving out", has_motion, starts_on_surface_outwards, 2, 50},
    {"a contact exactly at the limit", has_limit, meets_limit_exactly, 8, 25},
    {"a contact an ulp beside the limit", has_limit, nearly_meets_limit, 6, 20},
};

}  // namespace

std::span<const Configuration> configurations() { return table; }

}  // namespace nearmiss
