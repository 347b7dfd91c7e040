/// Formats numbers, lists and tables for readers.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/files/near_words.hpp"
#include "oracles/judge.hpp"
#include "reports/findings/encoded.hpp"

namespace nearmiss {

/// The shortest decimal that reads back as the same number of `scalar`; NaN, Infinity, -Infinity.
std::string number_text(double x, Scalar scalar = Scalar::float64);
/// The same for a number of an answer, where zero has no sign.
inline std::string value_text(double x, Scalar scalar = Scalar::float64) { return number_text(x + 0.0, scalar); }
/// "0", "1", "2", "4", "8", "2^4", ... for a rung of the judge's ladder; any other number as a decimal.
std::string epsilons_text(double k);
/// "0.78 % of the largest number of its group, 2^46 epsilon"; `k` in units of the scalar's epsilon.
std::string amount_text(double k, Scalar scalar);
/// Three digits: "12.3", "2880", "1.5e-07"; "-" without a number.
std::string three_digits(const std::optional<double>& x);
/// 1234567 as "1,234,567".
std::string count_text(std::uint64_t n);
/// "1 case", "1,234 cases", "2 misses", "3 queries".
std::string plural_text(std::uint64_t n, std::string_view noun);
/// "a", "a and b", "a, b and c".
std::string list_text(std::span<const std::string> items);

/// The error for a word that is not among `words`: "unknown query 'x'; did you mean …?", or, where no word is near, the
/// command that lists them.
std::string unknown_text(std::string_view what, std::string_view word, std::span<const std::string> words,
                         std::string_view lists_them = "nearmiss list");

/// Text for one line: printable (impl/subject/printable.hpp), and shortened in its middle where it exceeds `most`
/// bytes.
std::string one_line(std::string_view text, std::size_t most = 1000);

/// A file or folder for a line of text: as printable().
std::string path_text(const std::filesystem::path& path);

/// The first whole words of a text, on one line of at most `most` bytes; " ..." stands for those that are left out. A
/// first word that is longer is cut.
std::string first_words(std::string_view text, std::size_t most);

/// A table with columns padded to their widest cell and two spaces between them; the first row is the heading. Columns
/// from `right_from` on are aligned to the right. Cells are shown as printable() writes them.
std::string table_text(std::vector<std::vector<std::string>> rows, std::string_view indent = "",
                       std::size_t right_from = std::size_t(-1));

/// A paragraph, as printable() writes it, broken at spaces into lines of at most `width`; each line begins with
/// `indent`.
std::string wrapped_text(std::string_view paragraph, std::string_view indent, std::size_t width = 100);

}  // namespace nearmiss
