/// Truth: the plane's value at each of the eight corners.
#include "impl/catalogue/queries/box_plane_penetration.hpp"

#include "oracles/algorithms/nearest_piece.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void box_plane_penetration(const inputs::box_plane_penetration<N>& q, Out& out) {
  const Vector<N> n = vector(q.plane.normal), center = vector(q.box.center), half = vector(q.box.half);
  const auto axes = rotation_axes<N>(q.box.orientation);
  const N norm_squared = norm2(n), middle = dot(n, center) + q.plane.offset;
  if (may_be_zero(norm_squared)) return out.everything();
  const N per_norm = N(1) / root(norm_squared);
  const Vector<N> local_normal = into(axes, n);
  collide::CornerContacts<N> a;
  for (auto& corner : a.corners) corner = {N(0), {N(0), N(0), N(0)}};
  N lowest(0);
  for (int i = 0; i < 8; ++i) {
    Vector<N> local = half;
    for (int k = 0; k < 3; ++k) {
      if ((i >> k & 1) == 0) local[k] = -half[k];
    }
    const N height = middle + dot(local_normal, local);
    lowest = i == 0 ? height : N(lesser(lowest, height));
    if (!may_be_at_most_zero(height)) continue;
    const Vector<N> corner = plus(center, out_of(axes, local));
    a.corners[i] = {N(1), answer_vector(corner)};
    if (!may_be_positive(height)) continue;
    // In front or behind: the number and the point that belongs to it.
    a.corners[i].behind = join(N(0), N(1));
    a.corners[i].point = answer_vector(Vector<N>{join(N(0), corner[0]), join(N(0), corner[1]), join(N(0), corner[2])});
  }
  a.depth = -lowest * per_norm;
  if (may_be_negative(a.depth)) out.no(a, 1);
  if (!may_be_at_least_zero(a.depth)) return;
  a.normal = answer_vector(times(n, per_norm));
  out.yes(a);
}

/// A corner of the box as a contact.
template <class N>
bool on_surface(const inputs::box_plane_penetration<N>& q, const GivenPlace<N>& place) {
  return place.about.values[place.number - 1] == 0 || may_be_on_box(place, q.box);
}

NEARMISS_ORACLE(box_plane_penetration)

}  // namespace nearmiss::oracle
