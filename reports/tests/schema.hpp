/// The shipped JSON Schemas, applied by a validator that is not ours.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nearmiss {

/// "" when `document` is valid under reports/`schema_name`, otherwise every complaint.
std::string complaints(const nlohmann::json& document, const std::string& schema_name);

}  // namespace nearmiss
