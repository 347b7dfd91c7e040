/// FCL 0.7 as a subject: static collision, penetration, and continuous collision for the moving sphere.
#pragma once

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <cmath>
#include <type_traits>

#include <collide/box_box_overlap.hpp>
#include <collide/moving_sphere_box.hpp>
#include <collide/sphere_box_penetration.hpp>

#include "impl/subject/adapter.hpp"

namespace nearmiss::adapters {

/// One way to use FCL: a solver for static questions, a solver for motions.
template <fcl::GJKSolverType static_solver, fcl::CCDSolverType motion_solver>
struct Fcl {
  using Number = double;
  static constexpr bool referee = true;
  static std::string version() { return "FCL 0.7"; }

  /// FCL's own figures, relative to the scene: CollisionRequest::gjk_tolerance is 1e-6, and
  /// ContinuousCollisionRequest::toc_err is 1e-4. In units of 2^-53, up to the next power of two.
  static constexpr double gjk_tolerance = 0x1p34;
  static constexpr double time_of_contact_error = 0x1p40;

  template <class Q>
  static collide::Contract contract() {
    constexpr bool motion = std::is_same_v<Q, collide::inputs::moving_sphere_box<double>>;
    return {.backward = motion ? time_of_contact_error : gjk_tolerance, .lowest = -300, .highest = 300};
  }
  template <class Q>
  static std::string equivalence() {
    if (!std::is_same_v<Q, collide::inputs::moving_sphere_box<double>>) return "";
    return "continuousCollide over [0, T], T the power of two that carries the sphere past the box";
  }
  template <class Q>
  static std::string why_not() {
    return "FCL has no such operation for these shapes";
  }

  static auto answer(const collide::inputs::box_box_overlap<double>& q) {
    const fcl::Boxd a = box(q.box1), b = box(q.box2);  // FCL does not tell which axis separates them
    return only(collide::BoxOverlap<double>{meet(&a, pose(q.box1), &b, pose(q.box2), nullptr), -1}, {});
  }

  static auto answer(const collide::inputs::sphere_box_penetration<double>& q)
      -> Reply<collide::Penetration<double>> {
    const fcl::Sphered a(q.sphere.radius);
    const fcl::Boxd b = box(q.box);
    fcl::CollisionResultd result;
    if (!meet(&a, at(q.sphere.center), &b, pose(q.box), &result)) {
      return only(collide::Penetration<double>{-1.0, {}, {}}, {});  // apart: FCL says no more than that
    }
    const fcl::Contactd& c = result.getContact(0);
    // FCL's contact position lies half way into the overlap: another point than the one asked for.
    return only(collide::Penetration<double>{c.penetration_depth, {c.normal.x(), c.normal.y(), c.normal.z()}, {}},
                {"depth", "normal"});
  }

  static auto answer(const collide::inputs::moving_sphere_box<double>& q) -> Reply<collide::Impact<double>> {
    using Impact = collide::Impact<double>;
    const fcl::Sphered a(q.sphere.radius);
    const fcl::Boxd b = box(q.box);
    const double horizon = time_to_pass(q);
    if (horizon == 0) {
      return only(meet(&a, at(q.sphere.center), &b, pose(q.box), nullptr) ? Impact{0.0, {}, {}} : Impact::miss(),
                  {"time"});
    }
    const collide::Vec3<double> end = q.sphere.center + q.velocity * horizon;
    if (!std::isfinite(end.x + end.y + end.z)) return CannotAnswer{"the end of the motion is not finite"};
    fcl::ContinuousCollisionRequestd request;
    request.gjk_solver_type = static_solver;
    request.ccd_solver_type = motion_solver;
    fcl::ContinuousCollisionResultd result;
    const fcl::Transform3d still = pose(q.box);
    fcl::continuousCollide(&a, at(q.sphere.center), at(end), &b, still, still, request, result);
    return only(result.is_collide ? Impact{result.time_of_contact * horizon, {}, {}} : Impact::miss(), {"time"});
  }

 private:
  static fcl::Boxd box(const collide::Box<double>& b) { return {2 * b.half.x, 2 * b.half.y, 2 * b.half.z}; }
  static fcl::Transform3d at(const collide::Vec3<double>& p) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    t.translation() << p.x, p.y, p.z;
    return t;
  }
  static fcl::Transform3d pose(const collide::Box<double>& b) {
    fcl::Transform3d t = at(b.center);
    const auto& q = b.orientation;
    t.linear() = fcl::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
    return t;
  }
  /// With `result`, one contact is asked for as well.
  static bool meet(const fcl::CollisionGeometryd* a, const fcl::Transform3d& ta, const fcl::CollisionGeometryd* b,
                   const fcl::Transform3d& tb, fcl::CollisionResultd* result) {
    fcl::CollisionRequestd request(1, result != nullptr);
    request.gjk_solver_type = static_solver;
    fcl::CollisionResultd decision_only;
    return fcl::collide(a, ta, b, tb, request, result != nullptr ? *result : decision_only) > 0;
  }
  /// The least power of two that carries the sphere past the box's bounding sphere; 0 where the sphere
  /// does not move or starts past it.
  static double time_to_pass(const collide::inputs::moving_sphere_box<double>& q) {
    const auto length = [](const collide::Vec3<double>& v) { return std::hypot(v.x, v.y, v.z); };
    const double speed = length(q.velocity);
    if (!(speed > 0)) return 0;
    const collide::Vec3<double> from_box = q.sphere.center - q.box.center, along = q.velocity / speed;
    const double passed = from_box.x * along.x + from_box.y * along.y + from_box.z * along.z;
    const double time = (length(q.box.half) + q.sphere.radius - passed) / speed;
    return time > 0 ? std::exp2(std::ceil(std::log2(time))) : 0.0;
  }
};

using FclDefault = Fcl<fcl::GST_LIBCCD, fcl::CCDC_NAIVE>;
using FclIndep = Fcl<fcl::GST_INDEP, fcl::CCDC_NAIVE>;
using FclConservativeAdvancement = Fcl<fcl::GST_INDEP, fcl::CCDC_CONSERVATIVE_ADVANCEMENT>;

}  // namespace nearmiss::adapters
