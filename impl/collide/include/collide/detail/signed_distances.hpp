/// The kernel of the signed distance of every two rounded polytopes: points, spheres, segments, capsules, triangles and
/// boxes.
///
/// The signed distance of two cores is the greatest gap between them over all directions of length 1; the radii only
/// subtract. Of cores that are apart it is the length of a shortest way; of cores that overlap, a facet of their
/// difference has it.
///
/// Near a touch the way between two rounded points has no good direction. A right normal leads along the way, is
/// perpendicular to an edge or face that the way meets within, and no vertex is further along it. How far a normal and
/// a way fall short of this is their *defect*, and no other test accepts an answer or prefers one to another. So no
/// number decides whether cores are apart, overlap or nearly touch.
#pragma once

#include <bit>
#include <optional>
#include <tuple>
#include <utility>

#include <collide/detail/boxes_in_one_frame.hpp>
#include <collide/detail/shortest_ways.hpp>
#include <collide/detail/wide_filters.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// A vector perpendicular to `v`, of any length; of a zero vector, any.
template <class Tier, class T>
Vec3<T> any_perpendicular(const Vec3<T>& v) {
  const T x = abs(v.x), y = abs(v.y), z = abs(v.z);
  if (x <= y && x <= z) return v.y == T(0) && v.z == T(0) ? Vec3<T>{T(1), T(0), T(0)} : Vec3<T>{T(0), -v.z, v.y};
  return y <= z ? Vec3<T>{v.z, T(0), -v.x} : Vec3<T>{-v.y, v.x, T(0)};
}

/// A direction perpendicular to both cores.
template <class Tier, class T>
Vec3<T> direction_across(const Core<T, 1>&, const Core<T, 1>&) {
  return {T(1), T(0), T(0)};
}
template <class Tier, class T>
Vec3<T> direction_across(const Core<T, 1>&, const Core<T, 2>& b) {
  return any_perpendicular<Tier>(b.directions[0]);
}
template <class Tier, class T>
Vec3<T> direction_across(const Core<T, 2>& a, const Core<T, 2>& b) {
  const Vec3<T>& along = a.directions[0];
  const Vec3<T> normal = Tier::cross(along, second_across_first<Tier>(edge_of(a, 0), edge_of(b, 0)));
  if (Tier::dot(normal, normal) > T(0)) return normal;
  return any_perpendicular<Tier>(Tier::dot(along, along) > T(0) ? along : b.directions[0]);
}

template <class Tier, class T>
Vec3<T> unit_of(const Vec3<T>& v) {
  const Vec3<T> moderate = of_moderate_length(v);
  return moderate * (T(1) / sqrt(Tier::dot(moderate, moderate)));
}

/// How far a right answer is from one with this unit normal and these ends of the way, to first order: how far the way
/// leads aside of the normal; and of each core, by how much a vertex is further along the normal than one of those that
/// an end lies within.
template <class Tier, class T, int of_a, int of_b>
T defect_of(const Vec3<T>& normal, const WayBetween<T>& way, const Core<T, of_a>& a, const Core<T, of_b>& b) {
  const Vec3<T> aside = way.way - normal * Tier::dot(way.way, normal);
  const ProjectedRange<T> on_a = projected<Tier>(a, normal), on_b = projected<Tier>(b, normal);
  T from = on_a.most, to = on_b.least;
  for (int i = 0; i < of_a; ++i) {
    if ((way.from_of >> i & 1) != 0) from = smaller(from, T(Tier::dot(normal, a.vertices[i])));
  }
  for (int i = 0; i < of_b; ++i) {
    if ((way.to_of >> i & 1) != 0) to = larger(to, T(Tier::dot(normal, b.vertices[i])));
  }
  return sqrt(Tier::dot(aside, aside)) + (on_a.most - from) + (to - on_b.least);
}

/// The unit normal from A to B that belongs to the way between two points or segments.
template <class Tier, class T, int of_a, int of_b>
Vec3<T> normal_of(const WayBetween<T>& way, const Core<T, of_a>& a, const Core<T, of_b>& b) {
  if (way.way == Vec3<T>{}) return unit_of<Tier>(direction_across<Tier>(a, b));
  const Vec3<T> normal = unit_of<Tier>(way.way);
  if constexpr (MachineNumber<T> && (of_a == 2 || of_b == 2)) {
    Vec3<T> other = unit_of<Tier>(direction_across<Tier>(a, b));
    if (Tier::dot(other, way.way) < T(0)) other = -other;
    if (defect_of<Tier>(other, way, a, b) < defect_of<Tier>(normal, way, a, b)) return other;
  }
  return normal;
}

/// How far two cores are apart along a unit normal, which is negative where they overlap, and the way between their
/// points.
template <class T>
struct ApartAlong {
  Vec3<T> normal;
  T apart{};
  Vec3<T> from, way;
  Vertices of = 0, to = 0;  ///< of a way that proves to be a shortest one: the features at its ends
};

template <class Tier, class T, int of_a, int of_b>
  requires(of_a < 3 && of_b < 3)
ApartAlong<T> apart_along(const Core<T, of_a>& a, const Core<T, of_b>& b) {
  const WayBetween<T> way = shortest_way<Tier>(a, b);
  const Vec3<T> normal = normal_of<Tier>(way, a, b);
  return {normal, Tier::dot(way.way, normal), way.from, way.way, way.from_of, way.to_of};
}

// Of two cores of which one is a triangle or a box.

/// The direction of an edge of a core, and the normal of a face, any length, by its number.
template <class T, int most>
const Vec3<T>& direction_at(const Core<T, most>& core, int i) {
  return core.directions[i];
}
template <class T, int most>
const Vec3<T>& normal_at(const Core<T, most>& core, int i) {
  return core.normals[i];
}

/// The direction of a facet of the difference of the cores, any length: of a face of one of them, or across an edge of
/// each.
template <class Tier, class A, class B>
  requires(B::most_edges > 0)
auto facet_of(const A& a, const B& b, int facet) -> Vec3<typename A::Number> {
  if constexpr (A::most_edges > 1) {
    if (facet < a.count_of_normals) return normal_at(a, facet);
    facet -= a.count_of_normals;
  }
  if constexpr (B::most_edges > 1) {
    if (facet < b.count_of_normals) return normal_at(b, facet);
    facet -= b.count_of_normals;
  }
  if constexpr (A::most_edges > 0) {
    return across_edges<Tier>(direction_at(a, facet / B::most_directions), direction_at(b, facet % B::most_directions));
  } else {
    return {};
  }
}
/// Calls f(direction) for each facet, in the order of their numbers.
template <class Tier, class T, int of_a, int of_b, class F>
void for_each_facet(const Core<T, of_a>& a, const Core<T, of_b>& b, F&& f) {
  for (int i = 0; i < a.count_of_normals; ++i) f(a.normals[i]);
  for (int i = 0; i < b.count_of_normals; ++i) f(b.normals[i]);
  for (const Vec3<T>& d : a.directions) {
    for (const Vec3<T>& e : b.directions) f(across_edges<Tier>(d, e));
  }
}

/// How far the second core is from the first one along a direction, times its length.
template <class Tier, class T, int of_a, int of_b>
T gap_along(const Vec3<T>& direction, const Core<T, of_a>& a, const Core<T, of_b>& b) {
  return projected<Tier>(b, direction).least - projected<Tier>(a, direction).most;
}

template <class T, int most>
Core<T, most> moved_by(const Vec3<T>& way, Core<T, most> core) {
  for (Vec3<T>& v : core.vertices) v = v + way;
  return core;
}

/// Perpendicular to an edge of a core; of points, any.
template <class Tier, class T, int of_a, int of_b>
Vec3<T> across_some_edge(const Core<T, of_a>& a, const Core<T, of_b>& b) {
  for (const Vec3<T>& d : a.directions) {
    if (!(d == Vec3<T>{})) return any_perpendicular<Tier>(d);
  }
  for (const Vec3<T>& e : b.directions) {
    if (!(e == Vec3<T>{})) return any_perpendicular<Tier>(e);
  }
  return {T(1), T(0), T(0)};
}

/// What is proved of two cores, or proposed: they are apart, and the shortest way is between these features; or they
/// overlap by the least along a facet, and these features meet when they are moved apart.
struct Proved {
  bool apart;
  Vertices of, to;
  int facet = -1;         ///< that these features have; without one, they are a vertex and a vertex or an edge
  bool opposite = false;  ///< whether the second core is on the other side of the facet
};

/// Whether each comparison of numbers of this type has the result that numbers with error bounds had before. So what
/// these have proved need not be proved again.
template <class T>
concept FollowsDecisions = requires { T::follows_decisions; };

/// The vertices of a core without those that are equal to another one because a box is flat. Exact numbers that are
/// equal are dear to compare.
template <class T, int most>
constexpr Vertices distinct_vertices(const Core<T, most>&) {
  return all_vertices<most>;
}
template <class T>
constexpr Vertices distinct_vertices(const CoreOfBox<T>& box) {
  Vertices distinct = all_vertices<8>;
  for (int axis = 0; axis < 3; ++axis) {
    if ((box.flat >> axis & 1) != 0) distinct &= on_side(axis, false);
  }
  return distinct;
}

/// These vertices, or the distinct ones that are equal to them.
template <class T, int most>
constexpr Vertices distinct_of(const Core<T, most>&, Vertices vertices) {
  return vertices;
}
template <class T>
constexpr Vertices distinct_of(const CoreOfBox<T>& box, Vertices vertices) {
  for (int axis = 0; axis < 3; ++axis) {
    if ((box.flat >> axis & 1) == 0) continue;
    vertices = (vertices & on_side(axis, false)) | (vertices & on_side(axis, true)) >> (1 << axis);
  }
  return vertices;
}

template <class T>
T largest(const Vec3<T>& v) {
  return larger(larger(abs(v.x), abs(v.y)), abs(v.z));
}

/// The distinct vertices of a core that may be furthest along a unit direction: also those whose number overflows, so
/// never none. Those of a large box have large errors: of a box, by the edges that are not nearly perpendicular to the
/// direction.
template <int most>
Vertices furthest_vertices(const Core<double, most>& core, const Vec3<double>& direction, double rounding) {
  const double level = projected<Plain>(core, direction).most - 2 * rounding;
  Vertices furthest = 0;
  for (int i = 0; i < most; ++i) furthest |= Vertices(!(Plain::dot(direction, core.vertices[i]) < level)) << i;
  return furthest;
}
inline Vertices furthest_vertices(const CoreOfBox<double>& box, const Vec3<double>& direction, double rounding) {
  Vertices furthest = distinct_vertices(box);
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = Plain::dot(direction, box.reach[axis]);
    const double error = rounding + 16 * std::numeric_limits<double>::epsilon() * largest(box.reach[axis]);
    if ((box.flat >> axis & 1) == 0 && abs(reach) > error) furthest &= on_side(axis, reach > 0);
  }
  return furthest;
}

/// What doubles say of two cores, for other numbers to prove: the cores, how they are apart, and how much rounding may
/// change of a place.
template <class A, class B>
struct Guess {
  A a;
  B b;
  ApartAlong<double> apart;
  double rounding;

  bool overlap() const { return apart.apart < -rounding; }
  struct Furthest {
    Vertices a, b;
  };
  /// The vertices that may be furthest along a direction from A to B.
  Furthest furthest_along(const Vec3<double>& direction) const {
    return {furthest_vertices(a, direction, rounding), furthest_vertices(b, -direction, rounding)};
  }
  /// The shortest way between what is furthest along the normal, the cores moved apart if they overlap.
  [[gnu::noinline]] std::optional<WayBetween<double>> way_at_normal() const {
    const auto [near_a, near_b] = furthest_along(apart.normal);
    if (!overlap()) return shortest_way_among<Plain>(a, near_a, b, near_b);
    return shortest_way_among<Plain>(a, near_a, moved_by(apart.normal * -apart.apart, b), near_b);
  }
};

/// The double next to a number, or near enough for a guess.
template <class N>
double nearest_double(const N& number) {
  if constexpr (requires { number.rounded(); }) {
    return double(number.rounded());
  } else if constexpr (requires { number.value; }) {
    return nearest_double(number.value);
  } else if constexpr (requires { number.high; }) {
    return double(number.high);
  } else {
    return double(number);
  }
}

/// Whether a number is zero without a doubt.
template <class T>
bool is_surely_zero(const T& x) {
  if constexpr (DecidesEquality<T>) {
    return x == T(0);
  } else {
    return nearest_double(x) == 0 && x.error == 0;
  }
}
/// Whether it is in doubt which sign a number has. Of exact numbers it may take long to tell that they are zero.
template <class T>
bool has_doubtful_sign(const T& x) {
  if constexpr (DecidesEquality<T>) {
    return true;
  } else {
    return !(abs(nearest_double(x)) > 2 * x.error);
  }
}
template <class Tier, class T>
bool are_surely_parallel(const Vec3<T>& v, const Vec3<T>& w) {
  const Vec3<T> cross = Tier::cross(v, w);
  return is_surely_zero(cross.x) && is_surely_zero(cross.y) && is_surely_zero(cross.z);
}

/// Calls f(v) for each distinct vertex of a core that is not among these, while f returns true.
template <class AnyCore, class F>
bool each_other_vertex(const AnyCore& core, Vertices among, F&& f) {
  for (Vertices others = distinct_vertices(core) & ~among; others != 0; others &= others - 1) {
    if (!f(core.vertices[std::countr_zero(others)])) return false;
  }
  return true;
}

/// Whether no vertex of a core is further along a direction than a feature that is perpendicular to it. The direction
/// is also perpendicular to `edge`.
template <class Tier, class T, int most>
bool is_furthest(const Core<T, most>& core, Vertices feature, const Vec3<T>& direction, const Vec3<T>* = nullptr) {
  const Vec3<T>& at = core.vertices[std::countr_zero(feature)];
  return each_other_vertex(core, feature, [&](const Vec3<T>& v) { return Tier::dot(direction, v - at) <= T(0); });
}
/// Of a box: whether no edge that leaves the feature leads further.
template <class Tier, class T>
bool is_furthest(const CoreOfBox<T>& box, Vertices feature, const Vec3<T>& direction, const Vec3<T>* edge = nullptr) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool before = (feature & on_side(axis, false)) != 0, behind = (feature & on_side(axis, true)) != 0;
    if ((box.flat >> axis & 1) != 0 || (before && behind)) continue;
    const T along = Tier::dot(direction, box.directions[axis]);
    if (edge != nullptr && has_doubtful_sign(along) && are_surely_parallel<Tier>(*edge, box.directions[axis])) continue;
    if (!(before ? along <= T(0) : along >= T(0))) return false;
  }
  return true;
}

// What a core says of itself, computed when it is asked for, in the same way: for an answer that needs little of it.
template <class T>
struct BoxOnDemand {
  using Number = T;
  static constexpr int most_edges = 12, most_directions = 3, count_of_normals = 3;
  static constexpr bool has_unit_normals = true;

  BoxOnDemand(const Box<T>& box, const Vec3<T>& origin)
      : center(box.center - origin), axes(axes_of(box.orientation)), half(box.half) {}

  Vec3<T> center;
  Axes<T> axes;
  const Vec3<T>& half;
  T radius{};
};
template <class T>
struct TriangleOnDemand {
  using Number = T;
  static constexpr int most_edges = 3, most_directions = 3, count_of_normals = 1;
  static constexpr bool has_unit_normals = false;

  TriangleOnDemand(const Triangle<T>& triangle, const Vec3<T>& from)
      : corners{triangle.v0, triangle.v1, triangle.v2}, origin(from) {}

  std::array<Vec3<T>, 3> corners;
  const Vec3<T>& origin;
  T radius{};
};
template <class T, int most>
const Vec3<T>& vertex_of(const Core<T, most>& core, int i) {
  return core.vertices[i];
}
template <class T>
Vec3<T> vertex_of(const TriangleOnDemand<T>& triangle, int i) {
  return triangle.corners[i] - triangle.origin;
}
template <class T>
Vec3<T> vertex_of(const BoxOnDemand<T>& box, int i) {
  const auto side = [&](int axis, const T& half) { return box.axes[axis] * ((i >> axis & 1) != 0 ? half : -half); };
  return box.center + (side(0, box.half.x) + side(1, box.half.y) + side(2, box.half.z));
}
template <class T>
const Vec3<T>& direction_at(const BoxOnDemand<T>& box, int i) {
  return box.axes[i];
}
template <class T>
const Vec3<T>& normal_at(const BoxOnDemand<T>& box, int i) {
  return box.axes[i];
}
template <class T>
Vec3<T> direction_at(const TriangleOnDemand<T>& triangle, int i) {
  return triangle.corners[(i + 1) % 3] - triangle.corners[i];
}
template <class T>
Vec3<T> normal_at(const TriangleOnDemand<T>& triangle, int) {
  return Plain::cross(direction_at(triangle, 0), direction_at(triangle, 1));
}

/// The number of the direction of an edge, given by its ends.
template <class Core>
int direction_number(const Core&, Vertices ends) {
  if constexpr (Core::most_edges == 3) return ends == 3 ? 0 : ends == 6 ? 1 : 2;
  if constexpr (Core::most_edges == 12) return std::countr_zero(unsigned(std::countr_zero(ends) ^ last_of(ends)));
  return 0;
}
/// The direction of an edge; none of another feature.
template <class T, int most>
const Vec3<T>* direction_of(const Core<T, most>& core, Vertices feature) {
  if constexpr (most > 1) {
    if (std::popcount(feature) == 2) return &core.directions[direction_number(core, feature)];
  }
  return nullptr;
}

/// Whether a way, perpendicular to the features at its ends, has a length and no way is shorter.
template <class Tier, class T, class A, class B>
bool is_shortest(const WayBetween<T>& way, const A& a, const B& b) {
  return Tier::dot(way.way, way.way) > T(0) && is_furthest<Tier>(a, way.from_of, way.way, direction_of(b, way.to_of)) &&
         is_furthest<Tier>(b, way.to_of, -way.way, direction_of(a, way.from_of));
}

/// The direction of the facet of the difference of two cores along which they are apart by the most: the facet's number
/// in for_each_facet, its direction, the gap along it times its length, and its squared length. None without facets.
template <class T>
struct FacetOfMost {
  int facet = -1;
  bool opposite = false;
  Vec3<T> direction{};
  T gap{}, length2{};
};
/// Calls f for both directions of a facet that has one.
template <class Tier, class T, class A, class B, class F>
void with_both_sides(const Vec3<T>& facet, int number, const A& a, const B& b, F&& f) {
  const T length2 = Tier::dot(facet, facet);
  if (!(length2 > T(0))) return;
  const ProjectedRange<T> on_a = projected<Tier>(a, facet), on_b = projected<Tier>(b, facet);
  f(FacetOfMost<T>{number, false, facet, on_b.least - on_a.most, length2});
  f(FacetOfMost<T>{number, true, -facet, on_a.least - on_b.most, length2});
}
template <class Tier, class A, class B>
auto facet_of_most(const A& a, const B& b) {
  using T = typename A::Number;
  FacetOfMost<T> most;
  int number = 0;
  for_each_facet<Tier>(a, b, [&](const Vec3<T>& facet) {
    with_both_sides<Tier>(facet, number++, a, b, [&](const FacetOfMost<T>& side) {
      // gap |gap| / |direction|^2 grows with gap / |direction|
      if (most.facet < 0 || side.gap * abs(side.gap) * most.length2 > most.gap * abs(most.gap) * side.length2)
        most = side;
    });
  });
  return most;
}

/// The answer along a shortest way.
template <class Tier, class T>
ApartAlong<T> along_way(const WayBetween<T>& way) {
  const T length = sqrt(Tier::dot(way.way, way.way));
  return {way.way * (T(1) / length), length, way.from, way.way};
}
/// How far the second core is moved back along a facet of overlapping ones until they touch.
template <class T>
Vec3<T> out_of(const FacetOfMost<T>& most) {
  return most.direction * (most.gap / most.length2);
}
/// The answer along a facet of overlapping cores, whose first point is `from`.
template <class Tier, class T>
ApartAlong<T> along_facet(const FacetOfMost<T>& most, const Vec3<T>& from) {
  const T length = sqrt(most.length2);
  return {most.direction * (T(1) / length), most.gap / length, from, out_of(most)};
}

/// The number of a face among the normals of its core; of a vertex, an edge or all of a flat core, -1.
template <class T, int most>
int normal_of_face(const Core<T, most>&, Vertices face) {
  if constexpr (most == 8) {
    for (int axis = 0; axis < 3; ++axis) {
      if (face == on_side(axis, false) || face == on_side(axis, true)) return axis;
    }
    return -1;
  }
  return most == 3 && face == all_vertices<3> ? 0 : -1;
}
/// The facet of the difference of two cores that a face of one and a vertex of the other have, or an edge of each; -1
/// of other features.
template <class T, int of_a, int of_b>
int facet_of_features(const Core<T, of_a>& a, Vertices of, const Core<T, of_b>& b, Vertices to) {
  const int count_a = std::popcount(of), count_b = std::popcount(to);
  if (count_b == 1 && count_a > 2) return normal_of_face(a, of);
  if (count_a == 1 && count_b > 2) {
    const int face = normal_of_face(b, to);
    return face < 0 ? face : a.count_of_normals + face;
  }
  if constexpr (of_a > 1 && of_b > 1) {
    if (count_a == 2 && count_b == 2) {
      const auto i = edge_with_ends(a, of), k = edge_with_ends(b, to);
      if (i && k)
        return a.count_of_normals + b.count_of_normals + a.edges[*i].direction * int(b.directions.size()) +
               b.edges[*k].direction;
    }
  }
  return -1;
}

/// Whether a point is across a face, which is closed.
template <class Tier, class T, int most>
  requires(most < 3)
bool is_across_face(const Core<T, most>&, Vertices, const Vec3<T>&) {
  return false;
}
template <class Tier, class T>
bool is_across_face(const Core<T, 3>& triangle, Vertices, const Vec3<T>& point) {
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> inward = Tier::cross(triangle.normals[0], triangle.directions[i]);
    if (!(Tier::dot(inward, point - triangle.vertices[i]) >= T(0))) return false;
  }
  return true;
}
template <class Tier, class T>
bool is_across_face(const Core<T, 8>& box, Vertices face, const Vec3<T>& point) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_of_face = (face & on_side(axis, false)) != 0 && (face & on_side(axis, true)) != 0;
    const Vec3<T>& along = box.directions[axis];
    if (is_of_face &&
        !(Tier::dot(along, point - box.vertices[0]) >= T(0) && Tier::dot(along, point - box.vertices[7]) <= T(0)))
      return false;
  }
  return true;
}

/// The answer along the facet that two features have, one of them a vertex and the other a face, or both edges. None
/// where numbers that prove find that these features are not across each other, or that a vertex is further along the
/// facet than they are.
template <class Tier, class A, class B>
auto apart_along_facet(const A& a, const B& b, const Proved& features)
    -> std::optional<ApartAlong<typename A::Number>> {
  using T = typename A::Number;
  constexpr bool proves = !FollowsDecisions<T>;
  const auto& [is_apart, of, to, facet, opposite] = features;
  const Vec3<T>&on_a = vertex_of(a, std::countr_zero(of)), &on_b = vertex_of(b, std::countr_zero(to));
  const Vec3<T> direction = facet_of<Tier>(a, b, facet), normal = opposite ? -direction : direction;
  const Vec3<T> between = on_b - on_a;
  const T gap = Tier::dot(normal, between);
  if constexpr (proves) {
    if (!(is_apart ? gap > T(0) : gap < T(0))) return std::nullopt;
    if (!is_furthest<Tier>(a, of, normal) || !is_furthest<Tier>(b, to, -normal)) return std::nullopt;
  }
  const bool of_a = facet < a.count_of_normals, of_b = !of_a && facet < a.count_of_normals + b.count_of_normals;
  if ((of_a && A::has_unit_normals) || (of_b && B::has_unit_normals)) {
    const Vec3<T> way = normal * gap;
    if constexpr (proves) {
      if (of_a ? !is_across_face<Tier>(a, of, on_b) : !is_across_face<Tier>(b, to, on_a)) return std::nullopt;
    }
    return ApartAlong<T>{normal, gap, of_a ? on_b - way : on_a, way};
  }
  const T length2 = Tier::dot(direction, direction);
  if constexpr (proves) {
    if (!(length2 > T(0))) return std::nullopt;
  }
  const T length = sqrt(length2);
  const Vec3<T> way = normal * (gap / length2);
  ApartAlong<T> apart{normal * (T(1) / length), gap / length, on_a, way};
  if (of_a || of_b) {
    if constexpr (proves) {
      if (of_a ? !is_across_face<Tier>(a, of, on_b) : !is_across_face<Tier>(b, to, on_a)) return std::nullopt;
    }
    if (of_a) apart.from = on_b - way;
    return apart;
  }
  if constexpr (A::most_edges > 0 && B::most_edges > 0) {
    // The point of an edge that is across the other one, by parts of the edges perpendicular to the facet.
    const Vec3<T>&d = direction_at(a, direction_number(a, of)), &e = direction_at(b, direction_number(b, to));
    const Vec3<T> beside_b = Tier::cross(e, direction);
    const T at = Tier::dot(beside_b, between);
    if constexpr (proves) {
      const Vec3<T> beside_a = Tier::cross(d, direction);
      const Vec3<T>&end_a = vertex_of(a, last_of(of)), &end_b = vertex_of(b, last_of(to));
      const auto is_between = [](const T& first, const T& second) {
        return first > T(0) ? second < T(0) : first < T(0) && second > T(0);
      };
      if (!is_between(at, Tier::dot(beside_b, on_b - end_a)) ||
          !is_between(Tier::dot(beside_a, between), Tier::dot(beside_a, end_b - on_a)))
        return std::nullopt;
    }
    apart.from = on_a + d * (at / length2);
    return apart;
  }
  return std::nullopt;
}

/// The way from a point or an edge, given by its ends, to a point.
template <class Tier, class A, class T>
WayBetween<T> way_from(const A& core, Vertices feature, const Vec3<T>& point) {
  int first = std::countr_zero(feature), last = last_of(feature);
  if constexpr (A::most_edges == 3) {
    if (first == 0 && last == 2) std::swap(first, last);  // that edge leads from the last vertex to the first one
  }
  const Vec3<T>& from = vertex_of(core, first);
  if constexpr (A::most_edges > 0) {
    if (first != last)
      return shortest_way<Tier>(
          EdgeOfCore<T>{from, vertex_of(core, last), direction_at(core, direction_number(core, feature))}, point);
  }
  return {from, point - from};
}

/// The shortest way between two features that have no facet, a vertex and a vertex or an edge. None of others, and none
/// where it ends at the end of the edge.
template <class Tier, class A, class B>
auto way_without_facet(const A& a, Vertices of, const B& b, Vertices to)
    -> std::optional<WayBetween<typename A::Number>> {
  using T = typename A::Number;
  const bool from_edge = std::popcount(of) == 2, to_edge = std::popcount(to) == 2;
  const Vec3<T>&on_a = vertex_of(a, std::countr_zero(of)), &on_b = vertex_of(b, std::countr_zero(to));
  if (std::popcount(of) + std::popcount(to) > 3) return std::nullopt;
  WayBetween<T> way = from_edge ? way_from<Tier>(a, of, on_b) : way_from<Tier>(b, to, on_a);
  if constexpr (!FollowsDecisions<T>) {
    if ((from_edge || to_edge) && way.from_of != both_ends) return std::nullopt;
  }
  if (!from_edge) way.from = on_a, way.way = -way.way;
  way.from_of = of, way.to_of = to;
  return way;
}

/// The answer from what has been proved.
template <class Tier, class A, class B>
auto apart_as_proved(const A& a, const B& b, const Proved& proved) -> ApartAlong<typename A::Number> {
  if (proved.facet >= 0) return *apart_along_facet<Tier>(a, b, proved);
  return along_way<Tier>(*way_without_facet<Tier>(a, proved.of, b, proved.to));
}

/// A facet of the difference of two boxes across two edges, of which one is parallel to another edge of the other box
/// without a doubt, is parallel to a face: its number. Of any other facet its own number.
template <class Tier, class A, class B>
int face_parallel_to(const A& a, const B& b, int facet) {
  if constexpr (A::has_unit_normals && B::has_unit_normals) {
    if (facet < 6) return facet;
    const int i = (facet - 6) / 3, j = (facet - 6) % 3;
    for (int k = 0; k < 3; ++k) {
      if (k != j && are_surely_parallel<Tier>(a.directions[i], b.directions[k])) return 3 + (3 - j - k);
      if (k != i && are_surely_parallel<Tier>(a.directions[k], b.directions[j])) return 3 - i - k;
    }
  }
  return facet;
}

/// Whether cores overlap along each facet of their difference, and along no other one by less than along this one,
/// where these features are furthest.
template <class Tier, class A, class B>
[[gnu::noinline]] bool is_least_overlap(const A& a, const B& b, const Proved& features) {
  using T = typename A::Number;
  const Vec3<T> facet = facet_of<Tier>(a, b, features.facet), normal = features.opposite ? -facet : facet;
  const T length2 = Tier::dot(facet, facet);
  const T gap =
      Tier::dot(normal, b.vertices[std::countr_zero(features.to)] - a.vertices[std::countr_zero(features.of)]);
  const T gap2 = gap * gap;
  bool is_least = true;
  int number = 0;
  for_each_facet<Tier>(a, b, [&](const Vec3<T>& other) {
    const int own = number++;
    if (!is_least) return;
    with_both_sides<Tier>(other, own, a, b, [&](const FacetOfMost<T>& side) {
      if (!is_least || (side.facet == features.facet && side.opposite == features.opposite)) return;
      const T theirs = side.gap * side.gap * length2, ours = gap2 * side.length2;
      const bool is_same = has_doubtful_sign(theirs - ours) &&
                           (are_surely_parallel<Tier>(side.direction, normal) ||
                            face_parallel_to<Tier>(a, b, own) == face_parallel_to<Tier>(a, b, features.facet)) &&
                           Tier::dot(side.direction, normal) > T(0);
      is_least = is_same || (side.gap < T(0) && theirs >= ours);
    });
  });
  return is_least;
}

/// What a proof finds. One that fails or leaves a doubt finds nothing, and leaves no doubt.
template <class T, class Proof>
auto found_without_doubt(Proof&& proof) {
  if constexpr (DecidesEquality<T>) {
    return proof();
  } else {
    const bool before = std::exchange(T::doubt(), false);
    auto found = proof();
    if (T::doubt()) found.reset();
    T::doubt() = before;
    return found;
  }
}

/// The answer between these features, if it proves to be one.
template <class Tier, class A, class B, class Guess>
auto apart_between(const A& a, Vertices of, const B& b, Vertices to, const Guess& guess, std::optional<Proved>& proved)
    -> std::optional<ApartAlong<typename A::Number>> {
  Proved proposed{.apart = !guess.overlap(), .of = of, .to = to, .facet = facet_of_features(guess.a, of, guess.b, to)};
  if (proposed.facet >= 0) {
    const Vec3<double> facet = facet_of<Plain>(guess.a, guess.b, proposed.facet);
    proposed.opposite = Plain::dot(facet, guess.apart.normal) < 0;
  }
  using T = typename A::Number;
  const auto apart = found_without_doubt<T>([&]() -> std::optional<ApartAlong<T>> {
    if (proposed.facet >= 0) {
      if (!proposed.apart && !is_least_overlap<Tier>(a, b, proposed)) return std::nullopt;
      return apart_along_facet<Tier>(a, b, proposed);
    }
    const auto way = proposed.apart ? way_without_facet<Tier>(a, of, b, to) : std::nullopt;
    return way && is_shortest<Tier>(*way, a, b) ? std::optional(along_way<Tier>(*way)) : std::nullopt;
  });
  if (apart) proved = proposed;
  return apart;
}

/// The answer between features that doubles propose, if it proves to be one: a proof is short, a search is not.
template <class Tier, class A, class B, class Guess>
auto apart_as_proposed(const A& a, const B& b, const Guess& guess, std::optional<Proved>& proved)
    -> std::optional<ApartAlong<typename A::Number>> {
  Vertices of = distinct_of(guess.a, guess.apart.of), to = distinct_of(guess.b, guess.apart.to);
  for (const bool is_last : {false, true}) {
    if (is_last) {
      const auto way = guess.way_at_normal();
      if (!way || (way->from_of == of && way->to_of == to)) break;
      of = way->from_of, to = way->to_of;
    } else if (of == 0 || to == 0) {
      continue;
    }
    if (const auto apart = apart_between<Tier>(a, of, b, to, guess, proved)) return apart;
  }
  return std::nullopt;
}

/// Of exact numbers, and of those with error bounds, where what doubles propose has not been proved. Cores that overlap
/// along each facet of their difference do so least along one of them, and have a common point when they are moved
/// apart by as much. Otherwise a shortest way is the answer, unless they touch. What is furthest along a direction is
/// asked first: if every other vertex is less far than one of these, cores that touch there have a common point
/// between these.
template <class Tier, class A, class B, class Guess>
[[gnu::noinline]] auto apart_by_search(const A& a, const B& b, const Guess& guess) {
  using T = typename A::Number;
  const FacetOfMost<T> most = facet_of_most<Tier>(a, b);
  const auto along_most = [&] {
    const Vec3<double> facet = facet_of<Plain>(guess.a, guess.b, most.facet);
    return guess.furthest_along(facet == Vec3<double>{} ? facet : unit_of<Plain>(most.opposite ? -facet : facet));
  };
  if (most.facet >= 0 && most.gap <= T(0)) {
    const auto moved = moved_by(-out_of(most), b);
    const auto [near_a, near_b] = along_most();
    const auto is_less_far = [&](const auto& core, Vertices near, const Vec3<T>& direction) {
      const Vec3<T>& at = core.vertices[std::countr_zero(near)];
      return each_other_vertex(core, near, [&](const Vec3<T>& v) { return Tier::dot(direction, v - at) < T(0); });
    };
    std::optional<WayBetween<T>> way;
    if (is_less_far(a, near_a, most.direction) && is_less_far(b, near_b, -most.direction))
      way = shortest_way_among<Tier>(a, near_a, moved, near_b);
    if (most.gap < T(0)) {
      if (!way) way = shortest_of_ways<Tier>(a, moved);
      return along_facet<Tier>(most, way->from);
    }
    if (way && way->way == Vec3<T>{}) return ApartAlong<T>{unit_of<Tier>(most.direction), T(0), way->from, {}};
  } else {
    const auto shortest_among = [&](const auto& near) {
      const auto way = shortest_way_among<Tier>(a, near.a, b, near.b);
      return way && is_shortest<Tier>(*way, a, b) ? way : std::nullopt;
    };
    auto way = shortest_among(guess.furthest_along(guess.apart.normal));
    if (!way && most.facet >= 0) way = shortest_among(along_most());
    if (way) return along_way<Tier>(*way);
  }
  const WayBetween<T> way = shortest_of_ways<Tier>(a, b);
  if (gap_along<Tier>(way.way, a, b) > T(0)) return along_way<Tier>(way);
  return ApartAlong<T>{
      unit_of<Tier>(most.facet >= 0 ? most.direction : across_some_edge<Tier>(a, b)), T(0), way.from, {}};
}

/// Of exact numbers, and of those with error bounds.
template <class Tier, class A, class B, class Proposal>
auto exactly_apart(const A& a, const B& b, Proposal& proposal) -> ApartAlong<typename A::Number> {
  using T = typename A::Number;
  proposal.proved.reset();
  const auto& guess = proposal.guess();
  if (const auto apart = apart_as_proposed<Tier>(a, b, guess, proposal.proved)) return *apart;
  if constexpr (A::most_edges < 2 && B::most_edges < 2) {
    return apart_along<Tier>(a, b);
  } else if constexpr (requires { T::only_proves; }) {
    T::doubt() = true;
    return {};
  } else {
    return apart_by_search<Tier>(a, b, guess);
  }
}

/// The shortest ways between every two features of the cores: the shortest of them, and the lengths of all.
template <class Tier, class T, int of_a, int of_b>
class AllWays {
 public:
  [[gnu::noinline]] AllWays(const Core<T, of_a>& a, const Core<T, of_b>& b) {
    for_each_way<Tier>(a, b, [this](const WayBetween<T>& way) {
      const T length2 = Tier::dot(way.way, way.way);
      if (count_ == 0 || length2 < least2_) shortest_ = way, least2_ = length2;
      ends_[count_++] = {length2, way.from_of, way.to_of};
    });
  }
  const WayBetween<T>& shortest() const { return shortest_; }
  struct Near {
    Vertices on_a = 0, on_b = 0;
  };
  /// The vertices of the features at the ends of all ways of at most this squared length.
  Near ends_within(T length2) const {
    Near near;
    for (int i = 0; i < count_; ++i) {
      if (ends_[i].length2 <= length2) near.on_a |= ends_[i].from_of, near.on_b |= ends_[i].to_of;
    }
    return near;
  }

 private:
  struct Ends {
    T length2;
    Vertices from_of, to_of;
  };
  static constexpr int most_edges_of_a = of_a == 1 ? 1 : Core<T, of_a>::most_edges;
  static constexpr int most_edges_of_b = of_b == 1 ? 1 : Core<T, of_b>::most_edges;
  std::array<Ends, of_a + of_b + most_edges_of_a * most_edges_of_b> ends_;
  int count_ = 0;
  WayBetween<T> shortest_;
  T least2_{};
};

/// The tier of a guess: of cores that overlap it needs no points.
struct Guessing : Plain {};

/// Of machine numbers, where rounding may be as large as what tells one way from another. By weak duality, the
/// normal and the points of an answer belong together if its defect is zero. So each normal along which the cores are
/// apart by the most, but for rounding, is asked with each way between the features that are furthest along it, the
/// second core moved back along that normal; the answer has the least defect.
template <class Tier, class T, int of_a, int of_b>
class LeastDefect {
 public:
  [[gnu::noinline]] LeastDefect(const Core<T, of_a>& a, const Core<T, of_b>& b, T rounding)
      : a_(a), b_(b), rounding_(rounding) {
    for_each_facet<Tier>(
        a_, b_, each_unit([this](const Vec3<T>& unit) { include(facets_[count_of_facets_++] = along(unit)); }));
    overlap_ = most_ > -std::numeric_limits<T>::max() && most_ < -rounding_;
  }

  /// Whether they overlap along each facet of their difference.
  bool overlap() const { return overlap_; }
  [[gnu::noinline]] ApartAlong<T> of_facets() {
    if constexpr (std::same_as<Tier, Guessing>) {
      for (int i = 0; overlap_ && i < count_of_facets_; ++i) {
        const auto& [unit, a, b] = facets_[i];
        if (b.least - a.most == most_) return {unit, most_, {}, {}};
        if (a.least - b.most == most_) return {-unit, most_, {}, {}};
      }
    }
    for (int i = 0; i < count_of_facets_; ++i) try_both(facets_[i]);
    return best_;
  }
  /// Also for the other directions that a shortest way may have. A way that is not much longer than this one ends at
  /// the same vertices as a shortest way.
  [[gnu::noinline]] ApartAlong<T> of_all_directions(const AllWays<Tier, T, of_a, of_b>& ways) {
    const Vec3<T>& shortest = ways.shortest().way;
    const T length = sqrt(Tier::dot(shortest, shortest)) + rounding_;
    const auto [near_a, near_b] = ways.ends_within(length * length);
    const auto each_direction = [&](auto&& f) {
      for (int i = 0; i < of_a; ++i) {
        for (int k = 0; k < of_b; ++k) {
          if ((near_a >> i & 1) == 0 || (near_b >> k & 1) == 0) continue;
          const Vec3<T> way = b_.vertices[k] - a_.vertices[i];
          f(way);
          for (const Vec3<T>& d : a_.directions) f(perpendicular_part<Tier>(way, d));
          for (const Vec3<T>& e : b_.directions) f(perpendicular_part<Tier>(way, e));
        }
      }
      f(across_some_edge<Tier>(a_, b_));
    };
    each_direction(each_unit([this](const Vec3<T>& unit) { include(along(unit)); }));
    of_facets();
    each_direction(each_unit([this](const Vec3<T>& unit) {
      if (!is_settled()) try_both(along(unit));
    }));
    return best_;
  }

 private:
  template <class F>
  static auto each_unit(F f) {
    return [f](const Vec3<T>& direction) {
      if (direction == Vec3<T>{}) return;
      f(unit_of<Tier>(direction));
    };
  }
  /// The cores along a direction.
  struct Along {
    Vec3<T> unit;
    ProjectedRange<T> a, b;
  };
  Along along(const Vec3<T>& unit) const { return {unit, projected<Tier>(a_, unit), projected<Tier>(b_, unit)}; }
  void include(const Along& direction) {
    const auto& [unit, a, b] = direction;
    most_ = larger(most_, larger(T(b.least - a.most), T(a.least - b.most)));
  }
  bool is_settled() const { return least_defect_ <= rounding_ / T(16); }
  void try_both(const Along& direction) {
    if (is_settled()) return;
    const auto& [unit, a, b] = direction;
    if (b.least - a.most >= most_ - rounding_) try_with(unit, a.most, b.least);
    if (a.least - b.most >= most_ - rounding_) try_with(-unit, -a.least, -b.most);
  }
  [[gnu::noinline]] void try_with(const Vec3<T>& normal, T level_a, T level_b) {
    const T gap = level_b - level_a;
    Vertices furthest_a = 0, furthest_b = 0;
    for (int i = 0; i < of_a; ++i)
      furthest_a |= Vertices(Tier::dot(normal, a_.vertices[i]) >= level_a - T(2) * rounding_) << i;
    for (int k = 0; k < of_b; ++k)
      furthest_b |= Vertices(Tier::dot(normal, b_.vertices[k]) <= level_b + T(2) * rounding_) << k;
    const T apart = is_flat ? larger(gap, T(0)) : gap;
    const Vec3<T> out = normal * apart;
    for_each_way_among<Tier>(a_, furthest_a, moved_by(-out, b_), furthest_b, [&](const WayBetween<T>& way) {
      const T defect = defect_of<Tier>(normal, way, a_, b_);
      if (!(defect < least_defect_)) return;
      least_defect_ = defect;
      best_ = {normal, apart, way.from, out};
    });
  }

  /// The difference of a point and a triangle has no volume, so they do not overlap by any depth.
  static constexpr bool is_flat = of_a == 1 && of_b == 3;

  const Core<T, of_a>& a_;
  const Core<T, of_b>& b_;
  const T rounding_;
  static constexpr int most_facets = Core<T, of_a>::most_directions + Core<T, of_b>::most_directions +
                                     Core<T, of_a>::most_directions * Core<T, of_b>::most_directions;
  std::array<Along, most_facets> facets_;
  int count_of_facets_ = 0;
  bool overlap_ = false;
  T most_ = -std::numeric_limits<T>::max(), least_defect_ = std::numeric_limits<T>::infinity();
  ApartAlong<T> best_{};
};

template <class T, int most>
T largest_coordinate(const Core<T, most>& core) {
  T size{};
  for (const Vec3<T>& v : core.vertices) size = larger(size, largest(v));
  return size;
}
template <class T, int most>
bool is_finite(const Core<T, most>& core) {
  T nothing{};
  for (const Vec3<T>& v : core.vertices) nothing += (v.x - v.x) + (v.y - v.y) + (v.z - v.z);
  return nothing == T(0);
}
/// How much rounding may change of a way between the cores, at most. A box is at the origin and aligned with the axes:
/// where it is larger than where the other core lies, its size is in no number of the way.
template <class T, int of_a, int of_b>
T rounding_between(const Core<T, of_a>& a, const Core<T, of_b>& b) {
  const T size = of_b == 8 ? largest_coordinate(a) : larger(largest_coordinate(a), largest_coordinate(b));
  return T(64) * std::numeric_limits<T>::epsilon() * size;
}

/// The vertex of a core that is furthest along a direction.
template <class Tier, class T, int most>
int furthest_vertex(const Core<T, most>& core, const Vec3<T>& direction) {
  int furthest = 0;
  T at = Tier::dot(direction, core.vertices[0]);
  for (int i = 1; i < most; ++i) {
    const T other = Tier::dot(direction, core.vertices[i]);
    if (other > at) furthest = i, at = other;
  }
  return furthest;
}

/// The unit normal along a way between two cores. The edges of a box keep their directions when its numbers change by
/// rounding, however long the way is; so between two edges the normal is that across both, if it is across them better.
template <class Tier, class T, int of_a, int of_b>
Vec3<T> normal_along(const WayBetween<T>& way, const Core<T, of_a>& a, const Core<T, of_b>& b) {
  const Vec3<T> normal = unit_of<Tier>(way.way);
  if constexpr (of_a > 1 && of_b == 8) {
    if (std::popcount(way.from_of) == 2 && std::popcount(way.to_of) == 2) {
      const auto edge = [](const auto& core, Vertices ends) {
        return unit_of<Tier>(core.vertices[last_of(ends)] - core.vertices[std::countr_zero(ends)]);
      };
      const Vec3<T> d = edge(a, way.from_of), e = edge(b, way.to_of), across = across_edges<Tier>(d, e);
      if (across == Vec3<T>{}) return normal;
      const Vec3<T> unit = unit_of<Tier>(across);
      const auto along_edges = [&](const Vec3<T>& n) { return abs(Tier::dot(n, d)) + abs(Tier::dot(n, e)); };
      if (along_edges(unit) < along_edges(normal)) return Tier::dot(unit, way.way) < T(0) ? -unit : unit;
    }
  }
  return normal;
}

/// A shortest way between a core and a triangle or a box that proves to be one, by a few steps: each adds the ways
/// between the edges at the vertices that are furthest along the shortest way so far. All ways are many. None where the
/// steps add no way, or where `overlap()` tells that the cores overlap, which is asked once the ways do not lead apart.
template <class Tier, class T, int of_a, int of_b, class Overlap>
[[gnu::noinline]] std::optional<ApartAlong<T>> apart_by_steps(const Core<T, of_a>& a, const Core<T, of_b>& b,
                                                              T rounding, const Overlap& overlap) {
  WayBetween<T> shortest;
  T least2 = std::numeric_limits<T>::infinity();
  const auto consider = [&](const WayBetween<T>& way) {
    const T length2 = Tier::dot(way.way, way.way);
    if (length2 < least2) shortest = way, least2 = length2;
  };
  for_each_way_to_faces<Tier>(a, b, consider);
  if (of_b == 3 && least2 == std::numeric_limits<T>::infinity())  // no vertex is across a face
    consider({a.vertices[0], b.vertices[0] - a.vertices[0]});
  constexpr int most_steps = 4, step_of_doubt = 1;
  [[maybe_unused]] int last_a = -1, last_b = -1;
  for (int step = 0; step < most_steps && least2 > T(0); ++step) {
    const Vec3<T> normal = normal_along<Tier>(shortest, a, b);
    if (defect_of<Tier>(normal, shortest, a, b) <= rounding)
      return ApartAlong<T>{
          normal, Tier::dot(shortest.way, normal), shortest.from, shortest.way, shortest.from_of, shortest.to_of};
    if constexpr (of_a > 1) {
      const int on_a = furthest_vertex<Tier>(a, normal), on_b = furthest_vertex<Tier>(b, -normal);
      if (on_a == last_a && on_b == last_b) return std::nullopt;
      const bool leads_apart = Tier::dot(normal, b.vertices[on_b] - a.vertices[on_a]) >= T(0);
      if (step == step_of_doubt && !leads_apart && overlap()) return std::nullopt;
      for (int i = 0; i < count_of_edges(a); ++i) {
        for (int k = 0; k < count_of_edges(b); ++k) {
          const bool at_both = (of_edge(a, i) >> on_a & 1) != 0 && (of_edge(b, k) >> on_b & 1) != 0;
          if (at_both) consider(way_between_edges<Tier>(a, i, b, k));
        }
      }
      last_a = on_a, last_b = on_b;
    }
  }
  return std::nullopt;
}

template <class T>
Vec3<T> multiplied(const Vec3<T>& v, int power) {
  return {ldexp(v.x, power), ldexp(v.y, power), ldexp(v.z, power)};
}
/// All lengths times 2^power.
template <class T, int most>
[[gnu::noinline]] Core<T, most> multiplied(Core<T, most> core, int power) {
  for (Vec3<T>& v : core.vertices) v = multiplied(v, power);
  return core;
}
template <class T>
ApartAlong<T> multiplied(const ApartAlong<T>& along, int power) {
  return {
      along.normal, ldexp(along.apart, power), multiplied(along.from, power), multiplied(along.way, power), along.of,
      along.to};
}

/// Of cores whose coordinates and their squares are far from the ends of the range.
template <class Tier, class T, int of_a, int of_b>
[[gnu::noinline]] ApartAlong<T> moderate_apart_along(const Core<T, of_a>& a, const Core<T, of_b>& b) {
  const T rounding = rounding_between(a, b);
  std::optional<LeastDefect<Tier, T, of_a, of_b>> made;
  const auto least = [&]() -> auto& { return made ? *made : made.emplace(a, b, rounding); };
  if constexpr (of_b == 8 || of_a > 1) {
    if (const auto apart = apart_by_steps<Tier>(a, b, rounding, [&] { return least().overlap(); })) return *apart;
  }
  if (!is_finite(a) || !is_finite(b)) {
    constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    constexpr Vec3<T> nowhere{nan, nan, nan};
    return {nowhere, nan, nowhere, nowhere};
  }
  if ((of_b == 8 || made) && least().overlap()) return least().of_facets();
  const AllWays<Tier, T, of_a, of_b> ways(a, b);
  const WayBetween<T>& way = ways.shortest();
  if (Tier::dot(way.way, way.way) > T(0)) {
    const Vec3<T> normal = normal_along<Tier>(way, a, b);
    if (defect_of<Tier>(normal, way, a, b) <= rounding)
      return {normal, Tier::dot(way.way, normal), way.from, way.way, way.from_of, way.to_of};
  }
  if (of_b < 8 && least().overlap()) return least().of_facets();
  return least().of_all_directions(ways);
}

/// The cores whose numbers are so extreme that squares leave the range are multiplied by a power of two.
template <class Tier, class T, int of_a, int of_b>
  requires(MachineNumber<T> && (of_a > 2 || of_b > 2))
ApartAlong<T> apart_along(const Core<T, of_a>& a, const Core<T, of_b>& b) {
  constexpr int most = std::numeric_limits<T>::max_exponent / 4;
  const T size = larger(largest_coordinate(a), largest_coordinate(b));
  if (!(size > T(0)) || !(size <= std::numeric_limits<T>::max())) return moderate_apart_along<Tier>(a, b);
  const int exponent = ilogb(size);
  if (exponent >= -most && exponent <= most) return moderate_apart_along<Tier>(a, b);
  return multiplied(moderate_apart_along<Tier>(multiplied(a, -exponent), multiplied(b, -exponent)), exponent);
}

/// A shape as a core in the frame of a box with this center.
template <class Tier, class T, class Shape>
auto core_in_frame(const Axes<T>& axes, const Vec3<T>& center, const Shape& shape) {
  const auto turned = [&](const Vec3<T>& v) {
    const std::array<T, 3> local = into_frame<Tier>(axes, v);
    return Vec3<T>{local[0], local[1], local[2]};
  };
  const auto at = [&](const Vec3<T>& place) { return turned(place - center); };
  const Vec3<T> origin{};
  if constexpr (std::same_as<Shape, Vec3<T>>) {
    return core_of<Tier>(at(shape), origin);
  } else if constexpr (std::same_as<Shape, Sphere<T>>) {
    return core_of<Tier>(Sphere<T>{at(shape.center), shape.radius}, origin);
  } else if constexpr (std::same_as<Shape, Segment<T>>) {
    return core_of<Tier>(Segment<T>{at(shape.v0), at(shape.v1)}, origin);
  } else if constexpr (std::same_as<Shape, Capsule<T>>) {
    return core_of<Tier>(Capsule<T>{at(shape.p0), at(shape.p1), shape.radius}, origin);
  } else if constexpr (std::same_as<Shape, Triangle<T>>) {
    return core_of<Tier>(Triangle<T>{at(shape.v0), at(shape.v1), at(shape.v2)}, origin);
  } else {
    const Axes<T> own = axes_of(shape.orientation);
    return Core<T, 8>(
        core_of_box(at(shape.center), Axes<T>{turned(own[0]), turned(own[1]), turned(own[2])}, shape.half));
  }
}
template <class T>
Core<T, 8> aligned_core(const Vec3<T>& half) {
  return core_of_box(Vec3<T>{}, Axes<T>{Vec3<T>{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}, half);
}

/// How a core in the frame of a box with these axes and half extents is apart from the box.
template <class Tier, class T, int of_a>
ApartAlong<T> apart_from_box(const Core<T, of_a>& core, const Axes<T>& axes, const Vec3<T>& half) {
  const ApartAlong<T> local = apart_along<Tier>(core, aligned_core(half));
  const auto out = [&](const Vec3<T>& v) { return out_of_frame(axes, components(v)); };
  return {unit_of<Tier>(out(local.normal)), local.apart, out(local.from), out(local.way), local.of, local.to};
}

/// Whether cores of these types are apart by what exactly_apart tells, and whether that always proves: one of them is a
/// triangle or a box. The numbers are no machine numbers.
template <class A, class B>
constexpr bool has_proposals = !MachineNumber<typename A::Number> && A::most_edges + B::most_edges > 1;
template <class A, class B>
constexpr bool needs_proof = has_proposals<A, B> && (A::most_edges > 1 || B::most_edges > 1);

/// The same shape; a box with a quaternion of moderate length, unless a component of that would lose digits.
template <class Shape>
const Shape& with_moderate_rotation(const Shape& shape) {
  return shape;
}
template <class T>
Box<T> with_moderate_rotation(const Box<T>& box) {
  const auto& [x, y, z, w] = box.orientation;
  const std::array<T, 4> given{x, y, z, w}, moderate = rescaled(box.orientation);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] != T(0) && !(detail::abs(moderate[i]) >= std::numeric_limits<T>::min())) return box;
  }
  return {box.center, box.half, {moderate[0], moderate[1], moderate[2], moderate[3]}};
}

/// The same shape in doubles.
template <class Shape>
auto in_doubles(const Shape& shape) {
  Rebound<Shape, double> rounded{};
  convert(shape, rounded, [](const auto& from, double& to) { to = nearest_double(from); });
  return rounded;
}

/// The answer for cores with these radii, relative to the origin.
template <class T>
SignedDistance<T> with_radii(const ApartAlong<T>& cores, const Vec3<T>& origin, const T& radius1, const T& radius2) {
  const auto& [normal, apart, from, way, of, to] = cores;
  const T distance = apart - (radius1 + radius2);
  // The point of the larger radius follows from the other one, so that both belong to the normal and the distance.
  if (radius1 <= radius2) {
    const Vec3<T> point1 = (origin + from) + normal * radius1;
    return {distance, normal, point1, point1 + normal * distance};
  }
  const Vec3<T> point2 = (origin + (from + way)) - normal * radius2;
  return {distance, normal, point2 - normal * distance, point2};
}

}  // namespace detail

namespace kernels {

template <class A, class B>
class Proposal;
template <class Tier, class A, class B, class Proposal>
auto signed_distance(const A& a, const B& b, Proposal& proposal);

/// The kernel of every signed distance of this kind.
template <class Tier, class A, class B>
inline auto signed_distance(const A& a, const B& b) {
  const auto& origin = detail::any_point_of(a);
  if constexpr (MachineNumber<std::remove_cvref_t<decltype(origin.x)>>) {
    const auto first = detail::core_of<Tier>(a, origin);
    const auto second = detail::core_of<Tier>(b, origin);
    return detail::with_radii(detail::apart_along<Tier>(first, second), origin, first.radius, second.radius);
  } else {
    Proposal<A, B> proposal(a, b);
    return signed_distance<Tier>(a, b, proposal);
  }
}
/// Machine numbers: in the frame of the box, of the larger one of two, so that the size of a large box is in no number
/// of a place within one of its faces.
template <class Tier, class A, class T>
  requires MachineNumber<T>
inline SignedDistance<T> signed_distance(const A& a, const Box<T>& box) {
  if constexpr (std::same_as<A, Box<T>>) {
    if (detail::largest(a.half) > detail::largest(box.half)) {
      const SignedDistance<T> d = signed_distance<Tier>(box, a);
      return {d.distance, -d.normal, d.point2, d.point1};
    }
  }
  const Axes<T> axes = axes_of(box.orientation);
  const auto first = detail::core_in_frame<Tier>(axes, box.center, a);
  return detail::with_radii(detail::apart_from_box<Tier>(first, axes, box.half), box.center, first.radius, T(0));
}

/// What doubles say of two shapes, but for the points: in the frame of the box, of the larger one of two.
template <class A, class B>
[[gnu::noinline]] auto guess_between(const A& a, const B& b) {
  const Vec3<double>& origin = detail::any_point_of(a);
  const auto first = detail::core_of<Plain>(a, origin);
  const auto second = detail::core_of<Plain>(b, origin);
  detail::Guess<std::remove_const_t<decltype(first)>, std::remove_const_t<decltype(second)>> guess{
      first, second, {}, 0};
  if constexpr (std::same_as<B, Box<double>>) {
    const auto in_frame_of_second = [](const auto& one, const Box<double>& box) {
      const Axes<double> axes = axes_of(box.orientation);
      const auto local = detail::core_in_frame<Plain>(axes, box.center, one);
      return std::pair(detail::apart_from_box<detail::Guessing>(local, axes, box.half),
                       detail::rounding_between(local, detail::aligned_core(box.half)));
    };
    if constexpr (std::same_as<A, Box<double>>) {
      if (detail::largest(a.half) > detail::largest(b.half)) {
        const auto [back, rounding] = in_frame_of_second(b, a);
        guess.apart = {-back.normal, back.apart, {}, {}, back.to, back.of};
        guess.rounding = rounding;
        return guess;
      }
    }
    std::tie(guess.apart, guess.rounding) = in_frame_of_second(a, b);
  } else {
    guess.apart = detail::apart_along<detail::Guessing>(first, second);
    guess.rounding = detail::rounding_between(first, second);
  }
  return guess;
}

/// What doubles say of two shapes, computed when it is asked for the first time, and what was proved of it.
template <class A, class B>
class Proposal {
 public:
  /// The shapes must live as long.
  Proposal(const A& a, const B& b) : a_(a), b_(b) {}
  const auto& guess() {
    if (!guess_) guess_.emplace(guess_between(detail::in_doubles(a_), detail::in_doubles(b_)));
    return *guess_;
  }

  std::optional<detail::Proved> proved;

 private:
  using OfDoubles = decltype(guess_between(detail::in_doubles(std::declval<const A&>()),
                                           detail::in_doubles(std::declval<const B&>())));
  const A& a_;
  const B& b_;
  std::optional<OfDoubles> guess_;
};

/// The core of a shape, of which little is asked for.
template <class Tier, class Shape, class T>
auto core_on_demand(const Shape& shape, const Vec3<T>& origin) {
  if constexpr (std::same_as<Shape, Box<T>>) {
    return detail::BoxOnDemand<T>(shape, origin);
  } else if constexpr (std::same_as<Shape, Triangle<T>>) {
    return detail::TriangleOnDemand<T>(shape, origin);
  } else {
    return detail::core_of<Tier>(shape, origin);
  }
}

/// The signed distance from what has been proved.
template <class Tier, class A, class B>
auto signed_distance_as_proved(const A& a, const B& b, const detail::Proved& proved) {
  const auto& origin = detail::any_point_of(a);
  const auto& first = core_on_demand<Tier>(a, origin);
  const auto& second = core_on_demand<Tier>(b, origin);
  return detail::with_radii(detail::apart_as_proved<Tier>(first, second, proved), origin, first.radius, second.radius);
}

/// The same, for a proposal that serves the same shapes in other numbers.
template <class Tier, class A, class B, class Proposal>
auto signed_distance(const A& a, const B& b, Proposal& proposal) {
  const auto& origin = detail::any_point_of(a);
  using T = std::remove_cvref_t<decltype(origin.x)>;
  if constexpr (MachineNumber<T>) {
    return signed_distance<Tier>(a, b);
  } else {
    using First = decltype(detail::core_of<Tier>(a, origin));
    using Second = decltype(detail::core_of<Tier>(b, origin));
    constexpr bool follows = detail::FollowsDecisions<T>;
    const auto with = [&](const auto& apart_of) {
      const First first = detail::core_of<Tier>(a, origin);
      const Second second = detail::core_of<Tier>(b, origin);
      return detail::with_radii(apart_of(first, second), origin, first.radius, second.radius);
    };
    const auto along = [](const auto& first, const auto& second) { return detail::apart_along<Tier>(first, second); };
    if constexpr (follows && detail::needs_proof<First, Second>) {
      return signed_distance_as_proved<Tier>(a, b, *proposal.proved);
    } else if constexpr (follows && detail::has_proposals<First, Second>) {
      return proposal.proved ? signed_distance_as_proved<Tier>(a, b, *proposal.proved) : with(along);
    } else if constexpr (detail::has_proposals<First, Second>) {
      return with([&](const First& first, const Second& second) {
        return detail::exactly_apart<Tier>(first, second, proposal);
      });
    } else {
      return with(along);
    }
  }
}

/// Of these shapes in float, near contact, many directions differ by less than rounding, and each is asked. Doubles
/// tell them apart, which takes half the time.
template <class A, class B>
inline constexpr bool is_faster_in_doubles = false;
template <>
inline constexpr bool is_faster_in_doubles<Triangle<float>, Triangle<float>> = true;
template <>
inline constexpr bool is_faster_in_doubles<Triangle<float>, Box<float>> = true;
template <>
inline constexpr bool is_faster_in_doubles<Box<float>, Box<float>> = true;
template <class Tier, class A, class B>
using TierOfSignedDistance = std::conditional_t<std::same_as<Tier, Fast> && is_faster_in_doubles<A, B>, Accurate, Tier>;

/// The answer of machine numbers as `Tier` lifts it.
template <class Tier, class A, class B>
auto lifted_signed_distance(const A& a, const B& b) {
  if constexpr (
      requires { detail::filtered_distance(a, b); } && requires { Tier::decided_by_filter(true); }) {
    if (const auto decided = detail::filtered_distance(a, b)) return Tier::decided_by_filter(*decided);
  }
  if constexpr (requires { detail::are_in_one_frame(a, b); }) {
    if (detail::are_in_one_frame(a, b)) {
      return Tier::lift([](auto tier, const auto& one,
                           const auto& other) { return distance_in_one_frame<decltype(tier)>(one, other); },
                        a, b);
    }
  }
  return Tier::lift(
      [proposal = Proposal(a, b)](auto tier, const auto& one, const auto& other) mutable {
        return signed_distance<decltype(tier)>(one, other, proposal);
      },
      a, b);
}

}  // namespace kernels

namespace contracts {

/// First order, but for nearly parallel segments, whose errors cases alone bound. A length is at most 2 sqrt(3) G. In
/// eps of G: a vertex and a direction have an error of 2 each; the foot of a perpendicular 22 along its edge, as in
/// closest_point_segment; the way 5 of its length, so 17; a normal across an edge is off by 4 eps of a right angle, and
/// across the second one by 9, so that turning the edges by as much adds 31; the product of the way and the normal 28;
/// the sums for each point 10. Together 112. In eps of the radii: the length of the normal 4, products and sums 3.
/// With a triangle a defect of 64 eps of the largest coordinate, which is at most 2 G, is accepted too: 240. With a box
/// a place is turned into its frame and back, with an error of 20 of a length each: 379. A defect that is larger and
/// yet the least one is bounded by cases alone.
template <class Tier, class T>
constexpr Contract signed_distance(double backward) {
  return Tier::template contract<T>(
      {.backward = backward, .unit = 8, .lowest = lowest_for<T>(3), .highest = highest_for<T>(3)});
}

}  // namespace contracts
}  // namespace collide

// NOLINTBEGIN(bugprone-macro-parentheses): a type and a name that is declared have none

/// Defines the function `name` of two shapes, its kernel and its contract.
#define COLLIDE_SIGNED_DISTANCE(name, First, first, Second, second) \
  COLLIDE_SIGNED_DISTANCE_WITHIN(128, name, First, first, Second, second)
#define COLLIDE_SIGNED_DISTANCE_WITHIN(backward, name, First, first, Second, second)                  \
  COLLIDE_COMPILED(name)                                                                              \
  namespace kernels {                                                                                 \
  template <class Tier, class T>                                                                      \
  inline SignedDistance<T> name(const First<T>& first, const Second<T>& second) {                     \
    if constexpr (Tier::template lifts<T>) {                                                          \
      using In = TierOfSignedDistance<Tier, First<T>, Second<T>>;                                     \
      return lifted_signed_distance<In>(detail::with_moderate_rotation(first),                        \
                                        detail::with_moderate_rotation(second));                      \
    } else {                                                                                          \
      return signed_distance<Tier>(first, second);                                                    \
    }                                                                                                 \
  }                                                                                                   \
  }                                                                                                   \
  namespace contracts {                                                                               \
  template <class Tier = Fast, class T = double>                                                      \
  constexpr Contract name() {                                                                         \
    return signed_distance<Tier, T>(backward);                                                        \
  }                                                                                                   \
  }                                                                                                   \
  template <class Tier = Fast, class T>                                                               \
  [[nodiscard]] inline SignedDistance<T> name(const First<T>& first,                                  \
                                              const Second<T>& second) noexcept(Tier::never_throws) { \
    COLLIDE_ANSWER(name, TierOfNumbers<Tier>, first, second);                                         \
  }

// NOLINTEND(bugprone-macro-parentheses)

#include <collide/detail/strict_end.hpp>
