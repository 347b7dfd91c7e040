/// The vertices of a core that are furthest along a direction, and what lies between them. Shared by the oracles of the
/// grid.
#pragma once

#include "oracles/algorithms/near_points.hpp"
#include "oracles/algorithms/rounded_polytopes.hpp"
#include "oracles/exact/wide.hpp"

namespace nearmiss::oracle {

using ExactVector = Vector<Exact>;
using ExactCore = Core<Exact>;
using IntervalVector = Vector<Interval>;
using IntervalCore = Core<Interval>;

inline ExactCore in_units(const ExactCore& core) { return times(Exact(Exact(1) / core.unit), core); }

/// The corners of a polygon in order. Those of a face of a box are numbered like the corners of a square: by one bit
/// for each side.
inline std::vector<ExactVector> in_order(std::vector<ExactVector> corners) {
  if (corners.size() == 4) std::swap(corners[2], corners[3]);
  return corners;
}
/// The vertices furthest along the direction, the corners of a polygon in order; of a box, if that is not across it.
inline std::vector<ExactVector> furthest(const ExactCore& core, const ExactVector& direction) {
  std::vector<ExactVector> all;
  for (const ExactVector& v : core.vertices) {
    if (!all.empty() && may_be_less(dot(direction, v), dot(direction, all.front()))) continue;
    if (!all.empty() && may_be_less(dot(direction, all.front()), dot(direction, v))) all.clear();
    all.push_back(v);
  }
  return in_order(std::move(all));
}

/// A rational vector near x, and by how much a component of it is off at most.
struct NearRational {
  RationalVector vector;
  double slack = 0;
};
inline NearRational near_rational(const ExactVector& x) {
  constexpr mpfr_prec_t bits = 256;
  NearRational near;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!x[k].is_extended()) {
      near.vector[k] = x[k].a0();
      continue;
    }
    Wide low(bits), high(bits);
    enclose(x[k], low, high);
    mpfr_get_q(near.vector[k].mpq(), low.get());
    mpfr_sub(high.get(), high.get(), low.get(), MPFR_RNDU);
    near.slack = std::max(near.slack, mpfr_get_d(high.get(), MPFR_RNDU));
  }
  return near;
}

/// The place `number` of the given answer, whose distance from x is wanted for points x near base.
template <class Out>
PointOffset offset_place(const Out& out, std::size_t number, const ExactVector& offset) {
  NearRational near = near_rational(offset);
  PointOffset p{out.given_vector(number).front(), near.vector};
  p.place.slack += near.slack;
  return p;
}

/// A box around the vertices for which `may_be` is true.
template <class MayBe>
IntervalVector hull_of(const IntervalCore& core, MayBe may_be) {
  std::optional<IntervalVector> hull;
  for (const IntervalVector& v : core.vertices) {
    if (!may_be(v)) continue;
    if (!hull) hull = v;
    for (std::size_t k = 0; k < 3; ++k) (*hull)[k] = join((*hull)[k], v[k]);
  }
  return hull.value_or(core.vertices.front());
}
inline IntervalVector within_both(const IntervalVector& a, const IntervalVector& b) {
  return {meet(a[0], b[0]), meet(a[1], b[1]), meet(a[2], b[2])};
}

/// direction / |direction|, each component as tight as the direction's are: it grows with the same component of the
/// direction, and its magnitude falls with the others.
inline IntervalVector unit_of(const IntervalVector& direction) {
  IntervalVector unit;
  for (std::size_t k = 0; k < 3; ++k) {
    const Interval &x = direction[k], others2 = square(direction[(k + 1) % 3]) + square(direction[(k + 2) % 3]);
    const auto at = [&](double end, bool upper) {
      const Interval along = of_bound(end), across2 = of_bound((end > 0) == upper ? others2.inf() : others2.sup());
      const Interval value = along / root(square(along) + across2);
      return upper ? value.sup() : value.inf();
    };
    unit[k] = Interval(at(x.inf(), false), at(x.sup(), true));
    unit[k] = assume_within(unit[k], -1.0, 1.0);
  }
  return unit;
}

/// Whether a vertex of the core may be furthest along the normal.
struct MayBeFurthest {
  const IntervalCore& core;
  const IntervalVector& normal;

  bool operator()(const IntervalVector& v) const {
    return std::none_of(core.vertices.begin(), core.vertices.end(),
                        [&](const IntervalVector& other) { return dot(normal, minus(other, v)).inf() > 0; });
  }
};

}  // namespace nearmiss::oracle
