/// Truth: the signs of |m + v t|^2 - r^2 at both ends of the motion, of its derivative there, and of its discriminant.
#include "impl/catalogue/queries/moving_sphere_passes_sphere.hpp"

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_sphere_passes_sphere(const inputs::moving_sphere_passes_sphere<N>& q, Out& out) {
  const Vector<N> m = minus(vector(q.sphere.center), vector(q.fixed.center)), v = vector(q.velocity);
  const N reach2 = square(N(q.sphere.radius + q.fixed.radius));
  const N limit = assume_at_least_zero(q.limit);
  const N outside = norm2(m) - reach2;                         // at the start
  const N closing = -dot(m, v);                                // -1/2 times the derivative at the start
  const N clearance = norm2(cross(m, v)) - norm2(v) * reach2;  // <= 0: the line of motion comes within reach
  bool may_meet = may_be_at_most_zero(outside), may_miss = may_be_positive(outside);
  bool may_end_later = true, may_end_earlier = false;  // relative to the closest approach
  bool may_come_near = true;
  if (!q.forever) {
    const N outside_at_limit = norm2(plus(m, times(v, limit))) - reach2;
    const N still_closing = closing - norm2(v) * limit;
    may_meet = may_meet || may_be_at_most_zero(outside_at_limit);
    may_miss = may_miss && may_be_positive(outside_at_limit);
    may_end_later = may_be_negative(still_closing);
    may_end_earlier = may_be_at_least_zero(still_closing);
    if constexpr (is_enclosure<N>) {  // at a time on its way; tightens mostly slow motions
      const N any_time = join(N(0), limit);
      may_come_near = may_be_at_most_zero(N(norm2(plus(m, times(v, any_time))) - reach2));
    }
  }
  const bool may_meet_between = may_be_positive(closing) && may_end_later && may_be_at_most_zero(clearance);
  if (may_meet || (may_meet_between && may_come_near)) out.yes({true});
  if (may_miss && (may_be_at_most_zero(closing) || may_end_earlier || may_be_positive(clearance))) out.no();
}

NEARMISS_ORACLE(moving_sphere_passes_sphere)

}  // namespace nearmiss::oracle
