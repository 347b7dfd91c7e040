/// The origin of the subjects of this build. CMake writes these functions.
#pragma once

#include <string>
#include <vector>

#include "impl/subject/subject.hpp"

namespace nearmiss {

/// Names of the subjects that belong to this project (nearmiss_add_subject with OWN).
std::vector<std::string> own_subjects();
/// Names of the subjects that the files of NEARMISS_ADD add.
std::vector<std::string> added_subjects();

/// The subjects of this project as functions of this process, also where subjects() are programs of their own. A crash
/// or an endless loop of such a function ends or stops this process.
std::vector<Subject> own_subjects_in_process();

}  // namespace nearmiss
