/// Reads and writes whole files, of any kind.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "corpus/files/errors.hpp"

namespace nearmiss {

/// The whole file. Throws BadInput if it cannot be read.
std::string read_file(const std::filesystem::path& file);

/// Makes the folder and its missing parents. Throws IoError if it cannot be made.
void make_folder(const std::filesystem::path& folder);

/// Replaces the content of a regular file, or of one that does not exist yet, in one step: writes a temporary file
/// beside it and renames it. A link stays, and the file that it leads to is replaced. Writes straight into anything
/// else, such as a device, a pipe, a terminal, or an open file of a process by its name in /proc. Throws IoError.
void write_file(const std::filesystem::path& file, std::string_view text);

/// Throws IoError for each reason known now why write_file() would fail. Changes nothing. Call it before long work
/// whose result goes into the file.
void check_can_write(const std::filesystem::path& file);

/// Makes the folder. Throws IoError if it cannot be made or if no file can be made in it. Call it before long work
/// whose results go into the folder.
void make_writable_folder(const std::filesystem::path& folder);

/// Throws IoError where no file can be made in the folder or, if the folder does not exist yet, in the nearest folder
/// above it. Changes nothing. Call it before long work that may have nothing to write.
void check_can_write_in(const std::filesystem::path& folder);

}  // namespace nearmiss
