#include "reports/properties.hpp"

#include <array>

namespace nearmiss {

namespace {
bool always(const Query&) { return true; }

constexpr std::array table{
    Property{"answers_keep_their_contract", "no answer of a subject is proved to break its contract", always},
};
}  // namespace

std::span<const Property> all_properties() { return table; }

std::vector<std::string> properties_of(const Query& query) {
  std::vector<std::string> names;
  for (const Property& p : table) {
    if (p.holds_for(query)) names.emplace_back(p.name);
  }
  return names;
}

}  // namespace nearmiss
