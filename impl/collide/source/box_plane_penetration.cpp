/// box_plane_penetration in the tiers of the library collide::certified.
#include <collide/box_plane_penetration.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
CornerContacts<T> box_plane_penetration(const Box<T>& box, const Plane<T>& plane) {
  return kernels::box_plane_penetration<InStages<Tier>>(box, plane);
}

template CornerContacts<float> box_plane_penetration<Certified>(const Box<float>&, const Plane<float>&);
template CornerContacts<double> box_plane_penetration<Certified>(const Box<double>&, const Plane<double>&);
template CornerContacts<float> box_plane_penetration<Decisive>(const Box<float>&, const Plane<float>&);
template CornerContacts<double> box_plane_penetration<Decisive>(const Box<double>&, const Plane<double>&);

}  // namespace collide::compiled
