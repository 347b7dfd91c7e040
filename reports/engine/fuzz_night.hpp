/// Shares the time of a night between fuzz targets, and keeps their corpora small.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/engine/fuzz_targets.hpp"

namespace nearmiss {

struct FuzzNight {
  using Clock = std::chrono::steady_clock;

  std::filesystem::path run_folder;
  ForeignSubjects foreign;  ///< also asked
  std::string profile;      ///< the file of the profile that the targets keep to, from cases of its scene; empty: none
  unsigned jobs = 1;        ///< how many targets run at once
  Clock::time_point until;
  std::function<void()> tick;  ///< called about 20 times a second
  std::function<bool()> cancelled;
  std::function<void(const std::string&)> activity;  ///< receives what is being done, for people
};

/// The results of a night's fuzz targets.
struct FuzzNightOutcome {
  std::vector<FuzzOutcome> ran;      ///< one for each target that had a turn, summed over its turns
  std::vector<std::string> no_time;  ///< names of targets that had no turn
};

/// Runs the targets in turns, `jobs` at a time. In the first round each target gets a turn, together half of the time,
/// or all of it where half is less than two seconds for each: an equal share for each query. Then the target with the
/// largest product of recent yield (new inputs per second of its last turn) and waiting time is next. A target that
/// fails three times in a row without an execution gets no more turns. Throws IoError where a folder or a seed cannot
/// be written.
FuzzNightOutcome fuzz_in_turns(const std::vector<BuiltTarget>& targets, const FuzzNight& night);

/// The result of merge_corpora().
struct MergeOutcome {
  std::vector<std::string> merged;      ///< names of targets whose corpus was minimised
  std::uint64_t before = 0, after = 0;  ///< inputs in these corpora
};

/// Minimises the corpora that have doubled since they were last minimised: keeps the inputs that add a feature. Those
/// that grew most come first. Stops at night.until. A killed merge loses nothing, and the next call continues it. Call
/// it before the targets run. Throws IoError where a folder cannot be written.
MergeOutcome merge_corpora(const std::vector<BuiltTarget>& targets, const FuzzNight& night);

/// Completes or undoes what a killed merge left. merge_corpora() begins with it.
void settle_corpora(const std::vector<BuiltTarget>& targets, const std::filesystem::path& run_folder);

}  // namespace nearmiss
