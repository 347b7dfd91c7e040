/// Bullet 3.24 as a contender, in float or double: the calls of its adapter, and those that the adapter has no use for.
/// Bodies and algorithms are made before the timing; the timed part is one call. Each query uses the most direct
/// functions of Bullet, whose boxes have no margin here, as in the adapter:
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
#include "impl/adapters/bullet.hpp"

#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/CollisionDispatch/btSphereBoxCollisionAlgorithm.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>

#include "benchmarks/contender.hpp"
#include "benchmarks/end_of_motion.hpp"

namespace nearmiss::benchmarks {

namespace {

static_assert(std::is_same_v<btScalar, NEARMISS_SCALAR>);
using namespace adapters;
using Sphere = collide::Sphere<double>;
using Box = collide::Box<double>;
using AABox = collide::AABox<double>;
using Triangle = collide::Triangle<double>;

btVector3 vector(const Vec3d& v) { return BulletShapes::vector(v); }

template <class Q>
struct Algorithm {
  explicit Algorithm(const Q& q) : Algorithm(std::get<0>(shapes_of(q)), std::get<1>(shapes_of(q))) {}
  Algorithm(const First<Q>& a, const Second<Q>& b) : algorithm(a, b) {}
  LibraryAnswer ask() const {
    const BulletContact deepest = algorithm.deepest();
    return {deepest.yes(), -deepest.distance};
  }
  BulletAlgorithm<First<Q>, Second<Q>> algorithm;
};

struct SphereBoxDistance {
  template <class Q>
  explicit SphereBoxDistance(const Q& q)
      : a(q.sphere),
        b(q.box),
        center(vector(q.sphere.center)),
        radius(btScalar(q.sphere.radius)),
        algorithm(nullptr, information(), &a.wrapper, &b.wrapper, false) {}
  static btCollisionAlgorithmConstructionInfo information() {
    btCollisionAlgorithmConstructionInfo i;
    i.m_dispatcher1 = &bullet_dispatcher();
    return i;
  }
  LibraryAnswer ask() const {
    btVector3 on_box, normal;
    btScalar depth;
    const bool hit = algorithm.getSphereDistance(&b.wrapper, on_box, normal, depth, center, radius, 0);
    keep(on_box), keep(normal);
    return {hit, depth};
  }
  BulletBody<Sphere> a;
  BulletBody<Box> b;
  btVector3 center;
  btScalar radius;
  mutable btSphereBoxCollisionAlgorithm algorithm;
};

LibraryAnswer closest(btDiscreteCollisionDetectorInterface& detector,
                      const btDiscreteCollisionDetectorInterface::ClosestPointInput& input) {
  btPointCollector deepest;
  detector.getClosestPoints(input, deepest, nullptr);
  return {deepest.m_hasResult && deepest.m_distance <= 0, -deepest.m_distance};
}
template <class A, class B>
btDiscreteCollisionDetectorInterface::ClosestPointInput poses(const BulletBody<A>& a, const BulletBody<B>& b) {
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
  input.m_transformA = a.pose();
  input.m_transformB = b.pose();
  return input;
}

struct BoxBoxDetector {
  template <class Q>
  explicit BoxBoxDetector(const Q& q) : a(q.box1), b(q.box2), detector(&a.geometry, &b.geometry), input(poses(a, b)) {}
  LibraryAnswer ask() const { return closest(detector, input); }

  BulletBody<Box> a, b;
  mutable btBoxBoxDetector detector;
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
};

struct SphereTriangle {
  template <class Q>
  explicit SphereTriangle(const Q& q) : pair(q.sphere, q.triangle) {}
  LibraryAnswer ask() const { return {pair.meet()}; }
  mutable BulletSphereTriangle pair;
};

struct Gjk {
  template <class Q>
  explicit Gjk(const Q& q) : a(boxed(q.box)), b(q.triangle), input(poses(a, b)) {}
  LibraryAnswer ask() const {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    btGjkPairDetector detector(&a.geometry, &b.geometry, &simplex, &epa);
    return closest(detector, input);
  }
  BulletBody<Box> a;
  BulletBody<Triangle> b;
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
};

LibraryAnswer told(const std::optional<BulletHit>& hit) {
  keep(hit);
  return {hit.has_value(), hit ? hit->fraction : 1};
}

/// A sphere that moves from its start to past the shape, or a point, as Bullet's ray tests cast it.
template <class B>
using SphereMotion = BulletMotion<collide::Sphere<double>, B>;
template <class B, std::optional<BulletHit> (SphereMotion<B>::*cast)() const>
struct Motion {
  template <class Q>
  explicit Motion(const Q& q) : Motion(mover(q), q.velocity, target(q)) {}
  Motion(const Sphere& sphere, const Vec3d& velocity, const B& fixed)
      : motion(sphere, end_of_motion(sphere.center, velocity, sphere.radius, fixed) - sphere.center, fixed) {}
  LibraryAnswer ask() const { return told((motion.*cast)()); }

 private:
  template <class Q>
  static Sphere mover(const Q& q) {
    if constexpr (AsksPointMotion<Q>) {
      return {moving_point_of(q), 0};
    } else {
      return std::get<0>(shapes_of(q));
    }
  }
  template <class Q>
  static const B& target(const Q& q) {
    return std::get<std::tuple_size_v<ShapesOf<Q>> - 1>(shapes_of(q));
  }
  SphereMotion<B> motion;
};

void keep_contact(const btVector3& from, const btVector3& to, btScalar fraction) {
  btVector3 contact;
  contact.setInterpolate3(from, to, fraction);
  keep(contact);
}

/// A ray test that tells the fraction of its way.
template <class Ray>
struct RayTest {
  template <class Q>
  explicit RayTest(const Q& q) : RayTest(moving_point_of(q), q.velocity, std::get<0>(shapes_of(q))) {}
  template <class S>
  RayTest(const Vec3d& point, const Vec3d& velocity, const S& shape)
      : ray(point, end_of_motion(point, velocity, 0, shape), shape) {}
  LibraryAnswer ask() const {
    const std::optional<BulletHit> hit = ray.cast();
    if (hit) keep_contact(ray.from, ray.to, hit->fraction);
    return told(hit);
  }
  mutable Ray ray;
};

struct AABoxSlabs {
  template <class Q>
  explicit AABoxSlabs(const Q& q)
      : from(vector(q.ray.origin)),
        direction(vector(q.ray.direction)),
        bounds{vector(q.aabox.min), vector(q.aabox.max)} {
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

/// Registers Bullet's contenders for a query.
template <class Q>
void enter_query(const char* name) {
  const auto enter = [&]<class Asked>(std::type_identity<Asked>, const char* way) {
    register_contender(name, "bullet", way, std::make_unique<ContenderOf<Asked, Q>>());
  };
  if constexpr (AsksOverlap<Q> || AsksDepth<Q>) {
    if constexpr (is_triangle<Second<Q>> && is_aabox<First<Q>>) {
      enter(std::type_identity<Gjk>(), "gjk");
    } else if constexpr (is_sphere<First<Q>> && is_triangle<Second<Q>>) {
      enter(std::type_identity<SphereTriangle>(), "detector");
    } else if constexpr (is_box<First<Q>> && is_box<Second<Q>>) {
      enter(std::type_identity<BoxBoxDetector>(), "detector");
    } else if constexpr (BulletKnows<First<Q>> && BulletKnows<Second<Q>>) {
      if constexpr (is_sphere<First<Q>> && is_box<Second<Q>>)
        enter(std::type_identity<SphereBoxDistance>(), "distance");
      enter(std::type_identity<Algorithm<Q>>(), "algorithm");
    } else if constexpr (requires(const Q& q) { q.ray; }) {
      enter(std::type_identity<AABoxSlabs>(), "slabs");
    }
  } else if constexpr (AsksBallMotion<Q> && BulletKnows<Second<Q>>) {
    using Shot = SphereMotion<Second<Q>>;
    if constexpr (!is_plane<Second<Q>> && !is_halfspace<Second<Q>>)
      enter(std::type_identity<Motion<Second<Q>, &Shot::subsimplex>>(), "subsimplex");
    enter(std::type_identity<Motion<Second<Q>, &Shot::continuous>>(), "continuous");
  } else if constexpr (AsksPointMotion<Q> && is_triangle<First<Q>>) {
    enter(std::type_identity<RayTest<BulletTriangleRay>>(), "triangle-ray");
  } else if constexpr (AsksPointMotion<Q> && is_aabox<First<Q>>) {
    enter(std::type_identity<RayTest<BulletAABoxRay>>(), "outcodes");
  } else if constexpr (AsksPointMotion<Q> && BulletKnows<First<Q>> && !is_plane<First<Q>> && !is_halfspace<First<Q>>) {
    enter(std::type_identity<Motion<First<Q>, &SphereMotion<First<Q>>::subsimplex>>(), "subsimplex");
  }
}

}  // namespace

void enter_bullet() {
  add_context("Bullet", std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100));
#define NEARMISS_QUERY(query) enter_query<inputs::query<double>>(#query);
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
}

}  // namespace nearmiss::benchmarks
