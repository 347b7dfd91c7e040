/// The kernel of the overlap of every two rounded polytopes: a point, a sphere, a segment, a capsule, a triangle, a
/// box.
///
/// A rounded polytope is its *core*, the convex hull of a few points, grown by a radius. Two of them are apart exactly
/// if a direction n separates them: the least n . b over the core of B exceeds the greatest n . a over the core of A by
/// more than |n| times the sum of the radii. If they are apart, the shortest way w between the cores is such a
/// direction. It joins a feature of each core, so it is one of these, or its opposite:
///
/// - the normal of a face,
/// - the cross product of an edge of A and an edge of B,
/// - the part of the way from a vertex to an edge that is perpendicular to the edge,
/// - the way from a vertex to a vertex.
///
/// So the decision is whether one of these directions separates. Nothing else is compared: no case distinction between
/// regions, and no direction that is nearly zero needs care, since every direction that separates is a proof.
/// Source: the facets of the Minkowski difference (Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996, section 5, for
/// boxes).
#pragma once

#include <array>
#include <concepts>
#include <limits>

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// The core of a shape relative to an origin, with at most `most` vertices.
template <class T, int most>
struct Core {
  using Number = T;
  static constexpr int most_edges = most == 8 ? 12 : most * (most - 1) / 2;
  static constexpr int most_directions = most < 4 ? most_edges : 3;
  static constexpr bool has_unit_normals = most == 8;
  /// An edge, by one of its vertices and by its direction.
  struct Edge {
    int vertex, direction;
  };

  std::array<Vec3<T>, most> vertices{};
  std::array<Vec3<T>, most_directions> directions{};  ///< of the edges, any length
  std::array<Vec3<T>, most_directions> normals{};     ///< of the faces, any length
  int count_of_normals = 0;
  std::array<Edge, most_edges> edges{};
  T radius{};
};

/// The same direction, multiplied by a power of two (so without rounding) if its length is so extreme that products
/// would overflow or underflow.
template <class T>
Vec3<T> of_moderate_length(const Vec3<T>& v) {
  if constexpr (MachineNumber<T>) {
    const T largest = larger(larger(abs(v.x), abs(v.y)), abs(v.z));
    if (largest > T(0) && largest <= std::numeric_limits<T>::max() && !(largest >= T(0.0625) && largest <= T(16))) {
      const int down = -detail::ilogb(largest);
      return {detail::ldexp(v.x, down), detail::ldexp(v.y, down), detail::ldexp(v.z, down)};
    }
  }
  return v;
}

template <class Tier, class T>
Core<T, 1> core_of(const Vec3<T>& point, const Vec3<T>& origin) {
  Core<T, 1> core;
  core.vertices[0] = point - origin;
  return core;
}
template <class Tier, class T>
Core<T, 1> core_of(const Sphere<T>& sphere, const Vec3<T>& origin) {
  Core<T, 1> core = core_of<Tier>(sphere.center, origin);
  core.radius = sphere.radius;
  return core;
}
template <class Tier, class T>
Core<T, 2> core_of(const Segment<T>& segment, const Vec3<T>& origin) {
  Core<T, 2> core;
  core.vertices = {segment.v0 - origin, segment.v1 - origin};
  core.directions[0] = of_moderate_length(segment.v1 - segment.v0);
  core.edges[0] = {0, 0};
  return core;
}
template <class Tier, class T>
Core<T, 2> core_of(const Capsule<T>& capsule, const Vec3<T>& origin) {
  Core<T, 2> core = core_of<Tier>(Segment<T>{capsule.p0, capsule.p1}, origin);
  core.radius = capsule.radius;
  return core;
}
template <class T>
const Vec3<T>& any_point_of(const Vec3<T>& point) {
  return point;
}
template <class T>
const Vec3<T>& any_point_of(const Sphere<T>& sphere) {
  return sphere.center;
}
template <class T>
const Vec3<T>& any_point_of(const Segment<T>& segment) {
  return segment.v0;
}
template <class T>
const Vec3<T>& any_point_of(const Capsule<T>& capsule) {
  return capsule.p0;
}
template <class T>
const Vec3<T>& any_point_of(const Triangle<T>& triangle) {
  return triangle.v0;
}

/// The part of `v` that is perpendicular to `direction`, times the squared length of `direction`. The rounding errors
/// of the first pass leave a part along the direction that may be as large as the result; the second pass removes it.
template <class Tier, class T>
Vec3<T> perpendicular_part(const Vec3<T>& v, const Vec3<T>& direction) {
  const T length2 = Tier::dot(direction, direction);
  const Vec3<T> part = v * length2 - direction * Tier::dot(v, direction);
  if constexpr (MachineNumber<T>) {
    return part * length2 - direction * Tier::dot(part, direction);
  } else {
    return part;
  }
}

/// A vector perpendicular to both, zero where they are parallel; in machine numbers, perhaps another one.
template <class Tier, class T>
Vec3<T> across_edges(const Vec3<T>& d, const Vec3<T>& e) {
  const Vec3<T> normal = Tier::cross(d, e);
  if constexpr (MachineNumber<T>) {
    return perpendicular_part<Tier>(perpendicular_part<Tier>(normal, d), e);
  } else {
    return normal;
  }
}

/// The normal of a triangle with these sides, which have these directions; any length. In machine numbers that of the
/// two shorter sides, which loses the fewest digits, without its part along the longest side: what is left of its error
/// turns the plane about that side, so it moves no vertex by more than an error of the sides.
template <class Tier, class T>
Vec3<T> normal_of_sides(const std::array<Vec3<T>, 3>& sides, const std::array<Vec3<T>, 3>& directions) {
  if constexpr (MachineNumber<T>) {
    std::array<T, 3> sizes;
    for (int i = 0; i < 3; ++i) sizes[i] = larger(larger(abs(sides[i].x), abs(sides[i].y)), abs(sides[i].z));
    const int longest = sizes[0] >= sizes[1] ? (sizes[0] >= sizes[2] ? 0 : 2) : (sizes[1] >= sizes[2] ? 1 : 2);
    const Vec3<T> normal = Tier::cross(directions[(longest + 1) % 3], directions[(longest + 2) % 3]);
    return perpendicular_part<Tier>(normal, directions[longest]);
  } else {
    return Tier::cross(directions[0], directions[1]);
  }
}

template <class Tier, class T>
Core<T, 3> core_of(const Triangle<T>& triangle, const Vec3<T>& origin) {
  Core<T, 3> core;
  core.vertices = {triangle.v0 - origin, triangle.v1 - origin, triangle.v2 - origin};
  const std::array<Vec3<T>, 3> sides{triangle.v1 - triangle.v0, triangle.v2 - triangle.v1, triangle.v0 - triangle.v2};
  for (int i = 0; i < 3; ++i) {
    core.directions[i] = of_moderate_length(sides[i]);
    core.edges[i] = {i, i};
  }
  core.normals[0] = normal_of_sides<Tier>(sides, core.directions);
  core.count_of_normals = 1;
  return core;
}

/// The ends of a projection on a direction.
template <class T>
struct ProjectedRange {
  T least, most;
};
template <class Tier, class T, int most>
ProjectedRange<T> projected(const Core<T, most>& core, const Vec3<T>& direction) {
  const T first = Tier::dot(direction, core.vertices[0]);
  ProjectedRange<T> range{first, first};
  for (int i = 1; i < most; ++i) {
    const T at = Tier::dot(direction, core.vertices[i]);
    range = {smaller(range.least, at), larger(range.most, at)};
  }
  return range;
}

/// Whether a direction separates two cores by more than the sum of their radii.
template <class Tier, class A, class B>
class SeparationOfCores {
 public:
  using T = typename A::Number;

  SeparationOfCores(const A& a, const B& b) : a_(a), b_(b), radius_(a.radius + b.radius) {}

  // Not inlined: Certified inlines whole kernels, of which the loops below are a large part for each pair of shapes.
  [[gnu::noinline]] bool exists() const {
    return between_faces_and_edges() || between_edges(a_, b_) || between_edges(b_, a_) || between_vertices();
  }
  /// The directions that suffice for cores without radii of which one has a volume: the normals of the facets of their
  /// Minkowski difference.
  [[gnu::noinline]] bool between_faces_and_edges() const {
    for (int i = 0; i < a_.count_of_normals; ++i) {
      if (separates(a_.normals[i])) return true;
    }
    for (int i = 0; i < b_.count_of_normals; ++i) {
      if (separates(b_.normals[i])) return true;
    }
    for (const Vec3<T>& d : a_.directions) {
      for (const Vec3<T>& e : b_.directions) {
        if (separates(across_edges<Tier>(d, e))) return true;
      }
    }
    return false;
  }

 private:
  /// Directions between the edges of `one` and the vertices of `other`.
  template <class One, class Other>
  bool between_edges(const One& one, const Other& other) const {
    for (const auto& edge : one.edges) {
      for (const Vec3<T>& vertex : other.vertices) {
        if (separates(perpendicular_part<Tier>(vertex - one.vertices[edge.vertex], one.directions[edge.direction])))
          return true;
      }
    }
    return false;
  }
  bool between_vertices() const {
    for (const Vec3<T>& v : a_.vertices) {
      for (const Vec3<T>& w : b_.vertices) {
        if (separates(w - v)) return true;
      }
    }
    return false;
  }
  /// Whether `normal` or its opposite separates. Machine numbers: not so short that products underflow.
  bool separates(const Vec3<T>& normal) const {
    if constexpr (MachineNumber<T>) {
      constexpr T least = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
      if (!(Tier::dot(normal, normal) >= least)) return separates_scaled(of_moderate_length(normal));
    }
    return separates_scaled(normal);
  }
  bool separates_scaled(const Vec3<T>& normal) const {
    const ProjectedRange<T> a = projected<Tier>(a_, normal), b = projected<Tier>(b_, normal);
    const T gap = larger(b.least - a.most, a.least - b.most);
    if (!(gap > T(0))) return false;
    if (radius_ == T(0)) return true;
    if constexpr (MachineNumber<T>) {
      return gap > radius_ * sqrt(Tier::dot(normal, normal));
    } else {
      return gap * gap > radius_ * radius_ * Tier::dot(normal, normal);
    }
  }

  const A& a_;
  const B& b_;
  T radius_;
};
template <class Tier, class A, class B>
SeparationOfCores<Tier, A, B> separation_of(const A& a, const B& b) {
  return {a, b};
}

/// Whether Fast tries the filter of two shapes too: its own kernel takes several times as long.
template <class A, class B>
inline constexpr bool filter_is_fast = false;

}  // namespace detail

namespace kernels {

/// The kernel of every overlap of this kind.
template <class Tier, class A, class B>
inline auto overlap(const A& a, const B& b) {
  const auto& origin = detail::any_point_of(a);
  using T = std::remove_cvref_t<decltype(origin.x)>;
  const auto first = detail::core_of<Tier>(a, origin);
  const auto second = detail::core_of<Tier>(b, origin);
  return Decision<T>{!detail::separation_of<Tier>(first, second).exists()};
}

}  // namespace kernels

namespace contracts {

/// First order, but for the cross product of nearly parallel edges, which cases alone bound. In eps of G, by directions
/// that separate: a vertex has an error of 2; a projection 12; the product with the radius 4; a direction, after the
/// second pass, 32 over the extent of both bodies: together 50. By the shortest way of two axes: a vertex 2, twice; the
/// parameters 6 along each axis, and 24 across where they are nearly parallel; a point 4, twice; length and radii 8:
/// together 60. With a capsule and a box as in moving_sphere_passes_box.
template <class Tier, class T>
constexpr Contract overlap(double backward) {
  return Tier::template contract<T>({.backward = backward, .lowest = lowest_for<T>(3), .highest = highest_for<T>(3)});
}

}  // namespace contracts
}  // namespace collide

// NOLINTBEGIN(bugprone-macro-parentheses): a type and a name that is declared have none

/// Defines the function `name` of two shapes and its contract.
#define COLLIDE_OVERLAP_FUNCTION(name, First, first, Second, second) \
  COLLIDE_OVERLAP_FUNCTION_WITHIN(128, name, First, first, Second, second)
#define COLLIDE_OVERLAP_FUNCTION_WITHIN(backward, name, First, first, Second, second)                                  \
  COLLIDE_COMPILED(name)                                                                                               \
  namespace contracts {                                                                                                \
  template <class Tier = Fast, class T = double>                                                                       \
  constexpr Contract name() {                                                                                          \
    return overlap<Tier, T>(backward);                                                                                 \
  }                                                                                                                    \
  }                                                                                                                    \
  template <class Tier = Fast, class T>                                                                                \
  [[nodiscard]] inline Decision<T> name(const First<T>& first, const Second<T>& second) noexcept(Tier::never_throws) { \
    COLLIDE_ANSWER(name, TierOfDecisions<Tier>, first, second);                                                        \
  }

/// Defines its kernel too, which tries detail::filtered_overlap and lifts kernels::overlap.
#define COLLIDE_OVERLAP(name, First, first, Second, second)                                                 \
  namespace kernels {                                                                                       \
  template <class Tier, class T>                                                                            \
  inline Decision<T> name(const First<T>& first, const Second<T>& second) {                                 \
    constexpr bool certifies = uses_filter<Tier, T>;                                                        \
    if constexpr (certifies || (std::same_as<Tier, Fast> && detail::filter_is_fast<First<T>, Second<T>>)) { \
      if (const auto decided = detail::filtered_overlap(first, second)) {                                   \
        if constexpr (certifies) return Tier::decided_by_filter(Decision<T>{*decided});                     \
        return {*decided};                                                                                  \
      }                                                                                                     \
    }                                                                                                       \
    if constexpr (Tier::template lifts<T>) {                                                                \
      return COLLIDE_LIFTED(name, first, second);                                                           \
    } else {                                                                                                \
      return overlap<Tier>(first, second);                                                                  \
    }                                                                                                       \
  }                                                                                                         \
  }                                                                                                         \
  COLLIDE_OVERLAP_FUNCTION(name, First, first, Second, second)

// NOLINTEND(bugprone-macro-parentheses)

#include <collide/detail/strict_end.hpp>
