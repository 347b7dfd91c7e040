#include "fuzz/asked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <span>
#include <string>

#include "fuzz/this_target.hpp"
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

/// The named subject. A name must be that of a subject that offers one of the queries.
const Subject& named_subject(const std::string& name, std::span<const Query* const> queries) {
  const Subject* s = find_subject(name);
  if (s == nullptr) {
    cannot_run(fmt::format("the subject \"{}\" is to be asked, and this build does not have it", name));
  }
  if (std::none_of(queries.begin(), queries.end(), [&](const Query* q) { return offers(*s, *q); })) {
    cannot_run(fmt::format("the subject \"{}\" is to be asked, and it does not offer {}", name,
                           queries.size() == 1 ? "this query" : "a query of this target"));
  }
  return *s;
}

/// A subject to ask each query that it offers.
struct Chosen {
  const Subject* subject;
  bool is_named = false;
};

std::vector<Chosen> chosen_subjects(std::span<const Query* const> queries) {
  const bool tiers = *instead_of_tiers == '\0';
  std::vector<std::string> names = names_in(instead_of_tiers);
  for (std::string& name : names_in(std::getenv("NEARMISS_SUBJECTS"))) names.push_back(std::move(name));
  const std::vector<std::string> added = added_subjects();
  std::vector<Chosen> chosen;
  for (const Subject& s : subjects()) {
    if ((s.own && tiers) || s.host != nullptr || (has(names, "added") && has(added, s.name))) chosen.push_back({&s});
  }
  for (const std::string& name : names) {
    if (name == "added") continue;
    const Subject& s = named_subject(name, queries);
    const auto known = std::find_if(chosen.begin(), chosen.end(), [&](const Chosen& c) { return c.subject == &s; });
    (known != chosen.end() ? *known : chosen.emplace_back(Chosen{&s})).is_named = true;
  }
  return chosen;
}

/// The queries that NEARMISS_QUERIES names, which are some of the target's; without it all of these.
std::vector<const Query*> chosen_queries(const FuzzTarget& target) {
  std::vector<const Query*> chosen;
  for (const std::string& name : names_in(std::getenv("NEARMISS_QUERIES"))) {
    const Query* q = find_query(name);
    if (q == nullptr || !target.asks(*q))
      cannot_run(fmt::format("NEARMISS_QUERIES: {} is no query of this target", name));
    chosen.push_back(q);
  }
  return chosen.empty() ? target.queries : chosen;
}

/// Those of the subjects that are asked the query.
std::vector<Asked> asked_of(const Query& query, std::span<const Chosen> subjects) {
  std::vector<Asked> asked;
  for (const auto& [s, is_named] : subjects) {
    if (offers(*s, query) && (is_named || !repeats_a_tier(*s, query)))
      asked.push_back({s, s->offering(query.name).answer, s->standard_for(query.name)});
  }
  return asked;
}

/// The queries of the profile with its choices.
std::vector<AskedQuery> profiled_queries(std::span<const Query* const> queries, const std::string& profile) {
  std::vector<AskedQuery> all;
  for (const Query* q : queries) {
    std::unique_ptr<const ProfiledScene> scene = ProfiledScene::of_profile(profile, *q);
    if (!scene) continue;
    const std::vector<const Query*> alone{q};
    const Subject& s = named_subject(scene->subject(), alone);
    all.push_back({q, asked_of(*q, std::vector<Chosen>{{&s, true}}), std::move(scene)});
  }
  if (all.empty())
    cannot_run(fmt::format("NEARMISS_PROFILE: {}: queries: the profile does not have {}", profile,
                           queries.size() == 1 ? queries[0]->name : "a query of this target"));
  return all;
}

std::vector<AskedQuery> made_queries(const FuzzTarget& target) {
  const std::vector<const Query*> queries = chosen_queries(target);
  if (const char* profile = std::getenv("NEARMISS_PROFILE"); profile != nullptr && *profile != '\0')
    return profiled_queries(queries, profile);
  const std::vector<Chosen> subjects = chosen_subjects(queries);
  std::vector<AskedQuery> all;
  for (const Query* q : queries) all.push_back({q, asked_of(*q, subjects)});
  const auto asks_nobody = [](const AskedQuery& q) { return q.subjects.empty(); };
  if (!std::all_of(all.begin(), all.end(), asks_nobody)) std::erase_if(all, asks_nobody);
  return all;
}

}  // namespace

void cannot_run(const std::string& why) {
  std::fprintf(stderr, "fuzz_%s: %s\n", this_target, why.c_str());
  std::exit(2);
}

std::vector<AskedQuery> asked_queries(const FuzzTarget& target) {
  try {
    load_subjects_of_environment();
  } catch (const BadSubject& e) {
    cannot_run(e.what());
  }
  std::vector<AskedQuery> all = made_queries(target);
  std::set<std::string> named;
  std::string line;
  for (const AskedQuery& q : all) {
    for (const Asked& a : q.subjects) {
      if (named.insert(a.subject->name).second) line += " " + a.subject->name;
    }
  }
  std::fprintf(stderr, "asks:%s\n", line.c_str());
  return all;
}

}  // namespace nearmiss::fuzz
