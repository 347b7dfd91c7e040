/// Changes of a scene's cases that may make a cheaper subject good enough.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reports/trade/sources.hpp"

namespace nearmiss {

/// A change that a program can make, and the cases of the scene after it.
struct Remedy {
  std::string name;   ///< "re-centre the origin", "split the step", "another unit"
  std::string words;  ///< what the program does: "keeps positions relative to the corner of a cell of 64 yard"
  TradeSource source;
};

/// The remedies that apply to the query:
///
/// - Re-centre the origin: all positions of a case minus the corner of the cell that contains the first one. The edge
/// of
///   the cell is the least power of two that is at least the largest size, and the largest difference of a coordinate
///   of two positions of a case. The new positions are exact where the scalar holds them.
/// - Split the step: a moving shape starts where it is at the beginning of the eighth of the step in which the contact
///   is; its start is rounded. A limit becomes an eighth.
/// - Another unit: all lengths times the factor of the unit in which the median largest length is nearest to 1, or of
///   the next one if that is the scene's own.
///
/// The tolerance of another unit is in that unit; the other tolerances are unchanged.
std::vector<Remedy> remedies_for(const TradeSource& source, const Query& query, std::uint64_t seed);

}  // namespace nearmiss
