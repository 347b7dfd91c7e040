#include "reports/findings/pretty_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "impl/subject/printable.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

bool fits_on_a_line(const Json& j) {
  if (j.is_object()) return j.empty();
  return !j.is_array() || std::all_of(j.begin(), j.end(), fits_on_a_line);
}

/// True for characters that JSON allows in a string and that have an effect on a terminal.
bool has_effect(std::string_view character) { return printable(character) != character; }

/// "\u202e" for a character of two or three bytes, as all that have an effect are; "\u007f" for DEL.
std::string escaped(std::string_view character) {
  unsigned code = static_cast<unsigned char>(character[0]) & (character.size() == 2 ? 0x1Fu : 0x0Fu);
  for (const char c : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3Fu);
  return fmt::format("\\u{:04x}", character.size() == 1 ? 0x7Fu : code);
}

/// Bytes that are not UTF-8, for example in the name of a folder, become U+FFFD. Characters with an effect on a
/// terminal are escaped, which in JSON means the same.
std::string dumped(const Json& j) {
  const std::string text = j.dump(-1, ' ', false, Json::error_handler_t::replace);
  const auto is_plain = [](char c) { return static_cast<unsigned char>(c) < 0x7F; };
  if (std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string safe;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    while (end < text.size() && (text[end] & 0xC0) == 0x80) ++end;
    const std::string_view character = std::string_view(text).substr(i, end - i);
    if (!is_plain(text[i]) && has_effect(character)) {
      safe += escaped(character);
    } else {
      safe += character;
    }
    i = end;
  }
  return safe;
}

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
