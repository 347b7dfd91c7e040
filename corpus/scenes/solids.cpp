#include "corpus/scenes/solids.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace nearmiss::scenes {

namespace {

constexpr Vector along_z = {0, 0, 1};

Vector unit(const Vector& a) { return scaled(a, 1 / length_of(a)); }

/// The columns of the rotation matrix of a quaternion of any length.
std::array<Vector, 3> axes_of_rotation(const std::array<double, 4>& q) {
  const auto [x, y, z, w] = q;
  const double n = 1 / (x * x + y * y + z * z + w * w);
  std::array<Vector, 3> axes;
  axes[0] = {(w * w + x * x - y * y - z * z) * n, 2 * (x * y + w * z) * n, 2 * (x * z - w * y) * n};
  axes[1] = {2 * (x * y - w * z) * n, (w * w - x * x + y * y - z * z) * n, 2 * (y * z + w * x) * n};
  axes[2] = {2 * (x * z + w * y) * n, 2 * (y * z - w * x) * n, (w * w - x * x - y * y + z * z) * n};
  return axes;
}

/// A quaternion of length 1.
std::array<double, 4> draw_rotation(Random& random) {
  if (random.one_in(4)) return {0, 0, 0, 1};
  const bool about_z = random.one_in(3);
  for (;;) {
    std::array<double, 4> q{};
    double square = 0;
    for (std::size_t k = about_z ? 2 : 0; k < 4; ++k) {
      q[k] = random.uniform(-1, 1);
      square += q[k] * q[k];
    }
    constexpr double least = 1.0 / 16;  // far from the length 0, where the division is inexact
    if (square < least || square > 1) continue;
    for (double& x : q) x /= std::sqrt(square);
    return q;
  }
}

void draw_corners(Random& random, Solid& s, const Spread& size) {
  switch (s.type) {
    case Shape::capsule:
    case Shape::segment:
      s.corner_count = 2;
      s.corners[0] = scaled(draw_direction(random), draw_from(random, size));
      s.corners[1] = scaled(s.corners[0], -1);
      break;
    case Shape::triangle:
      s.corner_count = 3;
      for (std::size_t i = 0; i < 3; ++i) s.corners[i] = scaled(draw_direction(random), draw_from(random, size));
      break;
    case Shape::rectangle: {
      s.corner_count = 4;
      const Vector u = draw_direction(random), v = draw_orthogonal(random, u);
      const double a = draw_from(random, size), b = draw_from(random, size);
      s.corners = {plus(scaled(u, -a), v, -b), plus(scaled(u, a), v, -b), plus(scaled(u, a), v, b),
                   plus(scaled(u, -a), v, b)};
      break;
    }
    default: break;
  }
}

/// A normal whose smallest share along a chosen axis is well above 0, and a point of the face, edge or vertex.
SurfacePoint surface_of_box(Random& random, const Solid& s) {
  const std::size_t chosen = 1 + random.below(3), first = random.below(3);
  SurfacePoint p{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (first + i) % 3;
    const double sign = random.sign();
    if (i < chosen) p.normal = plus(p.normal, s.axes[k], sign * random.uniform(0.125, 1));
    p.at = plus(p.at, s.axes[k], s.half[k] * (i < chosen ? sign : random.uniform(-1, 1)));
  }
  p.normal = unit(p.normal);
  return p;
}

/// The normal of a flat shape, where its corners span a plane.
std::optional<Vector> normal_of(const Solid& s) {
  const Vector n = cross(plus(s.corners[1], s.corners[0], -1), plus(s.corners[2], s.corners[0], -1));
  const double length = length_of(n);
  if (!(length > 0)) return std::nullopt;
  return scaled(n, 1 / length);
}

SurfacePoint on_face(Random& random, const Solid& s, const Vector& normal) {
  double w[3], sum = 0;
  for (double& x : w) sum += x = random.uniform(0.01, 1);
  SurfacePoint p{{}, scaled(normal, random.sign())};
  for (std::size_t i = 0; i < 3; ++i) p.at = plus(p.at, s.corners[i], w[i] / sum);
  return p;
}

/// A normal at a right angle to an edge, on the side without other corners.
std::optional<SurfacePoint> on_edge(Random& random, const Solid& s) {
  const std::size_t i = random.below(s.corner_count), j = (i + 1) % s.corner_count;
  const Vector edge = plus(s.corners[j], s.corners[i], -1);
  if (!(length_of(edge) > 0)) return std::nullopt;
  SurfacePoint p{plus(s.corners[i], edge, random.uniform(0, 1)), draw_orthogonal(random, unit(edge))};
  if (s.corner_count > 2 && dot(plus(s.corners[(i + 2) % s.corner_count], s.corners[i], -1), p.normal) > 0)
    p.normal = scaled(p.normal, -1);
  return p;
}

SurfacePoint surface_of_hull(Random& random, const Solid& s) {
  SurfacePoint p{{}, draw_direction(random)};
  const auto normal = s.corner_count > 2 ? normal_of(s) : std::nullopt;
  const std::size_t feature = random.below(normal ? 3 : 2);
  const auto edge = feature == 1 && s.corner_count > 1 ? on_edge(random, s) : std::nullopt;
  if (feature == 2) {
    p = on_face(random, s, *normal);
  } else if (edge) {
    p = *edge;
  } else {
    return {s.support(p.normal), p.normal};
  }
  p.at = plus(p.at, p.normal, s.radius);
  return p;
}

}  // namespace

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector scaled(const Vector& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
double length_of(const Vector& a) { return std::sqrt(dot(a, a)); }

Vector draw_direction(Random& random) {
  for (;;) {
    const Vector x = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    constexpr double least = 1.0 / 16;
    if (const double square = dot(x, x); square >= least && square <= 1) return unit(x);
  }
}

Vector draw_orthogonal(Random& random, const Vector& axis) {
  for (;;) {
    const Vector x = cross(axis, draw_direction(random));
    constexpr double least = 1.0 / 16;
    if (dot(x, x) >= least) return unit(x);
  }
}

double draw_from(Random& random, const Spread& spread) {
  const double least = spread.least.value, most = spread.most.value;
  if (least == most) return least;
  if (!spread.logarithmic) return random.uniform(least, most);
  const auto octaves = std::size_t(std::ilogb(most / least)) + 1;
  for (;;) {  // least * 2^k * m with the density 1 / m
    const double m = random.uniform(1, 2), x = std::ldexp(least * m, int(random.below(octaves)));
    if (random.uniform(0, 1) * m < 1 && x <= most) return x;
  }
}

double Solid::reach() const {
  if (has_one_plane(type)) return 0;
  if (is_box()) return length_of(half);
  double most = 0;
  for (std::size_t i = 0; i < corner_count; ++i) most = std::max(most, length_of(corners[i]));
  return most + radius;
}

Vector Solid::support(const Vector& direction) const {
  Vector at{};
  if (is_box()) {
    for (std::size_t k = 0; k < 3; ++k) at = plus(at, axes[k], dot(axes[k], direction) < 0 ? -half[k] : half[k]);
    return at;
  }
  at = *std::max_element(corners.begin(), corners.begin() + std::ptrdiff_t(corner_count),
                         [&](const Vector& a, const Vector& b) { return dot(a, direction) < dot(b, direction); });
  return plus(at, direction, radius);
}

Solid draw_solid(Random& random, const Shapes& shapes) {
  Solid s;
  s.type = shapes.type;
  if (s.is_box()) {
    for (double& x : s.half) x = draw_from(random, shapes.size);
    if (s.type == Shape::box) s.rotation = draw_rotation(random);
    s.axes = axes_of_rotation(s.rotation);
    return s;
  }
  if (has_one_plane(s.type)) s.axes[0] = random.one_in(4) ? along_z : draw_direction(random);
  if (s.type == Shape::sphere || s.type == Shape::capsule) s.radius = draw_from(random, shapes.size);
  draw_corners(random, s, shapes.size);
  return s;
}

SurfacePoint draw_surface_point(Random& random, const Solid& solid) {
  if (has_one_plane(solid.type)) return {{}, solid.axes[0]};
  return solid.is_box() ? surface_of_box(random, solid) : surface_of_hull(random, solid);
}

}  // namespace nearmiss::scenes
