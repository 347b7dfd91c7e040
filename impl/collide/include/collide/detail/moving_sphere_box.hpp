/// The kernel of moving_sphere_box (collide/moving_sphere_box.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/point_enters_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// A point that moves past a box, in the box's frame. The squared distance to the box is a convex function of time and
/// quadratic between the times at which a coordinate crosses a face plane.
template <class Tier, class T>
struct PointPastBox {
  std::array<T, 3> at, step, half;  // position, velocity, half extents

  /// Advances the point by `time`. If `exact` is an axis, that coordinate is set to `plane`, without rounding error.
  void advance(T time, int exact, T plane) {
    for (int i = 0; i < 3; ++i) at[i] += step[i] * time;
    if (exact >= 0) at[exact] = plane;
  }
  /// The signed distance from the box along axis i. A coordinate on a face plane counts as beyond it if the motion
  /// leaves there.
  T beyond(int i) const {
    if (at[i] > half[i] || (at[i] == half[i] && step[i] > T(0))) return at[i] - half[i];
    if (at[i] < -half[i] || (at[i] == -half[i] && step[i] < T(0))) return at[i] + half[i];
    return T(0);
  }
  /// The signed distance along axis i after `time`, on the current piece. Computed from the distance now: the
  /// coordinates themselves may be so large that they lose its digits.
  T beyond_after(int i, const T& time) const {
    if (!is_beyond(i)) return T(0);
    const bool above = at[i] > half[i] || (at[i] == half[i] && step[i] > T(0));
    const T then = beyond(i) + step[i] * time;
    return above ? larger(then, T(0)) : smaller(then, T(0));
  }
  bool is_beyond(int i) const {
    return at[i] > half[i] || at[i] < -half[i] || (at[i] == half[i] && step[i] > T(0)) ||
           (at[i] == -half[i] && step[i] < T(0));
  }
  /// The next face plane that the motion crosses: its axis (-1: none), coordinate and time from now.
  struct Crossing {
    int axis = -1;
    T plane{};
    T time = std::numeric_limits<T>::infinity();
  };
  Crossing next_crossing() const {
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
  /// The first time on the current piece at which the distance to the box is `radius`; negative if there is none.
  T time_at_distance(T radius) const {
    using detail::abs, detail::sqrt;
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
    if (axes == 1) return positive_part((abs(beyond(last)) - radius) / abs(step[last]));
    if constexpr (MachineNumber<T>) {
      // The squares underflow. Within the range of the contract the motion along these axes is then far below the
      // rounding error of the velocity.
      if (!(speed2 >= std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon())) return T(-1);
    }
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
    if (outside <= T(0)) return T(0);  // rounding moved the contact to just before this piece
    return positive_part(nearest - sqrt(chord2 / speed2));
  }
  bool inside() const { return !is_beyond(0) && !is_beyond(1) && !is_beyond(2); }
  /// The face closest to a point in the box. If the point lies on faces, one of these that it does not leave. If it got
  /// into the box by rounding, on its way to a contact, the face that it entered.
  NearestFace<T> nearest_face_met(bool on_its_way) const {
    for (int i = 0; i < 3; ++i) {
      for (const T side : {T(-1), T(1)}) {
        if (at[i] == side * half[i] && side * step[i] <= T(0)) return {i, side, T(0)};
      }
    }
    if (const int axis = on_its_way ? entered_axis() : -1; axis >= 0) {
      return {axis, step[axis] > T(0) ? T(-1) : T(1), T(0)};
    }
    return nearest_face(at, half);
  }
  /// The axis of the face that the motion enters nearest to the point.
  int entered_axis() const {
    using detail::abs;
    const auto from_entry = [&](int i) { return abs(at[i] + (step[i] > T(0) ? half[i] : -half[i])); };
    int entered = -1;
    for (int i = 0; i < 3; ++i) {
      if (step[i] != T(0) && (entered < 0 || from_entry(i) < from_entry(entered))) entered = i;
    }
    return entered;
  }
  /// True if the point does not come closer. The distance is convex, so the point never will.
  bool receding() const {
    T closing(0);
    bool any = false;
    for (int i = 0; i < 3; ++i) {
      if (!is_beyond(i)) continue;
      any = true;
      closing -= step[i] * beyond(i);
    }
    return any && !(closing > T(0)) && !grazes();
  }
  /// True if a coordinate lies exactly on a face plane and leaves: its excess is zero now and grows on the next piece.
  bool grazes() const {
    for (int i = 0; i < 3; ++i) {
      if (is_beyond(i) && beyond(i) == T(0)) return true;
    }
    return false;
  }
};

}  // namespace detail

COLLIDE_COMPILED(moving_sphere_box)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_sphere_box(const Sphere<T>& sphere, const Vec3<T>& velocity, const Box<T>& box) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_sphere_box, sphere, velocity, box);
  } else {
    if (sphere.radius == T(0)) return detail::point_enters_box<Tier>(sphere.center, velocity, box);
    const Axes<T> axes = axes_of(box.orientation);
    const std::array<T, 3> half = components(box.half);
    detail::PointPastBox<Tier, T> path{into_frame<Tier>(axes, sphere.center - box.center),
                                       into_frame<Tier>(axes, velocity), half};
    // `away` is the vector from the box to the center.
    const auto contact = [&](T time, int face, std::array<T, 3> away) -> Impact<T> {
      if (!(time <= std::numeric_limits<T>::max())) return Impact<T>::miss();
      std::array<T, 3> nearest;
      for (int i = 0; i < 3; ++i) {
        nearest[i] = away[i] > T(0) ? half[i] : away[i] < T(0) ? -half[i] : clamped(path.at[i], -half[i], half[i]);
      }
      if (!(length(away) > T(0)) || face >= 0) {  // on or in the box, or moving toward one face
        const NearestFace<T> at_face = face >= 0 ? NearestFace<T>{face, path.step[face] > T(0) ? T(-1) : T(1), T(0)}
                                                 : path.nearest_face_met(MachineNumber<T> && time > T(0));
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
    if (outside < T(0)) return contact(T(0), -1, away);
    if (outside == T(0)) return closing >= T(0) ? contact(T(0), -1, away) : Impact<T>::miss();
    if (!(outside > T(0)) || !(closing > T(0))) return Impact<T>::miss();

    T elapsed(0);
    for (int piece = 0; piece < 7; ++piece) {
      const auto crossing = path.next_crossing();
      const T time = path.time_at_distance(sphere.radius);
      if (time >= T(0) && time <= crossing.time) {
        int beyond = 0, face = -1;
        for (int i = 0; i < 3; ++i) {
          away[i] = path.beyond_after(i, time);
          if (path.is_beyond(i)) ++beyond, face = i;
        }
        path.advance(time, -1, T(0));
        return contact(elapsed + time, beyond == 1 ? face : -1, away);
      }
      if (crossing.axis < 0 || path.receding()) return Impact<T>::miss();
      path.advance(crossing.time, crossing.axis, crossing.plane);
      elapsed += crossing.time;
      if (path.inside()) return contact(elapsed, crossing.axis, {});
    }
    return Impact<T>::miss();
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
