/// Mutators that bring a feature of one operand into a special position to a feature of another one. They work on the
/// features of any two shapes.
#include <utility>

#include "corpus/generator/constructions.hpp"
#include "corpus/generator/features.hpp"

namespace nearmiss {

namespace {

/// Two operands; `moved` has positions, which the mutator changes.
struct Pair {
  const Operand* fixed;
  const Operand* moved;
};

/// Two different operands at random. False if the query has only one.
bool draw_pair(CaseBuilder& d, Pair& pair) {
  const std::vector<Operand>& all = d.plan.bodies;
  if (all.size() < 2) return false;
  const std::size_t first = d.random.below(all.size());
  const std::size_t second = (first + 1 + d.random.below(all.size() - 1)) % all.size();
  pair = {&all[first], &all[second]};
  if (pair.moved->positions.empty()) std::swap(pair.fixed, pair.moved);
  return !pair.moved->positions.empty();
}

void translate(CaseBuilder& d, const Operand& operand, const Numbers& way) {
  for (const std::size_t p : operand.positions) d.set_vector(p, plus(d.vector(p), way));
}

/// A share of a way, in eighths: within it, or at an end.
double share(CaseBuilder& d) { return 0.125 * d.random.between(0, 8); }

Numbers point_on_edge(CaseBuilder& d, const Features& f) {
  if (f.edges.empty()) return d.random.pick(f.vertices);
  const Features::Edge& e = d.random.pick(f.edges);
  return plus(e.from, e.along, share(d));
}

/// The direction of an edge, or the sum of two: of a face's diagonal where both belong to one face.
Numbers draw_direction_in(CaseBuilder& d, const Features& f) {
  const Numbers first = d.random.pick(f.edges).along;
  return d.random.one_in(3) ? plus(first, d.random.pick(f.edges).along) : first;
}

bool is_solid(const Operand& o) { return o.half || o.shape == Shape::aabox; }
/// Whether an edge of the operand, or a plane's normal, can take any direction.
bool has_free_edge(const Operand& o) { return !is_solid(o) && (o.positions.size() > 1 || o.direction.has_value()); }

/// The plane gets that normal, and keeps a point.
void turn_plane(CaseBuilder& d, const Operand& plane, const Numbers& normal) {
  const Numbers point = features_of(d, plane).vertices[0];
  d.set_vector(*plane.direction, normal);
  d.set(*plane.offset, -dot(d.vector(*plane.direction), point));
}

/// The operand's direction, or an edge between two of its positions, becomes that one, from the edge's one end on.
void turn_edge(CaseBuilder& d, const Operand& operand, const Numbers& along) {
  if (operand.offset) return turn_plane(d, operand, along);
  if (operand.direction) return d.set_vector(*operand.direction, along);
  const std::size_t count = operand.positions.size(), first = d.random.below(count);
  const std::size_t second = (first + (d.random.one_in(2) ? 1 : count - 1)) % count;
  d.set_vector(operand.positions[second], plus(d.vector(operand.positions[first]), along));
}

/// Boxes turned alike, or by right angles.
void turn_box_alike(CaseBuilder& d, const Operand& fixed, const Operand& moved) {
  const std::size_t from = *fixed.rotation, to = *moved.rotation;
  for (std::size_t k = 0; k < 4; ++k) d.set(to + k, d[from + k]);
  if (d.random.one_in(2)) return;
  const std::size_t axis = d.random.below(3), i = (axis + 1) % 3, k = (axis + 2) % 3;  // q times (axis + 1)
  const double x = d[to + i], y = d[to + k], z = d[to + axis], w = d[to + 3];
  d.set(to + i, x + y), d.set(to + k, y - x), d.set(to + axis, z + w), d.set(to + 3, w - z);
}

/// An edge of one operand gets the direction of an edge of another one, changed by up to `off` of its length.
bool make_parallel(CaseBuilder& d, double off) {
  Pair pair;
  if (!draw_pair(d, pair)) return false;
  if (!has_free_edge(*pair.moved)) std::swap(pair.fixed, pair.moved);
  if (!has_free_edge(*pair.moved)) {
    if (!pair.fixed->rotation || !pair.moved->rotation || off != 0) return false;
    turn_box_alike(d, *pair.fixed, *pair.moved);
    return true;
  }
  const Features f = features_of(d, *pair.fixed);
  if (f.edges.empty()) return false;
  const Numbers along = draw_direction_in(d, f);
  const double sign = d.random.sign(), length = sign * d.random.power_of_two(-2, 2);
  const double reach = off * norm(along);
  turn_edge(d, *pair.moved, plus(plus({}, along, length), d.random_vector(1), reach));
  d.repair();
  return true;
}

/// Directions in the plane of a face, or through an edge.
struct Flat {
  Numbers place, first, second;
};

Flat draw_flat(CaseBuilder& d, const Features& f) {
  const Features::Edge& e = d.random.pick(f.edges);
  const Numbers other = d.random.pick(f.edges).along;
  const bool alike = norm(cross(e.along, other)) == 0;
  return {e.from, e.along, alike ? d.random_vector(d.unit) : other};
}

/// Two boxes turned alike, with faces in one plane.
bool make_flush(CaseBuilder& d, const Operand& fixed, const Operand& moved) {
  if (!fixed.half || !moved.half) return false;
  if (fixed.rotation && moved.rotation) turn_box_alike(d, fixed, moved);
  const Features f = features_of(d, fixed), m = features_of(d, moved);
  const Numbers n = d.random.pick(f.normals);
  const double side = d.random.sign(), other = d.random.sign();
  const Numbers to = furthest_point(d, f, plus({}, n, side)), from = furthest_point(d, m, plus({}, n, other));
  translate(d, moved, plus(to, from, -1));
  return true;
}

/// A direction at a right angle to features of both: of a face, of an edge of each, of a vertex and the other's vertex,
/// or an axis.
Numbers draw_separation(CaseBuilder& d, const Features& a, const Features& b) {
  const Features& one = d.random.one_in(2) ? a : b;
  switch (d.random.below(4)) {
    case 0:
      if (!one.normals.empty()) return d.random.pick(one.normals);
      [[fallthrough]];
    case 1:
      if (!a.edges.empty() && !b.edges.empty()) {
        const Numbers first = d.random.pick(a.edges).along;
        return cross(first, d.random.pick(b.edges).along);
      }
      [[fallthrough]];
    case 2: {
      const Numbers from = d.random.pick(a.vertices);
      return plus(d.random.pick(b.vertices), from, -1);
    }
    default: {
      Numbers axis{};
      axis[d.random.below(3)] = d.random.sign();
      return axis;
    }
  }
}

/// What moves starts earlier on its way, so that it is now where it was placed; in one of four cases it starts there.
void start_before(CaseBuilder& d) {
  if (d.random.one_in(4)) return;
  const double before = 0.25 * d.random.between(1, 8);
  for (const Operand& body : d.plan.bodies) {
    const auto& way = body.shape == Shape::ray ? body.direction : body.velocity;
    if (way) translate(d, body, plus({}, d.vector(*way), -before));
  }
}

}  // namespace

bool parallel_edges(CaseBuilder& d) { return make_parallel(d, 0); }
bool nearly_parallel_edges(CaseBuilder& d) { return make_parallel(d, tiny(d)); }

bool coplanar_features(CaseBuilder& d) {
  Pair pair;
  if (!draw_pair(d, pair)) return false;
  if (make_flush(d, *pair.fixed, *pair.moved)) return true;
  const auto has_edges = [](const Operand& o) { return is_solid(o) || has_free_edge(o); };
  if (!has_edges(*pair.fixed) || is_solid(*pair.moved)) std::swap(pair.fixed, pair.moved);
  if (!has_edges(*pair.fixed) || pair.moved->positions.empty()) return false;
  const Features f = features_of(d, *pair.fixed);
  const Flat flat = draw_flat(d, f);
  for (const std::size_t p : pair.moved->positions) {
    const double first = 0.125 * d.random.between(-8, 16), second = 0.125 * d.random.between(-8, 16);
    d.set_vector(p, plus(plus(flat.place, flat.first, first), flat.second, second));
  }
  start_before(d);
  d.repair();
  return true;
}

bool crossing_edges(CaseBuilder& d) {
  Pair pair;
  if (!draw_pair(d, pair)) return false;
  const Features f = features_of(d, *pair.fixed), m = features_of(d, *pair.moved);
  if (f.edges.empty() && m.edges.empty()) return false;
  const Numbers to = point_on_edge(d, f);
  translate(d, *pair.moved, plus(to, point_on_edge(d, m), -1));
  start_before(d);
  d.repair();
  return true;
}

bool touching_features(CaseBuilder& d) {
  Pair pair;
  if (!draw_pair(d, pair)) return false;
  const Features f = features_of(d, *pair.fixed), m = features_of(d, *pair.moved);
  const double side = d.random.sign();
  const Numbers any = draw_separation(d, f, m);
  const Numbers n = unit_of(plus({}, any, side));
  const double apart = f.radius + m.radius, off = d.random.one_in(2) ? 0 : tiny(d);
  const Numbers to = furthest_point(d, f, n), from = furthest_point(d, m, plus({}, n, -1));
  const double gap = apart + off * (apart > 0 ? apart : d.unit);
  translate(d, *pair.moved, plus(plus(to, from, -1), n, gap));
  start_before(d);
  d.repair();
  return true;
}

}  // namespace nearmiss
