/// Whether a place of the answer may lie on a shape's surface. Compares the place's squared distance from the surface
/// with the slack of the place. Shared by the oracles of queries that answer with a place on a surface.
#pragma once

#include "oracles/algorithms/nearest_piece.hpp"

namespace nearmiss::oracle {

template <class N>
bool within_slack(const GivenPlace<N>& g, const N& distance2) {
  return may_be_at_most(distance2, square(g.slack));
}

template <class N>
bool may_be_point(const GivenPlace<N>& g, const Vector<N>& point) {
  return within_slack(g, norm2(minus(g.at, point)));
}

/// The squared distance of the place from a segment, or from the edges and faces of the corners.
template <class N>
N distance2_of_segment(const GivenPlace<N>& g, const Vector<N>& v0, const Vector<N>& v1) {
  return edge_piece(std::array<Vector<N>, 2>{v0, v1}, 0, 1, g.at).all.distance2;
}
template <class N, class S>
bool may_be_on_segment(const GivenPlace<N>& g, const S& s) {
  return within_slack(g, distance2_of_segment(g, vector(s.v0), vector(s.v1)));
}
template <class N, std::size_t n>
bool may_be_on_perimeter(const GivenPlace<N>& g, const std::array<Vector<N>, n>& corner) {
  return within_slack(g, least_distance2(perimeter(corner, g.at)));
}
template <class N>
bool may_be_on_corners(const GivenPlace<N>& g, const std::array<Vector<N>, 3>& corner) {
  NumberVector<Piece<N>> pieces = perimeter(corner, g.at);
  pieces.push_back(face_piece(corner, {0, 1, 2}, false, g.at).piece);
  return within_slack(g, least_distance2(pieces));
}
template <class N, class T>
bool may_be_on_triangle(const GivenPlace<N>& g, const T& t) {
  return may_be_on_corners<N>(g, {vector(t.v0), vector(t.v1), vector(t.v2)});
}
template <class N, class R>
bool may_be_on_rectangle(const GivenPlace<N>& g, const R& r) {
  return may_be_on_corners<N>(g, {vector(r.v0), vector(r.v1), vector(r.v2)}) ||
         may_be_on_corners<N>(g, {vector(r.v0), vector(r.v2), vector(r.v3)});
}

template <class N, class L>
bool may_be_on_line(const GivenPlace<N>& g, const L& l) {
  const Vector<N> along = vector(l.direction);
  return may_be_at_most(norm2(cross(minus(g.at, vector(l.point)), along)), N(square(g.slack) * norm2(along)));
}

template <class N, class P>
bool may_be_on_plane(const GivenPlace<N>& g, const P& p) {
  const Vector<N> n = vector(p.normal);
  return may_be_at_most(square(N(dot(n, g.at) + p.offset)), N(square(g.slack) * norm2(n)));
}

/// At that distance from a point or an axis: neither nearer nor further by more than the slack.
template <class N>
bool may_be_at_radius(const GivenPlace<N>& g, const N& distance2, const N& radius) {
  if (!may_be_at_most(distance2, square(N(radius + g.slack)))) return false;
  const N nearest = radius - g.slack;
  return may_be_at_most_zero(nearest) || may_be_at_most(square(assume_at_least_zero(nearest)), distance2);
}
template <class N, class S>
bool may_be_on_sphere(const GivenPlace<N>& g, const S& s) {
  return may_be_at_radius(g, norm2(minus(g.at, vector(s.center))), s.radius);
}
template <class N, class C>
bool may_be_on_capsule(const GivenPlace<N>& g, const C& c) {
  return may_be_at_radius(g, distance2_of_segment(g, vector(c.p0), vector(c.p1)), c.radius);
}

/// In the frame of { x : low <= x <= high }: near the box, and not inside by more than the slack.
template <class N>
bool may_be_on_faces(const GivenPlace<N>& g, const Vector<N>& local, const Vector<N>& low, const Vector<N>& high) {
  N distance2(0);
  bool may_reach_a_face = false;
  for (int i = 0; i < 3; ++i) {
    const N below = low[i] - local[i], above = local[i] - high[i];  // positive: outside
    N beyond(0);
    bool may_be_beyond = false;
    for (const N& e : {below, above}) {
      if (!may_be_positive(e)) continue;
      beyond = may_be_beyond ? join(beyond, N(assume_at_least_zero(e))) : N(assume_at_least_zero(e));
      may_be_beyond = true;
    }
    distance2 = distance2 + square(beyond);
    may_reach_a_face =
        may_reach_a_face || may_be_at_least_zero(N(below + g.slack)) || may_be_at_least_zero(N(above + g.slack));
  }
  return may_reach_a_face && within_slack(g, distance2);
}
template <class N, class B>
bool may_be_on_aabox(const GivenPlace<N>& g, const B& b) {
  return may_be_on_faces(g, g.at, vector(b.min), vector(b.max));
}
template <class N, class B>
bool may_be_on_box(const GivenPlace<N>& g, const B& b) {
  const Vector<N> half = vector(b.half);
  return may_be_on_faces(g, into(rotation_axes<N>(b.orientation), minus(g.at, vector(b.center))), negated(half), half);
}

}  // namespace nearmiss::oracle
