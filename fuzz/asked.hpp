/// What a fuzz target asks, and whom.
#pragma once

#include <memory>
#include <vector>

#include "corpus/storage/fuzz_target.hpp"
#include "fuzz/profiled_scene.hpp"
#include "impl/catalogue/query.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss::fuzz {

struct Asked {
  const Subject* subject;
  AnswerFunction answer;
  Standard standard;
};

struct AskedQuery {
  const Query* query;
  std::vector<Asked> subjects;
  std::unique_ptr<const ProfiledScene> scene{};  ///< its cases stay in this scene; nullptr: anywhere
};

/// The queries of the target: all, those that NEARMISS_QUERIES names, or those of the profile (NEARMISS_PROFILE). Of
/// each, every tier of `collide` that answers it by a kernel of its own, or the subjects of the build option
/// NEARMISS_FUZZ_SUBJECTS in their place; and the subjects of the environment: NEARMISS_SUBJECTS, NEARMISS_PLUGINS,
/// NEARMISS_COMMANDS (see fuzz_target.cpp). With NEARMISS_PROFILE, the choice of the profile alone.
/// Prints the names of all subjects to standard error, where `nearmiss nightly` reads them. Ends the process with exit
/// status 2 where the environment names a query or a subject that cannot be asked.
std::vector<AskedQuery> asked_queries(const FuzzTarget& target);

/// Prints one line to standard error and ends the process with exit status 2.
[[noreturn]] void cannot_run(const std::string& why);

}  // namespace nearmiss::fuzz
