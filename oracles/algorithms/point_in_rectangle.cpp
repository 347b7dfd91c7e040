/// Truth: containment in either triangle, by the areas that the point forms with the edges.
#include "impl/catalogue/queries/point_in_rectangle.hpp"

#include "oracles/algorithms/point_and_triangle.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void point_in_rectangle(const inputs::point_in_rectangle<N>& q, Out& out) {
  const auto& r = q.rectangle;
  const Vector<N> v0 = vector(r.v0), v1 = vector(r.v1), v2 = vector(r.v2), v3 = vector(r.v3), p = vector(q.point);
  for_each_possible_axis(vector(q.normal), [&](int axis) {
    const SeenAlong<N> first({v0, v1, v2}, axis, p), second({v0, v2, v3}, axis, p);
    if (first.may_be_outside && second.may_be_outside) out.no();
    if (first.may_be_inside || second.may_be_inside) out.yes({true});
  });
}

NEARMISS_ORACLE(point_in_rectangle)

}  // namespace nearmiss::oracle
