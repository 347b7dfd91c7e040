#include "corpus/generator/feature_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/generator/generator.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

using Vector = std::array<double, 3>;

constexpr std::array<std::string_view, feature_region_count> names = {
    "a zero size",      "something flat", "no motion",         "a start in touch",   "two places alike",
    "parallel vectors", "a turned shape", "a scaled rotation", "a scaled direction", "no true rectangle"};

Vector vector_at(const Case& c, std::size_t i) { return {c.values[i], c.values[i + 1], c.values[i + 2]}; }
bool is_zero(const Vector& v) { return v == Vector{0, 0, 0}; }

/// Whether a b = c d: the products as sums of two doubles, which are exact unless they are subnormal or infinite.
bool equal_products(double a, double b, double c, double d) {
  const double ab = a * b, cd = c * d;
  return ab == cd && std::fma(a, b, -ab) == std::fma(c, d, -cd);
}

bool are_parallel(const Vector& a, const Vector& b) {
  if (is_zero(a) || is_zero(b)) return false;
  return equal_products(a[1], b[2], a[2], b[1]) && equal_products(a[2], b[0], a[0], b[2]) &&
         equal_products(a[0], b[1], a[1], b[0]);
}

bool has_zero_size(const Case& c) {
  const std::vector<std::size_t>& sizes = c.operands().sizes;
  return std::any_of(sizes.begin(), sizes.end(), [&](std::size_t i) { return c.values[i] == 0; });
}

/// Everything that has an extent beyond its radii and half extents: those are taken as 1.
bool has_something_flat(const Case& c) {
  const Operands& parts = c.operands();
  if (parts.segments.empty() && parts.triangles.empty() && parts.aaboxes.empty()) return false;
  Case solid = c;
  for (const std::size_t i : parts.sizes) solid.values[i] = 1;
  return !meets(solid, Precondition::no_zero_sizes);
}

bool has_two_places_alike(const Case& c) {
  const Operands& all = c.operands();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      for (const std::size_t place : all[i].positions) {
        const auto is_alike = [&](std::size_t other) { return vector_at(c, other) == vector_at(c, place); };
        if (std::ranges::any_of(all[k].positions, is_alike)) return true;
      }
    }
  }
  return false;
}

/// The velocities, directions and normals of a case, and its segments where the difference of their ends is exact.
std::vector<Vector> lines_of(const Case& c) {
  const Operands& parts = c.operands();
  std::vector<Vector> lines;
  for (const auto* list : {&parts.velocities, &parts.directions, &parts.normals}) {
    for (const std::size_t i : *list) lines.push_back(vector_at(c, i));
  }
  for (const auto& [from, to] : parts.segments) {
    const Vector a = vector_at(c, from), b = vector_at(c, to);
    const Vector along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const auto is_exact = [&](std::size_t k) { return along[k] + a[k] == b[k] && b[k] - along[k] == a[k]; };
    if (is_exact(0) && is_exact(1) && is_exact(2)) lines.push_back(along);
  }
  return lines;
}

bool has_parallels(const Case& c) {
  const std::vector<Vector> lines = lines_of(c);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (are_parallel(lines[i], lines[k])) return true;
    }
  }
  return false;
}

/// A turn that maps the axes to axes has a quaternion with one number, with two of the same magnitude, or with four.
bool maps_axes_to_axes(const double* q) {
  double largest = 0;
  for (int k = 0; k < 4; ++k) largest = std::max(largest, std::abs(q[k]));
  const auto of_largest = std::count_if(q, q + 4, [&](double x) { return std::abs(x) == largest; });
  const auto zeros = std::count(q, q + 4, 0.0);
  return of_largest + zeros == 4 && of_largest != 3;
}

bool has_something_turned(const Case& c) {
  const std::vector<std::size_t>& all = c.operands().quaternions;
  return std::any_of(all.begin(), all.end(), [&](std::size_t i) { return !maps_axes_to_axes(&c.values[i]); });
}

bool breaks(const Case& c, Precondition p) { return concerns(p, *c.query) && !meets(c, p); }

bool holds(FeatureRegion r, const Case& c) {
  switch (r) {
    case FeatureRegion::zero_size: return has_zero_size(c);
    case FeatureRegion::flat: return has_something_flat(c);
    case FeatureRegion::no_motion: return breaks(c, Precondition::moves);
    case FeatureRegion::starts_in_touch: return breaks(c, Precondition::starts_outside);
    case FeatureRegion::same_place: return has_two_places_alike(c);
    case FeatureRegion::parallel: return has_parallels(c);
    case FeatureRegion::turned: return has_something_turned(c);
    case FeatureRegion::scaled_rotation: return breaks(c, Precondition::unit_quaternion);
    case FeatureRegion::scaled_direction:
      return breaks(c, Precondition::unit_direction) || breaks(c, Precondition::unit_normal);
    case FeatureRegion::no_true_rectangle: return breaks(c, Precondition::true_rectangle);
  }
  return false;
}

}  // namespace

std::string_view name_of(FeatureRegion r) { return names[std::size_t(r)]; }

std::vector<std::string_view> FeatureRegions::names() const {
  std::vector<std::string_view> all;
  for (int r = 0; r < feature_region_count; ++r) {
    if (has(FeatureRegion(r))) all.push_back(name_of(FeatureRegion(r)));
  }
  return all;
}

FeatureRegions feature_regions_of(const Case& question) {
  FeatureRegions all;
  for (int r = 0; r < feature_region_count; ++r) {
    if (holds(FeatureRegion(r), question)) all.add(FeatureRegion(r));
  }
  return all;
}

FeatureRegions feature_regions_named(const std::vector<std::string>& given) {
  FeatureRegions all;
  for (int r = 0; r < feature_region_count; ++r) {
    if (std::find(given.begin(), given.end(), name_of(FeatureRegion(r))) != given.end()) all.add(FeatureRegion(r));
  }
  return all;
}

bool is_ordinary(const Case& question) {
  if (question.origin.starts_with("scene ")) return true;
  if (question.origin.starts_with("generator")) return !has_extreme_mutator(question);
  constexpr double least = 0x1p-20, most = 0x1p20;
  return std::all_of(question.values.begin(), question.values.end(),
                     [](double x) { return x == 0 || (std::abs(x) >= least && std::abs(x) <= most); });
}

}  // namespace nearmiss
