/// Reads causes from files of triage.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/triage/cause.hpp"

namespace nearmiss {

/// The inverse of cause_to_json(); the number of questions may be missing. Throws nlohmann::json::exception.
Cause cause_from_json(const nlohmann::json& j);

}  // namespace nearmiss
