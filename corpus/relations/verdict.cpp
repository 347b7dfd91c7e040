#include "corpus/relations/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

/// The largest number with this role; 0 without one.
double largest_of(const Case& c, Role role) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == role) largest = std::max(largest, std::abs(c.values[i]));
  }
  return largest;
}

/// How many times longer or slower the follow-up is; at least 1.
double times_larger(double own, double follow_up) { return own > 0 && follow_up > own ? follow_up / own : 1; }

/// A scene states what it requires of its own cases, in lengths and times. Of a follow-up that is larger or slower, as
/// much more is tolerated. Empty without a scene.
std::optional<SceneLimits> limits_for(const Case& own, const Case& follow_up) {
  if (scene_limits() == nullptr) return std::nullopt;
  SceneLimits wider = *scene_limits();
  const double longer = times_larger(largest_length(own), largest_length(follow_up));
  const double slower = times_larger(largest_of(follow_up, Role::velocity), largest_of(own, Role::velocity));
  wider.error *= longer, wider.missed_depth *= longer;
  if (wider.time) *wider.time *= longer * slower;
  return wider;
}

bool proves_wrong(const Finding& f) { return f.is_proved() || f.verdict == Verdict::broke; }

std::string broken_promise_text(const RelationFinding& r, const Subject& subject, const FollowUps& follow_ups,
                                bool bit_for_bit, Breach& breach) {
  bool exact = true, near = true;
  breach = Breach::contract;
  for (std::size_t i = 0; i < r.cases.size(); ++i) {
    if (r.findings[i].verdict == Verdict::broke) {
      breach = Breach::broke;
      return fmt::format("no answer {}: {}", i + 1, r.findings[i].clause);
    }
    if (proves_wrong(r.findings[i])) {
      return fmt::format("answer {}: {}, {}", i + 1, name_of(r.findings[i].disagreement), r.findings[i].clause);
    }
    const collide::Contract contract = subject.standard_for(r.cases[i].query->name).contract;
    exact = exact && contract.exact_decisions && r.findings[i].verdict != Verdict::out_of_domain;
    near = near && contract.forward <= metamorphic::ulps_of_slack;
  }
  if (r.agreement == Agreement::decisions_differ && exact && follow_ups.decisions_alone) {
    return "decisions that are promised to be exact differ";
  }
  if (r.agreement == Agreement::numbers_differ && exact && near && !follow_ups.image) {
    return "numbers differ by more than promised";
  }
  breach = Breach::bits;
  if (bit_for_bit && r.relation->bitwise && r.agreement != Agreement::same) {
    return "the change commutes with every rounded operation, and yet answers differ";
  }
  breach = Breach::none;
  return {};
}

/// A contract without any bounds: only the truth counts.
constexpr collide::Contract no_promise{};

/// One of the decisions is wrong: the judge tells which one, whatever the contract.
bool some_decision_is_wrong(const RelationFinding& r) {
  for (std::size_t i = 0; i < r.cases.size(); ++i) {
    if (confirmed(r.cases[i], r.answers[i], no_promise, Detail::verdict).truth_yes != r.answers[i].yes) return true;
  }
  return false;
}

/// The findings on a case and on its image must not contradict each other.
std::string oracle_error_text(const RelationFinding& r, const Subject& subject, const FollowUps& follow_ups) {
  if (!follow_ups.image) return {};
  if (r.findings[0].verdict == Verdict::out_of_domain || r.findings[1].verdict == Verdict::out_of_domain) return {};
  if (r.findings[0].verdict == Verdict::broke) return {};
  if (r.findings[1].verdict == Verdict::broke) return {};
  if (r.findings[0].truth_yes != r.findings[1].truth_yes) return "the exact decisions differ";
  const collide::Contract contract = subject.standard_for(r.cases[1].query->name).contract;
  const collide::Contract own = subject.standard_for(r.cases[0].query->name).contract;
  if (!follow_ups.image_keeps_ulps || contract.backward < own.backward || contract.forward < own.forward) return {};
  if (r.findings[0].verdict != Verdict::agrees) return {};  // an answer that is not proved wrong need not be right
  const Finding image = confirmed(r.cases[1], follow_ups.image(r.answers[0]), contract, Detail::verdict);
  if (proves_wrong(image)) {
    return fmt::format("an answer is right, but its image is wrong: {}, {}", name_of(image.disagreement), image.clause);
  }
  return {};
}

}  // namespace

std::string_view name_of(Breach b) {
  switch (b) {
    case Breach::none: return "none";
    case Breach::contradiction: return "contradiction";
    case Breach::bits: return "bits";
    case Breach::contract: return "contract";
    case Breach::broke: return "broke";
  }
  return "?";
}

bool claims_same_bits(const Subject& subject) {
  return subject.own && std::none_of(subject.offerings.begin(), subject.offerings.end(),
                                     [](const Offering& o) { return o.contract.exact_decisions; });
}

bool offers_all(const Subject& subject, const FollowUps& follow_ups) {
  return std::all_of(follow_ups.cases.begin(), follow_ups.cases.end(),
                     [&](const Case& c) { return !(subject.offering(c.query->name).answer == nullptr); });
}

bool may_be_asked_all(const Subject& subject, const FollowUps& follow_ups) {
  return std::all_of(follow_ups.cases.begin(), follow_ups.cases.end(),
                     [&](const Case& c) { return unmet_by(c, subject.offering(c.query->name).required).empty(); });
}

RelationFinding relate(const Relation& relation, const FollowUps& follow_ups, const Case& question,
                       std::vector<Answer> answers, const Subject& subject, bool bit_for_bit) {
  RelationFinding r;
  r.relation = &relation;
  r.cases.push_back(question);
  r.cases.insert(r.cases.end(), follow_ups.cases.begin(), follow_ups.cases.end());
  r.answers = std::move(answers);
  r.agreement = follow_ups.compare(r.answers[0], std::span(r.answers).subspan(1));
  const bool some_broke = std::any_of(r.answers.begin(), r.answers.end(),
                                      [](const Answer& a) { return a.status == Answer::Status::broke; });
  if (r.agreement == Agreement::same && !some_broke) return r;
  for (std::size_t i = 0; i < r.cases.size(); ++i) {
    const Standard standard = subject.standard_for(r.cases[i].query->name);
    const std::optional<SceneLimits> limits = limits_for(question, r.cases[i]);
    r.findings.push_back(
        confirmed(r.cases[i], r.answers[i], standard, Detail::verdict, {}, limits ? &*limits : nullptr));
  }
  r.broken = broken_promise_text(r, subject, follow_ups, bit_for_bit, r.breach);
  r.oracle = oracle_error_text(r, subject, follow_ups);
  if (r.breach != Breach::none || r.agreement != Agreement::decisions_differ) return r;
  if (some_decision_is_wrong(r)) {
    r.breach = Breach::contradiction;
  } else if (follow_ups.decisions_alone) {
    r.oracle = "decisions contradict each other, and the judge finds none of them wrong";
  }
  return r;
}

std::optional<RelationFinding> examine(const Relation& relation, const Case& question, std::uint64_t seed,
                                       const Subject& subject, const Ask& ask, bool bit_for_bit) {
  const auto follow_ups = relation.of(question, seed);
  if (!follow_ups || !offers_all(subject, *follow_ups)) return std::nullopt;
  const Offering& own = subject.offering(question.query->name);
  if (own.answer == nullptr || !unmet_by(question, own.required).empty()) return std::nullopt;
  if (!may_be_asked_all(subject, *follow_ups)) return std::nullopt;
  std::vector<Answer> answers{ask(question)};
  for (const Case& c : follow_ups->cases) answers.push_back(ask(c));
  return relate(relation, *follow_ups, question, std::move(answers), subject, bit_for_bit);
}

}  // namespace nearmiss
