/// For programs without the functions of subjects.
#include "impl/subject/provenance.hpp"

namespace nearmiss {

std::vector<Subject> own_subjects_in_process() { return {}; }

}  // namespace nearmiss
