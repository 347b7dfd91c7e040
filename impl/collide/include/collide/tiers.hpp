/// The tiers: how much arithmetic a query spends on each accuracy. A tier is a policy argument; the
/// text of a query is the same in every tier.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

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

/// x, or 0 where it is negative; NaN stays NaN.
template <class T>
constexpr T not_negative(T x) noexcept {
  return x < T(0) ? T(0) : x;
}

/// a / |a|; a itself where it is zero; NaN where a number of it is not finite.
template <class Tier, class T>
Vec3<T> unit(const Vec3<T>& a) noexcept {
  using std::sqrt, std::abs;
  constexpr T least = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
  constexpr T most = std::numeric_limits<T>::max() / T(16);
  const T length2 = Tier::dot(a, a);
  if (length2 >= least && length2 <= most) return a / sqrt(length2);
  const T largest = std::max({abs(a.x), abs(a.y), abs(a.z)});
  if (largest == T(0)) return a;
  const Vec3<T> scaled = a / largest;
  return scaled / sqrt(Tier::dot(scaled, scaled));
}

}  // namespace collide
