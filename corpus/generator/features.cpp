#include "corpus/generator/features.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss {

double dot(const Numbers& a, const Numbers& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Numbers cross(const Numbers& a, const Numbers& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double norm(const Numbers& a) { return std::sqrt(dot(a, a)); }
Numbers unit_of(const Numbers& a) {
  const double n = norm(a);
  return n > 0 ? plus({}, a, 1 / n) : Numbers{};
}

std::array<Numbers, 3> axes_of(const CaseBuilder& d, std::size_t begin) {
  const double x = d[begin], y = d[begin + 1], z = d[begin + 2], w = d[begin + 3];
  const double n = x * x + y * y + z * z + w * w;
  return {{{(w * w + x * x - y * y - z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n},
           {2 * (x * y - w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z + w * x) / n},
           {2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n, (w * w - x * x - y * y + z * z) / n}}};
}

namespace {

/// The corners of a box and its twelve edges. `half` are the half axes, with their lengths.
void add_box(Features& f, const Numbers& center, const std::array<Numbers, 3>& half) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    Numbers at = center;
    for (unsigned k = 0; k < 3; ++k) at = plus(at, half[k], (corner >> k & 1) != 0 ? 1 : -1);
    f.vertices.push_back(at);
    for (unsigned k = 0; k < 3; ++k) {
      if ((corner >> k & 1) == 0) f.edges.push_back({at, plus({}, half[k], 2)});
    }
  }
}

void add_box(const CaseBuilder& d, const Operand& box, Features& f) {
  std::array<Numbers, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (box.rotation) axes = axes_of(d, *box.rotation);
  f.normals.assign(axes.begin(), axes.end());
  for (std::size_t k = 0; k < 3; ++k) axes[k] = plus({}, axes[k], d[*box.half + k]);
  add_box(f, d.vector(box.positions[0]), axes);
}

void add_aabox(const CaseBuilder& d, const Operand& box, Features& f) {
  const Numbers low = d.vector(box.positions[0]), size = plus(d.vector(box.positions[1]), low, -1);
  f.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  add_box(f, plus(low, size, 0.5), {{{size[0] / 2, 0, 0}, {0, size[1] / 2, 0}, {0, 0, size[2] / 2}}});
}

/// A plane n . x + offset = 0: the point of it that is nearest to the origin.
void add_plane(const CaseBuilder& d, const Operand& plane, Features& f) {
  const Numbers n = d.vector(*plane.direction);
  const Numbers aside = std::abs(n[0]) < std::abs(n[1]) ? Numbers{0, n[2], -n[1]} : Numbers{-n[2], 0, n[0]};
  const double n2 = dot(n, n);
  const Numbers foot = n2 > 0 ? plus({}, n, -d[*plane.offset] / n2) : Numbers{};
  f.vertices = {foot};
  f.edges = {{foot, aside}, {foot, cross(n, aside)}};
  f.normals = {n};
}

/// Positions, the edges between them, and their faces. A list of vertices has an edge from each to the next.
void add_positions(const CaseBuilder& d, const Operand& operand, Features& f) {
  for (const std::size_t p : operand.positions) f.vertices.push_back(d.vector(p));
  const auto add_edge = [&](std::size_t i, std::size_t k) {
    f.edges.push_back({f.vertices[i], plus(f.vertices[k], f.vertices[i], -1)});
  };
  const ShapeTraits& traits = operand.traits();
  for (const auto& [i, k] : traits.edges) add_edge(i, k);
  for (std::size_t i = 1; traits.edges.empty() && i < f.vertices.size(); ++i) add_edge(i - 1, i);
  for (const auto& [i, j, k] : traits.faces)
    f.normals.push_back(cross(plus(f.vertices[j], f.vertices[i], -1), plus(f.vertices[k], f.vertices[i], -1)));
}

}  // namespace

Features features_of(const CaseBuilder& d, const Operand& operand) {
  Features f;
  if (operand.half) {
    add_box(d, operand, f);
  } else if (operand.shape == Shape::aabox) {
    add_aabox(d, operand, f);
  } else if (operand.offset) {
    add_plane(d, operand, f);
  } else {
    add_positions(d, operand, f);
    if (operand.direction) f.edges.push_back({f.vertices[0], d.vector(*operand.direction)});
  }
  if (operand.radius) f.radius = d[*operand.radius];
  return f;
}

Numbers furthest_point(CaseBuilder& d, const Features& features, const Numbers& direction) {
  const auto along = [&](const Numbers& v) { return dot(v, direction); };
  const Numbers& best = *std::ranges::max_element(features.vertices, {}, along);
  std::vector<Numbers> all{best};
  constexpr double rounding = 0x1p-40;  // axes and products are computed in double
  for (const Numbers& v : features.vertices) {
    const bool as_far = along(best) - along(v) <= rounding * (norm(plus(best, v, -1)) * norm(direction));
    if (&v != &best && as_far) all.push_back(v);
  }
  const Numbers first = d.random.pick(all), second = d.random.pick(all);
  const double share = 0.125 * d.random.between(0, 8);
  return plus(first, plus(second, first, -1), share);
}

}  // namespace nearmiss
