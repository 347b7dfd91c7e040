#include "reports/triage/trials.hpp"

#include <algorithm>
#include <cmath>

#include "corpus/case_builder.hpp"
#include "corpus/float_order.hpp"
#include "oracles/confirmed.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/findings/hash.hpp"

namespace nearmiss {

namespace {

bool may_move(Role role) { return role != Role::flag && role != Role::index; }

bool is_valid(const Case& c) {
  return std::all_of(c.values.begin(), c.values.end(),
                     [&](double x) { return std::isfinite(x) && representable(x, c.scalar); }) &&
         !c.query->broken(c.values);
}

/// `count` cases in which `change` replaces half of the numbers that may move.
template <class Change>
std::vector<Case> changed(const Case& c, std::size_t count, std::uint64_t seed, const Change& change) {
  Random random(seed);
  std::vector<Case> cases(count, c);
  for (Case& other : cases) {
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const bool moves = may_move(c.query->inputs[i].role) && c.values[i] != 0 && random.one_in(2);
      if (moves) other.values[i] = change(c.values[i], random);
    }
  }
  return cases;
}

/// Cases in which one size or one vector is multiplied by a power of two.
std::vector<Case> with_one_part_scaled(const Case& c) {
  std::vector<Case> cases;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Field& f = c.query->inputs[i];
    const bool is_vector = f.name.ends_with(".x") && f.role != Role::rotation && f.role != Role::size;
    if (!is_vector && f.role != Role::size) continue;
    for (const int k : {-4, -2, 2, 4}) {
      Case other = c;
      for (std::size_t n = i; n < i + (is_vector ? 3 : 1); ++n) other.values[n] = std::ldexp(c.values[n], k);
      cases.push_back(std::move(other));
    }
  }
  return cases;
}

}  // namespace

Trials::Trials(const Case& question, const Subject& subject, const CauseLimits& limits, Workers& workers)
    : subject_(subject), workers_(workers), limits_(limits) {
  base_.question = question;
  if (limits_.questions == 0) return;
  base_.answer = workers_.ask(subject_, question);
  ++questions_;
  for (const Detail detail : {Detail::verdict, Detail::full}) {
    detail_ = detail;
    base_.finding = judged(question, base_.answer);
    signature_ = signature_of(base_.finding);
    base_.outcome = outcome_of(base_.finding);
    if (is_bad(base_.finding)) return;
  }
}

Finding Trials::judged(const Case& c, const Answer& answer) const {
  return confirmed(c, answer, subject_.standard_for(c.query->name), detail_);
}

bool Trials::is_right(const Case& c, const Answer& answer) const {
  const Verdict v = judged(c, answer).verdict;
  return v == Verdict::agrees || v == Verdict::not_proved;
}

Outcome Trials::outcome_of(const Finding& f) const {
  if (is_bad(f)) return signature_of(f) == signature_ ? Outcome::same : Outcome::other;
  return f.verdict == Verdict::agrees || f.verdict == Verdict::not_proved ? Outcome::right : Outcome::none;
}

bool Trials::is_over() const {
  return interrupted() || questions_ >= limits_.questions || Clock::now() - begin_ >= limits_.time;
}

std::vector<Trial> Trials::ask(std::span<const Case> cases, Rounding rounding) {
  std::vector<Trial> trials(cases.size());
  std::vector<Case> valid;
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    trials[i].question = cases[i];
    if (questions_ + valid.size() >= limits_.questions || !is_valid(cases[i])) continue;
    valid.push_back(cases[i]);
    at.push_back(i);
  }
  const std::size_t most = Workers::capacity_for(query());
  for (std::size_t first = 0; first < valid.size() && !is_over(); first += most) {
    const std::span<const Case> batch = std::span(valid).subspan(first, std::min(most, valid.size() - first));
    workers_.send(subject_, batch, rounding);
    const std::span<const Answer> answers = workers_.receive(subject_);
    questions_ += batch.size();
    for (std::size_t k = 0; k < answers.size() && !is_over(); ++k) {
      Trial& t = trials[at[first + k]];
      t.answer = answers[k];
      t.raised = workers_.raised(subject_, k);
      t.finding = judged(t.question, t.answer);
      t.outcome = outcome_of(t.finding);
    }
  }
  return trials;
}

std::size_t count(std::span<const Trial> trials, Outcome outcome) {
  return std::size_t(std::count_if(trials.begin(), trials.end(), [&](const Trial& t) { return t.outcome == outcome; }));
}

std::vector<Case> ulp_neighbours(const Case& c, std::size_t count, int ulps, std::uint64_t seed) {
  return changed(c, count, seed,
                 [&](double x, Random& random) { return moved_by_ulps(x, random.between(-ulps, ulps), c.scalar); });
}

std::vector<Case> relative_neighbours(const Case& c, std::size_t count, int order, std::uint64_t seed) {
  return changed(c, count, seed, [&](double x, Random& random) {
    return rounded_to(c.scalar, x * (1 + std::ldexp(random.uniform(-1, 1), -order)));
  });
}

std::vector<Trial> variants(Trials& trials, std::size_t most, std::uint64_t seed) {
  const Case& c = trials.base().question;
  const int digits = c.scalar == Scalar::float32 ? 24 : 53;
  constexpr std::size_t of_each_order = 8;
  std::vector<Case> cases = with_one_part_scaled(c);
  for (int order = 1; order < digits; order += c.scalar == Scalar::float32 ? 1 : 2) {
    const auto some = relative_neighbours(c, of_each_order, order, seed + std::uint64_t(order));
    cases.insert(cases.end(), some.begin(), some.end());
  }
  std::vector<Trial> all = trials.ask(cases), found;
  std::erase_if(all, [&](const Trial& t) { return t.outcome != Outcome::same || t.question.values == c.values; });
  const std::size_t number = std::min(most, all.size());
  for (std::size_t i = 0; i < number; ++i) found.push_back(std::move(all[i * all.size() / number]));
  return found;
}

std::uint64_t seed_of(const Case& c) {
  Fnv1a fnv;
  fnv.add(c);
  return fnv.value();
}

}  // namespace nearmiss
