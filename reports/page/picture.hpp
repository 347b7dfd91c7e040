/// The picture of a case as data: its shapes, the motion and the contacts, in exact coordinates about the contact.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "corpus/files/file_value.hpp"
#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The picture of a report's case: a JSON object that a page draws without knowing the query.
///
/// The shapes follow from the query's list of inputs: an input whose members are {center, radius} is a sphere, one
/// whose members are {v0, v1, v2} a triangle, and so on; of an input that is none of these, each position is a point.
/// The velocity moves the shape that stands before it.
///
/// All coordinates are relative to `anchor`, a point of the subject's scalar at or near the true contact, and divided
/// by 2^unit_exponent, which is about as large as the picture. Each number is computed with 512 bits and rounded once,
/// so even a distance far below an ulp of the coordinates has the digits of a double: a picture stays still at every
/// zoom. What is curved or flat is given by signed distances from the anchor for the same reason: the faces of a box as
/// n . x
/// <= d, a sphere by |center| - radius. A moving shape stands where it is at the time `motion.time`.
///
/// Positions of the true contact are enclosures, given by their middle and half their width. Where several answers are
/// right, the one nearest to the claimed one is "true", and the others are "also true". Throws BadInput where the file
/// is no report.
nlohmann::ordered_json picture_of(const Case& question, const FileValue& report);

}  // namespace nearmiss
