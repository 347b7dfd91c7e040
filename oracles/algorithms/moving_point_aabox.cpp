/// Truth: separating axes decide; each face through which the point may enter gives its time.
#include "impl/catalogue/queries/moving_point_aabox.hpp"

#include "oracles/algorithms/ray_and_box.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_aabox(const inputs::moving_point_aabox<N>& q, Out& out) {
  using Entry = collide::Entry<N>;
  const RayAndBox<N> r{vector(q.point), vector(q.velocity), vector(q.aabox.min), vector(q.aabox.max)};
  const bool may_start_inside = may_start_in(r);
  if (may_start_inside) {
    Entry a;
    a.inside = true;
    a.location = q.point;
    out.no(a, 4);
    bool surely = true;
    for (int i = 0; i < 3; ++i) surely = surely && !may_be_less(r.at[i], r.low[i]) && !may_be_less(r.high[i], r.at[i]);
    if (surely) return;
  }
  if (may_miss(r)) out.no(Entry{}, 1);
  for_each_entry(r, [&](const N& time, const Vector<N>& place) {
    for_each_face_at(r, place, [&](int axis, int side) {
      if (!may_be_at_most_zero(N(N(side) * r.step[axis]))) return;  // the normal points along the motion
      Vector<N> normal{N(0), N(0), N(0)};
      normal[axis] = N(side);
      Entry a;
      a.location = answer_vector(place);
      a.time = time;
      a.normal = answer_vector(normal);
      out.yes(a);
    });
  });
}

template <class N>
bool on_surface(const inputs::moving_point_aabox<N>& q, const GivenPlace<N>& place) {
  return may_be_on_aabox(place, q.aabox);
}

NEARMISS_ORACLE(moving_point_aabox)

}  // namespace nearmiss::oracle
