/// Runs fuzz targets as processes for a given time. The command line never links them.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/storage/fuzz_target.hpp"

namespace nearmiss {

/// The program of a target, and those of its queries that it is to ask.
struct BuiltTarget {
  const FuzzTarget* target;
  std::vector<const Query*> queries;
  std::filesystem::path file;
};

/// The targets that were built with libFuzzer.
struct BuiltTargets {
  std::vector<BuiltTarget> targets;
  std::vector<std::string> missing;  ///< names of targets
  std::string where;                 ///< the folder, or the searched folders where none has a target
};

/// The targets of the queries. Searches `folder` or, without one, the folder fuzz/ of this build and then that of the
/// preset "fuzz".
BuiltTargets find_fuzz_targets(const std::optional<std::filesystem::path>& folder,
                               std::span<const Query* const> queries);

/// The result of one target's run.
struct FuzzOutcome {
  std::string target;
  double seconds = 0;
  std::uint64_t executions = 0;    ///< 0 where the target did not report it
  std::uint64_t new_inputs = 0;    ///< inputs that it added to its corpus; 0 where it did not report it
  unsigned turns = 1;              ///< how often it ran
  std::string ended;               ///< "left with exit code 0"
  bool failed = false;             ///< ended by itself with a code other than 0
  std::vector<std::string> asked;  ///< the subjects it asked; empty where it did not report them
};

/// The subjects from outside this build: files of plugins, and commands.
struct ForeignSubjects {
  std::vector<std::string> plugins, commands;
};

/// The environment entries that make a fuzz target, or the property tests, also ask foreign subjects and the subjects
/// of NEARMISS_ADD.
std::vector<std::string> environment_for_added(const ForeignSubjects& foreign);

/// The environment entries of a fuzz target: environment_for_added(), the queries to ask, where its case files go, and
/// the file of the profile that it keeps to, unless it is empty.
std::vector<std::string> environment_of_target(const BuiltTarget& target, const ForeignSubjects& foreign,
                                               const std::filesystem::path& run_folder, const std::string& profile);

struct FuzzBudget {
  std::filesystem::path run_folder;  ///< receives corpus/TARGET/ (kept), fuzz/ (case files, artifacts, logs)
  ForeignSubjects foreign;           ///< also asked
  std::string profile;               ///< the file of the profile that the target keeps to; empty: none
  double seconds = 1;                ///< from the start of the process
};

/// A fuzz target that runs. It does not look for leaks: LeakSanitizer reads /proc, and ends a process whose number
/// there is another one than its own, as it is in a host's namespace; the tests of the fuzz targets look for leaks. Its
/// environment has environment_of_target(); its messages go to fuzz/TARGET.log, and to fuzz/TARGET-N.log where it ends
/// with an error.
class RunningTarget {
 public:
  RunningTarget(const BuiltTarget& target, const FuzzBudget& budget);
  ~RunningTarget();

  /// Waits for the end at most so long. Ends a target that does not end in its time. With `cancelled`, tells it to end
  /// at once.
  bool has_ended(int milliseconds, bool cancelled);
  /// The result. Call it once, after the end.
  FuzzOutcome outcome();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Copies the stored seeds of the target's queries into its corpus in the run folder.
void put_seeds(const BuiltTarget& target, const std::filesystem::path& run_folder);

}  // namespace nearmiss
