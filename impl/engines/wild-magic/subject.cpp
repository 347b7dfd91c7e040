/// Wild Magic 5 as a plugin, in double: rays, moving spheres and lines by the Find() of its classes of intersection and
/// distance, overlaps by their Test() and by its functions of containment.
#include <Wm5Mathematics.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "nearmiss_plugin.h"

namespace {

using Vector = Wm5::Vector3<double>;

constexpr uint64_t time_alone = 1, time_and_place = 15;

Vector vector(const double* p) { return {p[0], p[1], p[2]}; }
Wm5::Sphere3<double> sphere(const double* p) { return {vector(p), p[3]}; }
/// Center, half extents, quaternion x y z w.
Wm5::Box3<double> box(const double* p) {
  const double n = std::sqrt(p[6] * p[6] + p[7] * p[7] + p[8] * p[8] + p[9] * p[9]);
  const double x = p[6] / n, y = p[7] / n, z = p[8] / n, w = p[9] / n;
  return {vector(p),
          {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)},
          p[3],
          p[4],
          p[5]};
}

Wm5::Segment3<double> segment(const double* p) { return {vector(p), vector(p + 3)}; }
Wm5::Capsule3<double> capsule(const double* p) { return {segment(p), p[6]}; }
Wm5::Triangle3<double> triangle(const double* p) { return {vector(p), vector(p + 3), vector(p + 6)}; }

int cannot(nearmiss_answer* answer, const char* why) {
  std::strcpy(answer->why, why);
  return NEARMISS_CANNOT_ANSWER;
}
int miss(nearmiss_answer* answer) {
  answer->yes = 0;
  return NEARMISS_ANSWERED;
}
int hit(nearmiss_answer* answer, double time, const Vector* place) {
  answer->yes = 1;
  answer->given = place ? time_and_place : time_alone;
  answer->values[0] = time;
  for (int i = 0; place && i < 3; ++i) answer->values[1 + i] = (*place)[i];
  return NEARMISS_ANSWERED;
}
/// The first point of a class of intersection of a ray with a shape.
template <class Intersection, class Shape>
int ray(const double* in, const Shape& shape, nearmiss_answer* answer) {
  const double speed = std::hypot(in[3], in[4], in[5]);
  if (!(speed > 0)) return cannot(answer, "a ray has a direction");
  const Wm5::Ray3<double> r(vector(in), vector(in + 3) / speed);
  Intersection i(r, shape);
  if (!i.Find()) return miss(answer);
  const Vector place = i.GetPoint(0);
  return hit(answer, (place - r.Origin).Length() / speed, &place);
}

int moving_point_sphere(const double* in, std::size_t, nearmiss_answer* answer) {
  return ray<Wm5::IntrRay3Sphere3<double>>(in, sphere(in + 6), answer);
}
int moving_point_box(const double* in, std::size_t, nearmiss_answer* answer) {
  return ray<Wm5::IntrRay3Box3<double>>(in, box(in + 6), answer);
}
int moving_point_capsule(const double* in, std::size_t, nearmiss_answer* answer) {
  return ray<Wm5::IntrRay3Capsule3<double>>(in, capsule(in + 6), answer);
}
int moving_point_triangle(const double* in, std::size_t, nearmiss_answer* answer) {
  const double speed = std::hypot(in[3], in[4], in[5]);
  if (!(speed > 0)) return cannot(answer, "a ray has a direction");
  const Wm5::Ray3<double> r(vector(in), vector(in + 3) / speed);
  const Wm5::Triangle3<double> t = triangle(in + 6);
  Wm5::IntrRay3Triangle3<double> i(r, t);
  return i.Find() ? hit(answer, i.GetRayParameter() / speed, nullptr) : miss(answer);
}
template <class Intersection>
int moved(Intersection i, const double* velocity, bool sphere_is_first, nearmiss_answer* answer) {
  const Vector still(0, 0, 0), v = vector(velocity);
  const double ever = std::numeric_limits<double>::max();
  if (!i.Find(ever, sphere_is_first ? v : still, sphere_is_first ? still : v)) return miss(answer);
  const Vector place = i.GetContactPoint();
  return i.GetContactTime() > 0 ? hit(answer, i.GetContactTime(), &place) : hit(answer, 0, nullptr);
}
int moving_sphere_sphere(const double* in, std::size_t, nearmiss_answer* answer) {
  const Wm5::Sphere3<double> moving = sphere(in), fixed = sphere(in + 7);
  return moved(Wm5::IntrSphere3Sphere3<double>(moving, fixed), in + 4, true, answer);
}
int moving_sphere_box(const double* in, std::size_t, nearmiss_answer* answer) {
  const Wm5::Sphere3<double> moving = sphere(in);
  const Wm5::Box3<double> fixed = box(in + 7);
  return moved(Wm5::IntrBox3Sphere3<double>(fixed, moving), in + 4, false, answer);
}
int closest_points_lines(const double* in, std::size_t, nearmiss_answer* answer) {
  const double l1 = std::hypot(in[3], in[4], in[5]), l2 = std::hypot(in[9], in[10], in[11]);
  const Wm5::Line3<double> a(vector(in), vector(in + 3) / l1), b(vector(in + 6), vector(in + 9) / l2);
  Wm5::DistLine3Line3<double> distance(a, b);
  distance.GetSquared();
  answer->yes = 1;
  for (int i = 0; i < 3; ++i) {
    answer->values[i] = distance.GetClosestPoint0()[i];
    answer->values[3 + i] = distance.GetClosestPoint1()[i];
  }
  return NEARMISS_ANSWERED;
}

int said(bool yes, nearmiss_answer* answer) {
  answer->yes = yes;
  answer->given = 0;
  return NEARMISS_ANSWERED;
}
int point_sphere_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return said(Wm5::InSphere(vector(in), sphere(in + 3)), answer);
}
int point_capsule_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return said(Wm5::InCapsule(vector(in), capsule(in + 3)), answer);
}
int point_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return said(Wm5::InBox(vector(in), box(in + 3)), answer);
}
/// Whether two shapes meet, by the class of their intersection.
template <template <class> class Intersection, class A, class B, class... Options>
int meet(const A& a, const B& b, nearmiss_answer* answer, Options... options) {
  return said(Intersection<double>(a, b, options...).Test(), answer);
}
int sphere_sphere_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrSphere3Sphere3>(sphere(in), sphere(in + 4), answer);
}
int sphere_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrBox3Sphere3>(box(in + 4), sphere(in), answer);
}
int box_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrBox3Box3>(box(in), box(in + 10), answer);
}
int sphere_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrTriangle3Sphere3>(triangle(in + 4), sphere(in), answer);
}
int sphere_segment_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrSegment3Sphere3>(segment(in + 4), sphere(in), answer);
}
int segment_capsule_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrSegment3Capsule3>(segment(in), capsule(in + 6), answer);
}
int segment_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrSegment3Triangle3>(segment(in), triangle(in + 6), answer);
}
int segment_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrSegment3Box3>(segment(in), box(in + 6), answer, true);  // solid
}
int capsule_capsule_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrCapsule3Capsule3>(capsule(in), capsule(in + 7), answer);
}
int triangle_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrTriangle3Triangle3>(triangle(in), triangle(in + 9), answer);
}
int triangle_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return meet<Wm5::IntrTriangle3Box3>(triangle(in), box(in + 9), answer);
}
int sphere_capsule_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  const Wm5::Capsule3<double> c = capsule(in + 4);
  return said(Wm5::DistPoint3Segment3<double>(vector(in), c.Segment).Get() <= in[3] + c.Radius, answer);
}
int capsule_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  const Wm5::Capsule3<double> c = capsule(in);
  return said(Wm5::DistSegment3Triangle3<double>(c.Segment, triangle(in + 7)).Get() <= c.Radius, answer);
}
int capsule_box_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  const Wm5::Capsule3<double> c = capsule(in);
  return said(Wm5::DistSegment3Box3<double>(c.Segment, box(in + 7)).Get() <= c.Radius, answer);
}
/// The distance and the two points of a class of distance.
template <class Distance>
int distance(Distance of, nearmiss_answer* answer) {
  answer->yes = 1, answer->given = 0b1111110001;
  answer->values[0] = of.Get();
  for (int i = 0; i < 3; ++i) {
    answer->values[4 + i] = of.GetClosestPoint0()[i];
    answer->values[7 + i] = of.GetClosestPoint1()[i];
  }
  return NEARMISS_ANSWERED;
}
int point_segment_signed_distance(const double* in, std::size_t, nearmiss_answer* answer) {
  const Vector point = vector(in);
  const Wm5::Segment3<double> s = segment(in + 3);
  return distance(Wm5::DistPoint3Segment3<double>(point, s), answer);
}
int closest_point_segment(const double* in, std::size_t, nearmiss_answer* answer) {
  const Vector point = vector(in + 6);
  const Wm5::Segment3<double> s = segment(in);
  Wm5::DistPoint3Segment3<double> of(point, s);
  of.GetSquared();
  answer->yes = 1;
  for (int i = 0; i < 3; ++i) answer->values[i] = of.GetClosestPoint1()[i];
  return NEARMISS_ANSWERED;
}
int segment_segment_signed_distance(const double* in, std::size_t, nearmiss_answer* answer) {
  const Wm5::Segment3<double> a = segment(in), b = segment(in + 6);
  return distance(Wm5::DistSegment3Segment3<double>(a, b), answer);
}

constexpr const char* by_distance = "a class of distance, and the radii";
const nearmiss_offer offers[] = {
    {"moving_point_sphere", 11, 7, nullptr, nullptr, moving_point_sphere, 0},
    {"moving_point_box", 16, 7, nullptr, nullptr, moving_point_box, 0},
    {"moving_point_capsule", 13, 7, nullptr, nullptr, moving_point_capsule, 0},
    {"moving_point_triangle", 15, 7, nullptr, nullptr, moving_point_triangle, 0},
    {"moving_sphere_sphere", 11, 7, nullptr, nullptr, moving_sphere_sphere, 0},
    {"moving_sphere_box", 17, 7, nullptr, nullptr, moving_sphere_box, 0},
    {"point_sphere_overlap", 7, 0, nullptr, nullptr, point_sphere_overlap, 0},
    {"point_capsule_overlap", 10, 0, nullptr, nullptr, point_capsule_overlap, 0},
    {"point_box_overlap", 13, 0, nullptr, nullptr, point_box_overlap, 0},
    {"sphere_sphere_overlap", 8, 0, nullptr, nullptr, sphere_sphere_overlap, 0},
    {"sphere_box_overlap", 14, 0, nullptr, nullptr, sphere_box_overlap, 0},
    {"box_box_overlap", 21, 1, nullptr, nullptr, box_box_overlap, 0},
    {"sphere_triangle_overlap", 13, 0, nullptr, nullptr, sphere_triangle_overlap, 0},
    {"sphere_segment_overlap", 10, 0, nullptr, nullptr, sphere_segment_overlap, 0},
    {"sphere_capsule_overlap", 11, 0, by_distance, nullptr, sphere_capsule_overlap, 0},
    {"segment_capsule_overlap", 13, 0, nullptr, nullptr, segment_capsule_overlap, 0},
    {"segment_triangle_overlap", 15, 0, nullptr, nullptr, segment_triangle_overlap, 0},
    {"segment_box_overlap", 16, 0, nullptr, nullptr, segment_box_overlap, 0},
    {"capsule_capsule_overlap", 14, 0, nullptr, nullptr, capsule_capsule_overlap, 0},
    {"capsule_triangle_overlap", 16, 0, by_distance, nullptr, capsule_triangle_overlap, 0},
    {"capsule_box_overlap", 17, 0, by_distance, nullptr, capsule_box_overlap, 0},
    {"triangle_triangle_overlap", 18, 0, nullptr, nullptr, triangle_triangle_overlap, 0},
    {"triangle_box_overlap", 19, 0, nullptr, nullptr, triangle_box_overlap, 0},
    {"closest_points_lines", 12, 6, nullptr, nullptr, closest_points_lines, 0},
    {"closest_point_segment", 9, 3, nullptr, nullptr, closest_point_segment, 0},
    {"point_segment_signed_distance", 9, 10, nullptr, nullptr, point_segment_signed_distance, 0},
    {"segment_segment_signed_distance", 12, 10, nullptr, nullptr, segment_segment_signed_distance, 0},
};
const nearmiss_plugin wild_magic = {NEARMISS_PLUGIN_VERSION,        SUBJECT, "Wild Magic 5.17", NEARMISS_DOUBLE,
                                    sizeof offers / sizeof *offers, offers};

}  // namespace

extern "C" const nearmiss_plugin* nearmiss_plugin_entry(void) { return &wild_magic; }
