/// The derivation of the grid's overlaps and signed distances: the point of the Minkowski difference of the cores that
/// is nearest to the origin, by the algorithm of Wolfe (Finding the nearest point in a polytope, Mathematical
/// Programming 11, 1976) in rationals. Unlike the oracle it finds nearest points, and looks for no direction that
/// separates.
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
  std::vector<std::size_t> numbers;  ///< of the points in a list

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
      if (weight <= 0) continue;
      kept.points.push_back(c.points[i]), kept.weights.push_back(weight), kept.numbers.push_back(c.numbers[i]);
    }
    c = std::move(kept);
    if (share == 1) return;
  }
}

/// The point of the convex hull that is nearest to the origin, from the point number `start` on.
Combination nearest_to_origin(const std::vector<V>& points, std::size_t start = 0) {
  const auto least_along = [&](const V& direction) {
    const auto least = std::min_element(points.begin(), points.end(),
                                        [&](const V& a, const V& b) { return dot(direction, a) < dot(direction, b); });
    return std::size_t(least - points.begin());
  };
  Combination c{{points[start]}, {1}, {start}};
  while (true) {
    const V x = c.sum();
    const std::size_t next = least_along(x);
    if (dot(x, points[next]) >= square_of(x)) return c;
    c.points.push_back(points[next]);
    c.weights.push_back(0);
    c.numbers.push_back(next);
    approach(c);
  }
}

/// The vertices of the Minkowski difference, and those of the bodies that each of them comes from.
struct Difference {
  std::vector<V> all, of_a, of_b;

  Difference(const Body& a, const Body& b) {
    for (const V& v : a.vertices) {
      for (const V& w : b.vertices) all.push_back(sub(w, v)), of_a.push_back(v), of_b.push_back(w);
    }
  }
};

template <Body (*read_first)(Reader&), Body (*read_second)(Reader&)>
Reference reference_overlap(Reader r) {
  const Body a = read_first(r), b = read_second(r);
  const Q reach = a.radius + b.radius;
  return square_of(nearest_to_origin(Difference(a, b).all).sum()) <= reach * reach ? yes() : no();
}

/// Of cores whose difference has no volume. The nearest points are a combination of those of two runs of the algorithm:
/// the pairs of nearest points are a convex set.
template <Body (*read_first)(Reader&), Body (*read_second)(Reader&)>
Reference reference_signed_distance(Reader r) {
  const Body a = read_first(r), b = read_second(r);
  const Difference d(a, b);
  V point1{}, way{};
  const Q share = r.choose.is_free() ? r.choose.share() : Q(0);
  for (const Q& weight : {Q(1 - share), share}) {
    const Combination c = nearest_to_origin(d.all, std::size_t(r.choose.below(int(d.all.size()))));
    way = c.sum();
    for (std::size_t i = 0; i < c.numbers.size(); ++i) {
      point1 = add(point1, d.of_a[c.numbers[i]], weight * c.weights[i]);
    }
  }
  const V point2 = add(point1, way);
  Reference reference = yes(R(length(way) - real(Q(a.radius + b.radius))));
  std::optional<V> direction = way;
  if (square_of(way) == 0) {  // any that separates weakly
    std::vector<V> against;
    for (const V& x : d.all) against.push_back(scaled(x, -1));
    direction = r.choose.in_cone({}, against);
  }
  if (!direction) return reference;
  reference.give_unit(*direction);
  const R n = length(*direction);
  const auto moved = [&](const V& x, const Q& by) {
    for (int k = 0; k < 3; ++k) reference.give(R(real(x[k]) + real(by) * real((*direction)[k]) / n));
  };
  moved(point1, a.radius);
  moved(point2, -b.radius);
  return reference;
}

}  // namespace

std::span<const Derived> of_grid() {
  static constexpr Derived all[] = {
#define NEARMISS_OVERLAP(first, second) \
  {#first "_" #second "_overlap", &reference_overlap<&read_##first, &read_##second>},
#define NEARMISS_SIGNED_DISTANCE(first, second) \
  {#first "_" #second "_signed_distance", &reference_signed_distance<&read_##first, &read_##second>},
#include "impl/catalogue/grid.def"
  };
  return all;
}

}  // namespace nearmiss::derived
