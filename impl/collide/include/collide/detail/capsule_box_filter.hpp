/// Filter of Certified for the overlap of a box with a segment or a capsule: in doubles, and where these leave a doubt
/// in double-words.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>

#include <collide/detail/double_word.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// A capsule in the frame of a box, in numbers of W, whose operations have an error of u.
///
/// Let S be the sum of the magnitudes of the half extents, and of the coordinates of both ends relative to the box's
/// center. A coordinate in the frame has an error of 20 u S, as in sphere_box_overlap, and a place on the axis one of
/// 24 u S, whatever the error of its parameter. So the way from the box to this place has one of 24 sqrt(3) u S, and 8
/// u S by its own rounding; so has, times |n|, the gap between the vertices along any direction n. `error` is twice
/// that.
template <class W>
class CapsuleInFrame {
 public:
  template <class T>
  CapsuleInFrame(const Capsule<T>& capsule, const Box<T>& box)
      : half_(components(wide(box.half))), radius_(capsule.radius) {
    const auto& [x, y, z, w] = box.orientation;
    const Axes<W> axes = axes_of(Quaternion<W>{W(x), W(y), W(z), W(w)});
    const Vec3<W> from = wide(capsule.p0) - wide(box.center), to = wide(capsule.p1) - wide(box.center);
    start_ = into_frame<Plain>(axes, from), end_ = into_frame<Plain>(axes, to);
    for (std::size_t k = 0; k < 3; ++k) along_[k] = end_[k] - start_[k];
    size_ = size(from) + size(to) + size(wide(box.half));
  }

  std::optional<bool> overlap() const {
    if (!(size_ >= 0x1p-200 && size_ <= 0x1p200 && radius_ >= 0 && radius_ <= 0x1p200)) return std::nullopt;
    const double error = 128 * u * size_;
    const W radius = W(radius_), doubt = W(error + 16 * u * radius_);  // their sum in double would lose the doubt
    if (is_inside(middle_of_crossing(), W(error))) return true;
    const std::array<W, 3> way = way_at(nearest_parameter());
    const W length2 = dot(way, way), sure = radius - doubt;
    if (W(0x1p-300) <= sure && length2 <= sure * sure) return true;
    const W first = dot(way, start_), last = dot(way, end_);
    W gap = last < first ? last : first;
    for (std::size_t k = 0; k < 3; ++k) gap = gap - abs(way[k]) * half_[k];
    if (W(0x1p-600) <= length2 && gap > sqrt(length2) * (radius + doubt)) return false;
    return std::nullopt;
  }

 private:
  static constexpr double u = std::same_as<W, double> ? 0x1p-53 : 0x1p-99;

  template <class T>
  static Vec3<W> wide(const Vec3<T>& v) {
    return {W(v.x), W(v.y), W(v.z)};
  }
  static double size(const Vec3<W>& v) {
    return detail::abs(leading_part(v.x)) + detail::abs(leading_part(v.y)) + detail::abs(leading_part(v.z));
  }
  static W dot(const std::array<W, 3>& a, const std::array<W, 3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static W within(const W& x, const W& low, const W& high) { return x < low ? low : high < x ? high : x; }

  W coordinate(std::size_t k, const W& parameter) const { return start_[k] + along_[k] * parameter; }
  /// From the nearest point of the box to the place on the axis.
  std::array<W, 3> way_at(const W& parameter) const {
    std::array<W, 3> way;
    for (std::size_t k = 0; k < 3; ++k) {
      const W x = coordinate(k, parameter);
      way[k] = x - within(x, -half_[k], half_[k]);
    }
    return way;
  }
  /// The parameter in the middle of the part of the axis inside the box; any other where there is none.
  W middle_of_crossing() const {
    W enter = W(0.0), exit = W(1.0);
    for (std::size_t k = 0; k < 3; ++k) {
      if (along_[k] == W(0.0)) continue;
      const W one = (-half_[k] - start_[k]) / along_[k], other = (half_[k] - start_[k]) / along_[k];
      const bool forth = one < other;
      const W first = forth ? one : other, last = forth ? other : one;
      enter = enter < first ? first : enter, exit = last < exit ? last : exit;
    }
    return within((enter + exit) * W(0.5), W(0.0), W(1.0));
  }
  bool is_inside(const W& parameter, const W& margin) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(abs(coordinate(k, parameter)) + margin <= half_[k])) return false;
    }
    return true;
  }
  /// Half the derivative of the squared distance from the box by the parameter: it grows, and is linear between the
  /// parameters at which the axis crosses the plane of a face.
  W slope_at(const W& parameter) const { return dot(way_at(parameter), along_); }
  W nearest_parameter() const {
    W low = W(0.0), high = W(1.0), slope_low = slope_at(low), slope_high = slope_at(high);
    if (W(0.0) <= slope_low) return low;
    if (slope_high <= W(0.0)) return high;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const W& face : {-half_[k], half_[k]}) {
        const W parameter = (face - start_[k]) / along_[k];
        if (!(low < parameter && parameter < high)) continue;
        const W slope = slope_at(parameter);
        if (slope < W(0.0)) {
          low = parameter, slope_low = slope;
        } else {
          high = parameter, slope_high = slope;
        }
      }
    }
    return within(low + (high - low) * (slope_low / (slope_low - slope_high)), low, high);
  }

  std::array<W, 3> half_, start_, end_, along_;
  double radius_, size_;
};

/// Whether they meet; nullopt if rounding may change the decision.
template <class T>
std::optional<bool> filtered_overlap(const Capsule<T>& capsule, const Box<T>& box) {
  const auto& [x, y, z, w] = box.orientation;
  const double norm2 = double(x) * double(x) + double(y) * double(y) + double(z) * double(z) + double(w) * double(w);
  if (!(norm2 >= 0x1p-900 && norm2 <= 0x1p900)) return std::nullopt;
  const auto decided = CapsuleInFrame<double>(capsule, box).overlap();
  return decided ? decided : CapsuleInFrame<DoubleWord<double>>(capsule, box).overlap();
}
template <class T>
std::optional<bool> filtered_overlap(const Segment<T>& segment, const Box<T>& box) {
  return filtered_overlap(Capsule<T>{segment.v0, segment.v1, T(0)}, box);
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
