/// Reduces a case to a simpler one with the same finding.
#pragma once

#include <functional>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The simplest case found for which `keeps` holds: few entries in lists, and then zeros, small integers, few
/// significant bits, few distinct numbers. `keeps(c)` must hold. It is called at most `questions` times, always with
/// valid cases that are exact in their scalar. Deterministic.
Case shrink(const Case& c, const std::function<bool(const Case&)>& keeps, int questions = 20000);

}  // namespace nearmiss
