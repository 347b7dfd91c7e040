/// Advice: for each query of a scene the cheapest subject that meets every requirement of the scene, with the evidence
/// (advice.json, reports/advice.schema.json).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/advice/evidence.hpp"
#include "reports/advice/remedies.hpp"
#include "reports/trade/trade.hpp"

namespace nearmiss {

struct AdviceSettings {
  std::string command;  ///< as typed
  std::filesystem::path folder;
  TradeSource source;
  std::vector<const Query*> queries;
  std::vector<const Subject*> subjects;
  std::uint64_t seed = 1;        ///< of the cases that are timed; the evidence has the next one
  std::uint64_t cases = 10'000;  ///< of each query, for the evidence
};

/// A subject that may answer a query, in the order of cost.
struct RankedSubject {
  const TradeSummary* measured = nullptr;  ///< time and errors on the same cases as all others
  std::optional<SceneEvidence> evidence;   ///< empty where it failed before, or a cheaper one met everything
  std::vector<MetRequirement> requirements;

  const Subject& subject() const { return *measured->subject; }
  /// Nanoseconds of a call in a sequence of calls, as a step makes them: the mean over the cases, and the median of the
  /// repeats. The median call would hide that a subject takes long in less than half of the cases.
  std::optional<double> cost() const {
    return measured->sequential ? std::optional(measured->sequential->p50) : std::nullopt;
  }
  bool meets_all() const { return evidence && evidence->is_complete() && none_failed(requirements); }
  /// The requirements that failed, with the worst figure and the limit of each: "error of places and depths: 0.5 metre,
  /// at most 0.01".
  std::string failures() const;
};

/// A remedy and the cheapest subject that meets every requirement with it or, where none does, the one whose worst
/// answer uses up least of the tolerance.
struct TriedRemedy {
  std::string name, words;
  std::string unit;                  ///< of the lengths of the evidence
  const Subject* subject = nullptr;  ///< nullptr: none was tried
  SceneEvidence evidence;
  std::vector<MetRequirement> requirements;
  std::optional<double> cost;  ///< of the subject, without the remedy
  bool meets_all = false;
};

struct AdvisedQuery {
  const Query* query = nullptr;
  double share = 0;                       ///< of the query among all queries of the scene
  std::vector<RankedSubject> candidates;  ///< in the order of cost; empty where no subject offers the query
  std::optional<std::size_t> chosen;      ///< index of the candidate; empty where none meets every requirement
  std::vector<TriedRemedy> remedies;      ///< where the chosen one is not the cheapest, or there is none

  const RankedSubject* choice() const { return chosen ? &candidates[*chosen] : nullptr; }
  /// The next cheaper candidate, which fails; nullptr where there is none.
  const RankedSubject* down() const;
  /// The cheapest of the dearer candidates with a smaller error; nullptr where there is none.
  const RankedSubject* up() const;
};

/// Times all subjects on some cases, and then asks them in the order of their cost for fresh cases until one meets
/// every requirement. Stops early on an interrupt; the query that is then examined is left out.
class Advice {
 public:
  /// Makes the folder. Throws IoError where it cannot.
  explicit Advice(AdviceSettings settings);

  void find();
  /// Writes advice.json, trade.json, trade.csv and worst/QUERY.json, the worst case of each chosen subject.
  void write() const;

  nlohmann::ordered_json to_json() const;
  /// Tables of at most 100 columns.
  std::string text() const;
  /// 0; 1 where no subject meets a requirement of some query; 2 after an interrupt; InternalError::exit_code after an
  /// internal error.
  int exit_code() const;

  const AdviceSettings& settings() const { return settings_; }
  const std::vector<AdvisedQuery>& queries() const { return advised_; }
  std::uint64_t evidence_seed() const { return settings_.seed + 1; }
  /// The time of all queries of a step with the chosen subjects, in seconds; empty where a query has none.
  std::optional<double> seconds_per_step() const;

  /// How many cases of each query are timed, and judged for all subjects.
  static constexpr std::uint64_t timed_cases = 500;

 private:
  AdvisedQuery advised(const TradedQuery& traded);
  SceneEvidence evidence_of(const Subject& subject, const Query& query, const TradeSource& source);
  std::vector<TriedRemedy> tried_remedies(const AdvisedQuery& a);
  TriedRemedy tried(const Remedy& remedy, const AdvisedQuery& a);
  bool tick(std::uint64_t done);

  AdviceSettings settings_;
  Trade trade_;
  Progress progress_;
  std::uint64_t done_ = 0;
  Dispatcher dispatcher_;
  InternalErrors internal_errors_;
  std::vector<AdvisedQuery> advised_;
};

}  // namespace nearmiss
