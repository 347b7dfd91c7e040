/// The kernel of box_box_penetration (collide/box_box_penetration.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/box_pair.hpp>
#include <collide/detail/box_penetration_filter.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// An axis along which two boxes overlap, with the depth and the side of box 1 on which box 2 lies (+1 or -1).
template <class T>
struct BoxContact {
  int axis;
  T depth, side;
};

/// Box 2 in the frame of box 1, with the center of box 1 as the origin and lengths not multiplied by norms.
template <class T>
struct BoxesInFrame {
  Axes<T> axes2;  ///< the axes of box 2 in the frame of box 1
  std::array<T, 3> center2;

  explicit BoxesInFrame(const BoxPair<T>& pair) {
    const T scale = pair.norm1 * pair.norm2;
    for (int j = 0; j < 3; ++j) {
      axes2[j] = Vec3<T>{pair.cosine[0][j], pair.cosine[1][j], pair.cosine[2][j]} / scale;
    }
    for (int i = 0; i < 3; ++i) center2[i] = pair.between[i] / pair.norm1;
  }
};

template <class T>
T sign_of(const T& x) {
  return x < T(0) ? T(-1) : T(1);
}

/// The midpoint of the shortest segment between an edge of box 1 and an edge of box 2: those that reach farthest along
/// the cross product of axes i and j. `unit` is that cross product as a unit vector.
template <class Tier, class T>
std::array<T, 3> contact_of_edges(const BoxPair<T>& pair, int i, int j, const CrossAxis<T>& unit, const T& side) {
  const BoxesInFrame<T> frame(pair);
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  const std::array<T, 2>&u1 = unit.in1, &u2 = unit.in2;
  const CrossAxis<T> product = pair.cross_axis(i, j, false);
  T sine = length(std::array<T, 3>{product.in1[0], product.in1[1], T(0)}) / (pair.norm1 * pair.norm2);
  if constexpr (MachineNumber<T>) sine = larger(sine, std::numeric_limits<T>::min());
  // The midpoints of both edges, and the vector from one to the other in both frames.
  std::array<T, 3> middle1{}, middle2 = frame.center2;
  middle1[i1] = pair.half1[i1] * sign_of(side * u1[0]);
  middle1[i2] = pair.half1[i2] * sign_of(side * u1[1]);
  const T offset1 = pair.half2[j1] * sign_of(side * u2[0]), offset2 = pair.half2[j2] * sign_of(side * u2[1]);
  const std::array<T, 3> b = components(frame.axes2[j]), b1 = components(frame.axes2[j1]),
                         b2 = components(frame.axes2[j2]);
  for (int k = 0; k < 3; ++k) middle2[k] = middle2[k] - (b1[k] * offset1 + b2[k] * offset2);
  const Vec3<T> d{middle2[0] - middle1[0], middle2[1] - middle1[1], middle2[2] - middle1[2]};
  const std::array<T, 3> d1 = components(d), d2 = into_frame<Tier>(frame.axes2, d);
  // The closest points of both lines, then clamped to the ends of the edges.
  const T to1 = Tier::difference_of_products(d2[j2], u2[0], d2[j1], u2[1]) / sine;
  const T to2 = Tier::difference_of_products(d1[i2], u1[0], d1[i1], u1[1]) / sine;
  const auto on_edge = [](const T& along, const T& half) { return along >= -half && along <= half; };
  T along1 = clamped(to1, -pair.half1[i], pair.half1[i]);
  const T then2 = on_edge(to1, pair.half1[i]) ? to2 : b[i] * along1 - d2[j];
  const T along2 = clamped(then2, -pair.half2[j], pair.half2[j]);
  if (!on_edge(then2, pair.half2[j])) along1 = clamped(b[i] * along2 + d1[i], -pair.half1[i], pair.half1[i]);
  middle1[i] = along1;
  std::array<T, 3> contact;
  for (int k = 0; k < 3; ++k) contact[k] = (middle1[k] + (middle2[k] + b[k] * along2)) / T(2);
  return contact;
}

/// The contact for the axis of a face: half way between a deepest vertex of the other box and the face.
template <class T>
std::array<T, 3> contact_of_face(const BoxPair<T>& pair, const BoxContact<T>& at) {
  const BoxesInFrame<T> frame(pair);
  if (at.axis < 3) {
    std::array<T, 3> vertex = frame.center2;
    for (int l = 0; l < 3; ++l) {
      const std::array<T, 3> b = components(frame.axes2[l]);
      const T offset = pair.half2[l] * sign_of(at.side * b[at.axis]);
      for (int k = 0; k < 3; ++k) vertex[k] = vertex[k] - b[k] * offset;
    }
    vertex[at.axis] = vertex[at.axis] + at.side * at.depth / T(2);
    return vertex;
  }
  const std::array<T, 3> b = components(frame.axes2[at.axis - 3]);
  std::array<T, 3> vertex;
  for (int k = 0; k < 3; ++k) {
    vertex[k] = pair.half1[k] * sign_of(at.side * b[k]) - b[k] * (at.side * at.depth / T(2));
  }
  return vertex;
}

/// The answer for boxes that are apart along an axis.
template <class T>
BoxPenetration<T> apart(const T& distance, int axis) {
  if constexpr (MachineNumber<T>) {  // a distance that underflows keeps its sign, which is the decision
    if (distance == T(0)) return {-std::numeric_limits<T>::denorm_min(), axis};
  }
  return {-distance, axis};
}

/// The answer for boxes that overlap least along an axis.
template <class Tier, class T>
BoxPenetration<T> contact_of_boxes(const Box<T>& box1, const Box<T>& box2, const BoxPair<T>& pair,
                                   const BoxContact<T>& least) {
  const Axes<T> axes1 = axes_of(box1.orientation);
  const auto to_world = [&](const std::array<T, 3>& local) { return box1.center + out_of_frame(axes1, local); };
  if (least.axis < 0) return {std::numeric_limits<T>::quiet_NaN()};  // no axis compared: NaN
  const int axis = least.axis;
  if (axis < 6) {
    const Vec3<T> along = axis < 3 ? axes1[axis] : axes_of(box2.orientation)[axis - 3];
    return {least.depth, axis, along * least.side, to_world(contact_of_face(pair, least))};
  }
  const int i = (axis - 6) / 3, j = (axis - 6) % 3;
  const CrossAxis<T> cross = pair.cross_axis(i, j);
  const T cross_length = length(std::array<T, 3>{cross.in1[0], cross.in1[1], T(0)});
  const CrossAxis<T> unit{{cross.in1[0] / cross_length, cross.in1[1] / cross_length},
                          {cross.in2[0] / cross_length, cross.in2[1] / cross_length}};
  const Vec3<T> normal = axes1[(i + 1) % 3] * unit.in1[0] + axes1[(i + 2) % 3] * unit.in1[1];
  return {least.depth, axis, normal * least.side, to_world(contact_of_edges<Tier>(pair, i, j, unit, least.side))};
}

#if defined(COLLIDE_LANES)

/// The answer for boxes that overlap least along the axis of a face, in lanes.
template <class T>
BoxPenetration<T> contact_of_face(const Box<T>& box1, const Box<T>& box2, const BoxPairInLanes<T>& pair,
                                  const BoxContact<T>& at) {
  using L = Lanes<T>;
  const L per_scale = L::splat(T(1)) / (pair.norm1 * pair.norm2), per_norm = L::splat(T(1)) / pair.norm1;
  const FrameInLanes<T> frame1(lanes(box1.orientation));
  const L side = L::splat(at.side), half_depth = side * L::splat(at.depth / T(2));
  const L sign_bit = L::splat(T(-0.0)), index = L::of(T(0), T(1), T(2), T(3));
  const std::array<L, 3> axes2 = FrameInLanes<T>::scaled(pair.relative).axes();  // in the frame of box 1, times scale
  L along, vertex;
  if (at.axis < 3) {
    along = frame1.axes()[std::size_t(at.axis)];
    const L is_axis = index == L::splat(T(at.axis));
    const std::array<T, 3> half2 = components(box2.half);
    vertex = pair.between * per_norm;
    for (std::size_t l = 0; l < 3; ++l) {  // toward the side of box 2 that is deepest in box 1
      const L toward = sum_of_three(axes2[l] & is_axis) * side;
      vertex = vertex - axes2[l] * per_scale * (L::splat(half2[l]) ^ (toward & sign_bit));
    }
    vertex = vertex + (half_depth & is_axis);
  } else {
    along = FrameInLanes<T>(lanes(box2.orientation)).axes()[std::size_t(at.axis - 3)];
    const L b = axes2[std::size_t(at.axis - 3)] * per_scale;
    vertex = (pair.half1 ^ (b * side & sign_bit)) - b * half_depth;
  }
  return {at.depth, at.axis, to_vec3(along * side), to_vec3(lanes(box1.center) + frame1.out_of(vertex))};
}

#endif

}  // namespace detail

namespace detail {

/// Whether the decision of the answer of `Fast` is exact. Let S be the sum of the magnitudes of the vector between the
/// centers and of the half extents, and u the unit roundoff. By the contract of box_box_overlap, the computed relative
/// rotation is that of a box 2 turned by 8 u, which moves its points by at most 16 u S. Along each axis of these two
/// boxes a computed gap has an error of at most 32 u S, and a depth or distance 16 u of itself. So boxes that are apart
/// are never computed to overlap by more than 64 u S, nor boxes that overlap to be apart by more.
template <class T>
bool is_certain(const BoxPenetration<T>& answer, const Box<T>& box1, const Box<T>& box2) {
  const T size = magnitudes(box2.center - box1.center) + magnitudes(box1.half) + magnitudes(box2.half);
  return is_moderate_size(size) && detail::abs(answer.depth) > T(128) * std::numeric_limits<T>::epsilon() * size;
}

}  // namespace detail

COLLIDE_COMPILED(box_box_penetration)

namespace kernels {

template <class Tier, class T>
inline BoxPenetration<T> box_box_penetration(const Box<T>& box1, const Box<T>& box2, int hint) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {  // computes all axes at once, so a hint saves nothing
    using L = detail::Lanes<T>;
    const detail::BoxPairInLanes<T> pair(box1, box2);
    const L zero = L::splat(T(0)), none = L::splat(std::numeric_limits<T>::infinity());
    std::array<detail::SeparationsInLanes<T>, 5> all;
    unsigned overlaps = 0;
    const bool good = pair.for_each_axis([&](int n, const auto& s) {
      all[std::size_t(n)] = s;
      overlaps |= unsigned((s.gap <= zero).bits() & 7) << 3 * n;
    });
    if (pair.is_valid() && good) {
      const auto number = [](const L& lanes, int bit) { return detail::to_array(lanes)[std::size_t(bit % 3)]; };
      const auto distance = [&](int bit) {
        const auto& s = all[std::size_t(bit / 3)];
        return number(s.gap, bit) / (pair.norm1.first() * detail::sqrt(number(s.length2, bit)));
      };
      const int outside = detail::first_bit(~overlaps);
      if (outside < box_box_axes) return detail::apart(distance(outside), detail::axis_of_bit(outside));
      // Comparing squares gives the same order without square roots. The cross product of parallel edges is not an
      // axis.
      const auto square = [&](int n) {
        const auto& s = all[std::size_t(n)];
        return select(zero < s.length2, s.gap * s.gap / s.length2, none);
      };
      const auto face_square = [&](int n) {  // the three axes have equal lengths
        const auto& s = all[std::size_t(n)];
        return s.gap * s.gap * broadcast_first(detail::Pair<T>::splat(T(1)) / first_pair(s.length2));
      };
      const L face1 = face_square(0), face2 = face_square(1), family0 = square(2), family1 = square(3),
              family2 = square(4);
      const L least = smallest_of_three(smaller(smaller(smaller(face1, face2), smaller(family0, family1)), family2));
      const auto bits = [&](int n, const L& squares) { return unsigned((squares == least).bits() & 7) << 3 * n; };
      const unsigned is_least =
          bits(0, face1) | bits(1, face2) | bits(2, family0) | bits(3, family1) | bits(4, family2);
      const int bit = detail::first_bit(is_least);
      using limits = std::numeric_limits<T>;
      // Squares outside the range of T cannot be compared.
      if (bit < box_box_axes && least.first() >= limits::min() / limits::epsilon() && least.first() <= limits::max()) {
        const auto& s = all[std::size_t(bit / 3)];
        const T side = detail::sign_of(number(s.toward, bit));
        const detail::BoxContact<T> at{detail::axis_of_bit(bit), T(0) - distance(bit), side};
        if (at.axis < 6) return detail::contact_of_face(box1, box2, pair, at);
        return detail::contact_of_boxes<Plain>(box1, box2, detail::BoxPair<T>(pair), at);
      }
    }
  }
  if constexpr (uses_filter<Tier, T>) {
    if (const auto answer = detail::filtered_penetration(box1, box2)) return Tier::decided_by_filter(*answer);
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(box_box_penetration, box1, box2, hint);
  } else {
    using detail::abs;
    const detail::BoxPair<T> pair(box1, box2);
    const T scale = pair.norm1 * pair.norm2;
    if constexpr (MachineNumber<T>) {  // a zero quaternion, or NaN
      if (!(scale > T(0))) return {std::numeric_limits<T>::quiet_NaN()};
    }
    const auto length_of = [&](int axis) {  // the factor by which a gap is multiplied
      if (axis < 3) return scale;
      if (axis < 6) return scale * pair.norm1;
      const auto cross = pair.cross_axis((axis - 6) / 3, (axis - 6) % 3).in1;
      return length(std::array<T, 3>{cross[0], cross[1], T(0)}) * pair.norm1;
    };
    if (hint >= 0 && hint < box_box_axes) {
      const T gap = detail::separation(pair, hint).gap;
      if (!(gap <= T(0))) return detail::apart(gap / length_of(hint), hint);
    }
    detail::BoxContact<T> least{-1, T(0), T(1)};
    for (int axis = 0; axis < box_box_axes; ++axis) {
      const detail::Separation<T> s = detail::separation(pair, axis);
      const T axis_length = length_of(axis);
      if (!(s.gap <= T(0))) return detail::apart(s.gap / axis_length, axis);
      if (axis_length == T(0)) continue;
      const T depth = -s.gap / axis_length;
      if (least.axis < 0 || depth < least.depth) least = {axis, depth, detail::sign_of(s.toward)};
    }
    return detail::contact_of_boxes<Tier>(box1, box2, pair, least);
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline BoxPenetration<T> box_box_penetration(const Box<T>& box1, const Box<T>& box2, int hint) {
  return split_answer<Tier>([&](auto tier) { return kernels::box_box_penetration<decltype(tier)>(box1, box2, hint); },
                            [&](const auto& answer) { return detail::is_certain(answer, box1, box2); });
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
