/// The profile of a scene that a fuzz target keeps to.
#pragma once

#include <memory>
#include <string>

#include "corpus/scenes/scene_cases.hpp"
#include "corpus/scenes/scene_ranges.hpp"

namespace nearmiss::fuzz {

/// The scene of a profile, and its choice for a query.
class ProfiledScene {
 public:
  /// nullptr where the profile does not have the query. Ends the process with exit status 2 where it cannot be read.
  static std::unique_ptr<const ProfiledScene> of_profile(const std::string& file, const Query& query);

  const std::string& subject() const { return subject_; }
  bool contains(const Case& c) const { return ranges_.contain(c); }
  /// Brings a changed case back into the scene. One that cannot be, or of another query or scalar, is replaced by a
  /// case of the scene.
  void bring_back(Case& c, Scalar scalar, unsigned seed) const;
  Case fresh_case(Scalar scalar, unsigned seed) const { return scenes::draw_case(scene_, *query_, scalar, seed, 0); }

 private:
  ProfiledScene(const Query& query, std::string subject, scenes::Scene scene);

  const Query* query_;
  std::string subject_;
  scenes::Scene scene_;
  scenes::SceneRanges ranges_;
};

}  // namespace nearmiss::fuzz
