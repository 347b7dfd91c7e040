/// Truth: the center's distance from the box in the box's frame; inside, the least face distance.
#include "impl/catalogue/queries/sphere_box_penetration.hpp"

#include "oracles/algorithms/point_and_box.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void sphere_box_penetration(const inputs::sphere_box_penetration<N>& q, Out& out) {
  using Penetration = collide::Penetration<N>;
  const auto axes = rotation_axes<N>(q.box.orientation);
  const Vector<N> half = vector(q.box.half), center = vector(q.sphere.center);
  const Vector<N> local = into(axes, minus(center, vector(q.box.center)));

  // Outside: the normal points from the center to the nearest feature. On the surface: against any outward normal.
  for_each_possible_region(local, half, [&](const Sides& sides) {
    const FromFeature<N> from = from_feature(local, half, sides);
    const N distance = from.distance(sides);
    Penetration a{q.sphere.radius - distance, {}, {}};
    if (may_be_negative(a.depth)) out.no(a, 1);
    if (!may_be_at_least_zero(a.depth)) return;
    a.contact = answer_vector(plus(vector(q.box.center), out_of(axes, from.nearest)));
    if (may_be_zero(from.distance2)) {
      return out.yes(a, normal_cone(axes, {-sides[0], -sides[1], -sides[2]}));
    }
    Vector<N> unit = times(negated(from.away), N(N(1) / distance));
    for (N& component : unit) component = assume_within(component, -1.0, 1.0);
    a.normal = answer_vector(out_of(axes, unit));
    out.yes(a);
  });

  // Inside or on the surface: the way out through a nearest face.
  for_each_nearest_face(local, half, [&](const Face& face, const N& distance) {
    const Vector<N> normal = face.side > 0 ? negated(axes[face.axis]) : axes[face.axis];
    const Vector<N> deepest = plus(center, times(normal, N(q.sphere.radius)));
    out.yes(Penetration{q.sphere.radius + distance, answer_vector(normal), answer_vector(deepest)});
  });
}

/// The contact: the box's nearest point, or the sphere's deepest one.
template <class N>
bool on_surface(const inputs::sphere_box_penetration<N>& q, const GivenPlace<N>& place) {
  return may_be_on_box(place, q.box) || may_be_on_sphere(place, q.sphere);
}

NEARMISS_ORACLE(sphere_box_penetration)

}  // namespace nearmiss::oracle
