/// libccd 2.1 as a subject: its GJK with EPA, and its MPR (Minkowski portal refinement), called directly. Shapes are
/// support functions, so spheres, boxes, triangles and swept spheres are exact, except for the rotation of a box, which
/// is rounded to a matrix.
#pragma once

#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include <array>
#include <cmath>
#include <concepts>
#include <string>

#include "impl/adapters/motion.hpp"
#include "impl/adapters/operations.hpp"
#include "impl/subject/adapter.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::adapters {

namespace in = inputs;

/// The shapes of `collide` by their centers and support points.
struct CcdShapes {
  /// The convex hull of at most three points, or a box, rounded by a radius.
  struct Convex {
    int corners = 0;
    std::array<Vec3d, 3> corner{};
    Vec3d half{};
    std::array<Vec3d, 3> axes{};
    double radius = 0;

    Vec3d center() const {
      Vec3d sum{};
      for (int i = 0; i < corners; ++i) sum = sum + corner[i] / double(corners);
      return sum;
    }
    Vec3d support(const Vec3d& direction) const {
      Vec3d best = corner[0];
      for (int i = 1; i < corners; ++i) {
        if (dot(corner[i], direction) > dot(best, direction)) best = corner[i];
      }
      const std::array<double, 3> reach{half.x, half.y, half.z};
      for (int i = 0; i < 3; ++i) {
        if (reach[i] > 0) best = best + axes[i] * (dot(axes[i], direction) < 0 ? -reach[i] : reach[i]);
      }
      const double norm = length(direction);
      return radius > 0 && norm > 0 ? best + direction * (radius / norm) : best;
    }
  };

  static Convex convex(const collide::Sphere<double>& s) { return {1, {s.center}, {}, {}, s.radius}; }
  static Convex convex(const collide::Segment<double>& s) { return {2, {s.v0, s.v1}, {}, {}, 0}; }
  static Convex convex(const collide::Triangle<double>& t) { return {3, {t.v0, t.v1, t.v2}, {}, {}, 0}; }
  static Convex convex(const collide::Capsule<double>& c) { return {2, {c.p0, c.p1}, {}, {}, c.radius}; }
  static Convex convex(const collide::Box<double>& b) {
    const auto [x, y, z, w] = unit(b.orientation);
    return {1,
            {b.center},
            b.half,
            {Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
             Vec3d{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
             Vec3d{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}},
            0};
  }
  /// An axis-aligned box by its corners, which are exact.
  struct Corners {
    Vec3d min, max;
    Vec3d center() const { return min * 0.5 + max * 0.5; }
    Vec3d support(const Vec3d& d) const {
      return {d.x < 0 ? min.x : max.x, d.y < 0 ? min.y : max.y, d.z < 0 ? min.z : max.z};
    }
  };
  static Corners convex(const collide::AABox<double>& b) { return {b.min, b.max}; }
};

template <class S>
concept CcdKnows = requires(const S& s) { CcdShapes::convex(s); };

enum class CcdAlgorithm { gjk, mpr };

template <CcdAlgorithm algorithm>
struct Ccd : private CcdShapes {
  using Number = double;
  static std::string version() { return "libccd 2.1"; }

  /// The defaults of epa_tolerance and mpr_tolerance in ccd.h, 1e-4, in units of 2^-53, rounded up to a power of two.
  /// These tolerances are lengths, so the domain starts at lengths of 1.
  template <class Q>
  static collide::Contract contract() {
    return {.backward = 0x1p40, .lowest = 0, .highest = 300};
  }
  template <class Q>
  static std::string equivalence() {
    return requires(const Q& q) { q.limit; } ? "the sphere's way as one convex shape" : "";
  }
  template <class Q>
  static std::string left_out() {
    if constexpr (AsksOverlap<Q> && TellsAxis<Q>) return "the axis, which libccd does not look for";
    if constexpr (AsksDepth<Q>)
      return (TellsAxis<Q> ? "the axis and the contact: " : "the contact: ") + std::string(positions);
    return "";
  }
  template <class Q>
  static std::string why_not() {
    if constexpr (requires(const Q& q) { q.plane; }) {
      return "libccd's shapes are bounded, and a plane is not";
    } else if constexpr (
        requires(const Q& q) { q.velocity; } || requires(const Q& q) { q.ray; }) {
      return "libccd knows no motions";
    } else if constexpr (requires(const Q& q) { q.box1; }) {
      return "libccd knows no boxes, only support functions";
    }
    return "libccd answers whether and how deep two convex shapes overlap";
  }

  template <AsksOverlap Q>
    requires CcdKnows<First<Q>> && CcdKnows<Second<Q>>
  static auto answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    return decided_alone<Q>(meet(a, b));
  }
  template <AsksDepth Q>
    requires CcdKnows<First<Q>> && CcdKnows<Second<Q>>
  static auto answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    return depth<typename Q::Answer>(a, b);
  }
  template <AsksBallPath Q>
    requires CcdKnows<Second<Q>>
  static Reply<collide::Decision<double>> answer(const Q& q) {
    const auto& target = std::get<1>(shapes_of(q));
    const auto way = way_of(q, ball_around(target));
    if (!way) return CannotAnswer{no_end};
    return collide::Decision<double>{meet(*way, target)};
  }

 private:
  static constexpr const char* positions =
      "ccd.h calls a position the place where a force should act, and not which point of the two bodies it is";

  /// The limit of iterations for GJK, whose default is unlimited, and for EPA, which has none: against a ball EPA adds
  /// points as long as each comes closer by the tolerance.
  static constexpr int most_iterations = 1000;
  /// Each iteration of either computes a support point of both bodies.
  static constexpr int most_points = 2 * (most_iterations + most_iterations);
  static inline int points = 0;  ///< support points computed in the current call

  template <class S>
  static void support(const void* shape, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    const S& s = *static_cast<const S*>(shape);
    // Beyond the limit, a point inside the shape ends EPA, because it is no progress.
    const bool within = ++points > most_points;
    const Vec3d p = within ? s.center() : s.support({direction->v[0], direction->v[1], direction->v[2]});
    ccdVec3Set(point, p.x, p.y, p.z);
  }
  template <class S>
  static void center(const void* shape, ccd_vec3_t* point) {
    const Vec3d p = static_cast<const S*>(shape)->center();
    ccdVec3Set(point, p.x, p.y, p.z);
  }
  template <class A, class B>
  static ccd_t settings() {
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = support<A>;
    ccd.support2 = support<B>;
    ccd.center1 = center<A>;
    ccd.center2 = center<B>;
    ccd.max_iterations = most_iterations;
    points = 0;
    return ccd;
  }

  template <class A, class B>
  static bool meet(const A& first, const B& second) {
    const auto a = convex(first);
    const auto b = convex(second);
    const ccd_t ccd = settings<std::remove_cv_t<decltype(a)>, std::remove_cv_t<decltype(b)>>();
    return (algorithm == CcdAlgorithm::gjk ? ccdGJKIntersect(&a, &b, &ccd) : ccdMPRIntersect(&a, &b, &ccd)) != 0;
  }
  template <class Depth, class A, class B>
  static Reply<Depth> depth(const A& first, const B& second) {
    const auto a = convex(first);
    const auto b = convex(second);
    const ccd_t ccd = settings<std::remove_cv_t<decltype(a)>, std::remove_cv_t<decltype(b)>>();
    double deep = 0;
    ccd_vec3_t direction, position;
    const int apart = algorithm == CcdAlgorithm::gjk ? ccdGJKPenetration(&a, &b, &ccd, &deep, &direction, &position)
                                                     : ccdMPRPenetration(&a, &b, &ccd, &deep, &direction, &position);
    if (points > most_points) return CannotAnswer{"EPA has not ended after 1000 iterations"};
    Depth d;
    d.depth = -1;
    if (apart != 0) return only(d, {});  // no distance is available
    d.depth = deep;
    d.normal = {direction.v[0], direction.v[1], direction.v[2]};
    return only(d, {"depth", "normal"});
  }
};

using CcdGjk = Ccd<CcdAlgorithm::gjk>;
using CcdMpr = Ccd<CcdAlgorithm::mpr>;

}  // namespace nearmiss::adapters
