#include "corpus/scenes/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"

namespace nearmiss::scenes {

namespace fs = std::filesystem;

std::span<const Unit> known_units() {
  static constexpr Unit units[] = {{"millimetre", 1e-3}, {"centimetre", 1e-2}, {"inch", 0.0254},  {"foot", 0.3048},
                                   {"yard", 0.9144},     {"metre", 1},         {"kilometre", 1e3}};
  return units;
}

std::shared_ptr<const SceneLimits> limits_of(const Scene& scene) {
  const Requirements& r = scene.required;
  return std::make_shared<const SceneLimits>(SceneLimits{scene.name, scene.unit, r.position_error.value,
                                                         r.missed_depth.value, r.time_error.value * scene.step.value});
}

const MixedQuery* Scene::find(const Query& query) const {
  const auto found =
      std::find_if(queries.begin(), queries.end(), [&](const MixedQuery& m) { return m.query == &query; });
  return found == queries.end() ? nullptr : &*found;
}

double Scene::share_of(const Query& query) const {
  double sum = 0;
  for (const MixedQuery& m : queries) sum += m.weight.value;
  const MixedQuery* own = find(query);
  return own == nullptr ? 0 : own->weight.value / sum;
}

std::vector<const Query*> Scene::all_queries() const {
  std::vector<const Query*> all;
  for (const MixedQuery& m : queries) all.push_back(m.query);
  return all;
}

fs::path scenes_folder() { return corpus_folder() / "scenes"; }

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  if (!fs::is_directory(scenes_folder())) return names;
  for (const auto& entry : fs::directory_iterator(scenes_folder())) {
    const fs::path& file = entry.path();
    if (file.extension() == ".json" && !file.stem().string().ends_with(".schema"))
      names.push_back(file.stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Scene load_scene(const std::string& name_or_file) {
  fs::path file = name_or_file;
  const std::vector<std::string> names = scene_names();
  if (std::find(names.begin(), names.end(), name_or_file) != names.end()) {
    file = scenes_folder() / (name_or_file + ".json");
  } else if (file.extension() != ".json") {
    throw BadInput(fmt::format("unknown scene '{}': known are {}; a file must end with .json", name_or_file,
                               fmt::join(names, ", ")));
  }
  return scene_from_json(parse_json(read_file(file), file.string()), file);
}

}  // namespace nearmiss::scenes
