/// What the plugins with planted mistakes share: vectors, the right answers of `collide`, and offers with its contract.
/// Each plugin defines mistake(), an overload for each query, before it includes planted_offers.hpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "impl/adapters/collide.hpp"
#include "impl/catalogue/answer.hpp"
#include "impl/plugin/nearmiss_plugin.h"

namespace nearmiss::planted {

using Vector = collide::Vec3<double>;

inline double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(const Vector& a) { return std::hypot(a.x, a.y, a.z); }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vector normal_of(const collide::Triangle<double>& t) { return cross(t.v1 - t.v0, t.v2 - t.v0); }
/// Rounded to float.
inline double in_float(double x) { return double(float(x)); }
inline Vector in_float(const Vector& a) { return {in_float(a.x), in_float(a.y), in_float(a.z)}; }
/// Whether the angle between the vector and the plane with this unit normal has a sine below `sine`.
inline bool grazes(const Vector& normal, const Vector& vector, double sine) {
  return std::abs(dot(normal, vector)) < sine * length(vector);
}

template <class Q>
[[gnu::noinline]] typename Q::Answer right(const Q& q) {
  return adapters::ask_collide<collide::Accurate>(q);
}
inline Vector nearest(const Vector& a, const Vector& b, const Vector& p) {
  return right(inputs::closest_point_segment<double>{{a, b}, p}).point;
}
/// The cross product of two axes, or one axis, as box_box_separating_axis numbers them.
template <class Q>
Vector axis_of(const Q& q, int axis) {
  return right(inputs::box_box_separating_axis<double>{q.box1, q.box2, axis}).direction;
}

}  // namespace nearmiss::planted

/// The answer to a query, with its mistake.
#define NEARMISS_MISTAKE(query) inputs::query<double>::Answer mistake(inputs::query<double> q)
