/// Truth: the velocity minus its projection on the normal; rational apart from one root.
#include "impl/catalogue/queries/slide_direction.hpp"

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void slide_direction(const inputs::slide_direction<N>& q, Out& out) {
  const Vector<N> v = vector(q.velocity);
  const Vector<N> to_center = plus(minus(vector(q.sphere.center), vector(q.location)), times(v, q.time));
  const N speed2 = norm2(v);
  if (may_be_zero(speed2)) {
    if (!surely_zero(speed2)) return out.everything();
    return out.yes({answer_vector(v)});
  }
  const N per_speed = N(1) / root(speed2);
  const auto answer = [&](const Vector<N>& along) {
    Vector<N> direction = times(along, per_speed);
    for (N& x : direction) x = assume_within(x, -1.0, 1.0);
    out.yes({answer_vector(direction)});
  };
  if (may_be_zero(to_center[0]) && may_be_zero(to_center[1]) && may_be_zero(to_center[2])) answer(v);
  const N length2 = norm2(to_center);
  if (!may_be_positive(length2)) return;
  if (!may_be_zero(length2)) {
    return answer(minus(v, times(to_center, N(dot(v, to_center) / length2))));
  }
  const N any = join(N(-1), N(1));  // encloses every vector of at most unit length
  out.yes({{any, any, any}});
}

NEARMISS_ORACLE(slide_direction)

}  // namespace nearmiss::oracle
