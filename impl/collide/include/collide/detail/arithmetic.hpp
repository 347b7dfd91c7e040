/// The arithmetic of a kernel: how it computes sums of products that may cancel, and functions built on these.
#pragma once

#include <cstdint>
#include <limits>

#include <collide/detail/double_word.hpp>
#include <collide/detail/number.hpp>
#include <collide/vec3.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// The cross product, from the derived arithmetic's difference of products (a base class in the CRTP style).
template <class Arithmetic>
struct WithCross {
  template <class T>
  static constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
    return {Arithmetic::difference_of_products(a.y, b.z, a.z, b.y),
            Arithmetic::difference_of_products(a.z, b.x, a.x, b.z),
            Arithmetic::difference_of_products(a.x, b.y, a.y, b.x)};
  }
};

/// Plain arithmetic in any number type. It is not a tier: it lifts nothing, so `kernels::QUERY<Plain>` is the kernel
/// itself. Number types other than the built-in ones may allocate memory, and so may throw.
struct Plain : WithCross<Plain> {
  static constexpr bool never_throws = false;
  /// True if a kernel called with this arithmetic and arguments of T must be lifted first.
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

/// Compensated arithmetic: recomputes a sum of products that cancels in twice the precision. With u the unit roundoff,
/// and without underflow, the error is at most 8 u of the result plus 64 u^2 of the terms; the error of plain
/// arithmetic is 3 u of the terms. A sum that keeps at least a quarter of the magnitude of its terms is not recomputed.
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
  /// a + b, or `plain` if a product overflowed.
  template <class T>
  static constexpr T sum(const DoubleWord<T>& a, const DoubleWord<T>& b, const T& plain) {
    const T sum = (a + b).high;
    return sum - sum == T(0) ? sum : plain;
  }
};

/// Whether the square of a length that unit() divides by neither overflows nor loses digits.
template <MachineNumber T>
constexpr bool needs_no_scaling(T length2) {
  constexpr T least = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
  return length2 >= least && length2 <= std::numeric_limits<T>::max() / T(16);
}

/// a / |a|. Zero for zero; NaN if a number of a is not finite.
template <class Tier, class T>
Vec3<T> unit(const Vec3<T>& a) {
  using detail::abs, detail::sqrt;
  const T length2 = Tier::dot(a, a);
  if constexpr (MachineNumber<T>) {
    if (!needs_no_scaling(length2)) {
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

/// 1 - |a|^2 with an error of 2^-8 eps, for a vector with a length of at most about 1.
///
/// Split a = h + l, where h is a multiple of 2^-g and |l| <= 2^-g / 2. The squares of h are multiples of 2^-2g, and 2
/// (g + 1) digits hold their sums, so that part is exact. The rest of |a|^2 is the sum of l (h + a), each with an error
/// of 2 u of 2^-g.
template <MachineNumber T>
T one_minus_length2(const Vec3<T>& a) {
  constexpr int digits = std::numeric_limits<T>::digits, g = (digits - 2) / 2;
  constexpr T round_to = T(3) * T(std::uint64_t{1} << (digits - 2 - g));  // neighbouring numbers are 2^-g apart here
  const auto rounded = [](T x) { return (x + round_to) - round_to; };
  const Vec3<T> h{rounded(a.x), rounded(a.y), rounded(a.z)}, l = a - h, sum = h + a;
  return (((T(1) - h.x * h.x) - h.y * h.y) - h.z * h.z) - Plain::dot(l, sum);
}

}  // namespace detail

/// `a` with its length corrected to sqrt(1 - missing), for an `a` whose length is off by a few eps; |missing| <= 1/4.
///
/// A perturbation of the operands can account for an error in a direction, but not for an error in a length that is 1
/// for all operands. After the correction the length has an error of 2^-8 eps, plus 1/3 of the original error times
/// `missing` (which belongs to a length that depends on an angle), plus the last rounding of each number.
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
