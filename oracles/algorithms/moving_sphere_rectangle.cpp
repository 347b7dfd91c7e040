/// Truth: the earlier of the first contacts with either triangle.
#include "impl/catalogue/queries/moving_sphere_rectangle.hpp"

#include "oracles/algorithms/sphere_and_triangle.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_sphere_rectangle(const inputs::moving_sphere_rectangle<N>& q, Out& out) {
  const std::array<Vector<N>, 4> v{vector(q.rectangle.v0), vector(q.rectangle.v1), vector(q.rectangle.v2),
                                   vector(q.rectangle.v3)};
  const auto with = [&](int second, int third) {
    return SphereAndTriangle<N>(vector(q.sphere.center), q.sphere.radius, vector(q.velocity),
                                {v[0], v[second], v[third]})
        .contacts();
  };
  std::array<TriangleContacts<N>, 2> both{with(1, 2), with(2, 3)};
  const double surely_by = std::min(both[0].surely_by, both[1].surely_by);
  for (const TriangleContacts<N>& one : both) {
    for (const TriangleContact<N>& c : one.list) {
      const auto earlier = [&](const TriangleContact<N>& other) {
        return may_be_less(other.impact.time, c.impact.time);
      };
      const bool later = std::any_of(both[0].list.begin(), both[0].list.end(), earlier) ||
                         std::any_of(both[1].list.begin(), both[1].list.end(), earlier);
      if (is_enclosure<N> ? bounds(c.impact.time).low > surely_by : later) continue;
      out.yes({at_most(c.impact.time, surely_by), c.impact.location, c.impact.normal}, c.normals);
    }
  }
  if (both[0].may_miss && both[1].may_miss) out.no();
}

template <class N>
bool on_surface(const inputs::moving_sphere_rectangle<N>& q, const GivenPlace<N>& place) {
  return may_be_on_rectangle(place, q.rectangle);
}

NEARMISS_ORACLE(moving_sphere_rectangle)

}  // namespace nearmiss::oracle
