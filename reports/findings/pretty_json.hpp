/// Formats JSON for readers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nearmiss {

/// Two spaces per level; an array without objects stays on one line: [x, y, z]. The text ends with a newline.
std::string pretty_json(const nlohmann::ordered_json& j);

}  // namespace nearmiss
