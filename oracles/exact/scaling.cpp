#include "oracles/exact/scaling.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss::oracle {

namespace {

constexpr int of_zero = -5000;  // below the exponent of every number and of every quotient of two

int exponent_of(double x) { return x == 0 ? of_zero : std::ilogb(x); }

/// The exponent of the largest of several numbers.
int exponent_of(std::span<const double> values) {
  int largest = of_zero;
  for (const double x : values) largest = std::max(largest, exponent_of(x));
  return largest;
}

/// The exponent to remove to bring a number into the moderate range; 0 if it already is there.
int away(int exponent) { return exponent == of_zero || std::abs(exponent) < Scaling::moderate ? 0 : exponent; }

/// The number of components of a vector with that role; all are multiplied by the same power.
std::size_t length_of_vector(Role role) { return role == Role::direction ? 3 : role == Role::rotation ? 4 : 1; }

}  // namespace

Scaling Scaling::needed(std::span<const Role> roles, std::span<const double> values) {
  Scaling s;
  s.of_input_.resize(roles.size());
  int length = of_zero, velocity = of_zero, direction = 0;
  for (std::size_t i = 0; i < roles.size(); i += length_of_vector(roles[i])) {
    const int exponent = exponent_of(values.subspan(i, length_of_vector(roles[i])));
    if (roles[i] == Role::direction) direction = away(exponent);
    if (roles[i] == Role::position || roles[i] == Role::size) length = std::max(length, exponent);
    if (roles[i] == Role::offset && exponent != of_zero) length = std::max(length, exponent - direction);
    if (roles[i] == Role::velocity) velocity = std::max(velocity, exponent);
  }
  s.length_ = away(length), s.velocity_ = away(velocity);
  direction = 0;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const std::size_t n = length_of_vector(roles[i]);
    int& exponent = s.of_input_[i];
    switch (roles[i]) {
      case Role::position:
      case Role::size: exponent = -s.length_; break;
      case Role::velocity: exponent = -s.velocity_; break;
      case Role::time: exponent = s.velocity_ - s.length_; break;
      case Role::offset: exponent = -s.length_ - direction; break;  // of the plane whose normal comes before it
      case Role::direction:
      case Role::rotation:
        exponent = -away(exponent_of(values.subspan(i, n)));
        if (roles[i] == Role::direction) direction = -exponent;
        std::fill_n(&s.of_input_[i], n, exponent);
        i += n - 1;
        break;
      default: break;
    }
    s.any_ = s.any_ || exponent != 0;
  }
  return s;
}

Interval Scaling::multiplied(Interval x, int exponent) {
  constexpr int most = 1000;  // both this power and its inverse are normal numbers
  for (; exponent != 0; exponent -= std::clamp(exponent, -most, most)) {
    x = x * Interval(std::ldexp(1.0, std::clamp(exponent, -most, most)));
  }
  return x;
}

}  // namespace nearmiss::oracle
