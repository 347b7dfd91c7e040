/// The tiers: how much arithmetic a query spends on each accuracy. A tier is a policy argument; the
/// text of a query is the same in every tier.
///
/// A tier computes a text in the caller's numbers, by its own `dot` and `difference_of_products`, or it
/// lifts the query: it has the same text computed in other numbers and rounds the answer. So a text must
/// be right where numbers are real numbers: it uses + - * /, comparisons, sqrt, abs and the words of
/// number.hpp, decides by comparisons alone, and keeps what guards against rounding, overflow and
/// underflow behind `if constexpr (MachineNumber<T>)`.
///
/// Some queries have a second text, in lanes (lanes.hpp), which `Fast` takes where the machine has them, and some a
/// first look in doubles, which `Certified` takes.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/double_word.hpp>
#include <collide/lanes.hpp>
#include <collide/number.hpp>
#include <collide/vec3.hpp>

namespace collide {

/// The cross product, by the differences of products of the operations that inherit it.
template <class Operations>
struct WithCross {
  template <class T>
  static constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    return {Operations::difference_of_products(a.y, b.z, a.z, b.y),
            Operations::difference_of_products(a.z, b.x, a.x, b.z),
            Operations::difference_of_products(a.x, b.y, a.y, b.x)};
  }
};

/// Plain arithmetic: what a text computes with unless its tier has something better. Not a tier itself: it
/// lifts nothing, so a query called with it is nothing but its text.
struct Plain : WithCross<Plain> {
  /// Whether the tier has a text with arguments of T computed by its `lift`.
  template <class T>
  static constexpr bool lifts = false;
  template <class T>
  static constexpr bool keeps = true;

  template <class T>
  static constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  template <class T>
  static constexpr T difference_of_products(const T& a, const T& b, const T& c, const T& d) noexcept {
    return a * b - c * d;
  }
  /// |a|^2 - r^2
  template <class T>
  static constexpr T beyond_radius(const Vec3<T>& a, const T& r) noexcept {
    return dot(a, a) - r * r;
  }
};

/// The same with sums of products that cancel computed again in twice the precision: the error is at most
/// 8 u of the result and 64 u^2 of the terms, u the unit roundoff, where nothing underflows; of plain
/// arithmetic it is 3 u of the terms. A sum that keeps a quarter of its terms' magnitude is good enough.
struct Compensated : WithCross<Compensated> {
  template <class T>
  static constexpr bool lifts = false;
  template <class T>
  static constexpr bool keeps = true;

  template <class T>
  static constexpr T difference_of_products(const T& a, const T& b, const T& c, const T& d) noexcept {
    using std::abs;
    const T p = a * b, q = c * d, difference = p - q;
    if (4 * abs(difference) >= abs(p) + abs(q)) return difference;
    return sum(DoubleWord<T>::two_product(a, b), DoubleWord<T>::two_product(-c, d), difference);
  }
  template <class T>
  static constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    using std::abs;
    const T x = a.x * b.x, y = a.y * b.y, z = a.z * b.z, plain = x + y + z;
    if (4 * abs(plain) >= abs(x) + abs(y) + abs(z)) return plain;
    const DoubleWord<T> xy = DoubleWord<T>::two_product(a.x, b.x) + DoubleWord<T>::two_product(a.y, b.y);
    return sum(xy, DoubleWord<T>::two_product(a.z, b.z), plain);
  }
  template <class T>
  static constexpr T beyond_radius(const Vec3<T>& a, const T& r) noexcept {
    using std::abs;
    const T length2 = Plain::dot(a, a), r2 = r * r, plain = length2 - r2;
    if (4 * abs(plain) >= length2 + r2) return plain;
    const DoubleWord<T> xy = DoubleWord<T>::two_product(a.x, a.x) + DoubleWord<T>::two_product(a.y, a.y);
    return sum(xy + DoubleWord<T>::two_product(a.z, a.z), DoubleWord<T>::two_product(-r, r), plain);
  }

 private:
  /// a + b, or `plain` where a product overflowed on the way.
  template <class T>
  static constexpr T sum(const DoubleWord<T>& a, const DoubleWord<T>& b, const T& plain) noexcept {
    const T sum = (a + b).high;
    return sum - sum == T(0) ? sum : plain;
  }
};

/// The sign bit is set where x is NaN or infinite: a carry out of an exponent that is all ones.
template <MachineNumber T>
constexpr auto not_finite_bit(T x) noexcept {
  static_assert(sizeof(T) == 4 || sizeof(T) == 8);
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  constexpr Bits exponent = std::bit_cast<Bits>(std::numeric_limits<T>::infinity());
  constexpr Bits one = Bits{1} << (std::numeric_limits<T>::digits - 1);
  return Bits((std::bit_cast<Bits>(x) & exponent) + one);
}

/// True where every number of the arguments is finite, but for a bare number, which may be +infinity.
template <class... Args>
constexpr bool all_finite(const Args&... args) noexcept {
  std::uint64_t found = 0;  // in the sign bit of double, and in that of float
  const auto look = [&](const auto& argument) {
    if constexpr (MachineNumber<std::remove_cvref_t<decltype(argument)>>) {
      if (!(argument >= -std::numeric_limits<std::remove_cvref_t<decltype(argument)>>::max()))
        found = ~std::uint64_t{0};
    } else {
      for_each_leaf(argument, [&](const auto& leaf, Role) {
        if constexpr (MachineNumber<std::remove_cvref_t<decltype(leaf)>>) found |= not_finite_bit(leaf);
      });
    }
  };
  (look(args), ...);
  constexpr bool only_floats = (std::same_as<Rebound<Args, float>, Args> && ...);
  return (found & (only_floats ? std::uint64_t{1} << 31 : std::uint64_t{1} << 63)) == 0;
}

/// No, a miss, or a depth that is NaN.
template <class A>
constexpr A nothing() noexcept {
  if constexpr (requires(A a) { a.depth; }) {
    A answer{};
    answer.depth = std::numeric_limits<decltype(answer.depth)>::quiet_NaN();
    return answer;
  } else {
    return A{};
  }
}

/// Makes an answer nothing that is a hit with arguments that are not finite.
template <class A, class... Args>
constexpr void deny_if_invalid(A& answer, const Args&... args) noexcept {
  if constexpr (!requires { A::yes(); }) {
    if (answer.yes() && !all_finite(args...)) answer = nothing<A>();
  }
}

/// Plain arithmetic of the scalar.
struct Fast : Plain {
  template <class T>
  static constexpr bool lifts = MachineNumber<T>;

  /// Whether the tier computes in T itself, so that what was computed before in T can help it.
  template <class T>
  static constexpr bool keeps = true;

  /// Calls `text(operations, arguments...)`, the query itself.
  template <class F, class... Args>
  static constexpr auto lift(F&& text, const Args&... args) noexcept {
    auto answer = text(Plain{}, args...);
    deny_if_invalid(answer, args...);
    return answer;
  }
  /// What the tier promises of a query in T whose fast tier promises `fast`.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    return fast;
  }
};

/// Whether a tier answers a query that has a text in lanes with that text.
template <class Tier, class T>
inline constexpr bool in_lanes = std::same_as<Tier, Fast> && MachineNumber<T>;

/// Whether a tier must be sure of a decision, and counts those of which the lanes are: a query that has such a look
/// takes it before its text is computed with error bounds.
template <class Tier, class T>
inline constexpr bool looks_first = MachineNumber<T> && requires { Tier::sure(true); };

/// After rounding: a depth that became zero keeps its sign, for it decides.
template <class A>
constexpr void keep_apart(bool yes, A& answer) noexcept {
  if constexpr (requires { answer.depth; }) {
    if (!yes && answer.yes()) answer.depth = -std::numeric_limits<decltype(answer.depth)>::denorm_min();
  }
}

/// Float: the text in double, its answer rounded once. Double: the text with compensated sums of products.
struct Accurate : Compensated {
  template <class T>
  static constexpr bool lifts = MachineNumber<T>;
  template <class T>
  static constexpr bool keeps = std::same_as<T, double>;

  template <class F, class... Args>
  static constexpr auto lift(F&& text, const Args&... args) noexcept {
    using A = decltype(text(Plain{}, args...));
    if constexpr (std::same_as<A, Rebound<A, float>>) {
      const auto widened = [](const auto& argument) {
        Rebound<std::remove_cvref_t<decltype(argument)>, double> wide{};
        convert(argument, wide, [](float from, double& to) { to = from; });
        return wide;
      };
      auto wide = text(Plain{}, widened(args)...);
      deny_if_invalid(wide, args...);
      A answer{};
      convert(wide, answer, [](double from, float& to) { to = static_cast<float>(from); });
      keep_apart(wide.yes(), answer);
      if constexpr (requires {
                      answer.time;
                      A::miss();
                    }) {
        if (wide.yes() && wide.time > double(std::numeric_limits<float>::max())) return A::miss();
      }
      return answer;
    } else {
      auto answer = text(Compensated{}, args...);
      deny_if_invalid(answer, args...);
      return answer;
    }
  }

  /// In float, the text's own errors are those of the fast tier in double, 2^-29 of a float's: what
  /// remains is the last rounding, and decisions on a knife's edge. No product of eight floats leaves the
  /// range of double.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    if constexpr (std::same_as<T, float>) return {.backward = 1, .unit = 4};
    return fast;
  }
};

/// a / |a|; a itself where it is zero; NaN where a number of it is not finite.
template <class Tier, class T>
Vec3<T> unit(const Vec3<T>& a) noexcept {
  using std::sqrt, std::abs;
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
T short_of_unit(const Vec3<T>& a) noexcept {
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
Vec3<T> of_length(const Vec3<T>& a, const T& missing = T(0)) noexcept {
  if constexpr (MachineNumber<T>) {
    return a + a * ((detail::short_of_unit(a) - missing) / T(2));
  } else {
    return a;
  }
}

}  // namespace collide
