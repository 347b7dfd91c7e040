/// The point of several pieces (the edges and faces of flat shapes) that is nearest to a given point. Shared by the
/// oracles of queries about triangles and rectangles.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

inline Interval lesser(const Interval& a, const Interval& b) {
  return {std::min(a.inf(), b.inf()), std::min(a.sup(), b.sup())};
}
inline const Exact& lesser(const Exact& a, const Exact& b) { return may_be_less(b, a) ? b : a; }

/// The number of references: the shape's vertices 0 to 3, and a rectangle's diagonal.
inline constexpr int diagonal = 4;

/// A possible nearest point of a piece. `gain[s]` is |point - s|^2 - |point - place|^2: how much nearer the place is
/// than reference s. For two places near s, gains are tighter than distances.
template <class N>
struct Place {
  Vector<N> point;
  N distance2{0};
  std::array<N, 5> gain;
};

/// An edge or a face, with its possible nearest points.
template <class N>
struct Piece {
  unsigned seen_from = 0;  ///< bit s: the gain over s is known
  bool surely = true;      ///< one of the places exists for certain; a face may have none
  NumberVector<Place<N>> places;
  Place<N> all;  ///< encloses distance and gains of every place

  bool is_seen_from(int s) const { return (seen_from >> s & 1u) != 0; }
  void add(const Place<N>& place) {
    if (places.empty()) {
      all = place;
    } else {
      all.distance2 = join(all.distance2, place.distance2);
      for (int s = 0; s < 5; ++s) {
        if (is_seen_from(s)) all.gain[s] = join(all.gain[s], place.gain[s]);
      }
    }
    places.push_back(place);
  }
};

/// The edge from corner `i` to corner `j`: its nearest point is one of the ends or the foot of the perpendicular.
/// Distances use Lagrange's identity; for an edge that may have no length, the bounding box of its ends.
template <class N, std::size_t n>
Piece<N> edge_piece(const std::array<Vector<N>, n>& corner, int i, int j, const Vector<N>& p) {
  const Vector<N>&a = corner[i], &b = corner[j];
  const Vector<N> along = minus(b, a), from_a = minus(p, a), from_b = minus(p, b);
  const N past_a = dot(from_a, along), before_b = -dot(from_b, along), length2 = norm2(along);
  const N a2 = norm2(from_a), b2 = norm2(from_b);
  Piece<N> piece;
  piece.seen_from = 1u << i | 1u << j;
  const auto add = [&](const Vector<N>& point, const N& distance2, const N& gain_a, const N& gain_b) {
    Place<N> place{point, distance2, {}};
    place.gain[i] = gain_a, place.gain[j] = gain_b;
    piece.add(place);
  };
  if (may_be_at_most_zero(past_a)) add(a, a2, N(0), N(N(2) * before_b - length2));
  if (may_be_at_most_zero(before_b)) add(b, b2, N(N(2) * past_a - length2), N(0));
  if (!may_be_positive(past_a) || !may_be_positive(before_b)) return piece;
  const N x = assume_at_least_zero(past_a), y = assume_at_least_zero(before_b);
  Vector<N> foot;
  for (int k = 0; k < 3; ++k) foot[k] = join(a[k], b[k]);  // between the ends in any case
  N distance2(0), gain_a(0), gain_b(0);
  if constexpr (is_enclosure<N>) {
    distance2 = meet(norm2(minus(p, foot)), join(N(0), lesser(a2, b2)));
    gain_a = join(N(0), lesser(a2, length2)), gain_b = join(N(0), lesser(b2, length2));
  }
  if (!may_be_zero(length2)) {
    const N share = assume_within(N(x / length2), 0.0, 1.0), rest = assume_within(N(y / length2), 0.0, 1.0);
    for (int k = 0; k < 3; ++k) {
      foot[k] = meet(meet(N(a[k] + along[k] * share), N(b[k] - along[k] * rest)), foot[k]);
    }
    distance2 = meet(N(norm2(cross(from_a, along)) / length2), distance2);
    gain_a = meet(N(square(x) / length2), gain_a);
    gain_b = meet(N(square(y) / length2), gain_b);
  }
  add(foot, distance2, gain_a, gain_b);
  return piece;
}

/// The foot of the perpendicular on the plane of three corners, if it lies in the triangle.
template <class N>
struct FacePiece {
  Piece<N> piece;
  bool surely_within = false;  ///< off all three edges, so they are further away
};

/// The foot of the perpendicular in a triangle that may have no area. The foot lies in the bounding box of the corners.
/// Along and across each edge it lies within the triangle's height over that edge, and beside the edge as the point
/// does. Empty if that is impossible.
template <class N>
std::optional<Place<N>> thin_face(const std::array<Vector<N>, 3>& v, const N& normal2, const Vector<N>& p) {
  Place<N> place;
  for (int k = 0; k < 3; ++k) place.point[k] = join(join(v[0][k], v[1][k]), v[2][k]);
  N most(0);
  for (int i = 0; i < 3; ++i) most = join(most, norm2(minus(p, v[i])));
  place.distance2 = most;
  for (int i = 0; i < 3; ++i) {
    const Vector<N> along = minus(v[(i + 1) % 3], v[i]), from = minus(p, v[i]);
    const N length2 = norm2(along);
    if (may_be_zero(length2)) continue;
    const N height = root(N(normal2 / length2)), around = join(height, N(-height));
    const N third = dot(minus(v[(i + 2) % 3], v[i]), along) / length2;
    N share = dot(from, along) / length2;
    if (!narrow(share, join(join(N(0), N(1)), third))) return std::nullopt;
    for (int k = 0; k < 3; ++k) place.point[k] = meet(N(v[i][k] + along[k] * share + around), place.point[k]);
    const N distance = assume_at_least_zero(N(root(N(norm2(cross(from, along)) / length2)) + around));
    place.distance2 = meet(square(distance), place.distance2);
  }
  place.distance2 = meet(norm2(minus(p, place.point)), place.distance2);
  return place;
}

/// `c` lists the corners. Gains are known over these corners and, if `line`, over the line through the first two.
template <class N, std::size_t n>
FacePiece<N> face_piece(const std::array<Vector<N>, n>& corner, const std::array<int, 3>& c, bool line,
                        const Vector<N>& p) {
  const std::array<Vector<N>, 3> v{corner[c[0]], corner[c[1]], corner[c[2]]};
  const Vector<N> base = minus(v[1], v[0]), normal = cross(base, minus(v[2], v[0]));
  const N normal2 = norm2(normal);
  FacePiece<N> face;
  Piece<N>& piece = face.piece;
  piece.surely = false;
  if (!may_be_positive(normal2)) return face;
  const bool has_area = !may_be_zero(normal2);
  piece.surely = face.surely_within = has_area;
  for (int i = 0; i < 3; ++i) {
    const N side = dot(cross(minus(v[(i + 1) % 3], v[i]), minus(p, v[i])), normal);
    if (!may_be_at_least_zero(side)) return piece.surely = face.surely_within = false, face;
    piece.surely = piece.surely && !may_be_negative(side);
    face.surely_within = face.surely_within && !may_be_at_most_zero(side);
  }
  Place<N> place;
  if constexpr (is_enclosure<N>) {
    const std::optional<Place<N>> thin = thin_face(v, normal2, p);
    if (!thin) return piece.surely = face.surely_within = false, face;
    place = *thin;
  }
  for (int s : c) piece.seen_from |= 1u << s;
  if (line) piece.seen_from |= 1u << diagonal;
  const Vector<N> w = minus(p, v[0]);
  if (has_area) {
    const N height = dot(normal, w);
    const Vector<N> foot = minus(p, times(normal, N(height / normal2)));
    const N distance2 = square(height) / normal2;
    for (int k = 0; k < 3; ++k) place.point[k] = is_enclosure<N> ? meet(foot[k], place.point[k]) : foot[k];
    place.distance2 = is_enclosure<N> ? meet(distance2, place.distance2) : distance2;
  }
  for (int i = 0; i < 3; ++i) {
    const Vector<N> from = minus(p, v[i]);
    N& gain = place.gain[c[i]];
    if (is_enclosure<N>) gain = assume_at_least_zero(N(norm2(from) - place.distance2));
    if (!has_area) continue;
    const N in_plane = norm2(cross(normal, from)) / normal2;
    gain = is_enclosure<N> ? meet(in_plane, gain) : in_plane;
  }
  if (line) {
    const N length2 = norm2(base);
    place.gain[diagonal] = has_area && !may_be_zero(length2)
                               ? N(square(dot(w, cross(normal, base))) / (normal2 * length2))
                               : N(join(N(0), norm2(w)));
  }
  piece.add(place);
  return face;
}

/// Calls f(piece, place) for each place that may be the nearest of all.
template <class N, class F>
void for_each_nearest(const NumberVector<Piece<N>>& pieces, F&& f) {
  const auto may_be_as_near = [](const Piece<N>& piece, const Place<N>& place, const Piece<N>& other) {
    if (!may_be_at_most(place.distance2, other.all.distance2)) return false;
    for (int s = 0; s < 5; ++s) {
      const bool both = piece.is_seen_from(s) && other.is_seen_from(s);
      if (both && !may_be_at_most(other.all.gain[s], place.gain[s])) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const Place<N>& place : pieces[i].places) {
      bool nearest = true;
      for (std::size_t j = 0; j < pieces.size() && nearest; ++j) {
        nearest = i == j || !pieces[j].surely || may_be_as_near(pieces[i], place, pieces[j]);
      }
      if (nearest) f(i, place);
    }
  }
}

/// The squared distance of the point from the union of the pieces.
template <class N>
N least_distance2(const NumberVector<Piece<N>>& pieces) {
  bool any = false;
  N least(0);
  for (const Piece<N>& piece : pieces) {
    if (!piece.surely) continue;
    least = any ? N(lesser(least, piece.all.distance2)) : piece.all.distance2;
    any = true;
  }
  for (const Piece<N>& piece : pieces) {
    if (!piece.surely && !piece.places.empty()) least = join(least, lesser(least, piece.all.distance2));
  }
  return least;
}

/// The pieces of a closed chain of edges; edge i goes from corner i to the next one.
template <class N, std::size_t n>
NumberVector<Piece<N>> perimeter(const std::array<Vector<N>, n>& corner, const Vector<N>& p) {
  NumberVector<Piece<N>> pieces;
  for (int i = 0; i < int(n); ++i) pieces.push_back(edge_piece(corner, i, (i + 1) % int(n), p));
  return pieces;
}

}  // namespace nearmiss::oracle
