/// The picture of a case as an SVG file.
#pragma once

#include <string>

#include "reports/picture/flat_picture.hpp"

namespace nearmiss {

/// What flat_picture() says, as SVG that needs no font and no file beside it. The exact answer is green: filled discs,
/// wide arrows and solid outlines; the given one is red: crosses, thin arrows and dashed outlines. Coordinates are
/// rounded to tenths of a pixel. Empty for an empty picture.
std::string svg_picture(const FlatPicture& picture);

}  // namespace nearmiss
