/// A 3D vector: a point, a displacement or a direction.
#pragma once

#include <collide/members.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  static constexpr auto members() {
    return std::tuple(member("x", &Vec3::x), member("y", &Vec3::y), member("z", &Vec3::z));
  }

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, const T& s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(const T& s, const Vec3& a) { return a * s; }
  friend constexpr Vec3 operator/(const Vec3& a, const T& s) { return {a.x / s, a.y / s, a.z / s}; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

namespace detail {
template <class T>
Vec3<double> in_double(const Vec3<T>& a) {
  return {double(a.x), double(a.y), double(a.z)};
}
}  // namespace detail

}  // namespace collide

#include <collide/detail/strict_end.hpp>
