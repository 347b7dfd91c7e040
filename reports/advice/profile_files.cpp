#include <fmt/format.h>
#include <collide/version.hpp>

#include <algorithm>
#include <set>
#include <string>

#include "reports/advice/profile.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t header_width = 120;

std::string head_of_header(const Profile& p) {
  return wrapped_text(
             fmt::format("The queries of collide that the scene {} asks, each at the tier and in the scalar that "
                         "'nearmiss scene advise' chose for it. This command wrote this file. It includes the "
                         "headers of these queries alone. A call of any other query is a compile error that "
                         "states what to do. Arguments have a type: collide::Sphere<double>{{...}}, not {{...}}.",
                         p.scene.name),
             "/// ", header_width) +
         "#pragma once\n\n";
}

std::string includes_of_header(const Profile& p) {
  std::string text;
  std::set<std::string> tiers;
  for (const ProfiledQuery& q : p.queries) {
    const TierOfSubject t = tier_of(q.subject);
    tiers.insert(t.tier);
    if (!t.tier.empty()) text += fmt::format("#include <collide/{}.hpp>\n", q.query->name);
  }
  if (tiers.contains("Decisive")) text = "#include <collide/decisive.hpp>\n" + text;
  if (tiers.contains("Certified")) text = "#include <collide/certified.hpp>\n" + text;
  return text + "#include <concepts>\n\n";
}

std::string function_of(const Profile& p, const ProfiledQuery& q, const TierOfSubject& t) {
  const std::string comment =
      wrapped_text(in_c_comment(fmt::format("`{}` in {}. {}", t.tier, t.scalar, q.evidence)), "/// ", header_width);
  return fmt::format(R"({0}template <class... Arguments>
[[nodiscard]] inline auto {1}(const Arguments&... arguments) noexcept(collide::{2}::never_throws) {{
  using Answer = decltype(collide::{1}<collide::{2}>(arguments...));
  static_assert(std::same_as<Answer, collide::Rebound<Answer, {3}>>,
                "{1}: the profile of the scene {4} computes in {3}");
  return collide::{1}<collide::{2}>(arguments...);
}}

)",
                     comment, q.query->name, t.tier, t.scalar, p.scene.name);
}

std::string absence_of(const Query& query, const std::string& why) {
  return fmt::format(R"(template <class... Arguments>
void {0}(const Arguments&...) {{
  static_assert(detail::is_offered<Arguments...>,
                {1});
}}

)",
                     query.name, c_string(fmt::format("{} {}", query.name, why)));
}

/// Why a query has no function; empty for one that has.
std::string why_absent(const Profile& p, const Query& query) {
  for (const ProfiledQuery& q : p.queries) {
    if (q.query != &query) continue;
    if (!tier_of(q.subject).tier.empty()) return "";
    return fmt::format("is answered by {}, which is no tier of collide, in the profile of the scene {}", q.subject,
                       p.scene.name);
  }
  for (const MissingQuery& m : p.missing) {
    if (m.query == &query) return fmt::format("is not in the profile of the scene {}: {}", p.scene.name, m.why);
  }
  return fmt::format("is not in the profile of the scene {}: add it to the scene and run 'nearmiss scene advise'",
                     p.scene.name);
}

/// The queries of the profile that the library collide::certified answers, separated by spaces.
std::string certified_queries(const Profile& p) {
  std::string names;
  for (const ProfiledQuery& q : p.queries) {
    const std::string tier = tier_of(q.subject).tier;
    if (tier == "Certified" || tier == "Decisive") names += (names.empty() ? "" : " ") + std::string(q.query->name);
  }
  return names;
}

}  // namespace

std::string profile_header(const Profile& p) {
  std::string text = head_of_header(p) + includes_of_header(p);
  text +=
      "namespace collide_profile {\n\nnamespace detail {\n\ntemplate <class...>\n"
      "inline constexpr bool is_offered = false;\n\n}  // namespace detail\n\n";
  for (const ProfiledQuery& q : p.queries) {
    if (const TierOfSubject t = tier_of(q.subject); !t.tier.empty()) text += function_of(p, q, t);
  }
  for (const Query& q : catalogue()) {
    if (const std::string why = why_absent(p, q); !why.empty()) text += absence_of(q, why);
  }
  return text + "}  // namespace collide_profile\n";
}

std::string profile_cmake(const Profile& p) {
  const std::string queries = certified_queries(p);
  const bool certified = !queries.empty();
  const std::string_view target = certified ? "collide::certified" : "collide::collide";
  const std::string of_library = certified ? fmt::format("    set(COLLIDE_CERTIFIED_QUERIES {})\n", queries) : "";
  return fmt::format(
      R"(# The interface library collide_profile: the header collide_profile.hpp beside this file, for the scene {0}.
# 'nearmiss scene advise' wrote this file. It uses the target collide::collide of this build where there is one, else
# the checkout of impl/collide in COLLIDE_SOURCE, else the installed package.
if(NOT TARGET collide::collide)
  if(COLLIDE_SOURCE)
    include(FetchContent)
{5}    FetchContent_Declare(collide SOURCE_DIR ${{COLLIDE_SOURCE}})
    FetchContent_MakeAvailable(collide)
  else()
    find_package(collide {1}.{2} REQUIRED{3})
  endif()
endif()
if(NOT TARGET {4})
  message(FATAL_ERROR "collide_profile needs {4}, which is missing")
endif()
add_library(collide_profile INTERFACE)
target_include_directories(collide_profile INTERFACE ${{CMAKE_CURRENT_LIST_DIR}})
target_link_libraries(collide_profile INTERFACE {4})
)",
      p.scene.name, COLLIDE_VERSION_MAJOR, COLLIDE_VERSION_MINOR, certified ? " COMPONENTS certified" : "", target,
      of_library);
}

}  // namespace nearmiss
