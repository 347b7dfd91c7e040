/// FCL 0.7 as a contender, in double: the calls of its adapter, with its default solvers. Bodies are made before the
/// timing.
///
/// A plane becomes FCL's half-space, the solid behind it; for motions it becomes FCL's plane. Motions run in both of
/// FCL's ways: "naive", the default, samples ten positions and may miss contacts between them; "advancement" cannot.
#include "impl/adapters/fcl.hpp"

#include <fcl/config.h>

#include "benchmarks/contender.hpp"
#include "benchmarks/end_of_motion.hpp"

namespace nearmiss::benchmarks {

namespace {

/// A plane without the solid behind it.
struct Surface {
  collide::Plane<double> plane;
};

}  // namespace
}  // namespace nearmiss::benchmarks

namespace nearmiss::adapters {

template <>
struct FclBody<benchmarks::Surface> {
  explicit FclBody(const benchmarks::Surface& s)
      : geometry(FclShapes::vector(s.plane.normal), -s.plane.offset), pose(fcl::Transform3d::Identity()) {}
  fcl::Planed geometry;
  fcl::Transform3d pose;
};

}  // namespace nearmiss::adapters

namespace nearmiss::benchmarks {

namespace {

using namespace adapters;

template <class Q, bool with_depth>
struct Collision {
  explicit Collision(const Q& q) : pair(std::make_from_tuple<FclPair<First<Q>, Second<Q>>>(shapes_of(q))) {}
  LibraryAnswer ask() const {
    const fcl::CollisionRequestd request(1, with_depth);
    fcl::CollisionResultd result;
    const bool hit = pair.meet(request, result);
    return {hit, with_depth ? (hit ? result.getContact(0).penetration_depth : -1.0) : 0.0};
  }
  FclPair<First<Q>, Second<Q>> pair;
};

template <class S>
auto solid(const S& shape) {
  if constexpr (is_aabox<S>) {
    return boxed(shape);
  } else {
    return shape;
  }
}

/// FCL's own test of a shape against a triangle that is part of no mesh.
template <class Q, bool triangle_first>
struct TriangleOverlap {
  using Other = std::conditional_t<triangle_first, Second<Q>, First<Q>>;
  explicit TriangleOverlap(const Q& q)
      : TriangleOverlap(std::get < triangle_first ? 1 : 0 > (shapes_of(q)),
                        std::get < triangle_first ? 0 : 1 > (shapes_of(q))) {}
  TriangleOverlap(const Other& other, const collide::Triangle<double>& t)
      : body(solid(other)), corners{FclShapes::vector(t.v0), FclShapes::vector(t.v1), FclShapes::vector(t.v2)} {}
  LibraryAnswer ask() const { return {meets_triangle(solver, body, corners)}; }

  FclBody<decltype(solid(Other{}))> body;
  fcl::Vector3d corners[3];
  fcl::detail::GJKSolver_libccd<double> solver;
};

template <class Q, bool advancement>
struct Motion {
  using Target = std::conditional_t<is_plane<Second<Q>>, Surface, Second<Q>>;
  explicit Motion(const Q& q) : Motion(std::get<0>(shapes_of(q)), q.velocity, std::get<1>(shapes_of(q))) {}
  Motion(const collide::Sphere<double>& sphere, const Vec3d& velocity, const Second<Q>& target)
      : pair(sphere, Target{target}),
        end(FclShapes::at(end_of_motion(sphere.center, velocity, sphere.radius, target))) {}
  LibraryAnswer ask() const {
    fcl::ContinuousCollisionRequestd request;
    if (advancement) {
      request.gjk_solver_type = fcl::GST_INDEP;
      request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    }
    const fcl::ContinuousCollisionResultd result = pair.move(end, request);
    return {result.is_collide, result.time_of_contact};
  }
  FclPair<collide::Sphere<double>, Target> pair;
  fcl::Transform3d end;
};

/// Registers FCL's contenders for a query.
template <class Q>
void enter_query(const char* name) {
  const auto enter = [&]<class Asked>(std::type_identity<Asked>, const char* way) {
    register_contender(name, "fcl", way, std::make_unique<ContenderOf<Asked, Q>>());
  };
  constexpr bool knows_first = FclKnows<First<Q>> || is_aabox<First<Q>>;
  if constexpr (AsksOverlap<Q> && knows_first && is_triangle<Second<Q>>) {
    enter(std::type_identity<TriangleOverlap<Q, false>>(), "shapeTriangleIntersect");
  } else if constexpr (AsksOverlap<Q> && is_triangle<First<Q>> && FclKnows<Second<Q>>) {
    enter(std::type_identity<TriangleOverlap<Q, true>>(), "shapeTriangleIntersect");
  } else if constexpr ((AsksOverlap<Q> || AsksDepth<Q>)&&FclKnowsBoth<Q>) {
    enter(std::type_identity<Collision<Q, AsksDepth<Q>>>(), "collide");
  } else if constexpr (AsksBallMotion<Q> && FclKnows<Second<Q>>) {
    enter(std::type_identity<Motion<Q, false>>(), "naive");
    if constexpr (!is_plane<Second<Q>> && !is_halfspace<Second<Q>>)
      enter(std::type_identity<Motion<Q, true>>(), "advancement");
  }
}

}  // namespace

void enter_fcl() {
  add_context("FCL", FCL_VERSION);
#define NEARMISS_QUERY(query) enter_query<inputs::query<double>>(#query);
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
}

}  // namespace nearmiss::benchmarks
