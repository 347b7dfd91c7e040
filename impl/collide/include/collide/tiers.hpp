/// The tiers: how much arithmetic a query spends on each accuracy. A tier is a policy argument; the
/// text of a query is the same in every tier.
///
/// A tier computes a text in the caller's numbers, by its own `dot` and `difference_of_products`, or it
/// lifts the query: it has the same text computed in other numbers and rounds the answer. So a text must
/// be right where numbers are real numbers: it uses + - * /, comparisons, sqrt, abs and the words of
/// number.hpp, decides by comparisons alone, and keeps what guards against rounding, overflow and
/// underflow behind `if constexpr (MachineNumber<T>)`.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include <collide/contract.hpp>
#include <collide/number.hpp>
#include <collide/vec3.hpp>

namespace collide {

/// Plain arithmetic of the scalar.
struct Fast {
  /// Whether the tier has a text with arguments of T computed in other numbers, by its `lift`.
  template <class T>
  static constexpr bool lifts = false;

  /// What the tier promises of a query in T whose fast tier promises `fast`.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    return fast;
  }

  template <class T>
  static constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  template <class T>
  static constexpr T difference_of_products(const T& a, const T& b, const T& c, const T& d) noexcept {
    return a * b - c * d;
  }
  template <class T>
  static constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x)};
  }
};

/// After rounding: a depth that became zero keeps its sign, for it decides.
template <class A>
void keep_apart(bool yes, A& answer) noexcept {
  if constexpr (requires { answer.depth; }) {
    if (!yes && answer.yes()) answer.depth = -std::numeric_limits<decltype(answer.depth)>::denorm_min();
  }
}

/// Float: the text in double, its answer rounded once. Double: plain arithmetic with sums of products that
/// cancel computed again in twice the precision.
struct Accurate : Fast {
  template <class T>
  static constexpr bool lifts = std::same_as<T, float>;

  /// In float, the text's own errors are those of the fast tier in double, 2^-29 of a float's: what
  /// remains is the last rounding, and decisions on a knife's edge. No product of eight floats leaves the
  /// range of double.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    if constexpr (lifts<T>) return {.backward = 1, .unit = 4};
    return fast;
  }

  /// Calls `text`, a query of the fast tier, with the arguments in double.
  template <class F, class... Args>
  static auto lift(F&& text, const Args&... args) noexcept {
    const auto widened = [](const auto& argument) {
      Rebound<std::remove_cvref_t<decltype(argument)>, double> wide{};
      convert(argument, wide, [](float from, double& to) { to = from; });
      return wide;
    };
    const auto wide = text(widened(args)...);
    Rebound<std::remove_cvref_t<decltype(wide)>, float> answer{};
    convert(wide, answer, [](double from, float& to) { to = static_cast<float>(from); });
    keep_apart(wide.yes(), answer);
    if constexpr (requires { answer.miss(); }) {
      if (wide.yes() && wide.time > double(std::numeric_limits<float>::max())) return decltype(answer)::miss();
    }
    return answer;
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

}  // namespace collide
