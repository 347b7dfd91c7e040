#include "fuzz/asked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fuzz/fuzzed_query.hpp"
#include "fuzz/profiled_scene.hpp"
#include "impl/adapters/decisive_kernels.hpp"
#include "impl/host/hosts.hpp"
#include "impl/subject/provenance.hpp"

namespace nearmiss::fuzz {

namespace {

#ifdef NEARMISS_FUZZ_SUBJECTS
constexpr const char* instead_of_tiers = NEARMISS_FUZZ_SUBJECTS;
#else
constexpr const char* instead_of_tiers = "";
#endif

/// The names in a list that is separated by commas.
std::vector<std::string> names_in(const char* list) {
  std::vector<std::string> names;
  for (std::string_view rest = list == nullptr ? "" : list; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    if (comma > 0) names.emplace_back(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return names;
}

bool has(const std::vector<std::string>& all, const std::string& name) {
  return std::find(all.begin(), all.end(), name) != all.end();
}

bool offers(const Subject& s, const Query& query) { return s.offering(query.name).offer != Offer::not_offered; }

/// Whether the subject's answers to the query are those of another tier: fuzzing would find each mistake twice, and the
/// second answer would cost a quarter of the time.
bool repeats_a_tier(const Subject& s, const Query& query) {
  return s.own && s.name.starts_with("collide-decisive-") && !adapters::has_decisive_kernel(query.name);
}

/// The named subject. A name must be that of a subject that offers the query.
const Subject& named_subject(const std::string& name, const Query& query) {
  const Subject* s = find_subject(name);
  if (s == nullptr) {
    cannot_run(fmt::format("the subject \"{}\" is to be asked, and this build does not have it", name));
  }
  if (!offers(*s, query)) {
    cannot_run(fmt::format("the subject \"{}\" is to be asked, and it does not offer this query", name));
  }
  return *s;
}

std::vector<const Subject*> chosen_subjects(const Query& query) {
  if (const ProfiledScene* profiled = ProfiledScene::of_environment(query))
    return {&named_subject(profiled->subject(), query)};
  const bool tiers = *instead_of_tiers == '\0';
  std::vector<std::string> names = names_in(instead_of_tiers);
  for (std::string& name : names_in(std::getenv("NEARMISS_SUBJECTS"))) names.push_back(std::move(name));
  const std::vector<std::string> added = added_subjects();
  std::vector<const Subject*> chosen;
  for (const Subject& s : subjects()) {
    const bool wanted = (s.own && tiers && !repeats_a_tier(s, query)) || s.host != nullptr ||
                        (has(names, "added") && has(added, s.name));
    if (wanted && offers(s, query)) chosen.push_back(&s);
  }
  for (const std::string& name : names) {
    if (name == "added") continue;
    const Subject& s = named_subject(name, query);
    if (std::find(chosen.begin(), chosen.end(), &s) == chosen.end()) chosen.push_back(&s);
  }
  return chosen;
}

}  // namespace

void cannot_run(const std::string& why) {
  std::fprintf(stderr, "fuzz_%s: %s\n", fuzzed_query, why.c_str());
  std::exit(2);
}

std::vector<Asked> asked_subjects(const Query& query) {
  try {
    load_subjects_of_environment();
  } catch (const BadSubject& e) {
    cannot_run(e.what());
  }
  std::vector<Asked> asked;
  std::string line;
  for (const Subject* s : chosen_subjects(query)) {
    asked.push_back({s, s->offering(query.name).answer, s->standard_for(query.name)});
    line += " " + s->name;
  }
  std::fprintf(stderr, "asks:%s\n", line.c_str());
  return asked;
}

}  // namespace nearmiss::fuzz
