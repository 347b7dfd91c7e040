/// Whether a profile still meets the requirements of its scene on fresh cases.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/advice/profile.hpp"

namespace nearmiss {

class Verification {
 public:
  /// Makes no folder and writes no file but for internal errors, beside the profile. Throws BadInput for a subject that
  /// this build does not have.
  Verification(const Profile& profile, std::filesystem::path file, std::uint64_t seed, std::uint64_t cases);

  /// Asks each query's subject. An interrupt stops it early.
  void ask();
  /// A table of at most 100 columns, a line for each failed requirement, and a line with the result.
  std::string text() const;
  /// 0; 1 where a requirement failed, or a query of the scene has no subject; 2 after an interrupt;
  /// InternalError::exit_code after an internal error.
  int exit_code() const;

 private:
  struct Verified {
    SceneEvidence evidence;
    std::vector<MetRequirement> requirements;
  };
  std::uint64_t failed() const;

  const Profile& profile_;
  std::filesystem::path file_;
  std::uint64_t seed_, cases_, done_ = 0;
  TradeSource source_;
  std::vector<const Subject*> subjects_;  ///< of each query of the profile
  Progress progress_;
  Dispatcher dispatcher_;
  InternalErrors internal_errors_;
  std::vector<Verified> verified_;
};

}  // namespace nearmiss
