/// Points of two cores near to each other, found in plain numbers. Any pair bounds a distance, and the directions in
/// which the cores may be that far apart; so the search may round, and need not find the nearest.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "oracles/algorithms/rounded_polytopes.hpp"

namespace nearmiss::oracle {

/// The points base + w[0] along[0] + w[1] along[1] + ...: of a box with each weight in [-1, 1], of another core with
/// weights that are not negative and have a sum of at most 1.
template <class N>
struct Spans {
  Vector<N> base;
  std::vector<Vector<N>> along;
  bool is_box = false;
};
using Weights = std::array<double, 3>;

template <class N>
Spans<N> spans_of(const Core<N>& core) {
  if (!core.reach.empty()) return {core.center, core.reach, true};
  Spans<N> spans{core.vertices.front(), {}};
  for (std::size_t i = 1; i < core.vertices.size(); ++i)
    spans.along.push_back(minus(core.vertices[i], core.vertices.front()));
  return spans;
}
template <class N>
Vector<N> point_at(const Spans<N>& spans, const Weights& weights) {
  Vector<N> x = spans.base;
  for (std::size_t i = 0; i < spans.along.size(); ++i) x = plus(x, times(spans.along[i], N(weights[i])));
  return x;
}

/// Searches in coordinates of at most about 1.
class NearPoints {
 public:
  NearPoints(const Core<Interval>& a, const Core<Interval>& b) : a_(plain(spans_of(a))), b_(plain(spans_of(b))) {
    double largest = 0;
    for (const Plain* s : {&a_, &b_}) {
      for (const double x : s->base) largest = std::max(largest, std::abs(x));
      for (const Vector<double>& v : s->along) {
        for (const double x : v) largest = std::max(largest, std::abs(x));
      }
    }
    if (!(largest > 0) || !std::isfinite(largest)) return;
    const int exponent = -std::ilogb(largest);
    for (Plain* s : {&a_, &b_}) {
      scale(s->base, exponent);
      for (Vector<double>& v : s->along) scale(v, exponent);
    }
    search();
  }
  /// Nothing where a number is not finite, or all are zero.
  const std::optional<std::array<Weights, 2>>& weights() const { return best_; }

 private:
  using Plain = Spans<double>;

  static Vector<double> plain(const Vector<Interval>& x) {
    return {CGAL::to_double(x[0]), CGAL::to_double(x[1]), CGAL::to_double(x[2])};
  }
  static Plain plain(const Spans<Interval>& spans) {
    Plain p{plain(spans.base), {}, spans.is_box};
    for (const Vector<Interval>& v : spans.along) p.along.push_back(plain(v));
    return p;
  }
  static void scale(Vector<double>& x, int exponent) {
    for (double& c : x) c = std::ldexp(c, exponent);
  }
  static double share(double part, double of) { return of > 0 ? std::clamp(part / of, 0.0, 1.0) : 0; }

  static std::vector<Weights> corners_of(const Plain& s) {
    if (!s.is_box) {
      std::vector<Weights> all(s.along.size() + 1, Weights{});
      for (std::size_t i = 0; i < s.along.size(); ++i) all[i + 1][i] = 1;
      return all;
    }
    std::vector<Weights> all;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      Weights w;
      for (std::size_t k = 0; k < 3; ++k) w[k] = (corner >> k & 1) != 0 ? -1 : 1;
      all.push_back(w);
    }
    return all;
  }
  static std::vector<std::pair<Weights, Weights>> edges_of(const Plain& s) {
    const std::vector<Weights> corners = corners_of(s);
    std::vector<std::pair<Weights, Weights>> all;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const std::size_t differ = i ^ j;  // the corners of a box differ by one bit along an edge
        if (!s.is_box || (differ & (differ - 1)) == 0) all.emplace_back(corners[i], corners[j]);
      }
    }
    return all;
  }
  static Weights between(const Weights& from, const Weights& to, double share) {
    Weights w;
    for (std::size_t k = 0; k < 3; ++k) w[k] = from[k] + share * (to[k] - from[k]);
    return w;
  }
  /// The point of the edge nearest to x.
  static Weights nearest_on(const Plain& s, const std::pair<Weights, Weights>& edge, const Vector<double>& x) {
    const Vector<double> from = point_at(s, edge.first), along = minus(point_at(s, edge.second), from);
    return between(edge.first, edge.second, share(dot(minus(x, from), along), dot(along, along)));
  }
  static double distance2(const Vector<double>& x, const Vector<double>& y) {
    const Vector<double> way = minus(x, y);
    return dot(way, way);
  }
  static Weights nearest(const Plain& s, const Vector<double>& x) {
    const Vector<double> to_x = minus(x, s.base);
    Weights best{};
    if (s.is_box) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double length2 = dot(s.along[k], s.along[k]);
        if (length2 > 0) best[k] = std::clamp(dot(to_x, s.along[k]) / length2, -1.0, 1.0);
      }
      return best;
    }
    for (const auto& edge : edges_of(s)) {
      const Weights w = nearest_on(s, edge, x);
      if (distance2(point_at(s, w), x) < distance2(point_at(s, best), x)) best = w;
    }
    if (s.along.size() < 2) return best;
    const Vector<double> normal = cross(s.along[0], s.along[1]);
    const double area2 = dot(normal, normal), w0 = dot(cross(to_x, s.along[1]), normal),
                 w1 = dot(cross(s.along[0], to_x), normal);
    if (!(w0 > 0) || !(w1 > 0) || !(w0 + w1 < area2)) return best;
    const Weights inside{w0 / area2, w1 / area2, 0};
    return distance2(point_at(s, inside), x) < distance2(point_at(s, best), x) ? inside : best;
  }
  /// Weights that certainly belong to a point of the core: the rounding of a sum is upward.
  static Weights kept_within(const Plain& s, Weights w) {
    constexpr double nearly_all = 1 - 0x1p-50;
    if (!s.is_box && w[0] + w[1] + w[2] > 1) {
      for (double& x : w) x *= nearly_all;
    }
    return w;
  }
  void consider(Weights wa, Weights wb) {
    wa = kept_within(a_, wa), wb = kept_within(b_, wb);
    const double now = distance2(point_at(a_, wa), point_at(b_, wb));
    if (best_ && !(now < least_)) return;
    best_ = {wa, wb}, least_ = now;
  }
  void search() {
    for (const Weights& corner : corners_of(a_)) consider(corner, nearest(b_, point_at(a_, corner)));
    for (const Weights& corner : corners_of(b_)) consider(nearest(a_, point_at(b_, corner)), corner);
    const auto edges_of_b = edges_of(b_);
    for (const auto& e : edges_of(a_)) {
      const Vector<double> from_a = point_at(a_, e.first), along_a = minus(point_at(a_, e.second), from_a);
      for (const auto& f : edges_of_b) {
        const Vector<double> from_b = point_at(b_, f.first), along_b = minus(point_at(b_, f.second), from_b);
        const Vector<double> across = cross(along_a, along_b);
        const double on_a = share(dot(cross(minus(from_b, from_a), along_b), across), dot(across, across));
        const Weights wb = nearest_on(b_, f, plus(from_a, times(along_a, on_a)));
        consider(nearest_on(a_, e, point_at(b_, wb)), wb);
      }
    }
    constexpr int steps = 4;  // of alternating projection
    for (int i = 0; i < steps && best_; ++i) {
      const Weights wb = nearest(b_, point_at(a_, (*best_)[0]));
      consider(nearest(a_, point_at(b_, wb)), wb);
    }
  }

  Plain a_, b_;
  std::optional<std::array<Weights, 2>> best_;
  double least_ = 0;
};

}  // namespace nearmiss::oracle
