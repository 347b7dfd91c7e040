/// Truth: the areas that the point forms with the edges. In a triangle without area many weights are right: those that
/// are not negative, have the sum 1 and give the point.
#include "impl/catalogue/queries/point_in_triangle.hpp"

#include "oracles/algorithms/point_and_triangle.hpp"
#include "oracles/algorithms/tuples.hpp"

namespace nearmiss::oracle {

namespace {

constexpr std::size_t weights = begin_of<collide::Containment<double>>("weights");

/// A triangle without area, projected along an axis, with the point on it.
template <class N>
struct FlatTriangle {
  const std::array<Vector<N>, 3>& corner;
  const std::array<int, 2>& seen;
  const Vector<N>& p;

  /// The corners relative to the point, along that axis.
  Vector<N> from_point(int k) const { return {corner[0][k] - p[k], corner[1][k] - p[k], corner[2][k] - p[k]}; }
};

inline Vector<Exact> weight_of_two(int i, int j, const Exact& share) {
  Vector<Exact> w{Exact(0), Exact(0), Exact(0)};
  w[i] = w[i] + Exact(1) - share, w[j] = w[j] + share;
  return w;
}

/// The ends of the segment of right weights, for corners at x on a line and the point at 0, between two corners or at
/// one. At each end one weight is zero.
inline std::vector<Vector<Exact>> ends_of_weights(const Vector<Exact>& x) {
  std::vector<Vector<Exact>> ends;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (surely_zero(x[i])) ends.push_back(weight_of_two(i, i, Exact(0)));
    if (may_be_negative(Exact(x[i] * x[j]))) ends.push_back(weight_of_two(i, j, x[i] / (x[i] - x[j])));
  }
  return ends;
}

/// The corners of the polygon of right weights.
inline std::vector<Vector<Exact>> ends_of_weights(const FlatTriangle<Exact>& t) {
  for (const int k : t.seen) {
    const Vector<Exact> x = t.from_point(k);
    if (!surely_zero(x[0]) || !surely_zero(x[1]) || !surely_zero(x[2])) return ends_of_weights(x);
  }
  return {weight_of_two(0, 0, Exact(0)), weight_of_two(1, 1, Exact(0)),
          weight_of_two(2, 2, Exact(0))};  // all corners are one point
}

template <class Out, class Make>
void yes_to_any_weights(const FlatTriangle<Exact>& t, Out& out, Make make) {
  yes_to_any_of(ends_of_weights(t), weights, out, make);
}
template <class Out, class Make>
void yes_to_any_weights(const FlatTriangle<Interval>& t, Out& out, Make make) {
  const Interval any(0, 1), zero(0);
  const Vector<Interval> origin{zero, zero, zero};
  NumberVector<Form> forms{{{Interval(1), Interval(1), Interval(1)}, origin, Interval(1)}};
  for (int i = 0; i < 3; ++i) {
    Form weight{origin, origin, any};
    weight.direction[i] = Interval(1);
    forms.push_back(weight);
  }
  for (const int k : t.seen) forms.push_back({t.from_point(k), origin, zero});
  yes_to_all_on(forms, weights, out, make({any, any, any}));
}

}  // namespace

template <class N, class Out>
void point_in_triangle(const inputs::point_in_triangle<N>& q, Out& out) {
  const std::array<Vector<N>, 3> corner{vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2)};
  const Vector<N> p = vector(q.point);
  const auto along = [&](int axis) {
    const SeenAlong<N> view(corner, axis, p);
    if (view.may_be_outside) out.no();
    if (view.may_have_area) out.yes({answer_vector<N>(view.weight), true});
    if (!view.may_be_flat) return;
    yes_to_any_weights(FlatTriangle<N>{corner, view.seen, p}, out,
                       [](const Vector<N>& weight) -> collide::Containment<N> {
                         return {answer_vector(weight), true};
                       });
  };
  if (q.axis >= 0) return along(q.axis);
  for_each_possible_axis(vector(q.normal), along);
}

NEARMISS_ORACLE(point_in_triangle)

}  // namespace nearmiss::oracle
