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

/// The subject that the profile has answer the query; empty where it does not have the query.
std::string subject_in(const nlohmann::json& profile, const std::string& file, const Query& query) {
  for (const FileValue& q : FileValue(profile, file).at("queries").items()) {
    if (q.at("query").text() == query.name) return q.at("subject").text();
  }
  return "";
}

scenes::Scene scene_in(const nlohmann::json& profile, const std::string& file) {
  const FileValue scene = FileValue(profile, file).at("scene");
  if (scene.at("file").is_null()) return scenes::load_scene(scene.at("name").text());
  const fs::path own = fs::absolute(file).parent_path() / scene.at("file").text();
  return scenes::load_scene(own.lexically_normal().string());
}

}  // namespace

ProfiledScene::ProfiledScene(const Query& query, std::string subject, scenes::Scene scene)
    : query_(&query), subject_(std::move(subject)), scene_(std::move(scene)), ranges_(scene_, query) {}

std::unique_ptr<const ProfiledScene> ProfiledScene::of_profile(const std::string& file, const Query& query) {
  try {
    const nlohmann::json profile = profile_in(file);
    std::string subject = subject_in(profile, file, query);
    if (subject.empty()) return nullptr;
    std::unique_ptr<const ProfiledScene> made(new ProfiledScene(query, std::move(subject), scene_in(profile, file)));
    use_measure({{}, scenes::limits_of(made->scene_)});
    return made;
  } catch (const std::exception& e) {
    cannot_run(fmt::format("NEARMISS_PROFILE: {}", e.what()));
  }
}

void ProfiledScene::bring_back(Case& c, Scalar scalar, unsigned seed) const {
  if (c.query != query_ || c.scalar != scalar || !ranges_.fit(c)) c = fresh_case(scalar, seed);
}

}  // namespace nearmiss::fuzz
