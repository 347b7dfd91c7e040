/// The frame of a box: its axes in world coordinates.
#pragma once

#include <array>
#include <limits>

#include <collide/detail/lanes.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// The three unit axes of a rotation; axis[i] is the image of coordinate axis i.
template <class T>
using Axes = std::array<Vec3<T>, 3>;

/// The axes of the rotation q / |q|. The matrix is rational in q, so no square root is needed.
template <class T>
Axes<T> axes_of(const Quaternion<T>& q) {
  const T s = T(2) / (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  const T xs = q.x * s, ys = q.y * s, zs = q.z * s;
  const T wx = q.w * xs, wy = q.w * ys, wz = q.w * zs;
  const T xx = q.x * xs, xy = q.x * ys, xz = q.x * zs;
  const T yy = q.y * ys, yz = q.y * zs, zz = q.z * zs;
  return {Vec3<T>{T(1) - (yy + zz), xy + wz, xz - wy},  //
          Vec3<T>{xy - wz, T(1) - (xx + zz), yz + wx},  //
          Vec3<T>{xz + wy, yz - wx, T(1) - (xx + yy)}};
}

/// Converts a direction from world to box coordinates, and back. There is no translation.
template <class Tier, class T>
std::array<T, 3> into_frame(const Axes<T>& axes, const Vec3<T>& world) {
  return {Tier::dot(axes[0], world), Tier::dot(axes[1], world), Tier::dot(axes[2], world)};
}
template <class T>
Vec3<T> out_of_frame(const Axes<T>& axes, const std::array<T, 3>& local) {
  return axes[0] * local[0] + axes[1] * local[1] + axes[2] * local[2];
}

template <class T>
std::array<T, 3> components(const Vec3<T>& v) {
  return {v.x, v.y, v.z};
}

/// The length of a vector; it is not lost when the squares underflow.
template <class T>
T length(const std::array<T, 3>& v) {
  using detail::abs, detail::sqrt;
  const T length2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  if constexpr (MachineNumber<T>) {
    constexpr T least = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
    if (length2 < least) {
      const T largest = larger(larger(abs(v[0]), abs(v[1])), abs(v[2]));
      if (largest == T(0)) return largest;
      const T x = v[0] / largest, y = v[1] / largest, z = v[2] / largest;
      return largest * sqrt(x * x + y * y + z * z);
    }
  }
  return sqrt(length2);
}

/// The signed distance of a coordinate from the interval [-half, half]: 0 inside. NaN if either argument is NaN.
template <class T>
T excess(T coordinate, T half) {
  return larger(coordinate - half, T(0)) + smaller(coordinate + half, T(0));
}

/// The face of a box closest to a point inside the box.
template <class T>
struct NearestFace {
  int axis = 0;  ///< axis of the face's outward normal
  T side{1};     ///< sign of the outward normal: +1 or -1
  T distance{};  ///< distance from the point, not negative for a point inside
};

template <class T>
NearestFace<T> nearest_face(const std::array<T, 3>& local, const std::array<T, 3>& half) {
  using detail::abs;
  NearestFace<T> best;
  for (int i = 0; i < 3; ++i) {
    const T distance = half[i] - abs(local[i]);
    if (i == 0 || distance < best.distance) best = {i, local[i] < T(0) ? T(-1) : T(1), distance};
  }
  return best;
}

namespace detail {

/// x, y, z, w of a quaternion, multiplied by a power of two (so without rounding) if its length is so extreme that
/// products would overflow or underflow.
template <class T>
std::array<T, 4> rescaled(const Quaternion<T>& q) {
  if constexpr (MachineNumber<T>) {
    using detail::abs;
    const T largest = larger(larger(abs(q.x), abs(q.y)), larger(abs(q.z), abs(q.w)));
    const bool usable = largest > T(0) && largest <= std::numeric_limits<T>::max();
    if (usable && !(largest >= T(0.0625) && largest <= T(16))) {
      const int down = -detail::ilogb(largest);
      return {detail::ldexp(q.x, down), detail::ldexp(q.y, down), detail::ldexp(q.z, down), detail::ldexp(q.w, down)};
    }
  }
  return {q.x, q.y, q.z, q.w};
}

/// Whether a quaternion with this squared length needs no rescaling; false for NaN.
template <class T>
bool is_in_safe_range(T norm2) {
  return norm2 >= T(0.00390625) && norm2 <= T(1024);
}

}  // namespace detail

#if defined(COLLIDE_LANES)

namespace detail {

/// `rescaled` in lanes.
template <class T>
Lanes<T> rescaled_lanes(const Quaternion<T>& q) {
  const auto [x, y, z, w] = rescaled(q);
  return Lanes<T>::of(x, y, z, w);
}

/// The rotation matrix of a quaternion, and its products with vectors, in lanes.
///
/// `main_` holds the diagonal of the matrix. Each element off the diagonal is a sum or a difference of the same two
/// products: `sums_` and `differences_`, in cyclic order.
template <class T>
class FrameInLanes {
 public:
  explicit FrameInLanes(const Lanes<T>& q) {
    const Lanes<T> scaled = q * (Lanes<T>::splat(T(2)) / sum_of_four(q * q));
    const Lanes<T> squares = q * scaled;                             // xx, yy, zz
    const Lanes<T> products = yzx(q) * zxy(scaled);                  // yz, zx, xy
    const Lanes<T> w_products = q.template broadcast<3>() * scaled;  // wx, wy, wz
    main_ = Lanes<T>::splat(T(1)) - (yzx(squares) + zxy(squares));
    sums_ = products + w_products;
    differences_ = products - w_products;
  }
  /// The matrix of the rotation q / |q| times |q|^2, computed without a division.
  static FrameInLanes scaled(const Lanes<T>& q) {
    const Lanes<T> squares = q * q, twice = q + q, w = q.template broadcast<3>();
    const Lanes<T> products = yzx(q) * zxy(twice), w_products = w * twice;
    FrameInLanes frame;
    frame.main_ = (w * w - zxy(squares)) + (squares - yzx(squares));
    frame.sums_ = products + w_products;
    frame.differences_ = products - w_products;
    return frame;
  }
  /// The matrix of absolute values. Its product with half extents gives the projected half extents.
  FrameInLanes magnitudes() const {
    FrameInLanes frame;
    frame.main_ = absolute(main_);
    frame.sums_ = absolute(sums_);
    frame.differences_ = absolute(differences_);
    return frame;
  }
  Lanes<T> into(const Lanes<T>& world) const {
    return main_ * world + zxy(sums_) * yzx(world) + yzx(differences_) * zxy(world);
  }
  Lanes<T> out_of(const Lanes<T>& local) const {
    return main_ * local + zxy(differences_) * yzx(local) + yzx(sums_) * zxy(local);
  }
  /// The columns of the matrix: the axes in world coordinates.
  std::array<Lanes<T>, 3> axes() const {
    using L = Lanes<T>;
    const L x = L::mask_of_lane(0), y = L::mask_of_lane(1), z = L::mask_of_lane(2), s = yzx(sums_),
            d = zxy(differences_);
    const L mx = main_ & x, my = main_ & y, mz = main_ & z;
    return {mx | (s & y) | (d & z), (d & x) | my | (s & z), (s & x) | (d & y) | mz};
  }

 private:
  FrameInLanes() = default;
  Lanes<T> main_, sums_, differences_;
};

/// `excess` in lanes. A NaN in `half` alone is lost.
template <class T>
Lanes<T> excess(const Lanes<T>& coordinate, const Lanes<T>& half) {
  return coordinate - smaller(larger(coordinate, Lanes<T>::splat(T(0)) - half), half);
}

}  // namespace detail

#endif

}  // namespace collide

#include <collide/detail/strict_end.hpp>
