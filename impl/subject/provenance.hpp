/// The origin of the subjects of this build. CMake writes these functions.
#pragma once

#include <string>
#include <vector>

#include "impl/subject/subject.hpp"

namespace nearmiss {

/// Names of all subjects of this build.
std::vector<std::string> built_in_subjects();
/// The subjects of this build with these names, in this order, built and started where they are programs of their own.
/// Throws BadSubject (impl/host/hosts.hpp).
std::vector<Subject> start_built_in(const std::vector<std::string>& names);
/// The subjects of this build with these names that can be started without building them, in this order.
std::vector<Subject> start_at_hand(const std::vector<std::string>& names);
/// Names of the installed engines (impl/host/engines.hpp), and those with these names, started. Throws BadSubject.
std::vector<std::string> installed_engines();
std::vector<Subject> start_engines(const std::vector<std::string>& names);
/// Names of the subjects that give second opinions on the findings of others (nearmiss_add_subject with REFEREE).
std::vector<std::string> names_of_referees();
/// Names of the subjects that belong to this project (nearmiss_add_subject with OWN).
std::vector<std::string> own_subjects();
/// Names of the subjects that the files of NEARMISS_ADD add.
std::vector<std::string> added_subjects();

/// The subjects of this project as functions of this process, also where subjects() are programs of their own. A crash
/// or an endless loop of such a function ends or stops this process. None in a program that does not link
/// nearmiss_subjects.
std::vector<Subject> own_subjects_in_process();

}  // namespace nearmiss
