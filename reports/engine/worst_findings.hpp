/// Prints the worst findings of a campaign.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nearmiss {

struct WorstFinding {
  std::string group;  ///< only the worst of each group is printed
  double above;       ///< negative where nothing is proved
  std::string headline, file;
  bool last = false;  ///< printed after all others
};

/// Headline and file of the worst findings, at most twelve; `index` is the file that lists all. Empty without findings.
std::string worst_text(const std::vector<WorstFinding>& findings, const std::filesystem::path& folder,
                       const char* index);

}  // namespace nearmiss
