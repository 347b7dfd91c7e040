#include "reports/advice/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/advice/advice_json.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"
#include "reports/trade/trade_json.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string evidence_sentence(const SceneEvidence& e, const std::string& unit) {
  std::string text = fmt::format("{} of the seed {}: {} beyond the tolerance", plural_text(e.cases, "case"), e.seed,
                                 e.beyond == 0 ? "no answer was" : plural_text(e.beyond, "answer") + " were");
  text += fmt::format(", so the rate is below {} (95 %)", three_digits(rate_of(e.beyond, e.cases).high));
  if (e.distance.proved > 0)
    text +=
        fmt::format("; the largest proved error of a place or depth is {} {}", three_digits(e.distance.proved), unit);
  if (e.time.proved > 0) text += fmt::format("; of a time {} s", three_digits(e.time.proved));
  return text + ".";
}

bool is_shipped(const scenes::Scene& scene) {
  return fs::weakly_canonical(scene.file.parent_path()) == fs::weakly_canonical(scenes::scenes_folder());
}

Json scene_to_json(const scenes::Scene& scene, const fs::path& folder) {
  const fs::path file = is_shipped(scene) ? fs::path() : fs::relative(fs::absolute(scene.file), fs::absolute(folder));
  return {{"name", scene.name}, {"file", file.empty() ? Json(nullptr) : Json(file.generic_string())}};
}

const AdvisedQuery& advised_query(const Advice& advice, const Query& query) {
  return *std::find_if(advice.queries().begin(), advice.queries().end(),
                       [&](const AdvisedQuery& a) { return a.query == &query; });
}

Json profiled_to_json(const ProfiledQuery& p, const Advice& advice) {
  const AdvisedQuery& a = advised_query(advice, *p.query);
  const TierOfSubject tier = tier_of(p.subject);
  Json evidence = evidence_to_json(*a.choice()->evidence);
  evidence.erase("worst");
  return {{"query", p.query->name},
          {"subject", p.subject},
          {"tier", tier.tier.empty() ? Json(nullptr) : Json(tier.tier)},
          {"scalar", name_of(a.choice()->subject().scalar)},
          {"share", a.share},
          {"nanoseconds", optional_to_json(a.choice()->cost())},
          {"evidence", std::move(evidence)}};
}

/// Reads the fields of a profile; errors name the file and the field.
class ProfileReader {
 public:
  explicit ProfileReader(const fs::path& file) : file_(file), j_(parse_json(read_file(file), file.string())) {}

  Profile read() {
    if (!j_.is_object() || j_.value("schema", Json()) != 1) fail("schema", "it is not a profile of schema 1");
    Profile p;
    p.scene = scene();
    p.seed = number(j_, "seed");
    p.cases = number(j_, "cases");
    for (const nlohmann::json& q : list("queries")) p.queries.push_back({query_of(q), text(q, "subject"), ""});
    for (const nlohmann::json& q : list("missing")) p.missing.push_back({query_of(q), text(q, "why")});
    for (const ProfiledQuery& q : p.queries) {
      if (p.scene.find(*q.query) == nullptr)
        fail("queries", fmt::format("the scene {} does not ask {}", p.scene.name, q.query->name));
    }
    return p;
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& rule) const {
    throw BadInput(fmt::format("{}: {}: {}", file_.string(), field, rule));
  }
  const nlohmann::json& field(const nlohmann::json& of, const std::string& name) const {
    if (!of.is_object() || !of.contains(name)) fail(name, "the field is missing");
    return of[name];
  }
  std::string text(const nlohmann::json& of, const std::string& name) const {
    const nlohmann::json& j = field(of, name);
    if (!j.is_string()) fail(name, "it is not a text");
    return j.get<std::string>();
  }
  std::uint64_t number(const nlohmann::json& of, const std::string& name) const {
    const nlohmann::json& j = field(of, name);
    if (!j.is_number_unsigned()) fail(name, "it is not a whole number");
    return j.get<std::uint64_t>();
  }
  const nlohmann::json& list(const std::string& name) const {
    const nlohmann::json& j = field(j_, name);
    if (!j.is_array()) fail(name, "it is not a list");
    return j;
  }
  const Query* query_of(const nlohmann::json& of) const {
    const std::string name = text(of, "query");
    const Query* query = find_query(name);
    if (query == nullptr) fail("query", fmt::format("unknown query '{}'", name));
    return query;
  }
  scenes::Scene scene() const {
    try {
      return scenes::load_scene(scene_name());
    } catch (const BadInput& e) {
      fail("scene", e.what());
    }
  }
  std::string scene_name() const {
    const nlohmann::json& scene = field(j_, "scene");
    if (field(scene, "file").is_null()) return text(scene, "name");
    return (fs::absolute(file_).parent_path() / text(scene, "file")).lexically_normal().string();
  }

  const fs::path& file_;
  nlohmann::json j_;
};

}  // namespace

TierOfSubject tier_of(std::string_view subject) {
  static constexpr std::pair<std::string_view, std::string_view> tiers[] = {
      {"fast", "Fast"}, {"accurate", "Accurate"}, {"decisive", "Decisive"}, {"certified", "Certified"}};
  for (const auto& [word, tier] : tiers) {
    for (const std::string_view scalar : {"float", "double"}) {
      if (subject == fmt::format("collide-{}-{}", word, scalar)) return {std::string(tier), std::string(scalar)};
    }
  }
  return {};
}

Profile profile_of(const Advice& advice, const scenes::Scene& scene) {
  Profile p{scene, advice.evidence_seed(), advice.settings().cases, {}, {}};
  const std::string& unit = advice.settings().source.tolerance.unit;
  for (const AdvisedQuery& a : advice.queries()) {
    if (a.choice() == nullptr) {
      p.missing.push_back({a.query, "no measured subject meets every requirement of the scene"});
    } else {
      p.queries.push_back({a.query, a.choice()->subject().name, evidence_sentence(*a.choice()->evidence, unit)});
    }
  }
  return p;
}

void write_profile(const Profile& profile, const Advice& advice) {
  const fs::path& folder = advice.settings().folder;
  Json queries = Json::array(), missing = Json::array();
  for (const ProfiledQuery& q : profile.queries) queries.push_back(profiled_to_json(q, advice));
  for (const MissingQuery& q : profile.missing) missing.push_back({{"query", q.query->name}, {"why", q.why}});
  const Json j{{"schema", 1},
               {"scene", scene_to_json(profile.scene, folder)},
               {"seed", profile.seed},
               {"cases", profile.cases},
               {"tolerance", tolerance_to_json(advice.settings().source.tolerance)},
               {"queries", std::move(queries)},
               {"missing", std::move(missing)}};
  write_file(folder / "profile.json", pretty_json(j));
  write_file(folder / "collide_profile.hpp", profile_header(profile));
  write_file(folder / "collide_profile.cmake", profile_cmake(profile));
}

Profile load_profile(const fs::path& file) { return ProfileReader(file).read(); }

const Subject& subject_of(const ProfiledQuery& query, const fs::path& profile) {
  const Subject* s = find_subject(query.subject);
  if (s == nullptr) {
    throw BadInput(
        fmt::format("{}: {}: this build has no subject {}", profile.string(), query.query->name, query.subject));
  }
  if (s->offering(query.query->name).answer == nullptr) {
    throw BadInput(
        fmt::format("{}: {}: the subject {} does not offer it", profile.string(), query.query->name, s->name));
  }
  return *s;
}

}  // namespace nearmiss
