/// The folder of the sources, for files that a program reads at run time. One generated source has the absolute path,
/// so that the compiler cache serves every other source to another clone.
#pragma once

#include <string>

namespace nearmiss {

/// That of the clone that was built; the folder that the environment variable NEARMISS_SOURCES names, where the clone
/// was moved or copied.
std::string source_folder();

}  // namespace nearmiss
