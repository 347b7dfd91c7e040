/// The accuracy that an implementation promises for a query. Each query has its contract beside its declaration:
/// `contracts::moving_sphere_plane<Accurate, float>()`.
///
/// The derivations beside the contracts use these terms:
///
/// - `eps` is the unit roundoff of the scalar: 2^-24 for float, 2^-53 for double. It is half of
///   std::numeric_limits<T>::epsilon().
/// - "A value has an error of k eps of X" means: the computed value differs from the exact one by at most k eps |X|.
/// - "First order" means: terms in eps^2 are left out. Every bound is rounded up to cover them.
/// - "Moving the point accounts for an error" means: the computed value is the exact value for a point moved by as
///   much. Such an error counts in `backward`.
/// - G is the largest magnitude among the positions of the input.
#pragma once

#include <limits>

namespace collide {

/// The bounds that an implementation promises; infinity promises nothing.
///
/// The tiers of this library also promise: where no operation of a query's kernel rounds, the decision (touches
/// included) and all numbers are exact.
struct Contract {
  static constexpr double none = std::numeric_limits<double>::infinity();

  /// Each answer is an exact answer, up to one unit in the last place of each number, for some input whose numbers
  /// differ from the given ones by at most `backward * eps * (largest magnitude in the same group)`. A group is all
  /// numbers of one role (members.hpp).
  double backward = none;
  /// Each number of the answer lies within this many units in the last place of an exact one.
  double forward = none;
  /// The decision (yes or no) is exact.
  bool exact_decisions = false;
  /// The length of each returned unit vector lies within `unit * eps` of 1.
  double unit = none;
  /// The domain of the contract: in each group the largest magnitude is zero or lies in [2^lowest, 2^highest]. For
  /// directions and rotations, the largest number of each single one must lie in that range.
  int lowest = -1100;
  int highest = 1100;
};

/// The exponent of the largest power of two whose `degree`-fold product is finite in T, with room for a few sums.
template <class T>
constexpr int highest_for(int degree) {
  return (std::numeric_limits<T>::max_exponent - 5) / degree;
}
/// The exponent of the least power of two whose `degree`-fold product is a normal number of T, as are its rounding
/// error and the rounding error of that error.
template <class T>
constexpr int lowest_for(int degree) {
  return (std::numeric_limits<T>::min_exponent + 2 * std::numeric_limits<T>::digits) / degree;
}
static_assert(highest_for<float>(2) == 61 && lowest_for<float>(2) == -38);
static_assert(highest_for<double>(2) == 509 && lowest_for<double>(2) == -457);

}  // namespace collide
