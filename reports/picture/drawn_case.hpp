/// What a picture shows of a case and of an answer to it.
#pragma once

#include <optional>
#include <vector>

#include "reports/findings/report.hpp"
#include "reports/picture/picture_shapes.hpp"

namespace nearmiss {

/// Where an answer says that the shapes are in contact. What it does not say, or says with a number that is not finite,
/// is empty. An answer in the frames of the operands has no place and no normal.
struct DrawnContact {
  bool yes = false;
  std::optional<PictureReal> time;
  std::optional<PictureReal> depth;  ///< negative: apart
  std::vector<PictureVector> places;
  std::optional<PictureVector> normal;  ///< of any length but zero; empty, too, where every one of many is right
};

struct DrawnCase {
  PictureInputs inputs;
  DrawnContact exact;                 ///< of several right answers the one nearest to the given one
  std::size_t alternative = 0;        ///< its index in the truth
  std::optional<DrawnContact> given;  ///< empty where the subject did not answer
};

DrawnCase drawn_case(const Report& r);

}  // namespace nearmiss
