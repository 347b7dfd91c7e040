/// Truth: the areas that the point forms with the edges. In a triangle without area many weights are right.
#include <collide/point_in_triangle.hpp>

#include "oracles/point_and_triangle.hpp"

namespace nearmiss::oracle {

namespace {

using Weights = std::array<Exact, 3>;

inline Interval flat_weight() { return {0, 1}; }

/// Weights of corners at x0, x1, x2 on a line that give p, which lies between them: those nearest to `given`.
/// All right ones are some of them plus a multiple of (x1 - x2, x2 - x0, x0 - x1).
inline Weights nearest_on_line(const Weights& x, const Exact& p, const Weights& given) {
  const Weights step{x[1] - x[2], x[2] - x[0], x[0] - x[1]};
  Weights w;
  for (int i = 0; i < 3; ++i) {  // some right ones: of two corners on either side of p
    const int j = (i + 1) % 3;
    const Exact across = x[j] - x[i], share = surely_zero(across) ? Exact(0) : Exact((p - x[i]) / across);
    if (surely_zero(across) || may_be_negative(share) || may_be_negative(Exact(Exact(1) - share))) continue;
    w = {Exact(0), Exact(0), Exact(0)};
    w[i] = Exact(1) - share, w[j] = share;
    break;
  }
  Exact along(0), step2(0);
  for (int i = 0; i < 3; ++i) along = along + (given[i] - w[i]) * step[i], step2 = step2 + square(step[i]);
  Exact amount = along / step2;
  for (int i = 0; i < 3; ++i) {  // as far as no weight becomes negative
    if (surely_zero(step[i])) continue;
    const Exact most = -w[i] / step[i];
    const bool from_below = may_be_positive(step[i]);
    if (from_below ? may_be_less(amount, most) : may_be_less(most, amount)) amount = most;
  }
  for (int i = 0; i < 3; ++i) w[i] = w[i] + amount * step[i];
  return w;
}

/// Where all corners are one point any weights are right: the given ones, made to be weights.
inline Weights nearest_at_point(Weights w) {
  Exact sum(0);
  for (Exact& x : w) {
    if (may_be_negative(x)) x = Exact(0);
    sum = sum + x;
  }
  if (surely_zero(sum)) return {Exact(1), Exact(0), Exact(0)};
  for (Exact& x : w) x = x / sum;
  return w;
}

/// Right weights for a point on a triangle without area.
inline Weights flat_weights(const std::array<Vector<Exact>, 3>& corner, const std::array<int, 2>& seen,
                            const Vector<Exact>& p, const Weights& given) {
  for (const int k : seen) {
    const Weights x{corner[0][k], corner[1][k], corner[2][k]};
    if (surely_zero(Exact(x[0] - x[1])) && surely_zero(Exact(x[1] - x[2]))) continue;
    return nearest_on_line(x, p[k], given);
  }
  return nearest_at_point(given);
}
inline std::array<Interval, 3> flat_weights(const std::array<Vector<Interval>, 3>&, const std::array<int, 2>&,
                                            const Vector<Interval>&, const std::array<Interval, 3>&) {
  return {flat_weight(), flat_weight(), flat_weight()};
}

}  // namespace

template <class N, class Out>
void point_in_triangle(const collide::inputs::point_in_triangle<N>& q, Out& out) {
  const std::array<Vector<N>, 3> corner{vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2)};
  const Vector<N> p = vector(q.point);
  const auto along = [&](int axis) {
    const SeenAlong<N> view(corner, axis, p);
    if (view.may_be_outside) out.no();
    if (view.may_have_area) out.yes({answer_vector<N>(view.weight), true});
    if (!view.may_be_flat) return;
    const std::array<N, 3> given{N(out.given(0)), N(out.given(1)), N(out.given(2))};
    out.yes({answer_vector<N>(flat_weights(corner, view.seen, p, given)), true});
  };
  if (q.axis >= 0) return along(q.axis);
  for_each_possible_axis(vector(q.normal), along);
}

NEARMISS_ORACLE(point_in_triangle, Containment)

}  // namespace nearmiss::oracle
