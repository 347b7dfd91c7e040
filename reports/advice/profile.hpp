/// Profiles: the queries of a scene, each with the subject that 'nearmiss scene advise' chose (profile.json,
/// reports/profile.schema.json), and the header and the CMake fragment that offer exactly these queries of collide.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/scenes/scene_file.hpp"
#include "impl/subject/subject.hpp"
#include "reports/advice/advice.hpp"

namespace nearmiss {

struct ProfiledQuery {
  const Query* query = nullptr;
  std::string subject;   ///< "collide-fast-float"
  std::string evidence;  ///< one sentence, for the header
};

/// A query of the scene that the profile cannot offer.
struct MissingQuery {
  const Query* query = nullptr;
  std::string why;  ///< one sentence
};

struct Profile {
  scenes::Scene scene;
  std::uint64_t seed = 0;  ///< of the evidence
  std::uint64_t cases = 0;
  std::vector<ProfiledQuery> queries;
  std::vector<MissingQuery> missing;
};

/// The profile that follows from an advice for the scene.
Profile profile_of(const Advice& advice, const scenes::Scene& scene);
/// Writes profile.json, collide_profile.hpp and collide_profile.cmake into the folder of the advice. The profile names
/// a scene of Nearmiss by its name, and any other by the path from this folder to its file.
void write_profile(const Profile& profile, const Advice& advice);

/// Reads profile.json. Throws BadInput that states file, field and rule, also for a scene that cannot be read.
Profile load_profile(const std::filesystem::path& file);
/// The subject of a query. Throws BadInput where this build does not have it, or where it does not offer the query.
const Subject& subject_of(const ProfiledQuery& query, const std::filesystem::path& profile);

/// C++: one function for each query of the profile, and for each other query of the catalogue one that does not compile
/// and states why.
std::string profile_header(const Profile& profile);
/// CMake: the interface library `collide_profile`.
std::string profile_cmake(const Profile& profile);

/// A tier of collide in a scalar, of the name of its subject.
struct TierOfSubject {
  std::string tier;    ///< "Fast"; empty for a subject that is no tier of collide
  std::string scalar;  ///< "float"
};
TierOfSubject tier_of(std::string_view subject);

}  // namespace nearmiss
