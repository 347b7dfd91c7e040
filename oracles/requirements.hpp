/// Which cases meet the preconditions of a subject.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/subject/precondition.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

/// Whether the precondition applies to any input of the query.
bool concerns(Precondition p, const Query& query);

/// True only if the case certainly meets the precondition, or if the precondition does not apply to the query. The
/// exact oracle decides whether a start lies outside. Thread-safe.
bool meets(const Case& question, Precondition p);
/// Those of `required` that the case does not certainly meet.
Preconditions unmet_by(const Case& question, Preconditions required);

/// True for a precondition beyond whose border a library may answer by a rule of its own, such as that a start in touch
/// is a hit. The other ones hold within rounding and have no such border: an input that breaks one of them by little
/// has the exact answer of an input nearby that meets it.
constexpr bool has_border(Precondition p) {
  return p == Precondition::starts_outside || p == Precondition::moves || p == Precondition::no_zero_sizes;
}
/// Those of `required` with a border that concern the query.
Preconditions with_border(const Query& query, Preconditions required);
/// Of the preconditions with a border: those that not certainly every input meets of which each number lies within
/// `moves` (one distance per number, not negative) of the case's number. Thread-safe.
Preconditions unmet_within(const Case& question, Preconditions required, std::span<const double> moves);

/// Whether the moving body or the ray's origin touches or overlaps the other set at the start; of a plane, with the
/// space behind it. For every input of which each number lies within `moves` of the case's; without `moves`, for the
/// case. Empty where this is not proved to be the same for all of them. False where nothing starts. Thread-safe.
std::optional<bool> contact_at_start(const Case& question, std::span<const double> moves = {});

/// "it requires unit quaternions and a start outside".
std::string requires_text(Preconditions required);

/// Asks the subject in this process, unless the case breaks one of its preconditions.
Answer ask_here(const Subject& subject, const Case& question);
/// Stands in for the answer to a case that the subject is not asked. The judge returns not_asked whatever the answer
/// is.
Answer answer_of_unasked(Preconditions unmet);

}  // namespace nearmiss
