#include "impl/subject/subject.hpp"

namespace nearmiss {

const Subject* find_subject(std::string_view name) {
  for (const Subject& s : subjects()) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

}  // namespace nearmiss
