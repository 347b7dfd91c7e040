/// FCL 0.7 as a subject: static collision, penetration, and continuous collision for the moving sphere.
#pragma once

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <string_view>
#include <type_traits>

#include "impl/adapters/motion.hpp"
#include "impl/subject/adapter.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::adapters {

namespace in = inputs;

/// Converts the catalogue's shapes to FCL's.
struct FclShapes {
  static fcl::Vector3d vector(const Vec3d& v) { return {v.x, v.y, v.z}; }
  static fcl::Transform3d at(const Vec3d& p) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    t.translation() = vector(p);
    return t;
  }
  static fcl::Sphered shape(const collide::Sphere<double>& s) { return fcl::Sphered(s.radius); }
  static fcl::Transform3d pose(const collide::Sphere<double>& s) { return at(s.center); }
  static fcl::Boxd shape(const collide::Box<double>& b) { return {2 * b.half.x, 2 * b.half.y, 2 * b.half.z}; }
  static fcl::Transform3d pose(const collide::Box<double>& b) {
    fcl::Transform3d t = at(b.center);
    const auto [x, y, z, w] = unit(b.orientation);
    t.linear() = fcl::Quaterniond(w, x, y, z).toRotationMatrix();
    return t;
  }
  static fcl::Capsuled shape(const collide::Capsule<double>& c) { return {c.radius, length(c.p1 - c.p0)}; }
  static fcl::Transform3d pose(const collide::Capsule<double>& c) {
    fcl::Transform3d t = at(c.p0 * 0.5 + c.p1 * 0.5);
    const Vec3d along = c.p1 - c.p0;
    if (length(along) > 0) {
      t.linear() = fcl::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), vector(along)).toRotationMatrix();
    }
    return t;
  }
  /// The half-space behind the plane; FCL normalizes the normal.
  static fcl::Halfspaced shape(const collide::Plane<double>& p) { return {vector(p.normal), -p.offset}; }
  static fcl::Transform3d pose(const collide::Plane<double>&) { return fcl::Transform3d::Identity(); }
};

/// FCL with one solver for static queries and one solver for motions.
template <fcl::GJKSolverType static_solver, fcl::CCDSolverType motion_solver>
struct Fcl : FclShapes {
  using Number = double;
  static std::string version() { return "FCL 0.7"; }

  /// FCL's own tolerances, relative to the scene, in units of 2^-53, rounded up to a power of two:
  /// CollisionRequest::gjk_tolerance is 1e-6, and ContinuousCollisionRequest::toc_err is 1e-4.
  static constexpr double gjk_tolerance = 0x1p34;
  static constexpr double time_of_contact_error = 0x1p40;

  template <class Q>
  static constexpr bool is_motion =
      requires(const Q& q) { q.sphere, q.velocity; } && !requires(const Q& q) { q.limit; };

  template <class Q>
  static collide::Contract contract() {
    return {.backward = is_motion<Q> ? time_of_contact_error : gjk_tolerance, .lowest = -300, .highest = 300};
  }
  template <class Q>
  static std::string equivalence() {
    if constexpr (std::is_same_v<Q, in::sphere_plane_penetration<double>> ||
                  std::is_same_v<Q, in::box_plane_penetration<double>>) {
      return "collide with the half-space behind the plane";
    } else if constexpr (std::is_same_v<Q, in::moving_sphere_plane<double>>) {
      return "continuousCollide with the half-space behind the plane, asked where the plane's front is met";
    } else if constexpr (std::is_same_v<Q, in::moving_sphere_passes_box<double>> ||
                         std::is_same_v<Q, in::moving_sphere_passes_sphere<double>>) {
      return "collide of the sphere's way, a capsule";
    } else if constexpr (is_motion<Q>) {
      return "continuousCollide over [0, T], T the power of two that carries the sphere past";
    }
    return "";
  }
  template <class Q>
  static std::string left_out() {
    if constexpr (std::is_same_v<Q, in::box_box_overlap<double>>) {
      return "the axis, which FCL does not tell";
    } else if constexpr (std::is_same_v<Q, in::box_box_penetration<double>>) {
      return "the axis, which it does not tell, and the contact: contact.h does not say which point pos is";
    } else if constexpr (std::is_same_v<Q, in::sphere_sphere_penetration<double>> ||
                         std::is_same_v<Q, in::sphere_box_penetration<double>> ||
                         std::is_same_v<Q, in::sphere_plane_penetration<double>> ||
                         std::is_same_v<Q, in::box_plane_penetration<double>>) {
      return "the contact: contact.h does not say which point pos is";
    } else if constexpr (is_motion<Q>) {
      return "the place and the normal, which continuousCollide does not tell";
    }
    return "";
  }
  template <class Q>
  static std::string why_not() {
    if constexpr (
        requires(const Q& q) { q.velocity, q.triangle; } || requires(const Q& q) { q.velocity, q.rectangle; }) {
      return "FCL moves nothing against a single triangle, which it has only as a part of meshes";
    } else if constexpr (
        requires(const Q& q) { q.point, q.velocity; } || requires(const Q& q) { q.ray; }) {
      return "FCL casts no rays";
    } else if constexpr (requires(const Q& q) { q.box1; }) {
      return "FCL keeps the parts of its test of two boxes to itself";
    } else if constexpr (requires(const Q& q) { q.velocity; }) {
      return "FCL computes no response";
    }
    return "FCL has no points, segments, lines or rectangles";
  }

  static auto answer(const in::sphere_sphere_overlap<double>& q) { return decided(q.sphere1, q.sphere2); }
  static auto answer(const in::sphere_box_overlap<double>& q) { return decided(q.sphere, q.box); }
  static auto answer(const in::box_box_overlap<double>& q) {  // FCL does not return the separating axis
    return only(collide::BoxOverlap<double>{meet(q.box1, q.box2, nullptr), -1}, {});
  }
  static auto answer(const in::sphere_triangle_overlap<double>& q) {
    return collide::Decision<double>{meets_triangle(shape(q.sphere), pose(q.sphere), q.triangle)};
  }
  static auto answer(const in::aabox_triangle_overlap<double>& q) -> Reply<collide::Decision<double>> {
    const auto box = centered(q.box);
    if (!box) return CannotAnswer{"the box's center and sides are not doubles exactly"};
    return collide::Decision<double>{meets_triangle(shape(*box), pose(*box), q.triangle)};
  }

  static auto answer(const in::sphere_sphere_penetration<double>& q) {
    return depth<collide::Penetration<double>>(q.sphere1, q.sphere2);
  }
  static auto answer(const in::sphere_box_penetration<double>& q) {
    return depth<collide::Penetration<double>>(q.sphere, q.box);
  }
  static auto answer(const in::box_box_penetration<double>& q) {
    return depth<collide::BoxPenetration<double>>(q.box1, q.box2);
  }
  static auto answer(const in::sphere_plane_penetration<double>& q) {  // FCL's normal points into the half-space
    return depth<collide::Penetration<double>, -1>(q.sphere, q.plane);
  }
  static auto answer(const in::box_plane_penetration<double>& q) {
    return depth<collide::CornerContacts<double>, -1>(q.box, q.plane);
  }

  static auto answer(const in::moving_sphere_sphere<double>& q) { return moved(q.sphere, q.velocity, q.fixed); }
  static auto answer(const in::moving_sphere_box<double>& q) { return moved(q.sphere, q.velocity, q.box); }
  static auto answer(const in::moving_sphere_capsule<double>& q) { return moved(q.sphere, q.velocity, q.capsule); }
  static auto answer(const in::moving_sphere_plane<double>& q) -> Reply<collide::Impact<double>> {
    if (!(dot(q.plane.normal, q.velocity) < 0) || !(dot(q.plane.normal, q.sphere.center) + q.plane.offset > 0)) {
      return CannotAnswer{"a half-space is no plane for a sphere behind it, or that does not approach it"};
    }
    return moved(q.sphere, q.velocity, q.plane);
  }

  static auto answer(const in::moving_sphere_passes_box<double>& q) { return passes(q, q.box); }
  static auto answer(const in::moving_sphere_passes_sphere<double>& q) { return passes(q, q.fixed); }

 private:
  using Solver = std::conditional_t<static_solver == fcl::GST_LIBCCD, fcl::detail::GJKSolver_libccd<double>,
                                    fcl::detail::GJKSolver_indep<double>>;

  /// With `result`, also requests contacts.
  template <class A, class B>
  static bool meet(const A& a, const B& b, fcl::CollisionResultd* result) {
    fcl::CollisionRequestd request(result != nullptr ? 16 : 1, result != nullptr);
    request.gjk_solver_type = static_solver;
    fcl::CollisionResultd decision_only;
    const auto shape_a = shape(a);
    const auto shape_b = shape(b);
    return fcl::collide(&shape_a, pose(a), &shape_b, pose(b), request, result != nullptr ? *result : decision_only) > 0;
  }
  template <class A, class B>
  static collide::Decision<double> decided(const A& a, const B& b) {
    return {meet(a, b, nullptr)};
  }
  template <class S>
  static bool meets_triangle(const S& s, const fcl::Transform3d& where, const collide::Triangle<double>& t) {
    return Solver().shapeTriangleIntersect(s, where, vector(t.v0), vector(t.v1), vector(t.v2), nullptr, nullptr,
                                           nullptr);
  }

  /// The depth and normal of the deepest contact. FCL's contact position is a different point than the query asks for.
  template <class Depth, int turn = 1, class A, class B>
  static Partly<Depth> depth(const A& a, const B& b) {
    fcl::CollisionResultd result;
    Depth d;
    d.depth = -1;
    if (!meet(a, b, &result)) return only(d, {});  // apart: FCL returns no distance
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      const fcl::Contactd& c = result.getContact(i);
      if (i > 0 && !(c.penetration_depth > d.depth)) continue;
      d.depth = c.penetration_depth;
      d.normal = {turn * c.normal.x(), turn * c.normal.y(), turn * c.normal.z()};
    }
    return only(d, {"depth", "normal"});
  }

  template <class B>
  static Reply<collide::Impact<double>> moved(const collide::Sphere<double>& sphere, const Vec3d& velocity,
                                              const B& b) {
    using Impact = collide::Impact<double>;
    double horizon = 0;
    if constexpr (std::is_same_v<B, collide::Plane<double>>) {
      horizon = time_to_pass(sphere.center, sphere.radius, velocity, b);
    } else {
      horizon = time_to_pass(sphere.center, sphere.radius, velocity, ball_around(b));
    }
    if (horizon == 0) return only(meet(sphere, b, nullptr) ? Impact{0.0, {}, {}} : Impact::miss(), {"time"});
    const Vec3d end = sphere.center + velocity * horizon;
    if (!finite(end)) return CannotAnswer{no_end};
    fcl::ContinuousCollisionRequestd request;
    request.gjk_solver_type = static_solver;
    request.ccd_solver_type = motion_solver;
    fcl::ContinuousCollisionResultd result;
    const fcl::Sphered shape_a = shape(sphere);
    const auto shape_b = shape(b);
    const fcl::Transform3d still = pose(b);
    fcl::continuousCollide(&shape_a, at(sphere.center), at(end), &shape_b, still, still, request, result);
    return only(result.is_collide ? Impact{result.time_of_contact * horizon, {}, {}} : Impact::miss(), {"time"});
  }

  template <class Q, class B>
  static Reply<collide::Decision<double>> passes(const Q& q, const B& b) {
    const auto way = way_of(q, ball_around(b));
    if (!way) return CannotAnswer{no_end};
    return decided(*way, b);
  }
};

/// FCL's signed distance, which is negative where two shapes overlap. It uses another algorithm than FCL's collision:
/// GJK and EPA of one of its solvers. GST_LIBCCD builds a ball from triangles, which may take minutes; GST_INDEP fails
/// an assertion where shapes touch.
template <fcl::GJKSolverType solver>
struct FclDistance : FclShapes {
  using Number = double;
  static std::string version() { return "FCL 0.7"; }

  /// DistanceRequest::distance_tolerance, 1e-6, relative to the least length, in units of 2^-53, rounded up to a power
  /// of two. The tolerance is a length, so the domain starts at lengths of 1/16.
  template <class Q>
  static collide::Contract contract() {
    return {.backward = 0x1p38, .lowest = -4, .highest = 300};
  }
  template <class Q>
  static std::string equivalence() {
    return "minus FCL's signed distance";
  }
  template <class Q>
  static std::string left_out() {
    return "normal and contact, which a distance has not";
  }
  template <class Q>
  static std::string why_not() {
    if constexpr (
        requires(const Q& q) { q.plane; } && !requires(const Q& q) { q.velocity; }) {
      return "FCL 0.7 has no distance to a plane or half-space, and crashes when it is asked for one (its issue 623)";
    }
    if constexpr (std::is_same_v<Q, in::sphere_sphere_penetration<double>> ||
                  std::is_same_v<Q, in::sphere_box_penetration<double>>) {
      return "GST_LIBCCD builds the ball from triangles, which may take minutes";
    }
    return "it is no distance; see the subject fcl";
  }

  static auto answer(const in::sphere_sphere_penetration<double>& q)
    requires(solver == fcl::GST_INDEP)
  {
    return depth<collide::Penetration<double>>(q.sphere1, q.sphere2);
  }
  static auto answer(const in::sphere_box_penetration<double>& q)
    requires(solver == fcl::GST_INDEP)
  {
    return depth<collide::Penetration<double>>(q.sphere, q.box);
  }
  static auto answer(const in::box_box_penetration<double>& q) {
    return depth<collide::BoxPenetration<double>>(q.box1, q.box2);
  }

 private:
  template <class Depth, class A, class B>
  static Partly<Depth> depth(const A& a, const B& b) {
    fcl::DistanceRequestd request(false, true);
    request.gjk_solver_type = solver;
    fcl::DistanceResultd result;
    const auto shape_a = shape(a);
    const auto shape_b = shape(b);
    fcl::distance(&shape_a, pose(a), &shape_b, pose(b), request, result);
    Depth d;
    d.depth = -result.min_distance;  // the return value is -1 for every overlap with GST_INDEP
    // For separated boxes the query asks for the gap along an axis, which is not their distance.
    if (std::is_same_v<Depth, collide::BoxPenetration<double>> && d.depth < 0) return only(d, {});
    return only(d, {"depth"});
  }
};

using FclDistanceLibccd = FclDistance<fcl::GST_LIBCCD>;
using FclDistanceIndep = FclDistance<fcl::GST_INDEP>;
using FclDefault = Fcl<fcl::GST_LIBCCD, fcl::CCDC_NAIVE>;
using FclIndep = Fcl<fcl::GST_INDEP, fcl::CCDC_NAIVE>;
using FclConservativeAdvancement = Fcl<fcl::GST_INDEP, fcl::CCDC_CONSERVATIVE_ADVANCEMENT>;

}  // namespace nearmiss::adapters
