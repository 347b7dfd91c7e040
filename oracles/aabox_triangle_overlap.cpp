/// Truth: thirteen separating axes, each with the shadows of all corners; a cross product that is zero is no
/// axis.
#include <collide/aabox_triangle_overlap.hpp>

#include "oracles/nearest_piece.hpp"

namespace nearmiss::oracle {

namespace {

/// The ends of a shadow on an axis.
template <class N>
struct Shadow {
  N low, high;
};

template <class N, std::size_t n>
Shadow<N> shadow(const Vector<N>& axis, const std::array<Vector<N>, n>& points) {
  Shadow<N> s{inner(axis, points[0]), inner(axis, points[0])};
  for (const Vector<N>& x : points) {
    const N at = inner(axis, x);
    s.low = lesser(s.low, at);
    s.high = -lesser(N(-s.high), N(-at));
  }
  return s;
}

}  // namespace

template <class N, class Out>
void aabox_triangle_overlap(const collide::inputs::aabox_triangle_overlap<N>& q, Out& out) {
  // Everything seen from a corner of the triangle.
  const Vector<N> origin = vector(q.triangle.v0), none{N(0), N(0), N(0)};
  const std::array<Vector<N>, 3> corner{none, minus(vector(q.triangle.v1), origin),
                                        minus(vector(q.triangle.v2), origin)};
  const std::array<Vector<N>, 2> ends{minus(vector(q.box.min), origin), minus(vector(q.box.max), origin)};
  std::array<Vector<N>, 8> box;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) box[i][k] = ends[i >> k & 1][k];
  }
  bool may_separate = false;
  const auto separated = [&](const Vector<N>& axis) {
    const Shadow<N> of_box = shadow(axis, box), of_triangle = shadow(axis, corner);
    may_separate = may_separate || may_be_less(of_box.high, of_triangle.low) || may_be_less(of_triangle.high, of_box.low);
    return !may_be_at_most(of_triangle.low, of_box.high) || !may_be_at_most(of_box.low, of_triangle.high);
  };
  const std::array<Vector<N>, 3> edge{corner[1], minus(corner[2], corner[1]), negated(corner[2])};
  bool surely = false;
  for (int k = 0; k < 3; ++k) {
    Vector<N> axis = none;
    axis[k] = N(1);
    surely = surely || separated(axis);
    for (int i = 0; i < 3 && !surely; ++i) surely = separated(outer(axis, edge[i]));
  }
  surely = surely || separated(outer(edge[0], edge[1]));
  if (may_separate) out.no();
  if (!surely) out.yes({true});
}

NEARMISS_ORACLE(aabox_triangle_overlap, Decision)

}  // namespace nearmiss::oracle
