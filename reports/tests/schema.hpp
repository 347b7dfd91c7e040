/// Validates documents against the shipped JSON Schemas with an independent validator.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nearmiss {

/// "" where `document` is valid under reports/`schema_name`, otherwise every error.
std::string complaints(const nlohmann::json& document, const std::string& schema_name);

}  // namespace nearmiss
