#include "reports/builds/builds.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "corpus/search/float_order.hpp"
#include "corpus/search/shrink.hpp"
#include "oracles/confirmed.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/schedule.hpp"
#include "reports/findings/report.hpp"
#include "reports/trade/errors.hpp"
#include "reports/triage/minimisation/fewer_regions.hpp"

namespace nearmiss {

namespace {

bool are_same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::optional<std::uint64_t> ulps_between(Scalar scalar, Role role, double a, double b) {
  if (is_discrete(role) || !std::isfinite(a) || !std::isfinite(b)) return std::nullopt;
  const std::int64_t at = order_of(scalar, a), other = order_of(scalar, b);
  return at < other ? std::uint64_t(other) - std::uint64_t(at) : std::uint64_t(at) - std::uint64_t(other);
}

/// By the measure where the contract does not cover the case.
Finding judged(const Case& question, const Answer& answer, const Subject& subject) {
  const Standard own = subject.standard_for(question.query->name);
  const Finding f = confirmed(question, answer, own, Detail::full);
  if (f.verdict != Verdict::out_of_domain) return f;
  const double epsilons = measure().error / unit_roundoff(subject.scalar);
  return confirmed(question, answer,
                   Standard({.backward = epsilons, .unit = epsilons}, false, own.required, own.declared), Detail::full);
}

bool is_outside(const Case& question, const Answer& answer, const Subject& subject) {
  return judge(question, answer, subject.standard_for(question.query->name), Detail::verdict).verdict ==
         Verdict::out_of_domain;
}

JudgedAnswer judged_answer(const Case& question, const Answer& answer, const Subject& subject) {
  JudgedAnswer j{answer, judged(question, answer, subject)};
  const bool decides_right = !decides(question.query->kind) || answer.yes == j.finding.truth_yes;
  j.is_right = answer.status == Answer::Status::answered && decides_right && !j.finding.is_proved();
  return j;
}

/// The comparisons of one query.
class ComparedQuery {
 public:
  ComparedQuery(const Query& query, const BuildsSettings& settings, std::span<const Subject* const> subjects,
                Dispatcher& dispatcher)
      : query_(query), settings_(settings), dispatcher_(dispatcher) {
    for (const Subject* s : subjects) {
      if (!(s->offering(query.name).answer == nullptr)) subjects_.push_back(s);
    }
    if (subjects_.size() < 2 || subjects_.front() != subjects.front()) {
      subjects_.clear();
      return;
    }
    for (const Subject* s : std::span(subjects_).subspan(1)) all_.push_back({&query, subjects_.front(), s});
  }

  std::vector<ComparedBuild> result() {
    if (subjects_.empty()) return {};
    Stream stream{&query_, subjects_.front()->scalar, all_required(subjects_, query_), subjects_, 0, 0, 0};
    std::vector<Case> cases;
    for (std::uint64_t left = settings_.cases; left > 0 && !interrupted(); left -= cases.size()) {
      settings_.tick(query_);
      generate_next(stream, settings_.seed, std::min<std::size_t>(left, Workers::capacity_for(query_)), cases);
      compare(cases);
    }
    for (ComparedBuild& c : all_) {
      if (c.first && !interrupted()) minimise(c);
    }
    return std::move(all_);
  }

 private:
  void compare(std::span<const Case> cases) {
    std::vector<std::vector<Answer>> answers(subjects_.size());
    dispatcher_.ask(
        subjects_, cases, [] {},
        [&](const Subject& s, std::span<const Answer> of_s) {
          const auto at = std::find(subjects_.begin(), subjects_.end(), &s) - subjects_.begin();
          answers[std::size_t(at)].assign(of_s.begin(), of_s.end());
        });
    for (std::size_t i = 0; i < all_.size(); ++i) compare(all_[i], cases, answers.front(), answers[i + 1]);
  }
  void compare(ComparedBuild& c, std::span<const Case> cases, std::span<const Answer> base,
               std::span<const Answer> other) {
    for (std::size_t i = 0; i < std::min(base.size(), other.size()); ++i) {
      ++c.asked;
      const auto difference = bit_difference(query_, c.base->scalar, base[i], other[i]);
      if (!difference) continue;
      const bool outside = is_outside(cases[i], base[i], *c.base);
      ++c.different, c.outside += outside;
      if (!c.first || (c.first->is_outside && !outside))
        c.first = FirstDifference{cases[i], outside, cases[i], *difference, {base[i], {}}, {other[i], {}}, {}};
    }
  }
  /// Replaces the first case by a simpler one, and judges the answers.
  void minimise(ComparedBuild& c) {
    FirstDifference& first = *c.first;
    const auto keeps = [&](const Case& changed) {
      settings_.tick(query_);
      const Answer base = dispatcher_.workers().ask(*c.base, changed);
      const Answer other = dispatcher_.workers().ask(*c.other, changed);
      const auto difference = bit_difference(query_, c.base->scalar, base, other);
      if (interrupted() || !difference || difference->kind != first.difference.kind) return false;
      if (is_outside(changed, base, *c.base) != first.is_outside) return false;
      first.question = changed, first.difference = *difference;
      first.base.answer = base, first.other.answer = other;
      return true;
    };
    shrink(in_fewer_regions(first.found, keeps), keeps, settings_.questions);
    first.base = judged_answer(first.question, first.base.answer, *c.base);
    first.other = judged_answer(first.question, first.other.answer, *c.other);
    first.truth = truth_of(first.question, c.base->standard_for(query_.name).declared);
  }

  const Query& query_;
  const BuildsSettings& settings_;
  Dispatcher& dispatcher_;
  std::vector<const Subject*> subjects_;  ///< those that offer the query, the base first; empty without two
  std::vector<ComparedBuild> all_;
};

}  // namespace

std::string_view name_of(BitDifference::Kind k) {
  switch (k) {
    case BitDifference::Kind::status: return "status";
    case BitDifference::Kind::decision: return "decision";
    case BitDifference::Kind::given: return "given numbers";
    case BitDifference::Kind::numbers: return "numbers";
  }
  return "?";
}

std::optional<BitDifference> bit_difference(const Query& query, Scalar scalar, const Answer& base,
                                            const Answer& other) {
  if (base.status != other.status) return BitDifference{BitDifference::Kind::status};
  if (base.status != Answer::Status::answered) return std::nullopt;
  if (decides(query.kind) && base.yes != other.yes) return BitDifference{BitDifference::Kind::decision};
  BitDifference d{BitDifference::Kind::numbers};
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (is_part(query, base, i) != is_part(query, other, i)) return BitDifference{BitDifference::Kind::given};
    const double a = base.values[i], b = other.values[i];
    if (is_part(query, base, i) && !are_same(a, b))
      d.numbers.push_back({i, a, b, ulps_between(scalar, query.outputs[i].role, a, b)});
  }
  return d.numbers.empty() ? std::nullopt : std::optional(d);
}

std::vector<ComparedBuild> compare_builds(const BuildsSettings& settings, std::span<const Subject* const> subjects) {
  Dispatcher dispatcher([] { return !interrupted(); });
  std::vector<ComparedBuild> all;
  for (const Query* q : settings.queries) {
    if (interrupted()) break;
    for (ComparedBuild& c : ComparedQuery(*q, settings, subjects, dispatcher).result()) all.push_back(std::move(c));
  }
  return all;
}

}  // namespace nearmiss
