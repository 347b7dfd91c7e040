/// Truth: both points by Cramer's rule for the two orthogonality conditions; the determinant by Lagrange's identity.
#include "impl/catalogue/queries/closest_points_lines.hpp"

#include "oracles/algorithms/surface.hpp"
#include "oracles/algorithms/tuples.hpp"

namespace nearmiss::oracle {

/// Equations that every point of the line satisfies: perpendicular to the line's direction it has the line's
/// coordinates.
NumberVector<Form> forms_of(const collide::Line<Interval>& line) {
  NumberVector<Form> forms;
  for (int i = 0; i < 3; ++i) {
    Vector<Interval> axis{Interval(0), Interval(0), Interval(0)};
    axis[i] = Interval(1);
    forms.push_back({cross(vector(line.direction), axis), vector(line.point), Interval(0)});
  }
  return forms;
}

/// Reports points known only to lie on their lines.
template <class Out>
void points_on_lines(const inputs::closest_points_lines<Interval>& q, const collide::ClosestPoints<Interval>& points,
                     Out& out) {
  constexpr std::size_t point1 = begin_of<collide::ClosestPoints<double>>("point1");
  constexpr std::size_t point2 = begin_of<collide::ClosestPoints<double>>("point2");
  const Bounds on1 = ulps_from(forms_of(q.line1), point1, out), on2 = ulps_from(forms_of(q.line2), point2, out);
  out.yes(points, SetDistance{{{point1, on1}, {point2, on2}}, {std::max(on1.low, on2.low), HUGE_VAL}});
}
template <class Out>
void any_points(const inputs::closest_points_lines<Interval>& q, Out& out) {
  const Interval any(-HUGE_VAL, HUGE_VAL);
  const collide::Vec3<Interval> anywhere{any, any, any};
  points_on_lines(q, {anywhere, anywhere}, out);
}

template <class N, class Out>
void closest_points_lines(const inputs::closest_points_lines<N>& q, Out& out) {
  const Vector<N> p1 = vector(q.line1.point), d1 = vector(q.line1.direction);
  const Vector<N> p2 = vector(q.line2.point), d2 = vector(q.line2.direction);
  const Vector<N> between = minus(p2, p1);
  const N length1 = norm2(d1), length2 = norm2(d2), determinant = norm2(cross(d1, d2));
  if (may_be_zero(determinant)) {
    if constexpr (is_enclosure<N>) {
      if (!surely_zero(determinant) || may_be_zero(length2)) return any_points(q, out);
    }
    // (p1 - p2) . d2 / |d2|^2 along line 2
    return out.yes({answer_vector(p1), answer_vector(minus(p2, times(d2, N(dot(between, d2) / length2))))});
  }
  const N along1 = dot(between, d1), along2 = dot(between, d2), cosine = dot(d1, d2);
  // The same numerators with their cancellation carried out: (between x d2) . (d1 x d2), and with d1.
  const Vector<N> normal = cross(d1, d2);
  const N numerator1 = meet(N(dot(cross(between, d2), normal)), N(along1 * length2 - along2 * cosine));
  const N numerator2 = meet(N(dot(cross(between, d1), normal)), N(along1 * cosine - along2 * length1));
  const collide::ClosestPoints<N> points{answer_vector(plus(p1, times(d1, N(numerator1 / determinant)))),
                                         answer_vector(plus(p2, times(d2, N(numerator2 / determinant))))};
  if constexpr (is_enclosure<N>) {  // tightens a place that is poorly known along its line
    if (determinant.sup() > (1 + 0x1p-40) * determinant.inf()) return points_on_lines(q, points, out);
  }
  out.yes(points);
}

template <class N>
bool on_surface(const inputs::closest_points_lines<N>& q, const GivenPlace<N>& place) {
  return may_be_on_line(place, place.number == 0 ? q.line1 : q.line2);
}

NEARMISS_ORACLE(closest_points_lines)

}  // namespace nearmiss::oracle
