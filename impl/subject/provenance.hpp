/// The origin of the subjects of this build. CMake writes both functions.
#pragma once

#include <string>
#include <vector>

namespace nearmiss {

/// Names of the subjects that belong to this project (nearmiss_add_subject with OWN).
std::vector<std::string> own_subjects();
/// Names of the subjects that the files of NEARMISS_ADD add.
std::vector<std::string> added_subjects();

}  // namespace nearmiss
