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
/// `edges`: the direction is across an edge of each, whose directions these are; otherwise empty.
template <class N, class F>
bool any_direction(const Core<N>& a, const Core<N>& b, bool facets_suffice, F&& f) {
  for (const Vector<N>& normal : a.normals) {
    if (f(normal, {})) return true;
  }
  for (const Vector<N>& normal : b.normals) {
    if (f(normal, {})) return true;
  }
  for (const Vector<N>& d : a.directions) {
    for (const Vector<N>& e : b.directions) {
      if (f(cross(d, e), TwoEdges<N>{&d, &e})) return true;
    }
  }
  if (facets_suffice) return false;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const auto& [from, along] : one->edges) {
      for (const Vector<N>& v : other->vertices) {
        const Vector<N> way = minus(v, one->vertices[from]);
        if (f(cross(along, cross(way, along)), {})) return true;
      }
    }
  }
  for (const Vector<N>& v : a.vertices) {
    for (const Vector<N>& w : b.vertices) {
      if (f(minus(w, v), {})) return true;
    }
  }
  return false;
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

/// Encloses the signed distance of two cores: the greatest gap over the directions of length 1. Where it is negative, a
/// direction of a facet has it, if the Minkowski difference has a volume; without a volume it is not negative.
/// nullopt: a direction is vague, so that the intervals cannot tell. The cores are in units of 1 / unit.
template <class N>
std::optional<Bounds> signed_distance(const Core<N>& a, const Core<N>& b, const N& unit = N(1)) {
  Bounds s{-HUGE_VAL, surely_spans(a, b) ? -HUGE_VAL : 0.0};
  N greatest(0), length2(0);  // of exact numbers: gap and direction
  bool any = false;
  const bool unknown = any_direction(a, b, false, [&](const Vector<N>& n, TwoEdges<N>) {
    const N n2 = norm2(n);
    if (surely_zero(n2)) return false;
    if (is_vague(n2)) return true;
    for (const N& gap : gaps(n, a, b)) {
      if constexpr (is_enclosure<N>) {
        const Bounds by = bounds(N(gap / root(n2)));
        if (!(by.low <= by.high)) return true;  // not a number
        s = {std::max(s.low, by.low), std::max(s.high, by.high)};
      } else {  // |gap| gap / n2 grows with gap / |n|
        const auto signed_square = [](const N& x) { return may_be_negative(x) ? N(-square(x)) : square(x); };
        if (any && !may_be_less(N(signed_square(greatest) * n2), N(signed_square(gap) * length2))) continue;
        greatest = gap, length2 = n2, any = true;
      }
    }
    return false;
  });
  if (unknown) return std::nullopt;
  if constexpr (!is_enclosure<N>) {
    if (any) {
      const Bounds by = bounds(N(N(greatest / N(length2 * unit)) * root(length2)));
      s = {std::max(s.low, by.low), std::max(s.high, by.high)};
    }
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

/// The inputs without numbers that are below 2^-100 of the largest length, or of the largest component of a rotation:
/// exact arithmetic on the others is cheap.
template <class Q>
std::vector<double> without_tiny_numbers(std::span<const double> inputs) {
  const std::vector<Role> roles = roles_of(Q{});
  std::array<double, 2> largest{};
  const auto of = [&](std::size_t i) -> double& { return largest[roles[i] == Role::rotation ? 1 : 0]; };
  for (std::size_t i = 0; i < inputs.size(); ++i) of(i) = std::max(of(i), std::abs(inputs[i]));
  std::vector<double> kept(inputs.begin(), inputs.end());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (std::abs(kept[i]) < 0x1p-100 * of(i)) kept[i] = 0;
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
  const Core<Exact> a = core_of(exact.a), b = core_of(exact.b);
  last = *signed_distance(times(b.unit, a), times(a.unit, b), Exact(a.unit * b.unit));
  arithmetic_barrier();
  last_inputs = inputs;
  return last;
}

}  // namespace nearmiss::oracle
