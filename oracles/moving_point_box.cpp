/// Truth: in the box's frame separating axes decide; each face through which the point may enter gives its
/// time.
#include <collide/moving_point_box.hpp>

#include "oracles/point_and_box.hpp"
#include "oracles/ray_and_box.hpp"
#include "oracles/residual.hpp"
#include "oracles/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_box(const collide::inputs::moving_point_box<N>& q, Out& out) {
  const auto axes = rotation_axes<N>(q.box.orientation);
  const Vector<N> origin = vector(q.box.center), half = vector(q.box.half);
  const RayAndBox<N> r{into(axes, minus(vector(q.point), origin)), into(axes, vector(q.velocity)), negated(half), half};
  const auto contact = [&](const N& time, const Vector<N>& place) {
    Vector<N> location = plus(origin, out_of(axes, place));
    if constexpr (is_enclosure<N>) {  // where the point has moved, with no box in it
      const Vector<N> point = vector(q.point), velocity = vector(q.velocity);
      if (is_moderate(time) && is_moderate(point) && is_moderate(velocity)) {
        const Vector<N> moved = plus(point, times(velocity, time));
        for (int i = 0; i < 3; ++i) location[i] = meet(location[i], moved[i]);
      }
    }
    for_each_possible_region(place, half, [&](const Sides& sides) {
      out.yes({time, answer_vector(location), {}}, normal_cone(axes, sides));
    });
  };
  if (may_start_in(r)) {
    bool may_be_strictly_in = true, may_stay = false, may_leave = true;
    bool may_be_on_surface = false;
    for (int i = 0; i < 3; ++i) {
      may_be_strictly_in = may_be_strictly_in && may_be_less(r.low[i], r.at[i]) && may_be_less(r.at[i], r.high[i]);
    }
    // A start on the surface stays where it does not move away from one of its faces.
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

template <class N>
bool on_surface(const collide::inputs::moving_point_box<N>& q, const GivenPlace<N>& place) {
  return may_be_on_box(place, q.box);
}

NEARMISS_ORACLE(moving_point_box, Impact)

}  // namespace nearmiss::oracle
