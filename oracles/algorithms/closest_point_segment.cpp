/// Truth: the minimum of a quadratic over [0, 1], by the sign of its derivative at both ends.
#include "impl/catalogue/queries/closest_point_segment.hpp"

#include "oracles/algorithms/surface.hpp"
#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void closest_point_segment(const inputs::closest_point_segment<N>& q, Out& out) {
  const Vector<N> v0 = vector(q.segment.v0), v1 = vector(q.segment.v1), p = vector(q.point);
  const Vector<N> along = minus(v1, v0);
  const N from_v0 = dot(minus(p, v0), along);  // -1/2 times the derivative at v0
  const N from_v1 = dot(minus(v1, p), along);  // 1/2 times the derivative at v1
  if (may_be_at_most_zero(from_v0)) out.yes({answer_vector(v0)});
  if (may_be_at_most_zero(from_v1)) out.yes({answer_vector(v1)});
  if (!may_be_positive(from_v0) || !may_be_positive(from_v1)) return;
  const N a = assume_at_least_zero(from_v0), b = assume_at_least_zero(from_v1);
  const N length2 = norm2(along);
  Vector<N> nearest;
  for (int i = 0; i < 3; ++i) nearest[i] = join(v0[i], v1[i]);  // between the ends in any case
  if (!may_be_zero(length2)) {
    // The weights of v1 and of v0; the nearer end gives the tighter one.
    const N share = assume_within(N(a / length2), 0.0, 1.0), rest = assume_within(N(b / length2), 0.0, 1.0);
    for (int i = 0; i < 3; ++i) {
      const N foot = meet(N(v0[i] + along[i] * share), N(v1[i] - along[i] * rest));
      nearest[i] = is_enclosure<N> ? meet(foot, nearest[i]) : foot;
    }
  }
  out.yes({answer_vector(nearest)});
}

template <class N>
bool on_surface(const inputs::closest_point_segment<N>& q, const GivenPlace<N>& place) {
  return may_be_on_segment(place, q.segment);
}

NEARMISS_ORACLE(closest_point_segment)

}  // namespace nearmiss::oracle
