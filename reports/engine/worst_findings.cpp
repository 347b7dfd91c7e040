#include "reports/engine/worst_findings.hpp"
#include "impl/subject/printable.hpp"
#include "reports/findings/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nearmiss {

namespace {

std::vector<const WorstFinding*> worst_of_each_group(const std::vector<WorstFinding>& findings) {
  std::vector<const WorstFinding*> worst;
  for (const WorstFinding& f : findings) {
    const auto same =
        std::find_if(worst.begin(), worst.end(), [&](const WorstFinding* o) { return o->group == f.group; });
    if (same == worst.end()) {
      worst.push_back(&f);
    } else if (f.above > (*same)->above) {
      *same = &f;
    }
  }
  std::stable_sort(worst.begin(), worst.end(), [](const WorstFinding* a, const WorstFinding* b) {
    return std::pair(a->last, -a->above) < std::pair(b->last, -b->above);
  });
  return worst;
}

}  // namespace

std::string worst_text(const std::vector<WorstFinding>& findings, const std::filesystem::path& folder,
                       const char* index) {
  constexpr std::size_t shown = 12;
  const std::vector<const WorstFinding*> worst = worst_of_each_group(findings);
  std::string text;
  for (std::size_t i = 0; i < worst.size() && i < shown; ++i) {
    text += fmt::format("{}\n    {}\n", printable(worst[i]->headline), path_text(folder / worst[i]->file));
  }
  if (worst.size() > shown) text += fmt::format("and {} more, see {}\n", worst.size() - shown, index);
  return text.empty() ? text : text + "\n";
}

}  // namespace nearmiss
