#include "reports/engine/sweep_counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "impl/subject/contained.hpp"
#include "oracles/motion_numbers.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

/// The processor time of this thread, in seconds.
double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
}

struct NamedCount {
  const char* name;
  std::uint64_t SweepCounts::*count;
};
constexpr NamedCount named_counts[] = {{"asked", &SweepCounts::asked},
                                       {"false_hits", &SweepCounts::false_hits},
                                       {"false_misses", &SweepCounts::false_misses},
                                       {"not_finite", &SweepCounts::not_finite},
                                       {"negative_times", &SweepCounts::negative_times},
                                       {"no_answer", &SweepCounts::no_answer},
                                       {"broke", &SweepCounts::broke},
                                       {"judged", &SweepCounts::judged},
                                       {"outside", &SweepCounts::outside},
                                       {"violations", &SweepCounts::violations},
                                       {"internal_errors", &SweepCounts::internal_errors}};

nlohmann::ordered_json violation_to_json(const std::optional<SweptViolation>& v) {
  if (!v) return nullptr;
  return {{"position", v->at},
          {"number", double(float_at(v->at))},
          {"above_epsilon", v->above < 0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(v->above)}};
}

double bound_from_json(const FileValue& j) { return j.is_null() ? -1 : j.not_negative(); }

std::optional<SweptViolation> violation_from_json(const FileValue& j) {
  if (j.is_null()) return std::nullopt;
  return SweptViolation{j.at("position").count(), bound_from_json(j.at("above_epsilon"))};
}

}  // namespace

void SweepCounts::add_violation(const SweptViolation& v) {
  if (!first || v.at < first->at) first = v;
  if (!worst || v.above > worst->above || (v.above == worst->above && v.at < worst->at)) worst = v;
}

void SweepCounts::add(const SweepCounts& other) {
  for (const NamedCount& n : named_counts) this->*n.count += other.*n.count;
  worst_backward = std::max(worst_backward, other.worst_backward);
  seconds += other.seconds;
  judge_seconds += other.judge_seconds;
  if (other.first) add_violation(*other.first);
  if (other.worst) add_violation(*other.worst);
}

nlohmann::ordered_json sweep_counts_to_json(const SweepCounts& c) {
  nlohmann::ordered_json j;
  for (const NamedCount& n : named_counts) j[n.name] = c.*n.count;
  j["backward_epsilon"] =
      c.worst_backward < 0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(c.worst_backward);
  j["first_violation"] = violation_to_json(c.first);
  j["worst_violation"] = violation_to_json(c.worst);
  j["seconds"] = c.seconds;
  j["judge_seconds"] = c.judge_seconds;
  return j;
}

SweepCounts sweep_counts_from_json(const FileValue& j) {
  SweepCounts c;
  for (const NamedCount& n : named_counts) {
    c.*n.count = j.at(n.name).count();
    if (c.*n.count > c.asked) j.at(n.name).fail("at most the number of asked floats");
  }
  c.worst_backward = bound_from_json(j.at("backward_epsilon"));
  c.first = violation_from_json(j.at("first_violation"));
  c.worst = violation_from_json(j.at("worst_violation"));
  c.seconds = j.at("seconds").not_negative();
  c.judge_seconds = j.at("judge_seconds").not_negative();
  return c;
}

SweepAsker::SweepAsker(const Slice& slice, const Subject& subject)
    : slice_(slice),
      answer_(subject.offering(slice.query().name).answer),
      standard_(subject.standard_for(slice.query().name)),
      outputs_(slice.query().outputs.size()),
      values_(slice.question().values),
      question_(slice.question()) {
  for (std::size_t i = 0; i < outputs_; ++i) {
    if (slice.query().outputs[i].role == Role::time && !time_) time_ = i;
  }
}

bool SweepAsker::ask(std::uint64_t begin, std::uint64_t end, bool yes, const std::function<bool()>& stopped) {
  constexpr std::uint64_t between_looks = 1u << 12;
  const double started = processor_time();
  for (std::uint64_t at = begin; at < end && !stopped(); at += between_looks) {
    ask_all(at, std::min(end, at + between_looks), yes);
  }
  counts_.seconds += processor_time() - started;
  return !stopped();
}

void SweepAsker::ask_all(std::uint64_t begin, std::uint64_t end, bool yes) {
  double& swept = values_[slice_.number()];
  for (std::uint64_t at = begin; at < end; ++at) {
    swept = double(float_at(at));
    const Answer a = answer_or_broke([&] { return answer_(values_); });
    if (a.status != Answer::Status::answered || a.yes != yes || has_bad_number(a)) examine(at, a, yes);
  }
  counts_.asked += end - begin;
}

/// A number that is given and is not finite, or a negative time. The numbers of a miss mean nothing, except its time,
/// which may be infinite, as the time of leaving may be.
bool SweepAsker::has_bad_number(const Answer& a) const {
  if (slice_.query().kind == Kind::impact && !a.yes) return time_ && !(a.values[*time_] >= 0);
  for (std::size_t i = 0; i < outputs_; ++i) {
    const bool never_leaves = a.values[i] == HUGE_VAL && is_time_of_leaving(slice_.query(), i);
    if (!std::isfinite(a.values[i]) && a.gives(i) && !never_leaves) return true;
  }
  return time_ && a.values[*time_] < 0;
}

void SweepAsker::examine(std::uint64_t at, const Answer& a, bool yes) {
  const double started = processor_time();
  ++counts_.judged;
  count(a, yes);
  judge_at(at, a, yes);
  counts_.judge_seconds += processor_time() - started;
}

void SweepAsker::count(const Answer& a, bool yes) {
  counts_.broke += a.status == Answer::Status::broke;
  counts_.no_answer += a.status == Answer::Status::cannot_answer;
  if (a.status != Answer::Status::answered) return;
  counts_.false_hits += a.yes && !yes;
  counts_.false_misses += !a.yes && yes;
  if (!has_bad_number(a)) return;
  const bool negative = time_ && a.values[*time_] < 0;
  (negative ? counts_.negative_times : counts_.not_finite) += 1;
}

void SweepAsker::judge_at(std::uint64_t at, const Answer& a, bool yes) {
  question_.values[slice_.number()] = double(float_at(at));
  try {
    const Finding f = confirmed(question_, a, standard_, Detail::verdict);
    const bool knows_truth = f.verdict == Verdict::agrees || f.verdict == Verdict::not_proved || f.is_proved();
    if (knows_truth && f.truth_yes != yes) {
      throw std::logic_error(fmt::format("{}: the judge's exact decision at {} = {} is not that of its range",
                                         slice_.query().name, slice_.field().name,
                                         number_text(question_.values[slice_.number()], Scalar::float32)));
    }
    counts_.outside += f.verdict == Verdict::out_of_domain;
    if (f.backward) counts_.worst_backward = std::max(counts_.worst_backward, f.backward->above);
    if (!f.is_proved() && f.verdict != Verdict::broke) return;
    counts_.violations += f.is_proved();
    counts_.add_violation({at, f.backward ? f.backward->above : -1});
  } catch (const InternalError& error) {
    ++counts_.internal_errors;
    internal_errors_.push_back(error);
  }
}

}  // namespace nearmiss
