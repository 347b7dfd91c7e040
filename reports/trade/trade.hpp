/// The price of accuracy: the time and the errors of many subjects on the same cases (trade.json,
/// reports/trade.schema.json).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/engine/dispatcher.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/engine/progress.hpp"
#include "reports/trade/sources.hpp"
#include "reports/trade/summary.hpp"

namespace nearmiss {

struct TradeSettings {
  std::string command;  ///< as typed
  std::filesystem::path folder;
  TradeSource source;
  std::vector<const Query*> queries;
  std::vector<const Subject*> subjects;
  std::uint64_t seed = 1;
  std::uint64_t cases = 1000;  ///< of each query
  unsigned repeats = 5;        ///< of each time
};

/// The measurements of one query.
struct TradedQuery {
  const Query* query;
  double share;  ///< among the queries of the scene
  std::uint64_t cases = 0, contacts = 0;
  std::vector<TradeSummary> subjects;  ///< those that offer the query
};

/// Measures each subject on the same cases: first the errors, by the judge, then the times. The cases fit the
/// preconditions of all chosen subjects together.
///
/// A case is exact in the scalar of the source. Where that is double, a subject in float is asked the rounded numbers
/// and its answer is judged by the exact ones: the rounding is a part of the price of float.
class Trade {
 public:
  /// Makes the folder. Throws IoError where it cannot.
  explicit Trade(TradeSettings settings);

  /// Stops early on an interrupt; the query that is then measured is left out.
  void measure();
  /// Writes trade.json and trade.csv into the folder.
  void write() const;

  nlohmann::ordered_json to_json() const;
  std::string csv() const;
  /// Tables of at most 100 columns.
  std::string text() const;
  /// 0; 2 after an interrupt; InternalError::exit_code after an internal error.
  int exit_code() const;
  const std::vector<TradedQuery>& queries() const { return traded_; }

 private:
  std::vector<const Subject*> offering(const Query& query) const;
  std::vector<Case> drawn(const Query& query, Preconditions required) const;
  void measure_query(const Query& query, double share);
  /// The answers of each subject in the order of the cases.
  std::vector<std::vector<TradeAnswer>> judged(std::span<const Subject* const> subjects, std::span<const Case> cases);
  std::vector<TradeAnswer> judged_batch(const Subject& subject, std::span<const Case> batch);
  TradeAnswer judged_answer(const Subject& subject, const Case& question, const Case& asked, const Answer& answer);
  void add_to_profile(const TradedQuery& traded, const std::vector<std::vector<TradeAnswer>>& answers,
                      const std::vector<TradeTimes>& times);
  void tick(std::uint64_t done);
  nlohmann::ordered_json profile_to_json() const;

  TradeSettings settings_;
  std::string started_;
  Progress progress_;
  std::uint64_t done_ = 0, total_ = 0;
  Dispatcher dispatcher_;
  InternalErrors internal_errors_;
  std::vector<TradedQuery> traded_;
  PerformanceProfile profile_;
};

/// The processor, its number and its load, for the results.
nlohmann::ordered_json machine_to_json();

}  // namespace nearmiss
