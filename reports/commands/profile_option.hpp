/// The option --profile: the queries, the subjects and the scene of a profile in place of chosen ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/advice/profile.hpp"
#include "reports/commands/options.hpp"

namespace nearmiss {

/// A profile, and its subjects, each of which offers only the queries that the profile has it answer.
class ChosenProfile {
 public:
  /// Throws BadInput as load_profile() and subject_of() do, and for a profile without queries.
  explicit ChosenProfile(const std::string& file);
  ChosenProfile(const ChosenProfile&) = delete;
  ChosenProfile& operator=(const ChosenProfile&) = delete;

  const scenes::Scene& scene() const { return profile_.scene; }
  std::vector<const Query*> queries() const;
  /// They live as long as this object.
  std::vector<const Subject*> subjects() const;

 private:
  Profile profile_;
  std::vector<Subject> subjects_;
};

/// --profile, which excludes --query, --subject and --scene where the command has them.
struct ProfileOption {
  std::string file;

  /// Call it after the options that it excludes are declared.
  void declare(CLI::App& app);
  bool is_given() const { return !file.empty(); }
};

}  // namespace nearmiss
