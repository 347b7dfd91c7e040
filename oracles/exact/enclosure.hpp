/// What the oracle says of a case: an enclosure of every exact answer.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "impl/catalogue/answer.hpp"

namespace nearmiss {

/// A closed interval of doubles.
struct Bounds {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  bool operator==(const Bounds&) const = default;
  bool empty() const { return low > high; }
  void include(const Bounds& b) {
    if (b.low < low) low = b.low;
    if (b.high > high) high = b.high;
  }
  /// The least absolute value within.
  double nearest_to_zero() const { return low > 0 ? low : high < 0 ? -high : 0.0; }
  double furthest_from_zero() const { return std::max(-low, high); }
};

/// How far each number of the input may move: absolute, one value per input number, not negative.
using Widening = std::span<const double>;

/// Encloses the exact answers of every input within a widening of the given one, seen from a given
/// answer: `error` holds (exact - given). With the zero answer it holds the exact values themselves.
struct Enclosure {
  bool may_be_yes = false;
  bool may_be_no = false;
  /// Some exact answer may agree with the given one: the same yes or no, and every given number within
  /// one ulp of its scalar. False is a proof that none does.
  bool may_match = false;
  /// Over the exact answers with the given yes or no. Empty where there is none.
  std::array<Bounds, Answer::capacity> error{};
  /// One member of the answer, held against the exact answers with the given yes or no by itself.
  struct Member {
    bool may_match = false;  ///< it may be within one ulp of that of an exact answer
    double ulps = 0;         ///< the proved distance from the nearest, in ulps
    double absolute = 0;     ///< the same distance, not in ulps
    int number = -1;         ///< which number of the answer is so far off; -1: there is no such exact answer
  };
  static constexpr std::size_t most_members = 18;
  std::array<Member, most_members> members{};  ///< in the order of the answer's layout
  /// Of the exact answer nearest to the given one: the largest proved distance, in ulps; and to which number.
  double ulps = 0;
  double absolute = 0;  ///< the same distance, not in ulps
  int worst = -1;
  /// Upper bound of that distance: equal to `ulps` but for the width of the enclosure.
  double ulps_at_most = 0;
  /// The largest such upper bound among all answers: no exact answer with the given yes or no is further away.
  double ulps_at_most_of_any = 0;

  bool decided() const { return may_be_yes != may_be_no; }
};

/// Who answers: intervals of doubles first, exact rational and algebraic numbers where they cannot tell.
enum class Stage { interval, exact };

/// One right answer, written down for people.
struct Alternative {
  bool yes = false;
  std::size_t count = 0;  ///< how many of the values it gives
  std::array<Bounds, Answer::capacity> values{};
  /// One `direction . normal` and the range in which it lies.
  struct Face {
    std::array<Bounds, 3> direction;
    Bounds range;
    bool operator==(const Face&) const = default;
  };
  bool many_normals = false;  ///< the normal is any unit vector that faces as listed
  std::vector<Face> facing;

  bool operator==(const Alternative&) const = default;
};

}  // namespace nearmiss
