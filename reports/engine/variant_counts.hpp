/// Counts findings by kind and variant: how many there are of what may be one bug.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <tuple>
#include <vector>

#include "reports/engine/campaign.hpp"
#include "reports/engine/tally.hpp"
#include "reports/findings/finding_kind.hpp"

namespace nearmiss {

class VariantCounts {
 public:
  struct Count {
    std::uint64_t findings = 0;
    std::uint64_t kept = 0;  ///< that became reports
  };
  /// After the first `most_variants` variants of a kind every other one counts as one without branches.
  static constexpr std::size_t most_variants = 256;

  void count(const Tally& tally, const Examined& e, const Variant& variant, bool kept);
  /// In the form of "variants" in reports/run.schema.json.
  nlohmann::ordered_json to_json() const;

 private:
  /// A kind by what is cheap to compare.
  using Key = std::tuple<const Query*, const Subject*, KindKey>;
  struct Kind {
    FindingKind words;
    std::map<Variant, Count> variants;
  };
  std::map<Key, Kind> kinds_;
};

/// The counts of one variant, as an index has them.
struct CountedVariant {
  FindingKind kind;
  Variant variant;
  VariantCounts::Count count;
};
/// Those of an index; empty for the index of an older build. Throws BadInput where it is no index.
std::vector<CountedVariant> variants_in(const FileValue& index);

}  // namespace nearmiss
