/// Truth: the minimum over the motion of the squared distance from the box, a convex function of time, compared with
/// the squared radius. Exact stage: the minimum lies at an end of the motion, where a coordinate crosses a face plane,
/// or at the minimum of the quadratic of one of the 26 regions around the box; the distances at all these times are
/// tried. Interval stage: the distance at any time is an upper bound. The tangent at that time, with the signs of the
/// slope on both sides, gives a lower bound.
#include "impl/catalogue/queries/moving_sphere_passes_box.hpp"

#include "oracles/algorithms/first_contact.hpp"
#include "oracles/algorithms/point_and_box.hpp"

namespace nearmiss::oracle {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The center in the box's frame.
template <class N>
struct Path {
  Vector<N> start, step, half;
};

inline Exact excess(const Exact& x, const Exact& half) {
  if (may_be_less(half, x)) return x - half;
  if (may_be_less(x, Exact(-half))) return x + half;
  return Exact(0);
}
inline Interval excess(const Interval& x, const Interval& half) {
  return assume_at_least_zero(x - half) + assume_at_most_zero(x + half);
}

template <class N>
Vector<N> beyond_at(const Path<N>& path, const N& time) {
  Vector<N> e;
  for (int i = 0; i < 3; ++i) e[i] = excess(N(path.start[i] + path.step[i] * time), path.half[i]);
  return e;
}

/// Whether the center is ever within the radius, from time 0 to `limit` (empty: without limit).
bool passes(const Path<Exact>& path, const Exact& radius2, const std::optional<Exact>& limit) {
  std::vector<Exact> times;
  times.reserve(2 + 6 + 26);  // the start, the limit, the faces' planes, and each region outside of the box
  times.emplace_back(0);
  if (limit) times.push_back(*limit);
  for (int i = 0; i < 3; ++i) {
    if (may_be_zero(path.step[i])) continue;
    times.push_back((path.half[i] - path.start[i]) / path.step[i]);
    times.push_back((-path.half[i] - path.start[i]) / path.step[i]);
  }
  for_each_region([&](const Sides& sides) {
    Exact along(0), speed2(0);
    for (int i = 0; i < 3; ++i) {
      if (sides[i] == 0) continue;
      along = along + path.step[i] * (path.start[i] - Exact(sides[i]) * path.half[i]);
      speed2 = speed2 + square(path.step[i]);
    }
    if (!may_be_zero(speed2)) times.push_back(-along / speed2);
  });
  return std::any_of(times.begin(), times.end(), [&](const Exact& t) {
    if (may_be_negative(t) || (limit && may_be_less(*limit, t))) return false;
    return may_be_at_most(norm2(beyond_at(path, t)), radius2);
  });
}

/// A time near that of the least distance. Plain doubles locate it, so the time itself proves nothing.
double time_of_least_distance(const Path<Interval>& path, double limit) {
  double at[3], step[3], half[3];
  const auto middle = [](const Interval& x) { return 0.5 * x.inf() + 0.5 * x.sup(); };
  NumberVector<double> crossings;
  for (int i = 0; i < 3; ++i) {
    at[i] = middle(path.start[i]), step[i] = middle(path.step[i]), half[i] = middle(path.half[i]);
    for (const int side : {-1, 1}) {
      const double t = step[i] != 0 ? (side * half[i] - at[i]) / step[i] : -1;
      if (t > 0 && t < infinity) crossings.push_back(t);
    }
  }
  const auto slope = [&](double t) {
    double s = 0;
    for (int i = 0; i < 3; ++i) {
      const double x = at[i] + step[i] * t;
      s += step[i] * (x - std::clamp(x, -half[i], half[i]));
    }
    return s;
  };
  std::sort(crossings.begin(), crossings.end());
  // If the center passes through the box, the middle of that time range is the safest choice.
  const auto within = [&](double t) {
    bool all = true;
    for (int i = 0; i < 3; ++i) all = all && std::abs(at[i] + step[i] * t) <= half[i];
    return all;
  };
  double begin = 0, longest = 0, surest = -1;
  for (const double crossing : crossings) {
    const double end = std::min(crossing, limit), half_way = 0.5 * begin + 0.5 * end;
    if (end - begin > longest && within(half_way)) longest = end - begin, surest = half_way;
    begin = end;
  }
  if (surest >= 0) return surest;
  double from = 0, slope_from = slope(0);
  if (slope_from >= 0) return 0;
  for (const double to : crossings) {
    const double slope_to = slope(to);
    if (slope_to >= 0) {
      return std::min(limit, std::clamp(from - slope_from * ((to - from) / (slope_to - slope_from)), from, to));
    }
    from = to, slope_from = slope_to;
  }
  double speed2 = 0;  // past all crossings every moving coordinate is beyond the box
  for (const double v : step) speed2 += v * v;
  const double last = speed2 > 0 ? from - slope_from / speed2 : from;
  return std::min(last < infinity ? last : from, limit);
}

/// A lower bound of the squared distance from time 0 to `limit`.
double least_distance2(const Path<Interval>& path, double near, double limit) {
  const auto slope_at = [&](double t) { return dot(path.step, beyond_at(path, of_bound(t))); };
  const Vector<Interval> e = beyond_at(path, of_bound(near));
  const Interval slope = dot(path.step, e);
  double speed2 = 0;
  for (int i = 0; i < 3; ++i) {
    if (e[i].inf() != 0 || e[i].sup() != 0) speed2 += std::max(square(path.step[i]).inf(), 0.0);
  }
  const double width = slope.sup() - slope.inf();
  double first = 0x1p-50 * near + 0x1p-1000;
  if (speed2 > 0 && width < speed2 * 0x1p400) first = std::max(first, width / speed2);
  // On each side, extends as far as the slope's sign is certain; beyond, the distance grows. Steps of four and then
  // bisection find the reach, so that it does not depend on where the steps fall.
  const auto least_reach = [&](double most, const auto& sure) {
    double reach = first;
    for (int i = 0; i < 300 && reach < most; ++i, reach *= 4) {
      if (!sure(reach)) continue;
      double low = i == 0 ? 0 : reach / 4;
      for (int half = 0; half < 12; ++half) {
        const double middle = 0.5 * (low + reach);
        (sure(middle) ? reach : low) = middle;
      }
      return reach;
    }
    return infinity;
  };
  const double up =
      least_reach(std::min(limit - near, 0x1p400), [&](double t) { return slope_at(near + t).inf() >= 0; });
  const double down = least_reach(near, [&](double t) { return slope_at(near - t).sup() <= 0; });
  const double after = up < infinity ? near + up : limit, before = down < infinity ? near - down : 0;
  const Interval down_after = of_bound(std::max(-slope.inf(), 0.0)), down_before = of_bound(std::max(slope.sup(), 0.0));
  Interval drop(0);
  if (down_after.sup() > 0 && after > near) {
    if (after == infinity) return -infinity;
    drop = Interval(2) * down_after * (of_bound(after) - of_bound(near));
  }
  if (down_before.sup() > 0 && before < near) {
    const Interval other = Interval(2) * down_before * (of_bound(near) - of_bound(before));
    drop = of_bound(std::max(drop.sup(), other.sup()));
  }
  return (of_bound(norm2(e).inf()) - of_bound(drop.sup())).inf();
}

}  // namespace

template <class N, class Out>
void moving_sphere_passes_box(const inputs::moving_sphere_passes_box<N>& q, Out& out) {
  const auto axes = rotation_axes<N>(q.box.orientation);
  const Path<N> path{into(axes, minus(vector(q.sphere.center), vector(q.box.center))), into(axes, vector(q.velocity)),
                     vector(q.box.half)};
  const N radius2 = square(q.sphere.radius);
  if constexpr (is_enclosure<N>) {
    const Interval limit = q.forever ? of_bound(infinity) : assume_at_least_zero(q.limit);
    const double near = time_of_least_distance(path, limit.sup());
    const auto surely = [&](const Interval& t) { return !may_be_positive(norm2(beyond_at(path, t)) - radius2); };
    const bool touches = surely(of_bound(std::min(near, limit.inf()))) || (near >= limit.inf() && surely(limit));
    if (!touches) out.no();
    if (touches || least_distance2(path, near, limit.sup()) <= radius2.sup()) out.yes({true});
  } else {
    const std::optional<N> limit = q.forever ? std::nullopt : std::optional<N>(q.limit);
    if (passes(path, radius2, limit))
      out.yes({true});
    else
      out.no();
  }
}

NEARMISS_ORACLE(moving_sphere_passes_box)

}  // namespace nearmiss::oracle
