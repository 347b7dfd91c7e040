#include "reports/findings/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "impl/subject/printable.hpp"

namespace nearmiss {

namespace {

/// The number of characters: bytes that do not continue a UTF-8 sequence.
std::size_t width_of(std::string_view s) {
  return std::size_t(std::count_if(s.begin(), s.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Most bytes of an unknown word that an error message quotes.
constexpr std::size_t most_of_a_word = 100;

}  // namespace

std::string number_text(double x, Scalar scalar) {
  if (std::isnan(x)) return "NaN";
  if (std::isinf(x)) return x > 0 ? "Infinity" : "-Infinity";
  return scalar == Scalar::float32 ? fmt::format("{}", float(x)) : fmt::format("{}", x);
}

std::string epsilons_text(double k) {
  int exponent = 0;
  if (k >= 16 && std::frexp(k, &exponent) == 0.5) return fmt::format("2^{}", exponent - 1);
  return fmt::format("{:g}", k);
}

std::string amount_text(double k, Scalar scalar) {
  const double relative = k * unit_roundoff(scalar);
  const std::string share = relative >= 1      ? fmt::format("{:.2g} times", relative)
                            : relative >= 1e-5 ? fmt::format("{:.2g} % of", 100 * relative)
                                               : fmt::format("{:.1e} times", relative);
  return fmt::format("{} the largest number of its group, {} epsilon", share, epsilons_text(k));
}

std::string three_digits(const std::optional<double>& x) {
  if (!x) return "-";
  const double size = std::abs(*x);
  if (*x != 0 && (size >= 1e6 || size < 1e-3)) return fmt::format("{:.1e}", *x);
  if (size < 1000) return fmt::format("{:.3g}", *x);
  const double unit = size < 1e4 ? 10 : size < 1e5 ? 100 : 1000;
  return fmt::format("{:.0f}", std::round(*x / unit) * unit);
}

std::string count_text(std::uint64_t n) {
  const std::string digits = std::to_string(n);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string plural_text(std::uint64_t n, std::string_view noun) {
  constexpr std::string_view vowels = "aeiou";
  const bool turns_to_ies =
      noun.size() > 1 && noun.back() == 'y' && vowels.find(noun[noun.size() - 2]) == std::string_view::npos;
  if (n != 1 && turns_to_ies) return fmt::format("{} {}ies", count_text(n), noun.substr(0, noun.size() - 1));
  const std::string_view ending = n == 1                                                               ? ""
                                  : noun.ends_with('s') || noun.ends_with('x') || noun.ends_with("ch") ? "es"
                                                                                                       : "s";
  return fmt::format("{} {}{}", count_text(n), noun, ending);
}

std::string list_text(std::span<const std::string> items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

std::string unknown_text(std::string_view what, std::string_view word, std::span<const std::string> words,
                         std::string_view lists_them) {
  const std::vector<std::string> close = close_matches(word, words);
  return fmt::format("unknown {} '{}'; {}", what, one_line(word, most_of_a_word),
                     close.empty() ? fmt::format("'{}' lists all", lists_them)
                                   : fmt::format("did you mean {}?", fmt::join(close, " or ")));
}

std::string one_line(std::string_view text, std::size_t most) {
  const std::size_t kept_at_end = most / 3;
  const auto continues = [&](std::size_t i) { return i < text.size() && (text[i] & 0xC0) == 0x80; };
  std::size_t cut = text.size(), goes_on = text.size();
  if (text.size() > most) {
    for (cut = most - kept_at_end; continues(cut);) --cut;
    for (goes_on = text.size() - kept_at_end; continues(goes_on);) ++goes_on;
  }
  if (cut == text.size()) return printable(text);
  return fmt::format("{} ... ({} bytes) ... {}", printable(text.substr(0, cut)), count_text(goes_on - cut),
                     printable(text.substr(goes_on)));
}

std::string path_text(const std::filesystem::path& path) { return printable(path.string()); }

std::string first_words(std::string_view text, std::size_t most) {
  constexpr std::string_view left_out = " ...";
  const std::string line = printable(text);
  if (line.size() <= most) return line;
  std::size_t cut = most - left_out.size();
  if (line[cut] != ' ') {
    const std::size_t space = line.rfind(' ', cut);
    if (space != std::string::npos && space > 0) cut = space;
  }
  while (cut > 0 && (line[cut] & 0xC0) == 0x80) --cut;
  return line.substr(0, cut) + std::string(left_out);
}

std::string table_text(std::vector<std::vector<std::string>> rows, std::string_view indent, std::size_t right_from) {
  for (auto& row : rows) {
    for (std::string& cell : row) cell = printable(cell);
  }
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line(indent);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t padding = widths[i] - width_of(row[i]);
      line.append(i >= right_from ? padding : 0, ' ');
      line += row[i];
      line.append((i >= right_from ? 0 : padding) + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string wrapped_text(std::string_view paragraph, std::string_view indent, std::size_t width) {
  const std::string shown = printable(paragraph);
  std::string_view text = shown;
  std::string wrapped, line(indent);
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    const bool first = line.size() == indent.size();
    if (!first && width_of(line) + 1 + width_of(word) > width) {
      wrapped += line + "\n";
      line = indent;
    } else if (!first) {
      line += ' ';
    }
    line += word;
  }
  return wrapped + line + "\n";
}

}  // namespace nearmiss
