/// The profile of a scene that a fuzz target keeps to.
#pragma once

#include <string>

#include "corpus/scenes/scene_cases.hpp"
#include "corpus/scenes/scene_ranges.hpp"

namespace nearmiss::fuzz {

/// The scene of a profile, and its choice for the fuzzed query.
class ProfiledScene {
 public:
  /// The profile that NEARMISS_PROFILE names; nullptr without. Ends the process with exit status 2 where it cannot be
  /// read or does not have the fuzzed query.
  static const ProfiledScene* of_environment(const Query& query);

  const std::string& subject() const { return subject_; }
  bool contains(const Case& c) const { return ranges_.contain(c); }
  /// Brings a changed case back into the scene. One that cannot be, or of another scalar, is replaced by a case of the
  /// scene.
  void bring_back(Case& c, Scalar scalar, unsigned seed) const;
  Case fresh_case(Scalar scalar, unsigned seed) const { return scenes::draw_case(scene_, query_, scalar, seed, 0); }

 private:
  ProfiledScene(const Query& query, const std::string& file);

  const Query& query_;
  std::string subject_;
  scenes::Scene scene_;
  scenes::SceneRanges ranges_;
};

}  // namespace nearmiss::fuzz
