/// Which cases are inside of what a subject requires.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/subject/precondition.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

/// The numbers of a query's inputs by what they are, from names and roles alone: indices of first numbers.
struct Parts {
  using Corners = std::array<std::size_t, 4>;
  /// What moves, and what it moves towards. A point and a ray's origin have no radius.
  struct Start {
    enum class Obstacle { plane, triangle, rectangle, sphere, capsule, box, aabox };

    std::size_t place = 0;
    std::optional<std::size_t> radius;
    Obstacle obstacle{};
    std::size_t begin = 0, count = 0;  ///< of the obstacle's numbers
  };

  explicit Parts(const Query& query);

  std::vector<Corners> rectangles;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< those that a rectangle is made of, too
  std::vector<std::array<std::size_t, 2>> segments;   ///< axes of capsules, too
  std::vector<std::size_t> normals, directions, quaternions, velocities;
  std::vector<std::size_t> sizes;    ///< each number
  std::vector<std::size_t> aaboxes;  ///< the lower corner; the upper one are the three numbers behind it
  std::optional<Start> start;
};

/// Of a query of the catalogue.
const Parts& parts_of(const Query& query);

/// Whether the query's inputs have anything that the precondition is about.
bool concerns(Precondition p, const Query& query);

/// True only if the case surely meets the precondition; where it is about nothing of the query, it is met. Starts are
/// decided by the exact oracle. Thread-safe.
bool meets(const Case& question, Precondition p);
/// Those among `required` that the case does not surely meet.
Preconditions unmet_by(const Case& question, Preconditions required);

/// "it requires unit quaternions and a start outside".
std::string requires_text(Preconditions required);

/// Asks in this process, unless the case is outside of what the subject requires.
Answer ask_here(const Subject& subject, const Case& question);
/// In place of an answer; the judge says not_asked whatever it is.
Answer answer_of_unasked(Preconditions unmet);

}  // namespace nearmiss
