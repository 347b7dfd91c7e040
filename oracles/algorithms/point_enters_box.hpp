/// A point, or a ball of radius 0, that meets a box's surface from outside. In the box's frame separating axes decide,
/// and each face through which the point may enter gives its time. Shared by the oracles of boxes.
#pragma once

#include "oracles/algorithms/point_and_box.hpp"
#include "oracles/algorithms/ray_and_box.hpp"
#include "oracles/algorithms/residual.hpp"

namespace nearmiss::oracle {

template <class N>
struct PointAndBox {
  Vector<N> point, velocity;  // in the world frame
  std::array<Vector<N>, 3> axes;
  Vector<N> origin, half;

  template <class B>
  PointAndBox(const Vector<N>& p, const Vector<N>& v, const B& box)
      : point(p),
        velocity(v),
        axes(rotation_axes<N>(box.orientation)),
        origin(vector(box.center)),
        half(vector(box.half)) {}
};

/// Reports all right answers: the impact with every outward normal against the motion.
template <class N, class Out>
void report_entry(const PointAndBox<N>& b, Out& out) {
  const RayAndBox<N> r{into(b.axes, minus(b.point, b.origin)), into(b.axes, b.velocity), negated(b.half), b.half};
  const auto contact = [&](const N& time, const Vector<N>& place) {
    Vector<N> location = plus(b.origin, out_of(b.axes, place));
    if constexpr (is_enclosure<N>) {  // the point's place by its motion, without the box
      if (is_moderate(time) && is_moderate(b.point) && is_moderate(b.velocity)) {
        const Vector<N> moved = plus(b.point, times(b.velocity, time));
        for (int i = 0; i < 3; ++i) location[i] = meet(location[i], moved[i]);
      }
    }
    for_each_cone_at(place, b.half, [&](const Sides& sides) {
      if (may_be_met(r.step, sides)) {
        out.yes({time, answer_vector(location), {}}, normal_cone(b.axes, sides).against(b.velocity));
      }
    });
  };
  if (may_start_in(r)) {
    bool may_be_strictly_in = true, may_stay = false, may_leave = true;
    bool may_be_on_surface = false;
    for (int i = 0; i < 3; ++i) {
      may_be_strictly_in = may_be_strictly_in && may_be_less(r.low[i], r.at[i]) && may_be_less(r.at[i], r.high[i]);
    }
    // A start on the surface is a contact unless the point moves away from one of its faces.
    for_each_face_at(r, r.at, [&](int axis, int side) {
      const N away = side > 0 ? r.step[axis] : N(-r.step[axis]);
      may_be_on_surface = true;
      may_stay = may_stay || may_be_at_most_zero(away);
      if (!is_enclosure<N>) may_leave = may_leave && may_be_positive(away);
    });
    if (may_be_strictly_in || (may_be_on_surface && may_leave)) out.no();
    if (may_stay) {
      Vector<N> place = r.at;
      for (int i = 0; i < 3; ++i) {
        if constexpr (is_enclosure<N>) narrow(place[i], join(r.low[i], r.high[i]));
      }
      contact(N(0), place);
    }
    if constexpr (!is_enclosure<N>) return;
  }
  if (may_miss(r)) out.no();
  for_each_entry(r, contact);
}

}  // namespace nearmiss::oracle
