/// JSON laid out for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nearmiss {

/// Two spaces a level; an array without objects stays on one line: [x, y, z]. Ends with a new line.
std::string pretty_json(const nlohmann::ordered_json& j);

}  // namespace nearmiss
