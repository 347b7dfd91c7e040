/// The units of the interval stage. Doubles have products of up to eight lengths only where lengths are moderate; so
/// where an input has others, lengths, velocities, directions and rotations are multiplied by powers of two, and what
/// the oracle answers is multiplied back. Every query allows it: roles are dimensions, and the length of a direction or
/// of a quaternion means nothing. A number that underflows is enclosed as every other one.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include <collide/members.hpp>

#include "oracles/exact/arithmetic.hpp"

namespace nearmiss::oracle {

using collide::Role;

class Scaling {
 public:
  /// `roles` are those of the values. Nothing is multiplied where each of them is 0 or moderate.
  static Scaling of(std::span<const Role> roles, std::span<const double> values) {
    bool all = true;
    for (const double x : values) all = all && is_moderate_or_zero(x);
    return all ? Scaling{} : needed(roles, values);
  }

  bool any() const { return any_; }
  /// The input's number, or a bound of how far it moves, in the oracle's units.
  Interval input(std::size_t number, const Interval& x) const { return multiplied(x, of_input_[number]); }
  /// A number of an answer.
  Interval to_oracle(Role role, const Interval& x) const { return multiplied(x, -of_answer(role)); }
  Interval to_answer(Role role, const Interval& x) const { return multiplied(x, of_answer(role)); }

  /// A product of eight numbers up to 2^moderate is finite, and one of eight down to 2^-moderate is normal, with room
  /// for sums.
  static constexpr int moderate = 96;

 private:
  static constexpr std::size_t most_inputs = 40;

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
      case Role::depth: return length_;
      case Role::time: return length_ - velocity_;
      default: return 0;
    }
  }

  bool any_ = false;
  int length_ = 0, velocity_ = 0;  ///< what an answer's lengths and velocities are multiplied by, as powers of two
  std::array<int, most_inputs> of_input_{};
};

}  // namespace nearmiss::oracle
