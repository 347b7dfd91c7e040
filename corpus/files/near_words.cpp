#include "corpus/files/near_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>
#include <set>
#include <utility>

#include "impl/catalogue/query.hpp"
#include "impl/subject/printable.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t most_of_a_word = 100;

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

std::string lower_case(std::string_view s) {
  std::string lower(s);
  for (char& c : lower) c = 'A' <= c && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return lower;
}

using Words = std::multiset<std::string>;

/// The words of "raySphere", "ray-sphere" and "ray_sphere", in small letters.
std::vector<std::string> words_in(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    const bool begins = std::isupper(static_cast<unsigned char>(c)) != 0;
    const bool parts = std::isalnum(static_cast<unsigned char>(c)) == 0;
    if ((begins || parts) && !words.back().empty()) words.emplace_back();
    if (!parts) words.back() += lower_case(std::string_view(&c, 1));
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// The words of other programs, and ours.
struct Synonym {
  std::string_view theirs, ours;
};
constexpr std::array words_of_queries = {
    Synonym{"obb", "box"},
    Synonym{"cube", "box"},
    Synonym{"cuboid", "box"},
    Synonym{"aabb", "aabox"},
    Synonym{"tri", "triangle"},
    Synonym{"rect", "rectangle"},
    Synonym{"quad", "rectangle"},
    Synonym{"ball", "sphere"},
    Synonym{"swept", "moving"},
    Synonym{"sweep", "moving"},
    Synonym{"dynamic", "moving"},
    Synonym{"cast", "moving"},
    Synonym{"intersect", "overlap"},
    Synonym{"intersects", "overlap"},
    Synonym{"intersection", "overlap"},
    Synonym{"collide", "overlap"},
    Synonym{"collision", "overlap"},
    Synonym{"test", "overlap"},
    Synonym{"depth", "penetration"},
    Synonym{"contact", "penetration"},
    Synonym{"distance", "closest point"},
    Synonym{"nearest", "closest"},
    Synonym{"raycast", "ray"},
    Synonym{"line", "segment"},
    Synonym{"reflect", "bounce"},
    Synonym{"spherecast", "moving sphere"},
};

Words translated(const std::vector<std::string>& words) {
  Words ours;
  for (const std::string& word : words) {
    const auto known = std::find_if(words_of_queries.begin(), words_of_queries.end(),
                                    [&](const Synonym& s) { return s.theirs == word; });
    if (known == words_of_queries.end()) {
      ours.insert(word);
    } else {
      for (std::string& w : words_in(known->ours)) ours.insert(std::move(w));
    }
  }
  return ours;
}

/// A ray is a moving point: in most queries, but not in all.
Words with_moving_points(Words words) {
  const std::size_t rays = words.erase("ray");
  for (std::size_t i = 0; i < rays; ++i) words.insert({"moving", "point"});
  words.erase("overlap");
  return words;
}

/// The share of the words of both that they have in common.
double likeness(const Words& a, const Words& b) {
  std::vector<std::string> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  const std::size_t all = a.size() + b.size() - common.size();
  return all == 0 ? 0 : double(common.size()) / double(all);
}

constexpr std::array words_of_fields = {
    Synonym{"dir", "velocity direction"},
    Synonym{"direction", "velocity"},
    Synonym{"motion", "velocity"},
    Synonym{"movement", "velocity"},
    Synonym{"displacement", "velocity"},
    Synonym{"vel", "velocity"},
    Synonym{"speed", "velocity"},
    Synonym{"velocity", "direction"},
    Synonym{"d", "velocity direction offset"},
    Synonym{"rotation", "orientation"},
    Synonym{"quaternion", "orientation"},
    Synonym{"quat", "orientation"},
    Synonym{"rot", "orientation"},
    Synonym{"q", "orientation"},
    Synonym{"position", "center point origin"},
    Synonym{"pos", "center point origin"},
    Synonym{"location", "center point origin"},
    Synonym{"centre", "center"},
    Synonym{"origin", "point center"},
    Synonym{"o", "origin point"},
    Synonym{"p", "point"},
    Synonym{"c", "center v2"},
    Synonym{"r", "radius"},
    Synonym{"rad", "radius"},
    Synonym{"extents", "half"},
    Synonym{"halfextents", "half"},
    Synonym{"half_extents", "half"},
    Synonym{"half_size", "half"},
    Synonym{"size", "half"},
    Synonym{"a", "v0 p0"},
    Synonym{"start", "v0 p0"},
    Synonym{"begin", "v0 p0"},
    Synonym{"b", "v1 p1"},
    Synonym{"end", "v1 p1"},
    Synonym{"n", "normal"},
    Synonym{"distance", "offset"},
    Synonym{"dist", "offset"},
    Synonym{"w", "offset"},
    Synonym{"tri", "triangle"},
    Synonym{"aabb", "aabox"},
    Synonym{"obb", "box"},
    Synonym{"cube", "box"},
    Synonym{"ball", "sphere"},
    Synonym{"ray", "point"},
    Synonym{"tmax", "limit"},
    Synonym{"max_time", "limit"},
};

bool has(std::span<const std::string> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 8> words_of_corners = {"min",   "max",   "mins", "maxs",
                                                              "lower", "upper", "lo",   "hi"};
constexpr std::array<std::string_view, 7> words_of_extents = {"center",       "centre",    "half", "extents",
                                                              "half_extents", "half_size", "size"};

}  // namespace

std::vector<std::string> close_matches(std::string_view word, std::span<const std::string> words) {
  std::vector<std::pair<std::size_t, std::string>> ranked;
  if (word.size() > most_of_a_word) return {};
  const std::string lower = lower_case(word);
  for (const std::string& w : words) {
    const std::string other = lower_case(w);
    const bool within = word.size() >= 3 && other != lower && other.find(lower) != std::string::npos;
    const std::size_t distance = within ? 1 : edit_distance(lower, other);
    if (distance <= std::max<std::size_t>(2, word.size() / 3)) ranked.emplace_back(distance, w);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> best;
  for (std::size_t i = 0; i < ranked.size() && i < 3; ++i) best.push_back(ranked[i].second);
  return best;
}

std::vector<std::string> nearest_queries(std::string_view name) {
  constexpr double least = 0.5, of_best = 0.9;
  if (name.size() > most_of_a_word) return {};
  const Words words = translated(words_in(name)), moving = with_moving_points(words);
  std::vector<std::string> names;
  std::vector<std::pair<double, std::string>> ranked;
  for (const Query& q : catalogue()) {
    names.emplace_back(q.name);
    const std::vector<std::string> all = words_in(q.name);
    const Words own(all.begin(), all.end());
    ranked.emplace_back(std::max(likeness(words, own), likeness(moving, own)), q.name);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (ranked.empty() || ranked[0].first < least) return close_matches(name, names);
  std::vector<std::string> best;
  for (const auto& [likely, query] : ranked) {
    if (best.size() < 3 && likely >= of_best * ranked[0].first) best.push_back(query);
  }
  if (ranked[0].first < 1) {  // a slip of the pen is nearer than a word in common
    std::vector<std::string> close = close_matches(name, names);
    for (std::string& b : best) {
      if (!has(close, b)) close.push_back(std::move(b));
    }
    best = std::move(close);
    best.resize(std::min<std::size_t>(best.size(), 3));
  }
  return best;
}

std::string unknown_query_text(std::string_view name) {
  const std::vector<std::string> near = nearest_queries(name);
  const std::string shown =
      printable(name.size() > most_of_a_word ? std::string(name.substr(0, most_of_a_word)) + "..." : std::string(name));
  return fmt::format(
      "unknown query '{}'; {}", shown,
      near.empty() ? "'nearmiss list' lists all" : fmt::format("did you mean {}?", fmt::join(near, " or ")));
}

std::string nearest_field_text(std::string_view name, std::span<const std::string> expected) {
  const std::string word = lower_case(name);
  const auto is_among = [&](const auto& words) { return std::find(words.begin(), words.end(), word) != words.end(); };
  if (has(expected, "center") && has(expected, "half") && is_among(words_of_corners))
    return "a box has the center (min + max) / 2 and the half extents (max - min) / 2";
  if (has(expected, "min") && has(expected, "max") && is_among(words_of_extents))
    return "an aabox has min = center - half and max = center + half";
  if (word == "ray" && has(expected, "point") && has(expected, "velocity")) return "a ray is a point and a velocity";
  std::vector<std::string> near;
  for (const Synonym& s : words_of_fields) {
    if (s.theirs != word) continue;
    std::string_view rest = s.ours;
    while (!rest.empty()) {
      const std::string_view one = rest.substr(0, rest.find(' '));
      if (has(expected, one)) near.emplace_back(one);
      rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    }
  }
  if (near.empty()) near = close_matches(name, expected);
  return near.empty() ? "" : fmt::format("did you mean {}?", fmt::join(near, " or "));
}

}  // namespace nearmiss
