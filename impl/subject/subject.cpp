#include "impl/subject/subject.hpp"

namespace nearmiss {

/// Written by CMake.
std::vector<Subject> built_in_subjects();

namespace {

std::vector<Subject>& all_subjects() {
  static std::vector<Subject> all = built_in_subjects();
  return all;
}

}  // namespace

const std::vector<Subject>& subjects() { return all_subjects(); }

void add_subject(Subject subject) { all_subjects().push_back(std::move(subject)); }

const Subject* find_subject(std::string_view name) {
  for (const Subject& s : subjects()) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

}  // namespace nearmiss
