/// FCL 0.7 as a contender, in double. Shapes and poses are made before the timing; the timed part is one call of its
/// API with its default solvers.
///
/// A plane becomes FCL's half-space, the solid behind it; for motions it becomes FCL's plane. Motions run in both of
/// FCL's ways: "naive", the default, samples ten positions and may miss contacts between them; "advancement" cannot.
#include <fcl/config.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "benchmarks/contender.hpp"
#include "benchmarks/shapes_of.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::benchmarks {

namespace {

using Vec3 = collide::Vec3<double>;
using Sphere = collide::Sphere<double>;
using Box = collide::Box<double>;
using AABox = collide::AABox<double>;
using Capsule = collide::Capsule<double>;
using Plane = collide::Plane<double>;
using Triangle = collide::Triangle<double>;

fcl::Vector3d vector(const Vec3& v) { return {v.x, v.y, v.z}; }
fcl::Transform3d at(const Vec3& p) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.translation() = vector(p);
  return t;
}

fcl::Sphered shape(const Sphere& s) { return fcl::Sphered(s.radius); }
fcl::Transform3d pose(const Sphere& s) { return at(s.center); }
fcl::Boxd shape(const Box& b) { return {2 * b.half.x, 2 * b.half.y, 2 * b.half.z}; }
fcl::Transform3d pose(const Box& b) {
  fcl::Transform3d t = at(b.center);
  const auto& q = b.orientation;
  t.linear() = fcl::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  return t;
}
fcl::Boxd shape(const AABox& b) { return {b.max.x - b.min.x, b.max.y - b.min.y, b.max.z - b.min.z}; }
fcl::Transform3d pose(const AABox& b) { return at((b.min + b.max) * 0.5); }
fcl::Capsuled shape(const Capsule& c) { return {c.radius, norm(c.p1 - c.p0)}; }
fcl::Transform3d pose(const Capsule& c) {
  fcl::Transform3d t = at((c.p0 + c.p1) * 0.5);
  t.linear() = fcl::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), vector(c.p1 - c.p0)).toRotationMatrix();
  return t;
}
fcl::Halfspaced shape(const Plane& p) {
  const double length = norm(p.normal);
  return {vector(p.normal / length), -p.offset / length};
}
fcl::Transform3d pose(const Plane&) { return fcl::Transform3d::Identity(); }
/// A plane without the solid behind it.
struct Surface {
  Plane plane;
};
fcl::Planed shape(const Surface& s) {
  const double length = norm(s.plane.normal);
  return {vector(s.plane.normal / length), -s.plane.offset / length};
}
fcl::Transform3d pose(const Surface&) { return fcl::Transform3d::Identity(); }

/// The shapes of a query, the first and second of their types.
template <class A, class B>
struct Pair {
  template <class Q>
  explicit Pair(const Q& q) : Pair(the<A>(q), the_other<A, B>(q)) {}
  Pair(const A& first, const B& second)
      : a(shape(first)), b(shape(second)), pose_a(pose(first)), pose_b(pose(second)) {}

  decltype(shape(A{})) a;
  decltype(shape(B{})) b;
  fcl::Transform3d pose_a, pose_b;
};

template <class A, class B>
struct Overlap : Pair<A, B> {
  using Pair<A, B>::Pair;
  LibraryAnswer ask() const {
    const fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd result;
    return {fcl::collide(&this->a, this->pose_a, &this->b, this->pose_b, request, result) > 0};
  }
};

template <class A, class B>
struct Penetration : Pair<A, B> {
  using Pair<A, B>::Pair;
  LibraryAnswer ask() const {
    const fcl::CollisionRequestd request(1, true);
    fcl::CollisionResultd result;
    const bool hit = fcl::collide(&this->a, this->pose_a, &this->b, this->pose_b, request, result) > 0;
    return {hit, hit ? result.getContact(0).penetration_depth : -1.0};
  }
};

/// FCL's own test of a shape against a triangle that is part of no mesh.
template <class A>
struct TriangleOverlap {
  template <class Q>
  explicit TriangleOverlap(const Q& q)
      : a(shape(the<A>(q))),
        pose_a(pose(the<A>(q))),
        v0(vector(the<Triangle>(q).v0)),
        v1(vector(the<Triangle>(q).v1)),
        v2(vector(the<Triangle>(q).v2)) {}
  LibraryAnswer ask() const { return {solver.shapeTriangleIntersect(a, pose_a, v0, v1, v2)}; }

  decltype(shape(A{})) a;
  fcl::Transform3d pose_a;
  fcl::Vector3d v0, v1, v2;
  fcl::detail::GJKSolver_libccd<double> solver;
};

/// The targets of a motion.
template <class B>
using Target = std::conditional_t<std::is_same_v<B, Plane>, Surface, B>;

template <class B, bool advancement>
struct Motion : Pair<Sphere, Target<B>> {
  template <class Q>
  explicit Motion(const Q& q) : Motion(the<Sphere>(q), q.velocity, the_other<Sphere, B>(q)) {}
  Motion(const Sphere& sphere, const Vec3& velocity, const B& target)
      : Pair<Sphere, Target<B>>(sphere, Target<B>{target}),
        end(at(end_of_motion(sphere.center, velocity, sphere.radius, target))) {}
  LibraryAnswer ask() const {
    fcl::ContinuousCollisionRequestd request;
    if (advancement) {
      request.gjk_solver_type = fcl::GST_INDEP;
      request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    }
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(&this->a, this->pose_a, end, &this->b, this->pose_b, this->pose_b, request, result);
    return {result.is_collide, result.time_of_contact};
  }
  fcl::Transform3d end;
};

template <class Q, class Asked>
void enter_as(const char* query, const char* way) {
  register_contender(query, "fcl", way, std::make_unique<ContenderOf<Asked, Q>>());
}

/// Registers FCL's contenders for a query.
template <QueryName query, class Q>
void enter_query(const char* name) {
  constexpr std::string_view is = query.text;
  if constexpr (is == "sphere_sphere_overlap") {
    enter_as<Q, Overlap<Sphere, Sphere>>(name, "collide");
  } else if constexpr (is == "sphere_box_overlap") {
    enter_as<Q, Overlap<Sphere, Box>>(name, "collide");
  } else if constexpr (is == "box_box_overlap") {
    enter_as<Q, Overlap<Box, Box>>(name, "collide");
  } else if constexpr (is == "sphere_triangle_overlap") {
    enter_as<Q, TriangleOverlap<Sphere>>(name, "shapeTriangleIntersect");
  } else if constexpr (is == "aabox_triangle_overlap") {
    enter_as<Q, TriangleOverlap<AABox>>(name, "shapeTriangleIntersect");
  } else if constexpr (is == "sphere_sphere_penetration") {
    enter_as<Q, Penetration<Sphere, Sphere>>(name, "collide");
  } else if constexpr (is == "sphere_plane_penetration") {
    enter_as<Q, Penetration<Sphere, Plane>>(name, "collide");
  } else if constexpr (is == "box_plane_penetration") {
    enter_as<Q, Penetration<Box, Plane>>(name, "collide");
  } else if constexpr (is == "sphere_box_penetration") {
    enter_as<Q, Penetration<Sphere, Box>>(name, "collide");
  } else if constexpr (is == "box_box_penetration") {
    enter_as<Q, Penetration<Box, Box>>(name, "collide");
  } else if constexpr (is == "moving_sphere_plane") {
    enter_as<Q, Motion<Plane, false>>(name, "naive");
  } else if constexpr (is == "moving_sphere_sphere") {
    enter_as<Q, Motion<Sphere, false>>(name, "naive");
    enter_as<Q, Motion<Sphere, true>>(name, "advancement");
  } else if constexpr (is == "moving_sphere_box") {
    enter_as<Q, Motion<Box, false>>(name, "naive");
    enter_as<Q, Motion<Box, true>>(name, "advancement");
  } else if constexpr (is == "moving_sphere_capsule") {
    enter_as<Q, Motion<Capsule, false>>(name, "naive");
    enter_as<Q, Motion<Capsule, true>>(name, "advancement");
  }
}

}  // namespace

void enter_fcl() {
  add_context("FCL", FCL_VERSION);
#define NEARMISS_QUERY(query) enter_query<#query, inputs::query<double>>(#query);
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
}

}  // namespace nearmiss::benchmarks
