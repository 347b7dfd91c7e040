#include "reports/findings/pretty_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

bool fits_on_a_line(const Json& j) {
  if (j.is_object()) return j.empty();
  return !j.is_array() || std::all_of(j.begin(), j.end(), fits_on_a_line);
}

/// Bytes that are not UTF-8, for example in the name of a folder, become U+FFFD.
std::string dumped(const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); }

void put_line(const Json& j, std::string& text) {
  if (!j.is_array()) {
    text += dumped(j);
    return;
  }
  text += '[';
  for (std::size_t i = 0; i < j.size(); ++i) {
    if (i > 0) text += ", ";
    put_line(j[i], text);
  }
  text += ']';
}

void put(const Json& j, std::size_t depth, std::string& text) {
  if (fits_on_a_line(j)) return put_line(j, text);
  text += j.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& item : j.items()) {
    text += first ? "\n" : ",\n";
    first = false;
    text.append(2 * (depth + 1), ' ');
    if (j.is_object()) text += dumped(item.key()) + ": ";
    put(item.value(), depth + 1, text);
  }
  text += '\n';
  text.append(2 * depth, ' ');
  text += j.is_object() ? "}" : "]";
}

}  // namespace

std::string pretty_json(const Json& j) {
  std::string text;
  put(j, 0, text);
  return text + "\n";
}

}  // namespace nearmiss
