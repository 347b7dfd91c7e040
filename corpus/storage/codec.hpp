/// Cases as JSON for people and as bytes for fuzzers. Both forms are exact.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/files/errors.hpp"
#include "corpus/files/files.hpp"
#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// How a decimal is read that is no number of the scalar.
enum class Decimals {
  exact,    ///< it is refused
  nearest,  ///< it means the nearest number of the scalar, and counts in rounded_numbers()
};
/// The rule for the cases that a user gives: `nearest`, until --exact sets it for the rest of the process. The cases
/// that are stored in corpus/, and the reports of Nearmiss, are always read exactly.
Decimals decimals_of_users();
void set_decimals_of_users(Decimals rule);

/// The decimals that this process has read as the nearest number of a scalar.
struct RoundedNumbers {
  std::uint64_t count = 0;
  double most = 0;  ///< the largest distance of a decimal from its number
};
const RoundedNumbers& rounded_numbers();
/// "17 decimals of case files are no floats, and were read as the nearest ones, at most 2.8e-09 away"; empty where
/// there is none.
std::string rounded_numbers_text();

/// {"query", "scalar", "inputs": {nested by field; vectors as [x, y, z]}, "origin": {"from", "seed", "index",
/// "moves"}}. Numbers are decimals that read back as the same double; -0.0 keeps its sign.
nlohmann::ordered_json case_to_json(const Case& c);
/// The inputs are members, in which a vector is [x, y, z] or {x, y, z}, a quaternion [x, y, z, w] or {x, y, z, w}, and
/// a list of counted entries an array of them; or "values", all numbers in the order of the query, in place of
/// "inputs". Throws BadInput, with `where` (a file name) in the message, for an unknown query, a missing, surplus or
/// mistyped field, a number beyond the range of the scalar or, with Decimals::exact, one that the scalar cannot hold,
/// and for inputs that break a rule. "origin" may be missing; "note", "expected" and "worst" (see store.hpp) are
/// allowed and ignored.
Case case_from_json(const nlohmann::json& j, const std::string& where, Decimals decimals = Decimals::exact);
/// The same for a query and a scalar by their names, and numbers in the order of the query.
Case case_from_values(std::string_view query, std::string_view scalar, std::span<const double> values,
                      const std::string& where, Decimals decimals);

/// Nests any list of fields with its values like the inputs of a case. JSON has no numbers that are not finite: they
/// become the strings "Infinity", "-Infinity" and "NaN".
nlohmann::ordered_json fields_to_json(std::span<const Field> fields, std::span<const double> values);

/// Parses JSON more strictly than the library does: a repeated field, a number beyond the range of double and a nonzero
/// number that reads as zero are errors. Throws BadInput that names the field.
nlohmann::json parse_json(std::string_view text, const std::string& where);

/// Reads one case file. Throws BadInput if it is unreadable, not JSON or not a case.
Case read_case(const std::filesystem::path& file, Decimals decimals = Decimals::exact);

/// C++ to paste into a test: the query's inputs by name, exactly, and a call of `Fast`.
std::string case_to_cpp(const Case& c);

/// One byte for the scalar, then each number in little-endian IEEE 754 of that scalar; flags, indices and counts as one
/// signed byte.
std::vector<std::uint8_t> case_to_bytes(const Case& c);
/// Empty if there are too few bytes or the inputs break a rule. Ignores surplus bytes, and all but the lowest bit of
/// the scalar and of a flag; a count that its list cannot have stands for one that it can.
std::optional<Case> case_from_bytes(const Query& query, std::span<const std::uint8_t> bytes);

}  // namespace nearmiss
