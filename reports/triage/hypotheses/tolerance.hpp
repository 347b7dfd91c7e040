/// Tests whether a finding comes from an absolute tolerance, and estimates its value.
#pragma once

#include <span>

#include "reports/triage/causes/tested.hpp"
#include "reports/triage/trials/scales.hpp"

namespace nearmiss {

/// The error is the same length, or time, at every scale. `scans` are those of scale_groups(), in their order.
Tested constant_error_of(const Trials& trials, std::span<const ScaleScan> scans);
/// The finding comes or goes with the scale, without overflow and underflow, in this case and in most of the similar
/// ones. The tolerance is known where a quantity has the same value wherever the finding ends. An unknown one is named
/// only where the wrong decisions of generated cases err to one side.
Tested tolerance_of(Trials& trials, std::span<const ScaleScan> scans, std::span<const Trial> similar,
                    bool errs_to_both_sides);

}  // namespace nearmiss
