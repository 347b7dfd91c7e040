#include "reports/findings/encoded.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "impl/subject/printable.hpp"

namespace nearmiss {

namespace {

constexpr std::string_view plain_in_a_shell = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+:=@";

bool is_letter_or_digit(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9'); }

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// The number of characters of the longest run of `c`.
std::size_t longest_run(std::string_view text, char c) {
  std::size_t longest = 0, run = 0;
  for (const char x : text) {
    run = x == c ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

/// The place of the character that makes the line an item of a list or an underline: "-", or the point of "1."; npos
/// where there is none. Characters that are always escaped are not meant.
std::size_t begins_a_block(std::string_view line) {
  const std::size_t number = std::min(line.find_first_not_of("0123456789"), line.size());
  const std::string_view marks = number == 0 ? "-+=" : ".)";
  return number < line.size() && marks.find(line[number]) != std::string_view::npos ? number : std::string_view::npos;
}

}  // namespace

std::string for_terminal(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    shown += printable(text.substr(0, end));
    if (end < text.size()) shown += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return shown;
}

std::string in_c_comment(std::string_view text) {
  std::string safe;
  for (const char c : printable(text)) {
    const char before = safe.empty() ? '\0' : safe.back();
    const bool joins = (before == '*' && c == '/') || (before == '/' && c == '*') || (before == '?' && c == '?') ||
                       (before == '\\' && c == ' ');
    if (joins) safe += before == '\\' ? '.' : ' ';
    safe += c;
  }
  if (safe.ends_with('\\')) safe += '.';  // at the end of a line it would join the next one
  return safe;
}

std::string c_string(std::string_view text) {
  std::string literal = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\' || c == '?') {  // a question mark: two of them begin a trigraph
      literal += '\\';
      literal += c;
    } else if (byte < 0x20 || byte >= 0x7F) {
      literal += fmt::format("\\{:03o}", unsigned(byte));
    } else {
      literal += c;
    }
  }
  return literal + '"';
}

std::string in_markdown(std::string_view text) {
  constexpr std::string_view special = "\\`*_[]<>&|~$#!";
  const std::string line = printable(text.substr(std::min(text.find_first_not_of(' '), text.size())));
  const std::size_t marker = begins_a_block(line);
  std::string safe;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool within_word = i > 0 && i + 1 < line.size() && is_letter_or_digit(line[i - 1]) &&
                             is_letter_or_digit(line[i + 1]) && line[i] == '_';
    if (i == marker || (special.find(line[i]) != std::string_view::npos && !within_word)) safe += '\\';
    safe += line[i];
  }
  return safe;
}

std::string markdown_block(std::string_view text, std::string_view language) {
  constexpr std::size_t usual_fence = 3;
  const std::string code = for_terminal(text);
  const std::string fence(std::max(usual_fence, longest_run(code, '`') + 1), '`');
  return fmt::format("{}{}\n{}{}{}\n", fence, language, code, code.ends_with('\n') ? "" : "\n", fence);
}

std::string in_html_script(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("</")) {
      safe += "<\\/";
      ++i;
    } else if (rest.starts_with("<!--")) {
      safe += "\\u003c";
    } else {
      safe += text[i];
    }
  }
  return safe;
}

std::string in_xml(std::string_view text) {
  std::string safe;
  for (const char c : for_terminal(text)) {
    switch (c) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      default: safe += c;
    }
  }
  replace_all(safe, "\xEF\xBF\xBE", "\\u{fffe}");  // the two characters that XML forbids beside control characters
  replace_all(safe, "\xEF\xBF\xBF", "\\u{ffff}");
  return safe;
}

std::string csv_cell(std::string_view text) {
  std::string cell = printable(text);
  constexpr std::string_view begins_a_formula = "=+-@";
  if (!cell.empty() && begins_a_formula.find(cell.front()) != std::string_view::npos) cell.insert(0, "'");
  if (cell.find_first_of(",;\"'") == std::string::npos) return cell;
  replace_all(cell, "\"", "\"\"");
  return '"' + cell + '"';
}

std::string shell_quoted(const std::string& word) {
  if (!word.empty() && word.find_first_not_of(plain_in_a_shell) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'') {
      text.append("'\\''");
    } else {
      text.push_back(c);
    }
  }
  text.push_back('\'');
  return text;
}

std::optional<std::vector<std::string>> words_of_shell(std::string_view line) {
  std::vector<std::string> words;
  bool within_word = false;
  while (!line.empty()) {
    const char c = line.front();
    if (c == ' ') {
      within_word = false;
      line.remove_prefix(1);
      continue;
    }
    if (!within_word) words.emplace_back();
    within_word = true;
    if (c == '\'') {
      const std::size_t end = line.find('\'', 1);
      if (end == std::string_view::npos) return std::nullopt;
      words.back() += line.substr(1, end - 1);
      line.remove_prefix(end + 1);
    } else if (line.starts_with("\\'")) {
      words.back() += '\'';
      line.remove_prefix(2);
    } else if (plain_in_a_shell.find(c) != std::string_view::npos) {
      words.back() += c;
      line.remove_prefix(1);
    } else {
      return std::nullopt;
    }
  }
  return words;
}

}  // namespace nearmiss
