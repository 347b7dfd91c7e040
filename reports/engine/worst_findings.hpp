/// The worst findings of a campaign as people are told of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nearmiss {

struct WorstFinding {
  std::string group;  ///< of each group the worst is told
  double above;       ///< negative where nothing is proved
  std::string headline, file;
  bool last = false;  ///< told after all others
};

/// Headline and file of the worst, a dozen at most; `index` says where the others are. Empty without any.
std::string worst_text(const std::vector<WorstFinding>& findings, const std::filesystem::path& folder,
                       const char* index);

}  // namespace nearmiss
