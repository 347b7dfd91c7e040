/// Vectors of extended precision, so that what cancels in double keeps its digits.
#pragma once

#include <cmath>

namespace nearmiss {

struct LongVector {
  long double x = 0, y = 0, z = 0;

  long double operator[](int k) const { return k == 0 ? x : k == 1 ? y : z; }
  friend LongVector operator+(const LongVector& a, const LongVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend LongVector operator-(const LongVector& a, const LongVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend LongVector operator*(const LongVector& a, long double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend long double dot(const LongVector& a, const LongVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend LongVector cross(const LongVector& a, const LongVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend long double length(const LongVector& a) { return std::sqrt(dot(a, a)); }
};

}  // namespace nearmiss
