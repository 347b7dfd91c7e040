/// Reads causes from files of triage.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "corpus/files/file_value.hpp"
#include "reports/triage/causes/cause.hpp"

namespace nearmiss {

/// The inverse of cause_to_json(); the number of questions may be missing. Throws BadInput.
Cause cause_from_json(const FileValue& j);

}  // namespace nearmiss
