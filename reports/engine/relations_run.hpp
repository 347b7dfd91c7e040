/// Asks many subjects many cases and their follow-ups, counts by relation, and writes reports of broken relations.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/engine/dispatcher.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/retention.hpp"
#include "reports/engine/schedule.hpp"

namespace nearmiss {

struct RelationsSettings {
  std::string command;  ///< as typed
  std::filesystem::path folder;
  std::vector<const Query*> queries;
  std::vector<const Subject*> subjects;
  std::vector<const Relation*> relations;
  std::uint64_t seed = 1;
  bool bit_for_bit = false;              ///< every subject claims equal bits, not only claims_same_bits()
  const scenes::Scene* scene = nullptr;  ///< where the cases are taken from; nullptr: the generator
};

/// The counts of one relation for one query and subject.
struct RelationTally {
  std::uint64_t cases = 0;  ///< cases where the case and all follow-ups were answered
  std::uint64_t numbers_differ = 0;
  std::uint64_t contradictions = 0, bits = 0, contract = 0, broke = 0, oracle = 0;
  double worst_backward = -1;  ///< the largest proved bound of a wrong answer; negative: none

  void count(const RelationFinding& f);
  void add(const RelationTally& other);
  std::uint64_t bad() const { return bits + contract + broke; }
};

class RelationsRun {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws IoError where the folder cannot be made.
  explicit RelationsRun(RelationsSettings settings);

  /// Examines `cases` of each query, subject and relation, or as many as the time allows. Queries take turns. An
  /// interrupt stops it early.
  void run(std::optional<std::uint64_t> cases, std::optional<Clock::time_point> until = std::nullopt);
  /// Writes relations.json (reports/relations.schema.json) beside the findings.
  void write() const;

  /// A table with a row for each subject and relation, and sums.
  std::string table() const;
  /// A line for each subject that was given up; empty where all were asked to the end.
  std::vector<std::string> given_up() const;
  std::string worst_findings() const;
  std::string summary() const;
  nlohmann::ordered_json to_json() const;
  std::uint64_t bad() const;
  /// The same of some subjects.
  std::uint64_t bad_of(const std::function<bool(const Subject&)>& some) const;
  /// The number of errors of Nearmiss itself, on one case or on related cases.
  std::uint64_t contradicted() const;
  const RelationsSettings& settings() const { return settings_; }
  std::uint64_t pairs() const { return sum().cases; }
  std::uint64_t contradictions() const { return sum().contradictions; }
  std::size_t reports() const { return written_.size(); }
  /// Written reports that are no longer on the disk: others have removed them.
  std::vector<std::string> vanished() const;

 private:
  struct Key {
    const Subject* subject;
    const Relation* relation;
    const Query* query;
    auto operator<=>(const Key&) const = default;
  };
  struct Written {
    Key key;
    std::string file;
    Breach breach;
    bool is_of_the_oracle;  ///< an error of Nearmiss itself
    std::string headline;
    double above = -1;
    std::string_view breach_name() const { return is_of_the_oracle ? "oracle" : name_of(breach); }
  };
  void batch(Stream& stream, std::size_t count);
  void relate_all(const Relation& relation, const std::vector<Case>& cases,
                  const std::map<const Subject*, std::vector<Answer>>& own);
  void take(const Key& key, const RelationChoice& choice, const RelationFinding& found);
  void put_in_order(Written w);
  bool worth_a_report(const Key& key, const RelationFinding& found, double above);
  /// The answers to all cases. A case that was not asked, after time-outs or at the end of the time, has
  /// answer_of_given_up().
  std::vector<Answer> ask(const Subject& subject, const std::vector<Case>& cases);
  RelationTally sum() const;
  std::uint64_t broke_alone() const;
  bool should_stop() const;
  void show_progress();

  RelationsSettings settings_;
  Clock::time_point begin_;
  std::optional<Clock::time_point> until_;
  Dispatcher dispatcher_;
  Progress progress_;
  std::map<Key, RelationTally> tallies_;
  /// Cases that broke a subject before they were related to others.
  std::map<std::pair<const Subject*, const Query*>, std::uint64_t> broke_alone_;
  Retention retention_;
  std::vector<Written> written_;
  InternalErrors internal_errors_;
  std::uint64_t done_ = 0;
  std::uint64_t not_asked_ = 0;  ///< pairs with a follow-up that does not meet the subject's preconditions
  std::optional<std::uint64_t> total_;
};

}  // namespace nearmiss
