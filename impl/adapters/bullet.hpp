/// Bullet 3.24 as a subject, in double or, without BT_USE_DOUBLE_PRECISION, in float: the algorithms of its dispatcher,
/// its detectors, its ray tests (btSubsimplexConvexCast) and its sweeps (btContinuousConvexCollision, with GJK and
/// EPA). The adapter computes their parameters, such as the end of a cast, in double and rounds once.
///
/// Every margin that is not a radius is set to zero: with Bullet's default of 0.04 a box has round edges, so it would
/// be a different body.
///
/// A body, an algorithm and a motion are prepared by their constructors; what their other functions do is Bullet's
/// work.
#pragma once

#include <btBulletCollisionCommon.h>

#include <BulletCollision/CollisionDispatch/SphereTriangleDetector.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btAabbUtil2.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "impl/adapters/motion.hpp"
#include "impl/adapters/operations.hpp"
#include "impl/subject/adapter.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::adapters {

namespace in = inputs;

/// The shapes of `collide` as Bullet's, and their poses.
struct BulletShapes {
  static bool fits(const Vec3d& v) {
    return std::isfinite(btScalar(v.x)) && std::isfinite(btScalar(v.y)) && std::isfinite(btScalar(v.z));
  }
  static btVector3 vector(const Vec3d& v) { return {btScalar(v.x), btScalar(v.y), btScalar(v.z)}; }
  static Vec3d doubles(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
  static btTransform at(const Vec3d& p) { return btTransform(btQuaternion::getIdentity(), vector(p)); }

  static btSphereShape shape(const collide::Sphere<double>& s) { return btSphereShape(btScalar(s.radius)); }
  static btTransform pose(const collide::Sphere<double>& s) { return at(s.center); }
  static btBoxShape shape(const collide::Box<double>& b) { return btBoxShape(vector(b.half)); }
  static btTransform pose(const collide::Box<double>& b) {
    const auto [x, y, z, w] = unit(b.orientation);
    return btTransform({btScalar(x), btScalar(y), btScalar(z), btScalar(w)}, vector(b.center));
  }
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
  static btStaticPlaneShape shape(const collide::HalfSpace<double>& h) {
    return shape(collide::Plane<double>{h.normal, h.offset});
  }
  static btTransform pose(const collide::HalfSpace<double>&) { return btTransform::getIdentity(); }
  static btTriangleShape shape(const collide::Triangle<double>& t) {
    return btTriangleShape(vector(t.v0), vector(t.v1), vector(t.v2));
  }
  static btTransform pose(const collide::Triangle<double>&) { return btTransform::getIdentity(); }
};

template <class S>
concept BulletKnows = requires(const S& s) { BulletShapes::shape(s); };

/// A shape with its pose, in the form of Bullet's algorithms.
template <class S>
struct BulletBody {
  explicit BulletBody(const S& s) : geometry(BulletShapes::shape(s)) {
    if constexpr (is_box<S> || is_triangle<S>) geometry.setMargin(0);
    object.setCollisionShape(&geometry);
    object.setWorldTransform(BulletShapes::pose(s));
  }
  BulletBody(const BulletBody&) = delete;
  BulletBody& operator=(const BulletBody&) = delete;
  const btTransform& pose() const { return object.getWorldTransform(); }

  decltype(BulletShapes::shape(S{})) geometry;
  btCollisionObject object;
  btCollisionObjectWrapper wrapper{nullptr, &geometry, &object, object.getWorldTransform(), -1, -1};
};

/// The deepest contact in place of Bullet's manifold, which merges and drops contacts.
struct BulletContact final : btManifoldResult {
  using btManifoldResult::btManifoldResult;
  void addContactPoint(const btVector3& on_b, const btVector3& point, btScalar at_distance) override {
    if (any && at_distance >= distance) return;
    any = true, distance = at_distance, normal = on_b, on_second = point;
  }
  bool yes() const { return any && distance <= 0; }
  btVector3 on_first() const { return on_second + normal * distance; }

  bool any = false;
  btScalar distance = 0;
  btVector3 normal{0, 0, 0};  ///< on the second, towards the first
  btVector3 on_second{0, 0, 0};
};

inline btCollisionDispatcher& bullet_dispatcher() {
  static btDefaultCollisionConfiguration configuration;
  static btCollisionDispatcher one(&configuration);
  return one;
}

/// The algorithm that Bullet's dispatcher has for two shapes.
template <class A, class B>
struct BulletAlgorithm {
  BulletAlgorithm(const A& first, const B& second) : a(first), b(second) {}
  BulletAlgorithm(const BulletAlgorithm&) = delete;
  BulletAlgorithm& operator=(const BulletAlgorithm&) = delete;
  ~BulletAlgorithm() {
    algorithm->~btCollisionAlgorithm();
    bullet_dispatcher().freeCollisionAlgorithm(algorithm);
  }
  BulletContact deepest() const {
    BulletContact contact(&a.wrapper, &b.wrapper);
    algorithm->processCollision(&a.wrapper, &b.wrapper, settings, &contact);
    return contact;
  }

  BulletBody<A> a;
  BulletBody<B> b;
  btCollisionAlgorithm* algorithm =
      bullet_dispatcher().findAlgorithm(&a.wrapper, &b.wrapper, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  static inline const btDispatcherInfo settings;
};

/// Bullet's test of a sphere against a triangle.
struct BulletSphereTriangle {
  BulletSphereTriangle(const collide::Sphere<double>& sphere, const collide::Triangle<double>& triangle)
      : a(sphere), b(triangle), detector(&a.geometry, &b.geometry, 0) {}
  bool meet() {
    btVector3 point, normal;
    btScalar depth = 0, time = 1;
    return detector.collide(a.pose().getOrigin(), point, normal, depth, time, 0);
  }

  BulletBody<collide::Sphere<double>> a;
  BulletBody<collide::Triangle<double>> b;
  SphereTriangleDetector detector;
};

/// The share of a cast's way, and the normal.
struct BulletHit {
  btScalar fraction;
  btVector3 normal;
};

/// A shape, or a point as a sphere of radius 0, that is cast along `way`.
template <class A, class B>
struct BulletMotion {
  BulletMotion(const A& mover, const Vec3d& way, const B& fixed)
      : a(mover),
        b(fixed),
        to(a.pose().getBasis(), BulletShapes::vector(BulletShapes::doubles(a.pose().getOrigin()) + way)) {}
  std::optional<BulletHit> subsimplex() const {
    btVoronoiSimplexSolver simplex;
    return by(btSubsimplexConvexCast(&a.geometry, &b.geometry, &simplex));
  }
  std::optional<BulletHit> continuous() const {
    if constexpr (is_plane<B> || is_halfspace<B>) {
      return by(btContinuousConvexCollision(&a.geometry, &b.geometry));
    } else {
      btVoronoiSimplexSolver simplex;
      btGjkEpaPenetrationDepthSolver epa;
      return by(btContinuousConvexCollision(&a.geometry, &b.geometry, &simplex, &epa));
    }
  }

  BulletBody<A> a;
  BulletBody<B> b;
  btTransform to;

 private:
  std::optional<BulletHit> by(btConvexCast&& cast) const {
    btConvexCast::CastResult result;
    result.m_fraction = 1;
    const btScalar unset = std::numeric_limits<btScalar>::quiet_NaN();  // Bullet leaves some numbers unset
    result.m_normal = btVector3(unset, unset, unset);
    if (!cast.calcTimeOfImpact(a.pose(), to, b.pose(), b.pose(), result)) return std::nullopt;
    return BulletHit{result.m_fraction, result.m_normal};
  }
};

/// The ray test of a triangle's front.
struct BulletTriangleRay {
  BulletTriangleRay(const Vec3d& start, const Vec3d& end, const collide::Triangle<double>& t)
      : from(BulletShapes::vector(start)),
        to(BulletShapes::vector(end)),
        corners{BulletShapes::vector(t.v0), BulletShapes::vector(t.v1), BulletShapes::vector(t.v2)} {}
  std::optional<BulletHit> cast() {
    Nearest nearest(from, to, btTriangleRaycastCallback::kF_FilterBackfaces);
    nearest.processTriangle(corners, 0, 0);
    return nearest.hit ? std::optional(BulletHit{nearest.m_hitFraction, nearest.normal}) : std::nullopt;
  }

  btVector3 from, to, corners[3];

 private:
  struct Nearest final : btTriangleRaycastCallback {
    using btTriangleRaycastCallback::btTriangleRaycastCallback;
    btScalar reportHit(const btVector3& hit_normal, btScalar fraction, int, int) override {
      normal = hit_normal, hit = true;
      return fraction;
    }
    btVector3 normal{0, 0, 0};
    bool hit = false;
  };
};

/// The ray test of an axis-aligned box by outcodes.
struct BulletAABoxRay {
  BulletAABoxRay(const Vec3d& start, const Vec3d& end, const collide::AABox<double>& box)
      : from(BulletShapes::vector(start)),
        to(BulletShapes::vector(end)),
        min(BulletShapes::vector(box.min)),
        max(BulletShapes::vector(box.max)) {}
  std::optional<BulletHit> cast() const {
    btScalar fraction = 1;
    btVector3 normal(0, 0, 0);
    if (!btRayAabb(from, to, min, max, fraction, normal)) return std::nullopt;
    return BulletHit{fraction, normal};
  }

  btVector3 from, to, min, max;
};

/// The queries with inputs in double that are exact btScalars.
struct BulletInDoubles : private BulletShapes {
  template <AsksOverlap Q>
    requires BulletKnows<First<Q>> && BulletKnows<Second<Q>>
  static auto answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    if constexpr (is_sphere<First<Q>> && is_triangle<Second<Q>>) {
      return decided_alone<Q>(BulletSphereTriangle(a, b).meet());
    } else {
      return decided_alone<Q>(BulletAlgorithm(a, b).deepest().yes());
    }
  }

  template <AsksDepth Q>
    requires BulletKnows<First<Q>> && BulletKnows<Second<Q>>
  static Partly<typename Q::Answer> answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    const BulletAlgorithm algorithm(a, b);
    const BulletContact deepest = algorithm.deepest();
    typename Q::Answer d;
    d.depth = deepest.any ? -deepest.distance : -1;
    if (!(d.depth >= 0)) return only(d, {});  // apart: Bullet reports only short distances
    d.normal = doubles(deepest.normal) * (is_plane<Second<Q>> ? 1.0 : -1.0);
    if constexpr (is_sphere<First<Q>> && (is_sphere<Second<Q>> || is_plane<Second<Q>>)) {
      d.contact = doubles(deepest.on_first());
      return only(d, {"depth", "normal", "contact"});
    } else {
      return only(d, {"depth", "normal"});
    }
  }

  template <AsksSignedDistance Q>
    requires(BulletKnows<First<Q>> && is_halfspace<Second<Q>>)
  static Reply<typename Q::Answer> answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    const BulletAlgorithm algorithm(a, b);
    const BulletContact deepest = algorithm.deepest();
    if (!deepest.any) return CannotAnswer{"Bullet tells no distance from a plane but of shapes that are near"};
    return typename Q::Answer{deepest.distance, doubles(deepest.normal) * -1.0, doubles(deepest.on_first()),
                              doubles(deepest.on_second)};
  }
  template <AsksSignedDistance Q>
    requires(BulletKnows<First<Q>> && BulletKnows<Second<Q>> && !is_halfspace<Second<Q>>)
  static Reply<typename Q::Answer> answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    const BulletBody first(a);
    const BulletBody second(b);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    btGjkPairDetector detector(&first.geometry, &second.geometry, &simplex, &depth);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = first.pose(), input.m_transformB = second.pose();
    btPointCollector nearest;
    detector.getClosestPoints(input, nearest, nullptr);
    if (!nearest.m_hasResult) return CannotAnswer{"btGjkPairDetector finds no result"};
    const btVector3 on_first = nearest.m_pointInWorld + nearest.m_normalOnBInWorld * nearest.m_distance;
    return typename Q::Answer{nearest.m_distance, doubles(nearest.m_normalOnBInWorld) * -1.0, doubles(on_first),
                              doubles(nearest.m_pointInWorld)};
  }

  template <AsksPointMotion Q>
    requires((BulletKnows<First<Q>> && !is_plane<First<Q>> && !is_halfspace<First<Q>>) || is_aabox<First<Q>>)
  static Reply<typename Q::Answer> answer(const Q& q) {
    using Shape = First<Q>;
    const Shape& target = std::get<0>(shapes_of(q));
    const Vec3d& start = moving_point_of(q);
    if constexpr (is_sphere<Shape>) {
      if (length(start - target.center) <= target.radius)
        return CannotAnswer{"Bullet's rays do not see a shape that they start in"};
    }
    const double horizon = time_of_cast(start, 0, q.velocity, ball_around(target));
    const Vec3d end = start + q.velocity * horizon;
    if (horizon == 0 || !fits(end)) return CannotAnswer{no_cast};
    if constexpr (is_triangle<Shape>) {
      const auto hit = BulletTriangleRay(start, end, target).cast();
      return hit ? Reply<Impact>(first_contact(*hit, horizon)) : Impact::miss();
    } else if constexpr (is_aabox<Shape>) {
      if (contains(target, start)) return CannotAnswer{"btRayAabb is asked from outside"};
      auto entry = collide::Entry<double>::miss();
      if (const auto hit = BulletAABoxRay(start, end, target).cast()) entry.time = hit->fraction * horizon;
      return only(entry, {"time"});  // btRayAabb's normal points inward on one side and outward on the other
    } else {
      const auto hit = BulletMotion(collide::Sphere<double>{start, 0.0}, q.velocity * horizon, target).subsimplex();
      return hit ? Reply<Impact>(first_contact(*hit, horizon)) : Impact::miss();
    }
  }

  template <AsksMotion Q>
    requires(BulletKnows<First<Q>> && BulletKnows<Second<Q>> && !Q::traits.one_sided)
  static Reply<collide::Impact<double>> answer(const Q& q) {
    const auto& [mover, target] = shapes_of(q);
    // Bullet's sweeps miss a shape in which they start, so the static algorithm is asked first.
    if (BulletAlgorithm(mover, target).deepest().yes()) return only(Impact{0.0, {}, {}}, {"time"});
    const collide::Sphere<double> ball = ball_around(mover);
    const double horizon = time_of_cast(ball.center, ball.radius, q.velocity, bound_of(target));
    const Vec3d way = q.velocity * horizon;
    if (horizon == 0 || !fits(ball.center + way)) return CannotAnswer{no_cast};
    const auto hit = BulletMotion(mover, way, target).continuous();
    return hit ? Reply<Impact>(first_contact(*hit, horizon)) : Impact::miss();
  }

 private:
  using Impact = collide::Impact<double>;
  static constexpr const char* no_cast = "a cast has two ends, apart and finite";

  /// Like time_to_pass, but positive also for a body that moves away; 0 without motion.
  template <class To>
  static double time_of_cast(const Vec3d& from, double radius, const Vec3d& velocity, const To& to) {
    const double passing = time_to_pass(from, radius, velocity, to), speed = length(velocity);
    if (passing > 0 || !(speed > 0)) return passing;
    double size = radius;
    if constexpr (requires { to.radius; }) size = to.radius;
    return power_of_two_above((size > 0 ? size : 1.0) / speed);
  }
  static Partly<Impact> first_contact(const BulletHit& hit, double horizon) {
    return only(Impact{hit.fraction * horizon, {}, doubles(hit.normal)}, {"time", "normal"});
  }
  static bool contains(const collide::AABox<double>& b, const Vec3d& p) {
    const auto within = [](double low, double x, double high) { return low <= x && x <= high; };
    return within(b.min.x, p.x, b.max.x) && within(b.min.y, p.y, b.max.y) && within(b.min.z, p.z, b.max.z);
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
    } else if constexpr (AsksPointMotion<Q> && is_triangle<First<Q>>) {
      return "the place, of which btTriangleRaycastCallback tells the fraction alone";
    } else if constexpr (requires(const Q& q) { q.velocity; }) {
      return "the place: no header says whether m_hitPoint is that of the first contact or of the cast's last step";
    } else if constexpr (AsksDepth<Q> && is_plane<Second<Q>> && !is_sphere<First<Q>>) {
      return "the corners: it tells the deepest alone";
    } else if constexpr (AsksDepth<Q> && is_sphere<First<Q>> && is_box<Second<Q>>) {
      return "the contact: its manifolds have a place on each body, and which one is meant depends on where the center "
             "is";
    } else if constexpr (AsksDepth<Q> && TellsAxis<Q>) {
      return "the axis, which it keeps to itself, and the contact: its manifolds have a place on each body, none "
             "between them";
    } else if constexpr (AsksOverlap<Q> && TellsAxis<Q>) {
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
