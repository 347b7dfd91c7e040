#include "reports/trade/errors.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss {

namespace {

/// Adds the forward error of one number of the answer, in the number's unit.
void add_forward(TradeAnswer& a, Role role, double absolute, double of_unit) {
  if (is_length(role)) a.distance = std::max(a.distance, absolute / of_unit);
  if (role == Role::time) a.time = std::max(a.time, absolute);
}

bool is_flag(const Query& query, int member) {
  return member >= 0 && query.layout.parts[std::size_t(member)].role == Role::flag;
}

/// Whether the finding has a wrong flag just before this member.
bool follows_wrong_flag(const Query& query, const Finding& f, int member) {
  return is_flag(query, member - 1) && std::any_of(f.members.begin(), f.members.end(),
                                                   [&](const MemberFinding& m) { return m.member == member - 1; });
}

/// The forward errors. A wrong flag of a corner says that a contact is there, or is not: the place beside the flag has
/// no distance to a right place then. As for a wrong decision, the backward errors of the flag and of the place count;
/// each epsilon is `epsilon_length` long.
void add_forward_errors(TradeAnswer& a, const Query& query, const Finding& f, double of_unit, double epsilon_length) {
  a.ulps = f.forward_ulps;
  for (const MemberFinding& m : f.members) {
    if (m.member < 0) continue;
    const bool is_of_flag = is_flag(query, m.member) || follows_wrong_flag(query, f, m.member);
    if (is_of_flag && m.backward) {
      a.distance = std::max(a.distance, m.backward->above * epsilon_length);
    } else {
      add_forward(a, query.layout.parts[std::size_t(m.member)].role, m.forward_absolute, of_unit);
    }
  }
  if (f.members.empty() && f.worst >= 0)
    add_forward(a, query.outputs[std::size_t(f.worst)].role, f.forward_absolute, of_unit);
}

TradeAnswer::State state_of(const Finding& f) {
  switch (f.verdict) {
    case Verdict::not_asked: return TradeAnswer::State::not_asked;
    case Verdict::cannot_answer: return TradeAnswer::State::no_answer;
    case Verdict::broke: return TradeAnswer::State::broke;
    default: return TradeAnswer::State::compared;
  }
}

}  // namespace

TradeTolerance relative_tolerance(double error, const std::string& source) {
  TradeTolerance t;
  t.error = t.missed_depth = error;
  t.source = source;
  return t;
}

Case asked_case(const Case& question, Scalar scalar) {
  Case c = question;
  if (scalar == Scalar::float64) return c;
  c.scalar = scalar;
  for (double& x : c.values) x = double(float(x));
  return c;
}

Case judged_case(const Case& question, Scalar scalar) {
  Case c = question;
  if (scalar == Scalar::float64) c.scalar = scalar;
  return c;
}

Standard unbounded_standard(Conventions declared) { return {collide::Contract{}, true, {}, declared}; }

Preconditions all_required(std::span<const Subject* const> subjects, const Query& query) {
  Preconditions all;
  for (const Precondition p : all_preconditions) {
    if (std::any_of(subjects.begin(), subjects.end(),
                    [&](const Subject* s) { return s->offering(query.name).required.has(p); }))
      all.add(p);
  }
  return all;
}

TradeAnswer trade_answer(const Case& question, Scalar scalar, const Answer& answer, const Finding& f,
                         const TradeTolerance& tolerance) {
  TradeAnswer a;
  a.state = state_of(f);
  if (a.state != TradeAnswer::State::compared) return a;
  a.truth_yes = f.truth_yes;
  a.yes = answer.yes;
  a.missed = f.has(Disagreement::false_miss);
  a.phantom = f.has(Disagreement::false_hit);
  a.not_finite = f.has(Disagreement::not_finite);
  const double length = largest_length(question), epsilon = unit_roundoff(question.scalar);
  const double of_backward = tolerance.unit.empty() ? 1 : length;
  if (f.backward) a.backward = f.backward->above * epsilon;
  a.shift = a.backward * of_backward;
  if (a.missed || a.phantom) return a;
  const double of_unit = tolerance.unit.empty() && length > 0 ? length : 1;
  add_forward_errors(a, *question.query, f, of_unit, epsilon * of_backward);
  a.ulps *= epsilon / unit_roundoff(scalar);
  return a;
}

bool is_beyond(const TradeAnswer& a, const TradeTolerance& tolerance) {
  if (a.state == TradeAnswer::State::broke || a.not_finite) return true;
  if (a.state != TradeAnswer::State::compared) return false;
  if (a.missed) return a.shift > tolerance.missed_depth;
  if (a.phantom || tolerance.unit.empty()) return a.shift > tolerance.error;
  return a.distance > tolerance.error || (tolerance.time && a.time > *tolerance.time);
}

}  // namespace nearmiss
