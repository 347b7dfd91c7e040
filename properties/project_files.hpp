/// The files of the project, for tests that read its sources and its pages.
#pragma once

#include <string>
#include <vector>

namespace nearmiss {

/// The names that cmake/sources prints, relative to source_folder(): the files that git tracks, also if they were
/// deleted.
std::vector<std::string> project_files();

/// The text of one of them. Throws std::runtime_error if it cannot be read.
std::string text_of_file(const std::string& name);

}  // namespace nearmiss
