#include "reports/triage/geometry/ratios.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace nearmiss {

namespace {

bool is_decimal_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The word without what numbers an axis, a corner or an edge: "x", "2", the end of "triangle.v1" and of "weights.y".
std::string_view without_number(std::string_view word) {
  const bool is_number = std::all_of(word.begin(), word.end(), is_decimal_digit);
  const auto is_axis = [](char c) { return c == 'x' || c == 'y' || c == 'z'; };
  const std::size_t n = word.size();
  if (is_number || (n == 1 && is_axis(word[0]))) return {};
  if (n > 2 && word[n - 2] == '.' && is_axis(word[n - 1])) return word.substr(0, n - 1);
  const bool is_corner = n >= 2 && word[n - 2] == 'v' && is_decimal_digit(word[n - 1]);
  return is_corner && (n == 2 || word[n - 3] == '.') ? word.substr(0, n - 1) : word;
}

/// A name without the numbers of axes, corners and edges, and these numbers.
struct Split {
  std::string without, numbers;
};
Split split(const std::string& name) {
  Split s;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find(' ', begin), name.size());
    const std::string_view word = std::string_view(name).substr(begin, end - begin), kept = without_number(word);
    if (!kept.empty() && !s.without.empty()) s.without += ' ';
    s.without += kept;
    s.numbers += word.substr(kept.size());
    begin = end + 1;
  }
  return s;
}

}  // namespace

/// Every ordered pair of different lengths, by its first.
std::pair<std::size_t, std::size_t> Ratios::pair(std::size_t i) const {
  const std::size_t k = i - pure(), others = lengths() - 1, first = k / others, rest = k % others;
  return {first, rest < first ? rest : rest + 1};
}

long double Ratios::value(std::size_t i) const {
  if (i < pure()) return magnitudes_.pure[i].value;
  const auto [a, b] = pair(i);
  const long double over = magnitudes_.lengths[b].value;
  return over > 0 ? magnitudes_.lengths[a].value / over : 0;
}

std::string Ratios::name(std::size_t i) const {
  if (i < pure()) return magnitudes_.pure[i].name;
  const auto [a, b] = pair(i);
  return magnitudes_.lengths[a].name + " over " + magnitudes_.lengths[b].name;
}

std::string Ratios::family(std::size_t i) const {
  if (i < pure()) return split(magnitudes_.pure[i].name).without;
  const auto [a, b] = pair(i);
  const Split first = split(magnitudes_.lengths[a].name), second = split(magnitudes_.lengths[b].name);
  const bool alike = !first.numbers.empty() && first.numbers == second.numbers;
  return first.without + " over " + second.without + (alike ? " with the same number" : "");
}

std::string without_numbers(const std::string& name) { return split(name).without; }

}  // namespace nearmiss
