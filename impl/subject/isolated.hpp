/// Subjects whose libraries are loaded apart from all others.
#pragma once

#include "impl/subject/subject.hpp"

namespace nearmiss {

/// The subject in the shared object `file`, which CMake made of an adapter (nearmiss_add_subject, ISOLATED). It is loaded
/// with libraries of its own, whatever the process has by the same names, and stays. Throws std::runtime_error where it
/// cannot be loaded.
Subject isolated_subject(const char* file);

}  // namespace nearmiss
