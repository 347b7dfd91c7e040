/// A case under construction, with access to the vectors, sizes and rotations of its operands. For the generator's own
/// sources.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// A generator of the same numbers on every machine: SplitMix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom
/// Number Generators, 2014) and exact arithmetic on its bits.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// 0 ... n - 1, for n at most 2^32.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(((bits() >> 32) * n) >> 32); }
  int between(int low, int high) { return low + int(below(std::size_t(high - low) + 1)); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  double sign() { return one_in(2) ? -1.0 : 1.0; }
  double uniform(double low, double high) { return low + (high - low) * (double(bits() >> 11) * 0x1p-53); }
  double power_of_two(int low, int high) { return std::ldexp(1.0, between(low, high)); }
  template <class T>
  const T& pick(const std::vector<T>& from) {
    return from[below(from.size())];
  }

 private:
  std::uint64_t state_;
};

/// The inputs of a case, listed as the mutators need them. A vector is named by its first number.
struct Plan {
  explicit Plan(const Query& q) : Plan(q, {}) {}
  /// Of cases whose lists have the counts among these values.
  Plan(const Query& q, std::span<const double> values);

  const Query* query;
  std::span<const Field> fields;
  std::uint64_t name_hash;
  std::vector<std::size_t> rotations;  ///< index of the x of each quaternion x, y, z, w
  std::vector<std::size_t> sizes;      ///< one entry per number
  std::vector<std::size_t> upper;      ///< one entry per number of an axis-aligned box's upper corner
  std::vector<std::size_t> lone;  ///< numbers outside of vectors, sizes, rotations and lists: times, flags, indices
  std::vector<Operand> operands;  ///< those with a position, in order
  std::vector<Operand> bodies;    ///< all, with planes
  std::vector<std::size_t> positions, velocities, directions, movable;  ///< movable: all three
  std::array<std::vector<std::size_t>, 16> numbers;                     ///< by role
};

/// The nearest number of the scalar. Not inline: GCC 12 at -O3 drops the rounding of some of several such numbers when
/// it vectorizes them.
double rounded_to(Scalar scalar, double x);

/// The numbers of a case under construction. Rounds every number that is set to the scalar.
class CaseBuilder {
 public:
  CaseBuilder(const Plan& p, Scalar s, Random& r, std::span<double> values)
      : plan(p), scalar(s), random(r), values_(values) {}

  const Plan& plan;
  const Scalar scalar;
  Random& random;
  double unit = 1;  ///< the scene's length unit, a power of two

  bool is_float() const { return scalar == Scalar::float32; }
  /// Float has fewer binary orders of magnitude than double.
  int orders(int of_float, int of_double) const { return is_float() ? of_float : of_double; }

  double operator[](std::size_t i) const { return values_[i]; }
  void set(std::size_t i, double x) { values_[i] = rounded_to(scalar, x); }
  void scale(std::size_t i, double factor) { set(i, values_[i] * factor); }
  void step_ulps(std::size_t i, int ulps);

  using Numbers = std::array<double, 3>;
  Numbers vector(std::size_t v) const { return {values_[v], values_[v + 1], values_[v + 2]}; }
  void set_vector(std::size_t v, const Numbers& x) {
    for (std::size_t k = 0; k < 3; ++k) set(v + k, x[k]);
  }
  /// A vector with components in [-reach, reach].
  Numbers random_vector(double reach) {
    Numbers x;
    for (double& component : x) component = random.uniform(-reach, reach);
    return x;
  }
  /// Two different entries of a list of at least two.
  std::array<std::size_t, 2> two_of(const std::vector<std::size_t>& list) {
    const std::size_t first = random.below(list.size());
    const std::size_t second = (first + 1 + random.below(list.size() - 1)) % list.size();
    return {list[first], list[second]};
  }
  /// Sets one component of each direction and rotation that became zero, and exchanges misplaced corners of a box.
  void repair();

 private:
  std::span<double> values_;
};

/// Fills the builder with a scene: smooth numbers, shapes near each other, velocities aimed at shapes.
void draw_scene(CaseBuilder& builder);

/// An entry of the table of mutators. `apply` returns false, without any change, if the mutator does not apply to the
/// query.
struct Mutator {
  std::string_view name, what;
  bool (*apply)(CaseBuilder& builder);
  bool extreme = false;      ///< leaves moderate magnitudes; extreme mutators end the table
  bool of_features = false;  ///< brings features of two shapes together
};
std::span<const Mutator> mutators();

using Numbers = CaseBuilder::Numbers;

/// a + factor b.
inline Numbers plus(const Numbers& a, const Numbers& b, double factor = 1) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

}  // namespace nearmiss
