/// The tiers: how much arithmetic a query spends on each accuracy. A tier is a policy argument; the
/// text of a query is the same in every tier.
#pragma once

#include <cmath>

#include <collide/vec3.hpp>

namespace collide {

/// Plain arithmetic of the scalar.
struct Fast {
  template <class T>
  static constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  template <class T>
  static constexpr T difference_of_products(T a, T b, T c, T d) noexcept {
    return a * b - c * d;
  }
  template <class T>
  static constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x)};
  }
};

/// a / |a|, or a where |a| is zero. The length is not rescued from overflow or underflow.
template <class Tier, class T>
Vec3<T> unit(const Vec3<T>& a) noexcept {
  using std::sqrt;
  const T length = sqrt(Tier::dot(a, a));
  return length > T(0) ? a / length : a;
}

}  // namespace collide
