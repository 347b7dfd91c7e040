/// Identifies this build, for --version and for reports.
#pragma once

#include <string>

namespace nearmiss {

std::string version();     ///< "0.1.0"
std::string compiler();    ///< "GNU 12.2.0"
std::string build_type();  ///< "Release"
std::string platform();    ///< "Linux x86_64"

}  // namespace nearmiss
