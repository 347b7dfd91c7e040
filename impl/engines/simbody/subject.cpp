/// Simbody as a plugin, in double: its boxes, spheres and triangles (SimTK::Geo), and rays against its
/// ContactGeometry::Sphere.
#include <SimTKmath.h>

#include <cmath>
#include <cstring>
#include <string>

#include "nearmiss_plugin.h"

namespace {

using SimTK::Geo, SimTK::Transform, SimTK::Vec3;

Vec3 vector(const double* in) { return {in[0], in[1], in[2]}; }
Geo::Sphere sphere(const double* in) { return {vector(in), in[3]}; }
Geo::Triangle triangle(const double* in) { return {vector(in), vector(in + 3), vector(in + 6)}; }
/// Center, half extents, quaternion x y z w.
Geo::OrientedBox box(const double* in) {
  const SimTK::Quaternion turn(SimTK::Vec4(in[9], in[6], in[7], in[8]));  // its constructor divides by the length
  return {Transform(SimTK::Rotation(turn), vector(in)), vector(in + 3)};
}

int said(bool yes, nearmiss_answer* answer) {
  answer->yes = yes, answer->given = 0;
  return NEARMISS_ANSWERED;
}
int point_sphere_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return said(!sphere(in + 3).isPointOutside(vector(in)), answer);
}
int point_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return said(box(in + 3).containsPoint(vector(in)), answer);
}
int sphere_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  const Geo::OrientedBox b = box(in + 4);
  return said(b.getBox().intersectsSphere({~b.getTransform() * vector(in), in[3]}), answer);  // in the frame of the box
}
int box_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  const Geo::OrientedBox a = box(in), b = box(in + 10);
  return said(a.getBox().intersectsOrientedBox({~a.getTransform() * b.getTransform(), b.getHalfLengths()}), answer);
}
int triangle_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return said(triangle(in).overlapsTriangle(triangle(in + 9)), answer);
}
constexpr const char* no_radius = "ContactGeometry::Sphere has a positive radius";
int moving_point_sphere(const double* in, std::size_t, nearmiss_answer* answer) {
  const double speed = std::hypot(in[3], in[4], in[5]);
  if (!(speed > 0)) {
    std::strcpy(answer->why, "a ray has a direction");
    return NEARMISS_CANNOT_ANSWER;
  }
  if (!(in[9] > 0)) {
    std::strcpy(answer->why, no_radius);
    return NEARMISS_CANNOT_ANSWER;
  }
  SimTK::Real distance = 0;
  SimTK::UnitVec3 normal;
  const SimTK::ContactGeometry::Sphere ball(in[9]);
  const bool hits = ball.intersectsRay(vector(in) - vector(in + 6), SimTK::UnitVec3(vector(in + 3)), distance, normal);
  answer->yes = hits, answer->given = 0;
  if (!hits) return NEARMISS_ANSWERED;
  answer->given = 0b1110001;  // the time and the normal
  answer->values[0] = distance / speed;
  for (int i = 0; i < 3; ++i) answer->values[4 + i] = normal[i];
  return NEARMISS_ANSWERED;
}
int point_sphere_signed_distance(const double* in, std::size_t, nearmiss_answer* answer) {
  if (!(in[6] > 0)) {
    std::strcpy(answer->why, no_radius);
    return NEARMISS_CANNOT_ANSWER;
  }
  bool is_inside = false;
  SimTK::UnitVec3 outward;
  const Vec3 center = vector(in + 3);
  const Vec3 nearest =
      center + SimTK::ContactGeometry::Sphere(in[6]).findNearestPoint(vector(in) - center, is_inside, outward);
  answer->yes = 1, answer->given = 0b1110001110;  // the normal and the second point
  for (int i = 0; i < 3; ++i) answer->values[1 + i] = -outward[i], answer->values[7 + i] = nearest[i];
  return NEARMISS_ANSWERED;
}

const nearmiss_offer offers[] = {
    {"moving_point_sphere", 11, 7, nullptr, nullptr, moving_point_sphere, 0},
    {"point_sphere_overlap", 7, 0, nullptr, nullptr, point_sphere_overlap, 0},
    {"point_box_overlap", 13, 0, nullptr, nullptr, point_box_overlap, 0},
    {"sphere_box_overlap", 14, 0, nullptr, nullptr, sphere_box_overlap, 0},
    {"box_box_overlap", 21, 1, nullptr, nullptr, box_box_overlap, 0},
    {"triangle_triangle_overlap", 18, 0, nullptr, nullptr, triangle_triangle_overlap, 0},
    {"point_sphere_signed_distance", 7, 10, nullptr, nullptr, point_sphere_signed_distance, 0},
};
/// The version of the library that is loaded.
const char* version() {
  static const std::string text = [] {
    int major = 0, minor = 0, build = 0;
    SimTK_version_simmath(&major, &minor, &build);
    return "Simbody " + std::to_string(major) + '.' + std::to_string(minor) + '.' + std::to_string(build);
  }();
  return text.c_str();
}

}  // namespace

extern "C" const nearmiss_plugin* nearmiss_plugin_entry(void) {
  static const nearmiss_plugin simbody = {NEARMISS_PLUGIN_VERSION,        SUBJECT, version(), NEARMISS_DOUBLE,
                                          sizeof offers / sizeof *offers, offers};
  return &simbody;
}
