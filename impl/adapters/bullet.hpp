/// Bullet 3.24 as a subject, in double or, without BT_USE_DOUBLE_PRECISION, in float: the algorithms of its dispatcher,
/// its detectors, its ray tests (btSubsimplexConvexCast) and its sweeps (btContinuousConvexCollision, with GJK and
/// EPA). The adapter computes their parameters, such as the end of a cast, in double and rounds once.
///
/// Every margin that is not a radius is set to zero: with Bullet's default of 0.04 a box has round edges, so it would
/// be a different body.
#pragma once

#include <btBulletCollisionCommon.h>

#include <BulletCollision/CollisionDispatch/SphereTriangleDetector.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btAabbUtil2.h>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "impl/adapters/motion.hpp"
#include "impl/subject/adapter.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::adapters {

namespace in = inputs;

/// The queries with inputs in double that are exact btScalars.
struct BulletInDoubles {
  static auto answer(const in::sphere_sphere_overlap<double>& q) { return decided(q.sphere1, q.sphere2); }
  static auto answer(const in::sphere_box_overlap<double>& q) { return decided(q.sphere, q.box); }
  static auto answer(const in::box_box_overlap<double>& q) {
    return only(collide::BoxOverlap<double>{decided(q.box1, q.box2).yes(), -1}, {});
  }
  static auto answer(const in::sphere_triangle_overlap<double>& q) {
    btSphereShape ball(btScalar(q.sphere.radius));
    btTriangleShape triangle(vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2));
    triangle.setMargin(0);
    btVector3 point, normal;
    btScalar depth = 0, time = 1;
    SphereTriangleDetector detector(&ball, &triangle, 0);
    return collide::Decision<double>{detector.collide(vector(q.sphere.center), point, normal, depth, time, 0)};
  }

  static auto answer(const in::sphere_sphere_penetration<double>& q) {
    return depth<collide::Penetration<double>>(q.sphere1, q.sphere2, &Result::on_first);
  }
  static auto answer(const in::sphere_box_penetration<double>& q) {
    return depth<collide::Penetration<double>>(q.sphere, q.box);
  }
  static auto answer(const in::box_box_penetration<double>& q) {
    return depth<collide::BoxPenetration<double>>(q.box1, q.box2);
  }
  static auto answer(const in::sphere_plane_penetration<double>& q) {
    return depth<collide::Penetration<double>, 1>(q.sphere, q.plane, &Result::on_first);
  }
  static auto answer(const in::box_plane_penetration<double>& q) {
    return depth<collide::CornerContacts<double>, 1>(q.box, q.plane);
  }

  static auto answer(const in::moving_point_sphere<double>& q) -> Reply<collide::Impact<double>> {
    if (length(q.point - q.sphere.center) <= q.sphere.radius) {
      return CannotAnswer{"Bullet's rays do not see a shape that they start in"};
    }
    return cast(q.point, q.velocity, q.sphere);
  }
  static auto answer(const in::moving_point_box<double>& q) { return cast(q.point, q.velocity, q.box); }
  static auto answer(const in::moving_point_capsule<double>& q) { return cast(q.point, q.velocity, q.capsule); }
  static auto answer(const in::moving_point_triangle<double>& q) -> Reply<collide::Impact<double>> {
    const double horizon = time_of_cast(q.point, 0, q.velocity, ball_around(q.triangle));
    const Vec3d end = q.point + q.velocity * horizon;
    if (horizon == 0 || !fits(end)) return CannotAnswer{no_cast};
    Nearest nearest(vector(q.point), vector(end), btTriangleRaycastCallback::kF_FilterBackfaces);
    btVector3 corners[3] = {vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2)};
    nearest.processTriangle(corners, 0, 0);
    if (!nearest.hit) return collide::Impact<double>::miss();
    return only(collide::Impact<double>{nearest.m_hitFraction * horizon, {}, doubles(nearest.normal)},
                {"time", "normal"});
  }
  static auto answer(const in::moving_point_aabox<double>& q) -> Reply<collide::Entry<double>> {
    const double horizon = time_of_cast(q.point, 0, q.velocity, ball_around(q.aabox));
    const Vec3d end = q.point + q.velocity * horizon;
    if (horizon == 0 || !fits(end)) return CannotAnswer{no_cast};
    const auto within = [](double low, double x, double high) { return low <= x && x <= high; };
    if (within(q.aabox.min.x, q.point.x, q.aabox.max.x) && within(q.aabox.min.y, q.point.y, q.aabox.max.y) &&
        within(q.aabox.min.z, q.point.z, q.aabox.max.z)) {
      return CannotAnswer{"btRayAabb is asked from outside"};
    }
    btScalar fraction = 1;
    btVector3 normal(0, 0, 0);
    const bool hit =
        btRayAabb(vector(q.point), vector(end), vector(q.aabox.min), vector(q.aabox.max), fraction, normal);
    collide::Entry<double> entry = collide::Entry<double>::miss();
    if (hit) entry.time = fraction * horizon;
    return only(entry, {"time"});  // btRayAabb's normal points inward on one side and outward on the other
  }

  static auto answer(const in::moving_sphere_sphere<double>& q) { return sweep(q.sphere, q.velocity, q.fixed); }
  static auto answer(const in::moving_sphere_box<double>& q) { return sweep(q.sphere, q.velocity, q.box); }
  static auto answer(const in::moving_sphere_capsule<double>& q) { return sweep(q.sphere, q.velocity, q.capsule); }

 private:
  using Impact = collide::Impact<double>;
  static constexpr const char* no_cast = "a cast has two ends, apart and finite";

  /// Like time_to_pass, but positive also for a body that moves away; 0 without motion.
  static double time_of_cast(const Vec3d& from, double radius, const Vec3d& velocity,
                             const collide::Sphere<double>& to) {
    const double passing = time_to_pass(from, radius, velocity, to), speed = length(velocity);
    if (passing > 0 || !(speed > 0)) return passing;
    return power_of_two_above((to.radius > 0 ? to.radius : 1.0) / speed);
  }

  struct Nearest final : btTriangleRaycastCallback {
    using btTriangleRaycastCallback::btTriangleRaycastCallback;
    btScalar reportHit(const btVector3& hit_normal, btScalar fraction, int, int) override {
      normal = hit_normal, hit = true;
      return fraction;
    }
    btVector3 normal{0, 0, 0};
    bool hit = false;
  };
  /// Collects the deepest contact instead of Bullet's manifold, which merges and drops contacts.
  struct Deepest final : btManifoldResult {
    using btManifoldResult::btManifoldResult;
    void addContactPoint(const btVector3& on_b, const btVector3& point, btScalar distance) override {
      if (any && distance >= least) return;
      any = true, least = distance, normal = on_b, on_second = point;
    }
    bool any = false;
    btScalar least = 0;
    btVector3 normal{0, 0, 0};  ///< on the second, towards the first
    btVector3 on_second{0, 0, 0};
  };

  static bool fits(const Vec3d& v) {
    return std::isfinite(btScalar(v.x)) && std::isfinite(btScalar(v.y)) && std::isfinite(btScalar(v.z));
  }
  static btVector3 vector(const Vec3d& v) { return {btScalar(v.x), btScalar(v.y), btScalar(v.z)}; }
  static Vec3d doubles(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
  static btQuaternion turn(const collide::Box<double>& b) {
    const auto [x, y, z, w] = unit(b.orientation);
    return {btScalar(x), btScalar(y), btScalar(z), btScalar(w)};
  }
  static btTransform at(const Vec3d& p) { return btTransform(btQuaternion::getIdentity(), vector(p)); }
  static btSphereShape shape(const collide::Sphere<double>& s) { return btSphereShape(btScalar(s.radius)); }
  static btTransform pose(const collide::Sphere<double>& s) { return at(s.center); }
  static btBoxShape shape(const collide::Box<double>& b) { return btBoxShape(vector(b.half)); }
  static btTransform pose(const collide::Box<double>& b) { return btTransform(turn(b), vector(b.center)); }
  static btCapsuleShapeZ shape(const collide::Capsule<double>& c) {
    return btCapsuleShapeZ(btScalar(c.radius), btScalar(length(c.p1 - c.p0)));
  }
  static btTransform pose(const collide::Capsule<double>& c) {
    const btVector3 along = vector(c.p1 - c.p0);
    const bool ball = !(length(c.p1 - c.p0) > 0);
    return btTransform(ball ? btQuaternion::getIdentity() : shortestArcQuat(btVector3(0, 0, 1), along.normalized()),
                       vector(c.p0 * 0.5 + c.p1 * 0.5));
  }
  static btStaticPlaneShape shape(const collide::Plane<double>& p) {  // Bullet normalizes the normal
    return btStaticPlaneShape(vector(p.normal), btScalar(-p.offset / length(p.normal)));
  }
  static btTransform pose(const collide::Plane<double>&) { return btTransform::getIdentity(); }

  /// A shape with its pose, in the form of Bullet's algorithms.
  template <class S>
  struct Body {
    explicit Body(const S& s) : geometry(shape(s)) {
      if constexpr (std::same_as<S, collide::Box<double>>) geometry.setMargin(0);
      object.setCollisionShape(&geometry);
      object.setWorldTransform(pose(s));
    }
    decltype(shape(S{})) geometry;
    btCollisionObject object;
    btCollisionObjectWrapper wrapper{nullptr, &geometry, &object, object.getWorldTransform(), -1, -1};
  };

  static btCollisionDispatcher& dispatcher() {
    static btDefaultCollisionConfiguration configuration;
    static btCollisionDispatcher one(&configuration);
    return one;
  }
  /// The result of the algorithm of Bullet's dispatcher: a signed distance and contact points, or none.
  struct Result {
    bool any;
    btScalar distance;
    btVector3 normal, on_second;

    btVector3 on_first() const { return on_second + normal * distance; }
  };
  template <class A, class B>
  static Result asked(const A& first, const B& second) {
    Body<A> a(first);
    Body<B> b(second);
    btCollisionAlgorithm* algorithm =
        dispatcher().findAlgorithm(&a.wrapper, &b.wrapper, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    Deepest deepest(&a.wrapper, &b.wrapper);
    algorithm->processCollision(&a.wrapper, &b.wrapper, btDispatcherInfo(), &deepest);
    algorithm->~btCollisionAlgorithm();
    dispatcher().freeCollisionAlgorithm(algorithm);
    return {deepest.any, deepest.least, deepest.normal, deepest.on_second};
  }
  template <class A, class B>
  static collide::Decision<double> decided(const A& a, const B& b) {
    const Result result = asked(a, b);
    return {result.any && result.distance <= 0};
  }
  /// `turn`: -1 for a normal from the first to the second, 1 for one from the second to the first.
  /// `contact`: the member of the result that is the contact, for an answer with a contact.
  template <class Depth, int turn = -1, class A, class B, class Contact = std::nullptr_t>
  static Partly<Depth> depth(const A& a, const B& b, Contact contact = nullptr) {
    const Result result = asked(a, b);
    Depth d;
    d.depth = result.any ? -result.distance : -1;
    if (!(d.depth >= 0)) return only(d, {});  // apart: Bullet reports only short distances
    d.normal = doubles(result.normal) * double(turn);
    if constexpr (std::same_as<Contact, std::nullptr_t>) {
      return only(d, {"depth", "normal"});
    } else {
      d.contact = doubles(std::invoke(contact, result));
      return only(d, {"depth", "normal", "contact"});
    }
  }

  template <class Cast>
  static Reply<Impact> moved(Cast&& by, const Vec3d& from, const Vec3d& velocity, double horizon,
                             const btTransform& still) {
    const Vec3d end = from + velocity * horizon;
    if (horizon == 0 || !fits(end)) return CannotAnswer{no_cast};
    btConvexCast::CastResult result;
    result.m_fraction = 1;
    const btScalar unset = std::numeric_limits<btScalar>::quiet_NaN();  // Bullet leaves some numbers unset
    result.m_normal = btVector3(unset, unset, unset);
    if (!by.calcTimeOfImpact(at(from), at(end), still, still, result)) return Impact::miss();
    return only(Impact{result.m_fraction * horizon, {}, doubles(result.m_normal)}, {"time", "normal"});
  }
  template <class B>
  static Reply<Impact> cast(const Vec3d& point, const Vec3d& velocity, const B& fixed) {
    Body<B> b(fixed);
    btSphereShape dot_shape(0);
    dot_shape.setMargin(0);
    btVoronoiSimplexSolver simplex;
    return moved(btSubsimplexConvexCast(&dot_shape, &b.geometry, &simplex), point, velocity,
                 time_of_cast(point, 0, velocity, ball_around(fixed)), pose(fixed));
  }
  template <class B>
  static Reply<Impact> sweep(const collide::Sphere<double>& sphere, const Vec3d& velocity, const B& fixed) {
    // Bullet's sweeps miss a shape in which they start, so the static algorithm is asked first.
    if (decided(sphere, fixed).yes()) return only(Impact{0.0, {}, {}}, {"time"});
    Body<B> b(fixed);
    btSphereShape ball(btScalar(sphere.radius));
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    return moved(btContinuousConvexCollision(&ball, &b.geometry, &simplex, &epa), sphere.center, velocity,
                 time_of_cast(sphere.center, sphere.radius, velocity, ball_around(fixed)), pose(fixed));
  }
};

/// The same numbers in double; every btScalar is exact in double.
template <template <class> class Inputs>
Inputs<double> in_doubles(const Inputs<btScalar>& q) {
  std::vector<double> values;
  collide::for_each_leaf(q, [&](const auto& leaf, collide::Role) { values.push_back(double(leaf)); });
  return inputs_from<Inputs<double>>(values.data());
}

/// No contract: Bullet states no figure for the accuracy of its answers.
struct Bullet {
  using Number = btScalar;
  static std::string version() {
    return "Bullet " + std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
  }

  template <class Q>
  static std::string equivalence() {
    if constexpr (requires(const Q& q) { q.velocity; }) {
      return "a cast over [0, T], T the power of two that carries it past";
    }
    return "";
  }
  template <class Q>
  static std::string left_out() {
    if constexpr (requires(const Q& q) { q.point, q.velocity, q.aabox; }) {
      return "the normal of btRayAabb, which leads inward on one side and outward on the other, and the place";
    } else if constexpr (requires(const Q& q) { q.velocity, q.triangle; }) {
      return "the place, of which btTriangleRaycastCallback tells the fraction alone";
    } else if constexpr (requires(const Q& q) { q.velocity; }) {
      return "the place: no header says whether m_hitPoint is that of the first contact or of the cast's last step";
    } else if constexpr (std::same_as<Q, in::box_plane_penetration<Number>>) {
      return "the corners: it tells the deepest alone";
    } else if constexpr (std::same_as<Q, in::sphere_box_penetration<Number>>) {
      return "the contact: its manifolds have a place on each body, and which one is meant depends on where the center "
             "is";
    } else if constexpr (std::same_as<Q, in::box_box_penetration<Number>>) {
      return "the axis, which it keeps to itself, and the contact: its manifolds have a place on each body, none "
             "between them";
    } else if constexpr (std::same_as<Q, in::box_box_overlap<Number>>) {
      return "the axis, which it keeps to itself";
    }
    return "";
  }
  template <class Q>
  static std::string why_not() {
    if constexpr (
        requires(const Q& q) { q.limit; } || requires(const Q& q) { q.location; }) {
      return "Bullet's casts tell the first contact, and nothing of a whole way or of a response";
    } else if constexpr (requires(const Q& q) { q.rectangle; }) {
      return "Bullet has no rectangles";
    } else if constexpr (requires(const Q& q) { q.velocity, q.plane; }) {
      return "Bullet's planes have a back, which its casts meet as well";
    } else if constexpr (requires(const Q& q) { q.sphere, q.velocity, q.triangle; }) {
      return "Bullet's triangles have two sides, and its sweeps tell no gate";
    } else if constexpr (requires(const Q& q) { q.velocity, q.prepared; }) {
      return "Bullet prepares no triangles";
    } else if constexpr (requires(const Q& q) { q.box1; }) {
      return "Bullet keeps the parts of its test of two boxes to itself";
    } else if constexpr (requires(const Q& q) { q.box, q.triangle; }) {
      return "Bullet has no test of a box and a triangle but GJK with margins";
    }
    return "Bullet has no such operation on points, segments or lines";
  }

  template <class Q>
    requires requires(const Q& q) { BulletInDoubles::answer(in_doubles(q)); }
  static Answer answer(const Q& q) {
    return erase(BulletInDoubles::answer(in_doubles(q)));
  }
};

}  // namespace nearmiss::adapters
