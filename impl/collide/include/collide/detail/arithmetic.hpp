/// The arithmetic of a kernel: how it computes sums of products that may cancel, and what is built on these.
#pragma once

#include <cstdint>
#include <limits>

#include <collide/detail/double_word.hpp>
#include <collide/detail/number.hpp>
#include <collide/vec3.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// The cross product, by the differences of products of the arithmetic that inherits it.
template <class Arithmetic>
struct WithCross {
  template <class T>
  static constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
    return {Arithmetic::difference_of_products(a.y, b.z, a.z, b.y),
            Arithmetic::difference_of_products(a.z, b.x, a.x, b.z),
            Arithmetic::difference_of_products(a.x, b.y, a.y, b.x)};
  }
};

/// Plain arithmetic. It is no tier: it lifts nothing, so that `kernels::QUERY<Plain>` is the kernel itself, in any
/// numbers. Numbers other than the machine's may allocate memory, and so may throw.
struct Plain : WithCross<Plain> {
  static constexpr bool never_throws = false;
  /// Whether a kernel called with this arithmetic and arguments of T must be lifted first.
  template <class T>
  static constexpr bool lifts = false;
  template <class T>
  static constexpr bool computes_in = true;

  template <class T>
  static constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  template <class T>
  static constexpr T difference_of_products(const T& a, const T& b, const T& c, const T& d) {
    return a * b - c * d;
  }
  /// |a|^2 - r^2
  template <class T>
  static constexpr T beyond_radius(const Vec3<T>& a, const T& r) {
    return dot(a, a) - r * r;
  }
};

/// Compensated arithmetic: computes a sum of products that cancels again in twice the precision. Its error is at most
/// 8 u of the result and 64 u^2 of the terms, u the unit roundoff, where nothing underflows; the error of plain
/// arithmetic is 3 u of the terms. A sum that keeps a quarter of its terms' magnitude is not computed again.
struct Compensated : WithCross<Compensated> {
  static constexpr bool never_throws = false;
  template <class T>
  static constexpr bool lifts = false;
  template <class T>
  static constexpr bool computes_in = true;

  template <class T>
  static constexpr T difference_of_products(const T& a, const T& b, const T& c, const T& d) {
    using detail::abs;
    const T p = a * b, q = c * d, difference = p - q;
    if (4 * abs(difference) >= abs(p) + abs(q)) return difference;
    return sum(DoubleWord<T>::two_product(a, b), DoubleWord<T>::two_product(-c, d), difference);
  }
  template <class T>
  static constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
    using detail::abs;
    const T x = a.x * b.x, y = a.y * b.y, z = a.z * b.z, plain = x + y + z;
    if (4 * abs(plain) >= abs(x) + abs(y) + abs(z)) return plain;
    const DoubleWord<T> xy = DoubleWord<T>::two_product(a.x, b.x) + DoubleWord<T>::two_product(a.y, b.y);
    return sum(xy, DoubleWord<T>::two_product(a.z, b.z), plain);
  }
  template <class T>
  static constexpr T beyond_radius(const Vec3<T>& a, const T& r) {
    using detail::abs;
    const T length2 = Plain::dot(a, a), r2 = r * r, plain = length2 - r2;
    if (4 * abs(plain) >= length2 + r2) return plain;
    const DoubleWord<T> xy = DoubleWord<T>::two_product(a.x, a.x) + DoubleWord<T>::two_product(a.y, a.y);
    return sum(xy + DoubleWord<T>::two_product(a.z, a.z), DoubleWord<T>::two_product(-r, r), plain);
  }

 private:
  /// a + b, or `plain` where a product overflowed on the way.
  template <class T>
  static constexpr T sum(const DoubleWord<T>& a, const DoubleWord<T>& b, const T& plain) {
    const T sum = (a + b).high;
    return sum - sum == T(0) ? sum : plain;
  }
};

/// a / |a|; a itself where it is zero; NaN where a number of it is not finite.
template <class Tier, class T>
Vec3<T> unit(const Vec3<T>& a) {
  using detail::abs, detail::sqrt;
  const T length2 = Tier::dot(a, a);
  if constexpr (MachineNumber<T>) {
    constexpr T least = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
    constexpr T most = std::numeric_limits<T>::max() / T(16);
    if (!(length2 >= least && length2 <= most)) {
      const T largest = larger(larger(abs(a.x), abs(a.y)), abs(a.z));
      if (largest == T(0)) return a;
      const Vec3<T> scaled = a / largest;
      return scaled / sqrt(Tier::dot(scaled, scaled));
    }
  } else if (length2 == T(0)) {
    return a;
  }
  return a / sqrt(length2);
}

namespace detail {

/// 1 - |a|^2 to 2^-8 eps, of a vector of at most about unit length.
///
/// a = h + l, where h is a multiple of 2^-g and |l| <= 2^-g / 2. Squares of h are multiples of 2^-2g, and 2 g + 2
/// digits hold their sums: nothing is rounded. What is left of |a|^2 is the sum of l (h + a), each known to 2 u of
/// 2^-g.
template <MachineNumber T>
T one_minus_length2(const Vec3<T>& a) {
  constexpr int digits = std::numeric_limits<T>::digits, g = (digits - 2) / 2;
  constexpr T round_to = T(3) * T(std::uint64_t{1} << (digits - 2 - g));  // its neighbours are 2^-g apart
  const auto rounded = [](T x) { return (x + round_to) - round_to; };
  const Vec3<T> h{rounded(a.x), rounded(a.y), rounded(a.z)}, l = a - h, sum = h + a;
  return (((T(1) - h.x * h.x) - h.y * h.y) - h.z * h.z) - Plain::dot(l, sum);
}

}  // namespace detail

/// `a` with the length sqrt(1 - missing), which it has but for some eps; |missing| <= 1/4.
///
/// Other directions of the operands may explain the error of a direction, but no error of a length that is 1, whatever
/// the operands are. So this leaves of it 2^-8 eps, and 1/3 of it times `missing`, which belongs to a length that
/// depends on an angle, beside the last rounding of each number.
template <class T>
Vec3<T> with_corrected_length(const Vec3<T>& a, const T& missing = T(0)) {
  if constexpr (MachineNumber<T>) {
    return a + a * ((detail::one_minus_length2(a) - missing) / T(2));
  } else {
    return a;
  }
}

}  // namespace collide

#include <collide/detail/strict_end.hpp>
