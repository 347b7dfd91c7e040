/// The derivation of the grid's overlaps: the point of the Minkowski difference of the cores that is nearest to the
/// origin, by the algorithm of Wolfe (Finding the nearest point in a polytope, Mathematical Programming 11, 1976) in
/// rationals. Unlike the oracle it finds nearest points, and looks for no direction that separates.
#include "properties/derivation.hpp"

namespace nearmiss::derived {
namespace {

/// The convex hull of the vertices, grown by the radius.
struct Body {
  std::vector<V> vertices;
  Q radius = 0;
};

Body read_point(Reader& r) { return {{r.vector()}}; }
Body read_sphere(Reader& r) {
  const V center = r.vector();
  return {{center}, r.number()};
}
Body read_segment(Reader& r) {
  const V v0 = r.vector(), v1 = r.vector();
  return {{v0, v1}};
}
Body read_capsule(Reader& r) {
  Body axis = read_segment(r);
  axis.radius = r.number();
  return axis;
}
Body read_triangle(Reader& r) {
  const V v0 = r.vector(), v1 = r.vector(), v2 = r.vector();
  return {{v0, v1, v2}};
}
Body read_box(Reader& r) {
  const RefBox box(r);
  Body body;
  for (int corner = 0; corner < 8; ++corner) {
    V local = box.half;
    for (int k = 0; k < 3; ++k) {
      if ((corner >> k & 1) == 0) local[k] = -local[k];
    }
    body.vertices.push_back(add(box.center, box.world(local)));
  }
  return body;
}

/// A convex combination of affinely independent points.
struct Combination {
  std::vector<V> points;
  std::vector<Q> weights;

  V sum() const {
    V x{0, 0, 0};
    for (std::size_t i = 0; i < points.size(); ++i) x = add(x, points[i], weights[i]);
    return x;
  }
};

/// The weights, of sum 1, of the point nearest to the origin in the affine hull: the solution of the equations
/// points[i] . x = m for all i, by elimination.
std::vector<Q> nearest_in_affine_hull(const std::vector<V>& points) {
  const std::size_t n = points.size() + 1;  // the weights, and m
  std::vector<std::vector<Q>> rows(n, std::vector<Q>(n + 1, 0));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t k = 0; k + 1 < n; ++k) rows[i][k] = dot(points[i], points[k]);
    rows[i][n - 1] = -1;
    rows[n - 1][i] = 1;
  }
  rows[n - 1][n] = 1;
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    while (rows[pivot][column] == 0) ++pivot;  // there is one: the points are affinely independent
    std::swap(rows[column], rows[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == column || rows[i][column] == 0) continue;
      const Q factor = rows[i][column] / rows[column][column];
      for (std::size_t k = column; k <= n; ++k) rows[i][k] -= factor * rows[column][k];
    }
  }
  std::vector<Q> weights;
  for (std::size_t i = 0; i + 1 < n; ++i) weights.push_back(rows[i][n] / rows[i][i]);
  return weights;
}

/// Goes to the nearest point of the affine hull or, where that lies outside the convex hull, as far as the convex hull
/// reaches, and leaves out the points whose weight is zero then.
void approach(Combination& c) {
  while (true) {
    const std::vector<Q> to = nearest_in_affine_hull(c.points);
    Q share = 1;
    for (std::size_t i = 0; i < to.size(); ++i) {
      if (to[i] < 0) share = std::min(share, Q(c.weights[i] / (c.weights[i] - to[i])));
    }
    Combination kept;
    for (std::size_t i = 0; i < to.size(); ++i) {
      const Q weight = c.weights[i] + share * (to[i] - c.weights[i]);
      if (weight > 0) kept.points.push_back(c.points[i]), kept.weights.push_back(weight);
    }
    c = std::move(kept);
    if (share == 1) return;
  }
}

/// The squared distance of the origin from the convex hull.
Q least_square(const std::vector<V>& points) {
  const auto least_along = [&](const V& direction) {
    return *std::min_element(points.begin(), points.end(),
                             [&](const V& a, const V& b) { return dot(direction, a) < dot(direction, b); });
  };
  Combination c{{points.front()}, {1}};
  while (true) {
    const V x = c.sum(), next = least_along(x);
    if (dot(x, next) >= square_of(x)) return square_of(x);
    c.points.push_back(next);
    c.weights.push_back(0);
    approach(c);
  }
}

template <Body (*read_first)(Reader&), Body (*read_second)(Reader&)>
Reference reference_overlap(Reader r) {
  const Body a = read_first(r), b = read_second(r);
  std::vector<V> difference;
  for (const V& v : a.vertices) {
    for (const V& w : b.vertices) difference.push_back(sub(w, v));
  }
  const Q reach = a.radius + b.radius;
  return least_square(difference) <= reach * reach ? yes() : no();
}

}  // namespace

std::span<const Derived> of_grid() {
  static constexpr Derived all[] = {
#define NEARMISS_OVERLAP(first, second) \
  {#first "_" #second "_overlap", &reference_overlap<&read_##first, &read_##second>},
#include "impl/catalogue/grid.def"
  };
  return all;
}

}  // namespace nearmiss::derived
