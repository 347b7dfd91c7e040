#include "impl/subject/subject.hpp"

#include <algorithm>
#include <utility>

#include "impl/catalogue/query.hpp"
#include "impl/subject/foreign_promises.hpp"
#include "impl/subject/provenance.hpp"

namespace nearmiss {

namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A convention that the user declares.
struct UsersDeclaration {
  std::string subject, query;  ///< empty: of every query that it concerns
  Declaration declaration;

  bool is_about(const Subject& s, std::string_view q) const {
    if (s.name != subject || (!query.empty() && query != q)) return false;
    const Query* known = find_query(q);
    return known != nullptr && concerns(declaration.convention, *known);
  }
};

std::vector<UsersDeclaration>& users_declarations() {
  static std::vector<UsersDeclaration> all;
  return all;
}

void declare_of_user(Subject& s) {
  for (const UsersDeclaration& u : users_declarations()) {
    for (Offering& o : s.offerings) {
      if (o.offer != Offer::not_offered && u.is_about(s, o.query)) o.declare({u.declaration});
    }
  }
}

/// The subject in the state before its start.
Subject not_started(std::string name) {
  Subject s;
  s.name = std::move(name);
  s.started = false;
  for (const Query& q : catalogue()) {
    Offering& o = s.offerings.emplace_back();
    o.query = q.name;
    o.how = "it is not built yet; './nearmiss build " + s.name + "' builds it";
  }
  return s;
}

/// The subjects of the process. Those of this build come first, and keep their places when they are started.
class AllSubjects {
 public:
  AllSubjects() : names_(built_in_subjects()), is_started_(names_.size()) {
    for (const std::string& name : names_) all_.push_back(not_started(name));
  }
  std::vector<Subject>& all() { return all_; }
  const std::vector<std::string>& built_in() const { return names_; }
  /// Starts those subjects of this build with these names that are not started.
  template <class Start>
  void start(const std::vector<std::string>& names, Start started_of) {
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (!is_started_[i] && contains(names, names_[i])) missing.push_back(names_[i]);
    }
    if (missing.empty()) return;
    for (Subject& s : started_of(missing)) put(std::move(s));
  }

 private:
  void put(Subject s) {
    const auto i = std::size_t(std::find(names_.begin(), names_.end(), s.name) - names_.begin());
    s.own = contains(own_, s.name);
    s.referee = contains(referees_, s.name);
    declare_of_user(s);
    all_.at(i) = std::move(s);
    is_started_[i] = true;
  }
  std::vector<std::string> names_, own_ = own_subjects(), referees_ = names_of_referees();
  std::vector<bool> is_started_;
  std::vector<Subject> all_;
};

AllSubjects& of_process() {
  static AllSubjects all;
  return all;
}

/// The installed engines; they keep their places when they are started.
std::vector<Subject>& engines_of_process() {
  static std::vector<Subject> engines = [] {
    std::vector<Subject> all;
    for (const std::string& name : installed_engines()) all.push_back(not_started(name));
    return all;
  }();
  return engines;
}

std::vector<std::string> names_of_engines() {
  std::vector<std::string> names;
  for (const Subject& s : engines_of_process()) names.push_back(s.name);
  return names;
}

void start_engines_named(const std::vector<std::string>& wanted) {
  std::vector<std::string> missing;
  for (const Subject& s : engines_of_process()) {
    if (!s.started && contains(wanted, s.name)) missing.push_back(s.name);
  }
  if (missing.empty()) return;
  for (Subject& started : start_engines(missing)) {
    declare_of_user(started);
    const auto listed = std::find_if(engines_of_process().begin(), engines_of_process().end(),
                                     [&](const Subject& s) { return s.name == started.name; });
    if (listed != engines_of_process().end()) *listed = std::move(started);
  }
}

}  // namespace

const std::vector<Subject>& subjects() {
  of_process().start(of_process().built_in(), start_built_in);
  return of_process().all();
}

const std::vector<Subject>& subjects_at_hand() {
  of_process().start(of_process().built_in(), start_at_hand);
  return of_process().all();
}

const std::vector<Subject>& engines_at_hand() {
  start_engines_named(names_of_engines());
  return engines_of_process();
}

std::vector<std::string> subject_names() {
  std::vector<std::string> names;
  for (const Subject& s : of_process().all()) names.push_back(s.name);
  return names;
}

std::vector<const Subject*> subjects_named(std::span<const std::string> names) {
  const std::vector<std::string> wanted(names.begin(), names.end());
  of_process().start(wanted, start_built_in);
  start_engines_named(wanted);
  std::vector<const Subject*> some;
  for (const std::vector<Subject>* all : {&of_process().all(), &engines_of_process()}) {
    for (const Subject& s : *all) {
      if (contains(wanted, s.name)) some.push_back(&s);
    }
  }
  return some;
}

std::vector<const Subject*> referees() { return subjects_named(names_of_referees()); }

void add_subject(Subject subject) {
  declare_of_user(subject);
  of_process().all().push_back(std::move(subject));
}

void declare(const std::string& subject, std::string_view query, const Declaration& declaration) {
  users_declarations().push_back({subject, std::string(query), declaration});
  for (std::vector<Subject>* all : {&of_process().all(), &engines_of_process()}) {
    for (Subject& s : *all) declare_of_user(s);
  }
}

namespace {
Measure the_measure;
bool promises_of_others_count = true;
std::optional<ReportedConventions> as_reported;
}  // namespace

const Measure& measure() { return the_measure; }
void set_measure(const Measure& m) { the_measure = m; }
void count_promises_of_others(bool count) { promises_of_others_count = count; }

void declare_as_reported(std::optional<ReportedConventions> reported) { as_reported = std::move(reported); }

std::vector<Declaration> Subject::declared_for(std::string_view query) const {
  if (!as_reported || as_reported->subject != name || as_reported->query != query) return offering(query).declared;
  Offering reported;
  reported.declare(as_reported->declared);
  for (const UsersDeclaration& u : users_declarations()) {
    if (u.is_about(*this, query)) reported.declare({u.declaration});
  }
  return reported.declared;
}

Standard Subject::standard_for(std::string_view query) const {
  const Offering& offer = offering(query);
  Conventions declared;
  for (const Declaration& d : declared_for(query)) declared.add(d.convention);
  const bool counts = !the_measure.for_all && (own || promises_of_others_count);
  if (counts && !promises_nothing(offer.contract)) return {offer.contract, true, offer.required, declared};
  const double epsilons = the_measure.error / unit_roundoff(scalar);
  return {{.backward = epsilons, .unit = epsilons}, false, offer.required, declared};
}

const Subject* find_subject(std::string_view name) {
  const std::vector<std::string> wanted{std::string(name)};
  const std::vector<const Subject*> found = subjects_named(wanted);
  return found.empty() ? nullptr : found.front();
}

bool is_subject(std::string_view name) { return contains(subject_names(), name) || contains(names_of_engines(), name); }

}  // namespace nearmiss
