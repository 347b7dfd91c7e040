/// The parts of a night (`nearmiss nightly`). Each asks subjects in the night's run, and notes its results in the
/// index.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "corpus/scenes/scene_file.hpp"
#include "reports/engine/building.hpp"
#include "reports/engine/fuzz_targets.hpp"
#include "reports/engine/run.hpp"

namespace nearmiss {

/// The share of the fuzzing time for minimising corpora.
inline constexpr double merging_share = 0.25;

/// The point of time after this share of the time from a to b.
Run::Clock::time_point between(Run::Clock::time_point a, Run::Clock::time_point b, double share);

/// Shows the progress of the run while the launcher builds.
void wait_for(const std::string& step, const std::string& what, Building& building, Run& run);

/// The loaded plugins and commands.
std::vector<const Subject*> plugins_and_commands();
/// The loaded plugins and commands, for the targets. Throws BadInput for a name that cannot be passed to them.
ForeignSubjects foreign_subjects();

/// Compares the findings of stored cases with their expectations.
class StoredCasesOfNight {
 public:
  StoredCasesOfNight();
  ~StoredCasesOfNight();
  /// Asks these subjects every stored case.
  void ask(Run& run, std::span<const Subject* const> subjects);
  /// The number of unexpected findings of subjects whose night it is.
  std::uint64_t unexpected() const;

 private:
  class Expectations;

  std::set<std::filesystem::path> asked_;
  std::unique_ptr<Expectations> expectations_;
};

/// Asks these subjects the cases of earlier nights' reports again. Adds the files of those that were asked.
void ask_again(Run& run, std::span<const Subject* const> subjects, const std::vector<WrittenReport>& earlier,
               std::set<std::string>& again);

/// Climbs towards the worst errors of every subject.
void climb(Run& run);

/// Related cases of every subject. Returns 0, 1 for broken promises of a subject whose night it is, or InternalError's
/// exit code.
int relate(Run& run, Run::Clock::time_point until, const scenes::Scene* scene);

/// Runs the property tests with fresh seeds. True where one failed.
bool ask_properties(Run& run, Run::Clock::time_point until, const Building& building);

/// Puts cases of the scene into the corpora of the targets, for them to start from, in the scalars of the subjects that
/// are asked them.
void put_seeds_of(const scenes::Scene& scene, const BuiltTargets& found, const Run& run);

struct NightFuzzing {
  std::string text;     ///< for the summary
  bool failed = false;  ///< a target ended with an error
};
/// Runs the fuzz targets, so many at once, and judges what they find. `profile` is the file of the profile that they
/// keep to; empty: none.
NightFuzzing fuzz_all(Run& run, const BuiltTargets& found, const std::string& profile, unsigned jobs,
                      Run::Clock::time_point end);

}  // namespace nearmiss
