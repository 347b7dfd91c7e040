/// Bullet 3.24 as a contender, in float or double. Shapes, poses and algorithms are made before the timing; the timed
/// part is one call. Each query uses the most direct functions of Bullet:
///
///   algorithm    processCollision of the algorithm that its dispatcher finds for the two shapes
///   distance     btSphereBoxCollisionAlgorithm::getSphereDistance
///   detector     btBoxBoxDetector, SphereTriangleDetector
///   gjk          btGjkPairDetector with EPA
///   subsimplex   btSubsimplexConvexCast, as its ray tests use it
///   continuous   btContinuousConvexCollision, as its sweep tests use it
///   triangle-ray btTriangleRaycastCallback; slabs: btRayAabb2; outcodes: btRayAabb. They return the fraction along
///                the ray; the contact that the queries ask for is computed from it as in Bullet's
///                ClosestRayResultCallback
#include <btBulletCollisionCommon.h>

#include <BulletCollision/CollisionDispatch/SphereTriangleDetector.h>
#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/CollisionDispatch/btSphereBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btAabbUtil2.h>

#include "benchmarks/contender.hpp"
#include "benchmarks/shapes_of.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::benchmarks {

namespace {

static_assert(std::is_same_v<btScalar, NEARMISS_SCALAR>);
using Vec3 = collide::Vec3<btScalar>;
using Sphere = collide::Sphere<btScalar>;
using Box = collide::Box<btScalar>;
using AABox = collide::AABox<btScalar>;
using Capsule = collide::Capsule<btScalar>;
using Plane = collide::Plane<btScalar>;
using Triangle = collide::Triangle<btScalar>;
using Ray = collide::Ray<btScalar>;

/// A moving point, as a shape.
struct Point {};

btVector3 vector(const Vec3& v) { return {v.x, v.y, v.z}; }
btTransform at(const Vec3& p) { return btTransform(btQuaternion::getIdentity(), vector(p)); }

btSphereShape shape(const Sphere& s) { return btSphereShape(s.radius); }
btTransform pose(const Sphere& s) { return at(s.center); }
btBoxShape shape(const Box& b) { return btBoxShape(vector(b.half)); }
btTransform pose(const Box& b) {
  const auto& q = b.orientation;
  return btTransform(btQuaternion(q.x, q.y, q.z, q.w).normalized(), vector(b.center));
}
btBoxShape shape(const AABox& b) { return btBoxShape(vector((b.max - b.min) * btScalar(0.5))); }
btTransform pose(const AABox& b) { return at((b.min + b.max) * btScalar(0.5)); }
btCapsuleShapeZ shape(const Capsule& c) { return btCapsuleShapeZ(c.radius, norm(c.p1 - c.p0)); }
btTransform pose(const Capsule& c) {
  const btVector3 z(0, 0, 1), along = vector(c.p1 - c.p0);
  const btQuaternion turn = along.fuzzyZero() ? btQuaternion::getIdentity() : shortestArcQuat(z, along.normalized());
  return btTransform(turn, vector((c.p0 + c.p1) * btScalar(0.5)));
}
btStaticPlaneShape shape(const Plane& p) {
  const btScalar length = norm(p.normal);
  return btStaticPlaneShape(vector(p.normal / length), -p.offset / length);
}
btTransform pose(const Plane&) { return btTransform::getIdentity(); }
btTriangleShape shape(const Triangle& t) { return btTriangleShape(vector(t.v0), vector(t.v1), vector(t.v2)); }
btTransform pose(const Triangle&) { return btTransform::getIdentity(); }
btSphereShape shape(const Point&) { return btSphereShape(0); }

/// A body of Bullet's collision world: shape, object and pose.
template <class S>
struct Body {
  explicit Body(const S& s) : geometry(shape(s)) {
    if constexpr (std::is_same_v<S, Triangle>) geometry.setMargin(0);
    object.setCollisionShape(&geometry);
    object.setWorldTransform(pose(s));
  }
  decltype(shape(S{})) geometry;
  btCollisionObject object;
  btCollisionObjectWrapper wrapper{nullptr, &geometry, &object, object.getWorldTransform(), -1, -1};
};

template <class A, class B>
struct Bodies {
  template <class Q>
  explicit Bodies(const Q& q) : a(the<A>(q)), b(the_other<A, B>(q)) {}
  Body<A> a;
  Body<B> b;
};

btCollisionDispatcher& dispatcher() {
  static btDefaultCollisionConfiguration configuration;
  static btCollisionDispatcher one(&configuration);
  return one;
}

/// Bullet's own settings.
const btDispatcherInfo settings;

/// Keeps the deepest contact instead of Bullet's manifold, which would grow from call to call.
struct DeepestContact final : btManifoldResult {
  using btManifoldResult::btManifoldResult;
  void addContactPoint(const btVector3& normal, const btVector3& point, btScalar distance) override {
    if (distance > depth_below) return;
    depth_below = distance, normal_on_b = normal, point_on_b = point;
  }
  btScalar depth_below = BT_LARGE_FLOAT;
  btVector3 normal_on_b, point_on_b;
};

template <class A, class B>
struct Algorithm : Bodies<A, B> {
  template <class Q>
  explicit Algorithm(const Q& q)
      : Bodies<A, B>(q),
        algorithm(
            dispatcher().findAlgorithm(&this->a.wrapper, &this->b.wrapper, nullptr, BT_CONTACT_POINT_ALGORITHMS)) {}
  ~Algorithm() {
    algorithm->~btCollisionAlgorithm();
    dispatcher().freeCollisionAlgorithm(algorithm);
  }
  LibraryAnswer ask() const {
    DeepestContact deepest(&this->a.wrapper, &this->b.wrapper);
    algorithm->processCollision(&this->a.wrapper, &this->b.wrapper, settings, &deepest);
    return {deepest.depth_below <= 0, -deepest.depth_below};
  }
  btCollisionAlgorithm* algorithm;
};

struct SphereBoxDistance : Bodies<Sphere, Box> {
  template <class Q>
  explicit SphereBoxDistance(const Q& q)
      : Bodies(q),
        center(vector(the<Sphere>(q).center)),
        radius(the<Sphere>(q).radius),
        algorithm(nullptr, information(), &a.wrapper, &b.wrapper, false) {}
  static btCollisionAlgorithmConstructionInfo information() {
    btCollisionAlgorithmConstructionInfo i;
    i.m_dispatcher1 = &dispatcher();
    return i;
  }
  LibraryAnswer ask() const {
    btVector3 on_box, normal;
    btScalar depth;
    const bool hit = algorithm.getSphereDistance(&b.wrapper, on_box, normal, depth, center, radius, 0);
    keep(on_box), keep(normal);
    return {hit, depth};
  }
  btVector3 center;
  btScalar radius;
  mutable btSphereBoxCollisionAlgorithm algorithm;
};

struct BoxBoxDetector : Bodies<Box, Box> {
  template <class Q>
  explicit BoxBoxDetector(const Q& q) : Bodies(q), detector(&a.geometry, &b.geometry) {
    input.m_transformA = a.object.getWorldTransform();
    input.m_transformB = b.object.getWorldTransform();
  }
  LibraryAnswer ask() const {
    btPointCollector deepest;
    detector.getClosestPoints(input, deepest, nullptr);
    return {deepest.m_hasResult && deepest.m_distance <= 0, -deepest.m_distance};
  }
  mutable btBoxBoxDetector detector;
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
};

struct SphereTriangle : Bodies<Sphere, Triangle> {
  template <class Q>
  explicit SphereTriangle(const Q& q)
      : Bodies(q), center(vector(the<Sphere>(q).center)), detector(&a.geometry, &b.geometry, 0) {}
  LibraryAnswer ask() const {
    btVector3 point, normal;
    btScalar depth = 0, time = 1;
    const bool hit = detector.collide(center, point, normal, depth, time, 0);
    keep(point), keep(normal);
    return {hit, depth};
  }
  btVector3 center;
  mutable SphereTriangleDetector detector;
};

template <class A, class B>
struct Gjk : Bodies<A, B> {
  template <class Q>
  explicit Gjk(const Q& q) : Bodies<A, B>(q) {
    input.m_transformA = this->a.object.getWorldTransform();
    input.m_transformB = this->b.object.getWorldTransform();
  }
  LibraryAnswer ask() const {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    btGjkPairDetector detector(&this->a.geometry, &this->b.geometry, &simplex, &epa);
    btPointCollector deepest;
    detector.getClosestPoints(input, deepest, nullptr);
    return {deepest.m_hasResult && deepest.m_distance <= 0, -deepest.m_distance};
  }
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
};

/// A sphere that moves from its start to past the shape.
template <class B>
struct ConvexCast : Bodies<Sphere, B> {
  template <class Q>
  explicit ConvexCast(const Q& q)
      : Bodies<Sphere, B>(q),
        from(pose(the<Sphere>(q))),
        to(at(end_of_motion(the<Sphere>(q).center, q.velocity, the<Sphere>(q).radius, the_other<Sphere, B>(q)))),
        still(this->b.object.getWorldTransform()) {}
  template <class Cast>
  LibraryAnswer by(Cast&& cast) const {
    btConvexCast::CastResult result;
    result.m_fraction = 1;
    const bool hit = cast.calcTimeOfImpact(from, to, still, still, result);
    keep(result.m_normal), keep(result.m_hitPoint);
    return {hit, result.m_fraction};
  }
  btTransform from, to, still;
};

template <class B>
struct Subsimplex : ConvexCast<B> {
  using ConvexCast<B>::ConvexCast;
  LibraryAnswer ask() const {
    btVoronoiSimplexSolver simplex;
    return this->by(btSubsimplexConvexCast(&this->a.geometry, &this->b.geometry, &simplex));
  }
};

template <class B>
struct Continuous : ConvexCast<B> {
  using ConvexCast<B>::ConvexCast;
  LibraryAnswer ask() const {
    if constexpr (std::is_same_v<B, Plane>) {
      return this->by(btContinuousConvexCollision(&this->a.geometry, &this->b.geometry));
    } else {
      btVoronoiSimplexSolver simplex;
      btGjkEpaPenetrationDepthSolver epa;
      return this->by(btContinuousConvexCollision(&this->a.geometry, &this->b.geometry, &simplex, &epa));
    }
  }
};

/// A point that moves from its start to past the shape, as Bullet's ray tests cast it.
template <class B>
struct RaySubsimplex {
  template <class Q>
  explicit RaySubsimplex(const Q& q)
      : b(the<B>(q)),
        point(shape(Point{})),
        from(at(q.point)),
        to(at(end_of_motion(q.point, q.velocity, btScalar(0), the<B>(q)))),
        still(b.object.getWorldTransform()) {
    point.setMargin(0);
  }
  LibraryAnswer ask() const {
    btVoronoiSimplexSolver simplex;
    btSubsimplexConvexCast cast(&point, &b.geometry, &simplex);
    btConvexCast::CastResult result;
    result.m_fraction = 1;
    const bool hit = cast.calcTimeOfImpact(from, to, still, still, result);
    keep(result.m_normal), keep(result.m_hitPoint);
    return {hit, result.m_fraction};
  }
  Body<B> b;
  btSphereShape point;
  btTransform from, to, still;
};

void keep_contact(const btVector3& from, const btVector3& to, btScalar fraction) {
  btVector3 contact;
  contact.setInterpolate3(from, to, fraction);
  keep(contact);
}

struct TriangleRay {
  struct Nearest final : btTriangleRaycastCallback {
    using btTriangleRaycastCallback::btTriangleRaycastCallback;
    btScalar reportHit(const btVector3& hit_normal, btScalar fraction, int, int) override {
      normal = hit_normal, hit = true;
      return fraction;
    }
    btVector3 normal;
    bool hit = false;
  };
  template <class Q>
  explicit TriangleRay(const Q& q)
      : corners{vector(the<Triangle>(q).v0), vector(the<Triangle>(q).v1), vector(the<Triangle>(q).v2)},
        from(vector(q.point)),
        to(vector(end_of_motion(q.point, q.velocity, btScalar(0), the<Triangle>(q)))) {}
  LibraryAnswer ask() const {
    Nearest nearest(from, to, btTriangleRaycastCallback::kF_FilterBackfaces);
    nearest.processTriangle(corners, 0, 0);
    keep(nearest.normal);
    if (nearest.hit) keep_contact(from, to, nearest.m_hitFraction);
    return {nearest.hit, nearest.m_hitFraction};
  }
  mutable btVector3 corners[3];
  btVector3 from, to;
};

struct AABoxOutcodes {
  template <class Q>
  explicit AABoxOutcodes(const Q& q)
      : from(vector(q.point)),
        to(vector(end_of_motion(q.point, q.velocity, btScalar(0), the<AABox>(q)))),
        min(vector(the<AABox>(q).min)),
        max(vector(the<AABox>(q).max)) {}
  LibraryAnswer ask() const {
    btScalar fraction = 1;
    btVector3 normal(0, 0, 0);
    const bool hit = btRayAabb(from, to, min, max, fraction, normal);
    keep(normal);
    if (hit) keep_contact(from, to, fraction);
    return {hit, fraction};
  }
  btVector3 from, to, min, max;
};

struct AABoxSlabs {
  template <class Q>
  explicit AABoxSlabs(const Q& q)
      : from(vector(the<Ray>(q).origin)),
        direction(vector(the<Ray>(q).direction)),
        bounds{vector(the<AABox>(q).min), vector(the<AABox>(q).max)} {
    for (int i = 0; i < 3; ++i) {
      inverse[i] = direction[i] == 0 ? BT_LARGE_FLOAT : 1 / direction[i];
      sign[i] = inverse[i] < 0;
    }
  }
  LibraryAnswer ask() const {
    btScalar entry = 0;
    const bool hit = btRayAabb2(from, inverse, sign, bounds, entry, 0, BT_LARGE_FLOAT);
    if (hit) keep(btVector3(from + direction * entry));
    return {hit, entry};
  }
  btVector3 from, direction, inverse{0, 0, 0};
  unsigned int sign[3];
  btVector3 bounds[2];
};

template <class Q, class Asked>
void enter_as(const char* query, const char* way) {
  register_contender(query, "bullet", way, std::make_unique<ContenderOf<Asked, Q>>());
}
template <class Q, class B>
void enter_casts(const char* query) {
  enter_as<Q, Subsimplex<B>>(query, "subsimplex");
  enter_as<Q, Continuous<B>>(query, "continuous");
}

/// Registers Bullet's contenders for a query.
template <QueryName query, class Q>
void enter_query(const char* name) {
  constexpr std::string_view is = query.text;
  if constexpr (is == "sphere_sphere_overlap" || is == "sphere_sphere_penetration") {
    enter_as<Q, Algorithm<Sphere, Sphere>>(name, "algorithm");
  } else if constexpr (is == "sphere_box_overlap" || is == "sphere_box_penetration") {
    enter_as<Q, SphereBoxDistance>(name, "distance");
    enter_as<Q, Algorithm<Sphere, Box>>(name, "algorithm");
  } else if constexpr (is == "box_box_overlap" || is == "box_box_penetration") {
    enter_as<Q, BoxBoxDetector>(name, "detector");
  } else if constexpr (is == "sphere_triangle_overlap") {
    enter_as<Q, SphereTriangle>(name, "detector");
  } else if constexpr (is == "aabox_triangle_overlap") {
    enter_as<Q, Gjk<AABox, Triangle>>(name, "gjk");
  } else if constexpr (is == "sphere_plane_penetration") {
    enter_as<Q, Algorithm<Sphere, Plane>>(name, "algorithm");
  } else if constexpr (is == "box_plane_penetration") {
    enter_as<Q, Algorithm<Box, Plane>>(name, "algorithm");
  } else if constexpr (is == "moving_sphere_plane") {
    enter_as<Q, Continuous<Plane>>(name, "continuous");
  } else if constexpr (is == "moving_sphere_sphere") {
    enter_casts<Q, Sphere>(name);
  } else if constexpr (is == "moving_sphere_box") {
    enter_casts<Q, Box>(name);
  } else if constexpr (is == "moving_sphere_capsule") {
    enter_casts<Q, Capsule>(name);
  } else if constexpr (is == "moving_sphere_triangle") {
    enter_casts<Q, Triangle>(name);
  } else if constexpr (is == "moving_point_sphere") {
    enter_as<Q, RaySubsimplex<Sphere>>(name, "subsimplex");
  } else if constexpr (is == "moving_point_box") {
    enter_as<Q, RaySubsimplex<Box>>(name, "subsimplex");
  } else if constexpr (is == "moving_point_capsule") {
    enter_as<Q, RaySubsimplex<Capsule>>(name, "subsimplex");
  } else if constexpr (is == "moving_point_triangle") {
    enter_as<Q, TriangleRay>(name, "triangle-ray");
  } else if constexpr (is == "moving_point_aabox") {
    enter_as<Q, AABoxOutcodes>(name, "outcodes");
  } else if constexpr (is == "ray_aabox") {
    enter_as<Q, AABoxSlabs>(name, "slabs");
  }
}

}  // namespace

void enter_bullet() {
  add_context("Bullet", std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100));
#define NEARMISS_QUERY(query) enter_query<#query, inputs::query<btScalar>>(#query);
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
}

}  // namespace nearmiss::benchmarks
