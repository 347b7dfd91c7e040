/// Which cases meet the preconditions of a subject.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/subject/precondition.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

/// The inputs of a query by their meaning, derived from names and roles alone. Each entry is the index of a first
/// number.
struct Parts {
  using Corners = std::array<std::size_t, 4>;
  /// The moving shape and its obstacle. A point and a ray's origin have no radius.
  struct Start {
    enum class Obstacle { plane, triangle, rectangle, sphere, capsule, box, aabox };

    std::size_t place = 0;
    std::optional<std::size_t> radius;
    Obstacle obstacle{};
    std::size_t begin = 0, count = 0;  ///< of the obstacle's numbers
  };

  explicit Parts(const Query& query);

  std::vector<Corners> rectangles;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< including those of rectangles
  std::vector<std::array<std::size_t, 2>> segments;   ///< including the axes of capsules
  std::vector<std::size_t> normals, directions, quaternions, velocities;
  std::vector<std::size_t> sizes;    ///< one entry per number
  std::vector<std::size_t> aaboxes;  ///< the lower corner; the upper corner follows it
  std::optional<Start> start;
};

/// The parts of a query of the catalogue.
const Parts& parts_of(const Query& query);

/// Whether the precondition applies to any input of the query.
bool concerns(Precondition p, const Query& query);

/// True only if the case certainly meets the precondition, or if the precondition does not apply to the query. The
/// exact oracle decides whether a start lies outside. Thread-safe.
bool meets(const Case& question, Precondition p);
/// Those of `required` that the case does not certainly meet.
Preconditions unmet_by(const Case& question, Preconditions required);

/// "it requires unit quaternions and a start outside".
std::string requires_text(Preconditions required);

/// Asks the subject in this process, unless the case breaks one of its preconditions.
Answer ask_here(const Subject& subject, const Case& question);
/// Stands in for the answer to a case that the subject is not asked. The judge returns not_asked whatever the answer
/// is.
Answer answer_of_unasked(Preconditions unmet);

}  // namespace nearmiss
