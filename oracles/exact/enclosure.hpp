/// The result of an oracle: an enclosure of every exact answer.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
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
  /// The least absolute value within the bounds.
  double nearest_to_zero() const { return low > 0 ? low : high < 0 ? -high : 0.0; }
  double furthest_from_zero() const { return std::max(-low, high); }
};

/// How far each input number may move: absolute, not negative, one value per number.
using Widening = std::span<const double>;

/// Encloses the exact answers of every input within a widening of the given input, relative to a given answer: `error`
/// holds (exact - given). For the zero answer it holds the exact values themselves.
struct Enclosure {
  bool may_be_yes = false;
  bool may_be_no = false;
  /// Some exact answer may match the given one: the same decision, and every given number within one ulp of its scalar.
  /// False is a proof that none matches.
  bool may_match = false;
  /// Over the exact answers with the given decision. Empty if there is none.
  std::array<Bounds, Answer::capacity> error{};
  /// One member of the answer, compared alone with the exact answers that have the given decision.
  struct Member {
    bool may_match = false;  ///< it may be within one ulp of the member of an exact answer
    double ulps = 0;         ///< the proved distance from the nearest one, in ulps
    double absolute = 0;     ///< the same distance, not in ulps
    int number = -1;         ///< index of the number with this distance; -1: no exact answer has the given decision
  };
  static constexpr std::size_t most_members = 18;
  std::array<Member, most_members> members{};  ///< in the order of the answer's layout
  /// For the exact answer nearest to the given one: the largest proved distance of a number, in ulps, and that number.
  double ulps = 0;
  double absolute = 0;  ///< the same distance, not in ulps
  int worst = -1;
  /// Upper bound of that distance; exceeds `ulps` only by the width of the enclosure.
  double ulps_at_most = 0;
  /// The largest such upper bound over all answers: every exact answer with the given decision is at most this far
  /// away.
  double ulps_at_most_of_any = 0;
  /// The branches of the algorithm that reported an answer: each sets one of 64 bits, by its place in the source. With
  /// several pieces of a shape in one loop, all of them are one branch.
  std::uint64_t branches = 0;
  std::uint32_t answers = 0;  ///< how many answers were reported

  bool decided() const { return may_be_yes != may_be_no; }
};

/// The stages of the oracle: intervals of doubles first, exact rational and algebraic numbers where the intervals
/// cannot tell.
enum class Stage { interval, exact };

/// One right answer, for people.
struct Alternative {
  bool yes = false;
  std::size_t count = 0;  ///< how many of the values it has
  std::array<Bounds, Answer::capacity> values{};
  /// For each of them the nearest number of the scalar, and a decimal for readers (oracles/exact/decimal.hpp).
  std::vector<double> nearest{};
  std::vector<std::string> decimals{};
  /// For a miss: there is a contact, at a time beyond the largest finite number.
  bool late = false;
  /// A range of `direction . normal`.
  struct Face {
    std::array<Bounds, 3> direction;
    std::array<std::string, 3> decimals;  ///< the direction as decimals
    Bounds range;
    bool operator==(const Face&) const = default;
  };
  bool many_normals = false;  ///< every unit vector that satisfies `facing` is a right normal
  std::vector<Face> facing{};

  bool operator==(const Alternative&) const = default;
};

/// Receives the right answers, for people.
struct AlternativeList {
  /// Of the decimals, significant ones; 0: the shortest decimals from which the nearest number of the scalar is read
  /// off.
  int digits = 0;
  std::vector<Alternative> all{};
};

}  // namespace nearmiss
