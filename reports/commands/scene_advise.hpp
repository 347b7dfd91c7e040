/// The actions advise and verify of the command scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "reports/commands/options.hpp"

namespace nearmiss {

/// The options of both actions; empty where they are not given.
struct AdviseOptions {
  Selection selection;  ///< of subjects; without any, the tiers of collide
  std::optional<std::uint64_t> cases, seed;
  std::string out;

  void declare(CLI::App& app);
  /// The name of the first given option; empty where none is given.
  std::string given() const;
};

/// Prints the advice for a scene and writes it with the profile. Returns the exit code.
int advise_scene(const std::string& scene, const AdviseOptions& options);
/// Asks each query of a profile fresh cases and prints whether every requirement holds. Returns the exit code.
int verify_profile(const std::string& profile, const AdviseOptions& options);

}  // namespace nearmiss
