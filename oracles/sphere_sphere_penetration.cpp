/// Truth: the distance of the centers, one root; any normal where they coincide.
#include <collide/sphere_sphere_penetration.hpp>

#include "oracles/outcomes.hpp"
#include "oracles/surface.hpp"

namespace nearmiss::oracle {

namespace {

/// Where the centers coincide, the contact goes with the normal: of all unit vectors the given one.
inline Vector<Exact> some_unit_vector(const Vector<Exact>& given) {
  const Exact length2 = norm2(given);
  if (surely_zero(length2)) return {Exact(1), Exact(0), Exact(0)};
  return times(given, Exact(1) / root(length2));
}
inline Vector<Interval> some_unit_vector(const Vector<Interval>&) {
  const Interval any(-1, 1);
  return {any, any, any};
}

}  // namespace

template <class N, class Out>
void sphere_sphere_penetration(const collide::inputs::sphere_sphere_penetration<N>& q, Out& out) {
  const Vector<N> center = vector(q.sphere1.center), between = minus(vector(q.sphere2.center), center);
  const N distance2 = norm2(between), distance = root(distance2);
  collide::Penetration<N> a{q.sphere1.radius + q.sphere2.radius - distance, {}, {}};
  if (may_be_negative(a.depth)) out.no(a, 1);
  if (!may_be_at_least_zero(a.depth)) return;
  const auto answer = [&](const Vector<N>& normal) {
    a.normal = answer_vector(normal);
    a.contact = answer_vector(plus(center, times(normal, q.sphere1.radius)));
    out.yes(a, may_be_zero(distance2) && is_enclosure<N> ? Normals<N>::any() : Normals<N>::as_given());
  };
  if (may_be_zero(distance2)) {
    return answer(some_unit_vector(Vector<N>{N(out.given(1)), N(out.given(2)), N(out.given(3))}));
  }
  Vector<N> normal = times(between, N(N(1) / distance));
  for (N& x : normal) x = assume_within(x, -1.0, 1.0);
  answer(normal);
}

template <class N>
bool on_surface(const collide::inputs::sphere_sphere_penetration<N>& q, const GivenPlace<N>& place) {
  return may_be_on_sphere(place, q.sphere1);
}

NEARMISS_ORACLE(sphere_sphere_penetration, Penetration)

}  // namespace nearmiss::oracle
