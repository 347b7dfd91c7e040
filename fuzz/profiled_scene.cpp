#include "fuzz/profiled_scene.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "fuzz/asked.hpp"

namespace nearmiss::fuzz {

namespace {

namespace fs = std::filesystem;

/// The profile as JSON (reports/profile.schema.json). 'nearmiss' checks every field; this reads those of the target.
nlohmann::json profile_in(const std::string& file) {
  nlohmann::json j = parse_json(read_file(file), file);
  const bool is_profile = j.is_object() && j.contains("scene") && j["scene"].is_object() &&
                          j["scene"].contains("file") && j.contains("queries") && j["queries"].is_array();
  if (!is_profile) throw BadInput(fmt::format("{}: it is not a profile of 'nearmiss scene advise'", file));
  return j;
}

/// The subject that the profile has answer the query.
std::string subject_in(const std::string& file, const Query& query) {
  const nlohmann::json profile = profile_in(file);
  for (const FileValue& q : FileValue(profile, file).at("queries").items()) {
    if (q.at("query").text() == query.name) return q.at("subject").text();
  }
  throw BadInput(fmt::format("{}: queries: the profile does not have {}", file, query.name));
}

scenes::Scene scene_in(const std::string& file) {
  const nlohmann::json profile = profile_in(file);
  const FileValue scene = FileValue(profile, file).at("scene");
  if (scene.at("file").is_null()) return scenes::load_scene(scene.at("name").text());
  const fs::path own = fs::absolute(file).parent_path() / scene.at("file").text();
  return scenes::load_scene(own.lexically_normal().string());
}

}  // namespace

ProfiledScene::ProfiledScene(const Query& query, const std::string& file)
    : query_(query), subject_(subject_in(file, query)), scene_(scene_in(file)), ranges_(scene_, query) {}

const ProfiledScene* ProfiledScene::of_environment(const Query& query) {
  static const ProfiledScene* const known = [&]() -> const ProfiledScene* {
    const char* file = std::getenv("NEARMISS_PROFILE");
    if (file == nullptr || *file == '\0') return nullptr;
    try {
      static const ProfiledScene scene(query, file);
      use_measure({{}, scenes::limits_of(scene.scene_)});
      return &scene;
    } catch (const std::exception& e) {
      cannot_run(fmt::format("NEARMISS_PROFILE: {}", e.what()));
    }
  }();
  return known;
}

void ProfiledScene::bring_back(Case& c, Scalar scalar, unsigned seed) const {
  if (c.scalar != scalar || !ranges_.fit(c)) c = fresh_case(scalar, seed);
}

}  // namespace nearmiss::fuzz
