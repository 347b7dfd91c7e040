/// Truth: thirteen separating axes, each with the projections of all corners. A zero cross product is no axis.
#include "impl/catalogue/queries/aabox_triangle_overlap.hpp"

#include "oracles/algorithms/nearest_piece.hpp"

namespace nearmiss::oracle {

namespace {

/// The ends of a projection on an axis.
template <class N>
struct Shadow {
  N low, high;
};

template <class N, std::size_t n>
Shadow<N> shadow(const Vector<N>& axis, const std::array<Vector<N>, n>& points) {
  Shadow<N> s{dot(axis, points[0]), dot(axis, points[0])};
  for (const Vector<N>& x : points) {
    const N at = dot(axis, x);
    s.low = lesser(s.low, at);
    s.high = -lesser(N(-s.high), N(-at));
  }
  return s;
}

/// An axis-aligned box and a triangle, relative to a corner of the box.
template <class N>
struct BoxAndTriangle {
  Vector<N> low, high;
  std::array<Vector<N>, 8> box;
  std::array<Vector<N>, 3> corner, edge;

  static Vector<N> unit(int k) {
    Vector<N> e{N(0), N(0), N(0)};
    e[k] = N(1);
    return e;
  }
  bool surely_within(const N& x, int k) const { return !may_be_less(x, low[k]) && !may_be_less(high[k], x); }
  /// A corner, projected along axis k.
  bool surely_in_shadow(int i, int k) const {
    return surely_within(corner[i][(k + 1) % 3], (k + 1) % 3) && surely_within(corner[i][(k + 2) % 3], (k + 2) % 3);
  }
  /// Edge i, projected along axis k.
  bool surely_meets_along(int i, int k) const {
    const N &a = corner[i][k], &b = corner[(i + 1) % 3][k];
    return (!may_be_less(a, low[k]) || !may_be_less(b, low[k])) &&
           (!may_be_less(high[k], a) || !may_be_less(high[k], b));
  }
  /// Whether, projected along axis k, the line of edge i certainly meets the box, or a corner of the edge lies in the
  /// box.
  bool surely_meets_across(int i, int k) const {
    if (surely_in_shadow(i, k) || surely_in_shadow((i + 1) % 3, k)) return true;
    const Vector<N> axis = cross(unit(k), edge[i]);
    const Shadow<N> of_box = shadow(axis, box);
    const N at = dot(axis, corner[i]);
    return !may_be_less(at, of_box.low) && !may_be_less(of_box.high, at);
  }
  /// Whether the projections of the box and of an edge of the triangle along axis k meet. Then no axis perpendicular to
  /// axis k separates box and triangle, including every cross product with axis k, even with an edge parallel to axis
  /// k.
  bool surely_meet_seen_along(int k) const {
    for (int i = 0; i < 3; ++i) {
      const bool beside = surely_meets_along(i, (k + 1) % 3) && surely_meets_along(i, (k + 2) % 3);
      if (beside && surely_meets_across(i, k)) return true;
    }
    return false;
  }
  /// Whether the box meets an edge. Then no axis separates box and triangle, including the normal of a triangle that
  /// may have no area.
  bool surely_meet_at_an_edge() const {
    for (int i = 0; i < 3; ++i) {
      bool meets = true;
      for (int k = 0; k < 3; ++k) meets = meets && surely_meets_along(i, k) && surely_meets_across(i, k);
      if (meets) return true;
    }
    return false;
  }
};

}  // namespace

template <class N, class Out>
void aabox_triangle_overlap(const inputs::aabox_triangle_overlap<N>& q, Out& out) {
  BoxAndTriangle<N> both;
  const Vector<N> origin = vector(q.triangle.v0);
  both.corner = {Vector<N>{N(0), N(0), N(0)}, minus(vector(q.triangle.v1), origin),
                 minus(vector(q.triangle.v2), origin)};
  both.edge = {both.corner[1], minus(both.corner[2], both.corner[1]), negated(both.corner[2])};
  both.low = minus(vector(q.box.min), origin), both.high = minus(vector(q.box.max), origin);
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) both.box[i][k] = (i >> k & 1) != 0 ? both.high[k] : both.low[k];
  }
  bool may_separate = false;
  /// Tests one axis. Only if the axis may separate them, asks whether they certainly meet whatever the axis is.
  const auto separated = [&](const Vector<N>& axis, const auto& surely_meet) {
    const Shadow<N> of_box = shadow(axis, both.box), of_triangle = shadow(axis, both.corner);
    const bool surely = !may_be_at_most(of_triangle.low, of_box.high) || !may_be_at_most(of_box.low, of_triangle.high);
    const bool may = may_be_less(of_box.high, of_triangle.low) || may_be_less(of_triangle.high, of_box.low);
    may_separate = may_separate || surely || (may && !(is_enclosure<N> && surely_meet()));
    return surely;
  };
  bool surely = false;
  for (int k = 0; k < 3; ++k) {
    surely = surely || separated(both.unit(k), [] { return false; });
    for (int i = 0; i < 3 && !surely; ++i) {
      surely = separated(cross(both.unit(k), both.edge[i]), [&] { return both.surely_meet_seen_along(k); });
    }
  }
  surely = surely || separated(cross(both.edge[0], both.edge[1]), [&] { return both.surely_meet_at_an_edge(); });
  if (may_separate) out.no();
  if (!surely) out.yes({true});
}

NEARMISS_ORACLE(aabox_triangle_overlap)

}  // namespace nearmiss::oracle
