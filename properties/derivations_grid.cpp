/// The derivation of the grid's overlaps and signed distances: the point of the Minkowski difference of the cores that
/// is nearest to the origin, by the algorithm of Wolfe (Finding the nearest point in a polytope, Mathematical
/// Programming 11, 1976) in rationals; where the origin is inside, the nearest of the planes through three vertices.
/// Unlike the oracle it finds points of the difference, and looks for no direction that separates. The same of casts
/// against a half-space, by two heights.
#include <algorithm>
#include <bitset>
#include <optional>
#include <vector>

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

struct HalfSpace {
  V normal;
  Q offset;

  Q height(const V& x) const { return dot(normal, x) + offset; }
};
HalfSpace read_halfspace(Reader& r) {
  const V normal = r.vector();
  return {normal, r.number()};
}
/// The vertices that are least far along its normal.
std::vector<V> lowest_of(const Body& body, const HalfSpace& halfspace) {
  std::vector<V> lowest = body.vertices;
  std::sort(lowest.begin(), lowest.end(),
            [&](const V& a, const V& b) { return halfspace.height(a) < halfspace.height(b); });
  while (halfspace.height(lowest.back()) > halfspace.height(lowest.front())) lowest.pop_back();
  return lowest;
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

template <Body (*read_first)(Reader&), HalfSpace (*read_second)(Reader&)>
Reference reference_overlap(Reader r) {
  const Body a = read_first(r);
  const HalfSpace b = read_second(r);
  const Q height = b.height(lowest_of(a, b).front());
  return height <= 0 || height * height <= a.radius * a.radius * square_of(b.normal) ? yes() : no();
}

using Rounded = std::array<double, 3>;

/// The points divided by the largest number: each coordinate is off by 2^-52 at most.
std::vector<Rounded> rounded(const std::vector<V>& points) {
  Q most = 0;
  for (const V& point : points) {
    for (const Q& x : point) most = std::max(most, Q(abs(x)));
  }
  std::vector<Rounded> all(points.size());
  for (std::size_t i = 0; most > 0 && i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) all[i][k] = Q(points[i][k] / most).get_d();
  }
  return all;
}
using Whole = std::array<mpz_class, 3>;

/// The points times `unit`: sums and products of whole numbers need no common divisor.
std::vector<Whole> in_whole_numbers(const std::vector<V>& points, mpz_class& unit) {
  unit = 1;
  for (const V& point : points) {
    for (const Q& x : point) unit = lcm(unit, x.get_den());
  }
  std::vector<Whole> all;
  for (const V& point : points) {
    Whole& whole = all.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) whole[k] = point[k].get_num() * (unit / point[k].get_den());
  }
  return all;
}
mpz_class product(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Whole across(const Whole& from, const Whole& a, const Whole& b) {
  Whole out;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    out[k] = (a[l] - from[l]) * (b[m] - from[m]) - (a[m] - from[m]) * (b[l] - from[l]);
  }
  return out;
}

/// The planes { x : n . x = 1 } through three of the points that have no point beyond them, by their n. None where the
/// origin is not inside the convex hull.
std::vector<V> planes_around_origin(const std::vector<V>& points) {
  constexpr std::size_t most_points = 64;
  const std::vector<Rounded> near = rounded(points);
  mpz_class unit;
  const std::vector<Whole> exact = in_whole_numbers(points, unit);
  std::vector<V> planes;
  std::vector<std::bitset<most_points>> on_planes;
  std::vector<std::size_t> close;    // to the plane, as far as rounded numbers tell
  std::size_t above = 0, below = 0;  // points on both sides of the last plane that had some: often of the next too
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Rounded &p = near[i], &q = near[j], &r = near[k];
        Rounded about;
        double lengths = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t l = (c + 1) % 3, m = (c + 2) % 3;
          lengths += std::abs(q[c] - p[c]) + std::abs(r[c] - p[c]);
          about[c] = (q[l] - p[l]) * (r[m] - p[m]) - (q[m] - p[m]) * (r[l] - p[l]);
        }
        // A difference is off by 2^-51, so a product of two by 2^-50 lengths, and the sum of six, each times a third
        // difference of at most 2, by less than 2^-45 lengths.
        const double certainly_off = 0x1p-44 * lengths;
        const auto off = [&](const Rounded& x) {
          return about[0] * (x[0] - p[0]) + about[1] * (x[1] - p[1]) + about[2] * (x[2] - p[2]);
        };
        if (std::min(off(near[above]), off(near[below])) < -certainly_off &&
            std::max(off(near[above]), off(near[below])) > certainly_off)
          continue;
        bool none_above = true, none_below = true;
        close.clear();
        for (std::size_t x = 0; x < points.size() && (none_above || none_below); ++x) {
          const double of_x = off(near[x]);
          if (of_x > certainly_off) none_above = false, above = x;
          if (of_x < -certainly_off) none_below = false, below = x;
          if (std::abs(of_x) <= certainly_off) close.push_back(x);
        }
        if (!none_above && !none_below) continue;
        const bool is_known =
            std::any_of(on_planes.begin(), on_planes.end(), [&](const auto& on) { return on[i] && on[j] && on[k]; });
        if (is_known) continue;
        const Whole out = across(exact[i], exact[j], exact[k]);
        if (out == Whole{0, 0, 0}) continue;
        const mpz_class level = product(out, exact[i]);
        std::bitset<most_points> on;
        for (const std::size_t x : close) {
          const mpz_class at = product(out, exact[x]);
          none_above = none_above && at <= level, none_below = none_below && at >= level;
          on[x] = at == level;
        }
        if ((none_above && level <= 0) || (none_below && level >= 0)) return {};
        if (none_above || none_below) {
          const Q per_level = Q(unit) / Q(level);
          planes.push_back(scaled({Q(out[0]), Q(out[1]), Q(out[2])}, per_level));
          on_planes.push_back(on);
        }
      }
    }
  }
  return planes;
}

/// Those that are nearest to the origin, by their n. None where the origin is not inside.
const std::vector<V>& nearest_faces(const std::vector<V>& points) {
  static thread_local std::vector<V> last, nearest;  // a test draws many right answers of a case
  if (points == last) return nearest;
  last = points;
  nearest.clear();
  Q most2 = 0;
  for (const V& n : planes_around_origin(points)) {
    const Q n2 = square_of(n);
    if (n2 < most2) continue;
    if (n2 > most2) most2 = n2, nearest.clear();
    nearest.push_back(n);
  }
  return nearest;
}

/// The nearest points are a combination of those of two runs of the algorithm: the pairs of nearest points are a convex
/// set. Where the cores overlap, they are those of the cores after a shortest translation that parts them: from the
/// origin to a nearest face of the difference.
template <Body (*read_first)(Reader&), Body (*read_second)(Reader&)>
Reference reference_signed_distance(Reader r) {
  const Body a = read_first(r), b = read_second(r);
  const Difference d(a, b);
  V out{};  // the translation of a, inward where the cores overlap
  const bool meet = square_of(nearest_to_origin(d.all).sum()) == 0;
  const std::vector<V> faces = meet ? nearest_faces(d.all) : std::vector<V>{};
  if (!faces.empty()) {
    const V& face = r.choose.among(faces);
    out = scaled(face, 1 / square_of(face));
  }
  std::vector<V> moved_apart;
  for (const V& x : d.all) moved_apart.push_back(sub(x, out));
  V point1{}, way{};
  const Q share = r.choose.is_free() ? r.choose.share() : Q(0);
  for (const Q& weight : {Q(1 - share), share}) {
    const Combination c = nearest_to_origin(moved_apart, std::size_t(r.choose.below(int(d.all.size()))));
    way = c.sum();
    for (std::size_t i = 0; i < c.numbers.size(); ++i) {
      point1 = add(point1, d.of_a[c.numbers[i]], weight * c.weights[i]);
    }
  }
  const bool overlap = !faces.empty();
  if (overlap) way = out;
  const V point2 = add(point1, way);
  const R apart = overlap ? R(-length(way)) : length(way);
  Reference reference = yes(R(apart - real(Q(a.radius + b.radius))));
  std::optional<V> direction = overlap ? scaled(way, -1) : way;
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

/// The foot of the perpendicular from a lowest point, or from a point between lowest ones, is the nearest point.
template <Body (*read_first)(Reader&), HalfSpace (*read_second)(Reader&)>
Reference reference_signed_distance(Reader r) {
  const Body a = read_first(r);
  const HalfSpace b = read_second(r);
  const std::vector<V> lowest = lowest_of(a, b);
  const V from = r.choose.is_free() ? r.choose.between(lowest) : lowest.front();
  const R n = length(b.normal);
  Reference reference = yes(R(real(b.height(from)) / n - real(a.radius)));
  reference.give_unit(scaled(b.normal, -1));
  for (int k = 0; k < 3; ++k) reference.give(R(real(from[k]) - real(a.radius) * real(b.normal[k]) / n));
  reference.give(add(from, b.normal, -b.height(from) / square_of(b.normal)));
  return reference;
}

/// The height of a lowest point at the times 0 and 1 gives the line that it follows.
template <Body (*read_first)(Reader&), HalfSpace (*read_second)(Reader&)>
Reference reference_cast(Reader r) {
  const Body a = read_first(r);
  const V velocity = r.vector();
  const HalfSpace b = read_second(r);
  const std::vector<V> lowest = lowest_of(a, b);
  const V from = r.choose.is_free() ? r.choose.between(lowest) : lowest.front();
  const Q now = b.height(from), later = b.height(add(from, velocity, 1));
  const R norm = length(b.normal), gap = real(now) / norm - real(a.radius);
  const Q reach2 = a.radius * a.radius * square_of(b.normal);
  const bool overlaps = now < 0 || now * now < reach2, touches = !overlaps && now * now == reach2;
  const auto hit = [&](const R& time, const R& down) {
    Reference reference = yes(time);
    for (int k = 0; k < 3; ++k)
      reference.give(R(real(from[k]) + time * real(velocity[k]) - down * real(b.normal[k]) / norm));
    reference.give_unit(b.normal);
    return reference;
  };
  if (overlaps || (touches && later <= now)) return hit(R(real(Q(0))), R(real(now) / norm));
  if (touches || later >= now) return no();
  return hit(R(gap * norm / real(Q(now - later))), R(real(a.radius)));
}

}  // namespace

std::span<const Derived> of_grid() {
  static constexpr Derived all[] = {
#define NEARMISS_OVERLAP(first, second) \
  {#first "_" #second "_overlap", &reference_overlap<&read_##first, &read_##second>},
#define NEARMISS_SIGNED_DISTANCE(first, second) \
  {#first "_" #second "_signed_distance", &reference_signed_distance<&read_##first, &read_##second>},
#define NEARMISS_CAST_AS(query, first, second) {#query, &reference_cast<&read_##first, &read_##second>},
#include "impl/catalogue/grid.def"
  };
  return all;
}

}  // namespace nearmiss::derived
