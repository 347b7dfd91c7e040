/// FCL 0.7 as a subject: static collision, penetration, and continuous collision for the moving sphere.
#pragma once

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <string_view>
#include <type_traits>

#include "impl/adapters/motion.hpp"
#include "impl/adapters/operations.hpp"
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
  static fcl::Halfspaced shape(const collide::HalfSpace<double>& h) { return {vector(h.normal), -h.offset}; }
  static fcl::Transform3d pose(const collide::HalfSpace<double>&) { return fcl::Transform3d::Identity(); }
};

/// A shape with its pose.
template <class S>
struct FclBody {
  explicit FclBody(const S& s) : geometry(FclShapes::shape(s)), pose(FclShapes::pose(s)) {}
  decltype(FclShapes::shape(S{})) geometry;
  fcl::Transform3d pose;
};

/// Two bodies, ready for the calls of FCL's interface.
template <class A, class B>
struct FclPair {
  FclPair(const A& first, const B& second) : a(first), b(second) {}

  bool meet(const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) const {
    return fcl::collide(&a.geometry, a.pose, &b.geometry, b.pose, request, result) > 0;
  }
  fcl::ContinuousCollisionResultd move(const fcl::Transform3d& end,
                                       const fcl::ContinuousCollisionRequestd& request) const {
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(&a.geometry, a.pose, end, &b.geometry, b.pose, b.pose, request, result);
    return result;
  }
  double distance(const fcl::DistanceRequestd& request) const {
    fcl::DistanceResultd result;
    fcl::distance(&a.geometry, a.pose, &b.geometry, b.pose, request, result);
    return result.min_distance;  // the return value is -1 for every overlap with GST_INDEP
  }

  FclBody<A> a;
  FclBody<B> b;
};

/// FCL's test of a body against a triangle that is part of no mesh. Only the form with a pose of the triangle knows
/// half-spaces: the other one, which meshes of axis-aligned boxes use, ends the program.
template <class Solver, class S>
bool meets_triangle(const Solver& solver, const FclBody<S>& body, const fcl::Vector3d (&corners)[3]) {
  if constexpr (std::is_same_v<decltype(body.geometry), fcl::Halfspaced>) {
    return solver.shapeTriangleIntersect(body.geometry, body.pose, corners[0], corners[1], corners[2],
                                         fcl::Transform3d::Identity(), nullptr, nullptr, nullptr);
  }
  return solver.shapeTriangleIntersect(body.geometry, body.pose, corners[0], corners[1], corners[2], nullptr, nullptr,
                                       nullptr);
}

/// One of FCL's GJK solvers.
template <fcl::GJKSolverType solver>
using FclSolver = std::conditional_t<solver == fcl::GST_LIBCCD, fcl::detail::GJKSolver_libccd<double>,
                                     fcl::detail::GJKSolver_indep<double>>;

template <class S>
concept FclKnows = requires(const S& s) { FclShapes::shape(s); };
template <class Q>
concept FclKnowsBoth = FclKnows<First<Q>> && FclKnows<Second<Q>>;

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
  static collide::Contract contract() {
    return {.backward = AsksMotion<Q> ? time_of_contact_error : gjk_tolerance, .lowest = -300, .highest = 300};
  }
  template <class Q>
  static std::string equivalence() {
    if constexpr (AsksDepth<Q> && is_plane<Second<Q>>) {
      return "collide with the half-space behind the plane";
    } else if constexpr (AsksBallPath<Q>) {
      return "collide of the sphere's way, a capsule";
    } else if constexpr (AsksBallMotion<Q> && is_plane<Second<Q>>) {
      return "continuousCollide with the half-space behind the plane, asked where the plane's front is met";
    } else if constexpr (AsksMotion<Q>) {
      return "continuousCollide over [0, T], T the power of two that carries the " +
             std::string(name_of_shape<First<Q>>) + " past";
    }
    return "";
  }
  template <class Q>
  static std::string left_out() {
    if constexpr (AsksOverlap<Q> && TellsAxis<Q>) {
      return "the axis, which FCL does not tell";
    } else if constexpr (AsksDepth<Q>) {
      const std::string contact = "the contact: contact.h does not say which point pos is";
      return TellsAxis<Q> ? "the axis, which it does not tell, and " + contact : contact;
    } else if constexpr (AsksMotion<Q>) {
      return "the place and the normal, which continuousCollide does not tell";
    }
    return "";
  }
  template <class Q>
  static std::string why_not() {
    if constexpr (OfMotion<Q> && (asks_of_triangle<Q> || requires(const Q& q) { q.rectangle; })) {
      return "FCL moves nothing against a single triangle, which it has only as a part of meshes";
    } else if constexpr (is_triangle<First<Q>> && is_triangle<Second<Q>>) {
      return "FCL tests two triangles only as parts of meshes";
    } else if constexpr (
        requires(const Q& q) { q.point, q.velocity; } || requires(const Q& q) { q.ray; }) {
      return "FCL casts no rays";
    } else if constexpr (requires(const Q& q) { q.box1; }) {
      return "FCL keeps the parts of its test of two boxes to itself";
    } else if constexpr (OfMotion<Q> && !AnswersWith<Q, Kind::impact>) {
      return "FCL computes no response";
    }
    return "FCL has no points, segments, lines or rectangles";
  }

  template <AsksOverlap Q>
    requires FclKnowsBoth<Q>
  static auto answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    return decided_alone<Q>(meet(a, b, nullptr));
  }
  template <AsksOverlap Q>
    requires FclKnows<First<Q>> && is_triangle<Second<Q>>
  static auto answer(const Q& q) {
    const auto& [body, triangle] = shapes_of(q);
    return decided_alone<Q>(meets(body, triangle));
  }
  template <AsksOverlap Q>
    requires is_triangle<First<Q>> && FclKnows<Second<Q>>
  static auto answer(const Q& q) {
    const auto& [triangle, body] = shapes_of(q);
    return decided_alone<Q>(meets(body, triangle));
  }
  static auto answer(const in::aabox_triangle_overlap<double>& q) -> Reply<collide::Decision<double>> {
    const auto box = centered(q.box);
    if (!box) return CannotAnswer{"the box's center and sides are not doubles exactly"};
    return collide::Decision<double>{meets(*box, q.triangle)};
  }

  template <AsksDepth Q>
    requires FclKnowsBoth<Q>
  static auto answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    constexpr int turn = is_plane<Second<Q>> ? -1 : 1;  // FCL's normal points into the half-space
    return depth<typename Q::Answer, turn>(a, b);
  }

  template <AsksMotion Q>
    requires FclKnowsBoth<Q>
  static Reply<collide::Impact<double>> answer(const Q& q) {
    const auto& [mover, target] = shapes_of(q);
    if constexpr (is_plane<Second<Q>>) {
      if (!(dot(target.normal, q.velocity) < 0) || !(dot(target.normal, mover.center) + target.offset > 0))
        return CannotAnswer{"a half-space is no plane for a sphere behind it, or that does not approach it"};
    }
    return moved(mover, q.velocity, target);
  }

  template <AsksBallPath Q>
    requires FclKnows<Second<Q>>
  static Reply<collide::Decision<double>> answer(const Q& q) {
    const auto way = way_of(q, ball_around(std::get<1>(shapes_of(q))));
    if (!way) return CannotAnswer{no_end};
    return collide::Decision<double>{meet(*way, std::get<1>(shapes_of(q)), nullptr)};
  }

 private:
  /// With `result`, also requests contacts.
  template <class A, class B>
  static bool meet(const A& a, const B& b, fcl::CollisionResultd* result) {
    fcl::CollisionRequestd request(result != nullptr ? 16 : 1, result != nullptr);
    request.gjk_solver_type = static_solver;
    fcl::CollisionResultd decision_only;
    return FclPair(a, b).meet(request, result != nullptr ? *result : decision_only);
  }
  template <class S>
  static bool meets(const S& s, const collide::Triangle<double>& t) {
    return meets_triangle(FclSolver<static_solver>(), FclBody(s), {vector(t.v0), vector(t.v1), vector(t.v2)});
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

  template <class A, class B>
  static Reply<collide::Impact<double>> moved(const A& a, const Vec3d& velocity, const B& b) {
    using Impact = collide::Impact<double>;
    const collide::Sphere<double> ball = ball_around(a);
    const double horizon = time_to_pass(ball.center, ball.radius, velocity, bound_of(b));
    if (horizon == 0) return only(meet(a, b, nullptr) ? Impact{0.0, {}, {}} : Impact::miss(), {"time"});
    const FclPair pair(a, b);
    fcl::Transform3d end = pair.a.pose;
    end.translation() += vector(velocity * horizon);
    if (!end.translation().allFinite()) return CannotAnswer{no_end};
    fcl::ContinuousCollisionRequestd request;
    request.gjk_solver_type = static_solver;
    request.ccd_solver_type = motion_solver;
    const fcl::ContinuousCollisionResultd result = pair.move(end, request);
    return only(result.is_collide ? Impact{result.time_of_contact * horizon, {}, {}} : Impact::miss(), {"time"});
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
    if constexpr (!AsksSignedDistance<Q>) return "minus FCL's signed distance";
    if constexpr (!asks_of_triangle<Q>) return "";
    return is_triangle<First<Q>> ? "triDistance, of triangles that are apart"
                                 : "shapeTriangleDistance, of shapes that are apart";
  }
  template <class Q>
  static std::string left_out() {
    return AsksSignedDistance<Q> ? "normal and points" : "normal and contact, which a distance has not";
  }
  template <class Q>
  static std::string why_not() {
    if constexpr ((is_plane<Second<Q>> || is_halfspace<Second<Q>>)&&!OfMotion<Q>) {
      return "FCL 0.7 has no distance to a plane or half-space, and crashes when it is asked for one (its issue 623)";
    }
    if constexpr (AsksDepth<Q> || (AsksSignedDistance<Q> && FclKnowsBoth<Q>)) {
      return "GST_LIBCCD builds the ball from triangles, which may take minutes";
    }
    return "it is no distance; see the subject fcl";
  }

  template <AsksDepth Q>
    requires(FclKnowsBoth<Q> && !is_plane<Second<Q>> && (solver == fcl::GST_INDEP || !is_sphere<First<Q>>))
  static auto answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    fcl::DistanceRequestd request(false, true);
    request.gjk_solver_type = solver;
    typename Q::Answer d;
    d.depth = -FclPair(a, b).distance(request);
    // For separated boxes the query asks for the gap along an axis, which is not their distance.
    if (TellsAxis<Q> && d.depth < 0) return only(d, {});
    return only(d, {"depth"});
  }

  template <AsksSignedDistance Q>
    requires(FclKnowsBoth<Q> && !is_halfspace<Second<Q>> && solver == fcl::GST_INDEP)
  static auto answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    fcl::DistanceRequestd request(false, true);
    request.gjk_solver_type = solver;
    typename Q::Answer d;
    d.distance = FclPair(a, b).distance(request);
    return only(d, {"distance"});
  }
  template <AsksSignedDistance Q>
    requires((FclKnows<First<Q>> || is_triangle<First<Q>>) && is_triangle<Second<Q>>)
  static Reply<typename Q::Answer> answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    typename Q::Answer d;
    d.distance = distance_of_triangle(a, {vector(b.v0), vector(b.v1), vector(b.v2)});
    if (!(d.distance > 0)) return CannotAnswer{"FCL tells no depth of a triangle"};
    return only(d, {"distance"});
  }

 private:
  using Corners = fcl::Vector3d[3];
  static double distance_of_triangle(const collide::Triangle<double>& t, const Corners& corners) {
    const Corners own{vector(t.v0), vector(t.v1), vector(t.v2)};
    fcl::Vector3d on_own, on_other;
    return fcl::detail::TriangleDistanced::triDistance(own, corners, on_own, on_other);
  }
  template <class S>
  static double distance_of_triangle(const S& s, const Corners& corners) {
    const FclBody<S> body(s);
    double distance = 0;
    FclSolver<solver>().shapeTriangleDistance(body.geometry, body.pose, corners[0], corners[1], corners[2], &distance);
    return distance;
  }
};

using FclDistanceLibccd = FclDistance<fcl::GST_LIBCCD>;
using FclDistanceIndep = FclDistance<fcl::GST_INDEP>;
using FclDefault = Fcl<fcl::GST_LIBCCD, fcl::CCDC_NAIVE>;
using FclIndep = Fcl<fcl::GST_INDEP, fcl::CCDC_NAIVE>;
using FclConservativeAdvancement = Fcl<fcl::GST_INDEP, fcl::CCDC_CONSERVATIVE_ADVANCEMENT>;

}  // namespace nearmiss::adapters
