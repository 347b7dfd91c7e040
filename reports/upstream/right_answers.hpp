/// The right answers to a case as a condition that a program can test: each within a stated tolerance.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "oracles/judge.hpp"

namespace nearmiss {

/// A condition on one member of an answer.
struct MemberCondition {
  std::size_t member = 0;      ///< index in the query's layout
  std::vector<double> values;  ///< the right ones, one for each number of the member
  /// The most by which a number may differ from the right one. 0 for flags and indices.
  double tolerance = 0;
  /// For a normal of which many values are right: `direction . normal` lies in [low, high], with the tolerance.
  struct Face {
    std::array<double, 3> direction;
    double low, high;
  };
  std::vector<Face> faces;
  bool any_unit_vector = false;  ///< many normals are right: every unit vector that satisfies `faces`
};

/// One right answer: the decision, and conditions on its members, all of which must hold.
struct RightAnswer {
  bool yes = false;
  std::vector<MemberCondition> members;
};

/// What a program tests. An answer is accepted where it matches one of `any`.
struct RightAnswers {
  std::vector<RightAnswer> any;
  double allowed = 0;     ///< the backward error that an answer may have, in epsilon of the scalar
  double unit_error = 0;  ///< the most by which a normal's length may differ from 1; 0: not tested
  /// The tolerances are smaller than the allowed error: the given members are wrong only together.
  bool narrowed = false;
};

/// The backward error, in epsilon of the scalar, that the standard allows; where it bounds none, the measure.
double allowed_backward_error(const Standard& standard, Scalar scalar);

/// The right answers to a case, with tolerances for the numbers of the outputs in `members` (indices in the layout).
/// A tolerance is the largest distance at which the judge takes a number for right, by the bound of the standard, on
/// lines through the right value: along each axis, and towards `given`. Where `given` is proved to be wrong, it is not
/// accepted; where the judge takes it for right, it is.
RightAnswers right_answers(const Case& question, const Answer& given, const Finding& finding, const Standard& standard,
                           const Truth& truth, const std::vector<std::size_t>& members);

/// True where the conditions accept the answer.
bool accepts(const RightAnswers& right, const Query& query, const Answer& answer);

}  // namespace nearmiss
