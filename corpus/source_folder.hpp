/// The folder of the sources, for files that a program reads at run time. One generated source has the absolute path,
/// so that the compiler cache serves every other source to another clone.
#pragma once

#include <string>

namespace nearmiss {

std::string source_folder();

}  // namespace nearmiss
