#include "fuzz/asked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fuzz/fuzzed_query.hpp"
#include "impl/host/hosts.hpp"
#include "impl/subject/provenance.hpp"

namespace nearmiss::fuzz {

namespace {

std::vector<std::string> named_in_environment() {
  const char* value = std::getenv("NEARMISS_SUBJECTS");
  std::vector<std::string> names;
  for (std::string_view rest = value == nullptr ? "" : value; !rest.empty();) {
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

/// The named subject. A name must be that of a subject that offers the query.
const Subject& named_subject(const std::string& name, const Query& query) {
  const Subject* s = find_subject(name);
  if (s == nullptr) {
    cannot_run(fmt::format("NEARMISS_SUBJECTS names \"{}\", which is no subject of this build", name));
  }
  if (!offers(*s, query)) {
    cannot_run(fmt::format("NEARMISS_SUBJECTS names \"{}\", which does not offer this query", name));
  }
  return *s;
}

std::vector<const Subject*> chosen_subjects(const Query& query) {
  const std::vector<std::string> names = named_in_environment(), added = added_subjects();
  std::vector<const Subject*> chosen;
  for (const Subject& s : subjects()) {
    const bool wanted = s.own || s.host != nullptr || (has(names, "added") && has(added, s.name));
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
