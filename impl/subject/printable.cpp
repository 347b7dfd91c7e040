#include "impl/subject/printable.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace nearmiss {

namespace {

struct Character {
  char32_t code;
  std::size_t bytes;  ///< 0: the bytes are not UTF-8
};

/// The first character of a text that is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return {0, 0};
  char32_t code = first & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {0, 0};
    code = code << 6 | (byte(i) & 0x3F);
  }
  constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least[bytes] || code > 0x10FFFF || surrogate ? Character{0, 0} : Character{code, bytes};
}

/// True for direction marks and overrides, line and paragraph separators, and the byte order mark.
bool changes_the_line(char32_t c) {
  return c == 0x061C || c == 0x200E || c == 0x200F || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) ||
         c == 0xFEFF;
}

std::string in_hexadecimal(const char* format, unsigned number) {
  char text[24];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const auto [code, bytes] = first_character(text);
    if (bytes == 0 || code < 0x20 || (code >= 0x7F && code < 0xA0)) {
      for (std::size_t i = 0; i < std::max<std::size_t>(bytes, 1); ++i) {
        shown += in_hexadecimal("\\x%02x", static_cast<unsigned char>(text[i]));
      }
    } else if (changes_the_line(code)) {
      shown += in_hexadecimal("\\u{%04x}", unsigned(code));
    } else {
      shown += text.substr(0, bytes);
    }
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return shown;
}

}  // namespace nearmiss
