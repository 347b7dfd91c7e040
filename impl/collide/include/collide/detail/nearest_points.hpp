/// Nearest points of two segments, in machine numbers.
#pragma once

#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// A segment by its start, relative to an origin, and its direction, whose length is moderate: its end is
/// start + direction * end. A single point has the direction 0.
template <MachineNumber T>
struct Axis {
  Vec3<T> start, direction{};
  T end{1};  ///< a power of two

  constexpr explicit Axis(const Vec3<T>& point) : start(point) {}
  Axis(const Vec3<T>& from, const Vec3<T>& to, const Vec3<T>& origin) : start(from - origin), direction(to - from) {
    const T largest = larger(larger(abs(direction.x), abs(direction.y)), abs(direction.z));
    if (!(largest > T(0) && largest <= std::numeric_limits<T>::max())) return;
    if (largest >= T(0.0625) && largest <= T(16)) return;
    const int down = -detail::ilogb(largest);
    direction = {detail::ldexp(direction.x, down), detail::ldexp(direction.y, down), detail::ldexp(direction.z, down)};
    end = detail::ldexp(T(1), -down);
  }
  Vec3<T> at(T parameter) const { return start + direction * parameter; }
};

/// x in [0, end]; NaN for NaN.
template <MachineNumber T>
T parameter_within(T x, T end) {
  return larger(smaller(x, end), T(0));
}
/// 1 / x; 0 for 0 and for a square that underflows. That of a cross product of moderate directions underflows only
/// where the sine of the angle is below eps^2.
template <MachineNumber T>
T inverse_or_zero(T x) {
  return x >= std::numeric_limits<T>::min() ? T(1) / x : T(0);
}

/// The parameter of the point of the axis nearest to a point; `inverse2` is that of its direction's squared length.
template <class Tier, class T>
T nearest_parameter(const Axis<T>& axis, T inverse2, const Vec3<T>& point) {
  return parameter_within(T(Tier::dot(point - axis.start, axis.direction) * inverse2), axis.end);
}
template <class Tier, class T>
T nearest_parameter(const Axis<T>& axis, const Vec3<T>& point) {
  return nearest_parameter<Tier>(axis, inverse_or_zero(Tier::dot(axis.direction, axis.direction)), point);
}

template <class T>
struct NearestParameters {
  T first{}, second{};
};

/// The parameters of points of both axes whose distance is the least one but for rounding.
///
/// The nearest points of the lines have parameters with the divisor |d x e|^2. Computed from the cross product, their
/// errors are eps |w| / sin(angle) in length, which moves the lines apart by eps |w| alone; the usual divisor
/// |d|^2 |e|^2 - (d . e)^2 loses all digits at angles below the square root of eps. What a parameter outside its
/// segment, and an angle of a few eps, leave is mended by the nearest parameter of each axis to the point on the other
/// one: the distance is convex, and no step increases it.
/// Source: Eberly, Robust Computation of Distance Between Line Segments, 2015, for the steps.
template <class Tier, class T>
NearestParameters<T> nearest_parameters(const Axis<T>& a, const Axis<T>& b) {
  const Vec3<T> normal = Tier::cross(a.direction, b.direction);
  // The divisions wait for nothing but the lengths.
  const T inverse_a = inverse_or_zero(Tier::dot(a.direction, a.direction));
  const T inverse_b = inverse_or_zero(Tier::dot(b.direction, b.direction));
  const T inverse_normal = inverse_or_zero(Tier::dot(normal, normal));
  const T at = Tier::dot(Tier::cross(b.start - a.start, b.direction), normal);
  const T first = parameter_within(T(at * inverse_normal), a.end);
  const T second = nearest_parameter<Tier>(b, inverse_b, a.at(first));
  return {nearest_parameter<Tier>(a, inverse_a, b.at(second)), second};
}

/// From a point of `a` to a point of `b`: a shortest way between them.
template <class Tier, class T>
Vec3<T> shortest_way(const Axis<T>& a, const Axis<T>& b) {
  const NearestParameters<T> nearest = nearest_parameters<Tier>(a, b);
  return b.at(nearest.second) - a.at(nearest.first);
}
template <class Tier, class T>
Vec3<T> shortest_way(const Vec3<T>& point, const Axis<T>& axis) {
  return axis.at(nearest_parameter<Tier>(axis, point)) - point;
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
