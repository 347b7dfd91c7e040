#include "reports/commands/profile_option.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/files/errors.hpp"

namespace nearmiss {

namespace {

/// The subject without the offers for other queries.
Subject with_no_offer_beyond(const Subject& subject, const std::vector<ProfiledQuery>& queries) {
  Subject restricted = subject;
  for (Offering& o : restricted.offerings) {
    const bool asked = std::any_of(queries.begin(), queries.end(), [&](const ProfiledQuery& q) {
      return q.subject == subject.name && q.query->name == o.query;
    });
    if (asked) continue;
    o.offer = Offer::not_offered;
    o.how = "the profile does not have it answer this query";
    o.answer = {};
  }
  return restricted;
}

}  // namespace

ChosenProfile::ChosenProfile(const std::string& file) : profile_(load_profile(file)) {
  if (profile_.queries.empty()) throw BadInput(fmt::format("{}: queries: the profile has none", file));
  std::vector<const Subject*> all;
  for (const ProfiledQuery& q : profile_.queries) {
    const Subject& s = subject_of(q, file);
    if (std::find(all.begin(), all.end(), &s) == all.end()) all.push_back(&s);
  }
  for (const Subject* s : all) subjects_.push_back(with_no_offer_beyond(*s, profile_.queries));
}

std::vector<const Query*> ChosenProfile::queries() const {
  std::vector<const Query*> all;
  for (const ProfiledQuery& q : profile_.queries) all.push_back(q.query);
  return all;
}

std::vector<const Subject*> ChosenProfile::subjects() const {
  std::vector<const Subject*> all;
  for (const Subject& s : subjects_) all.push_back(&s);
  return all;
}

void ProfileOption::declare(CLI::App& app) {
  CLI::Option* option =
      app.add_option("--profile", file,
                     "Ask the queries of this profile.json, each of the subject that the profile has answer it, with "
                     "cases of its scene; 'nearmiss scene advise' writes profiles")
          ->type_name("FILE");
  for (const char* excluded : {"--query", "--subject", "--scene"}) {
    if (CLI::Option* other = app.get_option_no_throw(excluded)) option->excludes(other);
  }
}

}  // namespace nearmiss
