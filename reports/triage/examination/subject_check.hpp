/// Checks how a subject is asked before its library is examined: ordinary cases, and the other meanings of their inputs
/// and answers that explain the wrong answers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "oracles/judge.hpp"
#include "reports/findings/workers.hpp"
#include "reports/triage/hypotheses/readings.hpp"

namespace nearmiss {

/// Readings that hold together and explain wrong answers: one, or two of which the second reads what the first has
/// read.
struct Misreading {
  std::vector<const Reading*> readings;
  std::size_t explained = 0;  ///< wrong answers that are right under it
};

/// A wrong answer as an example.
struct WrongOrdinary {
  Case question;
  Answer answer;
  Truth truth;
  std::string note;  ///< of a stored case: how its answer is derived by hand
};

/// The answers of a subject to the ordinary cases of one query.
struct CheckedQuery {
  const Query* query = nullptr;
  std::string subject;
  std::size_t asked = 0;           ///< cases
  std::size_t right = 0;           ///< answers against which nothing is proved
  std::size_t wrong = 0;           ///< answers that are proved wrong
  std::size_t broke = 0;           ///< cases that broke the subject
  std::size_t without_answer = 0;  ///< cases to which the subject has no answer
  std::size_t not_asked = 0;       ///< cases behind those in which the subject always broke, or was often late
  std::string why_broke;           ///< the reason of the first break
  std::optional<Misreading> misreading;
  std::optional<WrongOrdinary> example;

  bool is_fine() const { return wrong == 0 && broke == 0; }
  /// Every wrong answer is explained.
  bool is_explained() const { return misreading && misreading->explained == wrong; }
};

/// Asks the stored seeds of the query, which people derived by hand, and 64 generated scenes of moderate numbers. A
/// misreading explains nearly all wrong answers, or nearly all for which a meaning of the decision makes a difference,
/// and makes no right answer wrong. Pairs are tried where most answers are wrong. Deterministic. Throws InternalError
/// (oracles/confirmed.hpp).
CheckedQuery check_query(const Query& query, const Subject& subject, Workers& workers);

/// Lines for people: the counts, the misreading and the example.
std::string checked_text(const CheckedQuery& checked, Scalar scalar);

}  // namespace nearmiss
