/// The subjects that are not Nearmiss's own choice.
#pragma once

#include <string>
#include <vector>

namespace nearmiss {

/// Names of the subjects that this build was given by NEARMISS_ADD; written by CMake.
std::vector<std::string> added_subjects();

}  // namespace nearmiss
