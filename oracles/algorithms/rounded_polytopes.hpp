/// Rounded polytopes, and the signed distance of two: the shapes of the grid as their cores and radii. Shared by the
/// oracles of overlaps and of signed distances.
#pragma once

#include <optional>
#include <vector>

#include <collide/shapes.hpp>

#include "oracles/algorithms/nearest_piece.hpp"

namespace nearmiss::oracle {

/// A core: the convex hull of the vertices. An edge runs from its vertex along its direction.
template <class N>
struct Core {
  struct Edge {
    std::size_t from;
    Vector<N> along;
  };
  std::vector<Vector<N>> vertices;
  Vector<N> center;              ///< of a box
  std::vector<Vector<N>> reach;  ///< of a box: from its center to three of its faces
  std::vector<Edge> edges;
  std::vector<Vector<N>> directions;  ///< of the edges, each once
  std::vector<Vector<N>> normals;     ///< of the faces
  N radius = N(0);
  bool has_volume = false;  ///< certainly
  N unit = N(1);            ///< all lengths are in units of 1 / unit
};

template <class N>
Core<N> core_of(const collide::Vec3<N>& point) {
  Core<N> core;
  core.vertices = {vector(point)};
  return core;
}
template <class N>
Core<N> core_of(const collide::Sphere<N>& sphere) {
  Core<N> core = core_of(sphere.center);
  core.radius = sphere.radius;
  return core;
}
/// The convex hull of a chain of vertices, closed where there are three.
template <class N>
Core<N> flat_core(std::vector<Vector<N>> vertices) {
  Core<N> core;
  const std::size_t count = vertices.size(), edges = count == 2 ? 1 : count;
  for (std::size_t i = 0; i < edges; ++i) {
    core.edges.push_back({i, minus(vertices[(i + 1) % count], vertices[i])});
    core.directions.push_back(core.edges.back().along);
  }
  if (count == 3) core.normals = {cross(core.directions[0], core.directions[1])};
  core.vertices = std::move(vertices);
  return core;
}
template <class N>
Core<N> core_of(const collide::Segment<N>& segment) {
  return flat_core<N>({vector(segment.v0), vector(segment.v1)});
}
template <class N>
Core<N> core_of(const collide::Capsule<N>& capsule) {
  Core<N> core = flat_core<N>({vector(capsule.p0), vector(capsule.p1)});
  core.radius = capsule.radius;
  return core;
}
template <class N>
Core<N> core_of(const collide::Triangle<N>& triangle) {
  return flat_core<N>({vector(triangle.v0), vector(triangle.v1), vector(triangle.v2)});
}
/// The axes of a box, times `unit`. Exact ones are multiplied by the squared length of the quaternion: nothing is
/// divided, and all denominators stay powers of two.
template <class N>
struct Axes {
  std::array<Vector<N>, 3> axes;
  N unit;
};
inline Axes<Interval> axes_of(const collide::Quaternion<Interval>& q) {
  return {rotation_axes<Interval>(q), Interval(1)};
}
inline Axes<Exact> axes_of(const collide::Quaternion<Exact>& q) {
  const Exact xx = square(q.x), yy = square(q.y), zz = square(q.z), ww = square(q.w);
  const auto twice = [](const Exact& x) { return x + x; };
  return {{{{ww + xx - yy - zz, twice(q.x * q.y + q.w * q.z), twice(q.x * q.z - q.w * q.y)},
            {twice(q.x * q.y - q.w * q.z), ww - xx + yy - zz, twice(q.y * q.z + q.w * q.x)},
            {twice(q.x * q.z + q.w * q.y), twice(q.y * q.z - q.w * q.x), ww - xx - yy + zz}}},
          xx + yy + zz + ww};
}

template <class N>
Core<N> core_of(const collide::Box<N>& box) {
  Core<N> core;
  const auto [axes, unit] = axes_of(box.orientation);
  const Vector<N> half = vector(box.half);
  core.center = times(vector(box.center), unit);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vector<N> local = half;
    bool is_again = false;  // in a box without extent along an axis, two exact corners are one
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_flat = !is_enclosure<N> && surely_zero(half[k]);
      if ((corner >> k & 1) != 0) {
        is_again = is_again || is_flat;
        continue;
      }
      local[k] = -half[k];
    }
    if (is_again) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_flat = !is_enclosure<N> && surely_zero(half[k]);
      if ((corner >> k & 1) == 0 && !is_flat) core.edges.push_back({core.vertices.size(), axes[k]});
    }
    core.vertices.push_back(plus(core.center, out_of(axes, local)));
  }
  for (std::size_t k = 0; k < 3; ++k) core.reach.push_back(times(axes[k], half[k]));
  core.unit = unit;
  core.directions.assign(axes.begin(), axes.end());
  core.normals = core.directions;
  core.has_volume = std::none_of(half.begin(), half.end(), [](const N& h) { return may_be_at_most_zero(h); });
  return core;
}

/// The points center + x[0] reach[0] + x[1] reach[1] + x[2] reach[2] with each x in [-1, 1]. The vertices are in the
/// order of a box's.
inline Core<Interval> parallelepiped(const Vector<Interval>& center, const std::array<Vector<Interval>, 3>& reach) {
  Core<Interval> core;
  core.center = center;
  core.reach.assign(reach.begin(), reach.end());
  core.directions = core.reach;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vector<Interval> v = center;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_low = (corner >> k & 1) == 0;
      v = is_low ? minus(v, reach[k]) : plus(v, reach[k]);
      if (is_low) core.edges.push_back({corner, reach[k]});
    }
    core.vertices.push_back(v);
  }
  for (std::size_t k = 0; k < 3; ++k) core.normals.push_back(cross(reach[(k + 1) % 3], reach[(k + 2) % 3]));
  return core;
}

/// A place near the first vertex, without width: where the cores are relative to it, coordinates far from the origin
/// lose no digits, and the place is the same for every input that intervals enclose.
inline Vector<Interval> place_near(const Core<Interval>& core) {
  Vector<Interval> place = core.vertices.front();
  for (Interval& x : place) x = Interval(CGAL::to_double(x));
  return place;
}
inline const Vector<Exact>& place_near(const Core<Exact>& core) { return core.vertices.front(); }

template <class N>
Core<N> relative_to(const Vector<N>& place, Core<N> core) {
  for (Vector<N>& v : core.vertices) v = minus(v, place);
  if (!core.reach.empty()) core.center = minus(core.center, place);
  return core;
}

/// The directions of an edge of each core; none where a direction is not across two edges.
template <class N>
struct TwoEdges {
  const Vector<N>*of_a = nullptr, *of_b = nullptr;
};

/// Calls f(direction, edges) for every direction that may be that of the shortest way between the cores, until it
/// returns true: those of the facets of their Minkowski difference, then, unless the facets suffice, the others.
/// `edges`: the direction is across an edge of each, whose directions these are; otherwise empty. A direction is
/// computed only where wanted() returns true, which is called once for each, in the same order for every N.
template <class N, class F, class Wanted>
bool any_direction(const Core<N>& a, const Core<N>& b, bool facets_suffice, F&& f, Wanted&& wanted) {
  for (const Core<N>* core : {&a, &b}) {
    for (const Vector<N>& normal : core->normals) {
      if (wanted() && f(normal, {})) return true;
    }
  }
  for (const Vector<N>& d : a.directions) {
    for (const Vector<N>& e : b.directions) {
      if (wanted() && f(cross(d, e), TwoEdges<N>{&d, &e})) return true;
    }
  }
  if (facets_suffice) return false;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const auto& [from, along] : one->edges) {
      for (const Vector<N>& v : other->vertices) {
        if (!wanted()) continue;
        const Vector<N> way = minus(v, one->vertices[from]);
        if (f(cross(along, cross(way, along)), {})) return true;
      }
    }
  }
  for (const Vector<N>& v : a.vertices) {
    for (const Vector<N>& w : b.vertices) {
      if (wanted() && f(minus(w, v), {})) return true;
    }
  }
  return false;
}
template <class N, class F>
bool any_direction(const Core<N>& a, const Core<N>& b, bool facets_suffice, F&& f) {
  return any_direction(a, b, facets_suffice, std::forward<F>(f), [] { return true; });
}

/// The ends of a projection on a direction.
template <class N>
struct Projection {
  N low, high;
};
template <class N>
Projection<N> projection(const Vector<N>& direction, const Core<N>& core) {
  if (!core.reach.empty()) {
    const N middle = dot(direction, core.center);
    N around(0);
    for (const Vector<N>& r : core.reach) around = around + magnitude(dot(direction, r));
    return {middle - around, middle + around};
  }
  const N first = dot(direction, core.vertices.front());
  Projection<N> p{first, first};
  for (const Vector<N>& v : core.vertices) {
    const N at = dot(direction, v);
    p.low = lesser(p.low, at);
    p.high = -lesser(N(-p.high), N(-at));
  }
  return p;
}

/// The gap between the projections on a direction, times its length, and the same for its opposite.
template <class N>
std::array<N, 2> gaps(const Vector<N>& direction, const Core<N>& a, const Core<N>& b) {
  const Projection<N> of_a = projection(direction, a), of_b = projection(direction, b);
  return {N(of_b.low - of_a.high), N(of_a.low - of_b.high)};
}

/// Whether the Minkowski difference of the cores certainly has a volume: three of their edges span the space.
template <class N>
bool surely_spans(const Core<N>& a, const Core<N>& b) {
  std::vector<Vector<N>> extents;
  for (const Core<N>* core : {&a, &b}) {
    const auto& of_core = core->reach.empty() ? core->directions : core->reach;
    extents.insert(extents.end(), of_core.begin(), of_core.end());
  }
  for (std::size_t i = 0; i < extents.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vector<N> across = cross(extents[i], extents[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (!may_be_zero(dot(across, extents[k]))) return true;
      }
    }
  }
  return false;
}

/// Whether a squared length is known so poorly that what is divided by it says nothing: that of a cross product of
/// nearly parallel edges.
inline bool is_vague(const Interval& x) {
  return !(x.inf() > 0 && x.sup() < HUGE_VAL && x.sup() <= (1 + 0x1p-20) * x.inf());
}
inline bool is_vague(const Exact&) { return false; }

/// The gap along a direction, per its length, and the same for its opposite: the greater one. nullopt: the intervals
/// cannot tell.
inline std::optional<Bounds> greater_gap(const Vector<Interval>& direction, const Interval& length2,
                                         const Core<Interval>& a, const Core<Interval>& b) {
  if (is_vague(length2)) return std::nullopt;
  Bounds greater{-HUGE_VAL, -HUGE_VAL};
  for (const Interval& gap : gaps(direction, a, b)) {
    const Bounds by = bounds(Interval(gap / root(length2)));
    if (!(by.low <= by.high)) return std::nullopt;  // not a number
    greater = {std::max(greater.low, by.low), std::max(greater.high, by.high)};
  }
  return greater;
}

/// Encloses the signed distance of two cores: the greatest gap over the directions of length 1. Where it is negative, a
/// direction of a facet has it, if the Minkowski difference has a volume; without a volume it is not negative.
/// nullopt: a direction is vague, so that the intervals cannot tell.
inline std::optional<Bounds> signed_distance(const Core<Interval>& a, const Core<Interval>& b) {
  Bounds s{-HUGE_VAL, surely_spans(a, b) ? -HUGE_VAL : 0.0};
  const bool unknown = any_direction(a, b, false, [&](const Vector<Interval>& n, TwoEdges<Interval>) {
    const Interval n2 = norm2(n);
    if (surely_zero(n2)) return false;
    const std::optional<Bounds> by = greater_gap(n, n2, a, b);
    if (!by) return true;
    s = {std::max(s.low, by->low), std::max(s.high, by->high)};
    return false;
  });
  if (unknown) return std::nullopt;
  return s;
}

/// Encloses exact vectors divided by a power of two, so that no number is too large for intervals.
class Enclosing {
 public:
  void reach(const Vector<Exact>& v) {
    for (const Exact& x : v) {
      if (const std::optional<long> exponent = exponent_of(x))
        exponent_ = std::max(exponent_.value_or(*exponent), *exponent);
    }
  }
  Vector<Interval> operator()(const Vector<Exact>& v) const {
    Vector<Interval> enclosed;
    for (std::size_t k = 0; k < 3; ++k) {
      const Bounds x = bounds(v[k], exponent_.value_or(0));
      enclosed[k] = Interval(x.low, x.high);
    }
    return enclosed;
  }

 private:
  std::optional<long> exponent_;
};

/// Encloses two exact cores whose vertices are relative to one of them, in a unit of length that both share. The length
/// of a direction, and its unit, are its own.
inline std::array<Core<Interval>, 2> enclosing(const Core<Exact>& a, const Core<Exact>& b) {
  Enclosing lengths;
  for (const Core<Exact>* exact : {&a, &b}) {
    for (const std::vector<Vector<Exact>>* vectors : {&exact->vertices, &exact->reach}) {
      for (const Vector<Exact>& v : *vectors) lengths.reach(v);
    }
  }
  const auto enclose_all = [](const std::vector<Vector<Exact>>& vectors, auto&& enclose) {
    std::vector<Vector<Interval>> enclosures;
    std::transform(vectors.begin(), vectors.end(), std::back_inserter(enclosures), enclose);
    return enclosures;
  };
  const auto direction = [](const Vector<Exact>& v) {
    Enclosing own;
    own.reach(v);
    return own(v);
  };
  const auto enclose = [&](const Core<Exact>& exact) {
    Core<Interval> core;
    core.vertices = enclose_all(exact.vertices, lengths);
    core.reach = enclose_all(exact.reach, lengths);
    if (!exact.reach.empty()) core.center = lengths(exact.center);
    core.directions = enclose_all(exact.directions, direction);
    core.normals = enclose_all(exact.normals, direction);
    for (const auto& [from, along] : exact.edges) core.edges.push_back({from, direction(along)});
    return core;
  };
  return {enclose(a), enclose(b)};
}

/// Which of the directions of any_direction() may have the greatest gap: intervals leave few for exact arithmetic.
inline std::vector<bool> directions_of_greatest_gap(const Core<Exact>& exact_a, const Core<Exact>& exact_b) {
  const Vector<Exact>& place = place_near(exact_a);
  const auto [a, b] = enclosing(relative_to(place, exact_a), relative_to(place, exact_b));
  const IntervalScope scope;
  arithmetic_barrier();
  std::vector<double> upper;
  double greatest = -HUGE_VAL;
  any_direction(a, b, false, [&](const Vector<Interval>& n, TwoEdges<Interval>) {
    const std::optional<Bounds> by = greater_gap(n, norm2(n), a, b);
    upper.push_back(by ? by->high : HUGE_VAL);
    if (by) greatest = std::max(greatest, by->low);
    return false;
  });
  arithmetic_barrier();
  if (scope.any_invalid()) upper.assign(upper.size(), HUGE_VAL);  // the bounds mean nothing: all may be
  std::vector<bool> may_be(upper.size());
  std::transform(upper.begin(), upper.end(), may_be.begin(), [&](double high) { return high >= greatest; });
  return may_be;
}

/// The same of exact cores, in units of 1 / unit.
inline Bounds signed_distance(const Core<Exact>& a, const Core<Exact>& b, const Exact& unit) {
  const std::vector<bool> may_be = directions_of_greatest_gap(a, b);
  const auto signed_square = [](const Exact& x) { return may_be_negative(x) ? Exact(-square(x)) : square(x); };
  Exact greatest(0), length2(0);  // gap and direction
  bool any = false;
  const auto compare = [&](const Vector<Exact>& n, TwoEdges<Exact>) {
    const Exact n2 = norm2(n);
    if (surely_zero(n2)) return false;
    for (const Exact& gap : gaps(n, a, b)) {  // |gap| gap / n2 grows with gap / |n|
      if (any && !may_be_less(Exact(signed_square(greatest) * n2), Exact(signed_square(gap) * length2))) continue;
      greatest = gap, length2 = n2, any = true;
    }
    return false;
  };
  any_direction(a, b, false, compare, [&, i = std::size_t(0)]() mutable { return may_be[i++]; });
  Bounds s{-HUGE_VAL, surely_spans(a, b) ? -HUGE_VAL : 0.0};
  if (any) {
    const Bounds by = bounds(Exact(Exact(greatest / Exact(length2 * unit)) * root(length2)));
    s = {std::max(s.low, by.low), std::max(s.high, by.high)};
  }
  return s;
}

/// How far a vertex of the core moves at most from where it is for the inputs in the middle.
inline double movement(const Core<Interval>& core, const Core<Interval>& middle) {
  double furthest2 = 0;
  for (std::size_t i = 0; i < core.vertices.size(); ++i) {
    const double way2 = norm2(minus(core.vertices[i], middle.vertices[i])).sup();
    if (!(way2 <= furthest2)) furthest2 = way2 >= 0 ? way2 : HUGE_VAL;  // not a number: anywhere
  }
  return root(of_bound(furthest2)).sup() + magnitude(core.radius - middle.radius).sup();
}

/// The inputs without numbers that are below 2^-100 of the largest length, or of the largest component of their
/// rotation: exact arithmetic on the others is cheap.
template <class Q>
std::vector<double> without_tiny_numbers(std::span<const double> inputs) {
  const std::vector<Role> roles = roles_of(Q{});
  constexpr std::size_t components = 4;
  std::vector<std::size_t> groups;  // 0: lengths; then the rotations
  for (std::size_t i = 0, rotations = 0; i < inputs.size(); ++i)
    groups.push_back(roles[i] == Role::rotation ? 1 + rotations++ / components : 0);
  std::vector<double> largest(inputs.size(), 0.0), kept(inputs.begin(), inputs.end());
  for (std::size_t i = 0; i < inputs.size(); ++i)
    largest[groups[i]] = std::max(largest[groups[i]], std::abs(inputs[i]));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (std::abs(kept[i]) < 0x1p-100 * largest[groups[i]]) kept[i] = 0;
  }
  return kept;
}
template <class Q>
Q inputs_at(const std::vector<double>& values) {
  Q q;
  std::size_t i = 0;
  collide::for_each_leaf(q, [&](Interval& x, Role) { x = Interval(values[i++]); });
  return q;
}

/// In units of 1 / unit. A direction has no unit.
template <class N>
Core<N> times(const N& unit, Core<N> core) {
  for (Vector<N>& v : core.vertices) v = times(v, unit);
  for (Vector<N>& v : core.reach) v = times(v, unit);
  if (!core.reach.empty()) core.center = times(core.center, unit);
  core.radius = core.radius * unit;
  return core;
}

template <template <class> class Q>
Bounds exact_signed_distance(const std::vector<double>& inputs) {
  static thread_local std::vector<double> last_inputs;  // a search asks many widenings of the same inputs
  static thread_local Bounds last;
  if (inputs == last_inputs) return last;
  last_inputs.clear();  // what follows may throw
  const FloatingPointScope standard_modes;
  arithmetic_barrier();
  const auto exact = exact_inputs<Q<Exact>>(inputs);
  Core<Exact> a = core_of(exact.a), b = core_of(exact.b);
  const Exact unit = a.unit * b.unit;
  const Exact unit_of_a = a.unit;
  a = times(b.unit, std::move(a)), b = times(unit_of_a, std::move(b));
  last = signed_distance(a, b, unit);
  arithmetic_barrier();
  last_inputs = inputs;
  return last;
}

}  // namespace nearmiss::oracle
