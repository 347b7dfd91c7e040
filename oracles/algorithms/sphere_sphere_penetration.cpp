/// Truth: the distance of the centers, one root; any normal if the centers coincide.
#include "impl/catalogue/queries/sphere_sphere_penetration.hpp"

#include "oracles/algorithms/surface.hpp"
#include "oracles/algorithms/tuples.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void sphere_sphere_penetration(const inputs::sphere_sphere_penetration<N>& q, Out& out) {
  const Vector<N> center = vector(q.sphere1.center), between = minus(vector(q.sphere2.center), center);
  const N distance2 = norm2(between), distance = root(distance2);
  const N depth = q.sphere1.radius + q.sphere2.radius - distance;
  if (may_be_negative(depth)) out.no({depth, {}, {}}, 1);
  if (!may_be_at_least_zero(depth)) return;
  const auto answer = [&](const Vector<N>& normal, const Vector<N>& contact) -> collide::Penetration<N> {
    return {depth, answer_vector(normal), answer_vector(contact)};
  };
  if (may_be_zero(distance2)) {  // any normal, with the contact that belongs to it
    constexpr std::size_t normal = begin_of<collide::Penetration<double>>("normal");
    constexpr std::size_t contact = begin_of<collide::Penetration<double>>("contact");
    return yes_to_any(NormalWithPlace<N>{Normals<N>::any(), center, q.sphere1.radius, normal, contact}, out, answer);
  }
  Vector<N> normal = times(between, N(N(1) / distance));
  for (N& x : normal) x = assume_within(x, -1.0, 1.0);
  out.yes(answer(normal, plus(center, times(normal, q.sphere1.radius))));
}

template <class N>
bool on_surface(const inputs::sphere_sphere_penetration<N>& q, const GivenPlace<N>& place) {
  return may_be_on_sphere(place, q.sphere1);
}

NEARMISS_ORACLE(sphere_sphere_penetration)

}  // namespace nearmiss::oracle
