#include "reports/engine/retention.hpp"

#include <algorithm>

namespace nearmiss {

bool Retention::keep(const std::string& kind, std::uint64_t variant, double above, First first) {
  Kept& kept = kept_[kind];
  const bool much_worse = above > 0 && above >= 2 * kept.worst;
  const bool is_full = kept.count >= first.of_a_kind;
  if (!much_worse && (is_full || kept.variants[variant] >= first.of_a_variant)) return false;
  ++kept.count;
  if (!is_full) ++kept.variants[variant];
  kept.worst = std::max(kept.worst, above);
  return true;
}

}  // namespace nearmiss
