/// What the derivations that watch the oracle share: rationals of gmpxx, readers, and the comparison on
/// small integer lattices, where touches, ties and degenerate shapes are common. They share no code with
/// the oracle. Each file of derivations ends with an INSTANTIATE_TEST_SUITE_P of OracleOnLattice.
#pragma once

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "oracles/judge.hpp"

namespace nearmiss::lattice {

using Q = mpq_class;
using V = std::array<Q, 3>;

inline Q dot(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline V sub(const V& a, const V& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline V cross(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Reads the inputs of a case one after the other.
class Reader {
 public:
  explicit Reader(std::span<const double> values) : at_(values.data()) {}
  Q number() { return Q(*at_++); }
  V vector() { const Q x = number(), y = number(), z = number(); return {x, y, z}; }

 private:
  const double* at_;
};

struct RefBox {
  V center, half;
  std::array<V, 3> axes;

  explicit RefBox(Reader& r) : center(r.vector()), half(r.vector()) {
    // Columns of the rotation as images of the unit vectors: v + 2 w (u x v) + 2 u x (u x v), over |q|^2.
    const V u = r.vector();
    const Q w = r.number(), n = dot(u, u) + w * w;
    for (int i = 0; i < 3; ++i) {
      V e{0, 0, 0};
      e[i] = 1;
      const V uv = cross(u, e), uuv = cross(u, uv);
      for (int k = 0; k < 3; ++k) axes[i][k] = e[k] + 2 * (w * uv[k] + uuv[k]) / n;
    }
  }
  V local(const V& world) const { return {dot(axes[0], world), dot(axes[1], world), dot(axes[2], world)}; }
};

/// The first numbers of the answer, correctly rounded or nearly so; they may be fewer than it has.
struct Reference {
  bool yes;
  std::vector<double> values;
};
inline Reference no() { return {false, {}}; }
template <class... Values>
Reference yes(Values... values) { return {true, {values...}}; }

/// (-b - sqrt(d)) / a, or with the other sign.
inline double root_of(const Q& a, const Q& b, const Q& d, int sign = -1) {
  const mpf_class root = sqrt(mpf_class(d, 512));
  return mpf_class((-mpf_class(b, 512) + sign * root) / mpf_class(a, 512)).get_d();
}

inline Q excess(const Q& c, const Q& h) { return c > h ? Q(c - h) : c < -h ? Q(c + h) : Q(0); }

using Derivation = Reference (*)(Reader);

/// Compares the oracle with a derivation: decisions, and the reference's numbers to one unit in the last
/// place. Its test is in oracle_lattice_test.cpp.
class OracleOnLattice : public testing::TestWithParam<std::tuple<const char*, Derivation>> {};

}  // namespace nearmiss::lattice
