/// The subjects that a fuzz target asks.
#pragma once

#include <vector>

#include "impl/catalogue/query.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss::fuzz {

struct Asked {
  const Subject* subject;
  AnswerFunction answer;
  Standard standard;
};

/// Every tier of `collide` that answers the fuzzed query by a kernel of its own, or the subjects of the build option
/// NEARMISS_FUZZ_SUBJECTS in their place; and the subjects of the environment: NEARMISS_SUBJECTS, NEARMISS_PLUGINS,
/// NEARMISS_COMMANDS (see fuzz_query.cpp). With NEARMISS_PROFILE, the choice of the profile alone.
/// Prints their names to standard error, where `nearmiss nightly` reads them. Ends the process with exit status 2 where
/// the environment names a subject that cannot be asked.
std::vector<Asked> asked_subjects(const Query& query);

/// Prints one line to standard error and ends the process with exit status 2.
[[noreturn]] void cannot_run(const std::string& why);

}  // namespace nearmiss::fuzz
