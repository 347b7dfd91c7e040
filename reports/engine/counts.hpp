/// What a campaign counts: of each query and subject, of each of the generator's moves, of exact touches.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/engine/campaign.hpp"
#include "reports/engine/tally.hpp"
#include "reports/engine/touch_counts.hpp"

namespace nearmiss {

class Counts : public Sink {
 public:
  /// Counts what these subjects answer to these queries; with `by_class` by the moves that made the cases as well.
  Counts(std::vector<const Query*> queries, std::vector<const Subject*> subjects, bool by_class);

  void begin_batch(std::span<const Case> cases) override { touching_.assign(cases.size(), std::nullopt); }
  void take(const Examined& e) override;
  void take_given_up(const Query& query, const Subject& subject, std::uint64_t cases) override;

  /// nullptr where the subject does not offer the query.
  const Tally* of(const Query& query, const Subject& subject) const;
  std::uint64_t cases() const { return cases_; }
  /// Answers that are violations or breakages.
  std::uint64_t bad_answers() const { return bad_; }
  /// The same, and every subject that has two conventions of touching.
  std::uint64_t bad() const { return bad_ + touch_counts_.inconsistent().size(); }

  /// "nothing violated", or all that was by kind; and how many queries had no turn.
  std::string violated_text() const;
  /// A table for people: one row for each query and subject, and how often the exact stage had to decide; empty where
  /// nothing was asked.
  std::string table() const;
  /// For every subject its findings among the cases that each move of the generator made.
  std::string table_by_class() const;
  /// What the subjects make of exact touches: counts where some are no, and who has two conventions; empty without any.
  std::string touches_text() const;
  /// The members of an index that hold all of this.
  void add_to(nlohmann::ordered_json& index) const;

 private:
  /// How often each of the oracle's stages decided, of all subjects together.
  struct Stages {
    std::uint64_t interval = 0, exact = 0;
    double exact_share() const { return exact == 0 ? 0 : double(exact) / double(interval + exact); }
  };
  Stages stages_of(const Query& query) const;
  std::string breakages_text() const;
  std::string given_up_text() const;
  std::string stages_text() const;
  void count_by_class(const Examined& e);

  std::vector<const Query*> queries_;
  std::vector<const Subject*> subjects_;
  bool has_classes_;
  std::map<std::pair<const Query*, const Subject*>, Tally> tallies_;
  std::map<std::pair<const Subject*, std::string>, Tally> by_class_;
  TouchCounts touch_counts_;
  std::vector<std::optional<bool>> touching_;  ///< of the cases of the batch, where it is known
  std::uint64_t cases_ = 0, bad_ = 0;
};

}  // namespace nearmiss
