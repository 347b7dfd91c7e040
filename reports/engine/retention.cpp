#include "reports/engine/retention.hpp"

#include <algorithm>

namespace nearmiss {

bool Retention::keep(const std::string& kind, double above, std::uint64_t first_few) {
  Kept& kept = kept_[kind];
  const bool much_worse = above > 0 && above >= 2 * kept.worst;
  if (kept.count >= first_few && !much_worse) return false;
  ++kept.count;
  kept.worst = std::max(kept.worst, above);
  return true;
}

}  // namespace nearmiss
