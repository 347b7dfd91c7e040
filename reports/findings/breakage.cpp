#include "reports/findings/breakage.hpp"

#include <algorithm>
#include <cctype>

#include "impl/host/reasons.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

/// Longest kind in bytes.
constexpr std::size_t most_bytes = 80;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_of_word(char c) { return is_digit(c) || is_letter(c) || c == '_'; }

/// True for a name with an extension of one to four letters, as source files have.
bool is_source_file(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot == 0 || name.size() - dot > 5 || dot + 1 == name.size()) return false;
  return std::all_of(name.begin() + std::ptrdiff_t(dot) + 1, name.end(), is_letter);
}

/// "gjk.h:335" of "./narrowphase/gjk.h:335: …" and of "gjk.h:(335): …"; empty without such a place.
std::string place_in(std::string_view text) {
  for (std::size_t colon = 0; (colon = text.find(':', colon)) != std::string_view::npos; ++colon) {
    std::size_t begin = colon;
    while (begin > 0 && (is_of_word(text[begin - 1]) || text[begin - 1] == '.' || text[begin - 1] == '-' ||
                         text[begin - 1] == '+')) {
      --begin;
    }
    std::size_t line = colon + 1;
    if (line < text.size() && text[line] == '(') ++line;
    const std::size_t end = std::find_if_not(text.begin() + std::ptrdiff_t(line), text.end(), is_digit) - text.begin();
    const std::string_view file = text.substr(begin, colon - begin);
    if (end > line && is_source_file(file)) return std::string(file) + ":" + std::string(text.substr(line, end - line));
  }
  return {};
}

/// The length of the number, or of nan or inf, that begins at `at`; 0 where none begins there.
std::size_t number_at(std::string_view text, std::size_t at) {
  if (at > 0 && is_of_word(text[at - 1])) return 0;
  std::size_t end = at;
  if (text[end] == '-' || text[end] == '+') ++end;
  for (const std::string_view word : {"nan", "inf"}) {
    const bool whole = end + word.size() >= text.size() || !is_of_word(text[end + word.size()]);
    if (text.substr(end, word.size()) == word && whole) return end + word.size() - at;
  }
  if (end >= text.size() || !is_digit(text[end])) return 0;
  const auto goes_on = [&](std::size_t i) {  // digits of any base, a fraction, an exponent with its sign
    return std::isxdigit(static_cast<unsigned char>(text[i])) != 0 || text[i] == 'x' || text[i] == 'p' ||
           (text[i] == '.' && i + 1 < text.size() && is_digit(text[i + 1])) ||
           ((text[i] == '-' || text[i] == '+') && (text[i - 1] == 'e' || text[i - 1] == 'p'));
  };
  while (end < text.size() && goes_on(end)) ++end;
  return end - at;
}

std::string without_numbers(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = number_at(text, i);
    if (length > 0) {
      plain += 'N';
      i += length;
    } else {
      plain += text[i++];
    }
  }
  return plain;
}

/// At most `most_bytes` of a text, without its last word where that is cut and not longer than the rest.
std::string whole_words(const std::string& text) {
  if (text.size() <= most_bytes) return text;
  const std::size_t space = text.rfind(' ', most_bytes);
  return text.substr(0, space == std::string::npos || space < most_bytes / 2 ? most_bytes : space);
}

}  // namespace

BreakCause cause_in_report(std::string_view reason, bool late) {
  if (late) return BreakCause::time_limit;
  for (const BreakCause cause : {BreakCause::exception, BreakCause::signal, BreakCause::exit_code}) {
    if (reason.starts_with(reason_prefix(cause))) return cause;
  }
  return BreakCause::other;
}

std::string kind_of_breakage(std::string_view reason, BreakCause cause) {
  if (reason.empty()) return "no reason given";
  if (cause == BreakCause::time_limit)
    return reason.ends_with(not_again_suffix) ? "late in a batch, not again alone" : "no answer in time";
  if (reason.ends_with(not_again_suffix)) {
    reason.remove_suffix(not_again_suffix.size());
    return "in a batch, not again alone: " + kind_of_breakage(reason, cause);
  }
  // The number of a signal and an exit code are part of the kind: only the text behind them loses its numbers.
  const std::string_view head = cause == BreakCause::other ? "" : reason.substr(0, reason.find(": "));
  const std::string place = place_in(reason);
  if (!place.empty()) return one_line(head.empty() ? place : std::string(head) + " at " + place);
  return one_line(whole_words(std::string(head) + without_numbers(reason.substr(head.size()))));
}

}  // namespace nearmiss
