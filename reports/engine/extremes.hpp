/// Where a subject breaks down: its worst errors over distance, size, speed, ratio and angle.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/sweep.hpp"
#include "impl/subject/subject.hpp"
#include "reports/engine/campaign.hpp"
#include "reports/engine/progress.hpp"

namespace nearmiss {

struct ExtremesSettings {
  std::string command;  ///< as typed
  std::filesystem::path folder;
  std::vector<const Query*> queries;
  std::vector<const Subject*> subjects;
  std::uint64_t seed = 1;
  std::uint64_t cases = 50;  ///< of each cell
};

/// What was proved against the answers to the cases at one place of a plane. Contracts play no part: a place where
/// nothing is promised is measured all the same.
struct ExtremesCell {
  std::uint64_t cases = 0;       ///< answered; fewer where numbers do not fit the scalar
  std::uint64_t false_hits = 0;  ///< never added to the false misses
  std::uint64_t false_misses = 0;
  std::uint64_t not_finite = 0;  ///< NaN or infinity in a number of the answer
  std::uint64_t broke = 0;       ///< exception, abort, crash, limit
  std::uint64_t no_answer = 0;   ///< the subject says so
  std::uint64_t not_asked = 0;   ///< the case is outside of what the subject requires
  std::uint64_t gave_up = 0;     ///< not asked any more, after time-outs in this row or all over this map
  double forward_ulps = 0;       ///< of the worst number of an answer with the right decision: at least
  double backward_epsilon = -1;  ///< largest proved bound; negative where nothing is proved
};

struct ExtremesMap {
  const Query* query;
  const Subject* subject;
  SweepPlane plane;
  std::vector<ExtremesCell> cells;  ///< rows of y, in each the values of x
  std::uint64_t time_outs = 0, time_outs_in_row = 0;

  /// After so many time-outs the subject is not asked again: in that row, and in the whole map.
  static constexpr std::uint64_t most_in_row = 3, most = 12;
  bool given_up() const { return time_outs_in_row >= most_in_row || time_outs >= most; }
};

class Extremes {
 public:
  /// Makes the folder. Throws IoError where it cannot.
  explicit Extremes(ExtremesSettings settings);
  ~Extremes();

  /// Fills every map, or as many as there is time for before an interrupt.
  void sweep();
  /// Writes extremes.json, which reports/extremes.schema.json describes, and the page extremes.html, where this
  /// build knows the library that draws it.
  void write() const;

  /// Rows of query and subject: the worst of all their cells.
  std::string table() const;
  std::string summary() const;
  /// 0, 2 where it was interrupted; InternalError's where there was one.
  int exit_code() const;
  nlohmann::ordered_json to_json() const;
  /// The page with everything in it; empty where the library that draws it was not there at build.
  static std::optional<std::string> page(const nlohmann::ordered_json& report);

 private:
  void fill(const Query& query, Scalar scalar, const SweepPlane& plane);
  void ask(const std::vector<ExtremesMap*>& maps, std::size_t cell, std::span<const Case> cases);
  ExtremesSettings settings_;
  std::vector<ExtremesMap> maps_;
  Progress progress_;
  std::uint64_t done_ = 0, total_ = 0;
  class Place;
  std::unique_ptr<Place> place_;
  Campaign campaign_;
};

}  // namespace nearmiss
