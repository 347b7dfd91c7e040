/// Truth: in the box's frame separating axes decide, and each face through which the point may enter gives its time.
#include "impl/catalogue/queries/moving_point_box.hpp"

#include "oracles/algorithms/point_enters_box.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_box(const inputs::moving_point_box<N>& q, Out& out) {
  report_entry<N>({vector(q.point), vector(q.velocity), q.box}, out);
}

template <class N>
bool on_surface(const inputs::moving_point_box<N>& q, const GivenPlace<N>& place) {
  return may_be_on_box(place, q.box);
}

NEARMISS_ORACLE(moving_point_box)

}  // namespace nearmiss::oracle
