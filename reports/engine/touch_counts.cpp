#include "reports/engine/touch_counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "oracles/touch.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

TouchCount sum(const std::map<std::string, TouchCount>& features) {
  TouchCount all;
  for (const auto& [feature, t] : features) all.touches += t.touches, all.yes += t.yes;
  return all;
}

/// False for decisions without contact, such as parallel axes or distances of centers.
bool is_about_contact(const Query& query) { return decides(query.kind) && query.traits.touching_is_yes; }

}  // namespace

void TouchCounts::count(const Case& question, const Subject& subject, const Answer& answer, const Finding& f,
                        std::optional<bool>& known) {
  const bool may_touch = f.truth_yes && is_about_contact(*question.query);
  if (!may_touch || answer.status != Answer::Status::answered) return;
  if (!known) known = touches_exactly(question);
  if (!*known) return;
  TouchCount& t = by_feature_[{&subject, question.query}][std::string(feature_of_touch(question))];
  ++t.touches;
  t.yes += answer.yes;
}

std::vector<TouchCounts::Inconsistent> TouchCounts::inconsistent() const {
  std::map<const Subject*, Inconsistent> found;
  for (const auto& [key, features] : by_feature_) {
    const TouchCount all = sum(features);
    if (all.touches < enough) continue;
    Inconsistent& of = found[key.subject];
    of.subject = key.subject;
    if (all.share() >= 1 - exceptions) of.closed.emplace_back(key.query->name);
    if (all.share() <= exceptions) of.strict.emplace_back(key.query->name);
  }
  std::vector<Inconsistent> list;
  for (auto& [subject, i] : found) {
    if (!i.closed.empty() && !i.strict.empty()) list.push_back(std::move(i));
  }
  return list;
}

std::string TouchCounts::text() const {
  constexpr std::size_t shown = 12;
  std::vector<std::pair<double, std::string>> lines;
  for (const auto& [key, features] : by_feature_) {
    const TouchCount all = sum(features);
    if (all.yes == all.touches) continue;
    std::vector<std::string> parts;
    for (const auto& [feature, t] : features) {
      parts.push_back(fmt::format("{} {} of {}", feature, count_text(t.yes), count_text(t.touches)));
    }
    lines.emplace_back(
        all.share(), fmt::format("  {} {}: of {}, yes in {} ({})\n", key.subject->name, key.query->name,
                                 plural_text(all.touches, "exact touch"), count_text(all.yes), fmt::join(parts, ", ")));
  }
  if (lines.empty()) return "";
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text = "Exact touches, which count as contact:\n";
  for (std::size_t i = 0; i < lines.size() && i < shown; ++i) text += lines[i].second;
  if (lines.size() > shown) text += fmt::format("  and {} more, see index.json\n", lines.size() - shown);
  return text;
}

nlohmann::ordered_json TouchCounts::to_json() const {
  auto list = nlohmann::ordered_json::array();
  for (const auto& [key, features] : by_feature_) {
    for (const auto& [feature, t] : features) {
      list.push_back({{"query", key.query->name},
                      {"subject", key.subject->name},
                      {"feature", feature},
                      {"touches", t.touches},
                      {"yes", t.yes}});
    }
  }
  return list;
}

}  // namespace nearmiss
