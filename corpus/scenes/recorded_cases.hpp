/// Recorded inputs of queries: the files that a recorder (corpus/scenes/nearmiss_record.h) or a program of a user
/// writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corpus/files/errors.hpp"
#include "impl/catalogue/case.hpp"

namespace nearmiss::scenes {

/// Reads one case a line: {"query", "scalar", "values": [the inputs in the order of the query]}, or a case as other
/// files hold it, with "inputs". A decimal means the nearest number of the scalar, unless --exact is given. Empty lines
/// are skipped. Throws BadInput that states file, line, field and rule, also for a file without a case.
std::vector<Case> read_json_lines(const std::filesystem::path& file);
/// The same from rows of comma-separated values: query, scalar, then the inputs in the order of the query. A first row
/// that begins with "query" is a heading and is skipped.
std::vector<Case> read_csv(const std::filesystem::path& file);
/// The cases as read_json_lines() reads them, with "values".
std::string json_lines(const std::vector<Case>& cases);

}  // namespace nearmiss::scenes
