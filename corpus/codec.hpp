/// Cases as JSON for people and as bytes for fuzzers. Both are exact.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/errors.hpp"
#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// {"query", "scalar", "inputs": {nested by field; vectors as [x, y, z]}, "origin": {"from", "seed",
/// "index", "moves"}}. Numbers are decimals that read back as the same double; -0.0 keeps its sign.
nlohmann::ordered_json case_to_json(const Case& c);
/// Throws BadInput with `where` (a file name) for an unknown query, a missing, surplus or mistyped
/// field, a number that the scalar cannot hold exactly, and for inputs that break a rule. "origin" may
/// be missing; "note" and "expected" (see store.hpp) are allowed and not read.
Case case_from_json(const nlohmann::json& j, const std::string& where);

/// Nested like the inputs of a case: any list of fields with its values. JSON has no word for numbers
/// that are not finite: they become the strings "Infinity", "-Infinity" and "NaN".
nlohmann::ordered_json fields_to_json(std::span<const Field> fields, std::span<const double> values);

/// Text as JSON, stricter than the library: a field given twice, a number beyond the range of double
/// and a nonzero number that reads as zero are errors. Throws BadInput that names the field.
nlohmann::json parse_json(std::string_view text, const std::string& where);

/// The whole file. Throws BadInput when it cannot be read.
std::string read_file(const std::filesystem::path& file);
/// Reads one case file. Throws BadInput: unreadable, not JSON, not a case.
Case read_case(const std::filesystem::path& file);
/// With those above it, where they are missing. Throws BadInput where it cannot be made.
void make_folder(const std::filesystem::path& folder);
/// Writes to a temporary name beside `file` and renames. Throws BadInput when it cannot be written.
void write_file(const std::filesystem::path& file, std::string_view text);

/// C++ that can be pasted into a test: the query's inputs by name, exactly, and the question to `Fast`.
std::string case_to_cpp(const Case& c);

/// One byte for the scalar, then each number in little-endian IEEE 754 of that scalar; flags and
/// indices as one signed byte.
std::vector<std::uint8_t> case_to_bytes(const Case& c);
/// Empty when there are too few bytes or the inputs break a rule; surplus bytes are ignored, and so are
/// all bits but the lowest of the scalar and of a flag.
std::optional<Case> case_from_bytes(const Query& query, std::span<const std::uint8_t> bytes);

}  // namespace nearmiss
