/// Independent derivations, to test the oracle and the judge: slow, obvious ways to the exact answer of every query, in
/// gmpxx rationals and high-precision roots. They share no code with the oracle.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "properties/support.hpp"

namespace nearmiss::derived {

using Q = mpq_class;
using V = std::array<Q, 3>;

inline Q dot(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline V sub(const V& a, const V& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline V scaled(const V& a, const Q& s) { return {a[0] * s, a[1] * s, a[2] * s}; }
/// a + b t
inline V add(const V& a, const V& b, const Q& t = 1) { return {a[0] + b[0] * t, a[1] + b[1] * t, a[2] + b[2] * t}; }
inline V cross(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Q square_of(const V& a) { return dot(a, a); }

/// The precision of real numbers, in bits: enough for lengths from 2^-64 to 2^64, and more for a case with a larger
/// range.
using R = mpf_class;
using VR = std::array<R, 3>;
constexpr mp_bitcnt_t usual_bits = 512, bits_for_any_magnitude = 8192;
mp_bitcnt_t bits();
void set_bits(mp_bitcnt_t n);
inline R real(const Q& x) { return R(x, bits()); }
inline VR real(const V& x) { return {real(x[0]), real(x[1]), real(x[2])}; }
inline R length(const V& x) { return sqrt(real(square_of(x))); }

/// Rounds to zero what is within rounding of zero.
bool is_zero(const R& x);
/// Converts to double with an error below one unit in the last place.
double rounded(const R& x);
double rounded(const Q& x);

/// Chooses among several right answers: always the same one, or any of them.
class Choice {
 public:
  Choice() = default;
  explicit Choice(std::mt19937_64& random) : random_(&random) {}

  bool is_free() const { return random_ != nullptr; }
  /// 0 to n - 1. Draws no random number if there is no choice.
  int below(int n) const { return random_ == nullptr || n == 1 ? 0 : int((*random_)() % std::uint64_t(n)); }
  template <class T>
  const T& among(const std::vector<T>& all) const {
    return all[std::size_t(below(int(all.size())))];
  }
  /// 0 to 1, often one of the ends.
  Q share() const { return below(3) == 0 ? Q(below(2)) : Q(below((1 << 20) + 1), 1 << 20); }
  V direction() const;
  /// A point of the convex hull.
  V between(const std::vector<V>& points) const;
  /// m with m . a = 0 for each of `along` and m . b <= 0 for each of `against`, often with equality in the latter.
  /// Empty if none was found or the choice is fixed.
  std::optional<V> in_cone(const std::vector<V>& along, const std::vector<V>& against) const;

 private:
  std::mt19937_64* random_ = nullptr;
};

/// Reads the inputs of a case in order.
class Reader {
 public:
  explicit Reader(std::span<const double> values, Choice choice = {}) : choose(choice), at_(values.data()) {}
  Q number() { return Q(*at_++); }
  V vector() {
    const Q x = number(), y = number(), z = number();
    return {x, y, z};
  }

  const Choice choose;

 private:
  const double* at_;
};

struct RefBox {
  V center, half;
  std::array<V, 3> axes;

  explicit RefBox(Reader& r) : center(r.vector()), half(r.vector()) {
    // The columns of the rotation are the images of the unit vectors: v + 2 w (u x v) + 2 u x (u x v), over |q|^2.
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
  V world(const V& local) const { return add(add(scaled(axes[0], local[0]), axes[1], local[1]), axes[2], local[2]); }
  VR world(const VR& local) const;
};

/// The first numbers of the answer, each with an error below one unit in the last place of a double. Leaves out the
/// rest of the answer if several answers are right.
struct Reference {
  bool yes;
  std::vector<double> values;

  void give(double x) { values.push_back(x); }
  void give(const Q& x) { values.push_back(rounded(x)); }
  void give(const R& x) { values.push_back(rounded(x)); }
  void give(const V& x) {
    for (const Q& c : x) give(c);
  }
  void give(const VR& x) {
    for (const R& c : x) give(c);
  }
  /// n / |n|.
  void give_unit(const V& n) {
    const R l = length(n);
    for (const Q& c : n) give(R(real(c) / l));
  }
};
inline Reference no() { return {false, {}}; }
template <class... Values>
Reference yes(const Values&... values) {
  Reference r{true, {}};
  (r.give(values), ...);
  return r;
}

/// (-b - sqrt(d)) / a, or with the other sign.
inline R root_of(const Q& a, const Q& b, const Q& d, int sign = -1) {
  return (-real(b) + sign * sqrt(real(d))) / real(a);
}
/// x / sqrt(y).
inline R over_root(const Q& x, const Q& y) { return real(x) / sqrt(real(y)); }

inline Q excess(const Q& c, const Q& h) { return c > h ? Q(c - h) : c < -h ? Q(c + h) : Q(0); }

using Derivation = Reference (*)(Reader);
struct Derived {
  const char* query;
  Derivation derivation;
};
std::span<const Derived> of_shapes();
std::span<const Derived> of_boxes();
std::span<const Derived> of_grid();
std::span<const Derived> of_moving_points();
std::span<const Derived> of_moving_spheres();

/// nullptr if the query has none.
Derivation derivation_of(const Query& query);
/// The queries that have a derivation.
std::vector<NamedQuery> derived_queries();

/// A valid case of integers up to `range` in magnitude, with sizes from 0 to 2; half of the quaternions are
/// axis-aligned.
Case lattice_case(const Query& query, Scalar scalar, int range, std::mt19937_64& random);

}  // namespace nearmiss::derived
