#include "reports/triage/trials/trials.hpp"

#include <algorithm>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/search/float_order.hpp"
#include "oracles/confirmed.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/findings/hash.hpp"

namespace nearmiss {

namespace {

bool may_move(Role role) { return !is_discrete(role); }

/// Cases in which each part, at random, is as it is or multiplied by a power of two.
std::vector<Case> with_parts_scaled(const Case& c, std::size_t count, std::uint64_t seed) {
  constexpr int orders = 4;
  Random random(seed);
  std::vector<Case> cases(count, c);
  for (Case& other : cases) {
    for (const InputMember& m : c.operands().members) {  // each size by itself, and vectors as wholes
      if (m.role != Role::size && (!m.is_vector() || m.role == Role::rotation)) continue;
      double factor = 1;
      for (std::size_t i = m.begin; i < m.begin + m.count; ++i) {
        const bool is_of_its_own = i == m.begin || m.role == Role::size;
        if (is_of_its_own) factor = random.one_in(2) ? random.power_of_two(-orders, orders) : 1.0;
        other.values[i] = rounded_to(c.scalar, c.values[i] * factor);
      }
    }
  }
  return cases;
}

/// Moves at most `most` other cases with the finding to the end of `found`.
void take_same(std::vector<Trial>& from, const Case& c, std::size_t most, std::vector<Trial>& found) {
  for (Trial& t : from) {
    if (most == 0) return;
    if (t.outcome != Outcome::same || t.question.values == c.values) continue;
    found.push_back(std::move(t));
    --most;
  }
}

}  // namespace

bool is_valid(const Case& c) {
  return std::all_of(c.values.begin(), c.values.end(),
                     [&](double x) { return std::isfinite(x) && representable(x, c.scalar); }) &&
         !c.query->broken(c.values);
}

Trials::Trials(const Case& question, const Subject& subject, const CauseLimits& limits, Workers& workers)
    : subject_(subject), workers_(workers), limits_(limits) {
  base_.question = question;
  if (limits_.questions == 0) return;
  base_.answer = workers_.ask(subject_, question);
  ++questions_;
  for (const Detail detail : {Detail::verdict, Detail::full}) {
    detail_ = detail;
    base_.finding = judged(question, base_.answer);
    kind_ = kind_key_of(base_.finding);
    base_.outcome = outcome_of(base_.finding);
    if (is_bad(base_.finding)) return;
  }
}

/// What a scene requires is a length: of a scaled case it would require something else. A trial is judged by the share
/// of the lengths of the base case that it is.
Standard Trials::standard_for(const Query& q) const {
  Standard s = subject_.standard_for(q.name);
  const double length = largest_length(base_.question);
  if (s.promised || scene_limits() == nullptr || !(length > 0)) return s;
  const double epsilons = scene_limits()->error / length / unit_roundoff(base_.question.scalar);
  s.contract.backward = std::min(s.contract.backward, epsilons);
  return s;
}

Finding Trials::judged(const Case& c, const Answer& answer) const {
  return confirmed(c, answer, standard_for(*c.query), detail_, {}, nullptr);
}

Finding Trials::in_full(const Trial& t) const {
  return confirmed(t.question, t.answer, standard_for(query()), Detail::full, {}, nullptr);
}

bool Trials::is_right(const Case& c, const Answer& answer) const {
  const Verdict v = judged(c, answer).verdict;
  return v == Verdict::agrees || v == Verdict::not_proved;
}

Outcome Trials::outcome_of(const Finding& f) const {
  if (is_bad(f)) return kind_key_of(f) == kind_ ? Outcome::same : Outcome::other;
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

std::size_t count_answered(std::span<const Trial> trials) { return trials.size() - count(trials, Outcome::none); }

std::vector<Case> ulp_neighbours(const Case& c, std::size_t count, int ulps, std::uint64_t seed) {
  Random random(seed);
  std::vector<Case> cases(count, c);
  for (Case& other : cases) {
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (may_move(c.role(i)) && c.values[i] != 0)
        other.values[i] = moved_by_ulps(c.values[i], random.between(-ulps, ulps), c.scalar);
    }
  }
  return cases;
}

std::vector<Case> relative_neighbours(const Case& c, std::size_t count, int order, std::uint64_t seed) {
  Random random(seed);
  std::vector<Case> cases(count, c);
  for (Case& other : cases) {
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (may_move(c.role(i)) && random.one_in(2))
        other.values[i] = rounded_to(c.scalar, c.values[i] * (1 + std::ldexp(random.uniform(-1, 1), -order)));
    }
  }
  return cases;
}

std::vector<Case> with_moved_zeros(const Case& c, std::size_t count, int order, std::uint64_t seed) {
  const auto role = [&](std::size_t i) { return c.role(i); };
  std::vector<std::size_t> zeros;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (may_move(role(i)) && c.values[i] == 0) zeros.push_back(i);
  }
  if (zeros.empty()) return {};
  Random random(seed);
  std::vector<Case> cases(count, c);
  for (Case& other : cases) {
    for (const std::size_t i : zeros) {
      double largest = 0;
      for (std::size_t k = 0; k < c.values.size(); ++k) {
        if (role(k) == role(i)) largest = std::max(largest, std::abs(c.values[k]));
      }
      const bool stays_positive = role(i) == Role::size || role(i) == Role::time || role(i) == Role::weight;
      const double by = random.uniform(stays_positive ? 0 : -1, 1);
      if (random.one_in(2)) other.values[i] = rounded_to(c.scalar, std::ldexp(largest * by, -order));
    }
  }
  return cases;
}

std::vector<Trial> variants(Trials& trials, std::size_t most, std::uint64_t seed) {
  const Case& c = trials.base().question;
  const int digits = c.scalar == Scalar::float32 ? 24 : 53;
  constexpr std::size_t of_each_order = 8, mixed = 96;
  std::vector<Case> cases;
  for (int order = 0; order < digits; order += c.scalar == Scalar::float32 ? 1 : 2) {
    const auto some = relative_neighbours(c, of_each_order, order, seed + std::uint64_t(order));
    cases.insert(cases.end(), some.begin(), some.end());
  }
  std::vector<Trial> found, scaled = trials.ask(with_parts_scaled(c, mixed, seed)), near = trials.ask(cases);
  take_same(scaled, c, most / 2, found);
  take_same(near, c, most - found.size(), found);
  return found;
}

std::uint64_t seed_of(const Case& c) {
  Fnv1a fnv;
  fnv.add(c);
  return fnv.value();
}

}  // namespace nearmiss
