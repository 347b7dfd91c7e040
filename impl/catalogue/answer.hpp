/// An answer with its type erased, as subjects give it to the judge and processes send it to each other.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <collide/answers.hpp>

#include "impl/catalogue/break_cause.hpp"

namespace nearmiss {

/// The scalar in which a subject computes.
enum class Scalar { float32, float64 };

inline std::string_view name_of(Scalar s) { return s == Scalar::float32 ? "float" : "double"; }
/// Half the distance from 1 to the next number: 2^-24 or 2^-53.
inline double unit_roundoff(Scalar s) { return s == Scalar::float32 ? 0x1p-24 : 0x1p-53; }
inline double largest_finite(Scalar s) {
  return s == Scalar::float32 ? double(0x1.fffffep127f) : 0x1.fffffffffffffp1023;
}
/// Distance from |x| to the next larger number of the scalar.
inline double ulp(double x, Scalar s) {
  if (!std::isfinite(x)) return x;
  const int digits = s == Scalar::float32 ? 24 : 53;
  const int smallest = s == Scalar::float32 ? -149 : -1074;
  const int exponent = x == 0 ? smallest : std::max(smallest, std::ilogb(x) - (digits - 1));
  return std::ldexp(1.0, exponent);
}
inline bool representable(double x, Scalar s) { return s == Scalar::float64 || double(float(x)) == x; }

/// Trivially copyable, so that it can be passed through shared memory.
struct Answer {
  enum class Status : std::uint8_t {
    answered,
    cannot_answer,  ///< the subject has no answer to this case; never counted as a miss
    broke,          ///< exception, abort, crash, time or memory limit
  };
  static constexpr std::size_t capacity = 40;

  Status status = Status::answered;
  bool yes = false;                         ///< hit, overlap, inside
  std::uint8_t count = capacity;            ///< of `values`; the values behind them are 0
  std::uint64_t given = ~std::uint64_t{0};  ///< bit i: values[i] is part of the answer
  std::array<double, capacity> values{};    ///< in the order of the query's outputs
  std::array<char, 200> why{};              ///< the reason of cannot_answer and broke, cut to fit
  BreakCause cause = BreakCause::other;     ///< of broke

  bool late() const { return cause == BreakCause::time_limit; }
  bool gives(std::size_t i) const { return (given >> i & 1u) != 0; }
  std::string_view reason() const { return {why.data(), strnlen(why.data(), why.size())}; }

  static Answer without(Status status, std::string_view reason, BreakCause cause = BreakCause::other) {
    Answer a;
    a.status = status;
    a.cause = cause;
    a.count = 0;
    a.given = 0;
    a.explain(reason);
    return a;
  }
  /// Sets the reason, cut to fit where a character of UTF-8 ends.
  void explain(std::string_view reason) {
    std::size_t most = std::min(reason.size(), why.size() - 1);
    while (most < reason.size() && most > 0 && (reason[most] & 0xC0) == 0x80) --most;
    why.fill('\0');
    reason.copy(why.data(), most);
  }
};

/// The inputs of a query from numbers that are exact in its scalar (see representable). A list has as many entries as
/// the number before them says.
template <class Inputs>
Inputs inputs_from(const double* values) {
  Inputs q;
  collide::for_each_leaf(q, [&](auto& leaf, collide::Role) {
    using Leaf = std::remove_reference_t<decltype(leaf)>;
    leaf = static_cast<Leaf>(*values++);
  });
  return q;
}

template <class A>
Answer erase(const A& typed) {
  Answer a;
  a.yes = typed.yes();
  std::size_t i = 0;
  collide::for_each_leaf(typed, [&](const auto& leaf, collide::Role) { a.values[i++] = static_cast<double>(leaf); });
  a.count = static_cast<std::uint8_t>(i);
  return a;
}

}  // namespace nearmiss
