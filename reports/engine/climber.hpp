/// Climbs towards the worst errors of many subjects on many queries: a climb for each query, subject and kind of error,
/// which share the time of a campaign equally.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/engine/campaign.hpp"
#include "reports/engine/climb.hpp"

namespace nearmiss {

class Climber : public Sink {
 public:
  struct Settings {
    std::vector<const Query*> queries;
    std::vector<const Subject*> subjects;
    std::uint64_t seed = 0;
    std::optional<std::uint64_t> cases{};  ///< of each climb; empty: until the campaign's time is over
    Climb::Source source = Climb::Source::neighbours;
    bool from_stored = true;  ///< also begin at the stored worst cases of the query, of any subject
  };
  /// A forward climb needs a query with numbers in its answer. Throws BadInput for an invalid file of a worst case.
  explicit Climber(Settings settings);

  /// Climbs until the campaign should stop, or until each climb has asked its number of cases. The Climber must be a
  /// sink of the campaign. `turn` is called before each round.
  void run(Campaign& campaign, const std::function<void(const Climb&)>& turn);
  void take(const Examined& e) override { current_->take(e.of_batch, e.answer, e.finding); }

  const std::vector<Climb>& climbs() const { return climbs_; }
  /// The numbers of asked cases and of climbed hills, and for each climb its worst error: for the index of a run.
  nlohmann::ordered_json to_json() const;
  /// A table with a row for each query and subject: the worst forward and backward error, and the promised bounds.
  std::string table() const;
  /// "33,120 cases on 210 hills".
  std::string summary() const;

 private:
  /// The climb that has taken the least time of those that go on; nullptr: none goes on.
  Climb* next();
  std::size_t left(const Climb& c) const;

  Settings settings_;
  std::vector<Climb> climbs_;
  Climb* current_ = nullptr;
};

/// Writes the records of climbs of our own subjects into the stored worst cases (corpus/worst/), where they are worse
/// than what the stored case gives today. Where the stored case itself gives another error today, because the subject
/// or the judge changed, its file gets today's error, or is removed where no error is left. A record that breaks its
/// contract is not stored: it is a bug and has a report. Returns a line for each changed file and each such record.
/// Throws IoError where a file cannot be written.
std::vector<std::string> update_worst_cases(const Climber& climber);

}  // namespace nearmiss
