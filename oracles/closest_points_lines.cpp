/// Truth: both points by Cramer's rule for the two right angles, the determinant by Lagrange's identity.
#include <collide/closest_points_lines.hpp>

#include "oracles/outcomes.hpp"
#include "oracles/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void closest_points_lines(const collide::inputs::closest_points_lines<N>& q, Out& out) {
  const Vector<N> p1 = vector(q.line1.point), d1 = vector(q.line1.direction);
  const Vector<N> p2 = vector(q.line2.point), d2 = vector(q.line2.direction);
  const Vector<N> between = minus(p2, p1);
  const N length1 = norm2(d1), length2 = norm2(d2), determinant = norm2(outer(d1, d2));
  if (may_be_zero(determinant)) {
    if (!surely_zero(determinant) || may_be_zero(length2)) return out.everything();
    // (p1 - p2) . d2 / |d2|^2 along line 2
    return out.yes({answer_vector(p1), answer_vector(minus(p2, times(d2, N(inner(between, d2) / length2))))});
  }
  const N along1 = inner(between, d1), along2 = inner(between, d2), cosine = inner(d1, d2);
  // The same numerators with their cancellation done beforehand: (between x d2) . (d1 x d2), and with d1.
  const Vector<N> normal = outer(d1, d2);
  const N numerator1 = meet(N(inner(outer(between, d2), normal)), N(along1 * length2 - along2 * cosine));
  const N numerator2 = meet(N(inner(outer(between, d1), normal)), N(along1 * cosine - along2 * length1));
  out.yes({answer_vector(plus(p1, times(d1, N(numerator1 / determinant)))),
           answer_vector(plus(p2, times(d2, N(numerator2 / determinant))))});
}

template <class N>
bool on_surface(const collide::inputs::closest_points_lines<N>& q, const GivenPlace<N>& place) {
  return may_be_on_line(place, place.number == 0 ? q.line1 : q.line2);
}

NEARMISS_ORACLE(closest_points_lines, ClosestPoints)

}  // namespace nearmiss::oracle
