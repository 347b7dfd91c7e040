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

namespace {
bool one_measure = false;
}

void hold_all_to(double error) {
  one_measure = true;
  for (Subject& s : all_subjects()) {
    for (Offering& o : s.offerings) o.contract = {.backward = error / unit_roundoff(s.scalar)};
  }
}

bool held_to_one_measure() { return one_measure; }

const Subject* find_subject(std::string_view name) {
  for (const Subject& s : subjects()) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

}  // namespace nearmiss
