/// What an implementation promises for a query. Each query has its promise beside its function:
/// `contracts::moving_sphere_plane<Accurate, float>()`.
#pragma once

#include <limits>

namespace collide {

/// A promise; infinity promises nothing. `epsilon` is the unit roundoff of the implementation's
/// scalar: 2^-24 for float, 2^-53 for double.
///
/// The tiers of this library promise one thing more, which is about operations and not about answers: where no
/// operation of a query's kernel rounds, the decision, touches included, and all numbers are the exact ones.
struct Contract {
  static constexpr double none = std::numeric_limits<double>::infinity();

  /// The answer is, to one unit in the last place of each number, an exact answer for some input
  /// whose numbers differ by at most `backward * epsilon * (largest magnitude in the same group)`.
  double backward = none;
  /// Each number of the answer lies within this many units in the last place of an exact one.
  double forward = none;
  /// The yes or no is the exact one.
  bool exact_decisions = false;
  /// Returned unit vectors have a length within `unit * epsilon` of 1.
  double unit = none;
  /// The promise covers inputs where the largest magnitude of each group (positions, velocities, sizes,
  /// directions, rotations, times, offsets) is zero or lies in [2^lowest, 2^highest]; the largest number of each
  /// direction and of each rotation lies there by itself.
  int lowest = -1100;
  int highest = 1100;
};

/// The largest power of two whose `degree`-fold product is finite in T, with room for a few sums.
template <class T>
constexpr int highest_for(int degree) {
  return (std::numeric_limits<T>::max_exponent - 5) / degree;
}
/// The least power of two whose `degree`-fold product, and its rounding error, and the error's own
/// rounding, are normal numbers of T.
template <class T>
constexpr int lowest_for(int degree) {
  return (std::numeric_limits<T>::min_exponent + 2 * std::numeric_limits<T>::digits) / degree;
}
static_assert(highest_for<float>(2) == 61 && lowest_for<float>(2) == -38);
static_assert(highest_for<double>(2) == 509 && lowest_for<double>(2) == -457);

}  // namespace collide
