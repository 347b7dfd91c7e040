/// Truth: the least squared distance from the face and the edges, compared with the squared radius.
#include "impl/catalogue/queries/sphere_triangle_overlap.hpp"

#include "oracles/algorithms/nearest_piece.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void sphere_triangle_overlap(const inputs::sphere_triangle_overlap<N>& q, Out& out) {
  const std::array<Vector<N>, 3> corner{vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2)};
  const Vector<N> center = vector(q.sphere.center);
  NumberVector<Piece<N>> pieces = perimeter(corner, center);
  pieces.push_back(face_piece(corner, {0, 1, 2}, false, center).piece);
  const N outside = least_distance2(pieces) - square(q.sphere.radius);
  if (may_be_positive(outside)) out.no();
  if (may_be_at_most_zero(outside)) out.yes({true});
}

NEARMISS_ORACLE(sphere_triangle_overlap)

}  // namespace nearmiss::oracle
