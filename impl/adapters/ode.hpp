/// ODE 0.16 as a subject: the colliders of its primitives, and its rays.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "impl/adapters/motion.hpp"
#include "impl/adapters/operations.hpp"
#include "impl/subject/adapter.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::adapters {

namespace in = inputs;

/// The shapes of `collide` as ODE's geometries.
struct OdeShapes {
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
  static Geometry geometry(const collide::HalfSpace<double>& h) {
    return geometry(collide::Plane<double>{h.normal, h.offset});
  }
};

template <class S>
concept OdeKnows = requires(const S& s) { OdeShapes::geometry(s); };

/// No contract: ODE's manual states no figure for its colliders.
struct Ode : private OdeShapes {
  using Number = double;
  using Impact = collide::Impact<double>;
  static_assert(std::is_same_v<dReal, double>);
  static std::string version() { return "ODE 0.16"; }

  template <class Q>
  static std::string equivalence() {
    if (TellsSignedDistance<Q> && !OfTwoShapes<Q>) return "minus the depth of the point";
    return requires(const Q& q) {
      q.point, q.velocity;
    } ? "a ray that is long enough; time is its length over the speed" : "";
  }
  template <class Q>
  static std::string left_out() {
    const std::string contact = "the contact: ODE's manual does not say which point its position is";
    if constexpr (AsksOverlap<Q> && TellsAxis<Q>) {
      return "the axis, which ODE keeps to itself";
    } else if constexpr (AsksDepth<Q>) {
      return TellsAxis<Q> ? "the axis, which it keeps to itself, and " + contact : contact;
    } else if constexpr (TellsSignedDistance<Q>) {
      return OfTwoShapes<Q> ? "the distance and the normal, which follow from the points"
                            : "the normal and the points, of which it tells none";
    }
    return "";
  }
  template <class Q>
  static std::string why_not() {
    if constexpr (
        asks_of_triangle<Q> || requires(const Q& q) { q.triangle; } || requires(const Q& q) { q.rectangle; }) {
      return "ODE has triangles only as parts of meshes";
    } else if constexpr (requires(const Q& q) { q.sphere, q.velocity; }) {
      return "ODE knows no motions";
    } else if constexpr (requires(const Q& q) { q.box1; }) {
      return "ODE keeps the parts of its test of two boxes to itself";
    } else if constexpr (requires(const Q& q) { q.ray; }) {
      return "ODE's rays have an end, and a box turns their start inside into an exit";
    }
    return "ODE answers how geometries overlap, and how far a point is from one";
  }

  template <AsksOverlap Q>
    requires OdeKnows<First<Q>> && OdeKnows<Second<Q>>
  static auto answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    return decided_alone<Q>(deepest(a, b).has_value());
  }
  /// ODE's normals point into the first geometry. Its contact positions are different points than the query asks for.
  template <AsksDepth Q>
    requires OdeKnows<First<Q>> && OdeKnows<Second<Q>>
  static Partly<typename Q::Answer> answer(const Q& q) {
    const auto& [a, b] = shapes_of(q);
    typename Q::Answer d;
    d.depth = -1;
    const auto contact = deepest(a, b);
    if (!contact) return only(d, {});  // ODE returns no distance
    constexpr int turn = is_plane<Second<Q>> ? 1 : -1;
    d.depth = contact->depth;
    d.normal = {turn * contact->normal[0], turn * contact->normal[1], turn * contact->normal[2]};
    return only(d, {"depth", "normal"});
  }

  static Partly<collide::SignedDistance<double>> answer(const in::point_sphere_signed_distance<double>& q) {
    return out_of(q, dGeomSpherePointDepth);
  }
  static Partly<collide::SignedDistance<double>> answer(const in::point_capsule_signed_distance<double>& q) {
    return out_of(q, dGeomCapsulePointDepth);
  }
  static Partly<collide::SignedDistance<double>> answer(const in::point_halfspace_signed_distance<double>& q) {
    return out_of(q, dGeomPlanePointDepth);
  }
  static auto answer(const in::segment_segment_signed_distance<double>& q) {
    const auto vector = [](const Vec3d& v) { return std::array<dReal, 4>{v.x, v.y, v.z}; };
    const auto a1 = vector(q.a.v0), a2 = vector(q.a.v1), b1 = vector(q.b.v0), b2 = vector(q.b.v1);
    dVector3 on_a, on_b;
    dClosestLineSegmentPoints(a1.data(), a2.data(), b1.data(), b2.data(), on_a, on_b);
    collide::SignedDistance<double> d;
    d.point1 = {on_a[0], on_a[1], on_a[2]}, d.point2 = {on_b[0], on_b[1], on_b[2]};
    return only(d, {"point1", "point2"});
  }

  static Reply<Impact> answer(const in::moving_point_sphere<double>& q) {
    const Geometry sphere = geometry(q.sphere);
    // From inside, ODE's ray returns the exit, with a normal that points inward.
    const bool inside = dGeomSpherePointDepth(sphere.get(), q.point.x, q.point.y, q.point.z) >= 0;
    if (q.solid && inside) return only(Impact{0.0, {}, {}}, {"time"});
    return cast(q.point, q.velocity, sphere, time_to_pass(q.point, 0, q.velocity, q.sphere), !inside);
  }
  static Reply<Impact> answer(const in::moving_point_box<double>& q) {
    return cast_at_solid(q.point, q.velocity, q.box, dGeomBoxPointDepth);
  }
  static Reply<Impact> answer(const in::moving_point_capsule<double>& q) {
    return cast_at_solid(q.point, q.velocity, q.capsule, dGeomCapsulePointDepth);
  }
  static Reply<Impact> answer(const in::moving_point_plane<double>& q) {
    if (!(dot(q.plane.normal, q.velocity) < 0)) return Impact::miss();  // ODE's planes have two sides
    const Geometry plane = geometry(q.plane);
    if (dGeomPlanePointDepth(plane.get(), q.point.x, q.point.y, q.point.z) > 0) return Impact::miss();
    // Twice as long: a point may pass the plane exactly at the end of the ray, which rounding then puts before it.
    return cast(q.point, q.velocity, plane, 2 * time_to_pass(q.point, 0, q.velocity, q.plane));
  }

 private:
  /// How far the point is out of the shape.
  template <class Q>
  static Partly<collide::SignedDistance<double>> out_of(const Q& q, dReal (*depth)(dGeomID, dReal, dReal, dReal)) {
    collide::SignedDistance<double> d;
    d.distance = -depth(geometry(q.b).get(), q.a.x, q.a.y, q.a.z);
    return only(d, {"distance"});
  }
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

  template <class A, class B>
  static std::optional<dContactGeom> deepest(const A& first, const B& second) {
    const Geometry a = geometry(first), b = geometry(second);
    std::array<dContactGeom, 8> contacts;
    const int count = dCollide(a.get(), b.get(), int(contacts.size()), contacts.data(), sizeof(dContactGeom));
    if (count == 0) return std::nullopt;
    return *std::max_element(contacts.begin(), contacts.begin() + count,
                             [](const dContactGeom& x, const dContactGeom& y) { return x.depth < y.depth; });
  }
  template <class S>
  static Reply<Impact> cast_at_solid(const Vec3d& from, const Vec3d& velocity, const S& solid,
                                     dReal depth_of(dGeomID, dReal, dReal, dReal)) {
    const Geometry to = geometry(solid);
    const double depth = depth_of(to.get(), from.x, from.y, from.z);
    if (std::abs(depth) <= rounding_of_depth(from, solid)) return CannotAnswer{on_surface};
    if (depth > 0) return Impact::miss();
    return cast(from, velocity, to, time_to_pass(from, 0, velocity, ball_around(solid)));
  }
  /// The time of the ray to the geometry's surface.
  static Reply<Impact> cast(const Vec3d& from, const Vec3d& velocity, const Geometry& to, double horizon,
                            bool normal_is_outward = true) {
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
