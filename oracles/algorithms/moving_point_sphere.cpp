/// Truth: the quadratic |p + v t - c|^2 = r^2, its discriminant by Lagrange's identity.
#include "impl/catalogue/queries/moving_point_sphere.hpp"

#include "oracles/algorithms/surface.hpp"
#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

namespace {

/// `outward` from the center as a unit vector; any unit vector at the center itself.
template <class N, class Out, class Impact>
void contact(Out& out, Impact impact, const Vector<N>& outward) {
  const N length2 = norm2(outward);
  if (may_be_zero(length2)) {
    impact.normal = answer_vector(outward);
    return out.yes(impact, Normals<N>::any());
  }
  impact.normal = answer_vector(times(outward, N(N(1) / root(length2))));
  out.yes(impact);
}

}  // namespace

template <class N, class Out>
void moving_point_sphere(const inputs::moving_point_sphere<N>& q, Out& out) {
  using Impact = collide::Impact<N>;
  const Vector<N> p = vector(q.point), v = vector(q.velocity), m = minus(p, vector(q.sphere.center));
  const N radius = q.sphere.radius;
  const N outside = norm2(m) - square(radius);
  const N closing = -dot(m, v), speed2 = norm2(v);
  const bool starts_in = may_be_at_most_zero(outside);
  if (starts_in && q.solid) contact(out, Impact{N(0), answer_vector(p), {}}, m);
  if (!may_be_positive(outside) && q.solid) return;
  if (may_be_zero(speed2)) out.no();
  if (!may_be_positive(speed2)) return;
  if (may_be_zero(speed2)) return out.everything();

  // speed2 t^2 - 2 closing t + outside = 0
  const N discriminant = speed2 * square(radius) - norm2(cross(m, v));
  const auto at = [&](const N& time, const Vector<N>& along, const Normals<N>& of_a_point) {
    // The point is on the surface by definition, so the normal needs no root of its own. Radius 0 has many normals.
    if (may_be_zero(radius)) {
      out.yes(Impact{time, answer_vector(plus(p, along)), {}}, of_a_point);
    } else {
      const Vector<N> normal = times(plus(m, along), N(N(1) / radius));
      out.yes(Impact{time, answer_vector(plus(p, along)), answer_vector(normal)});
    }
  };
  if (starts_in && !q.solid) {
    const N half = root(discriminant);
    const N time = assume_at_least_zero(N((closing + half) / speed2));
    at(time, times(v, time), Normals<N>::any());
  }
  if (!may_be_positive(outside)) return;
  if (may_be_at_most_zero(closing) || may_be_negative(discriminant)) out.no();
  if (!may_be_positive(closing) || !may_be_at_least_zero(discriminant)) return;
  const N half = root(discriminant);
  const N far = assume_at_least_zero(closing) + half;
  if (may_be_zero(far)) return out.everything();
  const N time = meet(N(assume_at_least_zero(outside) / far), assume_at_least_zero(N((closing - half) / speed2)));
  at(time, times(v, time), Normals<N>::any().against(v));
}

/// A start in the solid ball is a contact at the start.
template <class N>
bool on_surface(const inputs::moving_point_sphere<N>& q, const GivenPlace<N>& place) {
  return may_be_on_sphere(place, q.sphere) || (q.solid && may_be_point(place, vector(q.point)));
}

NEARMISS_ORACLE(moving_point_sphere)

}  // namespace nearmiss::oracle
