#include "reports/engine/retention.hpp"

#include <algorithm>

namespace nearmiss {

bool Retention::would_keep(const std::string& kind, std::uint64_t variant, double above, First first) const {
  const auto of_kind = kept_.find(kind);
  if (of_kind == kept_.end()) return true;
  const Kept& kept = of_kind->second;
  if (above > 0 && above >= 2 * kept.worst) return true;
  const auto alike = kept.variants.find(variant);
  return kept.count < first.of_a_kind && (alike == kept.variants.end() || alike->second < first.of_a_variant);
}

bool Retention::keep(const std::string& kind, std::uint64_t variant, double above, First first) {
  if (!would_keep(kind, variant, above, first)) return false;
  Kept& kept = kept_[kind];
  if (kept.count < first.of_a_kind) ++kept.variants[variant];
  ++kept.count;
  kept.worst = std::max(kept.worst, above);
  return true;
}

}  // namespace nearmiss
