#include "corpus/storage/fuzz_target.hpp"

#include <algorithm>
#include <array>

#include "corpus/storage/codec.hpp"

namespace nearmiss {

namespace {

/// A query of the grid, and the operation that it asks of its pair.
struct PairOfGrid {
  std::string_view query, operation;
};
constexpr std::array pairs_of_grid{
#define NEARMISS_OVERLAP(first, second) PairOfGrid{#first "_" #second "_overlap", "overlap"},
#define NEARMISS_SIGNED_DISTANCE(first, second) PairOfGrid{#first "_" #second "_signed_distance", "signed_distance"},
#define NEARMISS_CAST_AS(query, first, second) PairOfGrid{#query, "cast"},
#include "impl/catalogue/grid.def"
};

std::string_view target_name(const Query& query) {
  const auto* pair = std::find_if(pairs_of_grid.begin(), pairs_of_grid.end(),
                                  [&](const PairOfGrid& p) { return p.query == query.name; });
  return pair == pairs_of_grid.end() ? query.name : pair->operation;
}

FuzzTarget* find_in(std::span<FuzzTarget> targets, std::string_view name) {
  const auto found = std::find_if(targets.begin(), targets.end(), [&](const FuzzTarget& t) { return t.name == name; });
  return found == targets.end() ? nullptr : &*found;
}

std::span<FuzzTarget> all_targets() {
  static std::vector<FuzzTarget> all = [] {
    std::vector<FuzzTarget> made;
    for (const Query& q : catalogue()) {
      FuzzTarget* const target = find_in(made, target_name(q));
      (target != nullptr ? *target : made.emplace_back(FuzzTarget{target_name(q), {}})).queries.push_back(&q);
    }
    return made;
  }();
  return all;
}

}  // namespace

bool FuzzTarget::asks(const Query& query) const {
  return std::find(queries.begin(), queries.end(), &query) != queries.end();
}

std::vector<std::uint8_t> FuzzTarget::bytes_of(const Case& c) const {
  std::vector<std::uint8_t> bytes = case_to_bytes(c);
  const auto place = std::find(queries.begin(), queries.end(), c.query) - queries.begin();
  bytes[0] = static_cast<std::uint8_t>(bytes[0] | (place << 1));
  return bytes;
}

std::optional<Case> FuzzTarget::case_of(std::span<const std::uint8_t> bytes) const {
  if (bytes.empty()) return std::nullopt;
  return case_from_bytes(*queries[(bytes[0] >> 1) % queries.size()], bytes);
}

std::span<const FuzzTarget> fuzz_targets() { return all_targets(); }

const FuzzTarget* find_fuzz_target(std::string_view name) { return find_in(all_targets(), name); }

const FuzzTarget& fuzz_target_of(const Query& query) { return *find_fuzz_target(target_name(query)); }

}  // namespace nearmiss
