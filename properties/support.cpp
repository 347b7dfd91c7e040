#include "properties/support.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "corpus/generator/fit.hpp"
#include "corpus/search/shrink.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/provenance.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/pretty_json.hpp"

namespace nearmiss {

std::ostream& operator<<(std::ostream& out, const Pairing& p) {
  std::string subject = p.subject->name;
  std::replace(subject.begin(), subject.end(), '-', '_');
  return out << p.query->name << "__" << subject;
}
std::ostream& operator<<(std::ostream& out, const NamedQuery& q) { return out << q.query->name; }

namespace {

/// Our own subjects, plugins, and those in the environment variable NEARMISS_SUBJECTS, separated by commas.
bool is_held_to_its_word(const Subject& s) {
  const char* value = std::getenv("NEARMISS_SUBJECTS");
  const std::string names = fmt::format(",{},", value == nullptr ? "" : value);
  const auto named = [&](const std::string& name) {
    return names.find(fmt::format(",{},", name)) != std::string::npos;
  };
  const std::vector<std::string> added = added_subjects();
  return s.own || !s.plugin.empty() || named(s.name) ||
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

std::vector<Pairing> certified_pairings() {
  std::vector<Pairing> certified = our_pairings();
  std::erase_if(certified, [](const Pairing& p) {
    return !p.subject->own || !promises_every_digit(p.subject->offering(p.query->name).contract);
  });
  return certified;
}

std::vector<NamedQuery> every_query() {
  std::vector<NamedQuery> all;
  for (const Query& q : catalogue()) all.push_back({&q});
  return all;
}

Finding examined(const Case& question, const Subject& subject) {
  return confirmed(question, ask_here(subject, question), subject.standard_for(question.query->name), Detail::verdict);
}

namespace {

/// Writes the report where nightly runs look for it, and returns the command that replays it.
template <class AnyReport>
std::string left_behind(AnyReport report, const Subject& subject, const Query& query, std::string_view fault) {
  const std::filesystem::path file =
      runs_folder() / "properties" / query.name / fmt::format("{}-{}-{}.json", subject.name, fault, id_of(report));
  report.replay = replay_command(subject, file.string());
  try {
    std::filesystem::create_directories(file.parent_path());
    write_file(file, pretty_json(report_to_json(report)));
  } catch (const std::exception& e) {
    return fmt::format("report:  none is left, for {}", e.what());
  }
  return fmt::format("report:  {}\nreplay:  {}", file.string(), report.replay);
}

std::string seed_text(const Case& c, const Subject& s) {
  if (c.origin != "generator") return fmt::format("from:    {}, seed {}, index {}", c.origin, c.seed, c.index);
  return fmt::format("seed:    {}, index {}\nrun:     nearmiss run --query {} --subject {} --seed {} --cases {}",
                     c.seed, c.index, c.query->name, s.name, c.seed, c.index + 1);
}

}  // namespace

std::string failure_text(const Case& question, const Subject& subject,
                         const std::function<std::string(const Case&)>& failure_of) {
  const std::string first = failure_of(question);
  const Case shrunk = shrink(
      question, [&](const Case& c) { return !failure_of(c).empty(); }, 4000);
  Workers workers;
  const Answer answer = ask_here(subject, shrunk);
  const Report report = examine(shrunk, subject, answer, workers);
  return fmt::format("{} {}: {}\n{}\n{}\nshrunk ({}):\n{}\n{}", question.query->name, subject.name, first,
                     seed_text(question, subject),
                     left_behind(report, subject, *shrunk.query, fault_of(report.finding)), failure_of(shrunk),
                     case_to_json(shrunk).dump(2), case_to_cpp(shrunk));
}

std::string failure_text(const Case& question, const Subject& subject) {
  const Disagreement first = examined(question, subject).disagreement;
  return failure_text(question, subject, [&](const Case& c) -> std::string {
    const Finding f = examined(c, subject);
    if (!is_violation(f) || f.disagreement != first) return {};
    return fmt::format("{} ({}), backward error above {} epsilon", name_of(f.disagreement), f.clause,
                       f.backward ? f.backward->above : -1);
  });
}

namespace {

/// A bitwise claim concerns our own tiers only: they use no epsilon.
std::optional<RelationFinding> examined_here(const Relation& r, const Case& c, std::uint64_t seed, const Subject& s) {
  return examine(
      r, c, seed, s, [&](const Case& asked) { return ask_here(s, asked); }, claims_same_bits(s));
}

bool breaks(const std::optional<RelationFinding>& f) { return f && !(f->broken.empty() && f->oracle.empty()); }

}  // namespace

std::string failure_text(const Relation& relation, const Case& question, std::uint64_t seed, const Subject& subject) {
  const Case shrunk = shrink(
      question, [&](const Case& c) { return breaks(examined_here(relation, c, seed, subject)); }, 2000);
  const RelationFinding found = *examined_here(relation, shrunk, seed, subject);
  Workers workers;
  const RelationReport report = report_of({&relation, seed, claims_same_bits(subject)}, found, subject, workers);
  std::string text = fmt::format(
      "{}\n{}\n{}\n{}\nshrunk:", headline(report), explanation(report), seed_text(question, subject),
      left_behind(report, subject, *question.query, fmt::format("{}-{}", relation.name, breach_of(report))));
  for (std::size_t i = 0; i < found.cases.size(); ++i) {
    text += fmt::format("\ncase {}:\n{}\n{}", i + 1, case_to_json(found.cases[i]).dump(2), case_to_cpp(found.cases[i]));
  }
  return text;
}

int cases_per_family() {
  const char* value = std::getenv("NEARMISS_FAMILY_CASES");
  return value != nullptr ? std::stoi(value) : 250;
}

int cost_of(const Query& query) {
  constexpr std::string_view operation = "_signed_distance";
  if (!query.name.ends_with(operation)) return 1;
  const std::string_view shapes = query.name.substr(0, query.name.size() - operation.size());
  const auto vertices = [](std::string_view shape) {
    return shape == "box" ? 8 : shape == "triangle" ? 3 : shape == "segment" || shape == "capsule" ? 2 : 1;
  };
  const std::size_t between = shapes.find('_');
  const int of_first = vertices(shapes.substr(0, between)), of_second = vertices(shapes.substr(between + 1));
  return of_second < 3 ? 1 : of_first * of_second;
}

std::uint64_t stream(std::uint64_t usual) {
  const char* seed = std::getenv("NEARMISS_SEED");
  return seed == nullptr ? usual : std::strtoull(seed, nullptr, 10) + usual;
}

std::string failure_of_agreement(const Query& query, const Subject& subject, std::uint64_t stream,
                                 std::uint64_t cases) {
  Case c;
  for (std::uint64_t i = 0; i < cases; ++i) {
    generate_inside(c, query, subject.scalar, stream, i, subject.offering(query.name).required);
    if (is_violation(examined(c, subject))) return failure_text(c, subject);
  }
  return {};
}

std::string failure_of_relations(const Query& query, const Subject& subject, std::uint64_t stream,
                                 std::uint64_t cases) {
  Case c;
  for (std::uint64_t i = 0; i < cases; ++i) {
    generate_inside(c, query, subject.scalar, stream, i, subject.offering(query.name).required);
    for (const Relation& r : relations()) {
      if (breaks(examined_here(r, c, i, subject))) return failure_text(r, c, i, subject);
    }
  }
  return {};
}

bool truth_is_yes(const Case& question) {
  const Answer none{};
  const std::vector<double> still(question.values.size(), 0.0);
  const Oracle& oracle = oracle_of(*question.query);
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
