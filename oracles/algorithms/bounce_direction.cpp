/// Truth: the Householder reflection of the velocity's direction; rational apart from one root.
#include "impl/catalogue/queries/bounce_direction.hpp"

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void bounce_direction(const inputs::bounce_direction<N>& q, Out& out) {
  const Vector<N> v = vector(q.velocity);
  const Vector<N> to_center = plus(minus(vector(q.sphere.center), vector(q.location)), times(v, q.time));
  const N speed2 = norm2(v);
  if (may_be_zero(speed2)) {
    if (!surely_zero(speed2)) return out.everything();
    return out.yes({answer_vector(v)});
  }
  const N speed = root(speed2);
  const auto reflected = [&](const Vector<N>& u) {
    const N length2 = norm2(u);
    if (may_be_zero(length2)) return out.everything();
    const N twice = N(2) * dot(v, u) / length2;
    out.yes({answer_vector(times(minus(v, times(u, twice)), N(N(1) / speed)))});
  };
  const bool may_coincide = may_be_zero(to_center[0]) && may_be_zero(to_center[1]) && may_be_zero(to_center[2]);
  if (may_coincide) reflected(vector(q.normal));
  if (!may_coincide || may_be_positive(norm2(to_center))) reflected(to_center);
}

NEARMISS_ORACLE(bounce_direction)

}  // namespace nearmiss::oracle
