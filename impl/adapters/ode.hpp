/// ODE 0.16 as a subject: the colliders of its primitives, and its rays.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "impl/adapters/motion.hpp"
#include "impl/subject/adapter.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::adapters {

namespace in = inputs;

/// No contract: ODE's manual states no figure for its colliders.
struct Ode {
  using Number = double;
  static_assert(std::is_same_v<dReal, double>);
  static std::string version() { return "ODE 0.16"; }

  template <class Q>
  static std::string equivalence() {
    return requires(const Q& q) {
      q.point, q.velocity;
    } ? "a ray that is long enough; time is its length over the speed" : "";
  }
  template <class Q>
  static std::string left_out() {
    if constexpr (std::is_same_v<Q, in::box_box_overlap<double>>) {
      return "the axis, which ODE keeps to itself";
    } else if constexpr (std::is_same_v<Q, in::box_box_penetration<double>>) {
      return "the axis, which it keeps to itself, and the contact: ODE's manual does not say which point its position "
             "is";
    } else if constexpr (std::is_same_v<Q, in::sphere_sphere_penetration<double>> ||
                         std::is_same_v<Q, in::sphere_box_penetration<double>> ||
                         std::is_same_v<Q, in::sphere_plane_penetration<double>> ||
                         std::is_same_v<Q, in::box_plane_penetration<double>>) {
      return "the contact: ODE's manual does not say which point its position is";
    }
    return "";
  }
  template <class Q>
  static std::string why_not() {
    if constexpr (
        requires(const Q& q) { q.triangle; } || requires(const Q& q) { q.rectangle; }) {
      return "ODE has triangles only as parts of meshes";
    } else if constexpr (requires(const Q& q) { q.sphere, q.velocity; }) {
      return "ODE knows no motions";
    } else if constexpr (requires(const Q& q) { q.box1; }) {
      return "ODE keeps the parts of its test of two boxes to itself";
    } else if constexpr (requires(const Q& q) { q.ray; }) {
      return "ODE's rays have an end, and a box turns their start inside into an exit";
    }
    return "ODE answers how geometries overlap";
  }

  static auto answer(const in::sphere_sphere_overlap<double>& q) { return decided(q.sphere1, q.sphere2); }
  static auto answer(const in::sphere_box_overlap<double>& q) { return decided(q.sphere, q.box); }
  static auto answer(const in::box_box_overlap<double>& q) {
    return only(collide::BoxOverlap<double>{deepest(q.box1, q.box2).has_value(), -1}, {});
  }

  static auto answer(const in::sphere_sphere_penetration<double>& q) {
    return depth<collide::Penetration<double>, -1>(q.sphere1, q.sphere2);
  }
  static auto answer(const in::sphere_box_penetration<double>& q) {
    return depth<collide::Penetration<double>, -1>(q.sphere, q.box);
  }
  static auto answer(const in::box_box_penetration<double>& q) {
    return depth<collide::BoxPenetration<double>, -1>(q.box1, q.box2);
  }
  static auto answer(
      const in::sphere_plane_penetration<double>& q) {  // the normal points into the first operand, like the plane's
    return depth<collide::Penetration<double>, 1>(q.sphere, q.plane);
  }
  static auto answer(const in::box_plane_penetration<double>& q) {
    return depth<collide::CornerContacts<double>, 1>(q.box, q.plane);
  }

  static auto answer(const in::moving_point_sphere<double>& q) -> Reply<collide::Impact<double>> {
    const Geometry sphere = geometry(q.sphere);
    if (q.solid && dGeomSpherePointDepth(sphere.get(), q.point.x, q.point.y, q.point.z) >= 0) {
      return only(collide::Impact<double>{0.0, {}, {}}, {"time"});  // ODE's ray would return the exit
    }
    // From inside, ODE's ray returns the exit, with a normal that points inward.
    const bool inside = dGeomSpherePointDepth(sphere.get(), q.point.x, q.point.y, q.point.z) >= 0;
    return cast(q.point, q.velocity, sphere, time_to_pass(q.point, 0, q.velocity, q.sphere), !inside);
  }
  static auto answer(const in::moving_point_box<double>& q) -> Reply<collide::Impact<double>> {
    const Geometry box = geometry(q.box);
    const double depth = dGeomBoxPointDepth(box.get(), q.point.x, q.point.y, q.point.z);
    if (std::abs(depth) <= rounding_of_depth(q.point, q.box)) return CannotAnswer{on_surface};
    if (depth > 0) return collide::Impact<double>::miss();
    return cast(q.point, q.velocity, box, time_to_pass(q.point, 0, q.velocity, ball_around(q.box)));
  }
  static auto answer(const in::moving_point_capsule<double>& q) -> Reply<collide::Impact<double>> {
    const Geometry capsule = geometry(q.capsule);
    const double depth = dGeomCapsulePointDepth(capsule.get(), q.point.x, q.point.y, q.point.z);
    if (std::abs(depth) <= rounding_of_depth(q.point, q.capsule)) return CannotAnswer{on_surface};
    if (depth > 0) return collide::Impact<double>::miss();
    return cast(q.point, q.velocity, capsule, time_to_pass(q.point, 0, q.velocity, ball_around(q.capsule)));
  }
  static auto answer(const in::moving_point_plane<double>& q) -> Reply<collide::Impact<double>> {
    if (!(dot(q.plane.normal, q.velocity) < 0)) return collide::Impact<double>::miss();  // ODE's planes have two sides
    const Geometry plane = geometry(q.plane);
    if (dGeomPlanePointDepth(plane.get(), q.point.x, q.point.y, q.point.z) > 0) return collide::Impact<double>::miss();
    // Twice as long: a point may pass the plane exactly at the end of the ray, which rounding then puts before it.
    return cast(q.point, q.velocity, plane, 2 * time_to_pass(q.point, 0, q.velocity, q.plane));
  }

 private:
  static double largest_of(double so_far, const Vec3d& v) {
    return std::max({so_far, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  }
  /// At most so far is dGeomBoxPointDepth() from the exact depth. In each direction, 3 terms up to twice the largest
  /// number are added to a half extent, each with at most 24 roundings: of the unit quaternion, the entry of its
  /// matrix, the difference to the center, the product and the sum.
  static double rounding_of_depth(const Vec3d& p, const collide::Box<double>& b) {
    constexpr double roundings = 2 * 4 * 24 * 0x1p-53;
    return roundings * largest_of(largest_of(largest_of(0, b.half), b.center), p);
  }
  /// At most so far is dGeomCapsulePointDepth() from the exact depth. The center, the axis and the length of the
  /// capsule are rounded too. In each direction, at most 16 terms up to twice the largest number are added, each with
  /// at most 8 roundings: of the center, the length, the axis (by a rotation), the place along it, and the distance.
  static double rounding_of_depth(const Vec3d& p, const collide::Capsule<double>& c) {
    constexpr double roundings = 2 * 16 * 8 * 0x1p-53;
    return roundings * largest_of(largest_of(largest_of(c.radius, c.p0), c.p1), p);
  }
  static constexpr const char* on_surface =
      "ODE's rays do not tell entering from leaving where they start on a surface";

  struct Destroy {
    void operator()(dGeomID g) const { dGeomDestroy(g); }
  };
  using Geometry = std::unique_ptr<std::remove_pointer_t<dGeomID>, Destroy>;

  static Geometry made(dGeomID g) { return Geometry(g); }
  struct Library {
    Library() { dInitODE2(0); }
    ~Library() { dCloseODE(); }
  };
  static void start() { static const Library started; }
  static Geometry geometry(const collide::Sphere<double>& s) {
    start();
    Geometry g = made(dCreateSphere(nullptr, s.radius));
    dGeomSetPosition(g.get(), s.center.x, s.center.y, s.center.z);
    return g;
  }
  static Geometry geometry(const collide::Box<double>& b) {
    start();
    Geometry g = made(dCreateBox(nullptr, 2 * b.half.x, 2 * b.half.y, 2 * b.half.z));
    dGeomSetPosition(g.get(), b.center.x, b.center.y, b.center.z);
    const collide::Quaternion<double> q = unit(b.orientation);
    const dQuaternion turn{q.w, q.x, q.y, q.z};
    dGeomSetQuaternion(g.get(), turn);
    return g;
  }
  static Geometry geometry(const collide::Capsule<double>& c) {
    start();
    const Vec3d along = c.p1 - c.p0, middle = c.p0 * 0.5 + c.p1 * 0.5;
    const double l = length(along);
    Geometry g = made(dCreateCapsule(nullptr, c.radius, l));
    dGeomSetPosition(g.get(), middle.x, middle.y, middle.z);
    if (l > 0) {
      dMatrix3 turn;
      dRFromZAxis(turn, along.x / l, along.y / l, along.z / l);
      dGeomSetRotation(g.get(), turn);
    }
    return g;
  }
  static Geometry geometry(const collide::Plane<double>& p) {  // ODE normalizes the normal
    start();
    return made(dCreatePlane(nullptr, p.normal.x, p.normal.y, p.normal.z, -p.offset));
  }

  template <class A, class B>
  static std::optional<dContactGeom> deepest(const A& first, const B& second) {
    const Geometry a = geometry(first), b = geometry(second);
    std::array<dContactGeom, 8> contacts;
    const int count = dCollide(a.get(), b.get(), int(contacts.size()), contacts.data(), sizeof(dContactGeom));
    if (count == 0) return std::nullopt;
    return *std::max_element(contacts.begin(), contacts.begin() + count,
                             [](const dContactGeom& x, const dContactGeom& y) { return x.depth < y.depth; });
  }
  template <class A, class B>
  static collide::Decision<double> decided(const A& a, const B& b) {
    return {deepest(a, b).has_value()};
  }
  /// ODE's normals point into the first geometry. Its contact positions are different points than the query asks for.
  template <class Depth, int turn, class A, class B>
  static Partly<Depth> depth(const A& a, const B& b) {
    Depth d;
    d.depth = -1;
    const auto contact = deepest(a, b);
    if (!contact) return only(d, {});  // ODE returns no distance
    d.depth = contact->depth;
    d.normal = {turn * contact->normal[0], turn * contact->normal[1], turn * contact->normal[2]};
    return only(d, {"depth", "normal"});
  }
  /// The time of the ray to the geometry's surface.
  static Reply<collide::Impact<double>> cast(const Vec3d& from, const Vec3d& velocity, const Geometry& to,
                                             double horizon, bool normal_is_outward = true) {
    using Impact = collide::Impact<double>;
    const double speed = length(velocity);
    if (!(speed > 0)) return CannotAnswer{"a ray has a direction, and nothing moves here"};
    if (horizon == 0) horizon = 1 / speed;  // starts past the geometry: any length is right
    const double reach = horizon * speed;
    if (!std::isfinite(reach)) return CannotAnswer{"the ray's length is not finite"};
    start();
    const Geometry ray = made(dCreateRay(nullptr, reach));
    dGeomRaySet(ray.get(), from.x, from.y, from.z, velocity.x / speed, velocity.y / speed, velocity.z / speed);
    dContactGeom contact;
    if (dCollide(ray.get(), to.get(), 1, &contact, sizeof contact) == 0) return only(Impact::miss(), {"time"});
    if (!normal_is_outward) return only(Impact{contact.depth / speed, {}, {}}, {"time"});
    return only(Impact{contact.depth / speed,
                       {contact.pos[0], contact.pos[1], contact.pos[2]},
                       {contact.normal[0], contact.normal[1], contact.normal[2]}},
                {"time", "location", "normal"});
  }
};

}  // namespace nearmiss::adapters
