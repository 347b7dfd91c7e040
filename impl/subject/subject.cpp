#include "impl/subject/subject.hpp"

#include <algorithm>

#include "impl/subject/foreign_promises.hpp"
#include "impl/subject/provenance.hpp"

namespace nearmiss {

/// Written by CMake.
std::vector<Subject> built_in_subjects();

namespace {

std::vector<Subject> subjects_of_build() {
  std::vector<Subject> all = built_in_subjects();
  const std::vector<std::string> own = own_subjects();
  for (Subject& s : all) s.own = std::find(own.begin(), own.end(), s.name) != own.end();
  return all;
}

std::vector<Subject>& all_subjects() {
  static std::vector<Subject> all = subjects_of_build();
  return all;
}

}  // namespace

const std::vector<Subject>& subjects() { return all_subjects(); }

void add_subject(Subject subject) { all_subjects().push_back(std::move(subject)); }

namespace {
Measure the_measure;
bool promises_of_others_count = true;
}  // namespace

const Measure& measure() { return the_measure; }
void set_measure(const Measure& m) { the_measure = m; }
void count_promises_of_others(bool count) { promises_of_others_count = count; }

Standard Subject::standard_for(std::string_view query) const {
  const Offering& offer = offering(query);
  const bool counts = !the_measure.for_all && (own || promises_of_others_count);
  if (counts && !promises_nothing(offer.contract)) return {offer.contract, true, offer.required};
  const double epsilons = the_measure.error / unit_roundoff(scalar);
  return {{.backward = epsilons, .unit = epsilons}, false, offer.required};
}

const Subject* find_subject(std::string_view name) {
  for (const Subject& s : subjects()) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

}  // namespace nearmiss
