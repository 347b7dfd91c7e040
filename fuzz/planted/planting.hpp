/// The table of planted mistakes. A mistake is one place: MISTAKE(round, query, where, what, causes) and the answer
/// with the mistake to the inputs `q`.
///   round    in which it was planted (docs/explanation/causes.md); a round is a plugin, with at most one mistake for
///            each query
///   where    `degenerate`: it shows only near a degeneracy; `ordinary`: in a noticeable share of all cases
///   what     what is wrong
///   causes   those that may be named: "KIND KEY or KIND KEY", where KEY is a regular expression for the whole key and
///            may be missing
/// MISREAD and MISREPORT, below, are shorter forms. planted.cpp has the plugin, which answers the queries of one round;
/// fuzz/planted/causes reads the table.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "impl/plugin/nearmiss_plugin.h"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss::planted {

enum class Where { degenerate, ordinary };

struct Mistake {
  int round;
  std::string_view query;
  Where where;
  std::string_view what, causes;
  nearmiss_offer offer;
};
/// Every mistake, in no order.
std::vector<Mistake>& mistakes();

using Vector = collide::Vec3<double>;
/// What a mistake computes by itself neither rounds nor leaves the range of double.
using Real = long double;
using Wide = collide::Vec3<Real>;
using Axes = std::array<Vector, 3>;

template <class T>
T dot(const collide::Vec3<T>& a, const collide::Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
collide::Vec3<T> cross(const collide::Vec3<T>& a, const collide::Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector& a) { return std::hypot(a.x, a.y, a.z); }
inline long double length(const Wide& a) { return std::sqrt(dot(a, a)); }
inline double squared(const Vector& a) { return dot(a, a); }
inline double squared(const collide::Quaternion<double>& r) { return r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w; }
inline Vector unit_of(const Vector& a) { return a / length(a); }
inline double sign(double x) { return x < 0 ? -1 : 1; }
template <class T>
T component(const collide::Vec3<T>& v, int k) {
  return k == 0 ? v.x : k == 1 ? v.y : v.z;
}
template <class T>
T& component(collide::Vec3<T>& v, int k) {
  return k == 0 ? v.x : k == 1 ? v.y : v.z;
}
/// The axis of the largest magnitude, the first of several.
inline int largest(const Vector& v) {
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}
inline std::array<double, 3> numbers_of(const Vector& v) { return {v.x, v.y, v.z}; }
inline Wide widened(const Vector& a) { return {a.x, a.y, a.z}; }
inline Vector narrowed(const Wide& a) { return {double(a.x), double(a.y), double(a.z)}; }

/// Rounded to float.
inline double in_float(double x) { return double(float(x)); }
inline Vector in_float(const Vector& a) { return {in_float(a.x), in_float(a.y), in_float(a.z)}; }
/// With the digits of a float and the range of double.
inline double in_24_bits(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(in_float(mantissa), exponent);
}
inline Vector in_24_bits(const Vector& a) { return {in_24_bits(a.x), in_24_bits(a.y), in_24_bits(a.z)}; }

/// The right answer: that of `collide`, tier Accurate.
template <class Q>
typename Q::Answer right(const Q& q);

inline Vector normal_of(const collide::Triangle<double>& t) { return cross(t.v1 - t.v0, t.v2 - t.v0); }
/// Whether the angle between the vector and the plane with this unit normal has a sine below `sine`.
inline bool grazes(const Vector& normal, const Vector& vector, double sine) {
  return std::abs(dot(normal, vector)) < sine * length(vector);
}
inline Vector nearest(const Vector& a, const Vector& b, const Vector& p) {
  return right(inputs::closest_point_segment<double>{{a, b}, p}).point;
}
inline Vector nearest(const collide::Triangle<double>& t, const Vector& p) {
  return right(inputs::closest_point_rectangle<double>{{t.v0, t.v1, t.v2, t.v2}, p}).point;
}
inline double distance_from_line(const Vector& a, const Vector& b, const Vector& p) {
  const double size = length(b - a);
  return size > 0 ? length(cross(p - a, (b - a) / size)) : length(p - a);
}

/// The cross product of two axes, or one axis, as box_box_separating_axis numbers them.
template <class Q>
Vector axis_of(const Q& q, int axis) {
  return right(inputs::box_box_separating_axis<double>{q.box1, q.box2, axis}).direction;
}
inline Vector axis_of_box(const collide::Box<double>& box, int k) {
  return right(inputs::box_box_separating_axis<double>{box, box, k}).direction;
}
/// The distance of two boxes along an axis that is not divided by its length; negative where they overlap.
template <class Q>
double gap_along(const Q& q, int axis) {
  return right(inputs::box_box_projected_distance<double>{q.box1, q.box2, axis}).value;
}
template <class Q>
collide::BoxBoxInfo<double> info_of(const Q& q) {
  return right(inputs::box_box_info<double>{q.box1, q.box2});
}
inline Axes axes_of_box(const collide::Box<double>& box) {
  return {axis_of_box(box, 0), axis_of_box(box, 1), axis_of_box(box, 2)};
}
/// The coordinates of a vector in a frame.
inline Vector into(const Axes& axes, const Vector& a) { return {dot(axes[0], a), dot(axes[1], a), dot(axes[2], a)}; }
/// The coordinates of a point in the box's frame.
inline Vector local(const collide::Box<double>& box, const Vector& p) { return into(axes_of_box(box), p - box.center); }
/// The columns of the matrix of a quaternion that is taken for one of unit length.
template <class T>
std::array<collide::Vec3<T>, 3> axes_of_unit(const collide::Quaternion<T>& r) {
  const T x = r.x, y = r.y, z = r.z, w = r.w;
  return {collide::Vec3<T>{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}
/// The axes of a box, whose quaternion may have any length.
inline std::array<Wide, 3> wide_axes_of(const collide::Box<double>& box) {
  const long double x = box.orientation.x, y = box.orientation.y, z = box.orientation.z, w = box.orientation.w;
  const long double size = std::sqrt(x * x + y * y + z * z + w * w);
  return axes_of_unit(collide::Quaternion<long double>{x / size, y / size, z / size, w / size});
}

/// Whether steps of the gap over the speed come to a gap of `enough`, with at most so many steps.
template <class Number, class Gap>
bool advances(const Gap& gap_at, Number speed, Number enough, int steps) {
  Number time = 0;
  for (int step = 0; step < steps; ++step) {
    const Number gap = gap_at(time);
    if (gap <= enough) return true;
    time += gap / speed;
  }
  return false;
}

/// Larger than the rounding of a distance; an answer that is no farther is the right one.
constexpr double hardly_more = 1 + 1e-14;

/// Half of b, and a quarter of the discriminant, of the equation for the times when a point is on an infinite cylinder.
inline std::pair<double, double> half_b_and_discriminant(const Vector& from, const Vector& velocity, const Vector& axis,
                                                         double radius) {
  const double dd = dot(axis, axis), nd = dot(velocity, axis), md = dot(from, axis);
  const double a = dd * dot(velocity, velocity) - nd * nd, b = dd * dot(from, velocity) - nd * md;
  const double c = dd * (dot(from, from) - radius * radius) - md * md;
  return {b, b * b - a * c};
}
inline Real wide_distance(const Vector& a, const Vector& b) { return length(widened(a) - widened(b)); }
/// The normal of three corners, of no length.
inline Wide wide_normal(const Vector& a, const Vector& b, const Vector& c) {
  return cross(widened(b) - widened(a), widened(c) - widened(a));
}
/// Not normalised barycentric coordinates of the foot of p on the triangle's plane, times the squared normal.
inline Wide foot_weights(const collide::Triangle<double>& t, const Wide& n, const Wide& p) {
  const Wide a = widened(t.v0), b = widened(t.v1), c = widened(t.v2);
  return {dot(n, cross(c - b, p - b)), dot(n, cross(a - c, p - c)), dot(n, cross(b - a, p - a))};
}
inline bool none_negative(const Wide& a) { return a.x >= 0 && a.y >= 0 && a.z >= 0; }
inline std::array<Real, 3> halves_of(const collide::Box<double>& box) { return {box.half.x, box.half.y, box.half.z}; }
/// Axis k of a box, as a unit vector.
inline Wide wide_axis(const collide::Box<double>& box, int k) {
  const long double x = box.orientation.x, y = box.orientation.y, z = box.orientation.z, w = box.orientation.w;
  const long double n = x * x + y * y + z * z + w * w;
  if (k == 0) return Wide{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)} / n;
  if (k == 1) return Wide{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)} / n;
  return Wide{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z} / n;
}
inline Wide wide_local(const collide::Box<double>& box, const Wide& p) {
  const Wide d = p - widened(box.center);
  return {dot(wide_axis(box, 0), d), dot(wide_axis(box, 1), d), dot(wide_axis(box, 2), d)};
}

/// Answers a case by a mistake.
template <class Q>
int answer_by(typename Q::Answer (*mistake)(Q), const double* numbers, nearmiss_answer* to);

/// Answers a case of this query right.
nearmiss_answer_function right_answer_to(std::string_view query);

/// Promises what the tier Accurate of collide promises.
template <class Q>
nearmiss_offer offer(const char* query, nearmiss_answer_function answer);

/// Puts a mistake into the table.
struct Row {
  explicit Row(const Mistake& m) { mistakes().push_back(m); }
};

}  // namespace nearmiss::planted

#define MISTAKE(round, query, where, what, causes)                                                                  \
  inputs::query<double>::Answer query##_##round(inputs::query<double>);                                             \
  int answer_##query##_##round(const double* numbers, std::size_t, nearmiss_answer* to) {                           \
    return answer_by<inputs::query<double>>(query##_##round, numbers, to);                                          \
  }                                                                                                                 \
  const Row row_of_##query##_##round(                                                                               \
      {round, #query, Where::where, what, causes, offer<inputs::query<double>>(#query, answer_##query##_##round)}); \
  inputs::query<double>::Answer query##_##round(inputs::query<double> q)
/// A mistake that is right for other inputs: changes `q`.
#define MISREAD(round, query, where, what, causes)          \
  void misread_##query##_##round(inputs::query<double>& q); \
  MISTAKE(round, query, where, what, causes) {              \
    misread_##query##_##round(q);                           \
    return right(q);                                        \
  }                                                         \
  void misread_##query##_##round(inputs::query<double>& q)
/// A mistake that starts from the right answer: changes `a`.
#define MISREPORT(round, query, where, what, causes)                                                  \
  void misreport_##query##_##round(const inputs::query<double>& q, inputs::query<double>::Answer& a); \
  MISTAKE(round, query, where, what, causes) {                                                        \
    auto a = right(q);                                                                                \
    misreport_##query##_##round(q, a);                                                                \
    return a;                                                                                         \
  }                                                                                                   \
  void misreport_##query##_##round([[maybe_unused]] const inputs::query<double>& q, inputs::query<double>::Answer& a)
