#include "reports/triage/ratios.hpp"

namespace nearmiss {

/// Every ordered pair of different lengths, by its first.
std::pair<std::size_t, std::size_t> Ratios::pair(std::size_t i) const {
  const std::size_t k = i - pure(), others = lengths() - 1, first = k / others, rest = k % others;
  return {first, rest < first ? rest : rest + 1};
}

long double Ratios::value(std::size_t i) const {
  if (i < pure()) return magnitudes_.pure[i].value;
  const auto [a, b] = pair(i);
  const long double over = magnitudes_.lengths[b].value;
  return over > 0 ? magnitudes_.lengths[a].value / over : 0;
}

std::string Ratios::name(std::size_t i) const {
  if (i < pure()) return magnitudes_.pure[i].name;
  const auto [a, b] = pair(i);
  return magnitudes_.lengths[a].name + " over " + magnitudes_.lengths[b].name;
}

}  // namespace nearmiss
