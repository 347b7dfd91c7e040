/// The engine: schedules cases, asks subjects, has every answer judged, and hands what comes of it to its sinks. Runs,
/// stored cases, maps of extremes and imports differ in where their cases come from and in what listens.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "reports/engine/dispatcher.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/engine/schedule.hpp"

namespace nearmiss {

/// An answer to a case of a batch, and the judge's word on it.
struct Examined {
  const Case& question;
  const Subject& subject;
  const Answer& answer;
  const Finding& finding;
  std::string_view output;   ///< what the subject's host wrote, where it broke
  std::size_t of_batch = 0;  ///< which case of the batch it is
};

/// What listens to a campaign.
class Sink {
 public:
  virtual ~Sink() = default;
  /// Of a case that is examined alone the batch is empty.
  virtual void begin_batch(std::span<const Case>) {}
  virtual void take(const Examined& e) = 0;
  /// Cases that are not asked, since the subject was late too often.
  virtual void take_given_up(const Query&, const Subject&, std::uint64_t) {}
  /// No answer of a batch is awaited any more: other cases may be asked.
  virtual void end_batch() {}
};

class Campaign {
 public:
  using Clock = std::chrono::steady_clock;

  struct Settings {
    std::filesystem::path folder;  ///< where internal errors are kept
    std::function<void()> tick;    ///< called often, also while subjects are awaited
    /// What answers are held to; without one, what the subject promises, or else the measure.
    std::function<Standard(const Subject&, const Query&)> standard{};
    Dispatcher::GiveUp give_up = Dispatcher::GiveUp::when_often_late;
  };

  Campaign(Settings settings, std::vector<Sink*> sinks);

  /// All cases are of one query and exact in the subjects' scalar. Stops early when it should. `meanwhile` is done
  /// while the subjects answer. A case outside of what a subject requires counts as not asked.
  void examine(std::span<const Subject* const> subjects, std::span<const Case> cases,
               const std::function<void()>& meanwhile = {});
  /// One case, whatever the scalar of the subjects: one that cannot hold it exactly has it out of its domain.
  void examine_in_any_scalar(std::span<const Subject* const> subjects, const Case& question);
  /// Cases of the generator, until the schedule or the time is over. The next batch is made while the subjects answer
  /// the one before; batches are as large as lets a person stop the campaign.
  void generate(Schedule& schedule, std::uint64_t seed);

  /// True when it was interrupted or its time is over.
  bool should_stop() const;
  void set_until(std::optional<Clock::time_point> until) { until_ = until; }
  std::optional<Clock::time_point> until() const { return until_; }

  const InternalErrors& internal_errors() const { return internal_errors_; }
  Dispatcher& dispatcher() { return dispatcher_; }

 private:
  bool goes_on() const;
  Standard standard_for(const Subject& subject, const Query& query) const;
  void ask_and_judge(std::span<const Subject* const> subjects, std::span<const Case> cases,
                     const std::function<void()>& meanwhile);
  void judge_all(const Subject& subject, std::span<const Case> cases, std::span<const Answer> answers);
  void hand_on_given_up(std::span<const Subject* const> subjects, const Query& query);

  Settings settings_;
  std::vector<Sink*> sinks_;
  std::optional<Clock::time_point> until_;
  Dispatcher dispatcher_;
  InternalErrors internal_errors_;
  std::map<std::pair<const Subject*, const Query*>, std::uint64_t> given_up_;  ///< as the sinks know
};

}  // namespace nearmiss
