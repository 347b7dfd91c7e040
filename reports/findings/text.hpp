/// Numbers and lists as people read them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/judge.hpp"

namespace nearmiss {

/// The shortest decimal that reads back as the same number of `scalar`; NaN, Infinity, -Infinity.
std::string number_text(double x, Scalar scalar = Scalar::float64);
/// The same of a number of an answer, where zero has no sign.
inline std::string value_text(double x, Scalar scalar = Scalar::float64) { return number_text(x + 0.0, scalar); }
/// The shortest decimal within the bounds where they are neighbours or nearly so, otherwise "between LOW
/// and HIGH".
std::string bounds_text(const Bounds& b);
/// "0", "1", "2", "4", "8", then "2^4 …": a rung of the judge's ladder, or any other number.
std::string epsilons_text(double k);
/// "0.78 % of the largest number in its group (2^46 epsilon)"; `k` in units of the scalar's epsilon.
std::string amount_text(double k, Scalar scalar);
/// 1234567 as "1,234,567".
std::string count_text(std::uint64_t n);
/// "1 case", "1,234 cases", "2 misses".
std::string plural_text(std::uint64_t n, std::string_view noun);
/// "a", "a and b", "a, b and c".
std::string list_text(std::span<const std::string> items);

/// For a shell's command line: in single quotes where it holds more than plain characters.
std::string shell_quoted(const std::string& word);

/// The words nearest to `word` in spelling, whatever the case, best first; at most three, none where all are far.
std::vector<std::string> close_matches(std::string_view word, std::span<const std::string> words);

/// The error for a word that is none of `words`: "unknown query 'x'; did you mean …?", or who lists them where no word
/// is near.
std::string unknown_text(std::string_view what, std::string_view word, std::span<const std::string> words,
                         std::string_view lists_them = "nearmiss list");

/// For one line: printable (impl/subject/printable.hpp), and without its middle what is longer than `most` bytes.
std::string one_line(std::string_view text, std::size_t most = 1000);

/// Columns padded to their widest cell, two spaces between them; the first row is the heading. Columns
/// from `right_from` on are aligned to the right.
std::string table_text(const std::vector<std::vector<std::string>>& rows, std::string_view indent = "",
                       std::size_t right_from = std::size_t(-1));

/// Text broken at spaces so that no line is longer than `width`; each line begins with `indent`.
std::string wrapped_text(std::string_view text, std::string_view indent, std::size_t width = 100);

}  // namespace nearmiss
