/// The quaternions for which the errors of axes_of hold.
#pragma once

#include <limits>

#include <collide/shapes.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// Whether the squared length of the quaternion neither overflows nor loses digits to underflow.
template <class T>
bool is_accurate_rotation(const Quaternion<T>& q) {
  using limits = std::numeric_limits<T>;
  const T norm2 = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
  return norm2 >= limits::min() / limits::epsilon() && norm2 <= limits::max() / T(2);
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
