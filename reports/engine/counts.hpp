/// The counts of a campaign: by query and subject, by mutator of the generator, and of exact touches.
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
  /// Counts the answers of these subjects to these queries; with `by_class` also by the mutators that made the cases.
  Counts(std::vector<const Query*> queries, std::vector<const Subject*> subjects, bool by_class);

  /// Counts the answers of these subjects too; the tables have them in this order. All subjects so far are among them.
  void extend(std::vector<const Subject*> subjects);

  void begin_batch(std::span<const Case> cases) override { touching_.assign(cases.size(), std::nullopt); }
  void take(const Examined& e) override;
  /// Where the second judgement may raise the worst error; and for a sample, so that a judge that contradicts itself is
  /// noticed.
  bool needs_second(const Examined& e) const override;
  void take_given_up(const Query& query, const Subject& subject, std::uint64_t cases, const Endurance& e) override;
  void take_not_judged(const Query& query, const Subject& subject, std::uint64_t answers) override;

  /// The counts of one subject on one query; nullptr where the subject does not offer it.
  const Tally* of(const Query& query, const Subject& subject) const;
  std::uint64_t cases() const { return cases_; }
  /// Answers that were not judged because too many were wrong.
  std::uint64_t not_judged() const { return not_judged_; }
  /// Answers that are violations or breakages.
  std::uint64_t bad_answers() const { return bad_; }
  /// The same plus the number of subjects with two conventions of touching.
  std::uint64_t bad() const { return bad_ + touch_counts_.inconsistent().size(); }

  /// The violations by kind, or "nothing violated", and the number of queries that were not asked.
  std::string violated_text() const;
  /// A table with one row for each query and subject, and the share that the exact stage decided; empty where nothing
  /// was asked.
  std::string table() const;
  /// The rows of table() for all queries together, one for each subject; empty where nothing was asked.
  std::string totals() const;
  /// A table of the findings of every subject by mutator of the generator.
  std::string table_by_class() const;
  /// The answers to exact touches: counts where some are no, and subjects with two conventions; empty where all are
  /// yes.
  std::string touches_text() const;
  /// Adds all counts to an index.
  void add_to(nlohmann::ordered_json& index) const;

 private:
  /// How often each stage of the oracle decided, over all subjects.
  struct Stages {
    std::uint64_t interval = 0, exact = 0;
    double exact_share() const { return exact == 0 ? 0 : double(exact) / double(interval + exact); }
  };
  Stages stages_of(const Query& query) const;
  std::vector<std::vector<std::string>> rows_of_totals() const;
  std::string breakages_text() const;
  std::string passed_over_text() const;
  std::string stages_text() const;
  void count_by_class(const Examined& e);

  std::vector<const Query*> queries_;
  std::vector<const Subject*> subjects_;
  bool has_classes_;
  std::map<std::pair<const Query*, const Subject*>, Tally> tallies_;
  std::map<std::pair<const Subject*, std::string>, Tally> by_class_;
  TouchCounts touch_counts_;
  std::vector<std::optional<bool>> touching_;  ///< for each case of the batch: whether it is an exact touch, once known
  std::uint64_t cases_ = 0, bad_ = 0, not_judged_ = 0;
};

}  // namespace nearmiss
