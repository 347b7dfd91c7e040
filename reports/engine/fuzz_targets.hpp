/// Fuzz targets as processes: found beside the command line, run for a time, never linked.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

struct FuzzTarget {
  const Query* query;
  std::filesystem::path file;
};

/// The targets that are built with libFuzzer.
struct FuzzTargets {
  std::vector<FuzzTarget> targets;
  std::vector<std::string> missing;  ///< queries without one
  std::string where;                 ///< the folder, or the folders that were searched in vain
};

/// Looks into `folder` or, without one, where the build puts them: the folder fuzz/ of this build, then
/// that of the preset "fuzz".
FuzzTargets find_fuzz_targets(const std::optional<std::filesystem::path>& folder,
                              std::span<const Query* const> queries);

/// What became of one target's run.
struct FuzzOutcome {
  std::string query;
  double seconds = 0;
  std::uint64_t executions = 0;    ///< 0 where the target did not say
  std::string ended;               ///< "left with exit code 0"
  bool failed = false;             ///< ended by itself with another code than 0
  std::vector<std::string> asked;  ///< subjects; empty where the target did not say
};

/// Subjects that were loaded for this process: the files of plugins, and commands.
struct ForeignSubjects {
  std::vector<std::string> plugins, commands;
};

/// What tells a fuzz target, or the properties, to ask them and the subjects of NEARMISS_ADD as well: for its
/// environment.
std::vector<std::string> environment_for_added(const ForeignSubjects& foreign);

struct FuzzBudget {
  std::filesystem::path run_folder;  ///< receives corpus/QUERY/ (kept), fuzz/ (case files, artifacts, logs)
  ForeignSubjects foreign;           ///< they are asked as well
  unsigned seconds = 1;
  std::function<void()> tick;  ///< called about twenty times a second while the target runs
  std::function<bool()> cancelled;
};

/// Runs the target for so long. It finds NEARMISS_FUZZ_REPORTS=RUN_FOLDER/fuzz in its environment, and there also that
/// it is to ask foreign subjects and those of NEARMISS_ADD; its own messages go to fuzz/QUERY.log. Stored seeds are
/// put into the corpus first.
FuzzOutcome fuzz(const FuzzTarget& target, const FuzzBudget& budget);

}  // namespace nearmiss
