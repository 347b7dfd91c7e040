/// Truth: the plane's linear equation, then the hit point's side of each edge, measured in the plane.
#include <collide/moving_point_triangle.hpp>

#include "oracles/outcomes.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_triangle(const collide::inputs::moving_point_triangle<N>& q, Out& out) {
  const Vector<N> p = vector(q.point), v = vector(q.velocity);
  const std::array<Vector<N>, 3> corner{vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2)};
  const Vector<N> n = outer(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
  const N approach = -inner(n, v);                       // > 0: toward the front
  const N height = inner(n, minus(p, corner[0]));        // >= 0: starts in front
  if (may_be_at_most_zero(approach) || may_be_negative(height)) out.no();
  if (!may_be_positive(approach) || !may_be_at_least_zero(height)) return;
  // The line of motion passes edge i on its inner side when its moment about the edge is not negative.
  bool may_pass = true;
  for (int i = 0; i < 3; ++i) {
    const Vector<N> a = minus(corner[i], p), b = minus(corner[(i + 1) % 3], p);
    const N moment = -inner(v, outer(a, b));
    if (may_be_negative(moment)) out.no();
    may_pass = may_pass && may_be_at_least_zero(moment);
  }
  if (!may_pass) return;
  if (may_be_zero(approach) || may_be_zero(norm2(n))) return out.everything();
  const N time = assume_at_least_zero(height) / assume_at_least_zero(approach);
  out.yes({time, answer_vector(plus(p, times(v, time))), answer_vector(times(n, N(N(1) / root(norm2(n)))))});
}

NEARMISS_ORACLE(moving_point_triangle, Impact)

}  // namespace nearmiss::oracle
