/// A picture of a case in characters.
#pragma once

#include <string>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// The shapes of the case, seen along one coordinate axis: the one along which the motion, the distance of the shapes
/// and the exact normal extend least. A shape is drawn by its exact projection, sampled at the middle of each
/// character. Lines of text with a legend; empty for a case that is a point, is not finite, has a shape without
/// bounds, or has none that covers the middle of a character.
std::string text_picture(const Report& r);

}  // namespace nearmiss
