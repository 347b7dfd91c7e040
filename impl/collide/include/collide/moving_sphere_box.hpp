/// When and where a moving sphere meets a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/frame.hpp>
#include <collide/point_enters_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

namespace detail {

/// A point that moves past a box, both in the box's frame. The squared distance to the box is convex
/// along the motion and quadratic between the times at which a coordinate crosses a face plane.
template <class Tier, class T>
struct PointPastBox {
  std::array<T, 3> at, step, half;  // position, velocity, half extents

  /// Moves on by `time`; a coordinate that reaches the face plane `exact` lands on it exactly.
  void advance(T time, int exact, T plane) noexcept {
    for (int i = 0; i < 3; ++i) at[i] += step[i] * time;
    if (exact >= 0) at[exact] = plane;
  }
  /// Beyond the box along axis i, seen from the moving point: a coordinate on a face plane counts as
  /// beyond when it is about to leave.
  T beyond(int i) const noexcept {
    if (at[i] > half[i] || (at[i] == half[i] && step[i] > T(0))) return at[i] - half[i];
    if (at[i] < -half[i] || (at[i] == -half[i] && step[i] < T(0))) return at[i] + half[i];
    return T(0);
  }
  bool is_beyond(int i) const noexcept {
    return at[i] > half[i] || at[i] < -half[i] || (at[i] == half[i] && step[i] > T(0)) ||
           (at[i] == -half[i] && step[i] < T(0));
  }
  /// The next face plane that the motion crosses: axis (-1: none), plane, time from now.
  struct Crossing {
    int axis = -1;
    T plane{};
    T time = std::numeric_limits<T>::infinity();
  };
  Crossing next_crossing() const noexcept {
    Crossing next;
    for (int i = 0; i < 3; ++i) {
      if (step[i] == T(0)) continue;
      const bool up = step[i] > T(0);
      const T near = up ? -half[i] : half[i];
      const T plane = (up ? near > at[i] : near < at[i]) ? near : -near;
      if (!(up ? plane > at[i] : plane < at[i])) continue;
      const T time = (plane - at[i]) / step[i];
      if (time < next.time) next = {i, plane, time};
    }
    return next;
  }
  /// The first time at which the distance to the box, on the present piece, is `radius`; negative
  /// when the piece never comes that near.
  T time_at_distance(T radius) const noexcept {
    using std::sqrt, std::abs;
    T speed2(0), closing(0);
    int axes = 0, last = 0;
    for (int i = 0; i < 3; ++i) {
      if (!is_beyond(i)) continue;
      const T e = beyond(i);
      speed2 += step[i] * step[i];
      closing -= step[i] * e;
      ++axes, last = i;
    }
    if (!(closing > T(0))) return T(-1);
    if (axes == 1) return not_negative((abs(beyond(last)) - radius) / abs(step[last]));
    const T nearest = closing / speed2;
    Vec3<T> offset{}, from_box{};
    const auto set = [](Vec3<T>& v, int i, const T& x) { (i == 0 ? v.x : i == 1 ? v.y : v.z) = x; };
    for (int i = 0; i < 3; ++i) {
      if (!is_beyond(i)) continue;
      set(from_box, i, beyond(i));
      set(offset, i, beyond(i) + step[i] * nearest);
    }
    const T chord2 = -Tier::beyond_radius(offset, radius);
    if (!(chord2 >= T(0))) return T(-1);
    const T outside = Tier::beyond_radius(from_box, radius);
    if (outside <= T(0)) return T(0);  // rounding put the contact just before this piece
    return not_negative(nearest - sqrt(chord2 / speed2));
  }
  bool inside() const noexcept { return !is_beyond(0) && !is_beyond(1) && !is_beyond(2); }
  /// The face nearest to a point in the box; of those on which it lies, one that it does not leave.
  NearestFace<T> nearest_face_met() const noexcept {
    for (int i = 0; i < 3; ++i) {
      for (const T side : {T(-1), T(1)}) {
        if (at[i] == side * half[i] && side * step[i] <= T(0)) return {i, side, T(0)};
      }
    }
    return nearest_face(at, half);
  }
  /// True while the point comes no nearer: the distance is convex, so it never will.
  bool receding() const noexcept {
    T closing(0);
    bool any = false;
    for (int i = 0; i < 3; ++i) {
      if (!is_beyond(i)) continue;
      any = true;
      closing -= step[i] * beyond(i);
    }
    return any && !(closing > T(0)) && !grazes();
  }
  /// A coordinate exactly on a face plane has no excess yet, though the piece ahead has one.
  bool grazes() const noexcept {
    for (int i = 0; i < 3; ++i) {
      if (is_beyond(i) && beyond(i) == T(0)) return true;
    }
    return false;
  }
};

}  // namespace detail

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the solid `box`.
///
/// An overlap at the start is a contact at time 0; so is a touch at the start unless the sphere
/// leaves. A sphere of radius 0 whose center starts strictly inside never comes from outside: a miss.
/// Location is the point of the box nearest to the center at that time or, for a center inside the
/// box, the nearest point of its surface.
///
/// 1. |center + velocity * time - location| == radius, but for an overlap at the start
/// 2. normal points from location to the center, or outward for a center inside; for a center on the surface it is that
///    of a face, and not along the motion unless that leaves the box
///
/// Source: in the box's frame the squared distance of the center is a convex piecewise quadratic of
/// time; its first root is found piece by piece (at most seven). A sphere of radius 0 is a point (moving_point_box).
template <class Tier = Fast, class T>
Impact<T> moving_sphere_box(const Sphere<T>& sphere, const Vec3<T>& velocity, const Box<T>& box) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return moving_sphere_box<decltype(by)>(a...); }, sphere, velocity,
                      box);
  }
  if (sphere.radius == T(0)) return detail::point_enters_box<Tier>(sphere.center, velocity, box);
  const Axes<T> axes = axes_of(box.orientation);
  const std::array<T, 3> half = components(box.half);
  detail::PointPastBox<Tier, T> path{into_frame<Tier>(axes, sphere.center - box.center),
                                     into_frame<Tier>(axes, velocity), half};
  const auto contact = [&](T time, int face) -> Impact<T> {
    if (!(time <= std::numeric_limits<T>::max())) return Impact<T>::miss();
    std::array<T, 3> nearest, away;
    for (int i = 0; i < 3; ++i) {
      nearest[i] = clamped(path.at[i], -half[i], half[i]);
      away[i] = excess(path.at[i], half[i]);
    }
    if (!(length(away) > T(0)) || face >= 0) {  // on or in the box, or on the way to one face
      const NearestFace<T> at_face =
          face >= 0 ? NearestFace<T>{face, path.step[face] > T(0) ? T(-1) : T(1), T(0)} : path.nearest_face_met();
      away = {};
      away[at_face.axis] = at_face.side;
      nearest[at_face.axis] = at_face.side * half[at_face.axis];
    }
    const Vec3<T> outward = unit<Tier>(Vec3<T>{away[0], away[1], away[2]});
    return {time, box.center + out_of_frame(axes, nearest), out_of_frame(axes, components(outward))};
  };

  T closing(0);
  std::array<T, 3> away;
  for (int i = 0; i < 3; ++i) {
    away[i] = excess(path.at[i], half[i]);
    closing -= away[i] * path.step[i];
  }
  const Vec3<T> from_box{away[0], away[1], away[2]};
  const T outside = Tier::beyond_radius(from_box, sphere.radius);
  if (outside < T(0)) return contact(T(0), -1);
  if (outside == T(0)) return closing >= T(0) ? contact(T(0), -1) : Impact<T>::miss();
  if (!(outside > T(0)) || !(closing > T(0))) return Impact<T>::miss();

  T elapsed(0);
  for (int piece = 0; piece < 7; ++piece) {
    const auto crossing = path.next_crossing();
    const T time = path.time_at_distance(sphere.radius);
    if (time >= T(0) && time <= crossing.time) {
      int beyond = 0, face = -1;
      for (int i = 0; i < 3; ++i) {
        if (path.is_beyond(i)) ++beyond, face = i;
      }
      path.advance(time, -1, T(0));
      return contact(elapsed + time, beyond == 1 ? face : -1);
    }
    if (crossing.axis < 0 || path.receding()) return Impact<T>::miss();
    path.advance(crossing.time, crossing.axis, crossing.plane);
    elapsed += crossing.time;
    if (path.inside()) return contact(elapsed, crossing.axis);
  }
  return Impact<T>::miss();
}

namespace contracts {

/// First order, G the largest position: an axis carries 16 eps (7 in each product of the quaternion, at
/// most two of them, and the sums), so a coordinate in the box frame 19 eps of the distance, which is at
/// most 4 G; the walk to the contact and the way back to the world add as much as 12 eps of 4 G. Unit:
/// the axes are combined by a unit vector.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_box() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
