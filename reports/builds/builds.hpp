/// Compares builds bit for bit: asks subjects that compute in one scalar the same cases, and finds the first case that
/// the first of them, the base, and another one answer differently.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oracles/judge.hpp"
#include "reports/engine/dispatcher.hpp"

namespace nearmiss {

/// A number of two answers that has other bits.
struct DifferentNumber {
  std::size_t output;  ///< index among the query's outputs
  double base, other;
  /// How many numbers of the scalar they are apart; 0 for the two zeros; empty for a flag or an index, and where one is
  /// not finite.
  std::optional<std::uint64_t> ulps;
};

struct BitDifference {
  enum class Kind {
    status,    ///< one of them has no answer, or broke
    decision,  ///< yes and no
    given,     ///< one of them gives a number that the other leaves out
    numbers,
  };
  Kind kind;
  std::vector<DifferentNumber> numbers{};  ///< empty for the other kinds
};
std::string_view name_of(BitDifference::Kind k);

/// Empty where the answers are the same bit for bit: the status, the decision, which numbers are given, and the bits of
/// each number that has a meaning (is_part). All NaN are the same; 0 and -0 are different. Why a subject has no answer
/// does not matter.
std::optional<BitDifference> bit_difference(const Query& query, Scalar scalar, const Answer& base, const Answer& other);

/// An answer and what is proved against it.
struct JudgedAnswer {
  Answer answer;
  /// By the subject's standard; by the measure where its contract does not cover the case.
  Finding finding;
  /// It is an answer with the exact decision, and no number is proved to differ by more than the standard allows.
  bool is_right = false;
};

/// The first case of a comparison with different answers; the first that the base's contract covers, where there is
/// one.
struct FirstDifference {
  Case found;
  bool is_outside;  ///< the base promises something, and not for this case
  /// The simplest case with a difference of the same kind that was found from there. What follows belongs to it.
  Case question;
  BitDifference difference;
  JudgedAnswer base, other;
  Truth truth;
};

/// The answers of the base and another subject to the cases of one query.
struct ComparedBuild {
  const Query* query;
  const Subject *base, *other;
  std::uint64_t asked = 0;  ///< fewer than the cases where one of them was given up, or after an interrupt
  std::uint64_t different = 0;
  std::uint64_t outside = 0;  ///< of these, the cases that the base's contract does not cover
  std::optional<FirstDifference> first{};
};

struct BuildsSettings {
  std::vector<const Query*> queries;
  std::uint64_t seed = 1, cases = 0;         ///< of each query
  int questions = 0;                         ///< the most that a search for a simpler case asks
  std::function<void(const Query&)> tick{};  ///< called often
};

/// Compares each of the others with the first subject, in each query that both offer. The cases meet the preconditions
/// of all of them. All subjects have the same scalar. Ends early after an interrupt.
std::vector<ComparedBuild> compare_builds(const BuildsSettings& settings, std::span<const Subject* const> subjects);

/// Which of the two is right, a sentence without its full stop.
std::string right_text(const ComparedBuild& c);
/// "moving_sphere_box-gcc-o0", for the file of the case.
std::string name_of(const ComparedBuild& c);
/// In the form of a comparison of reports/builds.schema.json. `c.first` must not be empty for "first".
nlohmann::ordered_json compared_to_json(const ComparedBuild& c);
/// A paragraph about a difference.
std::string difference_text(const ComparedBuild& c);

}  // namespace nearmiss
