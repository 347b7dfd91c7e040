/// Truth: projections on the fifteen axes in the world frame, each divided by the axis's length; the least overlap,
/// with every vertex or pair of edges that supports the boxes along its axis.
#include "impl/catalogue/queries/box_box_penetration.hpp"

#include "oracles/algorithms/tuples.hpp"
#include "oracles/algorithms/two_boxes.hpp"

namespace nearmiss::oracle {

namespace {

constexpr int axis_count = inputs::box_box_axes;

inline Interval capped(const Interval& x, double most) { return {std::min(x.inf(), most), std::min(x.sup(), most)}; }
inline const Exact& capped(const Exact& x, double) { return x; }

/// x, clamped to [-half, half]. Both depend on the same inputs.
inline Interval clamped(const Interval& x, const Interval& half) {
  const double low = x.inf() >= 0 ? std::min(x.inf(), half.inf()) : std::max(x.inf(), -half.sup());
  const double high = x.sup() >= 0 ? std::min(x.sup(), half.sup()) : std::max(x.sup(), -half.inf());
  return {low, high};
}
inline Exact clamped(const Exact& x, const Exact& half) {
  if (may_be_less(half, x)) return half;
  if (may_be_less(x, Exact(-half))) return -half;
  return x;
}

/// Calls f(sign) for each sign that the number may have; zero has both.
template <class N, class F>
void for_each_sign(const N& x, F&& f) {
  if (may_be_at_least_zero(x)) f(1);
  if (may_be_at_most_zero(x)) f(-1);
}

template <class N, class Out>
class Penetration {
 public:
  Penetration(const TwoBoxes<N>& boxes, Out& out) : boxes_(boxes), out_(out) {
    for (int k = 0; k < axis_count; ++k) axis_[k] = PairAxis<N>(boxes, k);
    if constexpr (is_enclosure<N>) bound_depths();
  }

  void run() {
    bool surely_apart = false;
    for (int k = 0; k < axis_count; ++k) {
      const PairAxis<N>& a = axis_[k];
      surely_apart = surely_apart || !may_be_at_most_zero(a.gap);
      if (a.may_exist && may_be_positive(a.gap) && may_be_negative(a.depth)) {
        out_.no({assume_at_most_zero(a.depth), k, {}, {}}, 2);
      }
    }
    if (surely_apart) return;
    double cap = std::numeric_limits<double>::infinity();
    for (const PairAxis<N>& a : axis_) {
      if (a.must_exist) cap = std::min(cap, bounds(a.depth).high);
    }
    if (cap < 0) return;
    for (int k = 0; k < axis_count; ++k) {
      if (!axis_[k].may_exist || !may_be_at_least_zero(axis_[k].depth) || !may_be_least(k)) continue;
      const N depth = assume_at_least_zero(capped(axis_[k].depth, cap));
      if (!axis_[k].must_exist) {
        nearly_parallel(k, depth);
        continue;
      }
      for_each_sign(N(dot(boxes_.between, axis_[k].direction)), [&](int side) {
        const Vector<N> unit = times(axis_[k].direction, N(N(side) / axis_[k].length));
        if (k < 3)
          face_of_1(k, unit, depth);
        else if (k < 6)
          face_of_2(k, unit, depth);
        else
          edges(k, unit, depth);
      });
    }
  }

 private:
  /// Intersects the depth with the bounds of all depths. These also bound the depth along edges that may be parallel.
  void bound_depths() {
    const double apart = root(norm2(boxes_.between)).sup();
    N most(0);
    for (int i = 0; i < 3; ++i) most = most + boxes_.half1[i] + boxes_.half2[i];
    std::array<N, axis_count> depth;
    for (int k = 0; k < axis_count; ++k) {
      double least = std::max(least_depth(axis_[k]), -apart);
      if (k >= 6) {
        const double across = least_depth_across(boxes_, axis_, k);
        if (across >= 0)
          least = std::max(least, across);
        else if (may_be_positive(axis_[k].gap))
          least = std::max(least, -most_gap_across(boxes_, axis_, k));
      }
      const double high = axis_[k].must_exist ? std::min(axis_[k].depth.sup(), most.sup()) : most.sup();
      depth[k] = N(std::min(least, high), high);
    }
    for (int k = 0; k < axis_count; ++k) axis_[k].depth = depth[k];
  }

  bool may_be_least(int k) {
    if (!is_enclosure<N> && least_ < 0) {
      for (int other = 0; other < axis_count; ++other) {
        if (!axis_[other].may_exist) continue;
        if (least_ < 0 || may_be_less(axis_[other].depth, axis_[least_].depth)) least_ = other;
      }
    }
    if (!is_enclosure<N>) return may_be_at_most(axis_[k].depth, axis_[least_].depth);
    return std::all_of(axis_.begin(), axis_.end(), [&](const PairAxis<N>& other) {
      return !other.must_exist || may_be_at_most(axis_[k].depth, other.depth);
    });
  }

  Vector<N> middle_of(const Vector<N>& a, const Vector<N>& b) const { return times(plus(a, b), N(N(1) / N(2))); }

  /// Where a box extends furthest along a direction; `along` has the direction's components in the box's frame. It is a
  /// vertex or, if some axes of the box are perpendicular to the direction, the hull of several vertices.
  struct Furthest {
    const Vector<N>& center;
    const std::array<Vector<N>, 3>& axes;
    const Vector<N>& half;
    Vector<N> along;

    bool may_be_level(int l) const { return may_be_zero(along[l]) && may_be_positive(half[l]); }
    N end(int l) const { return may_be_negative(along[l]) ? N(-half[l]) : half[l]; }
    Vector<N> at(const std::array<N, 3>& place) const { return plus(center, out_of(axes, place)); }
  };

  /// Half way between the face and any of the points; `shift` is half the depth along the normal, away from the face.
  void face(int k, const Vector<N>& normal, const N& depth, const Furthest& furthest, const Vector<N>& shift) {
    constexpr std::size_t contact = begin_of<collide::BoxPenetration<double>>("contact");
    const auto answer = [&](const Vector<N>& point) -> collide::BoxPenetration<N> {
      return {depth, k, answer_vector(normal), answer_vector(point)};
    };
    if constexpr (is_enclosure<N>) {
      Vector<N> place;
      for (int l = 0; l < 3; ++l) {
        place[l] = may_be_zero(furthest.along[l]) ? join(furthest.half[l], N(-furthest.half[l])) : furthest.end(l);
      }
      const Vector<N> middle = plus(furthest.center, shift);
      NumberVector<Form> forms;
      for (int l = 0; l < 3; ++l) forms.push_back({furthest.axes[l], middle, place[l]});
      yes_to_all_on(forms, contact, out_, answer(plus(middle, out_of(furthest.axes, place))));
    } else {
      yes_to_any_of(hull(furthest, shift), contact, out_, answer);
    }
  }
  /// The vertices of that hull in cyclic order.
  static std::vector<Vector<N>> hull(const Furthest& f, const Vector<N>& shift) {
    std::vector<std::array<N, 3>> places{{f.end(0), f.end(1), f.end(2)}};
    for (int l = 0; l < 3; ++l) {
      if (!f.may_be_level(l)) continue;
      for (std::size_t i = places.size(); i-- > 0;) {
        places.push_back(places[i]);
        places.back()[l] = -f.half[l];
      }
    }
    std::vector<Vector<N>> corners;
    for (const auto& place : places) corners.push_back(plus(f.at(place), shift));
    return corners;
  }

  void face_of_1(int k, const Vector<N>& normal, const N& depth) {
    face(k, normal, depth, {boxes_.center2, boxes_.axes2, boxes_.half2, into(boxes_.axes2, negated(normal))},
         times(normal, N(depth / N(2))));
  }
  void face_of_2(int k, const Vector<N>& normal, const N& depth) {
    face(k, normal, depth, {boxes_.center1, boxes_.axes1, boxes_.half1, into(boxes_.axes1, normal)},
         times(normal, N(-depth / N(2))));
  }

  /// Reports every pair of edges that supports the boxes along the normal.
  void edges(int k, const Vector<N>& normal, const N& depth) {
    const int i = (k - 6) / 3, j = (k - 6) % 3;
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    for_each_sign(N(dot(normal, boxes_.axes1[i1])), [&](int s1) {
      for_each_sign(N(dot(normal, boxes_.axes1[i2])), [&](int s2) {
        const Vector<N> on1 = plus(boxes_.center1, plus(times(boxes_.axes1[i1], N(N(s1) * boxes_.half1[i1])),
                                                        times(boxes_.axes1[i2], N(N(s2) * boxes_.half1[i2]))));
        for_each_sign(N(dot(normal, boxes_.axes2[j1])), [&](int t1) {
          for_each_sign(N(dot(normal, boxes_.axes2[j2])), [&](int t2) {
            const Vector<N> on2 = minus(boxes_.center2, plus(times(boxes_.axes2[j1], N(N(t1) * boxes_.half2[j1])),
                                                             times(boxes_.axes2[j2], N(N(t2) * boxes_.half2[j2]))));
            edge_pair(k, normal, depth, on1, on2);
          });
        });
      });
    });
  }

  /// One place on each edge; `along` has the distances from the edges' middles.
  struct Places {
    N along1, along2, distance2;
    bool always;  // it is on both edges for every input
  };

  /// The nearest points of the two edges lie inside both edges or at an end of one.
  void edge_pair(int k, const Vector<N>& normal, const N& depth, const Vector<N>& on1, const Vector<N>& on2) {
    const int i = (k - 6) / 3, j = (k - 6) % 3;
    const Vector<N>&a = boxes_.axes1[i], &b = boxes_.axes2[j];
    const N &half1 = boxes_.half1[i], &half2 = boxes_.half2[j];
    const Vector<N> d = minus(on2, on1);
    const Vector<N>& product = axis_[k].direction;
    const N length2 = norm2(product), da = dot(d, a), db = dot(d, b), cosine = boxes_.cosine(i, j);
    const N along1 = dot(d, cross(b, product)) / length2, along2 = dot(d, cross(a, product)) / length2;
    const N over1 = magnitude(along1) - half1, over2 = magnitude(along2) - half2;
    std::vector<Places> places;
    const auto add = [&](const N& x, const N& y, bool always) {
      places.push_back({x, y, norm2(minus(plus(d, times(b, y)), times(a, x))), always});
    };
    const bool may_be_within = may_be_at_most_zero(over1) && may_be_at_most_zero(over2);
    const bool within = !may_be_positive(over1) && !may_be_positive(over2);
    if (may_be_within) add(clamped(along1, half1), clamped(along2, half2), within);
    if (!within) {
      for (const int sign : {-1, 1}) {
        const N end1 = N(sign) * half1, end2 = N(sign) * half2;
        add(end1, clamped(N(cosine * end1 - db), half2), true);
        add(clamped(N(cosine * end2 + da), half1), end2, true);
      }
    }
    for (const Places& p : places) {
      const bool may_be_nearest = std::all_of(places.begin(), places.end(), [&](const Places& other) {
        return !other.always || may_be_at_most(p.distance2, other.distance2);
      });
      if (!may_be_nearest) continue;
      const Vector<N> contact = middle_of(plus(on1, times(a, p.along1)), plus(on2, times(b, p.along2)));
      out_.yes({depth, k, answer_vector(normal), answer_vector(contact)});
    }
  }

  /// Edges that may be parallel: the normal is perpendicular to both, and the contact lies between them.
  void nearly_parallel(int k, const N& depth) {
    if constexpr (is_enclosure<N>) {
      const int i = (k - 6) / 3, j = (k - 6) % 3;
      Vector<N> contact = middle_of(boxes_.center1, boxes_.center2);
      for (int c = 0; c < 3; ++c) {
        N around(0);
        for (int l = 0; l < 3; ++l) {
          around = around + boxes_.half1[l] * magnitude(boxes_.axes1[l][c]) +
                   boxes_.half2[l] * magnitude(boxes_.axes2[l][c]);
        }
        contact[c] = contact[c] + around * N(-0.5, 0.5);
      }
      out_.yes({depth, k, {}, answer_vector(contact)},
               Normals<N>::cone({{boxes_.axes1[i], 0, 0}, {boxes_.axes2[j], 0, 0}}));
    }
  }

  const TwoBoxes<N>& boxes_;
  Out& out_;
  std::array<PairAxis<N>, axis_count> axis_;
  int least_ = -1;
};

}  // namespace

template <class N, class Out>
void box_box_penetration(const inputs::box_box_penetration<N>& q, Out& out) {
  const TwoBoxes<N> boxes(q.box1, q.box2);
  Penetration<N, Out>(boxes, out).run();
}

NEARMISS_ORACLE(box_box_penetration)

}  // namespace nearmiss::oracle
