#include "properties/support.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "corpus/codec.hpp"
#include "corpus/shrink.hpp"
#include "impl/subject/added.hpp"

namespace nearmiss {

std::ostream& operator<<(std::ostream& out, const Pairing& p) {
  std::string subject = p.subject->name;
  std::replace(subject.begin(), subject.end(), '-', '_');
  return out << p.query->name << "__" << subject;
}
std::ostream& operator<<(std::ostream& out, const NamedQuery& q) { return out << q.query->name; }

namespace {

/// Our own subjects, plugins, and those that the environment variable NEARMISS_SUBJECTS names, separated by commas.
bool is_held_to_its_word(const Subject& s) {
  const char* told = std::getenv("NEARMISS_SUBJECTS");
  const std::string names = fmt::format(",{},", told == nullptr ? "" : told);
  const auto named = [&](const std::string& name) { return names.find(fmt::format(",{},", name)) != std::string::npos; };
  const std::vector<std::string> added = added_subjects();
  return s.name.starts_with("collide-") || !s.plugin.empty() || named(s.name) ||
         (named("added") && std::find(added.begin(), added.end(), s.name) != added.end());
}

}  // namespace

std::vector<Pairing> our_pairings() {
  std::vector<Pairing> all;
  for (const Query& q : catalogue()) {
    for (const Subject& s : subjects()) {
      if (is_held_to_its_word(s) && s.offering(q.name).offer != Offer::not_offered) all.push_back({&q, &s});
    }
  }
  return all;
}

std::vector<NamedQuery> every_query() {
  std::vector<NamedQuery> all;
  for (const Query& q : catalogue()) all.push_back({&q});
  return all;
}

Finding examined(const Case& question, const Subject& subject) {
  const Offering& offering = subject.offering(question.query->name);
  return judge(question, offering.answer(question.values), offering.contract, Detail::verdict);
}

std::string told(const Case& question, const Subject& subject) {
  const Finding first = examined(question, subject);
  const Case shrunk = shrink(question, [&](const Case& c) {
    const Finding f = examined(c, subject);
    return is_violation(f) && f.disagreement == first.disagreement;
  });
  const Finding last = examined(shrunk, subject);
  return fmt::format(
      "{} {}: {} ({}), backward error above {} epsilon\n"
      "replay:  nearmiss run --query {} --subject {} --seed {} --cases {}\n"
      "shrunk ({}, {}, backward error above {} epsilon):\n{}\n{}",
      question.query->name, subject.name, name_of(first.disagreement), first.clause,
      first.backward ? first.backward->above : -1, question.query->name, subject.name, question.seed,
      question.index + 1, name_of(last.disagreement), last.clause, last.backward ? last.backward->above : -1,
      case_to_json(shrunk).dump(2), case_to_cpp(shrunk));
}

bool truth_is_yes(const Case& question) {
  const Answer none{};
  const std::vector<double> still(question.values.size(), 0.0);
  const Oracle& oracle = question.query->oracle;
  Enclosure e = oracle.interval(question.values, still, none, question.scalar);
  if (!e.decided()) e = oracle.exact(question.values, none, question.scalar, nullptr);
  return e.may_be_yes;
}

bool holds_for_streams(const std::string& sentence, const std::function<std::string(std::uint64_t)>& failure_of) {
  return rc::check(sentence, [&] {
    const auto stream = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::uint32_t>(0, 1'000'000'000));
    const std::string failure = failure_of(stream);
    if (!failure.empty()) RC_FAIL(failure);
  });
}

}  // namespace nearmiss
