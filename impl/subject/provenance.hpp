/// Who brought which subjects of this build; both functions are written by CMake.
#pragma once

#include <string>
#include <vector>

namespace nearmiss {

/// Names of the subjects that belong to this project (nearmiss_add_subject with OWN).
std::vector<std::string> own_subjects();
/// Names of the subjects that NEARMISS_ADD brought.
std::vector<std::string> added_subjects();

}  // namespace nearmiss
