/// Leads a case out of the feature regions that its finding does without.
#pragma once

#include <functional>

#include "corpus/generator/feature_regions.hpp"

namespace nearmiss {

/// A case for which `keeps` holds, as it holds for `question`, in some or all of its regions and in no other. Tries
/// quaternions and directions of unit length, the scene turned so that a box is upright, and numbers moved by shares
/// from large to small, all of them or those of one role. `keeps` gets valid cases that are exact in their scalar, at
/// most some hundred. The same in every run.
Case in_fewer_regions(const Case& question, const std::function<bool(const Case&)>& keeps);

}  // namespace nearmiss
