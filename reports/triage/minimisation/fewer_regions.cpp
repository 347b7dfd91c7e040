#include "reports/triage/minimisation/fewer_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "oracles/requirements.hpp"
#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

namespace {

using Real = long double;
using Quaternion = std::array<Real, 4>;  // x, y, z, w
using Point = std::array<Real, 3>;

double rounded(const Case& c, Real x) { return c.scalar == Scalar::float32 ? double(float(x)) : double(x); }

/// The vectors that begin at these numbers, each divided by its length.
void normalise(Case& c, const std::vector<std::size_t>& begins, std::size_t count) {
  for (const std::size_t begin : begins) {
    Real square = 0;
    for (std::size_t k = 0; k < count; ++k) square += Real(c.values[begin + k]) * c.values[begin + k];
    for (std::size_t k = 0; k < count; ++k) c.values[begin + k] = rounded(c, c.values[begin + k] / std::sqrt(square));
  }
}

Case with_unit_vectors(Case c) {
  const Operands& parts = c.operands();
  normalise(c, parts.quaternions, 4);
  normalise(c, parts.directions, 3);
  normalise(c, parts.normals, 3);
  return c;
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
          a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}
Quaternion conjugate(const Quaternion& q) { return {-q[0], -q[1], -q[2], q[3]}; }

Quaternion unit_quaternion_at(const Case& c, std::size_t begin) {
  Quaternion q;
  Real square = 0;
  for (std::size_t k = 0; k < 4; ++k) q[k] = c.values[begin + k], square += q[k] * q[k];
  for (Real& x : q) x /= std::sqrt(square);
  return q;
}

Point turned(const Point& p, const Quaternion& by) {
  const Quaternion q = product(product(by, {p[0], p[1], p[2], 0}), conjugate(by));
  return {q[0], q[1], q[2]};
}

/// The scene turned about the origin so that the first rotation of the case becomes none. The case itself where it has
/// no rotation, or a box that cannot be turned.
Case upright(const Case& c) {
  const Operands& parts = c.operands();
  if (parts.quaternions.empty() || !parts.aaboxes.empty()) return c;
  const Quaternion back = conjugate(unit_quaternion_at(c, parts.quaternions.front()));
  Case scene = c;
  for (const std::size_t begin : parts.quaternions) {
    const Quaternion q = product(back, unit_quaternion_at(c, begin));
    for (std::size_t k = 0; k < 4; ++k) scene.values[begin + k] = rounded(c, q[k]);
  }
  for (std::size_t k = 0; k < 4; ++k) scene.values[parts.quaternions.front() + k] = k == 3 ? 1 : 0;
  for (const InputMember& m : parts.members) {
    if (!m.is_vector() || m.role == Role::size) continue;
    const std::size_t i = m.begin;
    const Point p = turned({c.values[i], c.values[i + 1], c.values[i + 2]}, back);
    for (std::size_t k = 0; k < 3; ++k) scene.values[i + k] = rounded(c, p[k]);
  }
  return scene;
}

/// The case with each number of these roles moved by up to `share` of the largest magnitude of its role, or of 1 where
/// all are 0. Sizes stay positive.
Case stirred(const Case& c, std::span<const Role> roles, double share, std::mt19937_64& random) {
  Case moved = c;
  for (const Role role : roles) {
    double largest = 0;
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (c.role(i) == role) largest = std::max(largest, std::abs(c.values[i]));
    }
    const double by = share * (largest > 0 ? largest : 1);
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (c.role(i) != role) continue;
      const double x = c.values[i] + by * (2 * std::generate_canonical<double, 53>(random) - 1);
      moved.values[i] = rounded(c, role == Role::size ? std::abs(x) : x);
    }
  }
  return moved;
}

constexpr std::array stirred_roles = {Role::position, Role::size, Role::velocity, Role::direction, Role::rotation};

/// The cases to try, nearest to the scene first.
std::vector<Case> candidates_of(const Case& c, std::mt19937_64& random) {
  const Case unit = with_unit_vectors(c);
  std::vector<Case> all{unit, upright(c), upright(unit)};
  for (const double share : {0x1p-1, 0x1p-4, 0x1p-8, 0x1p-14, 0x1p-20}) {
    all.push_back(stirred(c, stirred_roles, share, random));
    all.push_back(with_unit_vectors(all.back()));
    for (std::size_t i = 0; i < stirred_roles.size(); ++i) {
      all.push_back(stirred(c, std::span(stirred_roles).subspan(i, 1), share, random));
    }
  }
  return all;
}

}  // namespace

Case in_fewer_regions(const Case& question, const std::function<bool(const Case&)>& keeps) {
  std::mt19937_64 random(1);
  Case best = question;
  FeatureRegions regions = feature_regions_of(best);
  for (bool is_better = true; is_better && !regions.empty();) {
    is_better = false;
    for (const Case& c : candidates_of(best, random)) {
      if (!is_valid(c)) continue;
      const FeatureRegions left = feature_regions_of(c);
      if (left == regions || !left.within(regions) || !keeps(c)) continue;
      best = c, regions = left, is_better = true;
      break;
    }
  }
  return best;
}

}  // namespace nearmiss
