/// The units of the interval stage. A product of up to eight lengths stays in the range of double only if the lengths
/// are moderate. So the interval stage multiplies other lengths, velocities, directions and rotations by powers of two,
/// and multiplies the oracle's answers back. Every query allows this: roles are dimensions, and the length of a
/// direction or of a quaternion has no meaning. A number that underflows is enclosed like any other.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <collide/members.hpp>

#include "oracles/exact/arithmetic.hpp"

namespace nearmiss::oracle {

using collide::Role;

class Scaling {
 public:
  /// `roles` are those of the values. Multiplies nothing if each value is 0 or moderate.
  static Scaling of(std::span<const Role> roles, std::span<const double> values) {
    bool all = true;
    for (const double x : values) all = all && is_moderate_or_zero(x);
    return all ? Scaling{} : needed(roles, values);
  }

  bool any() const { return any_; }
  /// Converts an input number, or a bound of how far it moves, to the oracle's units.
  Interval input(std::size_t number, const Interval& x) const { return multiplied(x, of_input_[number]); }
  /// Converts a number of an answer.
  Interval to_oracle(Role role, const Interval& x) const { return multiplied(x, -of_answer(role)); }
  Interval to_answer(Role role, const Interval& x) const { return multiplied(x, of_answer(role)); }

  /// A product of eight numbers up to 2^moderate is finite, and a product of eight numbers down to 2^-moderate is
  /// normal, with room for sums.
  static constexpr int moderate = 96;

 private:
  static bool is_moderate_or_zero(double x) {
    constexpr int bias = 1023, digits = 52;
    const auto exponent = unsigned(std::bit_cast<std::uint64_t>(x) >> digits & 0x7ff);
    return exponent - unsigned(bias - moderate) < 2u * moderate || x == 0;
  }
  static Scaling needed(std::span<const Role> roles, std::span<const double> values);
  static Interval multiplied(Interval x, int exponent);
  int of_answer(Role role) const {
    switch (role) {
      case Role::position:
      case Role::size:
      case Role::depth:
      case Role::distance: return length_;
      case Role::time: return length_ - velocity_;
      default: return 0;
    }
  }

  bool any_ = false;
  int length_ = 0,
      velocity_ = 0;  ///< exponents of the powers of two by which an answer's lengths and velocities are multiplied
  /// Of each number of the input; without memory while nothing is multiplied.
  std::vector<int> of_input_;
};

}  // namespace nearmiss::oracle
