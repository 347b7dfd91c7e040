/// The engine: schedules cases, asks subjects, judges every answer, and passes the findings to sinks. Runs, climbs,
/// stored cases, maps of extremes and imports differ in the source of their cases and in their sinks.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "reports/engine/answer_sample.hpp"
#include "reports/engine/dispatcher.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/engine/schedule.hpp"

namespace nearmiss {

/// An answer to a case of a batch, and its finding.
struct Examined {
  const Case& question;
  const Subject& subject;
  const Answer& answer;
  const Finding& finding;
  std::string_view output;   ///< output of the subject's host, where it broke
  std::size_t of_batch = 0;  ///< index of the case in the batch
};

/// Receives the findings of a campaign.
class Sink {
 public:
  virtual ~Sink() = default;
  /// The batch is empty for a case that is examined alone.
  virtual void begin_batch(std::span<const Case>) {}
  virtual void take(const Examined& e) = 0;
  /// True where this sink needs the second judgement of a settled violation (oracles/confirmed.hpp).
  virtual bool needs_second(const Examined&) const { return true; }
  /// A number of cases that were not asked because the subject was given up.
  virtual void take_given_up(const Query&, const Subject&, std::uint64_t, const Endurance&) {}
  /// A number of answers that were not judged because too many were wrong (reports/engine/answer_sample.hpp).
  virtual void take_not_judged(const Query&, const Subject&, std::uint64_t) {}
  /// Called when no answer of the batch is pending: the sink may ask other cases.
  virtual void end_batch() {}
};

class Campaign {
 public:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

  struct Settings {
    std::filesystem::path folder;  ///< the folder for internal errors
    std::function<void()> tick;    ///< called often, also while the campaign waits for subjects
    /// The bound for answers; without a function, Subject::standard_for.
    std::function<Standard(const Subject&, const Query&)> standard{};
    Dispatcher::GiveUp give_up = Dispatcher::GiveUp::when_often_broken;
    bool every_answer = false;  ///< judge every answer to generated cases, also where most are wrong
  };

  Campaign(Settings settings, std::vector<Sink*> sinks);

  /// All cases are of one query and exact in the subjects' scalar. Stops early on should_stop(). Runs `meanwhile` while
  /// the subjects work. A case that does not meet a subject's preconditions counts as not asked.
  void examine(std::span<const Subject* const> subjects, std::span<const Case> cases,
               const std::function<void()>& meanwhile = {});
  /// The same for cases that a search proposes: they are no sample, so that sinks get an empty batch, as for a case
  /// that is examined alone. Judges with at least this detail.
  void examine_searched(std::span<const Subject* const> subjects, std::span<const Case> cases, Detail detail);
  /// Examines one case with subjects of any scalar. For a scalar that cannot hold the case exactly it is out of domain.
  void examine_in_any_scalar(std::span<const Subject* const> subjects, const Case& question);
  /// Examines generated cases until the schedule or the time ends. Makes the next batch while the subjects work. Limits
  /// the duration of a batch, so that an interrupt takes effect soon. Of the answers of a subject that is often wrong
  /// it judges a sample (reports/engine/answer_sample.hpp).
  void generate(Schedule& schedule, std::uint64_t seed);

  /// True when the campaign was interrupted or its time is over.
  bool should_stop() const;
  void set_until(std::optional<Clock::time_point> until) { until_ = until; }
  std::optional<Clock::time_point> until() const { return until_; }

  const InternalErrors& internal_errors() const { return internal_errors_; }
  Dispatcher& dispatcher() { return dispatcher_; }

 private:
  bool keeps_waiting() const;
  Standard standard_for(const Subject& subject, const Query& query) const;
  void ask_and_judge(std::span<const Subject* const> subjects, std::span<const Case> cases,
                     const std::function<void()>& meanwhile, Detail detail = Detail::verdict);
  void judge_all(const Subject& subject, std::span<const Case> cases, std::span<const Answer> answers, Detail detail);
  /// Judges the i-th answer of a batch and hands the finding on. True where the answer is proved wrong.
  bool judge_one(const Subject& subject, const Standard& standard, const Case& question, const Answer& answer,
                 std::size_t i, Detail detail);
  void hand_on_given_up(std::span<const Subject* const> subjects, const Query& query);

  Settings settings_;
  std::vector<Sink*> sinks_;
  std::optional<Clock::time_point> until_;
  Dispatcher dispatcher_;
  InternalErrors internal_errors_;
  std::map<std::pair<const Subject*, const Query*>, std::uint64_t> given_up_;  ///< as reported to the sinks
  std::map<std::pair<const Subject*, const Query*>, AnswerSample> samples_;    ///< of the answers to generated cases
  bool is_generating_ = false;
};

}  // namespace nearmiss
