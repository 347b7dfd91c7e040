/// Truth: the least squared distance from two faces, four edges and the diagonal. The signed distances from a face's
/// edges, in its plane, decide whether the foot lies in the face.
#include "impl/catalogue/queries/closest_point_rectangle.hpp"

#include "oracles/algorithms/nearest_piece.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void closest_point_rectangle(const inputs::closest_point_rectangle<N>& q, Out& out) {
  const auto& r = q.rectangle;
  const std::array<Vector<N>, 4> corner{vector(r.v0), vector(r.v1), vector(r.v2), vector(r.v3)};
  const Vector<N> p = vector(q.point);
  const FacePiece<N> face1 = face_piece(corner, {0, 2, 1}, true, p), face2 = face_piece(corner, {0, 2, 3}, true, p);
  NumberVector<Piece<N>> pieces{face1.piece, face2.piece};
  const auto edge = [&](int i, int j) { pieces.push_back(edge_piece(corner, i, j, p)); };
  if (!face1.surely_within) edge(0, 1), edge(1, 2);
  if (!face2.surely_within) edge(2, 3), edge(3, 0);
  if (!face1.surely_within && !face2.surely_within) edge(2, 0);
  for_each_nearest(pieces, [&](std::size_t, const Place<N>& place) { out.yes({answer_vector(place.point)}); });
}

template <class N>
bool on_surface(const inputs::closest_point_rectangle<N>& q, const GivenPlace<N>& place) {
  return may_be_on_rectangle(place, q.rectangle);
}

NEARMISS_ORACLE(closest_point_rectangle)

}  // namespace nearmiss::oracle
