/// Access to the shapes in a query's inputs, for the contenders of other libraries.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include <collide/shapes.hpp>

namespace nearmiss::benchmarks {

/// A query's name as a template argument.
struct QueryName {
  char text[48]{};
  template <std::size_t n>
  constexpr QueryName(const char (&name)[n]) {
    std::copy_n(name, n, text);
  }
};

/// The k-th member of type S of a query's inputs.
template <class S, int k = 0, std::size_t i = 0, class Q>
const S& the(const Q& q) {
  constexpr auto member = std::get<i>(Q::members());
  using Here = std::remove_cvref_t<decltype(q.*(member.pointer))>;
  if constexpr (!std::is_same_v<Here, S>) {
    return the<S, k, i + 1>(q);
  } else if constexpr (k > 0) {
    return the<S, k - 1, i + 1>(q);
  } else {
    return q.*(member.pointer);
  }
}

/// The shape of type B beside one of type A; the second one where both types are the same.
template <class A, class B, class Q>
const B& the_other(const Q& q) {
  constexpr int k = std::is_same_v<A, B> ? 1 : 0;
  return the<B, k>(q);
}

template <class T>
T dot(const collide::Vec3<T>& a, const collide::Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
T norm(const collide::Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}

/// A ball that holds the shape.
template <class T>
collide::Sphere<T> ball_around(const collide::Sphere<T>& s) {
  return s;
}
template <class T>
collide::Sphere<T> ball_around(const collide::Box<T>& b) {
  return {b.center, norm(b.half)};
}
template <class T>
collide::Sphere<T> ball_around(const collide::AABox<T>& b) {
  return {(b.min + b.max) * T(0.5), norm(b.max - b.min) / 2};
}
template <class T>
collide::Sphere<T> ball_around(const collide::Capsule<T>& c) {
  return {(c.p0 + c.p1) * T(0.5), norm(c.p1 - c.p0) / 2 + c.radius};
}
template <class T>
collide::Sphere<T> ball_around(const collide::Triangle<T>& t) {
  const collide::Vec3<T> center = (t.v0 + t.v1 + t.v2) / T(3);
  return {center, std::max({norm(t.v0 - center), norm(t.v1 - center), norm(t.v2 - center)})};
}
/// An end for an unlimited motion, past the shape, so that no contact is lost. Other libraries move from a start to an
/// end.
template <class S, class T>
collide::Vec3<T> end_of_motion(const collide::Vec3<T>& start, const collide::Vec3<T>& velocity, T radius,
                               const S& shape) {
  const collide::Sphere<T> ball = ball_around(shape);
  const T speed = norm(velocity);
  if (!(speed > 0)) return start;
  const T way = std::max(dot(ball.center - start, velocity) / speed, T(0)) + ball.radius + radius;
  return start + velocity * (way / speed);
}

/// For a plane that the motion approaches; a unit of time otherwise.
template <class T>
collide::Vec3<T> end_of_motion(const collide::Vec3<T>& start, const collide::Vec3<T>& velocity, T radius,
                               const collide::Plane<T>& plane) {
  const T above = dot(plane.normal, start) + plane.offset, closing = -dot(plane.normal, velocity);
  if (!(above > 0 && closing > 0)) return start + velocity;
  return start + velocity * ((above + radius * norm(plane.normal)) / closing);
}

}  // namespace nearmiss::benchmarks
