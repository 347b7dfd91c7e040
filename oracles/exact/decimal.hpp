/// Exact numbers as decimals for readers. Only the oracles' .cpp files include it.
#pragma once

#include <string>

#include "impl/catalogue/answer.hpp"
#include "oracles/exact/arithmetic.hpp"

namespace nearmiss::oracle {

/// The number of the scalar that is nearest to x; of two equally near ones the even one. Infinite where IEEE 754 rounds
/// to infinity.
double nearest_number(const Exact& x, Scalar scalar);

/// A decimal from which the nearest number of the scalar is read off: the shortest one, as for the numbers of an
/// answer. It begins with "≈" unless it is exact: x is the very number of the scalar that the decimal denotes, or the
/// decimal itself. Of a number that is no float it has the digits of the nearest double. `nearest` is nearest_number().
/// Here and below, the number that stands for +infinity (arithmetic.hpp) is "inf".
std::string decimal_of(const Exact& x, double nearest, Scalar scalar);
inline std::string decimal_of(const Exact& x, Scalar scalar) {
  return decimal_of(x, nearest_number(x, scalar), scalar);
}

/// The decimal of so many significant digits, at least 1, that is nearest to x; of two equally near ones the even one.
/// It begins with "≈" unless it is x exactly. Then it has only the digits that x needs, as "0.5"; otherwise it has all
/// of them, also zeros at the end.
std::string decimal_of_digits(const Exact& x, int digits);

}  // namespace nearmiss::oracle
