#include "reports/findings/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "oracles/confirmed.hpp"
#include "reports/findings/hash.hpp"

namespace nearmiss {

namespace {

/// The power of two that brings the largest position or size of the case to [1, 2); empty where all are zero or the
/// factor is 1. Lengths, speeds and plane offsets are scaled, so times do not change.
std::optional<double> to_unit_scale(const Case& c) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    if (role == Role::position || role == Role::size) largest = std::max(largest, std::abs(c.values[i]));
  }
  if (!(largest > 0) || std::ilogb(largest) == 0) return std::nullopt;
  return std::ldexp(1.0, -std::ilogb(largest));
}

std::optional<Case> scaled(const Case& question, double factor) {
  Case c = question;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    const bool scales = role == Role::position || role == Role::size || role == Role::velocity || role == Role::offset;
    if (!scales) continue;
    c.values[i] *= factor;
    if (c.values[i] / factor != question.values[i] || !representable(c.values[i], c.scalar)) return std::nullopt;
  }
  return c;
}

/// Converts the answer to a scaled case to an answer to the original case.
Answer scaled_back(const Query& query, Answer a, double factor) {
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    const Role role = query.outputs[i].role;
    if (is_length(role)) a.values[i] /= factor;
  }
  return a;
}

/// The opinions of every referee, other than the subject, that offers the query and can hold the case's numbers. Each
/// gets the case itself and, because its tolerances are lengths, once more at unit scale.
std::vector<Opinion> second_opinions(const Case& question, const Subject& subject, Workers& workers) {
  std::vector<Opinion> opinions;
  for (const Subject* referee : referees()) {
    if (referee->name == subject.name) continue;
    const Offering& offering = referee->offering(question.query->name);
    if (offering.answer == nullptr) continue;
    const std::optional<Case> same = in_scalar(question, referee->scalar);
    if (!same) continue;
    const Standard asked{{}, true, offering.required};
    const Answer answer = workers.ask(*referee, *same);
    opinions.push_back({referee->name, referee->version, answer, judge(*same, answer, asked, Detail::full)});
    const std::optional<double> factor = to_unit_scale(*same);
    const std::optional<Case> unit = factor ? scaled(*same, *factor) : std::nullopt;
    if (!unit) continue;
    const Answer again = scaled_back(*same->query, workers.ask(*referee, *unit), *factor);
    opinions.push_back(
        {referee->name + " at unit scale", referee->version, again, judge(*same, again, asked, Detail::full)});
  }
  return opinions;
}

}  // namespace

Report examine(const Case& question, const Subject& subject, Workers& workers) {
  return examine(question, subject, workers.ask(subject, question), workers);
}

Report examine(const Case& question, const Subject& subject, const Answer& answer, Workers& workers) {
  Report r;
  r.question = question;
  r.subject = subject.name;
  r.version = subject.version;
  r.answer = answer;
  r.standard = subject.standard_for(question.query->name);
  r.declared = subject.declared_for(question.query->name);
  if (!r.standard.promised && scene_limits() != nullptr) r.scene = *scene_limits();
  r.finding = confirmed(question, answer, r.standard, Detail::full);
  r.truth = truth_of(question, r.standard.declared);
  r.referees = second_opinions(question, subject, workers);
  r.static_checks = static_checks(question, answer, r.truth, workers);
  return r;
}

bool is_bad(const Finding& f) { return f.is_proved() || f.verdict == Verdict::broke; }

std::string fault_of(const Finding& f) {
  std::string fault(f.verdict == Verdict::broke ? name_of(f.verdict) : name_of(f.disagreement));
  std::replace(fault.begin(), fault.end(), ' ', '-');
  return fault;
}

std::string id_of(const Report& r) {
  Fnv1a fnv;
  fnv.add(r.question.query->name);
  fnv.add(r.subject);
  fnv.add(fault_of(r.finding));
  for (const double x : r.question.values) fnv.add(x);
  return fnv.id();
}

bool is_part(const Query& query, const Answer& answer, std::size_t output) {
  if (answer.status != Answer::Status::answered || !answer.gives(output)) return false;
  if (answer.yes) return true;
  const Role role = query.outputs[output].role;
  return role == Role::depth || role == Role::flag || role == Role::index;
}

}  // namespace nearmiss
