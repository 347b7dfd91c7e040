/// Parts of an advice as JSON, for all files that have them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/advice/evidence.hpp"

namespace nearmiss {

nlohmann::ordered_json evidence_to_json(const SceneEvidence& e);

}  // namespace nearmiss
