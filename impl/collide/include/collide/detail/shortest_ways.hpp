/// Shortest ways between the features of two cores: vertices, edges and faces of points, segments, triangles and boxes.
///
/// The nearest points of two segments follow from the place of the second one that is nearest to the line of the first
/// one, by at most two more projections. Source: Lumelsky, On fast computation of distance between line segments,
/// Information Processing Letters 21, 1985, for the projections. Eberly, Robust Computation of Distance Between Line
/// Segments, 2018, shows where the parameters of nearly parallel segments lose their digits; here the part of the
/// second segment across the first one is taken first.
#pragma once

#include <bit>
#include <bitset>
#include <optional>

#include <collide/detail/overlaps_of_boxes.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// A set of vertices of a core: bit i is that of vertex i.
using Vertices = unsigned;
template <int most>
constexpr Vertices all_vertices = (1u << most) - 1;
constexpr Vertices both_ends = all_vertices<2>;
/// The number of the last one of some vertices.
constexpr int last_of(Vertices some) { return std::bit_width(some | 1u) - 1; }

/// A point of the first core, and the way from there to a point of the second one. Each lies within the convex hull of
/// some vertices, and not within that of fewer.
template <class T>
struct WayBetween {
  Vec3<T> from, way;
  Vertices from_of = 1, to_of = 1;
};

/// The part of `v` perpendicular to `direction`, not zero. The second pass removes what rounding left.
template <class Tier, class T>
Vec3<T> across_direction(const Vec3<T>& v, const Vec3<T>& direction) {
  const T length2 = Tier::dot(direction, direction);
  const Vec3<T> part = v - direction * (Tier::dot(v, direction) / length2);
  if constexpr (MachineNumber<T>) {
    return part - direction * (Tier::dot(part, direction) / length2);
  } else {
    return part;
  }
}

/// An edge of a core: its ends and its direction.
template <class T>
struct EdgeOfCore {
  const Vec3<T>&v0, &v1, &direction;
};

/// The edges of a core, or its only point; and which vertices of the core the ends of an edge are.
template <class T, int most>
constexpr int count_of_edges(const Core<T, most>&) {
  return most == 8 ? 12 : most == 3 ? 3 : 1;
}
template <class T, int most>
constexpr std::array<int, 2> ends_of_edge(const Core<T, most>& core, int i) {
  if constexpr (most == 8) return {core.edges[i].vertex, core.edges[i].vertex | 1 << core.edges[i].direction};
  return {i, (i + 1) % most};
}
template <class T, int most>
EdgeOfCore<T> edge_of(const Core<T, most>& core, int i) {
  const auto [first, second] = ends_of_edge(core, i);
  return {core.vertices[first], core.vertices[second], core.directions[core.edges[i].direction]};
}
template <class T>
const Vec3<T>& edge_of(const Core<T, 1>& core, int) {
  return core.vertices[0];
}

/// From the point of an edge that is nearest to a point.
template <class Tier, class T>
WayBetween<T> shortest_way(const EdgeOfCore<T>& edge, const Vec3<T>& point) {
  const auto& [v0, v1, direction] = edge;
  const Vec3<T> from0 = point - v0;
  const T along = Tier::dot(from0, direction);
  if (along <= T(0)) return {v0, from0};
  const Vec3<T> from1 = point - v1;
  if (Tier::dot(from1, direction) >= T(0)) return {v1, from1, 2};
  return {v0 + direction * (along / Tier::dot(direction, direction)), across_direction<Tier>(from0, direction),
          both_ends};
}
/// To that point.
template <class Tier, class T>
WayBetween<T> shortest_way(const Vec3<T>& point, const EdgeOfCore<T>& edge) {
  const WayBetween<T> back = shortest_way<Tier>(edge, point);
  return {point, -back.way, 1, back.from_of};
}

template <class Tier, class T>
WayBetween<T> shortest_way(const Core<T, 1>& a, const Core<T, 1>& b) {
  return {a.vertices[0], b.vertices[0] - a.vertices[0]};
}
template <class Tier, class T>
WayBetween<T> shortest_way(const Core<T, 1>& a, const Core<T, 2>& b) {
  return shortest_way<Tier>(a.vertices[0], edge_of(b, 0));
}

/// The part of the second segment's direction that is perpendicular to the first one; zero where they are parallel.
template <class Tier, class T>
Vec3<T> second_across_first(const EdgeOfCore<T>& a, const EdgeOfCore<T>& b) {
  return Tier::dot(a.direction, a.direction) > T(0) ? across_direction<Tier>(b.direction, a.direction) : Vec3<T>{};
}

/// A point of a segment: an end, or within.
template <class T>
struct PointOfSegment {
  Vec3<T> at;
  Vertices of = 1;
};

/// The point of the second segment that is nearest to the line of the first one; of parallel segments, any end.
template <class Tier, class T>
PointOfSegment<T> nearest_to_line(const EdgeOfCore<T>& a, const EdgeOfCore<T>& b) {
  const Vec3<T> across = second_across_first<Tier>(a, b);
  const Vec3<T>&v0 = b.v0, &v1 = b.v1;
  const T across2 = Tier::dot(across, across);
  if (!(across2 > T(0))) return {v0};
  const T before = -Tier::dot(across_direction<Tier>(v0 - a.v0, a.direction), across);
  if (before <= T(0)) return {v0};
  const T behind = -Tier::dot(across_direction<Tier>(v1 - a.v0, a.direction), across);
  if (behind >= T(0)) return {v1, 2};
  // Not before / across2, which rounding takes beyond the end of a segment that is nearly parallel.
  return {v0 + (v1 - v0) * (before / (before - behind)), both_ends};
}

/// The nearest point of the first segment to the one that is nearest to its line. If that is an end, the nearest point
/// of the second segment may be another.
template <class Tier, class T>
WayBetween<T> shortest_way(const EdgeOfCore<T>& a, const EdgeOfCore<T>& b) {
  const PointOfSegment<T> to = nearest_to_line<Tier>(a, b);
  WayBetween<T> way = shortest_way<Tier>(a, to.at);
  if (way.from_of != both_ends) {
    const Vertices from_of = way.from_of;
    way = shortest_way<Tier>(way.from, b);
    way.from_of = from_of;
  } else {
    way.to_of = to.of;
  }
  return way;
}

template <class Tier, class T>
WayBetween<T> shortest_way(const Core<T, 2>& a, const Core<T, 2>& b) {
  return shortest_way<Tier>(edge_of(a, 0), edge_of(b, 0));
}

template <class T, int most>
Vertices of_edge(const Core<T, most>& core, int i, Vertices ends = both_ends) {
  if constexpr (most < 3) return ends & all_vertices<most>;
  const auto [first, second] = ends_of_edge(core, i);
  return (ends & 1) << first | (ends >> 1) << second;
}

/// From the point within a triangle that is nearest to a point. None where that is not within.
template <class Tier, class T>
std::optional<WayBetween<T>> way_from_face(const Core<T, 3>& triangle, const Vec3<T>& point) {
  const Vec3<T>& normal = triangle.normals[0];
  const T length2 = Tier::dot(normal, normal);
  if (!(length2 > T(0))) return std::nullopt;
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> inward = Tier::cross(normal, triangle.directions[i]);
    if (!(Tier::dot(inward, point - triangle.vertices[i]) > T(0))) return std::nullopt;
  }
  const Vec3<T> way = normal * (Tier::dot(normal, point - triangle.vertices[0]) / length2), from = point - way;
  if constexpr (MachineNumber<T>) {  // the edges of a sliver are too nearly parallel to say where it ends
    for (const Vec3<T>& direction : triangle.directions) {
      const ProjectedRange<T> range = projected<Tier>(triangle, direction);
      const T at = Tier::dot(direction, from);
      if (!(at >= range.least && at <= range.most)) return std::nullopt;
    }
  }
  return WayBetween<T>{from, way, all_vertices<3>};
}

/// The vertices of a box that are on one side of it along an axis.
constexpr Vertices on_side(int axis, bool further) {
  constexpr std::array<Vertices, 3> further_ones{0xAA, 0xCC, 0xF0};
  return further ? further_ones[axis] : all_vertices<8> & ~further_ones[axis];
}
/// How far the point is beyond a box along an axis: negative before its first side, positive behind its other side.
template <class Tier, class T>
T beyond(const Core<T, 8>& box, int axis, const Vec3<T>& point) {
  const T before = Tier::dot(box.directions[axis], point - box.vertices[0]);
  if (before < T(0)) return before;
  const T behind = Tier::dot(box.directions[axis], point - box.vertices[7]);
  return behind > T(0) ? behind : T(0);
}
/// From the point of a box that is nearest to a point; no way from a point inside.
template <class Tier, class T>
std::optional<WayBetween<T>> way_from_face(const Core<T, 8>& box, const Vec3<T>& point) {
  WayBetween<T> way{point, {}, all_vertices<8>};
  for (int axis = 0; axis < 3; ++axis) {
    const T excess = beyond<Tier>(box, axis, point);
    if (excess == T(0)) continue;
    way.way = way.way + box.directions[axis] * excess;
    way.from_of &= on_side(axis, excess > T(0));
  }
  way.from = point - way.way;
  return way;
}

/// The way from within a face, given by its vertices, to a point across it. None where the point is not across.
template <class Tier, class T>
std::optional<WayBetween<T>> way_from_one_face(const Core<T, 3>& triangle, Vertices, const Vec3<T>& point) {
  return way_from_face<Tier>(triangle, point);
}
template <class Tier, class T>
std::optional<WayBetween<T>> way_from_one_face(const Core<T, 8>& box, Vertices face, const Vec3<T>& point) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool further : {false, true}) {
      if (face != on_side(axis, further)) continue;
      const auto is_beside = [&](int other) { return beyond<Tier>(box, other, point) != T(0); };
      if (is_beside((axis + 1) % 3) || is_beside((axis + 2) % 3)) return std::nullopt;
      const Vec3<T>& direction = box.directions[axis];
      const Vec3<T> way = direction * Tier::dot(direction, point - box.vertices[further ? 7 : 0]);
      return WayBetween<T>{point - way, way, face};
    }
  }
  return std::nullopt;
}

/// Calls f(way) for the ways from the faces whose vertices are all among `of`, to a point across them.
template <class Tier, class T, int most, class F>
void for_each_way_from_faces(const Core<T, most>& core, Vertices of, const Vec3<T>& point, F&& f) {
  const auto from = [&](Vertices face) {
    if ((face & ~of) != 0) return;
    if (const auto way = way_from_one_face<Tier>(core, face, point)) f(*way);
  };
  if constexpr (most == 3) {
    from(all_vertices<3>);
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool further : {false, true}) from(on_side(axis, further));
    }
  }
}

/// Between edges of the cores.
template <class Tier, class T, int of_a, int of_b>
[[gnu::noinline]] WayBetween<T> way_between_edges(const Core<T, of_a>& a, int i, const Core<T, of_b>& b, int k) {
  WayBetween<T> way = shortest_way<Tier>(edge_of(a, i), edge_of(b, k));
  way.from_of = of_edge(a, i, way.from_of), way.to_of = of_edge(b, k, way.to_of);
  return way;
}

/// Calls f(way) for the ways between vertices of one core and the points within faces of the other one; those of a box
/// are the shortest ways to it.
template <class Tier, class T, int of_a, int of_b, class F>
void for_each_way_to_faces(const Core<T, of_a>& a, const Core<T, of_b>& b, F&& f) {
  if constexpr (of_a >= 3) {
    for (int i = 0; i < of_b; ++i) {
      if (auto way = way_from_face<Tier>(a, b.vertices[i])) {
        way->to_of = 1u << i;
        f(*way);
      }
    }
  }
  if constexpr (of_b >= 3) {
    for (int i = 0; i < of_a; ++i) {
      if (const auto back = way_from_face<Tier>(b, a.vertices[i]))
        f(WayBetween<T>{a.vertices[i], -back->way, 1u << i, back->from_of});
    }
  }
}
/// Calls f(way) for the shortest way between every two features of the cores that have one, and some more than once.
template <class Tier, class T, int of_a, int of_b, class F>
void for_each_way(const Core<T, of_a>& a, const Core<T, of_b>& b, F&& f) {
  for_each_way_to_faces<Tier>(a, b, f);
  if constexpr (of_a > 1 || of_b < 8) {
    for (int i = 0; i < count_of_edges(a); ++i) {
      for (int k = 0; k < count_of_edges(b); ++k) f(way_between_edges<Tier>(a, i, b, k));
    }
  }
}
/// Whether equal numbers of a type compare as equal without a doubt: those with error bounds cannot.
template <class T>
concept DecidesEquality = !requires(T x) { x.error; };

/// The shortest of the ways that are considered one after the other.
template <class T, int of_a, int of_b>
class ShortestWay {
 public:
  /// Exact numbers that are equal are dear to compare: a way between vertices that are known already is the same way,
  /// and none is shorter than one of no length.
  template <class Tier>
  void consider(const WayBetween<T>& way) {
    if constexpr (!MachineNumber<T>) {
      const std::size_t both = way.from_of << of_b | way.to_of;
      if (known_[both]) return;
      known_[both] = true;
      if constexpr (DecidesEquality<T>) {
        if (any_ && least2_ == T(0)) return;
      }
    }
    const T length2 = Tier::dot(way.way, way.way);
    if (!any_ || length2 < least2_) shortest_ = way, least2_ = length2;
    any_ = true;
  }
  bool any() const { return any_; }
  const WayBetween<T>& way() const { return shortest_; }

 private:
  WayBetween<T> shortest_;
  T least2_{};
  std::bitset<MachineNumber<T> ? 1 : 1 << (of_a + of_b)> known_;
  bool any_ = false;
};

// What is marked is not inlined: tiers inline whole kernels, of which these loops are a large part for each two shapes.
template <class Tier, class T, int of_a, int of_b>
[[gnu::noinline]] WayBetween<T> shortest_of_ways(const Core<T, of_a>& a, const Core<T, of_b>& b) {
  ShortestWay<T, of_a, of_b> shortest;
  for_each_way<Tier>(a, b, [&](const WayBetween<T>& way) { shortest.template consider<Tier>(way); });
  return shortest.way();
}

/// Calls f(way) for the ways between features whose vertices are all among these, also between each vertex and each
/// edge: where edges cross nearly at a vertex, rounding may take the way between them for one within both.
template <class Tier, class T, int of_a, int of_b, class F>
void for_each_way_among(const Core<T, of_a>& a, Vertices among_a, const Core<T, of_b>& b, Vertices among_b, F&& f) {
  const auto each_vertex = [](Vertices among, auto&& of) {
    for (; among != 0; among &= among - 1) of(std::countr_zero(among));
  };
  const auto each_edge = [](const auto& core, Vertices among, auto&& of) {
    for (int i = 0; i < count_of_edges(core); ++i) {
      if ((of_edge(core, i) & ~among) == 0) of(i);
    }
  };
  each_vertex(among_a, [&](int i) {
    each_vertex(among_b, [&](int k) {
      f(WayBetween<T>{a.vertices[i], b.vertices[k] - a.vertices[i], 1u << i, 1u << k});
    });
    if constexpr (of_b >= 3) {
      const auto to_face = [&](const WayBetween<T>& back) {
        f(WayBetween<T>{a.vertices[i], -back.way, 1u << i, back.from_of});
      };
      for_each_way_from_faces<Tier>(b, among_b, a.vertices[i], to_face);
    }
  });
  if constexpr (of_a >= 3) {
    each_vertex(among_b, [&](int k) {
      for_each_way_from_faces<Tier>(a, among_a, b.vertices[k], [&](WayBetween<T> way) {
        way.to_of = 1u << k;
        f(way);
      });
    });
  }
  if constexpr (of_b > 1) {
    each_edge(b, among_b, [&](int k) {
      const auto edge = edge_of(b, k);
      each_vertex(among_a, [&](int i) {
        WayBetween<T> way = shortest_way<Tier>(a.vertices[i], edge);
        way.from_of = 1u << i, way.to_of = of_edge(b, k, way.to_of);
        f(way);
      });
      if constexpr (of_a > 1) {
        each_edge(a, among_a, [&](int i) { f(way_between_edges<Tier>(a, i, b, k)); });
      }
    });
  }
  if constexpr (of_a > 1) {
    each_edge(a, among_a, [&](int i) {
      each_vertex(among_b, [&](int k) {
        WayBetween<T> way = shortest_way<Tier>(edge_of(a, i), b.vertices[k]);
        way.from_of = of_edge(a, i, way.from_of), way.to_of = 1u << k;
        f(way);
      });
    });
  }
}

/// The shortest of the ways between features whose vertices are all among these.
template <class Tier, class T, int of_a, int of_b>
[[gnu::noinline]] std::optional<WayBetween<T>> shortest_way_among(const Core<T, of_a>& a, Vertices among_a,
                                                                  const Core<T, of_b>& b, Vertices among_b) {
  ShortestWay<T, of_a, of_b> shortest;
  for_each_way_among<Tier>(a, among_a, b, among_b,
                           [&](const WayBetween<T>& way) { shortest.template consider<Tier>(way); });
  if (!shortest.any()) return std::nullopt;
  return shortest.way();
}

/// The number of the edge of a core that has these two vertices; none where they are no edge.
template <class T, int most>
std::optional<int> edge_with_ends(const Core<T, most>& core, Vertices ends) {
  for (int i = 0; i < count_of_edges(core); ++i) {
    if (of_edge(core, i) == ends) return i;
  }
  return std::nullopt;
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
