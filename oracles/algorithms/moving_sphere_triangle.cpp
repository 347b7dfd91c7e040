/// Truth: the first contact with the face, an edge or a vertex, each in its own region.
#include "impl/catalogue/queries/moving_sphere_triangle.hpp"

#include "oracles/algorithms/sphere_and_triangle.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_sphere_triangle(const inputs::moving_sphere_triangle<N>& q, Out& out) {
  SphereAndTriangle<N> pair(vector(q.sphere.center), q.sphere.radius, vector(q.velocity),
                            {vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2)});
  constexpr std::size_t before_weights = begin_of<collide::TriangleImpact<double>>("weights");
  const TriangleContacts<N> all = pair.contacts();
  for (const TriangleContact<N>& c : all.list) {
    if (c.any_weights)
      out.yes(c.impact, c.normals, before_weights);
    else
      out.yes(c.impact, c.normals);
  }
  if (all.may_miss) out.no();
}

template <class N>
bool on_surface(const inputs::moving_sphere_triangle<N>& q, const GivenPlace<N>& place) {
  return may_be_on_triangle(place, q.triangle);
}

NEARMISS_ORACLE(moving_sphere_triangle)

}  // namespace nearmiss::oracle
