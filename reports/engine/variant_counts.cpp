#include "reports/engine/variant_counts.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace nearmiss {

void VariantCounts::count(const Tally& tally, const Examined& e, const Variant& variant, bool kept) {
  const bool broke = e.finding.verdict == Verdict::broke;
  KindKey key = kind_key_of(e.finding);
  if (broke) key.breakage = tally.breakage_of(e.finding);
  const auto [at, is_new] = kinds_.try_emplace({e.question.query, &e.subject, std::move(key)});
  Kind& kind = at->second;
  if (is_new) {
    kind.words = kind_of_finding(*e.question.query, e.subject.name, e.finding);
    if (broke) kind.words.clause = std::get<KindKey>(at->first).breakage;
  }
  const bool is_known = kind.variants.contains(variant) || kind.variants.size() < most_variants;
  Count& c = kind.variants[is_known ? variant : Variant{0, variant.regions, variant.ordinary}];
  ++c.findings;
  c.kept += kept;
}

nlohmann::ordered_json VariantCounts::to_json() const {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& [key, kind] : kinds_) {
    const FindingKind& words = kind.words;
    for (const auto& [variant, count] : kind.variants) {
      all.push_back({{"query", words.query},
                     {"subject", words.subject},
                     {"fault", words.fault},
                     {"member", words.member},
                     {"clause", words.clause},
                     {"branches", fmt::format("{:016x}", variant.branches)},
                     {"regions", variant.regions.names()},
                     {"ordinary", variant.ordinary},
                     {"findings", count.findings},
                     {"kept", count.kept}});
    }
  }
  return all;
}

std::vector<CountedVariant> variants_in(const FileValue& index) {
  std::vector<CountedVariant> all;
  const std::optional<FileValue> variants = index.find("variants");
  if (!variants) return all;
  for (const FileValue& v : variants->items()) {
    CountedVariant c{{v.at("query").text(), v.at("subject").text(), v.at("fault").text(), v.at("member").text(),
                      v.at("clause").text()},
                     {},
                     {}};
    c.variant = {v.at("branches").hexadecimal(), feature_regions_named(v.at("regions").texts()),
                 v.at("ordinary").flag()};
    c.count = {v.at("findings").count(), v.at("kept").count()};
    if (c.count.kept > c.count.findings) v.at("kept").fail("at most the number of findings");
    all.push_back(std::move(c));
  }
  return all;
}

}  // namespace nearmiss
