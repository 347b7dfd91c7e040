/// Truth of the grid's overlaps: two rounded polytopes are apart if a direction separates their cores by more than the
/// sum of their radii. If there is one, then the direction of the shortest way between the cores is one, and that joins
/// two features: it is the normal of a face, the cross product of two edges, perpendicular to an edge, or between two
/// vertices. The bodies meet if none of these separates.
#include "impl/catalogue/queries/overlaps.hpp"

#include "oracles/algorithms/nearest_piece.hpp"

namespace nearmiss::oracle {

namespace {

/// A core: the convex hull of the vertices. An edge runs from its vertex along its direction.
template <class N>
struct Core {
  struct Edge {
    std::size_t from;
    Vector<N> along;
  };
  std::vector<Vector<N>> vertices;
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
Axes<Interval> axes_of(const collide::Quaternion<Interval>& q) { return {rotation_axes<Interval>(q), Interval(1)}; }
Axes<Exact> axes_of(const collide::Quaternion<Exact>& q) {
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
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vector<N> local = half;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((corner >> k & 1) != 0) continue;
      local[k] = -half[k];
      core.edges.push_back({corner, axes[k]});
    }
    core.vertices.push_back(plus(times(vector(box.center), unit), out_of(axes, local)));
  }
  core.unit = unit;
  core.directions = core.normals = {axes[0], axes[1], axes[2]};
  core.has_volume = std::none_of(half.begin(), half.end(), [](const N& h) { return may_be_at_most_zero(h); });
  return core;
}

/// A place near the first vertex, without width: where the cores are relative to it, coordinates far from the origin
/// lose no digits, and the place is the same for every input that intervals enclose.
Vector<Interval> place_near(const Core<Interval>& core) {
  Vector<Interval> place = core.vertices.front();
  for (Interval& x : place) x = Interval(CGAL::to_double(x));
  return place;
}
const Vector<Exact>& place_near(const Core<Exact>& core) { return core.vertices.front(); }

template <class N>
Core<N> relative_to(const Vector<N>& place, Core<N> core) {
  for (Vector<N>& v : core.vertices) v = minus(v, place);
  return core;
}

/// Which decisions the directions that were tried allow.
template <class N>
class Directions {
 public:
  Directions(const Core<N>& a, const Core<N>& b) : a_(a), b_(b), radius2_(square(N(a.radius + b.radius))) { try_all(); }
  bool may_be_apart() const { return may_be_apart_; }
  bool may_meet() const { return !surely_apart_; }

 private:
  void try_all() {
    for (const Vector<N>& normal : a_.normals) separates(normal);
    for (const Vector<N>& normal : b_.normals) separates(normal);
    for (const Vector<N>& d : a_.directions) {
      for (const Vector<N>& e : b_.directions) separates(cross(d, e));
    }
    // Without a radius, the facets of a Minkowski difference with a volume suffice.
    if ((a_.has_volume || b_.has_volume) && surely_zero(radius2_)) return;
    across_edges(a_, b_);
    across_edges(b_, a_);
    for (const Vector<N>& v : a_.vertices) {
      for (const Vector<N>& w : b_.vertices) separates(minus(w, v));
    }
  }
  void across_edges(const Core<N>& one, const Core<N>& other) {
    for (const auto& [from, along] : one.edges) {
      const N length2 = norm2(along);
      for (const Vector<N>& v : other.vertices) {
        const Vector<N> way = minus(v, one.vertices[from]);
        separates(minus(times(way, length2), times(along, dot(way, along))));
      }
    }
  }
  /// Tries the direction and its opposite.
  void separates(const Vector<N>& normal) {
    if (surely_apart_) return;
    const Shadow a = shadow(normal, a_), b = shadow(normal, b_);
    for (const N& gap : {N(b.low - a.high), N(a.low - b.high)}) {
      if (!may_be_positive(gap)) continue;
      const N beyond = square(assume_at_least_zero(gap)) - radius2_ * norm2(normal);
      if (!may_be_positive(beyond)) continue;
      may_be_apart_ = true;
      surely_apart_ = surely_apart_ || (!may_be_at_most_zero(gap) && !may_be_at_most_zero(beyond));
    }
  }
  struct Shadow {
    N low, high;
  };
  static Shadow shadow(const Vector<N>& normal, const Core<N>& core) {
    const N first = dot(normal, core.vertices.front());
    Shadow s{first, first};
    for (const Vector<N>& v : core.vertices) {
      const N at = dot(normal, v);
      s.low = lesser(s.low, at);
      s.high = -lesser(N(-s.high), N(-at));
    }
    return s;
  }

  const Core<N>& a_;
  const Core<N>& b_;
  N radius2_;
  bool may_be_apart_ = false, surely_apart_ = false;
};

/// In units of 1 / unit. A direction has no unit.
template <class N>
Core<N> times(const N& unit, Core<N> core) {
  for (Vector<N>& v : core.vertices) v = times(v, unit);
  core.radius = core.radius * unit;
  return core;
}

template <class N, class Out>
void overlap(Core<N> a, Core<N> b, Out& out) {
  if constexpr (!is_enclosure<N>) {
    const N of_a = a.unit, of_b = b.unit;
    a = times(of_b, std::move(a));
    b = times(of_a, std::move(b));
  }
  const Vector<N> place = place_near(a);
  a = relative_to(place, std::move(a));
  b = relative_to(place, std::move(b));
  const Directions<N> tried(a, b);
  if (tried.may_be_apart()) out.no();
  if (tried.may_meet()) out.yes({true});
}

}  // namespace

#define NEARMISS_OVERLAP(first, second)                                                       \
  template <class N, class Out>                                                               \
  void first##_##second##_overlap(const inputs::first##_##second##_overlap<N>& q, Out& out) { \
    overlap(core_of(q.a), core_of(q.b), out);                                                 \
  }                                                                                           \
  NEARMISS_ORACLE(first##_##second##_overlap)
#include "impl/catalogue/grid.def"

}  // namespace nearmiss::oracle
