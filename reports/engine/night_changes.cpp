#include "reports/engine/night_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "impl/subject/provenance.hpp"
#include "impl/subject/subject.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A bound so many times that of all earlier nights is worse: a rung of the ladder, below which bounds are the same.
constexpr double times_worse = 2;

std::string key_of(const WrittenReport& w) {
  return fmt::format("{}/{}/{}/{}", w.query, w.subject, w.disagreement, w.breakage);
}

double bound_of(const WrittenReport& w) { return w.above.value_or(-1); }

/// The reports of one kind.
struct ReportsOfKind {
  const WrittenReport* tonight = nullptr;  ///< the worst
  const WrittenReport* earlier = nullptr;  ///< the worst
  bool all_again = true;                   ///< the cases of all earlier reports were asked again

  static void keep_worst(const WrittenReport*& worst, const WrittenReport& w) {
    if (worst == nullptr || bound_of(w) > bound_of(*worst)) worst = &w;
  }
  Change change() const {
    if (tonight == nullptr) return all_again ? Change::fixed : Change::known;
    if (earlier == nullptr) return Change::fresh;
    return bound_of(*tonight) > 0 && bound_of(*tonight) >= times_worse * bound_of(*earlier) ? Change::worse
                                                                                            : Change::known;
  }
};

constexpr Change all_changes[] = {Change::fresh, Change::worse, Change::known, Change::fixed};

std::string count_text(const NightChanges& all, bool ours) {
  std::vector<std::string> parts;
  for (const Change c : all_changes) parts.push_back(fmt::format("{} {}", all.of(ours, c).size(), name_of(c)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Where to look first: the worst of the new kinds, or of the worse ones.
std::string first_to_read(const NightChanges& all, bool ours, const fs::path& folder) {
  for (const Change c : {Change::fresh, Change::worse}) {
    const std::vector<ChangedKind> kinds = all.of(ours, c);
    if (kinds.empty()) continue;
    const WrittenReport& w = kinds.front().worst;
    return fmt::format("\n  {}: {}\n    {}", name_of(c), w.headline, path_text(folder / w.file));
  }
  return "";
}

}  // namespace

std::string_view name_of(Change c) {
  switch (c) {
    case Change::fresh: return "new";
    case Change::worse: return "worse";
    case Change::known: return "known";
    default: return "fixed";
  }
}

bool is_ours(const std::string& subject) {
  const auto is_among = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), subject) != names.end();
  };
  const bool is_plugin_or_command = !is_among(built_in_subjects());  // perhaps of an earlier night
  return is_plugin_or_command || is_among(own_subjects()) || is_among(added_subjects());
}

std::string names_of_ours() {
  const std::vector<std::string> own = own_subjects();
  std::set<std::string> names;
  for (const std::string& name : subject_names()) {
    const bool is_own = std::find(own.begin(), own.end(), name) != own.end();
    if (is_ours(name)) names.insert(is_own ? "collide" : name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

NightChanges::NightChanges(const std::vector<WrittenReport>& earlier, const std::vector<WrittenReport>& tonight,
                           const std::set<std::string>& again) {
  std::map<std::string, ReportsOfKind> kinds;
  for (const WrittenReport& w : earlier) {
    ReportsOfKind& kind = kinds[key_of(w)];
    ReportsOfKind::keep_worst(kind.earlier, w);
    kind.all_again = kind.all_again && again.contains(w.file);
  }
  for (const WrittenReport& w : tonight) ReportsOfKind::keep_worst(kinds[key_of(w)].tonight, w);
  for (const auto& [name, kind] : kinds) {
    const WrittenReport& worst = kind.tonight != nullptr ? *kind.tonight : *kind.earlier;
    kinds_.push_back({kind.change(), is_ours(worst.subject), worst});
  }
  std::stable_sort(kinds_.begin(), kinds_.end(),
                   [](const ChangedKind& a, const ChangedKind& b) { return bound_of(a.worst) > bound_of(b.worst); });
}

std::vector<ChangedKind> NightChanges::of(bool ours, Change change) const {
  std::vector<ChangedKind> some;
  std::copy_if(kinds_.begin(), kinds_.end(), std::back_inserter(some),
               [&](const ChangedKind& k) { return k.ours == ours && k.change == change; });
  return some;
}

bool NightChanges::is_regression() const {
  return !of(true, Change::fresh).empty() || !of(true, Change::worse).empty();
}

std::string NightChanges::text(const fs::path& folder) const {
  return fmt::format("{}: {}{}\nother libraries: {}{}", names_of_ours(), count_text(*this, true),
                     first_to_read(*this, true, folder), count_text(*this, false), first_to_read(*this, false, folder));
}

Json NightChanges::to_json() const {
  Json j = Json::object();
  for (const bool ours : {true, false}) {
    Json& side = j[ours ? "ours" : "others"] = Json::object();
    for (const Change c : all_changes) {
      Json& list = side[std::string(name_of(c))] = Json::array();
      for (const ChangedKind& k : of(ours, c)) list.push_back(written_to_json(k.worst));
    }
  }
  return j;
}

void put_aside_fixed(const NightChanges& changes, const std::vector<WrittenReport>& earlier, const fs::path& folder) {
  std::set<std::string> fixed;
  for (const bool ours : {true, false}) {
    for (const ChangedKind& k : changes.of(ours, Change::fixed)) fixed.insert(key_of(k.worst));
  }
  for (const WrittenReport& w : earlier) {
    if (!fixed.contains(key_of(w))) continue;
    const fs::path to = folder / "fixed" / fs::path(w.file).lexically_relative("findings");
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    fs::rename(folder / w.file, to, error);
  }
}

}  // namespace nearmiss
