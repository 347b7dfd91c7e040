/// What an implementation promises for a query. The judge reads these numbers and nothing else.
#pragma once

#include <limits>

namespace collide {

/// A promise; infinity promises nothing. `epsilon` is the unit roundoff of the implementation's
/// scalar: 2^-24 for float, 2^-53 for double.
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
  /// The promise covers inputs whose nonzero numbers lie in [2^lowest, 2^highest].
  int lowest = -1100;
  int highest = 1100;
};

}  // namespace collide
